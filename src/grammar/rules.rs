//! The two sets of rules, and why a token can be skipped (docs/reference/grammar.md §2.6).

use serde::{Deserialize, Serialize};

use crate::mesh::unzip::Inapplicable;
use crate::mesh::validate::Invalid;
use crate::mesh::{DartId, QuadMesh, VertexId};

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
    /// The strip would end in a pole, and none may (`search.poles`).
    #[error("no poles")]
    NoPoles,
    /// What is frozen (`search.frozen`) would be touched.
    #[error("frozen")]
    Frozen,
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

/// Whether a deletion on a part of a symmetric mesh leaves every seam: one that shrinks to a point has its ends merged.
///
/// # Errors
/// [`Skip::CornersMerged`].
pub fn keep_seams(before: &QuadMesh, after: &QuadMesh) -> Result<(), Skip> {
    let seam_ends =
        |mesh: &QuadMesh| mesh.darts().filter(|&d| mesh.is_outside(d) && mesh.is_seam_end(d)).count();
    if before.is_folded() && seam_ends(before) != seam_ends(after) {
        Err(Skip::CornersMerged)
    } else {
        Ok(())
    }
}

/// Whether a rule has left the frozen faces as they were.
///
/// # Errors
/// [`Skip::Frozen`].
pub fn keep_frozen(before: &QuadMesh, after: &QuadMesh) -> Result<(), Skip> {
    if before.frozen() == after.frozen() { Ok(()) } else { Err(Skip::Frozen) }
}

/// Number of *flat* faces: all vertices of the face lie on one side of the domain, or all but one of its edges (or
/// all of them) on one and the same boundary loop that has no marks. Marks that are not sharp do not count. On a part of a symmetric
/// mesh a seam is a side, and walls are sides or not as in the whole: a seam's end is no mark of a loop.
pub fn count_flat_faces(mesh: &QuadMesh) -> usize {
    let has_marks = loops_with_marks(mesh);
    let sides = sides(mesh, &has_marks);
    let is_on = |v: VertexId, side: u32| sides[v.index()].contains(&side);
    let lies_on_one_side = |first: DartId| {
        let mut candidates = sides[mesh.origin(first).index()].into_iter().filter(|&side| side != NO_SIDE);
        candidates.any(|side| mesh.along(first).all(|d| is_on(mesh.origin(d), side)))
    };
    let is_flat = |&first: &DartId| lies_on_one_loop(mesh, first, &has_marks) || lies_on_one_side(first);
    mesh.face_darts().iter().filter(|first| is_flat(first)).count()
}

fn lies_on_one_loop(mesh: &QuadMesh, first: DartId, has_marks: &[bool]) -> bool {
    let (mut edges, mut label, mut on_label) = (0, None, 0);
    for d in mesh.along(first) {
        edges += 1;
        let outside = mesh.left(mesh.twin(d)).as_loop();
        if let Some(outside) = outside.filter(|&outside| !has_marks[outside as usize]) {
            on_label += u32::from(*label.get_or_insert(outside) == outside);
        }
    }
    on_label + 1 >= edges
}

/// For each loop, whether it carries a sharp mark of the domain.
fn loops_with_marks(mesh: &QuadMesh) -> Vec<bool> {
    let mut is_marked = vec![false; mesh.vertex_count()];
    mesh.marks()
        .iter()
        .filter(|mark| mark.sharp && (mark.corner as usize) < mesh.domain_corner_count())
        .for_each(|mark| is_marked[mark.vertex.index()] = true);
    let mut has_marks = vec![false; mesh.loop_count()];
    for d in mesh.darts() {
        if let Some(label) = mesh.left(d).as_loop() {
            has_marks[label as usize] |= is_marked[mesh.origin(d).index()] || is_marked[mesh.end(d).index()];
        }
    }
    has_marks
}

/// No side of the domain: inside, or a loop without marks.
const NO_SIDE: u32 = u32::MAX;

/// The two sides that each vertex lies on; the same one twice unless it carries a mark. They are numbered through over all loops.
fn sides(mesh: &QuadMesh, has_marks: &[bool]) -> Vec<[u32; 2]> {
    let mut sharp = vec![false; mesh.vertex_count()];
    mesh.marks().iter().filter(|mark| mark.sharp).for_each(|mark| sharp[mark.vertex.index()] = true);
    let mut sides = vec![[NO_SIDE; 2]; mesh.vertex_count()];
    let mut fresh = 0;
    for darts in mesh.loops() {
        let Some(start) = darts.iter().position(|&d| sharp[mesh.origin(d).index()]) else { continue };
        let mut side = NO_SIDE;
        for &d in darts[start..].iter().chain(&darts[..=start]) {
            let v = mesh.origin(d).index();
            let before = side;
            if sharp[v] {
                let is_side = mesh.left(d).as_loop().is_none_or(|label| has_marks[label as usize]);
                side = if is_side { fresh } else { NO_SIDE };
                fresh += 1;
            }
            // The first vertex comes again at the end, where what is before it is known.
            sides[v] = if sides[v] == [NO_SIDE; 2] { [before, side] } else { [before, sides[v][1]] };
        }
    }
    sides
}

/// True if some vertex carries two sharp corners of the domain, so that a side of it has vanished.
fn has_merged_corners(mesh: &QuadMesh) -> bool {
    let mut carriers: Vec<VertexId> = mesh.marks().iter().filter(|m| m.sharp).map(|m| m.vertex).collect();
    carriers.sort_unstable();
    carriers.windows(2).any(|pair| pair[0] == pair[1])
}
