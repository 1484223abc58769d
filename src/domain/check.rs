//! Checks of boundary curves: no crossing, no touching, holes inside, surface everywhere.

use super::curve::{Curve, closest_on_segment};
use super::error::DomainError;
use crate::surface::{Surface, SurfaceKind};
use std::f64::consts::TAU;

/// Curves nearer to each other than this share of the domain's size touch.
const TOUCH: f64 = 1e-9;

/// Refuses a closed polyline two edges of which cross or touch.
pub(super) fn simple(loop_number: usize, points: &[[f64; 3]]) -> Result<(), DomainError> {
    let count = points.len();
    let size = diagonal(points);
    // Sweep over edges by their smallest x, so that a boundary of thousands of points costs little.
    let ends = |i: usize| (points[i], points[(i + 1) % count]);
    let mut order: Vec<usize> = (0..count).collect();
    let left = |i: usize| ends(i).0[0].min(ends(i).1[0]);
    let right = |i: usize| ends(i).0[0].max(ends(i).1[0]);
    order.sort_by(|&i, &j| left(i).total_cmp(&left(j)).then(i.cmp(&j)));
    for (k, &i) in order.iter().enumerate() {
        for &j in order[k + 1..].iter().take_while(|&&j| left(j) <= right(i) + TOUCH * size) {
            let (i, j) = (i.min(j), i.max(j));
            if let Some([x, y]) = edges_meet(points, i, j, TOUCH * size) {
                let (first, second) = ([i, (i + 1) % count], [j, (j + 1) % count]);
                return Err(DomainError::SelfCrossing { loop_number, first, second, x, y });
            }
        }
    }
    Ok(())
}

/// Where edges `i` and `j` of a closed polyline meet, other than in the point that neighbours share.
fn edges_meet(points: &[[f64; 3]], i: usize, j: usize, tolerance: f64) -> Option<[f64; 2]> {
    let count = points.len();
    let (a, b) = (points[i], points[(i + 1) % count]);
    let (c, d) = (points[j], points[(j + 1) % count]);
    let near = |p: [f64; 3], q: [f64; 3], r: [f64; 3]| {
        (closest_on_segment(p, q, r, 2).0.sqrt() <= tolerance).then_some([p[0], p[1]])
    };
    if (i + 1) % count == j {
        // Neighbours fold back on each other.
        near(d, a, b).or_else(|| near(a, c, d))
    } else if (j + 1) % count == i {
        near(b, c, d).or_else(|| near(c, a, b))
    } else {
        segments_meet([a, b], [c, d], tolerance)
    }
}

/// Where two segments cross or come within a tolerance, in plan.
fn segments_meet([a, b]: [[f64; 3]; 2], [c, d]: [[f64; 3]; 2], tolerance: f64) -> Option<[f64; 2]> {
    let side =
        |p: [f64; 3], q: [f64; 3], r: [f64; 3]| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    let (s, t, u, v) = (side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b));
    if (s > 0.0) != (t > 0.0) && (u > 0.0) != (v > 0.0) {
        let share = if u == v { 0.0 } else { u / (u - v) };
        return Some([a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])]);
    }
    [(a, c, d), (b, c, d), (c, a, b), (d, a, b)]
        .into_iter()
        .find(|&(p, q, r)| closest_on_segment(p, q, r, 2).0.sqrt() <= tolerance)
        .map(|(p, _, _)| [p[0], p[1]])
}

fn diagonal(points: &[[f64; 3]]) -> f64 {
    let [low, high] = Curve::Polyline { points: points.to_vec() }.bounds();
    (high[0] - low[0]).hypot(high[1] - low[1])
}

/// Smallest and largest extents of a loop, m.
const EXTENTS: std::ops::RangeInclusive<f64> = 1e-6..=1e9;

/// Refuses loops of measures that no structure has.
pub(super) fn extents(curves: &[Curve]) -> Result<(), DomainError> {
    for (loop_number, curve) in curves.iter().enumerate() {
        let [low, high] = curve.bounds();
        let extents = [high[0] - low[0], high[1] - low[1]];
        if extents.iter().any(|extent| !EXTENTS.contains(extent)) {
            return Err(DomainError::Extents { loop_number, extents });
        }
    }
    Ok(())
}

/// Refuses loops that meet, holes outside the outer loop, and holes in holes.
pub(super) fn curves(curves: &[Curve]) -> Result<(), DomainError> {
    let [low, high] = curves[0].bounds();
    let tolerance = TOUCH * (high[0] - low[0]).hypot(high[1] - low[1]);
    for second in 1..curves.len() {
        for first in 0..second {
            if let Some([x, y]) = meet(&curves[first], &curves[second], tolerance) {
                return Err(DomainError::LoopsMeet { first, second, x, y });
            }
        }
    }
    for (loop_number, hole) in curves.iter().enumerate().skip(1) {
        let [x, y, _] = hole.point(0.0);
        // The hole may also be larger than the outer loop.
        if !curves[0].surrounds([x, y]) {
            return Err(DomainError::HoleOutside { loop_number });
        }
        if let Some(outer) = (1..curves.len()).find(|&k| k != loop_number && curves[k].surrounds([x, y])) {
            return Err(DomainError::HoleInHole { inner: loop_number, outer });
        }
    }
    Ok(())
}

