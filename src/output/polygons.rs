//! What mesh formats are written from: positions and faces, of a pattern or of what a Conway operator makes of it.

use crate::geometry::Pattern;
use crate::geometry::conway::PolyMesh;

/// A mesh of polygons. Borrowed, since exporters only read.
#[derive(Clone, Debug)]
pub struct Polygons<'a> {
    /// Vertex positions, m, z up.
    pub positions: &'a [[f64; 3]],
    /// Faces of three or more vertices, counter-clockwise seen from above.
    pub faces: Vec<&'a [u32]>,
    /// A number that each face carries (the coarse face it belongs to); empty if there is none.
    pub coarse_faces: &'a [u32],
}

impl<'a> From<&'a Pattern> for Polygons<'a> {
    fn from(pattern: &'a Pattern) -> Self {
        Self {
            positions: &pattern.positions,
            faces: pattern.panels.iter().map(|panel| panel.corners()).collect(),
            coarse_faces: &pattern.coarse_face,
        }
    }
}

impl<'a> From<&'a PolyMesh> for Polygons<'a> {
    fn from(mesh: &'a PolyMesh) -> Self {
        Self {
            positions: &mesh.positions,
            faces: mesh.faces.iter().map(Vec::as_slice).collect(),
            coarse_faces: &[],
        }
    }
}
