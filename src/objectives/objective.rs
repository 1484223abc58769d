//! An objective: a metric and which way it is better.

use super::{AnalysedDesign, Metric};

/// Buckling factors beyond this, or none at all, are as good as each other where the factor is maximised: no structure gets so far.
const SAFE: f64 = 1000.0;

/// A metric that a search makes small or large.
#[derive(Clone, Copy, Debug)]
pub struct Objective {
    /// What is measured.
    pub metric: &'static Metric,
    /// Whether it is better the larger it is.
    pub maximised: bool,
}

impl Objective {
    /// Its value as files and people have it.
    pub fn value(&self, design: &AnalysedDesign) -> Option<f64> {
        let value = (self.metric.value)(design)?;
        Some(if self.maximised && self.metric.name == "buckling_factor" { value.min(SAFE) } else { value })
    }

    /// From the value as files have it to that which the search makes small, and back.
    pub fn turned(&self, value: f64) -> f64 {
        if self.maximised { -value } else { value }
    }
}
