//! The rows of the results: one per evaluated design, one per generation. Plain data, written by `output`.

use serde::{Deserialize, Serialize};

use super::problem::Evaluation;
use crate::evolve::{Fitness, Violation};
use crate::grammar::Tokens;
use crate::mesh::canonical::Code;

/// One evaluated design: a row of `history.csv`, and of `pareto.csv` if it is on the front.
#[derive(Clone, PartialEq, Debug)]
pub struct EvaluatedRow {
    /// Generation in which it was bred, 0 the first population.
    pub generation: u32,
    /// Its slot within the generation. Rows are ordered by (generation, slot).
    pub slot: u32,
    /// The string as bred.
    pub tokens: Tokens,
    /// The expressed string.
    pub expressed: Tokens,
    /// Placed + reduced code: no two rows have the same.
    pub code: Code,
    /// Stage and measure of the failure; stage 0 = feasible.
    pub violation: Violation,
    /// What failed, in words; empty for a feasible design.
    pub reason: Box<str>,
    /// Objectives in the order of the config; empty where they do not exist.
    pub objectives: Box<[f64]>,
    /// All metrics in the order of the registry; empty where none exists.
    pub metrics: Metrics,
    /// Whether the structure was analysed.
    pub structural: bool,
}

impl EvaluatedRow {
    /// What selection needs of it.
    pub fn fitness(&self) -> Fitness {
        Fitness::new(self.violation, self.objectives.to_vec())
    }

    /// True for a feasible design.
    pub fn is_feasible(&self) -> bool {
        self.violation.is_feasible()
    }

    /// The evaluation it was made from.
    pub fn evaluation(&self) -> Evaluation {
        Evaluation {
            violation: self.violation,
            reason: self.reason.to_string(),
            objectives: self.objectives.to_vec(),
            metrics: self.metrics.iter().collect(),
            structural: self.structural,
        }
    }
}

/// Optional numbers in 8 bytes each, since every evaluated design is kept in memory. NaN stands for "none" inside
/// and never comes out.
#[derive(Clone, Debug, Default)]
pub struct Metrics(Box<[f64]>);

impl Metrics {
    /// All values, in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Option<f64>> + '_ {
        self.0.iter().map(|&x| (!x.is_nan()).then_some(x))
    }

    /// The value at `index`, if there is one.
    pub fn get(&self, index: usize) -> Option<f64> {
        self.0.get(index).copied().filter(|x| !x.is_nan())
    }
}

impl FromIterator<Option<f64>> for Metrics {
    fn from_iter<I: IntoIterator<Item = Option<f64>>>(values: I) -> Self {
        Self(values.into_iter().map(|x| x.unwrap_or(f64::NAN)).collect())
    }
}

impl PartialEq for Metrics {
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

/// One generation: a row of `generations.csv`. All counts but those marked are of this generation alone.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct GenerationRow {
    /// Number of the generation, 0 the first population.
    pub generation: u32,
    /// Designs evaluated so far, over all generations.
    pub evaluations: u64,
    /// Of these, those whose structure was analysed.
    pub structural: u64,
    /// Of these, the feasible ones.
    pub feasible: u64,
    /// Size of the non-dominated set of all feasible evaluations so far.
    pub front: u64,
    /// Its hypervolume; `None` until the normalisation is known.
    pub hypervolume: Option<f64>,
    /// Breeding of this generation.
    pub breeding: Breeding,
    /// Best value so far of each objective over all feasible evaluations; empty while there is none.
    pub best: Vec<f64>,
    /// Mean of each objective over the feasible evaluations of this generation; empty if there is none.
    pub mean: Vec<f64>,
}

/// What happened while a generation was bred.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Breeding {
    /// Strings bred, refused ones included.
    pub bred: u64,
    /// Refused: a design with an equal equivalence code is known.
    pub duplicates: u64,
    /// Refused: a design less than `min_distance` away is known, but none with an equal code.
    pub neighbours: u64,
    /// Refused: topology alone rules the design out.
    pub rejected: u64,
    /// Not evaluated, because a design of the same placed + reduced code was before (`min_distance` = 0).
    pub cached: u64,
    /// Slots filled by a random string after `tries` refusals.
    pub immigrants: u64,
    /// Slots left empty because random strings were refused too.
    pub empty: u64,
    /// Per operator, in the order of [`OPERATORS`](super::operators::OPERATORS).
    pub operators: Vec<OperatorCount>,
}

/// How an operator fared in a generation.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct OperatorCount {
    /// Strings it had a part in, refused ones included.
    pub used: u64,
    /// Of these, those evaluated.
    pub evaluated: u64,
    /// Of these, those that survived into the next population.
    pub survived: u64,
    /// Of the evaluated, those that entered the non-dominated set of all evaluations.
    pub entered_front: u64,
}
