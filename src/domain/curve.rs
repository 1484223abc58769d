//! Closed plan curves with a parameter: polylines and ellipses (a circle is one), counter-clockwise, with their z as given.

use std::f64::consts::TAU;

/// A closed curve, counter-clockwise in plan.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Curve {
    /// Straight pieces between the points; the last is joined to the first. Parameter: number of the piece + share of it.
    Polyline {
        /// The points, m.
        points: Vec<[f64; 3]>,
    },
    /// center + a cos t · e + b sin t · e⊥ with e = (cos, sin) of the rotation. Parameter: the angle t.
    Ellipse {
        /// The centre, m.
        center: [f64; 3],
        /// The semi-axes a and b, m.
        axes: [f64; 2],
        /// Cosine and sine of the rotation.
        turn: [f64; 2],
    },
}

impl Curve {
    /// The parameter runs over `0..period`.
    pub(super) fn period(&self) -> f64 {
        match self {
            Self::Polyline { points } => points.len() as f64,
            Self::Ellipse { .. } => TAU,
        }
    }

    /// The parameters between which the curve is smooth, the period included.
    pub(super) fn breaks(&self) -> Vec<f64> {
        match self {
            Self::Polyline { points } => (0..=points.len()).map(|i| i as f64).collect(),
            Self::Ellipse { .. } => (0..=8).map(|i| f64::from(i) / 8.0 * TAU).collect(),
        }
    }

    /// The number of the straight piece at `t`, and the share of it that lies before.
    fn piece(t: f64, count: usize) -> (usize, f64) {
        let t = t.rem_euclid(count as f64);
        let i = (t as usize).min(count - 1);
        (i, t - i as f64)
    }

    /// Position at parameter `t`, z as given.
    pub(super) fn point(&self, t: f64) -> [f64; 3] {
        match self {
            Self::Polyline { points } => {
                let (i, share) = Self::piece(t, points.len());
                let (a, b) = (points[i], points[(i + 1) % points.len()]);
                std::array::from_fn(|k| a[k] + share * (b[k] - a[k]))
            }
            Self::Ellipse { center, axes, turn } => {
                let (u, v) = (axes[0] * libm::cos(t), axes[1] * libm::sin(t));
                [center[0] + u * turn[0] - v * turn[1], center[1] + u * turn[1] + v * turn[0], center[2]]
            }
        }
    }

    /// The same curve at height 0.
    pub(super) fn flattened(&self) -> Self {
        let down = |[x, y, _]: &[f64; 3]| [*x, *y, 0.0];
        match self {
            Self::Polyline { points } => Self::Polyline { points: points.iter().map(down).collect() },
            Self::Ellipse { center, axes, turn } => {
                Self::Ellipse { center: down(center), axes: *axes, turn: *turn }
            }
        }
    }

    /// d point / dt; at a kink that of the piece after it.
    pub(super) fn derivative(&self, t: f64) -> [f64; 3] {
        match self {
            Self::Polyline { points } => {
                let (i, _) = Self::piece(t, points.len());
                let (a, b) = (points[i], points[(i + 1) % points.len()]);
                std::array::from_fn(|k| b[k] - a[k])
            }
            Self::Ellipse { axes, turn, .. } => {
                let (u, v) = (-axes[0] * libm::sin(t), axes[1] * libm::cos(t));
                [u * turn[0] - v * turn[1], u * turn[1] + v * turn[0], 0.0]
            }
        }
    }

    /// Parameter of the closest point: in space, or in plan when `plan` is set. Ties: the smaller parameter.
    pub(super) fn closest(&self, point: [f64; 3], plan: bool) -> f64 {
        self.closest_between(point, plan, [0.0, self.period()])
    }

