//! A boundary loop by arc length on the surface.

use super::curve::{Curve, closest_on_segment};
use crate::surface::{Surface, SurfaceKind};
use std::sync::Arc;

/// One boundary loop, counter-clockwise in plan whether it is the outer one or a hole. Its points lie on the surface: the plan
/// curve lifted, or as given in space where the surface is free.
#[derive(Clone)]
pub struct BoundaryLoop {
    pub(super) curve: Curve,
    /// `None` on a free surface.
    pub(super) surface: Option<Arc<dyn Surface>>,
    /// Curve parameters of the corners, ascending.
    pub(super) corner_parameters: Vec<f64>,
    corners: Vec<f64>,
    cells: Vec<Cell>,
    length: f64,
    /// What is a short way for the patterns here: within it the curve turns at a corner, m.
    way: f64,
}

/// A stretch of the curve between two parameters, with the arc length there as a cubic in the parameter.
#[derive(Clone, Debug)]
struct Cell {
    /// Parameter and arc length at the start.
    t: f64,
    s: f64,
    /// Width in the parameter and length.
    width: f64,
    length: f64,
    /// Lengths per width at both ends, relative to the mean: 1, 1 where the speed is even.
    speeds: [f64; 2],
}

impl Cell {
    /// Share of the cell's length at a share of its width: the cubic Hermite polynomial with the two end speeds.
    fn length_share(&self, u: f64) -> f64 {
        let [a, b] = self.speeds;
        u * (a + u * ((3.0 - 2.0 * a - b) + u * (a + b - 2.0)))
    }

    /// The inverse of [`Cell::length_share`], which is monotone: safeguarded Newton.
    fn width_share(&self, share: f64) -> f64 {
        let [a, b] = self.speeds;
        if a == 1.0 && b == 1.0 {
            return share;
        }
        let (mut low, mut high, mut u) = (0.0, 1.0, share);
        for _ in 0..60 {
            let error = self.length_share(u) - share;
            if error > 0.0 {
                high = u;
            } else {
                low = u;
            }
            let slope = a + u * (2.0 * (3.0 - 2.0 * a - b) + u * 3.0 * (a + b - 2.0));
            let next = u - error / slope;
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            if (next - u).abs() <= 1e-16 {
                break;
            }
            u = next;
        }
        u
    }
}

/// A part of a loop, between two of its corners.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Stretch([f64; 2]);

/// A step in the parameter back from a kink, onto the piece before it.
const NEAR: f64 = 1e-6;

/// Cells of a loop where its speed is not even.
const CELLS: usize = 1024;

impl BoundaryLoop {
    pub(super) fn new(
        curve: Curve,
        surface: &Arc<dyn Surface>,
        mut corner_parameters: Vec<f64>,
        way: f64,
    ) -> Self {
        corner_parameters.sort_by(f64::total_cmp);
        let surface = (surface.kind() != SurfaceKind::Free).then(|| Arc::clone(surface));
        Self::measured(curve, surface, corner_parameters, way)
    }

    fn measured(
        curve: Curve,
        surface: Option<Arc<dyn Surface>>,
        corner_parameters: Vec<f64>,
        way: f64,
    ) -> Self {
        let (corners, cells) = (Vec::new(), Vec::new());
        let mut boundary = Self { curve, surface, corner_parameters, corners, cells, length: 0.0, way };
        boundary.measure();
        boundary.corners = boundary.corner_parameters.iter().map(|&t| boundary.arc_length(t)).collect();
        boundary
    }

    /// Fills the cells and the length.
    fn measure(&mut self) {
        let breaks = self.curve.breaks();
        let per_piece = (CELLS / (breaks.len() - 1)).max(16);
        for piece in breaks.windows(2) {
            // One step inside the piece, so that a kink's two speeds are not mixed.
            let speeds: Vec<f64> =
                (0..=16).map(|i| self.speed(piece[0] + (piece[1] - piece[0]) * inner_share(i))).collect();
            let even = speeds.iter().all(|v| (v - speeds[0]).abs() <= 1e-12 * speeds[0]);
            let count = if even { 1 } else { per_piece };
            for i in 0..count {
                let share = |i: usize| piece[0] + (piece[1] - piece[0]) * (i as f64 / count as f64);
                self.push_cell(share(i), share(i + 1), even);
            }
        }
    }

    fn push_cell(&mut self, start: f64, end: f64, even: bool) {
        let width = end - start;
        let smooth = self.surface.as_ref().is_none_or(|s| s.is_smooth());
        let (length, speeds) = if even && smooth {
            (self.speed(start + 0.5 * width) * width, [1.0; 2])
        } else if smooth {
            let mean: f64 = GAUSS.iter().map(|(u, w)| w * self.speed(start + u * width)).sum();
            let at = |u: f64| (self.speed(start + u * width) / mean).clamp(0.0, 3.0);
            (mean * width, [at(1e-9), at(1.0 - 1e-9)])
        } else {
            (self.chords(start, width), [1.0; 2])
        };
        self.cells.push(Cell { t: start, s: self.length, width, length, speeds });
        self.length += length;
    }

