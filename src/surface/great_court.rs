//! The roof of the British Museum's Great Court (Williams 2001, *The analytic and numerical definition of the geometry of the
//! British Museum Great Court Roof*; docs/reference/geometry.md §4).

use super::height::HeightFunction;
use crate::expression::algebra::Algebra;
use crate::expression::dual::Dual;
use crate::simd::{Vector, with_vectors};
use pulp::{Simd, WithSimd};

/// Radius of the reading room's circle about the origin, m.
const A: f64 = 22.245;
/// Half width in x, m.
const B: f64 = 36.625;
/// Distance of the north wall, m.
const C: f64 = 46.025;
/// Distance of the south wall, m.
const D: f64 = 51.125;
/// Weight λ of the third function.
const LAMBDA: f64 = 0.5;
/// Decay μ of the third function towards the corners.
const MU: f64 = 14.0;
/// Height at the circle, m.
const H1: f64 = 20.955;
/// Height at the walls, m.
const H0: f64 = 19.71;
/// How far outside still counts as on the rim, m.
const RIM: f64 = 1e-6;

/// The analytic roof between the four walls and the circle. Beyond them the height is that of the nearest wall or of the
/// circle.
#[derive(Clone, Copy, Debug)]
pub struct GreatCourt;

impl HeightFunction for GreatCourt {
    fn z(&self, x: f64, y: f64) -> f64 {
        let (x, y) = within_walls(x, y);
        rim(x, y).unwrap_or_else(|| roof(x, y))
    }

    fn lift_all(&self, points: &mut [[f64; 3]]) {
        with_vectors(Heights(points));
    }

    fn lift_all_with_slopes(&self, points: &mut [[f64; 3]], slopes: &mut [[f64; 2]]) {
        with_vectors(HeightsAndSlopes(points, slopes));
    }

    fn gradient(&self, x: f64, y: f64) -> [f64; 2] {
        let (x, y) = within_walls(x, y);
        if is_level(x, y) {
            return [0.0; 2];
        }
        let [x, y] = Dual::variables(x, y);
        roof(x, y).slope
    }

    fn covers(&self, x: f64, y: f64) -> bool {
        let outer = x.abs() <= B + RIM && (-D - RIM..=C + RIM).contains(&y);
        outer && x * x + y * y >= (A - RIM) * (A - RIM)
    }

    fn extent(&self) -> String {
        format!(
            "the roof is between |x| ≤ {B}, −{D} ≤ y ≤ {C} and the circle of radius {A} m about the origin"
        )
    }
}

/// The heights of points.
struct Heights<'a>(&'a mut [[f64; 3]]);

impl WithSimd for Heights<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for batch in self.0.chunks_mut(Vector::<S>::LANES) {
            let [x, y] = plan(simd, batch);
            let z = roof(x, y);
            for (l, point) in batch.iter_mut().enumerate() {
                point[2] = rim(x.numbers()[l], y.numbers()[l]).unwrap_or(z.numbers()[l]);
            }
        }
    }
}

/// The heights of points, and the slopes there.
struct HeightsAndSlopes<'a>(&'a mut [[f64; 3]], &'a mut [[f64; 2]]);

impl WithSimd for HeightsAndSlopes<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let lanes = Vector::<S>::LANES;
        for (batch, slopes) in self.0.chunks_mut(lanes).zip(self.1.chunks_mut(lanes)) {
            let [x, y] = plan(simd, batch);
            let [dual_x, dual_y] = Dual::variables(x, y);
            let Dual { value: z, slope: [by_x, by_y] } = roof(dual_x, dual_y);
            for (l, (point, slope)) in batch.iter_mut().zip(slopes).enumerate() {
                let (x, y) = (x.numbers()[l], y.numbers()[l]);
                point[2] = rim(x, y).unwrap_or(z.numbers()[l]);
                *slope = if is_level(x, y) { [0.0; 2] } else { [by_x.numbers()[l], by_y.numbers()[l]] };
            }
        }
    }
}

/// Points in plan, within the walls; the last again where there are fewer than lanes.
#[inline(always)]
fn plan<S: Simd>(simd: S, batch: &[[f64; 3]]) -> [Vector<S>; 2] {
    let at = |l: usize| {
        let point = &batch[l.min(batch.len() - 1)];
        within_walls(point[0], point[1])
    };
    [Vector::of(simd, |l| at(l).0), Vector::of(simd, |l| at(l).1)]
}

/// Where the formula has no slope: in the corners, and within the circle.
#[inline(always)]
fn is_level(x: f64, y: f64) -> bool {
    (x.abs() >= B && (y >= C || y <= -D)) || (x * x + y * y).sqrt() <= A
}

/// The nearest point within the walls.
#[inline]
fn within_walls(x: f64, y: f64) -> (f64, f64) {
    (x.clamp(-B, B), y.clamp(-D, C))
}

