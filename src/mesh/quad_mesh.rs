//! The coarse quad mesh as a map of darts, and how to walk on it (docs/reference/grammar.md §1).
//!
//! A *dart* is a directed edge. `next` goes on around the face on its left (or around the boundary loop, for an
//! *outside* dart, which has no face there), `twin` is the same edge seen from the other side. These two
//! permutations are the whole topology; a vertex is an orbit of `rotate = next ∘ twin`, a face or a boundary loop
//! an orbit of `next`.
//!
//! Invariants (all checked by [`validate`](super::validate::check)):
//! `twin` has no fixed point and is its own inverse; `prev` is the inverse of `next`; the origin of `next(d)` is
//! the origin of `twin(d)`; both darts of an edge carry the same strip label; the darts of a face have the same
//! `left`; in a pseudo-quad exactly one dart, the one leaving the pole corner, has `pole` set; vertices, faces and
//! loops are numbered densely from 0.

use super::ids::{DartId, FaceId, StripId, VertexId};

/// What lies on the left of a dart: a face, the outside with the label of its boundary loop, or, in a part of a symmetric mesh, the
/// seam along which it goes on in its image ([`fold`](super::fold)).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Left(u32);

const OUTSIDE: u32 = 1 << 31;
const SEAM: u32 = 1 << 30;

impl Left {
    /// A face.
    pub fn face(face: FaceId) -> Self {
        Self(face.0)
    }

    /// No face: the boundary loop with this label.
    pub fn outside(label: u32) -> Self {
        Self(OUTSIDE | label)
    }

    /// No face here: a seam of this fold, counted from the first.
    pub fn seam(fold: u32) -> Self {
        Self(OUTSIDE | SEAM | fold)
    }

    /// True where there is no face.
    pub fn is_outside(self) -> bool {
        self.0 & OUTSIDE != 0
    }

    /// The face, if there is one.
    pub fn as_face(self) -> Option<FaceId> {
        (!self.is_outside()).then_some(FaceId(self.0))
    }

    /// The label of the boundary loop, on an outside dart that is not on a seam.
    pub fn as_loop(self) -> Option<u32> {
        (self.0 & (OUTSIDE | SEAM) == OUTSIDE).then_some(self.0 & !OUTSIDE)
    }

    /// The fold whose seam it is.
    pub fn as_seam(self) -> Option<u32> {
        (self.is_outside() && self.0 & SEAM != 0).then_some(self.0 & !(OUTSIDE | SEAM))
    }
}

/// One dart. Plain data: the edits in this folder write it, everyone else reads it through [`QuadMesh`].
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Dart {
    /// The next dart around the face or boundary loop on the left.
    pub next: DartId,
    /// The one before.
    pub prev: DartId,
    /// The same edge the other way.
    pub twin: DartId,
    /// The vertex it leaves.
    pub origin: VertexId,
    /// The face or boundary loop on its left.
    pub left: Left,
    /// Label of the strip that the edge belongs to.
    pub strip: StripId,
    /// True if it leaves the pole corner of the pseudo-quad on its left.
    pub pole: bool,
    /// True if the face on its left is one that no rule may touch.
    pub frozen: bool,
}

/// Corner `corner` of the domain is at `vertex`.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Mark {
    /// Number of the corner.
    pub corner: u32,
    /// The boundary vertex that carries it.
    pub vertex: VertexId,
    /// False for the mark of a domain without corners, which is no kink (docs/reference/geometry.md §0.4).
    pub sharp: bool,
}

/// A coarse quad mesh. Vertex, face and dart numbers mean nothing; loop labels, corner marks and strip labels do.
///
/// Positions and marks are carried along; no rule looks at a position.
#[derive(Clone, Debug, Default)]
pub struct QuadMesh {
    pub(super) darts: Vec<Dart>,
    pub(super) positions: Vec<[f64; 3]>,
    pub(super) marks: Vec<Mark>,
    pub(super) corner_count: u32,
    pub(super) face_count: u32,
    pub(super) loop_count: u32,
    pub(super) next_strip: u32,
    /// In a part of a symmetric mesh, by loop label: how many images an edge of the loop has in the loop of the whole mesh, itself
    /// included; 0 for a loop that is the image of another. Empty in a whole mesh, where all are 1.
    pub(super) images: Vec<u32>,
    /// In such a part: corners from this number on are ends of seams.
    pub(super) domain_corners: u32,
}

