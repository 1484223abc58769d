//! Subdivision of a strip into parallel ones, to keep a boundary long enough (docs/reference/grammar.md §4.2).

use super::ids::{DartId, StripId, VertexId};
use super::quad_mesh::{Dart, Left, QuadMesh};
use super::strips;

/// The parts of the subdivided darts.
#[derive(Clone, Debug)]
pub struct Parts {
    n: usize,
    /// For each old dart, in how far it was subdivided: index of its further parts in `further`.
    further: Vec<Option<u32>>,
    parts: Vec<DartId>,
}

impl Parts {
    /// All parts of an old dart, in its direction; the dart itself if it was not subdivided.
    pub fn of(&self, d: DartId) -> impl Iterator<Item = DartId> + '_ {
        let further = match self.further.get(d.index()) {
            Some(&Some(start)) => &self.parts[start as usize..start as usize + self.n - 1],
            _ => &[],
        };
        std::iter::once(d).chain(further.iter().copied())
    }

    fn nth(&self, d: DartId, k: usize) -> DartId {
        self.of(d).nth(k).unwrap_or(d)
    }
}

/// Puts `n − 1` vertices on each edge of `strip` and splits its faces: `n` in a row, `n × n` where it crosses
/// itself. The first part of every old dart keeps the dart's number; one part of the strip keeps its label.
pub fn subdivide(mesh: &mut QuadMesh, strip: StripId, n: usize) -> Parts {
    let faces: Vec<DartId> =
        mesh.face_darts().into_iter().filter(|&d| mesh.along(d).any(|e| mesh.strip(e) == strip)).collect();
    let inside: Vec<bool> = mesh.darts.iter().map(|dart| dart.strip == strip).collect();
    let old_next: Vec<DartId> = mesh.darts.iter().map(|dart| dart.next).collect();
    let parts = split_edges(mesh, strip, n);
    for first in faces {
        Grid::new(mesh, &parts, &old_next, &inside, first, n).fill(mesh);
    }
    // The parts still share one label: all but the first along any one edge take new ones.
    if let Some(d) = inside.iter().position(|&inside| inside) {
        for k in 1..n {
            let label = mesh.push_strip();
            strips::relabel(mesh, parts.nth(DartId(d as u32), k), label);
        }
    }
    parts
}

/// Splits every edge of the strip in `n` equal parts.
fn split_edges(mesh: &mut QuadMesh, strip: StripId, n: usize) -> Parts {
    let old = mesh.darts.len();
    let mut parts = Parts { n, further: vec![None; old], parts: Vec::new() };
    for d in (0..old as u32).map(DartId) {
        let twin = mesh.twin(d);
        if mesh.strip(d) != strip || parts.further[d.index()].is_some() {
            continue;
        }
        let (from, to) = (mesh.position(mesh.origin(d)), mesh.position(mesh.origin(twin)));
        let (left, right) = (mesh.left(d), mesh.left(twin));
        let vertices: Vec<VertexId> =
            (1..n).map(|k| mesh.push_vertex(between(from, to, k as f64 / n as f64))).collect();
        // From w(k) on: the new dart forward to w(k+1), twin of the new dart that goes on from w(k+1) back, save
        // that the last one is the twin of the old twin, and the old dart the twin of the last new one.
        let forward: Vec<DartId> = (1..n).map(|k| push_dart(mesh, vertices[k - 1], left, strip)).collect();
        let backward: Vec<DartId> =
            (1..n).map(|k| push_dart(mesh, vertices[n - 1 - k], right, strip)).collect();
        let chain: Vec<DartId> = std::iter::once(d).chain(forward.iter().copied()).collect();
        let twins: Vec<DartId> = std::iter::once(twin).chain(backward.iter().copied()).collect();
        for k in 0..n {
            mesh.at(chain[k]).twin = twins[n - 1 - k];
            mesh.at(twins[n - 1 - k]).twin = chain[k];
        }
        for run in [chain, twins] {
            let (first, last) = (run[0], run[n - 1]);
            let following = mesh.next(first);
            run.windows(2).for_each(|pair| mesh.link(pair[0], pair[1]));
            mesh.link(last, following);
        }
        for (dart, further) in [(d, forward), (twin, backward)] {
            parts.further[dart.index()] = Some(parts.parts.len() as u32);
            parts.parts.extend(further);
        }
    }
    parts
}

fn push_dart(mesh: &mut QuadMesh, origin: VertexId, left: Left, strip: StripId) -> DartId {
    let d = DartId(mesh.darts.len() as u32);
    let dart = Dart { next: d, prev: d, twin: d, origin, left, strip, pole: false, frozen: false };
    mesh.darts.push(dart);
    d
}