    /// Length of eight chords: for surfaces with facets.
    fn chords(&self, start: f64, width: f64) -> f64 {
        let points: Vec<_> = (0..=8).map(|i| self.at(start + width * f64::from(i) / 8.0)).collect();
        points.windows(2).map(|w| distance(w[0], w[1])).sum()
    }

    /// |d point / dt| on the surface.
    fn speed(&self, t: f64) -> f64 {
        let d = self.derivative(t);
        (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt()
    }

    /// d point / dt on the surface.
    fn derivative(&self, t: f64) -> [f64; 3] {
        let d = self.curve.derivative(t);
        let Some(surface) = &self.surface else { return d };
        let n = surface.normal(self.at(t));
        // On a vertical tangent plane a horizontal curve stays horizontal.
        let rise = if n[2].abs() > 1e-6 { -(n[0] * d[0] + n[1] * d[1]) / n[2] } else { 0.0 };
        [d[0], d[1], rise]
    }

    /// Point at a curve parameter, on the surface.
    pub(super) fn at(&self, t: f64) -> [f64; 3] {
        let [x, y, z] = self.curve.point(t);
        match &self.surface {
            None => [x, y, z],
            Some(surface) => [x, y, surface.height(x, y).unwrap_or_else(|| surface.project([x, y, z])[2])],
        }
    }

    /// Arc length from the start to a curve parameter in `0..=period`.
    pub fn arc_length(&self, t: f64) -> f64 {
        let i = self.cells.partition_point(|c| c.t <= t).saturating_sub(1);
        let cell = &self.cells[i];
        cell.s + cell.length * cell.length_share(((t - cell.t) / cell.width).clamp(0.0, 1.0))
    }

    /// Curve parameter at an arc length, modulo the length: the same for a loop and for the loop in plan.
    pub fn parameter(&self, s: f64) -> f64 {
        let s = s.rem_euclid(self.length);
        // A point at a corner is the corner, to the last bit.
        if let Ok(i) = self.corners.binary_search_by(|c| c.total_cmp(&s)) {
            return self.corner_parameters[i];
        }
        let i = self.cells.partition_point(|c| c.s <= s).saturating_sub(1);
        let cell = &self.cells[i];
        cell.t + cell.width * cell.width_share(((s - cell.s) / cell.length).clamp(0.0, 1.0))
    }

    /// Length of the curve on the surface, m.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Point at arc length `s` counter-clockwise from the start, modulo the length, m. At a corner's arc length it is the
    /// corner exactly.
    pub fn point(&self, s: f64) -> [f64; 3] {
        self.at(self.parameter(s))
    }

    /// Unit tangent in space at arc length `s`, counter-clockwise; at a kink that of the stretch after it.
    pub fn tangent(&self, s: f64) -> [f64; 3] {
        let d = self.derivative(self.parameter(s));
        let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
        d.map(|v| v / length)
    }

    /// The same loop in plan, by its plan length.
    pub(super) fn in_plan(&self) -> Self {
        Self::measured(self.curve.flattened(), None, self.corner_parameters.clone(), self.way)
    }

    /// Point and unit tangent at arc length `s`, modulo the length.
    pub fn place(&self, s: f64) -> ([f64; 3], [f64; 3]) {
        let t = self.parameter(s);
        let d = self.derivative(t);
        let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
        (self.at(t), d.map(|v| v / length))
    }

    /// Angle by which the curve turns at a corner at arc length `s`, along the surface, −π..π; positive to the left. It is that
    /// between the directions a short way before and after, so that a fillet turns as the corner it rounds; but no farther than
    /// midway to another corner.
    pub(super) fn turning(&self, s: f64) -> f64 {
        let t = self.parameter(s);
        let way = self.way.min(0.5 * self.room(s));
        let [before, after] = if way > 0.0 {
            [self.parameter(s - way), self.parameter(s + way)]
        } else {
            [(t - NEAR).rem_euclid(self.curve.period()), t]
        };
        let (before, after) = (self.derivative(before), self.derivative(after));
        let across: [f64; 3] = std::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            before[i] * after[j] - before[j] * after[i]
        });
        let along: f64 = (0..3).map(|k| before[k] * after[k]).sum();
        let size = across.iter().map(|a| a * a).sum::<f64>().sqrt();
        libm::atan2(size.copysign(across[2]), along)
    }

    /// Length from arc length `s` to the nearest corner beside it, at most a quarter of the loop.
    fn room(&self, s: f64) -> f64 {
        self.corners
            .iter()
            .map(|c| (c - s).abs())
            .map(|gap| gap.min(self.length - gap))
            .filter(|&gap| gap > 0.0)
            .fold(0.25 * self.length, f64::min)
    }

    /// Arc lengths of the corners, ascending, in `0..length`.
    pub fn corners(&self) -> &[f64] {
        &self.corners
    }

    /// Arc length of the point of the curve that is closest in plan, or in space where the surface is free.
    pub fn closest(&self, point: [f64; 3]) -> f64 {
        self.arc_length(self.curve.closest(point, self.surface.is_some()))
    }

    /// The point of the curve that is closest in plan, or in space where the surface is free.
    pub fn closest_point(&self, point: [f64; 3]) -> [f64; 3] {
        self.at(self.curve.closest(point, self.surface.is_some()))
    }

    /// The stretch from arc length `from` counter-clockwise to `to`, two corners; the whole loop if they are a length apart (a
    /// corner and itself) or not finite.
    pub fn stretch(&self, from: f64, to: f64) -> Stretch {
        let part = (to - from) / self.length;
        if !(part > 0.0 && part < 1.0 - 1e-9) {
            return Stretch([0.0, self.curve.period()]);
        }
        let (start, end) = (self.parameter(from), self.parameter(to));
        Stretch([start, if end > start { end } else { end + self.curve.period() }])
    }

    /// Arc length and place of the point of a stretch that is closest in plan, or in space where the surface is free. What is
    /// near a corner may be nearer to the other side of it: a vertex of one side is not to go there.
    pub fn nearest(&self, point: [f64; 3], stretch: Stretch) -> (f64, [f64; 3]) {
        let t = self.curve.closest_between(point, self.surface.is_some(), stretch.0);
        (self.arc_length(t), self.at(t))
    }

    /// Arc length of the point that is locally closest in plan, going down from arc length `s`.
    pub fn closest_near(&self, point: [f64; 2], s: f64) -> f64 {
        self.arc_length(self.curve.closest_near(point, self.parameter(s)))
    }

    /// Arc lengths of points along the loop, ascending from its start: all points of a polyline, all corners (that of a fillet may
    /// lie between two points), and between them so many that the plan distance from one to the next is at most `spacing`.
    pub fn sample(&self, spacing: f64) -> Vec<f64> {
        const CHORDS: usize = 8;
        let mut samples = Vec::new();
        for piece in self.curve.breaks().windows(2) {
            let at = |share: f64| piece[0] + share * (piece[1] - piece[0]);
            let corners: Vec<_> =
                (0..=CHORDS).map(|i| self.curve.point(at(i as f64 / CHORDS as f64))).collect();
            let length: f64 = corners.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).sum();
            let count = (1.01 * length / spacing).ceil().max(1.0) as usize;
            samples.extend((0..count).map(|i| self.arc_length(at(i as f64 / count as f64))));
        }
        samples.extend(&self.corners);
        samples.sort_by(f64::total_cmp);
        samples.dedup();
        samples
    }

    /// Whether the stretch from arc length `from` counter-clockwise to `to` is one straight line in plan, to a tenth of the way
    /// within which corners turn: a fillet at its end does not make a wall a curve.
    pub fn is_straight(&self, from: f64, to: f64) -> bool {
        let Curve::Polyline { points } = &self.curve else { return false };
        let start = self.parameter(from);
        let mut end = self.parameter(to);
        if end <= start {
            end += self.curve.period();
        }
        let a = self.curve.point(start);
        let b = self.curve.point(end);
        let chord = (b[0] - a[0]).hypot(b[1] - a[1]);
        let tolerance = (1e-9 * chord).max(0.1 * self.way);
        (start.floor() as usize + 1..end.ceil() as usize).all(|i| {
            let p = points[i % points.len()];
            let area = (b[0] - a[0]) * (p[1] - a[1]) - (p[0] - a[0]) * (b[1] - a[1]);
            area.abs() <= tolerance * chord
        }) && chord > 0.0
    }

    /// Farthest that the curve from arc length `from` counter-clockwise to `to` lies from its chord in plan, m; 0 within rounding.
    pub fn gap(&self, from: f64, to: f64) -> f64 {
        let start = self.parameter(from);
        let end = self.parameter(to);
        let end = if end > start { end } else { end + self.curve.period() };
        let (a, b) = (self.curve.point(start), self.curve.point(end));
        let distance2 = |t| closest_on_segment(self.curve.point(t), a, b, 2).0;
        let gap = self.curve.probes(start, end).map(distance2).fold(0.0, f64::max).sqrt();
        if gap > 1e-9 * self.length { gap } else { 0.0 }
    }

    /// Enclosed plan area, m².
    pub fn area(&self) -> f64 {
        self.curve.area()
    }

    /// Whether the loop runs around (x, y) in plan; on the curve either answer may come.
    pub fn surrounds(&self, point: [f64; 2]) -> bool {
        self.curve.surrounds(point)
    }
}

/// Shares 0..1 of 17 probes, the ends drawn in a little.
fn inner_share(i: i32) -> f64 {
    1e-9 + (1.0 - 2e-9) * f64::from(i) / 16.0
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f64>().sqrt()
}

/// Gauss–Legendre on 0..1 with four points: position and weight.
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_9),
    (0.330_009_478_207_571_9, 0.326_072_577_431_273_1),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_1),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_9),
];
