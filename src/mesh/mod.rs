//! Topology only: coarse quad meshes without coordinates (GRAMMAR §1).

pub mod base;
pub mod canonical;
pub mod ids;

pub use base::BaseMesh;
pub use canonical::{CanonicalMesh, Code, Strip};
pub use ids::{FaceId, StripId, VertexId};
