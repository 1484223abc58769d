//! L-BFGS (Nocedal, Wright, *Numerical Optimization*, algorithms 7.4 and 7.5) from the inverse of the mesh's Laplacian, with
//! backtracking.

use super::net::{Freedom, Net, Of, Places};
use crate::geometry::sparse::{Factor, Symmetric, fill_reducing_order};
use std::collections::VecDeque;

/// Pairs that are remembered.
const MEMORY: usize = 8;
/// Halvings of a step in the line search.
const MAX_HALVINGS: usize = 25;
/// Share of the slope by which a step must lower the energy (Armijo).
const SUFFICIENT: f64 = 1e-4;
/// Gains in a row below the tolerance after which a descent ends.
const SMALL_GAINS: usize = 3;
/// What is added to the Laplacian's diagonal.
const SHIFT: f64 = 1e-3;

/// What is minimised.
pub trait Energy {
    /// The energy at `x`, and its gradient; infinite where `x` is not allowed. May bring `x` back onto what it is held on.
    fn value(&mut self, x: &mut [f64], gradient: &mut [f64]) -> f64;

    /// Takes out of a direction at the last point of [`Energy::value`] what leads off that.
    fn make_tangential(&self, _direction: &mut [f64]) {}
}

/// When a descent ends, and how far a step goes.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Most steps.
    pub iterations: usize,
    /// Relative gain that counts as small.
    pub tolerance: f64,
    /// Length to which steps are measured: the first at most a quarter of it, later ones at most twice.
    pub rest: f64,
}

struct Pair {
    s: Vec<f64>,
    y: Vec<f64>,
    /// H₀ y.
    hy: Vec<f64>,
    /// 1 / (s · y).
    rho: f64,
}

/// Goes down from `x`; the energy at the end, infinite if that of the start is.
pub fn descend(net: &Net<'_>, energy: &mut dyn Energy, x: &mut Vec<f64>, bounds: Bounds) -> f64 {
    let Some(factor) = net.preconditioner() else { return f64::INFINITY };
    let n = x.len();
    let inner = |a: &[f64], b: &[f64]| inner(net, a, b);
    let mut gradient = vec![0.0; n];
    let mut value = energy.value(x, &mut gradient);
    if !value.is_finite() {
        return f64::INFINITY;
    }
    let mut solved = solve(factor, &gradient);
    let mut pairs: VecDeque<Pair> = VecDeque::new();
    let (mut next, mut next_gradient) = (x.clone(), gradient.clone());
    let mut small = 0;
    let mut steps = 0;
    while steps < bounds.iterations {
        let mut direction = direction(net, &gradient, &solved, &pairs);
        energy.make_tangential(&mut direction);
        net.even(&mut direction, Of::Direction);
        let slope = inner(&direction, &gradient);
        let found = if slope < 0.0 {
            steps += 1;
            let longest = direction.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
            let reach = if pairs.is_empty() { 0.25 } else { 2.0 } * bounds.rest;
            let mut step = (reach / longest).min(1.0);
            let mut found = None;
            for _ in 0..MAX_HALVINGS {
                for i in 0..n {
                    next[i] = x[i] + step * direction[i];
                }
                let lower = energy.value(&mut next, &mut next_gradient);
                if lower <= value + SUFFICIENT * step * slope {
                    found = Some(lower);
                    break;
                }
                step *= 0.5;
            }
            found
        } else {
            None
        };
        let Some(lower) = found else {
            if pairs.is_empty() {
                break;
            }
            // Once more without what is remembered.
            pairs.clear();
            energy.value(x, &mut gradient);
            continue;
        };
        let next_solved = solve(factor, &next_gradient);
        remember(
            &mut pairs,
            Pair::of([x, &next], [&gradient, &next_gradient], [&solved, &next_solved], inner),
        );
        std::mem::swap(x, &mut next);
        std::mem::swap(&mut gradient, &mut next_gradient);
        solved = next_solved;
        let gain = value - lower;
        value = lower;
        small = if gain <= bounds.tolerance * value.abs() { small + 1 } else { 0 };
        if small >= SMALL_GAINS {
            break;
        }
    }
    value
}

impl Pair {
    fn of(
        [x, next]: [&[f64]; 2],
        [gradient, next_gradient]: [&[f64]; 2],
        [solved, next_solved]: [&[f64]; 2],
        inner: impl Fn(&[f64], &[f64]) -> f64,
    ) -> Self {
        let difference = |a: &[f64], b: &[f64]| b.iter().zip(a).map(|(b, a)| b - a).collect::<Vec<f64>>();
        let (s, y) = (difference(x, next), difference(gradient, next_gradient));
        Self { rho: 1.0 / inner(&s, &y), hy: difference(solved, next_solved), s, y }
    }
}

fn remember(pairs: &mut VecDeque<Pair>, pair: Pair) {
    if pair.rho > 0.0 && pair.rho.is_finite() {
        if pairs.len() == MEMORY {
            pairs.pop_front();
        }
        pairs.push_back(pair);
    }
}

