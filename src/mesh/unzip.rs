//! Strip addition: unzipping the mesh along a polyedge (docs/reference/grammar.md §3).
//!
//! Two steps make all of it. *Opening* an edge puts a 2-gon between its two darts, so that each stays with the face
//! on its own left. *Splitting* a vertex at two of its corners puts a transverse edge across the faces of these
//! corners: the 2-gon just opened becomes a triangle, the one behind it (the front of the strip) a quad. Both keep
//! the map a map and its Euler characteristic, so vertices and edges of the path may repeat at will; only
//! "at most one edge joins two vertices" (V2) can come out wrong.

use super::ids::{DartId, StripId, VertexId};
use super::quad_mesh::{Left, Mark, QuadMesh};

/// How a new strip runs.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Course {
    /// From its start to its end.
    Open([End; 2]),
    /// Back to its start.
    Closed,
}

/// How a strip ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum End {
    /// In a pole.
    Pole,
    /// On the boundary; at the end of a seam, coming from inside, on the wall (of two seams on the earlier fold's).
    Regular,
    /// At the end of a seam, coming from inside: on the seam (of two on the later fold's).
    OnSeam,
}

/// Why a polyedge cannot be unzipped.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Inapplicable {
    /// The polyedge has no edge.
    #[error("empty path")]
    EmptyPath,
    /// A closed strip was asked for, but the polyedge does not end where it starts.
    #[error("not closed")]
    NotClosed,
    /// A regular start inside.
    #[error("start not on boundary")]
    StartNotOnBoundary,
    /// A regular end inside.
    #[error("end not on boundary")]
    EndNotOnBoundary,
    /// One edge with a pole at either end.
    #[error("two poles on one edge")]
    TwoPolesOnOneEdge,
}

/// Whether a strip of this course can be added along `path`; the V2 check comes after.
///
/// # Errors
/// The reason why not.
pub fn applicable(mesh: &QuadMesh, path: &[DartId], course: Course) -> Result<(), Inapplicable> {
    let (Some(&first), Some(&last)) = (path.first(), path.last()) else {
        return Err(Inapplicable::EmptyPath);
    };
    match course {
        Course::Closed if mesh.origin(first) != mesh.end(last) => Err(Inapplicable::NotClosed),
        Course::Closed => Ok(()),
        Course::Open([End::Pole, End::Pole]) if path.len() == 1 => Err(Inapplicable::TwoPolesOnOneEdge),
        Course::Open([start, end]) => {
            let gap_at_start = mesh.gap(first);
            let gap_at_end = mesh.gap(mesh.next(last));
            // `°` on an end says something only where a path comes from inside to the end of a seam; else it asks for a closed strip.
            let is_told = |end: End, gap: Option<DartId>, edge: DartId| {
                end != End::OnSeam
                    || gap.is_some_and(|gap| mesh.is_seam_end(gap)) && boundary_of(mesh, edge).is_none()
            };
            if start != End::Pole && gap_at_start.is_none() {
                Err(Inapplicable::StartNotOnBoundary)
            } else if end != End::Pole && gap_at_end.is_none() {
                Err(Inapplicable::EndNotOnBoundary)
            } else if !is_told(start, gap_at_start, first) || !is_told(end, gap_at_end, last) {
                Err(Inapplicable::NotClosed)
            } else {
                Ok(())
            }
        }
    }
}

/// What is outside of a boundary edge: a loop or a seam. `None` of an inner edge.
fn boundary_of(mesh: &QuadMesh, d: DartId) -> Option<Left> {
    [d, mesh.twin(d)].into_iter().map(|d| mesh.left(d)).find(|left| left.is_outside())
}

/// Adds a strip along `path`, which must be [`applicable`], and gives its label.
///
/// Every dart keeps its identity: it stays with the face on its left.
/// The result breaks no condition but possibly V2, which the caller checks.
pub fn unzip(mesh: &mut QuadMesh, path: &[DartId], course: Course) -> StripId {
    let strip = mesh.push_strip();
    let mut zipper = Zipper { mesh, path: path.to_vec(), strip, course, arrival: None };
    zipper.run();
    strip
}

/// What tells which side of a seam's end the new edge at the end of a strip lies on.
#[derive(Clone, Copy)]
struct Arrival {
    end: End,
    /// What is outside of the path's edge there; `None` if it comes from inside.
    along: Option<Left>,
}

impl Arrival {
    /// Whether the new edge goes on what lies before the seam's end, in the direction of the outside darts, not on what lies after.
    /// From the wall it goes on the seam, from the seam on the wall, so that the new strip lies along what the path lay along.
    fn is_before(self, before: Left, after: Left) -> bool {
        match self.along {
            Some(along) => along == after,
            None => (before > after) == (self.end == End::OnSeam),
        }
    }
}

struct Zipper<'a> {
    mesh: &'a mut QuadMesh,
    /// What is left to unzip, kept a path of darts that meet.
    path: Vec<DartId>,
    strip: StripId,
    course: Course,
    /// While a regular end is split: how the path comes to it.
    arrival: Option<Arrival>,
}

