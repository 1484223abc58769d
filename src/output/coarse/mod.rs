//! A decoded string for other programs and for people: JSON, OBJ, SVG, text (docs/reference/files.md §3.2).

mod json;
mod layout;
mod obj;
mod svg;
mod text;

pub use json::json;
pub use obj::obj;
pub use svg::svg;
pub use text::text;

use crate::grammar::{Decoded, Tokens};
use crate::mesh::QuadMesh;
use std::collections::BTreeMap;

/// A string and what it decodes to.
#[derive(Clone, Copy, Debug)]
pub struct Reading<'a> {
    /// The string as given.
    pub string: &'a Tokens,
    /// What it means: the whole mesh and the marker on it.
    pub decoded: &'a Decoded,
    /// The part that it was decoded on, with the marker there, where patterns are to be symmetric.
    pub part: Option<&'a Decoded>,
}

/// The irregular vertices of a mesh, counted by valence.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, Default, serde::Serialize, serde::Deserialize)]
pub struct Singularities {
    /// Inner vertices with other than 4 edges.
    pub inner: BTreeMap<usize, usize>,
    /// Boundary vertices with other than 3 edges.
    pub boundary: BTreeMap<usize, usize>,
    /// Pole vertices, whatever their valence.
    pub poles: usize,
}

/// Counts the singular vertices: a pole with an irregular valence is counted under both.
pub fn singularities(mesh: &QuadMesh) -> Singularities {
    let mut counts = Singularities {
        poles: mesh.pole_vertices().iter().filter(|&&pole| pole).count(),
        ..Singularities::default()
    };
    for (valence, on_boundary) in mesh.valences().into_iter().zip(mesh.boundary_vertices()) {
        if on_boundary && valence != 3 {
            *counts.boundary.entry(valence).or_default() += 1;
        } else if !on_boundary && valence != 4 {
            *counts.inner.entry(valence).or_default() += 1;
        }
    }
    counts
}

/// The faces as lists of vertices, a pseudo-quad beginning with its pole.
fn faces(mesh: &QuadMesh) -> Vec<Vec<u32>> {
    mesh.face_darts().into_iter().map(|first| mesh.along(first).map(|d| mesh.origin(d).0).collect()).collect()
}