/// The height where it is known without the formula: within the circle, and on the walls, which saves boundary points from it. In
/// the corners the formula is 0/0.
#[inline]
fn rim(x: f64, y: f64) -> Option<f64> {
    if x.abs() >= B || y >= C || y <= -D {
        Some(H0)
    } else if (x * x + y * y).sqrt() <= A {
        Some(H1)
    } else {
        None
    }
}

/// z = z₁ + z₂ + z₃ inside the walls (|x| ≤ b, −d ≤ y ≤ c) and outside the circle, but for the corners.
///
/// On the walls Σ q of β is infinite; so β is written with the four wall distances multiplied out, which leaves 0/0 in the
/// corners alone.
#[inline(always)]
fn roof<T: Algebra>(x: T, y: T) -> T {
    let r = (x * x + y * y).sqrt();
    let sin = y / r;
    let sin2 = sin * sin;
    let (east, west) = (-(x - B), x + B);
    let (north, south) = (-(y - C), y + D);
    let walls = east * west * north * south;
    let shrink = r.constant(A) / r;
    let psi = walls * (1.0 / (B * B * C * D));
    let (u, v) = (shrink * x * (1.0 / B), shrink * y);
    let eta = psi / ((u * u).complement() * (v * (1.0 / C)).complement() * (v * (1.0 / D) + 1.0));
    let z1 = eta * (H1 - H0) + H0;
    let beyond = r * (1.0 / A) - 1.0;
    let z2 = second(beyond, psi, sin, sin2);
    let (east2, west2, north2, south2) = (east * east, west * west, north * north, south * south);
    let sum = (east2 + north2).sqrt() * (west * south)
        + (east2 + south2).sqrt() * (west * north)
        + (west2 + north2).sqrt() * (east * south)
        + (west2 + south2).sqrt() * (east * north);
    let beta = shrink.complement() * walls / sum;
    z1 + z2 + beta * third(east, north, south, sin, sin2)
}

/// z₂, with `beyond` = r/a − 1; uses (1 + cos 2θ)/2 = 1 − sin²θ and (1 − cos 2θ)/2 = sin²θ.
#[inline(always)]
fn second<T: Algebra>(beyond: T, psi: T, sin: T, sin2: T) -> T {
    let alpha = beyond * psi;
    let cos2 = sin2.complement();
    let n = sin2 + sin;
    let m = sin2 - sin;
    let bracket = (psi * 10.0 + 35.0) * cos2 + n * 12.0 + (psi * 12.0 + 7.5) * m - 1.6;
    let ripple = n * n * 2.5 * (alpha * 3.0).complement() + m * m * 0.625 * beyond * beyond;
    alpha * (bracket * (1.0 - LAMBDA) - cos2 * 10.0 + ripple)
}

