//! The in-house linear-elastic frame solver (STRUCTURE). It knows nodes and members, not strips.

pub mod params;

pub use params::StructureParams;
