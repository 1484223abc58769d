//! The initial mesh as it is given: plain arrays with positions, before any check.

use std::collections::BTreeMap;

/// An initial coarse quad mesh, from a file, from the config, or from the skeleton (docs/reference/geometry.md §1.3).
#[derive(Clone, PartialEq, Debug, Default)]
pub struct BaseMesh {
    /// Vertex positions, m.
    pub vertices: Vec<[f64; 3]>,
    /// Counter-clockwise faces: quads, or triangles whose pole is in `poles`.
    pub faces: Vec<Vec<u32>>,
    /// Pole vertex of each pseudo-quad, by face number.
    pub poles: BTreeMap<u32, u32>,
    /// Start of the marker, `(position, direction)`; default the first dart of face 0.
    pub marker: Option<[u32; 2]>,
    /// For each corner of the domain, the vertices that carry its mark.
    pub corners: Vec<Vec<u32>>,
}