impl QuadMesh {
    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// Number of edges.
    pub fn edge_count(&self) -> usize {
        self.darts.len() / 2
    }

    /// Number of faces.
    pub fn face_count(&self) -> usize {
        self.face_count as usize
    }

    /// Number of boundary loops, labelled `0..loop_count`.
    pub fn loop_count(&self) -> usize {
        self.loop_count as usize
    }

    /// Number of corners: those of the domain and, in a part of a symmetric mesh, the ends of seams.
    pub fn corner_count(&self) -> usize {
        self.corner_count as usize
    }

    /// Number of corners of the domain, without the ends of seams.
    pub fn domain_corner_count(&self) -> usize {
        if self.is_folded() { self.domain_corners as usize } else { self.corner_count() }
    }

    /// V − E + F.
    pub fn euler_characteristic(&self) -> i64 {
        self.vertex_count() as i64 - self.edge_count() as i64 + self.face_count() as i64
    }

    /// All darts, outside ones included.
    pub fn darts(&self) -> impl ExactSizeIterator<Item = DartId> + use<> {
        (0..self.darts.len() as u32).map(DartId)
    }

    /// All that is known of one dart.
    pub fn dart(&self, d: DartId) -> &Dart {
        &self.darts[d.index()]
    }

    /// The next dart around the face or boundary loop on the left: the marker's turn.
    pub fn next(&self, d: DartId) -> DartId {
        self.darts[d.index()].next
    }

    /// The dart before `d` around the face or boundary loop on the left.
    pub fn prev(&self, d: DartId) -> DartId {
        self.darts[d.index()].prev
    }

    /// The same edge the other way.
    pub fn twin(&self, d: DartId) -> DartId {
        self.darts[d.index()].twin
    }

    /// The next dart clockwise about the origin: the marker's pivot.
    pub fn clockwise(&self, d: DartId) -> DartId {
        self.next(self.twin(d))
    }

    /// The next dart counter-clockwise about the origin.
    pub fn counter_clockwise(&self, d: DartId) -> DartId {
        self.twin(self.prev(d))
    }

    /// The vertex a dart leaves.
    pub fn origin(&self, d: DartId) -> VertexId {
        self.darts[d.index()].origin
    }

    /// The vertex a dart goes to.
    pub fn end(&self, d: DartId) -> VertexId {
        self.origin(self.next(d))
    }

    /// The face or boundary loop on the left.
    pub fn left(&self, d: DartId) -> Left {
        self.darts[d.index()].left
    }

    /// True if a dart has no face on its left.
    pub fn is_outside(&self, d: DartId) -> bool {
        self.left(d).is_outside()
    }

    /// The strip that the edge of a dart belongs to.
    pub fn strip(&self, d: DartId) -> StripId {
        self.darts[d.index()].strip
    }