/// Where two curves come within a tolerance of each other or cross.
fn meet(first: &Curve, second: &Curve, tolerance: f64) -> Option<[f64; 2]> {
    match (first, second) {
        (Curve::Polyline { points: a }, Curve::Polyline { points: b }) => {
            pieces(a).find_map(|s| pieces(b).find_map(|t| segments_meet(s, t, tolerance)))
        }
        (Curve::Polyline { points }, ellipse) | (ellipse, Curve::Polyline { points }) => {
            pieces(points).find_map(|s| segment_meets_ellipse(s, ellipse, tolerance))
        }
        (a, b) => ellipses_meet(a, b, tolerance),
    }
}

fn pieces(points: &[[f64; 3]]) -> impl Iterator<Item = [[f64; 3]; 2]> + '_ {
    (0..points.len()).map(|i| [points[i], points[(i + 1) % points.len()]])
}

/// A segment meets an ellipse when it has points on both sides of it; in the ellipse's own axes, where it is the unit circle,
/// the nearest point of the segment is that to the origin and the farthest is an end.
fn segment_meets_ellipse([a, b]: [[f64; 3]; 2], ellipse: &Curve, tolerance: f64) -> Option<[f64; 2]> {
    let Curve::Ellipse { center, axes, turn } = ellipse else { return None };
    let local = |p: [f64; 3]| {
        let (x, y) = (p[0] - center[0], p[1] - center[1]);
        [(x * turn[0] + y * turn[1]) / axes[0], (y * turn[0] - x * turn[1]) / axes[1], 0.0]
    };
    let (nearest2, share) = closest_on_segment([0.0; 3], local(a), local(b), 2);
    let farthest = ellipse.ellipse_radius([a[0], a[1]]).max(ellipse.ellipse_radius([b[0], b[1]]));
    let relative = tolerance / axes[0].min(axes[1]);
    let crosses = nearest2.sqrt() <= 1.0 + relative && farthest >= 1.0 - relative;
    crosses.then(|| [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])])
}

/// Two ellipses: the signed distance of one from the other, at many points and refined about the least by golden section.
fn ellipses_meet(a: &Curve, b: &Curve, tolerance: f64) -> Option<[f64; 2]> {
    const SAMPLES: usize = 2048;
    let gap = |t: f64| {
        let p = a.point(t);
        let q = b.point(b.closest(p, true));
        let distance = (p[0] - q[0]).hypot(p[1] - q[1]);
        if b.surrounds([p[0], p[1]]) { -distance } else { distance }
    };
    let gaps: Vec<f64> = (0..SAMPLES).map(|i| gap(i as f64 / SAMPLES as f64 * TAU)).collect();
    let nearest = (1..SAMPLES).fold(0, |best, i| if gaps[i].abs() < gaps[best].abs() { i } else { best });
    if let Some(i) = (0..SAMPLES).find(|&i| (gaps[i] > 0.0) != (gaps[0] > 0.0)) {
        let p = a.point(i as f64 / SAMPLES as f64 * TAU);
        return Some([p[0], p[1]]);
    }
    let step = TAU / SAMPLES as f64;
    let (mut low, mut high) = ((nearest as f64 - 1.0) * step, (nearest as f64 + 1.0) * step);
    for _ in 0..100 {
        let (u, v) = (low + (high - low) * 0.382, low + (high - low) * 0.618);
        if signed(gap(u), gaps[0]) < signed(gap(v), gaps[0]) {
            high = v;
        } else {
            low = u;
        }
    }
    let t = 0.5 * (low + high);
    let p = a.point(t);
    (signed(gap(t), gaps[0]) <= tolerance).then_some([p[0], p[1]])
}

/// The gap, counted positive on the side where the reference lies.
fn signed(gap: f64, reference: f64) -> f64 {
    if reference < 0.0 { -gap } else { gap }
}

/// Refuses a surface that has no finite height somewhere in the domain: tested along the boundary and on a grid.
pub(super) fn covered(curves: &[Curve], surface: &dyn Surface) -> Result<(), DomainError> {
    const GRID: usize = 96;
    const ALONG: usize = 32;
    if surface.kind() == SurfaceKind::Free {
        return Ok(());
    }
    let test = |x: f64, y: f64| {
        let missing = surface.height(x, y).is_none();
        if missing { Err(DomainError::NotCovered { x, y, extent: surface.extent() }) } else { Ok(()) }
    };
    for curve in curves {
        for piece in curve.breaks().windows(2) {
            for i in 0..ALONG {
                let [x, y, _] = curve.point(piece[0] + (piece[1] - piece[0]) * i as f64 / ALONG as f64);
                test(x, y)?;
            }
        }
    }
    let [low, high] = curves[0].bounds();
    for i in 0..GRID {
        for j in 0..GRID {
            let at = |k: usize, n: usize| low[k] + (high[k] - low[k]) * (n as f64 + 0.5) / GRID as f64;
            let (x, y) = (at(0, i), at(1, j));
            if curves[0].surrounds([x, y]) && !curves[1..].iter().any(|h| h.surrounds([x, y])) {
                test(x, y)?;
            }
        }
    }
    Ok(())
}
