//! Strings, strips and meshes: the grammar against its reference cases, and properties of random strings.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod cases;
mod cli;
mod frozen;
mod oracle;
mod properties;
mod symmetry;
mod vectors;