    /// The same of a stretch between two parameters, the second of which may lie up to a period beyond the end. An ellipse has
    /// no kink that would part stretches: of it, all points count.
    pub(super) fn closest_between(&self, point: [f64; 3], plan: bool, [from, to]: [f64; 2]) -> f64 {
        match self {
            Self::Polyline { points } => {
                let dimensions = if plan { 2 } else { 3 };
                let count = points.len();
                let mut best = (f64::INFINITY, 0.0);
                for i in from as usize..to.ceil() as usize {
                    let (a, b) = (points[i % count], points[(i + 1) % count]);
                    let ends = [(from - i as f64).max(0.0), (to - i as f64).min(1.0)];
                    let (distance2, share) = closest_on_part(point, a, b, dimensions, ends);
                    if distance2 < best.0 {
                        best = (distance2, i as f64 + share);
                    }
                }
                best.1 % count as f64
            }
            // The plane of the ellipse is horizontal: the height of the point does not matter.
            Self::Ellipse { center, axes, turn } => {
                let (x, y) = (point[0] - center[0], point[1] - center[1]);
                let local = [x * turn[0] + y * turn[1], y * turn[0] - x * turn[1]];
                closest_on_ellipse(local, *axes)
            }
        }
    }

    /// Parameter of the locally closest point in plan, going down from parameter `t`.
    pub(super) fn closest_near(&self, [x, y]: [f64; 2], t: f64) -> f64 {
        match self {
            Self::Polyline { points } => closest_piece_near([x, y, 0.0], points, t),
            Self::Ellipse { center, axes, .. } if axes[0] == axes[1] => {
                let at_center = (x, y) == (center[0], center[1]);
                if at_center { t } else { self.closest([x, y, 0.0], true) }
            }
            Self::Ellipse { axes, .. } => {
                // Newton on half the squared distance, whose second derivative is |p'|² + (p − x)·p''.
                let mut t = t;
                for _ in 0..50 {
                    let (p, d) = (self.point(t), self.derivative(t));
                    let second = self.derivative(t + 0.25 * TAU);
                    let gap = [p[0] - x, p[1] - y];
                    let slope = gap[0] * d[0] + gap[1] * d[1];
                    let steepness = (d[0] * d[0] + d[1] * d[1] + gap[0] * second[0] + gap[1] * second[1])
                        .max(0.1 * axes[0].min(axes[1]).powi(2));
                    let step = (-slope / steepness).clamp(-0.2, 0.2);
                    t += step;
                    if step.abs() < 1e-15 {
                        break;
                    }
                }
                t.rem_euclid(TAU) % TAU
            }
        }
    }

    /// Enclosed plan area, m².
    pub(super) fn area(&self) -> f64 {
        match self {
            Self::Polyline { points } => signed_area(points),
            Self::Ellipse { axes, .. } => std::f64::consts::PI * axes[0] * axes[1],
        }
    }

    /// Whether the curve runs around (x, y); on the curve itself either answer may come.
    pub(super) fn surrounds(&self, [x, y]: [f64; 2]) -> bool {
        match self {
            Self::Polyline { points } => {
                let mut inside = false;
                let mut a = points[points.len() - 1];
                for &b in points {
                    if (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) {
                        inside = !inside;
                    }
                    a = b;
                }
                inside
            }
            Self::Ellipse { .. } => self.ellipse_radius([x, y]) < 1.0,
        }
    }

    /// Where the line on which the other coordinate is `level` crosses the curve: the coordinate `axis` (0: x, 1: y) of an even
    /// number of points. A line that only touches does not cross.
    pub(super) fn crossings(&self, axis: usize, level: f64) -> Vec<f64> {
        let across = 1 - axis;
        match self {
            Self::Polyline { points } => (0..points.len())
                .filter_map(|i| {
                    let (a, b) = (points[i], points[(i + 1) % points.len()]);
                    let share = (level - a[across]) / (b[across] - a[across]);
                    ((a[across] > level) != (b[across] > level))
                        .then(|| a[axis] + share * (b[axis] - a[axis]))
                })
                .collect(),
            // |M (p − centre)|² = 1, quadratic in the coordinate along the line.
            Self::Ellipse { center, axes, turn } => {
                let local = |p: [f64; 2]| {
                    [(p[0] * turn[0] + p[1] * turn[1]) / axes[0], (p[1] * turn[0] - p[0] * turn[1]) / axes[1]]
                };
                let mut unit = [0.0; 2];
                unit[axis] = 1.0;
                let mut offset = [0.0; 2];
                offset[across] = level - center[across];
                let (d, o) = (local(unit), local(offset));
                let square = d[0] * d[0] + d[1] * d[1];
                let middle = -(d[0] * o[0] + d[1] * o[1]) / square;
                let moment = d[0] * o[1] - d[1] * o[0];
                let rest = square - moment * moment;
                if rest <= 0.0 {
                    return Vec::new();
                }
                let half = rest.sqrt() / square;
                vec![center[axis] + middle - half, center[axis] + middle + half]
            }
        }
    }

