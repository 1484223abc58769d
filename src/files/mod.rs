//! Files that whatever writes into a results folder shares: written whole or not at all, locked, and named once.

pub mod atomic;
pub mod lock;
pub mod names;
