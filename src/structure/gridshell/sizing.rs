//! The least section height that meets every requirement.

use super::AnalysisError;
use super::evaluate::Evaluator;
use crate::structure::params::{HeightParams, Quantity, RequirementParams, StructureParams};

/// Width of the bracket at which the bisection ends, m: a tenth of a millimetre.
const RESOLUTION: f64 = 1e-4;

/// The height to report: the fixed one, or the least of the range that meets all requirements, or the largest if
/// none does.
///
/// # Errors
/// What keeps the largest height from being analysed; at smaller ones, it counts as a requirement not met.
pub fn height(evaluator: &mut Evaluator<'_>, params: &StructureParams) -> Result<f64, AnalysisError> {
    let (min, max) = match params.height {
        HeightParams::Fixed { fixed_m } => return Ok(fixed_m),
        HeightParams::Sized { min_m, max_m, .. } => (min_m, max_m),
    };
    if !meets(evaluator, params, max)? {
        return Ok(max);
    }
    let (mut low, mut high) = (min, max);
    if meets_or_fails(evaluator, params, min)? {
        return Ok(min);
    }
    while high - low > RESOLUTION {
        let middle = 0.5 * (low + high);
        if meets_or_fails(evaluator, params, middle)? {
            high = middle;
        } else {
            low = middle;
        }
    }
    Ok(high)
}

/// Like [`meets`], but a structure past its critical load does not meet.
fn meets_or_fails(
    evaluator: &mut Evaluator<'_>,
    params: &StructureParams,
    height: f64,
) -> Result<bool, AnalysisError> {
    match meets(evaluator, params, height) {
        Err(
            AnalysisError::Unstable { .. } | AnalysisError::Mechanism(_) | AnalysisError::NoConvergence(_),
        ) => Ok(false),
        other => other,
    }
}

/// Whether this height meets every requirement, the cheap ones asked first.
fn meets(
    evaluator: &mut Evaluator<'_>,
    params: &StructureParams,
    height: f64,
) -> Result<bool, AnalysisError> {
    evaluator.statics(height)?;
    let costly = |r: &&RequirementParams| r.quantity == Quantity::BucklingFactor;
    let (costly, cheap): (Vec<_>, Vec<_>) = params.requirements.iter().partition(costly);
    for required in cheap.into_iter().chain(costly) {
        if evaluator.requirement(required)?.excess() > 0.0 {
            return Ok(false);
        }
    }
    Ok(true)
}
