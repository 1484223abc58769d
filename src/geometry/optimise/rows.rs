//! What the rows of a sheet's strips are measured by and bound to (docs/reference/geometry.md §2.2).

use super::Task;
use super::ground::{Ground, Rail};
use super::sheet::{Held, NO_CORNER, Sheet};
use crate::geometry::coarse::Coarse;
use crate::geometry::density::{Bounds, SideRows};
use crate::geometry::limits::Limits;
use crate::geometry::topology::Available;
use crate::geometry::vector::distance;
use std::borrow::Cow;
use std::f64::consts::TAU;

/// Points of a side at which its curvature is measured.
const SAMPLES: usize = 1024;
/// Length over which it is measured, in target lengths.
const WINDOW: f64 = 0.25;
/// How much finer than its limits a side is to be.
const RESERVE: f64 = 0.9;
/// By how much the smallest angle is exceeded where poles are capped.
const POLE_RESERVE: f64 = 1.05;

/// Lengths of a strip's rungs, local units.
#[derive(Clone, Copy, Debug)]
pub struct Rungs {
    sum: f64,
    count: f64,
    /// The longest.
    pub most: f64,
}

impl Rungs {
    /// Their mean.
    pub fn mean(&self) -> f64 {
        self.sum / self.count
    }

    fn add(&mut self, length: f64) {
        self.sum += length;
        self.count += 1.0;
        self.most = self.most.max(length);
    }
}

/// The rungs of all strips: of every coarse face all rows one way and all columns the other.
pub fn rungs(coarse: &Coarse<'_>, sheet: &Sheet) -> Vec<Rungs> {
    let none = Rungs { sum: 0.0, count: 0.0, most: 0.0 };
    let mut rungs = vec![none; coarse.mesh.strips.len()];
    let between = |u: u32, v: u32| distance(sheet.points[u as usize], sheet.points[v as usize]);
    for (f, &[s, t]) in coarse.mesh.face_strips.iter().enumerate() {
        let grid = sheet.dense.grid(coarse, f);
        let is_pole = coarse.mesh.faces[f][0] == coarse.mesh.faces[f][1];
        for j in usize::from(is_pole)..=grid.m {
            rungs[s as usize].add((0..grid.n).map(|i| between(grid.at(i, j), grid.at(i + 1, j))).sum());
        }
        for i in 0..=grid.n {
            rungs[t as usize].add((0..grid.m).map(|j| between(grid.at(i, j), grid.at(i, j + 1))).sum());
        }
    }
    rungs
}

/// Most rows of each strip: those that end in poles share the room there.
pub fn caps(task: &Task<'_>) -> Vec<u32> {
    let Task { coarse, limits, .. } = *task;
    let available = Available::of(coarse, task.domain, task.corners);
    let mut poles: Vec<Vec<u32>> = vec![Vec::new(); coarse.mesh.vertex_count];
    for (face, strips) in coarse.mesh.faces.iter().zip(&coarse.mesh.face_strips) {
        if face[0] == face[1] {
            poles[face[0] as usize].push(strips[0]);
        }
    }
    let mut caps = vec![u32::MAX; coarse.mesh.strips.len()];
    for (v, strips) in poles.iter().enumerate().filter(|(_, strips)| !strips.is_empty()) {
        let on_boundary = usize::from(coarse.on_loop[v].is_some());
        let others = coarse.vertex_faces[v] as usize - strips.len();
        let by_angle = available.angle(v as u32) / (POLE_RESERVE * limits.min_angle);
        let room = (limits.max_valence.saturating_sub(on_boundary) as f64).min((by_angle + 1e-9).floor());
        let cap =
            ((room - others as f64) / strips.len() as f64).floor().clamp(1.0, f64::from(u32::MAX)) as u32;
        for &s in strips {
            caps[s as usize] = caps[s as usize].min(cap);
        }
    }
    caps
}

/// What the rows of the strips are bound to on a sheet; `coarseness` is what its lengths are multiplied by, √(N/Nc).
pub fn bounds(
    coarse: &Coarse<'_>,
    ground: &Ground<'_>,
    sheet: &Sheet,
    limits: &Limits,
    caps: &[u32],
    coarseness: f64,
) -> Bounds {
    let mut least = vec![1u32; caps.len()];
    let mut sides = Vec::new();
    for (label, held) in sheet.loops.iter().enumerate() {
        let rail = &ground.rails[label];
        let edges = coarse_edges(coarse, label, held);
        for edge in &edges {
            let inside = held.corner_count(edge.start + 1, edge.end);
            least[edge.strip as usize] = least[edge.strip as usize].max(inside + 1);
        }
        sides.extend(side_rows(rail, held, &edges, limits, coarseness));
    }
    Bounds { most: caps.to_vec(), least, sides }
}

/// A coarse boundary edge: its strip, and the positions of its ends on the loop, the last possibly one turn on.
struct BoundaryEdge {
    strip: u32,
    start: usize,
    end: usize,
}

