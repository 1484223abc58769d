//! Strips: the maximal chains of opposite edges (docs/reference/grammar.md §1.4), walked on the map.

use super::ids::{DartId, StripId};
use super::quad_mesh::QuadMesh;

/// One strip as it is met on a mesh.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct StripChain {
    /// Its label.
    pub label: StripId,
    /// One dart of each transverse edge, from end to end, all pointing from the left flank to the right one as
    /// seen along the chain: the face crossed next lies on the left of each.
    pub darts: Vec<DartId>,
    /// True for a loop.
    pub closed: bool,
    /// Whether it ends in a pole: behind its first edge, and beyond its last. Both false in a loop.
    pub poles: [bool; 2],
}

impl StripChain {
    /// How many of its ends are poles.
    pub fn pole_count(&self) -> u8 {
        u8::from(self.poles[0]) + u8::from(self.poles[1])
    }
}

/// The strip through the edge of `d`, from its end behind `d` on (from `d` on if it is closed).
pub fn chain(mesh: &QuadMesh, d: DartId) -> StripChain {
    let label = mesh.strip(d);
    let mut darts = Vec::new();
    // Forward from the other side of the edge gives the way back to the first edge.
    let mut first = mesh.twin(d);
    let (mut closed, mut back) = (false, first);
    while let Some(o) = mesh.opposite(back) {
        back = mesh.twin(o);
        if back == mesh.twin(d) {
            closed = true;
            break;
        }
        first = back;
    }
    let start = if closed { d } else { mesh.twin(first) };
    let mut last = start;
    darts.push(start);
    while let Some(o) = mesh.opposite(last) {
        let following = mesh.twin(o);
        if following == start {
            break;
        }
        last = following;
        darts.push(last);
    }
    let poles = if closed { [false; 2] } else { [!mesh.is_outside(first), !mesh.is_outside(last)] };
    StripChain { label, darts, closed, poles }
}

/// All strips, in label order; each begins on the side of its lowest numbered dart.
pub fn all(mesh: &QuadMesh) -> Vec<StripChain> {
    let mut seen = vec![false; mesh.next_strip as usize];
    let mut strips = Vec::new();
    for d in mesh.darts() {
        if !std::mem::replace(&mut seen[mesh.strip(d).index()], true) {
            strips.push(chain(mesh, d));
        }
    }
    strips.sort_by_key(|strip| strip.label);
    strips
}

/// Labels of all strips present, ascending.
pub fn labels(mesh: &QuadMesh) -> Vec<StripId> {
    let mut present = vec![false; mesh.next_strip as usize];
    for dart in &mesh.darts {
        present[dart.strip.index()] = true;
    }
    (0..mesh.next_strip).map(StripId).filter(|label| present[label.index()]).collect()
}

/// Number of edges of a strip.
pub fn edge_count(mesh: &QuadMesh, label: StripId) -> usize {
    mesh.darts.iter().filter(|dart| dart.strip == label).count() / 2
}

/// Collects all strips anew, blind to labels: each edge's strip number by dart, numbered in dart order.
/// What the labels are checked against.
pub fn collect_anew(mesh: &QuadMesh) -> Vec<u32> {
    let mut number = vec![u32::MAX; mesh.darts.len()];
    let mut count = 0;
    for d in mesh.darts() {
        if number[d.index()] == u32::MAX {
            for e in chain(mesh, d).darts {
                number[e.index()] = count;
                number[mesh.twin(e).index()] = count;
            }
            count += 1;
        }
    }
    number
}

/// Gives every edge of the strip through `d` the label `label`.
pub(super) fn relabel(mesh: &mut QuadMesh, d: DartId, label: StripId) {
    for e in chain(mesh, d).darts {
        let twin = mesh.twin(e);
        mesh.at(e).strip = label;
        mesh.at(twin).strip = label;
    }
}