impl Zipper<'_> {
    fn run(&mut self) {
        // What is outside of the edge opened last.
        let mut along = None;
        let (mut front, stop) = match self.course {
            Course::Closed => {
                // The last edge opens at its end V0 too; the triangle there is closed by the last step.
                let last = self.path.len() - 1;
                let (to_start, from_start) = self.open(self.path[last]);
                self.path[last] = to_start;
                (self.split_start(Some(from_start)), 1)
            }
            Course::Open([End::Pole, _]) => {
                along = boundary_of(self.mesh, self.path[0]);
                let (leaving, front) = self.open(self.path[0]);
                self.mesh.at(leaving).pole = true;
                (front, 0)
            }
            Course::Open([end, _]) => {
                along = boundary_of(self.mesh, self.path[0]);
                self.arrival = Some(Arrival { end, along });
                let gap = self.mesh.gap(self.path[0]);
                (self.split_start(gap), 0)
            }
        };
        self.arrival = None;
        let mut i = 1;
        while i + stop < self.path.len() {
            along = boundary_of(self.mesh, self.path[i]);
            let (opened, next_front) = self.open(self.path[i]);
            self.split(opened, front, i);
            front = next_front;
            i += 1;
        }
        match self.course {
            Course::Closed => self.split(self.path[i], front, i),
            Course::Open([_, End::Pole]) => self.mesh.at(front).pole = true,
            Course::Open([_, end]) => {
                if let Some(gap) = self.mesh.gap(front) {
                    self.arrival = Some(Arrival { end, along });
                    self.split(gap, front, i);
                }
            }
        }
    }

    /// Opens the first edge and splits its start between it and the corner `behind` (boundary gap, or the triangle
    /// on the last edge of a closed path). Gives the front.
    fn split_start(&mut self, behind: Option<DartId>) -> DartId {
        let (opened, front) = self.open(self.path[0]);
        if let Some(behind) = behind {
            self.split(opened, behind, 0);
        }
        front
    }

    /// Puts a 2-gon between `d = (u, v)` and its twin. Gives its darts `u → v` and `v → u`.
    fn open(&mut self, d: DartId) -> (DartId, DartId) {
        let mesh = &mut *self.mesh;
        let twin = mesh.twin(d);
        let (u, v, strip) = (mesh.origin(d), mesh.origin(twin), mesh.strip(d));
        let face = Left::face(mesh.push_face());
        let (uv, vu) = mesh.push_edge((u, face), (v, face), strip);
        mesh.link(uv, vu);
        mesh.link(vu, uv);
        mesh.at(uv).twin = twin;
        mesh.at(twin).twin = uv;
        mesh.at(vu).twin = d;
        mesh.at(d).twin = vu;
        (uv, vu)
    }

    /// Splits the common origin of `ahead` and `behind` at the corners to the left of these two darts, with a
    /// transverse edge across them. The darts counter-clockwise after `ahead` up to `behind` go to the left copy.
    /// `i` is the step: the path from there on is mended.
    fn split(&mut self, ahead: DartId, behind: DartId, i: usize) {
        let mesh = &mut *self.mesh;
        let right = mesh.origin(ahead);
        let left = mesh.push_vertex(mesh.position(right));
        let mut left_has_gap = mesh.is_outside(ahead);
        let mut d = ahead;
        while d != behind {
            d = mesh.counter_clockwise(d);
            mesh.at(d).origin = left;
            left_has_gap |= mesh.is_outside(d);
        }
        let (before_ahead, before_behind) = (mesh.prev(ahead), mesh.prev(behind));
        let (to_right, to_left) =
            mesh.push_edge((left, mesh.left(ahead)), (right, mesh.left(behind)), self.strip);
        mesh.link(before_ahead, to_right);
        mesh.link(to_right, ahead);
        mesh.link(before_behind, to_left);
        mesh.link(to_left, behind);

        let new_outside = [to_right, to_left].into_iter().find(|&d| mesh.is_outside(d));
        let carrier = match new_outside {
            Some(d) => self.settle(d),
            None if left_has_gap => left,
            None => right,
        };
        if carrier == left {
            move_marks(&mut self.mesh.marks, right, left);
        }
        self.mend_path(i, to_right, to_left);
    }

    /// Of copies that both lie on the boundary, joined by this outside dart, the first in the direction of the outside darts takes the
    /// marks; at the end of a seam the one where, as the path comes, the seam ends now.
    fn settle(&mut self, d: DartId) -> VertexId {
        let mesh = &mut *self.mesh;
        let (before, after) = (mesh.left(mesh.prev(d)), mesh.left(mesh.next(d)));
        let is_before =
            before != after && self.arrival.is_some_and(|arrival| arrival.is_before(before, after));
        mesh.at(d).left = if is_before { before } else { after };
        if is_before { mesh.end(d) } else { mesh.origin(d) }
    }

    /// Inserts the transverse dart wherever two consecutive darts no longer meet, and at the end of an open path
    /// whose boundary gap went to the other copy.
    fn mend_path(&mut self, i: usize, to_right: DartId, to_left: DartId) {
        let mesh = &*self.mesh;
        let (left, right) = (mesh.origin(to_right), mesh.origin(to_left));
        let from = |v: VertexId| if v == left { to_right } else { to_left };
        let mut j = i + 1;
        while j + 1 < self.path.len() {
            let (end, start) = (mesh.end(self.path[j]), mesh.origin(self.path[j + 1]));
            if end != start {
                self.path.insert(j + 1, from(end));
                j += 1;
            }
            j += 1;
        }
        if let (Course::Open([_, End::Regular | End::OnSeam]), Some(&last)) = (self.course, self.path.last())
            && i < self.path.len()
        {
            let end = mesh.end(last);
            if (end == left || end == right) && mesh.gap(mesh.next(last)).is_none() {
                self.path.push(from(end));
            }
        }
    }
}

fn move_marks(marks: &mut [Mark], from: VertexId, to: VertexId) {
    if marks.iter().any(|mark| mark.vertex == from) {
        for mark in marks.iter_mut().filter(|mark| mark.vertex == from) {
            mark.vertex = to;
        }
        marks.sort_unstable();
    }
}