fn coarse_edges(coarse: &Coarse<'_>, label: usize, held: &Held) -> Vec<BoundaryEdge> {
    let vertices = &coarse.loops[label];
    let n = vertices.len();
    let is_coarse = |i: &usize| (held.vertices[*i] as usize) < coarse.mesh.vertex_count;
    let stations: Vec<usize> = (0..held.vertices.len()).filter(is_coarse).collect();
    (0..n)
        .map(|i| BoundaryEdge {
            strip: coarse.edge_strip[coarse.edge(vertices[i], vertices[(i + 1) % n])],
            start: stations[i],
            end: if i + 1 == n { held.vertices.len() + stations[0] } else { stations[i + 1] },
        })
        .collect()
}

impl Held {
    /// Corners at the positions `from..to`, which may go on into the next turn.
    fn corner_count(&self, from: usize, to: usize) -> u32 {
        let n = self.vertices.len();
        (from..to).filter(|i| self.corner[i % n] != NO_CORNER).count() as u32
    }
}

/// The sides of a loop with what they need; those that a coarse edge joins over a corner are one.
fn side_rows(
    rail: &Rail<'_>,
    held: &Held,
    edges: &[BoundaryEdge],
    limits: &Limits,
    coarseness: f64,
) -> Vec<SideRows> {
    let n = held.vertices.len();
    let corners: Vec<usize> = (0..n).filter(|&i| held.is_sharp && held.corner[i] != NO_CORNER).collect();
    if corners.is_empty() {
        let need = need(rail, [0.0, rail.length], limits, coarseness).ceil() as u32;
        return vec![SideRows { need, strips: edges.iter().map(|edge| edge.strip).collect() }];
    }
    // Side k runs from corner k to the next; a group of sides is named by its first.
    let count = corners.len();
    let side_at = |position: usize| {
        let k = corners.partition_point(|&c| c <= position % n);
        if k == 0 { count - 1 } else { k - 1 }
    };
    let mut group: Vec<usize> = (0..count).collect();
    let root = |group: &[usize], mut k: usize| {
        while group[k] != k {
            k = group[k];
        }
        k
    };
    for edge in edges {
        for position in edge.start + 1..edge.end {
            let (a, b) = (root(&group, side_at(edge.start)), root(&group, side_at(position)));
            group[a.max(b)] = a.min(b);
        }
    }
    let station = |k: usize| held.along[corners[k % count]] + if k >= count { rail.length } else { 0.0 };
    (0..count)
        .filter(|&k| group[k] == k)
        .map(|k| {
            let members = || (0..count).filter(|&side| root(&group, side) == k);
            let need = members()
                .map(|side| need(rail, [station(side), station(side + 1)], limits, coarseness).ceil() as u32)
                .sum();
            let on = |edge: &&BoundaryEdge| root(&group, side_at(edge.start)) == k;
            SideRows { need, strips: edges.iter().filter(on).map(|edge| edge.strip).collect() }
        })
        .collect()
}

/// ∫ max(1/(0.9 longest edge), √(κ/(8 · 0.9 gap))) ds over a stretch of a rail, less a rounding error.
fn need(rail: &Rail<'_>, [from, to]: [f64; 2], limits: &Limits, coarseness: f64) -> f64 {
    let unit = limits.target_length;
    let by_length = 1.0 / (RESERVE * coarseness * limits.max_edge / unit);
    let by_gap = 1.0 / (8.0 * RESERVE * coarseness * limits.max_gap / unit);
    let is_closed = to - from > rail.length * (1.0 - 1e-9);
    if !is_closed && rail.is_straight(from, to) {
        return (rail.surface_length(from, to) * by_length - 1e-9).max(0.0);
    }
    let is_whole = from == 0.0 && to == rail.length;
    let curvature =
        if is_whole { Cow::from(rail.curvature(curvature)) } else { Cow::from(curvature(rail, [from, to])) };
    let stretch = rail.surface_length(from, to) / (to - from);
    let rows = |kappa: &f64| (stretch * by_length).max((kappa * by_gap).sqrt());
    let sum: f64 = curvature.iter().map(rows).sum();
    (sum * (to - from) / SAMPLES as f64 - 1e-9).max(0.0)
}

/// Curvature at points that divide a stretch of a rail evenly; near the ends of one that is not closed, that a little further in.
fn curvature(rail: &Rail<'_>, [from, to]: [f64; 2]) -> Vec<f64> {
    let step = (to - from) / SAMPLES as f64;
    let window = ((WINDOW / step).round() as usize).clamp(4, SAMPLES / 4);
    let points: Vec<[f64; 2]> =
        (0..=SAMPLES + 2 * window).map(|i| rail.at(from + step * i as f64).point).collect();
    let directions: Vec<f64> =
        points.iter().zip(&points[window..]).map(|(a, b)| libm::atan2(b[1] - a[1], b[0] - a[0])).collect();
    let is_closed = to - from > rail.length * (1.0 - 1e-9);
    let last = if is_closed { SAMPLES } else { SAMPLES - 2 * window };
    (0..SAMPLES)
        .map(|i| {
            let at = i.saturating_sub(window).min(last - 1);
            let turn = directions[at + window] - directions[at];
            (turn - TAU * libm::round(turn / TAU)).abs() / (window as f64 * step)
        })
        .collect()
}