    /// √((u/a)² + (v/b)²) in the axes of an ellipse: 1 on the curve. 0 for a polyline.
    pub(super) fn ellipse_radius(&self, [x, y]: [f64; 2]) -> f64 {
        match self {
            Self::Polyline { .. } => 0.0,
            Self::Ellipse { center, axes, turn } => {
                let (x, y) = (x - center[0], y - center[1]);
                let u = (x * turn[0] + y * turn[1]) / axes[0];
                let v = (y * turn[0] - x * turn[1]) / axes[1];
                (u * u + v * v).sqrt()
            }
        }
    }

    /// Smallest and largest x and y.
    pub(super) fn bounds(&self) -> [[f64; 2]; 2] {
        match self {
            Self::Polyline { points } => {
                points.iter().fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |b, p| {
                    [[b[0][0].min(p[0]), b[0][1].min(p[1])], [b[1][0].max(p[0]), b[1][1].max(p[1])]]
                })
            }
            Self::Ellipse { center, axes, turn } => {
                let reach = |c: f64, s: f64| (axes[0] * c * axes[0] * c + axes[1] * s * axes[1] * s).sqrt();
                let (rx, ry) = (reach(turn[0], turn[1]), reach(turn[1], turn[0]));
                [[center[0] - rx, center[1] - ry], [center[0] + rx, center[1] + ry]]
            }
        }
    }

    /// Parameter of the point of largest x; ties: the smaller parameter.
    pub(super) fn rightmost(&self) -> f64 {
        match self {
            Self::Polyline { points } => {
                let best = (1..points.len())
                    .fold(0, |best, i| if points[i][0] > points[best][0] { i } else { best });
                best as f64
            }
            Self::Ellipse { axes, turn, .. } => {
                libm::atan2(-axes[1] * turn[1], axes[0] * turn[0]).rem_euclid(TAU)
            }
        }
    }
}

/// The locally closest point of a closed polyline: from piece to piece as long as that comes nearer.
fn closest_piece_near(p: [f64; 3], points: &[[f64; 3]], t: f64) -> f64 {
    let count = points.len();
    let on = |i: usize| closest_on_segment(p, points[i % count], points[(i + 1) % count], 2);
    let (mut piece, _) = Curve::piece(t, count);
    let (mut distance2, mut share) = on(piece);
    for _ in 0..count {
        let next = (if share >= 1.0 { piece + 1 } else { piece + count - 1 }) % count;
        let (beyond2, beyond) = on(next);
        if (share > 0.0 && share < 1.0) || beyond2 >= distance2 {
            break;
        }
        (piece, distance2, share) = (next, beyond2, beyond);
    }
    (piece as f64 + share) % count as f64
}

/// Area by the shoelace formula, positive counter-clockwise, m².
pub(super) fn signed_area(points: &[[f64; 3]]) -> f64 {
    // Relative to the first point, so that a domain far from the origin loses no digits.
    let [x0, y0, _] = points[0];
    let shifted = |i: usize| [points[i][0] - x0, points[i][1] - y0];
    (1..points.len().saturating_sub(1))
        .map(|i| {
            let (a, b) = (shifted(i), shifted(i + 1));
            0.5 * (a[0] * b[1] - b[0] * a[1])
        })
        .sum()
}

/// Squared distance to a segment and the share of it at which the closest point lies, in the first `dimensions` coordinates.
pub(super) fn closest_on_segment(p: [f64; 3], a: [f64; 3], b: [f64; 3], dimensions: usize) -> (f64, f64) {
    closest_on_part(p, a, b, dimensions, [0.0, 1.0])
}

/// The same of the part of a segment between two shares of it.
fn closest_on_part(
    p: [f64; 3],
    a: [f64; 3],
    b: [f64; 3],
    dimensions: usize,
    [from, to]: [f64; 2],
) -> (f64, f64) {
    let (mut along, mut length2) = (0.0, 0.0);
    for k in 0..dimensions {
        along += (p[k] - a[k]) * (b[k] - a[k]);
        length2 += (b[k] - a[k]) * (b[k] - a[k]);
    }
    let share = if length2 > 0.0 { (along / length2).max(from).min(to) } else { from };
    let distance2 = (0..dimensions)
        .map(|k| {
            let d = a[k] + share * (b[k] - a[k]) - p[k];
            d * d
        })
        .sum();
    (distance2, share)
}

