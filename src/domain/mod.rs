//! The domain: boundary loops and their corners (GEOMETRY §1).

pub mod params;

pub use params::{Corners, DomainParams, LoopParams};
