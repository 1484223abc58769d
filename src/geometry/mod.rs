//! From the canonical mesh to a dense pattern on the surface, and its fabrication metrics (GEOMETRY).

pub mod params;
pub mod pattern;

pub use params::{PatternParams, TopologyParams};
pub use pattern::{Panel, Pattern};
