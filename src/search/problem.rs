//! What the search asks of a problem: the only thing it knows of meshes, geometry and structure.

use crate::evolve::{FAILED, Fitness, Violation};
use crate::grammar::Tokens;
use crate::mesh::canonical::Code;
use crate::random::Rng;

/// A problem over strings. All methods are pure: the same arguments give the same result, on any thread.
pub trait Problem: Sync {
    /// What a string means, without geometry: called for every string bred, often many times per evaluation.
    fn identify(&self, tokens: &Tokens) -> Identity;

    /// Develops and measures one design. Its failures are data ([`Evaluation::violation`]), never an error; a panic
    /// is caught by the [`Server`](super::Server) and becomes stage 6. Two strings with the same
    /// [`Identity::code`] must give the same evaluation, since only one of them is ever evaluated.
    fn evaluate(&self, tokens: &Tokens) -> Evaluation;

    /// Whether some objectives are known before the structure is analysed, and others only after. If so,
    /// [`Self::preview`] may be asked of several candidates, of which one is evaluated.
    fn has_preview(&self) -> bool {
        false
    }

    /// What is known of a design before its structure is analysed.
    fn preview(&self, _tokens: &Tokens) -> Preview {
        Preview::unknown(Violation::NONE)
    }

    /// A random string, by the initialiser of the config.
    fn random(&self, rng: &mut Rng) -> Tokens;

    /// Applies a rule-wise operator that has to follow the decoding ([`RuleOperator::AppendStrip`],
    /// [`RuleOperator::AppendDeletion`]) to a parent's expressed string; `None` where it does not apply.
    fn vary(&self, operator: RuleOperator, expressed: &Tokens, rng: &mut Rng) -> Option<Tokens>;
}

/// Operators that work on whole rules (RUN "Operators").
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum RuleOperator {
    /// Append a strip along a valid polyedge reached by the shortest walk.
    AppendStrip,
    /// Append the deletion of a strip reached by the shortest walk.
    AppendDeletion,
    /// Drop the last rule.
    DropLast,
    /// Swap `A`, `A*` and `A°` of one pair.
    SwapPair,
}

/// What a string means, as far as the search must know.
#[derive(Clone, PartialEq, Debug)]
pub struct Identity {
    /// Placed + reduced code: designs with equal codes share their values.
    pub code: Code,
    /// The codes under the `equivalence` of the config, each with the number of strips deleted to get there: the
    /// design itself with 0 first, then all reached by deleting up to `min_distance` − 1 strips, each code once with
    /// its smallest number. Just the design itself for `min_distance` ≤ 1.
    pub neighbourhood: Vec<(Code, u8)>,
    /// The expressed string.
    pub expressed: Tokens,
    /// Why topology alone already rules the design out (pinched, flat faces), if it does. Such a design may be bred
    /// anew without being evaluated; [`Problem::evaluate`] must give the same violation and reason.
    pub rejected: Option<(Violation, String)>,
}

/// What is known of a design before its structure is analysed.
#[derive(Clone, PartialEq, Debug)]
pub struct Preview {
    /// Stage and measure of a failure that is known by then.
    pub violation: Violation,
    /// The objectives in the order of the config, rounded to 10 significant digits; `None` for those that are not known.
    pub objectives: Vec<Option<f64>>,
}

impl Preview {
    /// Of a design without a pattern.
    pub fn unknown(violation: Violation) -> Self {
        Self { violation, objectives: Vec::new() }
    }
}

/// The result of evaluating one design.
#[derive(Clone, PartialEq, Debug)]
pub struct Evaluation {
    /// Stage and measure of the failure; [`Violation::NONE`] for a feasible design.
    pub violation: Violation,
    /// What failed, in words; empty for a feasible design.
    pub reason: String,
    /// The objectives in the order of the config, rounded to 10 significant digits ([`round_significant`]); empty
    /// where the design did not get that far.
    pub objectives: Vec<f64>,
    /// All metrics in the order of the registry; `None` where a value does not exist. The same length always, or
    /// empty.
    pub metrics: Vec<Option<f64>>,
    /// Whether the structure was analysed: this is what a budget of `evaluations` counts.
    pub structural: bool,
}

impl Evaluation {
    /// A design that could not be evaluated: panic, error, or values that are not finite.
    pub fn failed(reason: impl Into<String>, structural: bool) -> Self {
        let violation = Violation::new(FAILED, 0.0);
        Self { violation, reason: reason.into(), objectives: Vec::new(), metrics: Vec::new(), structural }
    }

    /// The evaluation as the search takes it: nothing in it is NaN or infinite, objectives are rounded, and a
    /// feasible design has `objectives` of them. Whatever breaks this becomes stage 6 with a reason.
    pub fn sanitised(mut self, objectives: usize) -> Self {
        self.objectives.iter_mut().for_each(|f| *f = round_significant(*f));
        let finite = self.objectives.iter().all(|f| f.is_finite());
        if !finite || (self.violation.is_feasible() && self.objectives.len() != objectives) {
            let found = if finite { "missing" } else { "not finite" };
            let reason = format!("an objective is {found}");
            return Self { metrics: finite_only(self.metrics), ..Self::failed(reason, self.structural) };
        }
        if !self.violation.measure.is_finite() {
            self.violation = Violation::new(FAILED, 0.0);
            self.reason = format!("{} (violation not finite)", self.reason);
        }
        self.metrics = finite_only(self.metrics);
        self
    }

    /// What selection needs of it.
    pub fn fitness(&self) -> Fitness {
        Fitness::new(self.violation, self.objectives.clone())
    }
}

fn finite_only(metrics: Vec<Option<f64>>) -> Vec<Option<f64>> {
    metrics.into_iter().map(|m| m.filter(|x| x.is_finite())).collect()
}

/// Rounds to 10 significant decimal digits, so that last bits, which differ between CPUs, decide nothing.
///
/// Goes through the decimal representation, which is exact and the same everywhere.
pub fn round_significant(x: f64) -> f64 {
    if !x.is_finite() || x == 0.0 {
        return if x == 0.0 { 0.0 } else { x };
    }
    format!("{x:.9e}").parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_digits() {
        assert_eq!(round_significant(1.234_567_890_123_4), 1.234_567_890);
        assert_eq!(round_significant(-9.999_999_999_96e-7), -1e-6);
        assert_eq!(round_significant(123_456_789_012.0), 123_456_789_000.0);
        assert_eq!(round_significant(-0.0).to_bits(), 0.0f64.to_bits());
        assert!(round_significant(f64::NAN).is_nan());
    }

    #[test]
    fn nothing_but_finite_numbers_leaves() {
        let good = Evaluation {
            violation: Violation::NONE,
            reason: String::new(),
            objectives: vec![1.0, 2.0],
            metrics: vec![Some(f64::NAN), Some(3.0), None],
            structural: true,
        };
        assert_eq!(good.clone().sanitised(2).metrics, [None, Some(3.0), None]);
        assert_eq!(good.clone().sanitised(3).violation.stage, FAILED);
        let bad = Evaluation { objectives: vec![1.0, f64::INFINITY], ..good }.sanitised(2);
        assert_eq!((bad.violation.stage, bad.objectives.len()), (FAILED, 0));
        assert!(bad.reason.contains("not finite"));
    }
}
