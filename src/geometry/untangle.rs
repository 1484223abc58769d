//! Turning folded panels over in plan, the boundary held (Garanzha, Kaporin, Kudryavtseva, Protais, Ray, Sokolov 2021,
//! *Foldover-free maps in 50 lines of code*, ACM TOG 40(4)).
//!
//! Every corner of a panel is a triangle with a map J from the corner of a square of the pattern's size. The energy
//! Σ tr JᵀJ / χ(det J) + λ (1 + det² J) / χ(det J) with χ(D) = (D + √(ε² + D²)) / 2 is finite for folded corners too, and ε is
//! lowered until none is left. Minimised by L-BFGS that starts from the inverse of the graph Laplacian.

use super::laplacian::{Laplacian, Weights};

/// Weight λ of the part of the energy that asks for equal areas.
const AREA_WEIGHT: f64 = 0.2;
/// Rounds, each with its ε, and steps of L-BFGS in a round.
const ROUNDS: usize = 40;
const STEPS: usize = 12;
/// Pairs that L-BFGS remembers.
const MEMORY: usize = 6;
/// Halvings of a step in the line search.
const MAX_HALVINGS: usize = 30;
/// A corner with at least this share of a square's determinant is unfolded well enough.
const ENOUGH: f64 = 1e-3;
/// Smallest ε.
const LEAST_EPSILON: f64 = 1e-4;
/// Steps of evening out.
const EVENING_STEPS: usize = 8;

/// A plan point, m.
pub type Point = [f64; 2];

/// The corner triangles that the free vertices can change.
pub struct Corners {
    /// `[corner, next, previous]` vertices.
    triples: Vec<[u32; 3]>,
}

impl Corners {
    /// All corners of the quads, and one of each triangle (last vertex twice), that have a free vertex.
    pub fn of(quads: &[[u32; 4]], is_fixed: &[bool]) -> Self {
        let mut triples = Vec::with_capacity(4 * quads.len());
        for q in quads {
            let corners = if q[2] == q[3] { 1 } else { 4 };
            for i in 0..corners {
                let previous = if corners == 1 { q[2] } else { q[(i + 3) % 4] };
                let triple = [q[i], q[(i + 1) % 4], previous];
                if triple.iter().any(|&v| !is_fixed[v as usize]) {
                    triples.push(triple);
                }
            }
        }
        Self { triples }
    }

    /// Whether some corner turns right or is flat.
    pub fn are_tangled(&self, plan: &[Point]) -> bool {
        self.triples.iter().any(|t| {
            let (e, f) = arms(plan, t);
            e[0] * f[1] - e[1] * f[0] <= 0.0
        })
    }

    fn least_determinant(&self, plan: &[Point], size: f64) -> f64 {
        let scale = 1.0 / (size * size);
        self.triples
            .iter()
            .map(|t| {
                let (e, f) = arms(plan, t);
                (e[0] * f[1] - e[1] * f[0]) * scale
            })
            .fold(f64::INFINITY, f64::min)
    }

    /// The energy, and its gradient by vertex.
    fn energy(&self, plan: &[Point], size: f64, epsilon: f64, gradient: &mut [Point]) -> f64 {
        gradient.fill([0.0; 2]);
        let scale = 1.0 / (size * size);
        let mut sum = 0.0;
        for t in &self.triples {
            let (e, f) = arms(plan, t);
            let trace = (e[0] * e[0] + e[1] * e[1] + f[0] * f[0] + f[1] * f[1]) * scale;
            let det = (e[0] * f[1] - e[1] * f[0]) * scale;
            let root = (epsilon * epsilon + det * det).sqrt();
            // χ = (D + √(ε² + D²))/2 without cancellation for D < 0.
            let chi = if det >= 0.0 { 0.5 * (det + root) } else { 0.5 * epsilon * epsilon / (root - det) };
            let slope = chi / root;
            let above = trace + AREA_WEIGHT * (1.0 + det * det);
            sum += above / chi;
            let by_trace = 2.0 * scale / chi;
            let by_det = (2.0 * AREA_WEIGHT * det - above * slope / chi) * scale / chi;
            let ge = [by_trace * e[0] + by_det * f[1], by_trace * e[1] - by_det * f[0]];
            let gf = [by_trace * f[0] - by_det * e[1], by_trace * f[1] + by_det * e[0]];
            for k in 0..2 {
                gradient[t[1] as usize][k] += ge[k];
                gradient[t[2] as usize][k] += gf[k];
                gradient[t[0] as usize][k] -= ge[k] + gf[k];
            }
        }
        sum
    }
}

fn arms(plan: &[Point], [o, u, v]: &[u32; 3]) -> (Point, Point) {
    let (o, u, v) = (plan[*o as usize], plan[*u as usize], plan[*v as usize]);
    ([u[0] - o[0], u[1] - o[1]], [v[0] - o[0], v[1] - o[1]])
}

/// Moves the free vertices until every corner turns left; does nothing if that is so already. `size` is the edge length of
/// the square that has a panel's mean area, m. Gives up after a fixed number of steps: the result may still be folded.
pub fn untangle(plan: &mut [Point], corners: &Corners, edges: &[[u32; 2]], is_fixed: &[bool], size: f64) {
    if !corners.are_tangled(plan) {
        return;
    }
    let Some(laplacian) = Laplacian::new(edges, Weights::Equal, is_fixed) else { return };
    for _ in 0..ROUNDS {
        let least = corners.least_determinant(plan, size);
        if least > ENOUGH || least.is_nan() {
            return;
        }
        let epsilon = (LEAST_EPSILON * LEAST_EPSILON + 0.04 * least.min(0.0) * least.min(0.0)).sqrt();
        descend(plan, corners, &laplacian, is_fixed, size, epsilon, STEPS);
    }
}

