//! The least section height that meets every requirement.
//!
//! A bracket (too low, high enough) is narrowed as in bisection, but cut where the requirements are expected to be
//! just met: the share of the limit that is used goes nearly with a power of the height, so the cut is found by the
//! secant on logarithms. Statics decide first; buckling is asked of the height they give, by one factorisation.

use super::AnalysisError;
use super::evaluate::Evaluator;
use crate::structure::params::{HeightParams, StructureParams};

/// Width of the bracket at which the search ends, m: a tenth of a millimetre.
pub const RESOLUTION: f64 = 1e-4;
/// Power of the height that a first guess supposes.
const POWER: f64 = 1.5;
/// Every so many cuts one halves the bracket, so that it cannot crawl.
const HALVE_EVERY: usize = 4;

/// The height to report: the fixed one, or the least of the range that meets all requirements, or the largest if
/// none does.
///
/// # Errors
/// What keeps the largest height from being analysed; at smaller ones it counts as a requirement not met.
pub fn height(evaluator: &mut Evaluator<'_>, params: &StructureParams) -> Result<f64, AnalysisError> {
    let (min, max) = match params.height {
        HeightParams::Fixed { fixed_m } => return Ok(fixed_m),
        HeightParams::Sized { min_m, max_m, .. } => (min_m, max_m),
    };
    evaluator.statics(max)?;
    let used = evaluator.used(false)?;
    if used > 1.0 || !evaluator.meets_buckling()? {
        return Ok(max);
    }
    let by_statics = least(evaluator, min, (max, used), false)?;
    evaluator.statics(by_statics)?;
    if evaluator.meets_buckling()? {
        return Ok(by_statics);
    }
    evaluator.statics(max)?;
    let used = evaluator.used(true)?;
    least(evaluator, by_statics, (max, used), true)
}

/// A height and the share of the limits used there.
type Point = (f64, f64);

/// The share used at a height; infinite where the structure does not stand.
fn used_at(evaluator: &mut Evaluator<'_>, height: f64, all: bool) -> Result<f64, AnalysisError> {
    let used = evaluator.statics(height).and_then(|()| evaluator.used(all));
    match used {
        Err(
            AnalysisError::Unstable { .. } | AnalysisError::Mechanism(_) | AnalysisError::NoConvergence(_),
        ) => Ok(f64::INFINITY),
        other => other,
    }
}

/// The least height from `min` on that uses at most all of the limits, within [`RESOLUTION`]; `high` does.
fn least(evaluator: &mut Evaluator<'_>, min: f64, high: Point, all: bool) -> Result<f64, AnalysisError> {
    // `low` is not known to be too low until something was found to be; then `low.1` > 1.
    let mut low: Point = (min, f64::NAN);
    let mut high = high;
    let mut previous: Option<Point> = None;
    for cut in 1.. {
        if high.0 - low.0 <= RESOLUTION && (low.1 > 1.0 || high.0 <= min) {
            break;
        }
        let height = next_cut(low, high, previous, cut, min);
        let used = used_at(evaluator, height, all)?;
        previous = Some((height, used));
        if used > 1.0 {
            low = (height, used);
        } else {
            high = (height, used);
        }
    }
    Ok(high.0)
}

/// Where to cut the bracket next.
fn next_cut(low: Point, high: Point, previous: Option<Point>, cut: usize, min: f64) -> f64 {
    let bracketed = low.1 > 1.0;
    let expected = match previous {
        // The first guess: from the largest height by the usual power.
        None => high.0 * high.1.powf(1.0 / POWER),
        Some(_) if bracketed && low.1.is_finite() && high.1 > 0.0 => {
            let (a, b) = (low.0.ln(), high.0.ln());
            (a + (b - a) * low.1.ln() / (low.1.ln() - high.1.ln())).exp()
        }
        Some(_) if bracketed => 0.5 * (low.0 + high.0),
        // Still high enough: go on by the power.
        Some(_) => high.0 * high.1.powf(1.0 / POWER),
    };
    if !bracketed {
        // `min` itself is worth asking only if the guess comes near it.
        return if expected <= min + RESOLUTION || high.0 - min <= RESOLUTION {
            min
        } else if expected < high.0 - 0.5 * RESOLUTION {
            expected
        } else {
            0.5 * (min + high.0)
        };
    }
    if cut.is_multiple_of(HALVE_EVERY) || !expected.is_finite() {
        return 0.5 * (low.0 + high.0);
    }
    // A little beyond the expected root, on the side that was not met last, so that the bracket closes from both.
    let beyond = 0.4 * RESOLUTION;
    let last_too_low = previous.is_some_and(|p| p.1 > 1.0);
    let height = if last_too_low { expected + beyond } else { expected - beyond };
    let margin = 0.25 * RESOLUTION;
    height.clamp(low.0 + margin, high.0 - margin)
}