/// Angle t of the point (a cos t, b sin t) closest to (u, v). At the centre of a circle: 0.
///
/// Eberly, *Distance from a point to an ellipse* (Geometric Tools, 2013): the closest point is (a² u/(s + a²), b² v/(s + b²)) for
/// the largest root s of the distance equation, found by bisection in the first quadrant, which cannot fail.
fn closest_on_ellipse([u, v]: [f64; 2], [a, b]: [f64; 2]) -> f64 {
    if a == b {
        return libm::atan2(v, u).rem_euclid(TAU) % TAU;
    }
    let (major, minor, p, q) = if a > b { (a, b, u.abs(), v.abs()) } else { (b, a, v.abs(), u.abs()) };
    let [x, y] = closest_in_quadrant(p, q, major, minor);
    let (x, y) = if a > b { (x, y) } else { (y, x) };
    libm::atan2(y.copysign(v) / b, x.copysign(u) / a).rem_euclid(TAU) % TAU
}

/// The closest point on the first quadrant of an ellipse with `major` > `minor`, for p, q ≥ 0.
fn closest_in_quadrant(p: f64, q: f64, major: f64, minor: f64) -> [f64; 2] {
    if q <= 0.0 {
        // On the major axis: between the centres of curvature the closest point leaves the axis.
        let gap = major * major - minor * minor;
        if major * p < gap {
            let cos = major * p / gap;
            return [major * cos, minor * (1.0 - cos * cos).max(0.0).sqrt()];
        }
        return [major, 0.0];
    }
    let ratio = (major / minor) * (major / minor);
    let (n0, z1) = (ratio * p / major, q / minor);
    // The root is sought in w = s/b² + 1, which keeps its digits near the major axis, where w tends to 0.
    let g = |w: f64| {
        let (r0, r1) = (n0 / (w + (ratio - 1.0)), z1 / w);
        r0 * r0 + r1 * r1 - 1.0
    };
    let (mut low, mut high) = (z1, if g(1.0) < 0.0 { 1.0 } else { (n0 * n0 + z1 * z1).sqrt() });
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if g(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let w = 0.5 * (low + high);
    [ratio * p / (w + (ratio - 1.0)), q / w]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ellipse(axes: [f64; 2]) -> Curve {
        Curve::Ellipse { center: [1.0, 2.0, 0.0], axes, turn: [0.8, 0.6] }
    }

    /// The closest of many points of the curve cannot be closer than the closest point.
    #[test]
    fn closest_point_of_an_ellipse() {
        for axes in [[3.0, 1.0], [1.0, 2.5], [2.0, 2.0], [2.0, 2.0 + 1e-9]] {
            let curve = ellipse(axes);
            for i in 0..40 {
                let p = [f64::from(i % 8) - 3.0, f64::from(i / 8) - 0.5, 0.0];
                let distance = |t: f64| {
                    let q = curve.point(t);
                    (q[0] - p[0]).hypot(q[1] - p[1])
                };
                let found = distance(curve.closest(p, true));
                let sampled =
                    (0..3000).map(|k| distance(f64::from(k) / 3000.0 * TAU)).fold(f64::MAX, f64::min);
                assert!(found <= sampled + 1e-9, "{axes:?} {p:?}: {found} {sampled}");
            }
        }
    }

    #[test]
    fn points_of_an_ellipse_are_their_own_closest() {
        let curve = ellipse([3.0, 1.0]);
        for k in 0..100 {
            let t = f64::from(k) / 100.0 * TAU;
            let found = curve.closest(curve.point(t), true);
            assert!((found - t).abs() < 1e-7, "{t} {found}");
            let p = curve.point(found);
            assert!((curve.ellipse_radius([p[0], p[1]]) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn rightmost_point() {
        let curve = ellipse([3.0, 1.0]);
        let most = curve.point(curve.rightmost())[0];
        assert!((most - curve.bounds()[1][0]).abs() < 1e-12);
    }
}
