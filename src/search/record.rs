//! The rows of the results: one per evaluated design, one per generation. Plain data, written by `output`.

use serde::{Deserialize, Serialize};

use super::problem::Evaluation;
use crate::evolve::{Fitness, Violation};
use crate::grammar::Tokens;
use crate::mesh::Symmetries;
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
    /// Which symmetries it has.
    pub symmetries: Symmetries,
    /// Stage and measure of the failure; stage 0 = feasible.
    pub violation: Violation,
    /// What failed, in words; empty for a feasible design.
    pub reason: Box<str>,
    /// Objectives in the order of the config; empty where they do not exist.
    pub objectives: Box<[f64]>,
    /// All metrics in the order of the registry; empty where none exists.
    pub metrics: Metrics,
    /// The combinations of loads that govern, in the order of the registry; empty where the structure was not analysed.
    pub governing: Box<[Box<str>]>,
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
            governing: self.governing.iter().map(|name| name.to_string()).collect(),
            structural: self.structural,
        }
    }
}

/// Optional numbers, at most 64, of which only those that exist take room: every evaluated design is kept in memory,
/// and most fail before they have all. NaN counts as none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metrics {
    /// Bit i: number i exists.
    present: u64,
    length: u8,
    values: Box<[f64]>,
}

impl Metrics {
    /// All values, in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Option<f64>> + '_ {
        (0..usize::from(self.length)).map(|index| self.get(index))
    }

    /// The value at `index`, if there is one.
    pub fn get(&self, index: usize) -> Option<f64> {
        let bit = 1u64.checked_shl(index as u32).filter(|bit| self.present & bit != 0)?;
        self.values.get((self.present & (bit - 1)).count_ones() as usize).copied()
    }
}

impl FromIterator<Option<f64>> for Metrics {
    /// # Panics
    /// With more than 64 numbers.
    fn from_iter<I: IntoIterator<Item = Option<f64>>>(numbers: I) -> Self {
        let (mut present, mut length, mut values) = (0, 0u8, Vec::new());
        for number in numbers {
            assert!(length < 64, "more than 64 metrics");
            if let Some(value) = number.filter(|x| !x.is_nan()) {
                present |= 1u64 << length;
                values.push(value);
            }
            length += 1;
        }
        Self { present, length, values: values.into() }
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

#[cfg(test)]
mod tests {
    use super::Metrics;

    #[test]
    fn metrics_give_back_what_they_were_given() {
        let given = |i: usize| (!i.is_multiple_of(3)).then_some(i as f64);
        let metrics: Metrics = (0..64).map(given).collect();
        assert!(metrics.iter().eq((0..64).map(given)));
        assert_eq!((metrics.get(63), metrics.get(62), metrics.get(64)), (None, Some(62.0), None));
        assert_eq!([Some(f64::NAN), Some(1.0)].into_iter().collect::<Metrics>().get(0), None);
        assert_eq!(Metrics::default().iter().len(), 0);
    }
}
