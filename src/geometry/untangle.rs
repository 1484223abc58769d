//! Turning folded panels over in plan (Garanzha, Kaporin, Kudryavtseva, Protais, Ray, Sokolov 2021, *Foldover-free maps in 50 lines of
//! code*, ACM TOG 40(4)), boundary vertices sliding along their sides or held.
//!
//! Every corner of a panel is a triangle with a map J from the corner of a square of edge length ℓ. The energy
//! Σ tr JᵀJ / χ(det J) + λ (1 + det² J) / χ(det J) with χ(D) = (D + √(ε² + D²)) / 2 is finite for folded corners too, and ε is
//! lowered until none is left. Boundary edges have ½ (d² + 1) / χ(d), d their arc length ÷ ℓ, so that vertices keep their order; inner
//! vertices that are beyond a smooth loop, or nearly so, are driven back by w f², w doubling from round to round
//! (docs/reference/geometry.md §6.5).

use super::optimise::descent::{Bounds, Energy, descend};
use super::optimise::net::{Net, Places};
use super::vector::Vec3;

/// Weight λ of the part of the energy that asks for equal areas.
const AREA_WEIGHT: f64 = 0.2;
/// Rounds, each with its ε, and steps of a round.
const ROUNDS: usize = 40;
const STEPS: usize = 12;
/// Rounds without a better worst corner after which it gives up.
const PATIENCE: usize = 12;
/// A corner with at least this share of a square's determinant is unfolded well enough.
const ENOUGH: f64 = 1e-3;
/// Smallest ε.
const LEAST_EPSILON: f64 = 1e-4;
/// Steps of evening out.
const EVENING_STEPS: usize = 8;
/// How far inside a smooth loop a vertex is left alone, in ℓ.
const MARGIN: f64 = 0.02;
/// Largest weight w of vertices beyond a smooth loop.
const MOST_WEIGHT: f64 = 1e4;

/// The unknowns of a plan net moved until every corner turns left, boundary vertices keep their order and all are inside; `None` where
/// that is so already. `rest` is ℓ in the net's units. Gives up after a fixed number of steps: the result may still be folded.
pub fn untangle(net: &Net<'_>, rest: f64) -> Option<Vec<f64>> {
    let mut flat = Flat::new(net, rest);
    let mut x = net.start();
    if flat.is_clean(&x) {
        return None;
    }
    let bounds = Bounds { iterations: STEPS, tolerance: 1e-4, rest };
    let (mut best, mut best_round) = (f64::NEG_INFINITY, 0);
    for round in 0..ROUNDS {
        let least = flat.least(&x).min(0.0);
        if least > best {
            (best, best_round) = (least, round);
        } else if round - best_round >= PATIENCE && least < 0.0 {
            break;
        }
        flat.epsilon = (LEAST_EPSILON * LEAST_EPSILON + 0.04 * least * least).sqrt();
        flat.outside_weight = ((1u64 << round) as f64).min(MOST_WEIGHT);
        descend(net, &mut flat, &mut x, bounds);
        if flat.is_clean(&x) {
            break;
        }
    }
    Some(x)
}

/// A few steps more down the same energy, where no corner is folded: panels come nearer to squares of edge length `rest`.
pub fn even_out(net: &Net<'_>, rest: f64, mut x: Vec<f64>) -> Vec<f64> {
    let bounds = Bounds { iterations: EVENING_STEPS, tolerance: 1e-4, rest };
    descend(net, &mut Flat::new(net, rest), &mut x, bounds);
    x
}

struct Flat<'a, 'b> {
    net: &'a Net<'b>,
    /// `[corner, next, previous]` vertices that count.
    corners: Vec<[u32; 3]>,
    rest: f64,
    epsilon: f64,
    outside_weight: f64,
    places: Places,
    by_point: Vec<Vec3>,
}

impl<'a, 'b> Flat<'a, 'b> {
    fn new(net: &'a Net<'b>, rest: f64) -> Self {
        let mut corners = Vec::with_capacity(4 * net.sheet.quads.len());
        for quad in &net.sheet.quads {
            let count = if quad[2] == quad[3] { 3 } else { 4 };
            corners
                .extend((0..count).map(|i| [quad[i], quad[(i + 1) % count], quad[(i + count - 1) % count]]));
        }
        corners.retain(|corner| !net.is_silent[corner[0] as usize]);
        let places = net.places();
        let by_point = vec![[0.0; 3]; places.points.len()];
        Self { net, corners, rest, epsilon: LEAST_EPSILON, outside_weight: 0.0, places, by_point }
    }

    fn place(&mut self, x: &[f64]) {
        self.net.place_in_plan(x, &mut self.places);
    }

    fn is_clean(&mut self, x: &[f64]) -> bool {
        self.least(x) > ENOUGH && !self.is_outside(x)
    }

