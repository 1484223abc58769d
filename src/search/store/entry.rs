//! One evaluation as the journal holds it.

use serde::{Deserialize, Serialize};

use super::super::child::Child;
use super::super::problem::Evaluation;
use super::super::record::EvaluatedRow;
use super::super::state::Indexed;
use crate::evolve::Violation;
use crate::grammar::Tokens;
use crate::mesh::Symmetries;
use crate::mesh::canonical::Code;

/// A line of the journal.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Entry {
    pub(super) generation: u32,
    pub(super) slot: u32,
    tokens: Tokens,
    expressed: Tokens,
    code: Code,
    /// Left out where it has none.
    #[serde(default, skip_serializing_if = "is_unsymmetric")]
    symmetries: Symmetries,
    /// Equivalence codes and their numbers of deletions; left out where it is the code alone.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    nearby: Vec<Nearby>,
    violation: Violation,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    reason: String,
    objectives: Vec<f64>,
    metrics: Vec<Option<f64>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    governing: Vec<String>,
    structural: bool,
}

#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
struct Nearby(Code, u8);

impl Entry {
    pub(super) fn of(generation: u32, slot: u32, child: &Child, evaluation: &Evaluation) -> Self {
        let identity = &child.identity;
        let plain = identity.neighbourhood == [(identity.code, 0)];
        let nearby = identity.neighbourhood.iter().map(|&(code, deleted)| Nearby(code, deleted));
        let evaluation = evaluation.clone();
        Self {
            generation,
            slot,
            tokens: child.tokens.clone(),
            expressed: identity.expressed.clone(),
            code: identity.code,
            symmetries: identity.symmetries,
            nearby: if plain { Vec::new() } else { nearby.collect() },
            violation: evaluation.violation,
            reason: evaluation.reason,
            objectives: evaluation.objectives,
            metrics: evaluation.metrics,
            governing: evaluation.governing,
            structural: evaluation.structural,
        }
    }

    pub(super) fn into_evaluation(self) -> (Code, Evaluation) {
        let evaluation = Evaluation {
            violation: self.violation,
            reason: self.reason,
            objectives: self.objectives,
            metrics: self.metrics,
            governing: self.governing,
            structural: self.structural,
        };
        (self.code, evaluation)
    }

    pub(super) fn into_indexed(self) -> Indexed {
        let neighbourhood = match self.nearby.is_empty() {
            true => vec![(self.code, 0)],
            false => self.nearby.into_iter().map(|Nearby(code, deleted)| (code, deleted)).collect(),
        };
        let row = EvaluatedRow {
            generation: self.generation,
            slot: self.slot,
            tokens: self.tokens,
            expressed: self.expressed,
            code: self.code,
            symmetries: self.symmetries,
            violation: self.violation,
            reason: self.reason.into(),
            objectives: self.objectives.into(),
            metrics: self.metrics.into_iter().collect(),
            governing: self.governing.into_iter().map(String::into_boxed_str).collect(),
            structural: self.structural,
        };
        Indexed { row, neighbourhood }
    }
}

fn is_unsymmetric(symmetries: &Symmetries) -> bool {
    *symmetries == Symmetries::default()
}
