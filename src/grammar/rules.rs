//! The two sets of rules, and why a token can be skipped (docs/reference/grammar.md §2.6).

use serde::{Deserialize, Serialize};

use crate::mesh::unzip::Inapplicable;
use crate::mesh::validate::Invalid;
use crate::mesh::{QuadMesh, VertexId};

/// Which results a string may have.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rules {
    /// The grammar as it stands.
    #[default]
    Plain,
    /// For patterns in a given boundary: no rule may add a flat face or put two corners on one vertex.
    Domain,
}

/// Why a token was skipped: not applicable, or its result would not be valid.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Skip {
    /// The polyedge cannot be unzipped.
    #[error("{0}")]
    Polyedge(#[from] Inapplicable),
    /// All edges of the position belong to the strip to delete.
    #[error("position inside strip")]
    PositionInsideStrip,
    /// No edge of the position is left for the marker.
    #[error("marker lost")]
    MarkerLost,
    /// Domain rules: the result has more flat faces than the mesh before.
    #[error("flat face")]
    FlatFace,
    /// Domain rules: two corners of the domain would be at one vertex.
    #[error("corners merged")]
    CornersMerged,
    /// The result would break a condition of a valid mesh.
    #[error("invalid: {0}")]
    Invalid(#[from] Invalid),
}

impl Skip {
    /// True for the class *invalid*, false for the class *not applicable*.
    pub fn is_invalid(self) -> bool {
        matches!(self, Self::Invalid(_))
    }
}

impl Rules {
    /// Whether the rules allow the step from a mesh to another.
    ///
    /// # Errors
    /// What the domain has no room for.
    pub fn allow(self, before: &QuadMesh, after: &QuadMesh) -> Result<(), Skip> {
        if self == Self::Plain {
            Ok(())
        } else if count_flat_faces(after) > count_flat_faces(before) {
            Err(Skip::FlatFace)
        } else if has_merged_corners(after) && !has_merged_corners(before) {
            Err(Skip::CornersMerged)
        } else {
            Ok(())
        }
    }
}

/// The two sides of the domain that a boundary vertex lies on; the same one twice unless it carries a mark.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Place {
    Inside,
    Sides(u32, u32),
    /// On a loop without marks.
    Loop,
}

/// Number of *flat* faces: all vertices of the face lie on one side of the domain, or all but one of its edges (or
/// all of them) on one and the same boundary loop that has no marks. Marks that are not sharp do not count.
pub fn count_flat_faces(mesh: &QuadMesh) -> usize {
    let places = places(mesh);
    let place = |v: VertexId| places[v.index()];
    mesh.face_darts()
        .into_iter()
        .filter(|&first| match place(mesh.origin(first)) {
            Place::Inside | Place::Loop => lies_on_one_loop(mesh, first, &places),
            Place::Sides(a, b) => [a, b].into_iter().any(|side| {
                mesh.along(first)
                    .all(|d| matches!(place(mesh.origin(d)), Place::Sides(a, b) if a == side || b == side))
            }),
        })
        .count()
}

fn lies_on_one_loop(mesh: &QuadMesh, first: crate::mesh::DartId, places: &[Place]) -> bool {
    let (mut edges, mut label, mut on_label) = (0, None, 0);
    for d in mesh.along(first) {
        edges += 1;
        let outside = mesh.left(mesh.twin(d)).as_loop();
        if let Some(outside) = outside
            && places[mesh.origin(d).index()] == Place::Loop
        {
            on_label += u32::from(*label.get_or_insert(outside) == outside);
        }
    }
    on_label + 1 >= edges
}

/// Where each vertex lies. Sides are numbered through over all loops.
fn places(mesh: &QuadMesh) -> Vec<Place> {
    let mut sharp = vec![false; mesh.vertex_count()];
    mesh.marks().iter().filter(|mark| mark.sharp).for_each(|mark| sharp[mark.vertex.index()] = true);
    let mut places = vec![Place::Inside; mesh.vertex_count()];
    let mut first_side = 0;
    for darts in mesh.loops() {
        let vertices: Vec<VertexId> = darts.iter().map(|&d| mesh.origin(d)).collect();
        let marked = vertices.iter().filter(|v| sharp[v.index()]).count() as u32;
        let Some(start) = vertices.iter().position(|v| sharp[v.index()]) else {
            vertices.iter().for_each(|v| places[v.index()] = Place::Loop);
            continue;
        };
        let mut side = marked - 1;
        for v in vertices[start..].iter().chain(&vertices[..start]) {
            let before = side;
            if sharp[v.index()] {
                side = (side + 1) % marked;
            }
            places[v.index()] = Place::Sides(first_side + before, first_side + side);
        }
        first_side += marked;
    }
    places
}

/// True if some vertex carries two sharp corners of the domain, so that a side of it has vanished.
fn has_merged_corners(mesh: &QuadMesh) -> bool {
    let mut carriers: Vec<VertexId> = mesh.marks().iter().filter(|m| m.sharp).map(|m| m.vertex).collect();
    carriers.sort_unstable();
    carriers.windows(2).any(|pair| pair[0] == pair[1])
}
