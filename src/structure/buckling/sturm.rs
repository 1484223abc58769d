//! Factors by counting alone: K + s Kg has as many negative pivots as there are factors below s.
//!
//! Bisection on that count cannot miss a factor, nor how often it is repeated, nor mistake the order of factors that lie
//! close together (Wilkinson 1965, ch. 5; Bathe 1996, §11.4). It costs a factorisation a step, and is what is used where
//! an iteration has failed or has missed something.

use super::super::solver::Solver;
use super::{Mode, NoConvergence, SAME};
use crate::random;

/// Width of the bracket, beside the factor, at which it is known.
const WIDTH: f64 = 1e-10;
/// Times the least |λ|, of either sign, beyond which is not looked for factors: they are of no use, and soon rounding.
pub const FAR: f64 = 1e8;
/// Steps of the inverse iteration for a shape, and the change of 1/λ at which it ends.
const STEPS: usize = 60;
const SETTLED: f64 = 1e-8;

/// How many factors lie below each s where it was counted, ascending.
struct Counts<'a, 'm> {
    solver: &'a mut Solver<'m>,
    axial: &'a [f64],
    known: Vec<(f64, usize)>,
}

impl Counts<'_, '_> {
    fn at(&mut self, s: f64) -> Result<usize, NoConvergence> {
        let place = self.known.partition_point(|known| known.0 < s);
        match self.known.get(place) {
            Some(known) if known.0 == s => Ok(known.1),
            _ => {
                let count = self.solver.factors_below(self.axial, s).ok_or(NoConvergence)?;
                self.known.insert(place, (s, count));
                Ok(count)
            }
        }
    }

    /// The nearest s below which lie fewer than `k` factors (0 if none was counted), and the nearest above with `k`.
    fn bracket(&self, k: usize) -> (f64, Option<f64>) {
        let first = self.known.iter().position(|known| known.1 >= k);
        let low = first.unwrap_or(self.known.len()).checked_sub(1).map_or(0.0, |i| self.known[i].0);
        (low, first.map(|i| self.known[i].0))
    }

    /// The `k`-th factor between two s, the second not far above; none if there are fewer.
    fn narrow(&mut self, k: usize, scale: f64) -> Result<Option<(f64, f64)>, NoConvergence> {
        loop {
            let (low, high) = self.bracket(k);
            let next = match high {
                // No factor is less than the least |λ|, of which `scale` is about one.
                None if low >= FAR * scale => return Ok(None),
                None => (4.0 * low).clamp(0.5 * scale, FAR * scale),
                Some(high) if high - low <= WIDTH * high => return Ok(Some((low, high))),
                Some(high) if low == 0.0 => 0.25 * high,
                Some(high) if high > 2.0 * low => low.sqrt() * high.sqrt(),
                Some(high) => low + 0.5 * (high - low),
            };
            // Where no number lies between, or only what is as good as nothing.
            if high.is_some_and(|high| next <= low || next >= high) || !(next > 0.0 && next.is_finite()) {
                return Ok(high.filter(|high| *high > f64::MIN_POSITIVE).map(|high| (low, high)));
            }
            self.at(next)?;
        }
    }
}

/// The first `count` factors, ascending and as often as they are repeated; `hints`: what they may be.
///
/// # Errors
/// [`NoConvergence`] if a pivot is not a number.
pub fn factors(
    solver: &mut Solver<'_>,
    axial: &[f64],
    count: usize,
    hints: &[f64],
) -> Result<Vec<f64>, NoConvergence> {
    let scale = least(solver, axial, hints);
    let mut counts = Counts { solver, axial, known: Vec::new() };
    for hint in hints {
        // A repeated one is counted once.
        if counts.known.last().is_none_or(|known| *hint > known.0) {
            counts.at(hint * (1.0 - SAME))?;
            counts.at(hint * (1.0 + SAME))?;
        }
    }
    let mut found = Vec::new();
    while found.len() < count {
        let Some((low, high)) = counts.narrow(found.len() + 1, scale)? else { break };
        let there = counts.at(high)?;
        found.resize(there.min(count), 0.5 * (low + high));
    }
    Ok(found)
}

/// The first mode; `hints`: what its factor may be.
///
/// # Errors
/// [`NoConvergence`] if a pivot is not a number.
pub fn first(solver: &mut Solver<'_>, axial: &[f64], hints: &[f64]) -> Result<Option<Mode>, NoConvergence> {
    let Some(&factor) = factors(solver, axial, 1, hints)?.first() else { return Ok(None) };
    // With a factor of K + s Kg just below, the mode and those as good as equal to it grow far beyond all others.
    let below = [1e-9, 1e-7, 1e-5, 1e-3].into_iter().find(|d| solver.is_definite(axial, factor * (1.0 - d)));
    let below = below.ok_or(NoConvergence)?;
    solver.factorise_shifted(axial, factor * (1.0 - below)).map_err(|_| NoConvergence)?;
    let mut rng = random::stream(0x7374_7572, 0, 0);
    let mut shape: Vec<f64> = (0..solver.system().unknowns()).map(|_| random::unit(&mut rng) - 0.5).collect();
    solver.solve_as_factorised(&mut shape);
    let (mut image, mut before) = (vec![0.0; shape.len()], 0.0f64);
    for _ in 0..STEPS {
        let size = shape.iter().fold(0.0f64, |a, v| a.max(v.abs()));
        if !(size > 0.0 && size.is_finite()) {
            return Err(NoConvergence);
        }
        shape.iter_mut().for_each(|v| *v /= size);
        solver.minus_geometric(axial, &shape, &mut image);
        solver.solve_as_factorised(&mut image);
        std::mem::swap(&mut shape, &mut image);
        let grown = shape.iter().fold(0.0f64, |a, v| a.max(v.abs()));
        if (grown - before).abs() <= SETTLED * grown {
            break;
        }
        before = grown;
    }
    Ok(Some(Mode { factor, shape }))
}

/// About the least |λ|, of either sign: the first hint, else what a few steps of the power method with K⁻¹ Kg give.
fn least(solver: &mut Solver<'_>, axial: &[f64], hints: &[f64]) -> f64 {
    if let Some(first) = hints.first() {
        return *first;
    }
    let (_, growth) = most_bent(solver, axial);
    if growth > 0.0 && growth.is_finite() { 1.0 / growth } else { 1.0 }
}

/// A few steps of the power method with K⁻¹ Kg: the shape, and how much the last step made it grow.
pub fn most_bent(solver: &mut Solver<'_>, axial: &[f64]) -> (Vec<f64>, f64) {
    let mut rng = random::stream(0x7374_7572, 1, 0);
    let n = solver.system().unknowns();
    let mut v: Vec<f64> = (0..n).map(|_| random::unit(&mut rng) - 0.5).collect();
    solver.solve(&mut v);
    let mut image = vec![0.0; n];
    let mut growth = 0.0;
    for _ in 0..8 {
        let size = v.iter().fold(0.0f64, |a, v| a.max(v.abs()));
        v.iter_mut().for_each(|v| *v /= size);
        solver.minus_geometric(axial, &v, &mut image);
        solver.solve(&mut image);
        growth = image.iter().fold(0.0f64, |a, v| a.max(v.abs()));
        std::mem::swap(&mut v, &mut image);
    }
    (v, growth)
}