/// −H g by the two-loop recursion, H₀ = γ (Jᵀ L J + 10⁻³ I)⁻¹. H₀ is linear: applied to the gradient and to each y once, when they are
/// new, not to what the first loop leaves.
fn direction(net: &Net<'_>, gradient: &[f64], solved: &[f64], pairs: &VecDeque<Pair>) -> Vec<f64> {
    let mut q = gradient.to_vec();
    let mut h = solved.to_vec();
    let mut alphas = Vec::with_capacity(pairs.len());
    for pair in pairs.iter().rev() {
        let alpha = pair.rho * inner(net, &pair.s, &q);
        add_scaled(&mut q, &pair.y, -alpha);
        add_scaled(&mut h, &pair.hy, -alpha);
        alphas.push(alpha);
    }
    if let Some(last) = pairs.back() {
        let gamma = 1.0 / (last.rho * inner(net, &last.y, &last.hy));
        h.iter_mut().for_each(|value| *value *= gamma);
    }
    for (pair, alpha) in pairs.iter().zip(alphas.into_iter().rev()) {
        let beta = pair.rho * inner(net, &pair.y, &h);
        add_scaled(&mut h, &pair.s, alpha - beta);
    }
    h.iter_mut().for_each(|value| *value = -*value);
    h
}

fn solve(factor: &Factor, gradient: &[f64]) -> Vec<f64> {
    let mut solved = gradient.to_vec();
    factor.solve(&mut solved);
    solved
}

fn add_scaled(a: &mut [f64], b: &[f64], k: f64) {
    for (a, b) in a.iter_mut().zip(b) {
        *a += k * b;
    }
}

/// Products of a vertex are summed first, so that turning a domain by 90° changes no bit.
fn inner(net: &Net<'_>, a: &[f64], b: &[f64]) -> f64 {
    let (m, w) = (net.inner_unknowns, net.width);
    let vertex = |(a, b): (&[f64], &[f64])| match (a, b) {
        ([ax, ay], [bx, by]) => ax * bx + ay * by,
        ([ax, ay, az], [bx, by, bz]) => (ax * bx + ay * by) + az * bz,
        _ => 0.0,
    };
    let inner: f64 = a[..m].chunks_exact(w).zip(b[..m].chunks_exact(w)).map(vertex).sum();
    inner + a[m..].iter().zip(&b[m..]).map(|(a, b)| a * b).sum::<f64>()
}

/// A vertex's unknowns, each with the derivative of the position by it.
pub type Columns = Vec<(u32, [f64; 3])>;

impl Net<'_> {
    /// The factor of Jᵀ L J + 10⁻³ I where the sheet stood at first: L the mesh's Laplacian with equal weights, J the derivative of
    /// positions by unknowns. The order is one of the vertices, which have all their unknowns together.
    pub fn preconditioner(&self) -> Option<&Factor> {
        self.factor.get_or_init(|| self.factorise()).as_ref()
    }

    fn factorise(&self) -> Option<Factor> {
        let mut places = self.places();
        let mut x = self.start();
        if self.width == 2 {
            self.place_in_plan(&x, &mut places);
        } else {
            self.place(&mut x, &mut places);
        }
        let mut matrix = Symmetric { diagonal: vec![SHIFT; self.unknowns], entries: Vec::new() };
        for &[u, v] in &self.sheet.edges.list {
            let (a, b) = (self.columns(&places, u), self.columns(&places, v));
            for &(i, d) in a.iter().chain(&b) {
                matrix.diagonal[i as usize] += d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
            }
            for &(i, d) in &a {
                for &(j, e) in &b {
                    let product = d[0] * e[0] + d[1] * e[1] + d[2] * e[2];
                    if product != 0.0 {
                        matrix.entries.push((i, j, -product));
                    }
                }
            }
        }
        let order = fill_reducing_order(self.freedom.len(), self.sheet.edges.list.iter().copied())?;
        Factor::in_order(&matrix, order.into_iter().flat_map(|v| self.unknowns_of(v)).collect())
    }

    fn columns(&self, places: &Places, v: u32) -> Columns {
        match self.freedom[v as usize] {
            Freedom::Fixed => Vec::new(),
            Freedom::Inner(at) => (0..self.width)
                .map(|k| (at as u32 + k as u32, std::array::from_fn(|j| f64::from(u8::from(j == k)))))
                .collect(),
            Freedom::Slider(at) => vec![(at as u32, places.tangents[at - self.inner_unknowns])],
        }
    }

    /// The numbers of a vertex's unknowns.
    fn unknowns_of(&self, v: u32) -> std::ops::Range<u32> {
        match self.freedom[v as usize] {
            Freedom::Fixed => 0..0,
            Freedom::Inner(at) => at as u32..(at + self.width) as u32,
            Freedom::Slider(at) => at as u32..at as u32 + 1,
        }
    }

    /// The unknown of a slider, and its tangent.
    pub fn slide(&self, places: &Places, v: u32) -> Option<(usize, [f64; 3])> {
        match self.freedom[v as usize] {
            Freedom::Slider(at) => Some((at, places.tangents[at - self.inner_unknowns])),
            _ => None,
        }
    }
}