    /// All darts that leave the origin of `d`, from `d` on, clockwise.
    pub fn around(&self, d: DartId) -> impl Iterator<Item = DartId> + '_ {
        cycle(d, move |e| self.clockwise(e))
    }

    /// All darts of the face or boundary loop on the left of `d`, from `d` on.
    pub fn along(&self, d: DartId) -> impl Iterator<Item = DartId> + '_ {
        cycle(d, move |e| self.next(e))
    }

    /// The outside dart that leaves the origin of `d`, if that is on the boundary.
    pub fn gap(&self, d: DartId) -> Option<DartId> {
        self.around(d).find(|&e| self.is_outside(e))
    }

    /// The dart across the face on the left of `d` (docs/reference/grammar.md §1): `None` where that is the edge `(p, p)` of a
    /// pole, and on an outside dart.
    pub fn opposite(&self, d: DartId) -> Option<DartId> {
        let next = self.next(d);
        if self.is_outside(d) {
            None
        } else if self.dart(d).pole {
            Some(self.prev(d))
        } else if self.dart(next).pole {
            Some(next)
        } else if self.dart(self.next(next)).pole {
            None
        } else {
            Some(self.next(next))
        }
    }

    /// Whether it is a part of a symmetric mesh, with seams along which it goes on.
    pub fn is_folded(&self) -> bool {
        !self.images.is_empty()
    }

    /// How many images an edge of a boundary loop has in that loop of the whole mesh, itself included: 1 in a whole mesh, 0 where the
    /// loop is itself the image of another.
    pub fn images_in_loop(&self, label: u32) -> usize {
        self.images.get(label as usize).map_or(1, |&images| images as usize)
    }

    /// For each loop label the darts of that loop, without those of seams.
    pub fn walls(&self) -> Vec<Vec<DartId>> {
        let mut walls = vec![Vec::new(); self.loop_count()];
        for d in self.darts() {
            if let Some(label) = self.left(d).as_loop() {
                walls[label as usize].push(d);
            }
        }
        walls
    }

    /// Whether a boundary vertex, given by the outside dart that leaves it, is the end of a seam.
    pub fn is_seam_end(&self, gap: DartId) -> bool {
        self.left(gap) != self.left(self.prev(gap))
    }

    /// For each vertex, whether some face has its pole there.
    pub fn pole_vertices(&self) -> Vec<bool> {
        let mut poles = vec![false; self.vertex_count()];
        for dart in self.darts.iter().filter(|dart| dart.pole) {
            poles[dart.origin.index()] = true;
        }
        poles
    }

    /// For each vertex, whether it lies on the boundary.
    pub fn boundary_vertices(&self) -> Vec<bool> {
        let mut boundary = vec![false; self.vertex_count()];
        for dart in self.darts.iter().filter(|dart| dart.left.is_outside()) {
            boundary[dart.origin.index()] = true;
        }
        boundary
    }

    /// For each vertex, its number of edges.
    pub fn valences(&self) -> Vec<usize> {
        let mut valences = vec![0; self.vertex_count()];
        for dart in &self.darts {
            valences[dart.origin.index()] += 1;
        }
        valences
    }

    /// One dart of each face, in face order: the one leaving the pole in a pseudo-quad, else the lowest numbered.
    pub fn face_darts(&self) -> Vec<DartId> {
        let mut first: Vec<Option<DartId>> = vec![None; self.face_count()];
        for d in self.darts() {
            if let Some(face) = self.left(d).as_face() {
                let slot = &mut first[face.index()];
                if slot.is_none() || self.dart(d).pole {
                    *slot = Some(d);
                }
            }
        }
        first.into_iter().flatten().collect()
    }

    /// Each boundary loop as its outside darts, in label order, from the lowest numbered dart on. In a part of a symmetric mesh a loop
    /// goes round over walls and seams, and comes once, under the lowest of its labels; the others are empty.
    pub fn loops(&self) -> Vec<Vec<DartId>> {
        let mut loops = vec![Vec::new(); self.loop_count()];
        let mut seen = vec![false; self.darts.len()];
        for (label, darts) in self.walls().into_iter().enumerate() {
            if let Some(&first) = darts.first()
                && !seen[first.index()]
            {
                loops[label] = self.along(first).collect();
                loops[label].iter().for_each(|d| seen[d.index()] = true);
            }
        }
        loops
    }

    /// The marks of the domain's corners, by corner number, then vertex.
    pub fn marks(&self) -> &[Mark] {
        &self.marks
    }

    /// For each corner number, the vertices that carry it.
    pub fn corners(&self) -> Vec<Vec<VertexId>> {
        let mut corners = vec![Vec::new(); self.corner_count()];
        for mark in &self.marks {
            corners[mark.corner as usize].push(mark.vertex);
        }
        corners
    }

    /// Declares a mark to be no kink of the boundary (docs/reference/geometry.md §0.4): it is handed on and coded like any other,
    /// but the domain rules of the grammar do not see it.
    pub fn blunt(&mut self, corner: u32) {
        for mark in self.marks.iter_mut().filter(|mark| mark.corner == corner) {
            mark.sharp = false;
        }
    }

    /// Freezes the faces with these middles (the mean of their vertices, m): no rule may touch them.
    pub fn freeze(&mut self, chosen: impl Fn([f64; 3]) -> bool) {
        for first in self.face_darts() {
            let around: Vec<DartId> = self.along(first).collect();
            let sum = around.iter().map(|&d| self.position(self.origin(d))).fold([0.0; 3], add);
            if chosen(sum.map(|x| x / around.len() as f64)) {
                around.into_iter().for_each(|d| self.at(d).frozen = true);
            }
        }
    }

    /// What is left of the frozen faces: their darts, how many vertices they share among them, and how many darts have their twin
    /// among them. Rules that leave all three alone have not touched them.
    pub fn frozen(&self) -> [usize; 3] {
        let frozen = || self.darts.iter().filter(|dart| dart.frozen);
        let mut is_met = vec![false; self.vertex_count()];
        frozen().for_each(|dart| is_met[dart.origin.index()] = true);
        let inner = frozen().filter(|dart| self.darts[dart.twin.index()].frozen).count();
        [frozen().count(), is_met.into_iter().filter(|&met| met).count(), inner]
    }

    /// Position of a vertex, m: where the rules put it, to draw the coarse mesh. No result depends on it.
    pub fn position(&self, v: VertexId) -> [f64; 3] {
        self.positions[v.index()]
    }

    /// The positions of all vertices, m.
    pub fn positions(&self) -> &[[f64; 3]] {
        &self.positions
    }

    /// The dart from `u` to `v`, if these are adjacent.
    pub fn find_dart(&self, u: VertexId, v: VertexId) -> Option<DartId> {
        self.darts().find(|&d| self.origin(d) == u && self.end(d) == v)
    }

    pub(super) fn at(&mut self, d: DartId) -> &mut Dart {
        &mut self.darts[d.index()]
    }

    /// Makes `b` follow `a` around the face on their left.
    pub(super) fn link(&mut self, a: DartId, b: DartId) {
        self.at(a).next = b;
        self.at(b).prev = a;
    }

    /// Adds the two darts of a new edge, `u → v` with `left_uv` on its left and back, as each other's twins.
    /// `next` and `prev` are for the caller to set.
    pub(super) fn push_edge(
        &mut self,
        (u, left_uv): (VertexId, Left),
        (v, left_vu): (VertexId, Left),
        strip: StripId,
    ) -> (DartId, DartId) {
        let uv = DartId(self.darts.len() as u32);
        let vu = DartId(uv.0 + 1);
        let dart = |twin, origin, left| Dart {
            next: uv,
            prev: uv,
            twin,
            origin,
            left,
            strip,
            pole: false,
            frozen: false,
        };
        self.darts.push(dart(vu, u, left_uv));
        self.darts.push(dart(uv, v, left_vu));
        (uv, vu)
    }

    pub(super) fn push_vertex(&mut self, position: [f64; 3]) -> VertexId {
        self.positions.push(position);
        VertexId(self.positions.len() as u32 - 1)
    }

    pub(super) fn push_face(&mut self) -> FaceId {
        self.face_count += 1;
        FaceId(self.face_count - 1)
    }

    pub(super) fn push_strip(&mut self) -> StripId {
        self.next_strip += 1;
        StripId(self.next_strip - 1)
    }

    /// `clone_from` that keeps the buffers: rules are tried on a copy thousands of times a second.
    pub fn copy_from(&mut self, other: &Self) {
        self.darts.clone_from(&other.darts);
        self.positions.clone_from(&other.positions);
        self.marks.clone_from(&other.marks);
        self.corner_count = other.corner_count;
        self.face_count = other.face_count;
        self.loop_count = other.loop_count;
        self.next_strip = other.next_strip;
        self.images.clone_from(&other.images);
        self.domain_corners = other.domain_corners;
    }
}

fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] + b[i])
}

fn cycle(start: DartId, step: impl Fn(DartId) -> DartId) -> impl Iterator<Item = DartId> {
    let mut following = Some(start);
    std::iter::from_fn(move || {
        let d = following?;
        following = Some(step(d)).filter(|&e| e != start);
        Some(d)
    })
}