/// z₃/β; e^(−μ(1+x/b)) is e^(−2μ) / e^(−μ(1−x/b)), which saves one of four exponentials.
#[inline(always)]
fn third<T: Algebra>(east: T, north: T, south: T, sin: T, sin2: T) -> T {
    /// e^(−2μ) for μ = 14.
    const E_2MU: f64 = 6.914_400_106_940_203e-13;
    let smooth = sin2.complement() * 3.5 + sin2 * 3.0 + sin * 0.3;
    let at_east = (east * (-MU / B)).exp_bounded();
    let in_x = at_east + at_east.constant(E_2MU) / at_east;
    let in_y = (north * (-MU / C)).exp_bounded() + (south * (-MU / D)).exp_bounded();
    smooth * LAMBDA + in_x * 1.05 * in_y
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::{HeightSurface, Surface};

    /// The table of docs/reference/geometry.md §4.
    const TABLE: [(f64, f64, f64); 8] = [
        (30.0, 20.0, 23.636645776870374),
        (-30.0, 20.0, 23.636645776870374),
        (0.0, 40.0, 24.862344852734996),
        (0.0, -40.0, 27.014456478924764),
        (30.0, -45.0, 22.52685024630962),
        (10.0, -30.0, 26.78151684956868),
        (36.0, 45.0, 20.064447503913726),
        (-25.0, -10.0, 23.04081921131406),
    ];

    #[test]
    fn heights_of_the_table() {
        for (x, y, z) in TABLE {
            assert!((GreatCourt.z(x, y) - z).abs() < 1e-12, "z({x}, {y}) = {}", GreatCourt.z(x, y));
        }
    }

    #[test]
    fn walls_corners_and_circle() {
        for i in 0..=40 {
            let t = f64::from(i) / 40.0;
            for (x, y) in [
                (B, -D + t * (C + D)),
                (-B, -D + t * (C + D)),
                (-B + t * 2.0 * B, C),
                (-B + t * 2.0 * B, -D),
                // a little outside
                (B + 1e-3, -D + t * (C + D)),
                (-B + t * 2.0 * B, C + 5.0),
            ] {
                assert_eq!(GreatCourt.z(x, y), H0, "({x}, {y})");
            }
            let angle = t * std::f64::consts::TAU;
            for radius in [A, A - 1e-9, A + 1e-9, 0.5 * A] {
                let z = GreatCourt.z(radius * libm::cos(angle), radius * libm::sin(angle));
                assert!((z - H1).abs() < 1e-7, "circle at {angle}: {z}");
            }
        }
        assert_eq!(GreatCourt.z(0.0, 0.0), H1);
        assert!(GreatCourt.gradient(B, C).iter().all(|g| g.is_finite()));
    }

    /// The formula as it stands in docs/reference/geometry.md §4, term by term.
    fn as_printed(x: f64, y: f64) -> f64 {
        let r = x.hypot(y);
        let (a, b, c, d) = (A, B, C, D);
        let (sin, cos2) = (y / r, 1.0 - 2.0 * (y / r) * (y / r));
        let psi = (1.0 - x / b) * (1.0 + x / b) * (1.0 - y / c) * (1.0 + y / d);
        let ax = a * x / (r * b);
        let eta = psi / ((1.0 - ax) * (1.0 + ax) * (1.0 - a * y / (r * c)) * (1.0 + a * y / (r * d)));
        let alpha = (r / a - 1.0) * psi;
        let q = |p: f64, s: f64| p.hypot(s) / (p * s);
        let beta = (1.0 - a / r) / (q(b - x, c - y) + q(b - x, d + y) + q(b + x, c - y) + q(b + x, d + y));
        let n = (1.0 - cos2) / 2.0 + sin;
        let m = (1.0 - cos2) / 2.0 - sin;
        let z1 = (H1 - H0) * eta + H0;
        let z2 = alpha
            * ((1.0 - LAMBDA)
                * ((35.0 + 10.0 * psi) * (1.0 + cos2) / 2.0 + 12.0 * n + (7.5 + 12.0 * psi) * m - 1.6)
                - 5.0 * (1.0 + cos2)
                + 10.0 * (n / 2.0) * (n / 2.0) * (1.0 - 3.0 * alpha)
                + 2.5 * (m / 2.0) * (m / 2.0) * (r / a - 1.0) * (r / a - 1.0));
        let e = |t: f64| (-MU * t).exp();
        let z3 = beta
            * (LAMBDA * (1.75 * (1.0 + cos2) + 1.5 * (1.0 - cos2) + 0.3 * sin)
                + 1.05 * (e(1.0 - x / b) + e(1.0 + x / b)) * (e(1.0 - y / c) + e(1.0 + y / d)));
        z1 + z2 + z3
    }

    #[test]
    fn the_same_as_the_printed_formula_all_over() {
        let mut worst = 0.0f64;
        for i in 0..200 {
            for j in 0..200 {
                let x = -B + (f64::from(i) + 0.5) / 200.0 * 2.0 * B;
                let y = -D + (f64::from(j) + 0.5) / 200.0 * (C + D);
                if x.hypot(y) > A {
                    worst = worst.max((GreatCourt.z(x, y) - as_printed(x, y)).abs());
                }
            }
        }
        assert!(worst < 1e-12, "{worst:e}");
    }

    #[test]
    fn many_points_have_the_heights_of_each() {
        let mut rng = crate::random::stream(3, 0, 0);
        let mut number = |from: f64, to: f64| from + (to - from) * crate::random::unit(&mut rng);
        // Also within the circle, beyond the walls, and in the corners.
        let mut points: Vec<[f64; 3]> =
            (0..5_003).map(|_| [number(-40.0, 40.0), number(-55.0, 50.0), 0.0]).collect();
        points.extend([[B, C, 0.0], [-B, C, 0.0], [B, -D, 0.0], [-B, -D, 0.0], [50.0, 60.0, 0.0]]);
        let each: Vec<f64> = points.iter().map(|p| GreatCourt.z(p[0], p[1])).collect();
        HeightSurface(GreatCourt).project_all(&mut points);
        assert!(points.iter().zip(&each).all(|(p, z)| p[2].to_bits() == z.to_bits()));
    }

    #[test]
    fn gradient_is_that_of_the_height() {
        let h = 1e-5;
        for (x, y, _) in TABLE {
            let g = GreatCourt.gradient(x, y);
            let dx = (GreatCourt.z(x + h, y) - GreatCourt.z(x - h, y)) / (2.0 * h);
            let dy = (GreatCourt.z(x, y + h) - GreatCourt.z(x, y - h)) / (2.0 * h);
            assert!((g[0] - dx).abs() < 1e-7 && (g[1] - dy).abs() < 1e-7, "{g:?} {dx} {dy}");
        }
    }

    #[test]
    fn covers_what_lies_between_walls_and_circle() {
        let roof = HeightSurface(GreatCourt);
        assert!(roof.height(30.0, 20.0).is_some());
        assert!(roof.height(0.0, 0.0).is_none());
        assert!(roof.height(40.0, 0.0).is_none());
        assert!(roof.height(B, C).is_some());
        assert_eq!(roof.project([30.0, 20.0, 0.0])[..2], [30.0, 20.0]);
    }
}