/// A few steps more down the same energy, where no corner is folded: panels come nearer to squares of edge length `size`.
pub fn even_out(plan: &mut [Point], corners: &Corners, edges: &[[u32; 2]], is_fixed: &[bool], size: f64) {
    if let Some(laplacian) = Laplacian::new(edges, Weights::Equal, is_fixed) {
        descend(plan, corners, &laplacian, is_fixed, size, LEAST_EPSILON, EVENING_STEPS);
    }
}

/// One difference of positions and of gradients, and 1 / (s · y).
struct Pair {
    s: Vec<Point>,
    y: Vec<Point>,
    rho: f64,
}

/// L-BFGS (Nocedal, Wright, *Numerical Optimization*, algorithms 7.4 and 7.5) with backtracking.
fn descend(
    plan: &mut [Point],
    corners: &Corners,
    laplacian: &Laplacian<'_>,
    is_fixed: &[bool],
    size: f64,
    epsilon: f64,
    steps: usize,
) {
    let n = plan.len();
    let mut gradient = vec![[0.0; 2]; n];
    let mut energy = corners.energy(plan, size, epsilon, &mut gradient);
    hold(&mut gradient, is_fixed);
    let mut next_gradient = gradient.clone();
    let mut next = plan.to_vec();
    let mut pairs: Vec<Pair> = Vec::new();
    for _ in 0..steps {
        let direction = direction(&gradient, &pairs, laplacian);
        let slope = inner(&direction, &gradient);
        if slope.is_nan() || slope >= 0.0 {
            return;
        }
        // The first step of a round has no scale of its own: it moves no vertex by more than a panel.
        let longest = direction.iter().map(|d| d[0].abs().max(d[1].abs())).fold(0.0, f64::max);
        let mut step = if pairs.is_empty() { (size / longest).min(1.0) } else { 1.0 };
        let mut lower = None;
        for _ in 0..MAX_HALVINGS {
            for i in 0..n {
                next[i] = [plan[i][0] + step * direction[i][0], plan[i][1] + step * direction[i][1]];
            }
            let found = corners.energy(&next, size, epsilon, &mut next_gradient);
            if found <= energy + 1e-4 * step * slope {
                lower = Some(found);
                break;
            }
            step *= 0.5;
        }
        let Some(found) = lower else { return };
        hold(&mut next_gradient, is_fixed);
        let s: Vec<Point> = direction.iter().map(|d| [step * d[0], step * d[1]]).collect();
        let y: Vec<Point> =
            next_gradient.iter().zip(&gradient).map(|(a, b)| [a[0] - b[0], a[1] - b[1]]).collect();
        let product = inner(&s, &y);
        if product > 0.0 {
            if pairs.len() == MEMORY {
                pairs.remove(0);
            }
            pairs.push(Pair { s, y, rho: 1.0 / product });
        }
        plan.copy_from_slice(&next);
        std::mem::swap(&mut gradient, &mut next_gradient);
        let gain = energy - found;
        energy = found;
        if gain <= 1e-4 * energy {
            return;
        }
    }
}

/// −H g by the two-loop recursion, H₀ = γ L⁻¹.
fn direction(gradient: &[Point], pairs: &[Pair], laplacian: &Laplacian<'_>) -> Vec<Point> {
    let mut q = gradient.to_vec();
    let mut alphas = Vec::with_capacity(pairs.len());
    for pair in pairs.iter().rev() {
        let alpha = pair.rho * inner(&pair.s, &q);
        add_scaled(&mut q, &pair.y, -alpha);
        alphas.push(alpha);
    }
    precondition(&mut q, laplacian);
    if let Some(last) = pairs.last() {
        let mut hy = last.y.clone();
        precondition(&mut hy, laplacian);
        let gamma = 1.0 / (last.rho * inner(&last.y, &hy));
        for point in &mut q {
            *point = [gamma * point[0], gamma * point[1]];
        }
    }
    for (pair, alpha) in pairs.iter().zip(alphas.into_iter().rev()) {
        let beta = pair.rho * inner(&pair.y, &q);
        add_scaled(&mut q, &pair.s, alpha - beta);
    }
    for point in &mut q {
        *point = [-point[0], -point[1]];
    }
    q
}

fn precondition(values: &mut [Point], laplacian: &Laplacian<'_>) {
    for k in 0..2 {
        let mut column = vec![0.0; values.len()];
        laplacian.solve(&mut column, |_| 0.0, |v| values[v][k]);
        for (value, c) in values.iter_mut().zip(column) {
            value[k] = c;
        }
    }
}

fn hold(gradient: &mut [Point], is_fixed: &[bool]) {
    for (g, _) in gradient.iter_mut().zip(is_fixed).filter(|(_, fixed)| **fixed) {
        *g = [0.0; 2];
    }
}

fn inner(a: &[Point], b: &[Point]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a[0] * b[0] + a[1] * b[1]).sum()
}

fn add_scaled(a: &mut [Point], b: &[Point], k: f64) {
    for (a, b) in a.iter_mut().zip(b) {
        *a = [a[0] + k * b[0], a[1] + k * b[1]];
    }
}
