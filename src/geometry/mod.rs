//! From the canonical mesh to a dense pattern on the surface, and its fabrication metrics (docs/reference/geometry.md).
//!
//! ```text
//! canonical mesh → corners → (topology: flat, pinched) → density → dense → place → relax → check
//! ```
//!
//! Every step is a function of the canonical mesh, the domain, the surface and the parameters: equal codes give equal bytes.

pub mod boundary;
pub mod check;
pub mod coarse;
pub mod conway;
pub mod corners;
pub mod dense;
pub mod density;
mod develop;
pub mod deviation;
pub mod distinct;
pub mod force_density;
pub mod images;
pub mod laplacian;
pub mod limits;
pub mod metrics;
pub mod optimise;
pub mod outline;
pub mod params;
pub mod pattern;
pub mod place;
mod rejection;
pub mod relax;
pub mod sparse;
pub mod topology;
pub mod untangle;
pub mod vector;

pub use develop::{Shaped, develop, shape, topological_rejection};
pub use images::Image;
pub use params::PatternParams;
pub use pattern::{Panel, Pattern};
pub use rejection::Rejection;
