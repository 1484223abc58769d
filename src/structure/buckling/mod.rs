//! Linear buckling: the smallest positive λ of (K + λ Kg) φ = 0.
//!
//! Found by an eigenvalue iteration, and then *counted*: K is positive definite, so that K + s Kg has as many negative
//! pivots as there are factors between 0 and s (Sylvester's law of inertia; Sturm sequence). What an iteration has
//! missed, be it the seventh of seven equal columns or the heaviest of many nearly equal ones, shows in that count; the
//! factors are then found by counting alone (`sturm`), as often as they are repeated.

mod dense;
mod lanczos;
mod sturm;

use super::solver::Solver;
use lanczos::Lanczos;

/// A buckling mode.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Load factor λ.
    pub factor: f64,
    /// Shape φ, in elimination order.
    pub shape: Vec<f64>,
}

/// No factor could be told: the pivots of K + s Kg are not numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoConvergence;

/// Why there are no factors that one can rely on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoFactors {
    /// See [`NoConvergence`].
    NoConvergence,
    /// Rounding changes solutions by this share, too much for a count of pivots to prove anything.
    IllConditioned(f64),
}

impl From<NoConvergence> for NoFactors {
    fn from(_: NoConvergence) -> Self {
        Self::NoConvergence
    }
}

/// What an iteration is to find.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Search {
    /// How many modes.
    modes: usize,
    /// Residual relative to the eigenvalue at which a mode counts as found; its λ is better than the square of that
    /// over its distance from the next.
    tolerance: f64,
    /// How often solutions with K are corrected.
    corrections: usize,
}

/// What an iteration has found, which may not be all.
struct Found {
    /// λ ascending.
    modes: Vec<Mode>,
    /// The largest |ν| = 1/|λ|, of either sign.
    largest: f64,
    /// The residual reached.
    tolerance: f64,
}

/// Up to this many unknowns, or this many for each mode, the dense problem is solved.
const DENSE: usize = 150;
const DENSE_A_MODE: usize = 4;
/// Of ν beside the largest |ν|, below which there is no factor but rounding.
const NOTHING: f64 = 1e-10;
/// Residual of the modes of [`factors`], and what may have been reached instead to be believed.
const FINE: f64 = 1e-8;
const BELIEVED: f64 = 1e-7;
/// How many modes are looked at for what rounding does to them; the share that it may change solutions by without a
/// correction, and the one beyond which corrections do not help; and how many then are made.
const LOOKED_AT: usize = 4;
const CORRECTED: f64 = 1e-9;
const HOPELESS: f64 = 1e-2;
const CORRECTIONS: usize = 3;
/// How far from a factor, in shares that rounding changes solutions by, a count is believed.
const MARGIN: f64 = 20.0;
/// Factors between these shares apart are counted one by one.
const EQUAL: f64 = 1e-11;
const APART: f64 = 1e-5;
/// How far below the first factor, in residuals, none may lie.
const BELOW: f64 = 4.0;
/// How far below the last of several factors, beside it, is counted: factors nearer than that are one.
const SAME: f64 = 2e-9;

/// The first mode, whose factor no other lies below; none if no load of this direction buckles the structure.
///
/// `axial`: N of each member, tension positive. `tolerance`: residual of the mode relative to 1/λ; the factor is better
/// than the square of that over its distance from the next.
///
/// # Errors
/// [`NoConvergence`].
pub fn first(solver: &mut Solver<'_>, axial: &[f64], tolerance: f64) -> Result<Option<Mode>, NoConvergence> {
    let Some(found) = iterate(solver, axial, Search { modes: 1, tolerance, corrections: 0 }) else {
        return Ok(None);
    };
    if let Ok(Found { modes, largest, tolerance: reached }) = &found {
        let below = match modes.first() {
            Some(mode) => mode.factor * (1.0 - BELOW * reached),
            None => sturm::FAR / largest,
        };
        if *reached <= tolerance.max(BELIEVED) && solver.is_definite(axial, below) {
            return Ok(modes.first().cloned());
        }
    }
    sturm::first(solver, axial, &hints(&found))
}

/// The first `count` factors, ascending, each as often as it is repeated; fewer if there are no more below 1e8 times the
/// least |λ|.
///
/// # Errors
/// [`NoFactors`].
pub fn factors(solver: &mut Solver<'_>, axial: &[f64], count: usize) -> Result<Vec<f64>, NoFactors> {
    let free = solver.system().held().iter().filter(|h| !**h).count();
    let modes = count.min(free);
    let mut search = Search { modes, tolerance: FINE, corrections: 0 };
    let Some(mut found) = iterate(solver, axial, search) else {
        return Ok(Vec::new());
    };
    let rounding = rounding(solver, axial, &found);
    if rounding > CORRECTED {
        if rounding.is_nan() || rounding > HOPELESS {
            return Err(NoFactors::IllConditioned(rounding));
        }
        search.corrections = CORRECTIONS;
        found = Lanczos::new(solver, axial, search).run();
    }
    let known = hints(&found);
    // A count tells nothing of factors nearer than rounding moves them.
    let margin = SAME.max(MARGIN * rounding);
    if let Ok(found) = &found
        && found.tolerance <= BELIEVED
        && (rounding > CORRECTED || !is_near(&known))
    {
        let below = match known.last() {
            Some(last) if known.len() == modes => last * (1.0 - margin),
            _ => sturm::FAR / found.largest,
        };
        let there = known.iter().filter(|factor| **factor < below).count();
        if solver.factors_below(axial, below) == Some(there) {
            return Ok(known);
        }
    }
    if rounding > CORRECTED {
        return Err(NoFactors::IllConditioned(rounding));
    }
    Ok(sturm::factors(solver, axial, modes, &known)?)
}

/// Whether some of the factors are neither apart nor equal: what an iteration then gives may be mixtures.
fn is_near(factors: &[f64]) -> bool {
    factors.windows(2).any(|two| {
        let apart = (two[1] - two[0]) / two[1];
        apart > EQUAL && apart < APART
    })
}

/// The share by which rounding changes solutions with K in the directions of the first modes; where none was found, in
/// that which the axial forces bend most.
fn rounding(solver: &mut Solver<'_>, axial: &[f64], found: &Result<Found, NoConvergence>) -> f64 {
    let mut shapes: Vec<Vec<f64>> =
        found.iter().flat_map(|found| &found.modes).take(LOOKED_AT).map(|mode| mode.shape.clone()).collect();
    if shapes.is_empty() {
        shapes.push(sturm::most_bent(solver, axial).0);
    }
    let mut worst = 0.0f64;
    for shape in shapes {
        let mut image = vec![0.0; shape.len()];
        solver.minus_geometric(axial, &shape, &mut image);
        worst = worst.max(solver.solve_corrected(&mut image, 1));
    }
    worst
}

/// The factors that an iteration gave, ascending.
fn hints(found: &Result<Found, NoConvergence>) -> Vec<f64> {
    found.iter().flat_map(|found| &found.modes).map(|mode| mode.factor).collect()
}

/// The iteration that suits the size; none where there is nothing to find.
fn iterate(solver: &mut Solver<'_>, axial: &[f64], search: Search) -> Option<Result<Found, NoConvergence>> {
    if search.modes == 0 || axial.iter().all(|&n| n == 0.0) {
        return None;
    }
    let free = solver.system().held().iter().filter(|h| !**h).count();
    Some(if free <= DENSE.max(DENSE_A_MODE * search.modes) {
        dense::dense(solver, axial, search.modes)
    } else {
        Lanczos::new(solver, axial, search).run()
    })
}
