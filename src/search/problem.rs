//! What the search asks of a problem: the only thing it knows of meshes, geometry and structure.

use crate::evolve::{FAILED, Fitness, Violation};
use crate::grammar::Tokens;
use crate::mesh::Symmetries;
use crate::mesh::canonical::Code;
use crate::random::Rng;
use serde::{Deserialize, Serialize};

/// A problem over strings. All methods are pure: the same arguments give the same result, on any thread.
pub trait Problem: Sync {
    /// What a string means, without geometry: called for every string bred, often many times per evaluation.
    fn identify(&self, tokens: &Tokens) -> Identity;

    /// Develops and measures one design. Its failures are data ([`Evaluation::violation`]), never an error; a panic
    /// is caught by the [`Server`](super::Server) and becomes stage 6. Two strings with the same
    /// [`Identity::code`] must give the same evaluation, since only one of them is ever evaluated.
    fn evaluate(&self, tokens: &Tokens) -> Evaluation;

    /// The designs to go on from, evaluated first.
    fn seeds(&self) -> Vec<Tokens> {
        Vec::new()
    }

    /// A random string, by the initialiser of the config.
    fn random(&self, rng: &mut Rng) -> Tokens;

    /// The strings that lead from an expressed string one step of this kind further, in a fixed order; several may have the
    /// same code. None where a problem knows no steps.
    fn steps(&self, _steps: Steps, _expressed: &Tokens) -> Vec<Tokens> {
        Vec::new()
    }

    /// Applies a rule-wise operator to a parent's expressed string; `None` where it does not apply.
    fn vary(&self, operator: RuleOperator, expressed: &Tokens, rng: &mut Rng) -> Option<Tokens>;
}

/// Steps of which all are taken, one after the other.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Steps {
    /// Each strip that can be deleted, and a strip along each natural polyedge.
    Natural,
    /// A strip along each simple polyedge of at most six edges from boundary to boundary.
    Simple,
}

/// Operators that work on whole rules (docs/reference/search.md §2).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum RuleOperator {
    /// Append a strip along a valid polyedge reached by the shortest walk.
    AppendStrip,
    /// Append a strip along a natural polyedge.
    AppendNatural,
    /// Append a strip along a simple polyedge of at most four edges.
    AppendShort,
    /// Append the deletion of a strip reached by the shortest walk.
    AppendDeletion,
    /// Swap `A`, `A*` and `A°` of one pair.
    SwapPair,
}

/// What a string means, as far as the search must know. Serialised, strings and symmetries are as they are printed, codes in
/// 32 hexadecimal digits.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Identity {
    /// Placed + reduced code: designs with equal codes share their values.
    pub code: Code,
    /// The codes under the `equivalence` of the config, each with the number of strips deleted to get there: the
    /// design itself with 0 first, then all reached by deleting up to `min_distance` − 1 strips, each code once with
    /// its smallest number. Just the design itself for `min_distance` ≤ 1.
    pub neighbourhood: Vec<(Code, u8)>,
    /// The expressed string.
    pub expressed: Tokens,
    /// Which symmetries the design has.
    pub symmetries: Symmetries,
    /// Why topology alone already rules the design out (pinched, flat faces), if it does. Such a design may be bred
    /// anew without being evaluated; [`Problem::evaluate`] must give the same violation and reason.
    pub rejected: Option<(Violation, String)>,
}

/// The result of evaluating one design.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
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
    /// The combinations of loads that govern, in the order of the registry; empty where the structure was not analysed.
    pub governing: Vec<String>,
    /// Whether the structure was analysed: this is what a budget of `evaluations` counts.
    pub structural: bool,
}

impl Evaluation {
    /// A design that could not be evaluated: panic, error, or values that are not finite.
    pub fn failed(reason: impl Into<String>, structural: bool) -> Self {
        let violation = Violation::new(FAILED, 0.0);
        Self {
            violation,
            reason: reason.into(),
            objectives: Vec::new(),
            metrics: Vec::new(),
            governing: Vec::new(),
            structural,
        }
    }

