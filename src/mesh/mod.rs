//! Topology only: coarse quad meshes without coordinates (docs/reference/grammar.md §1).

pub mod automorphism;
pub mod base;
pub mod base_json;
pub mod canonical;
pub mod code;
pub mod contract;
pub mod distance;
pub mod fold;
pub mod ids;
pub mod isomorphism;
pub mod load;
pub mod quad_mesh;
pub mod reduce;
pub mod samples;
pub mod strips;
pub mod subdivide;
pub mod symmetries;
pub mod unzip;
pub mod validate;

pub use base::BaseMesh;
pub use canonical::{CanonicalMesh, Code, Strip};
pub use distance::{Distance, deletions, distance};
pub use ids::{DartId, FaceId, StripId, VertexId};
pub use isomorphism::{Equivalence, Symmetry, canonical_mesh, canonical_mesh_under};
pub use load::{BaseMeshError, InitialMesh};
pub use quad_mesh::QuadMesh;
pub use symmetries::Symmetries;
