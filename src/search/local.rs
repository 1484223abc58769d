//! Local steps: a good design found so far, and one or two strips more or less (docs/reference/search.md §2.1).

use super::params::Survival;
use super::problem::{Problem, RuleOperator};
use super::state::State;
use crate::grammar::Tokens;
use crate::random::{Rng, below, chance, weighted};

/// How many of the least violating designs count as near misses.
const MISSES: usize = 20;

/// Chance of a second step.
const SECOND: f64 = 0.35;

/// What a step does, by weight.
const STEPS: [(RuleOperator, f64); 5] = [
    (RuleOperator::AppendDeletion, 0.3),
    (RuleOperator::AppendStrip, 0.2),
    (RuleOperator::AppendNatural, 0.2),
    (RuleOperator::SwapPair, 0.2),
    (RuleOperator::AppendShort, 0.1),
];

/// Where steps are taken from: rows of the front, or, while nothing is feasible, of the nearest misses. None where the front holds
/// most designs, good or bad: then parents are those of the population (docs/search.md).
#[derive(Debug)]
pub(crate) struct Footholds(Vec<u32>);

impl Footholds {
    pub(crate) fn of(state: &State, survival: Survival) -> Self {
        let objectives = state.front.points().next().map_or(0, <[f64]>::len);
        if survival.by_hypervolume(objectives) {
            return Self(Vec::new());
        }
        let front: Vec<u32> = state.front.ids().map(|id| id as u32).collect();
        if !front.is_empty() {
            return Self(front);
        }
        let mut misses: Vec<u32> = (0..state.rows.len() as u32).collect();
        misses.sort_by(|&a, &b| {
            let [a, b] = [a, b].map(|i| state.rows[i as usize].violation);
            a.total_cmp(b)
        });
        misses.truncate(MISSES);
        Self(misses)
    }

    /// A row to start from; `None` where there is none.
    pub(crate) fn draw(&self, rng: &mut Rng) -> Option<u32> {
        (!self.0.is_empty()).then(|| self.0[below(rng, self.0.len())])
    }
}

/// A string one or two steps from an expressed one, and the operators that made it; `None` where no step applies.
pub(crate) fn step<P: Problem>(
    problem: &P,
    expressed: &Tokens,
    rng: &mut Rng,
) -> Option<(Tokens, Vec<RuleOperator>)> {
    let mut tokens = expressed.clone();
    let mut made_by = Vec::new();
    let steps = if chance(rng, SECOND) { 2 } else { 1 };
    for _ in 0..steps {
        let Some(operator) = weighted(rng, &STEPS) else { break };
        if let Some(further) = problem.vary(operator, &tokens, rng) {
            tokens = further;
            made_by.push(operator);
        }
    }
    (!made_by.is_empty()).then_some((tokens, made_by))
}
