//! Who dominates whom: objectives, and before them violations (Deb et al. 2002, §VI).

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

/// The stage of a design that could not be evaluated at all: ranked after everything else.
pub const FAILED: u8 = 6;

/// How badly a design breaks its constraints: the stage first, then the measure (docs/reference/search.md §1.2).
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct Violation {
    /// 0 = feasible; larger stages are worse.
    pub stage: u8,
    /// ≥ 0, comparable within one stage only.
    pub measure: f64,
}

impl Violation {
    /// No violation.
    pub const NONE: Self = Self { stage: 0, measure: 0.0 };

    /// A violation of `stage` by `measure`; a measure that is not finite counts as failed.
    pub fn new(stage: u8, measure: f64) -> Self {
        if measure.is_finite() { Self { stage, measure } } else { Self { stage: FAILED, measure: 0.0 } }
    }

    /// True when nothing is violated.
    pub fn is_feasible(self) -> bool {
        self.stage == 0
    }

    /// Lexicographic order: stage, then measure. All feasible designs are equal.
    pub fn total_cmp(self, other: Self) -> Ordering {
        match self.stage.cmp(&other.stage) {
            Ordering::Equal if self.stage == 0 => Ordering::Equal,
            Ordering::Equal => self.measure.total_cmp(&other.measure),
            unequal => unequal,
        }
    }
}

/// What selection knows of a design.
#[derive(Clone, PartialEq, Debug)]
pub struct Fitness {
    /// Constraints first.
    pub violation: Violation,
    /// To be minimised; empty where a design has none. All finite if the design is feasible.
    pub objectives: Vec<f64>,
}

impl Fitness {
    /// A feasible design whose objectives are not all finite, or are missing, becomes [`FAILED`].
    pub fn new(violation: Violation, objectives: Vec<f64>) -> Self {
        let sound = !objectives.is_empty() && objectives.iter().all(|f| f.is_finite());
        if violation.is_feasible() && !sound {
            return Self { violation: Violation::new(FAILED, 0.0), objectives: Vec::new() };
        }
        Self { violation, objectives }
    }
}

/// The outcome of a comparison.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Domination {
    /// The first dominates the second.
    First,
    /// The second dominates the first.
    Second,
    /// Neither.
    Neither,
}

impl From<Ordering> for Domination {
    fn from(order: Ordering) -> Self {
        match order {
            Ordering::Less => Self::First,
            Ordering::Greater => Self::Second,
            Ordering::Equal => Self::Neither,
        }
    }
}

/// Constrained domination: the smaller violation wins; objectives decide between feasible designs only.
pub fn compare(a: &Fitness, b: &Fitness) -> Domination {
    match a.violation.total_cmp(b.violation) {
        Ordering::Equal if a.violation.is_feasible() => compare_objectives(&a.objectives, &b.objectives),
        order => order.into(),
    }
}

/// Pareto domination of two objective vectors of one length: nowhere worse and somewhere better.
pub fn compare_objectives(a: &[f64], b: &[f64]) -> Domination {
    debug_assert_eq!(a.len(), b.len());
    let (mut better, mut worse) = (false, false);
    for (x, y) in a.iter().zip(b) {
        // `==` first: −0.0 and 0.0 are the same objective value.
        if x == y {
            continue;
        }
        match x.total_cmp(y) {
            Ordering::Less => better = true,
            _ => worse = true,
        }
        if better && worse {
            return Domination::Neither;
        }
    }
    match (better, worse) {
        (true, false) => Domination::First,
        (false, true) => Domination::Second,
        _ => Domination::Neither,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fit(stage: u8, measure: f64, objectives: &[f64]) -> Fitness {
        Fitness::new(Violation::new(stage, measure), objectives.to_vec())
    }

    #[test]
    fn feasible_beats_infeasible_and_the_stage_comes_before_the_measure() {
        let good = fit(0, 0.0, &[9.0, 9.0]);
        let near = fit(1, 100.0, &[1.0, 1.0]);
        let far = fit(2, 0.001, &[]);
        assert_eq!(compare(&good, &near), Domination::First);
        assert_eq!(compare(&far, &near), Domination::Second);
        assert_eq!(
            compare(&near, &fit(1, 100.0, &[0.0, 0.0])),
            Domination::Neither,
            "objectives do not decide here"
        );
    }

    #[test]
    fn what_is_not_finite_is_failed() {
        assert_eq!(fit(0, 0.0, &[1.0, f64::NAN]).violation.stage, FAILED);
        assert_eq!(fit(0, 0.0, &[]).violation.stage, FAILED);
        assert_eq!(Violation::new(1, f64::NAN).stage, FAILED);
        assert_eq!(compare(&fit(0, 0.0, &[f64::INFINITY]), &fit(5, 3.0, &[])), Domination::Second);
    }

    #[test]
    fn equal_vectors_do_not_dominate_each_other() {
        assert_eq!(compare_objectives(&[0.0, 1.0], &[-0.0, 1.0]), Domination::Neither);
        assert_eq!(compare_objectives(&[0.0, 1.0], &[0.0, 2.0]), Domination::First);
    }
}