    fn is_outside(&mut self, x: &[f64]) -> bool {
        self.place(x);
        self.net.is_out_of_order(x) || self.net.is_outside(&self.places)
    }

    /// The least determinant of a corner and, where the boundary slides, the least arc of a boundary edge.
    fn least(&mut self, x: &[f64]) -> f64 {
        self.place(x);
        let scale = 1.0 / (self.rest * self.rest);
        let determinants = self.corners.iter().map(|corner| {
            let (e, f) = arms(&self.places.points, corner);
            (e[0] * f[1] - e[1] * f[0]) * scale
        });
        let arcs = self.net.links.iter().map(|link| self.net.arc(x, link) / self.rest);
        let least = |values: &mut dyn Iterator<Item = f64>| {
            values.fold(f64::INFINITY, |least, v| if v.is_nan() { f64::NEG_INFINITY } else { least.min(v) })
        };
        least(&mut determinants.chain(arcs))
    }

    fn corner_energy(&mut self) -> f64 {
        self.by_point.fill([0.0; 3]);
        let scale = 1.0 / (self.rest * self.rest);
        let mut sum = 0.0;
        for corner in &self.corners {
            let (e, f) = arms(&self.places.points, corner);
            let trace = ((e[0] * e[0] + e[1] * e[1]) + (f[0] * f[0] + f[1] * f[1])) * scale;
            let det = (e[0] * f[1] - e[1] * f[0]) * scale;
            let (chi, slope) = bounded(det, self.epsilon);
            let above = trace + AREA_WEIGHT * (1.0 + det * det);
            sum += above / chi;
            let by_trace = 2.0 * scale / chi;
            let by_det = (2.0 * AREA_WEIGHT * det - above * slope / chi) * scale / chi;
            let ge = [by_trace * e[0] + by_det * f[1], by_trace * e[1] - by_det * f[0]];
            let gf = [by_trace * f[0] - by_det * e[1], by_trace * f[1] + by_det * e[0]];
            for k in 0..2 {
                self.by_point[corner[1] as usize][k] += ge[k];
                self.by_point[corner[2] as usize][k] += gf[k];
                self.by_point[corner[0] as usize][k] -= ge[k] + gf[k];
            }
        }
        sum
    }

    /// w f² of vertices beyond smooth loops; adds the gradient by position.
    fn outside_energy(&mut self) -> f64 {
        if self.outside_weight == 0.0 {
            return 0.0;
        }
        let mut sum = 0.0;
        for (v, depth, way) in self.net.beyond_smooth_loops(&self.places, MARGIN * self.rest) {
            let f = depth / self.rest + MARGIN;
            sum += self.outside_weight * f * f;
            let by_depth = 2.0 * self.outside_weight * f / self.rest;
            for (slope, along) in self.by_point[v as usize].iter_mut().zip(way) {
                *slope += by_depth * along;
            }
        }
        sum
    }

    fn arc_energy(&self, x: &[f64], gradient: &mut [f64]) -> f64 {
        let mut sum = 0.0;
        for link in &self.net.links {
            let d = self.net.arc(x, link) / self.rest;
            let (chi, slope) = bounded(d, self.epsilon);
            let above = d * d + 1.0;
            sum += 0.5 * above / chi;
            let by_arc = 0.5 * (2.0 * d - above * slope / chi) / chi / self.rest;
            for (v, sign) in [(link.from, -1.0), (link.to, 1.0)] {
                if let Some((at, _)) = self.net.slide(&self.places, v) {
                    gradient[at] += sign * by_arc;
                }
            }
        }
        sum
    }
}

impl Energy for Flat<'_, '_> {
    fn value(&mut self, x: &mut [f64], gradient: &mut [f64]) -> f64 {
        self.place(x);
        let sum = self.corner_energy() + self.outside_energy();
        self.net.pull(&self.places, &self.by_point, gradient, true);
        let sum = sum + self.arc_energy(x, gradient);
        if sum.is_finite() { sum } else { f64::INFINITY }
    }
}

/// χ(D) = (D + √(ε² + D²))/2, without cancellation for D < 0, and χ′/χ · χ.
fn bounded(d: f64, epsilon: f64) -> (f64, f64) {
    let root = (epsilon * epsilon + d * d).sqrt();
    let chi = if d >= 0.0 { 0.5 * (d + root) } else { 0.5 * epsilon * epsilon / (root - d) };
    (chi, chi / root)
}

fn arms(points: &[Vec3], [o, u, v]: &[u32; 3]) -> ([f64; 2], [f64; 2]) {
    let (o, u, v) = (points[*o as usize], points[*u as usize], points[*v as usize]);
    ([u[0] - o[0], u[1] - o[1]], [v[0] - o[0], v[1] - o[1]])
}