    /// The evaluation as the search takes it: nothing in it is NaN or infinite, objectives are rounded, and a
    /// feasible design has `objectives` of them. Whatever breaks this becomes stage 6 with a reason.
    pub fn sanitised(mut self, objectives: usize) -> Self {
        self.objectives.iter_mut().for_each(|f| *f = round_significant(*f));
        let finite = self.objectives.iter().all(|f| f.is_finite());
        if !finite || (self.violation.is_feasible() && self.objectives.len() != objectives) {
            let found = if finite { "missing" } else { "not finite" };
            let reason = format!("an objective is {found}");
            return Self {
                metrics: finite_only(self.metrics),
                governing: self.governing,
                ..Self::failed(reason, self.structural)
            };
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
/// What the decimal representation, which is exact and the same everywhere, rounds to; the way there is shorter for
/// almost all numbers.
pub fn round_significant(x: f64) -> f64 {
    if !x.is_finite() || x == 0.0 {
        return if x == 0.0 { 0.0 } else { x };
    }
    rounded_by_scaling(x).unwrap_or_else(|| format!("{x:.9e}").parse().unwrap_or(x))
}

/// Powers of ten that a double holds exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
    1e19, 1e20, 1e21, 1e22,
];

/// The ten digits as a whole number, scaled there and back by an exact power of ten, so that either way is rounded
/// once: the way there errs by less than 1e-6, the way back gives the double nearest to the decimal. `None` where no
/// such power does, or so near the middle of two decimals that the error could decide.
fn rounded_by_scaling(x: f64) -> Option<f64> {
    let magnitude = x.abs();
    // Of the power that gives ten digits: 1e9 ≤ magnitude · 10^place < 1e10.
    let place: i32 = if magnitude < 1e10 {
        (0..=22).find(|&place| magnitude * POWERS[place as usize] >= 1e9)?
    } else {
        -(1..=22).find(|&place| magnitude / POWERS[place as usize] < 1e10)?
    };
    let power = POWERS[place.unsigned_abs() as usize];
    let scaled = if place >= 0 { magnitude * power } else { magnitude / power };
    let whole = scaled.floor();
    let rest = scaled - whole;
    if (rest - 0.5).abs() < 1e-5 {
        return None;
    }
    let digits = if rest > 0.5 { whole + 1.0 } else { whole };
    Some((if place >= 0 { digits / power } else { digits * power }).copysign(x))
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
    fn scaling_rounds_as_the_decimal_representation_does() {
        let decimal = |x: f64| format!("{x:.9e}").parse::<f64>().unwrap();
        let mut rng = crate::random::stream(1, 0, 0);
        let random = (0..200_000).map(|_| f64::from_bits(rand::Rng::next_u64(&mut rng)));
        // Halves of the eleventh digit, the middles, and their neighbours; powers of ten and theirs.
        let middles = (0..1000u32).map(|k| f64::from(k).mul_add(1e6, 1e9) + 0.5);
        let near = (-40..40).flat_map(|e| middles.clone().map(move |m| m * 10f64.powi(e)));
        let powers = (-30..40).map(|e| 10f64.powi(e));
        let around = near.chain(powers).flat_map(|x| [x.next_down(), x, x.next_up()]);
        for x in random.chain(around).filter(|x| x.is_finite() && *x != 0.0) {
            for x in [x, -x] {
                assert_eq!(round_significant(x).to_bits(), decimal(x).to_bits(), "{x:e}");
            }
        }
    }

    #[test]
    fn nothing_but_finite_numbers_leaves() {
        let good = Evaluation {
            violation: Violation::NONE,
            reason: String::new(),
            objectives: vec![1.0, 2.0],
            metrics: vec![Some(f64::NAN), Some(3.0), None],
            governing: vec![],
            structural: true,
        };
        assert_eq!(good.clone().sanitised(2).metrics, [None, Some(3.0), None]);
        assert_eq!(good.clone().sanitised(3).violation.stage, FAILED);
        let bad = Evaluation { objectives: vec![1.0, f64::INFINITY], ..good }.sanitised(2);
        assert_eq!((bad.violation.stage, bad.objectives.len()), (FAILED, 0));
        assert!(bad.reason.contains("not finite"));
    }
}
