//! Limits on any metric, as `[[pattern.limit]]` and `[[structure.requirement]]` set them.

use super::{AnalysedDesign, called};
use crate::geometry::limits::{LimitExcess, at_least, at_most};

/// How a design stands to a limit on the metric of that name: `max`, or else `min`. A metric that the design does not have exceeds
/// nothing; neither does a name that is none, which the config refuses.
pub fn limit(design: &AnalysedDesign, name: &str, max: Option<f64>, min: Option<f64>) -> Option<LimitExcess> {
    let metric = called(name)?;
    let value = (metric.value)(design)?;
    match (max, min) {
        (Some(max), _) => Some(at_most(metric.column, value, max)),
        (None, min) => Some(at_least(metric.column, value, min?)),
    }
}
