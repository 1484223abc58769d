//! `quadrille` finds good topologies for structured surface structures: gridshells, shells and cable nets.
//!
//! A design is a short string over a small grammar. The pipeline runs one way; every stage is a plain
//! function on plain data:
//!
//! ```text
//! config → string → topology → geometry → structure → objectives → selection → files
//! ```
//!
//! Method: Oval, Mesnil, Van Mele, Baverel, Block, *A vector encoding for topology finding of structured
//! quad-based patterns for surface structures*. See `docs/ARCHITECTURE.md` for the modules and what flows.

pub mod config;
pub mod domain;
pub mod evolve;
pub mod files;
pub mod geometry;
pub mod grammar;
pub mod io;
pub mod json;
pub mod mesh;
pub mod objectives;
pub mod output;
pub mod random;
pub mod search;
mod simd;
pub mod skeleton;
pub mod structure;
pub mod study;
pub mod surface;