fn between(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 3] {
    std::array::from_fn(|i| a[i] * (1.0 - t) + b[i] * t)
}

/// A subdivided face as a grid of cells, `columns × rows`: sides in order bottom (left to right), right (upwards),
/// top (right to left) and left (downwards). A pseudo-quad `[p, p, a, b]` has its zero-length edge at the bottom.
struct Grid {
    columns: usize,
    rows: usize,
    /// Darts of the sides, along the face; none at the bottom of a pseudo-quad.
    bottom: Vec<DartId>,
    right: Vec<DartId>,
    top: Vec<DartId>,
    left: Vec<DartId>,
    /// Labels of the inner edges: rows run like the bottom, columns like the right side.
    row_label: StripId,
    column_label: StripId,
}

impl Grid {
    fn new(
        mesh: &QuadMesh,
        parts: &Parts,
        old_next: &[DartId],
        inside: &[bool],
        first: DartId,
        n: usize,
    ) -> Self {
        let next = |d: DartId| old_next[d.index()];
        let run = |d: DartId| parts.of(d).collect::<Vec<_>>();
        let count = |d: DartId| if inside[d.index()] { n } else { 1 };
        // `first` leaves the pole corner of a pseudo-quad: it is the right side, and there is no bottom.
        let pole = mesh.dart(first).pole;
        let right = if pole { first } else { next(first) };
        let (top, left) = (next(right), next(next(right)));
        Self {
            columns: count(top),
            rows: count(right),
            bottom: if pole { Vec::new() } else { run(first) },
            right: run(right),
            top: run(top),
            left: run(left),
            row_label: mesh.strip(top),
            column_label: mesh.strip(right),
        }
    }

    fn fill(&self, mesh: &mut QuadMesh) {
        let points = self.points(mesh);
        let point = |column: usize, row: usize| points[row * (self.columns + 1) + column];
        let Some(face) = mesh.left(self.right[0]).as_face() else { return };
        let pole = self.bottom.is_empty();
        mesh.at(self.right[0]).pole = false;
        // `below[c]`: the dart that runs to the right under cell `c` of the row at hand.
        let mut below: Vec<Option<DartId>> =
            if pole { vec![None; self.columns] } else { self.bottom.iter().map(|&d| Some(d)).collect() };
        for row in 0..self.rows {
            let mut left_side = self.left[self.rows - 1 - row];
            for (column, below) in below.iter_mut().enumerate() {
                let first_cell = row == 0 && column == 0;
                let cell = Left::face(if first_cell { face } else { mesh.push_face() });
                let (right_side, next_left) = if column + 1 == self.columns {
                    (self.right[row], left_side)
                } else {
                    let (lower, upper) = (point(column + 1, row), point(column + 1, row + 1));
                    mesh.push_edge((lower, cell), (upper, cell), self.column_label)
                };
                let (above_left, next_below) = if row + 1 == self.rows {
                    (self.top[self.columns - 1 - column], None)
                } else {
                    let (from, to) = (point(column + 1, row + 1), point(column, row + 1));
                    let (leftwards, rightwards) = mesh.push_edge((from, cell), (to, cell), self.row_label);
                    (leftwards, Some(rightwards))
                };
                let cycle: Vec<DartId> =
                    below.iter().copied().chain([right_side, above_left, left_side]).collect();
                for (k, &d) in cycle.iter().enumerate() {
                    mesh.link(d, cycle[(k + 1) % cycle.len()]);
                    mesh.at(d).left = cell;
                }
                mesh.at(right_side).pole = pole && row == 0;
                *below = next_below;
                left_side = next_left;
            }
        }
    }

    /// The vertices of the grid, row by row from the bottom; inner ones are made.
    fn points(&self, mesh: &mut QuadMesh) -> Vec<VertexId> {
        let (columns, rows) = (self.columns, self.rows);
        let pole = mesh.origin(self.right[0]);
        let mut points = Vec::with_capacity((columns + 1) * (rows + 1));
        for row in 0..=rows {
            for column in 0..=columns {
                points.push(if row == 0 {
                    self.bottom.get(column).map_or(pole, |&d| mesh.origin(d))
                } else if row == rows {
                    if column == 0 {
                        mesh.origin(self.left[0])
                    } else {
                        mesh.origin(self.top[columns - column])
                    }
                } else if column == 0 {
                    mesh.origin(self.left[rows - row])
                } else if column == columns {
                    mesh.origin(self.right[row])
                } else {
                    let (a, b) = (mesh.origin(self.left[rows - row]), mesh.origin(self.right[row]));
                    let (a, b) = (mesh.position(a), mesh.position(b));
                    mesh.push_vertex(between(a, b, column as f64 / columns as f64))
                });
            }
        }
        points
    }
}
