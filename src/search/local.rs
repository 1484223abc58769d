//! Local steps: a good design found so far, and one or two strips more or less (docs/reference/search.md §2.1).

use super::problem::{Problem, RuleOperator};
use super::state::State;
use crate::grammar::Tokens;
use crate::random::{Rng, below, chance, unit};

/// Chance of a parent from the front, and, of the others, of any feasible design. The rest are near misses.
const FRONT: f64 = 0.6;
const FEASIBLE: f64 = 0.375;

/// How many of the least violating designs count as near misses.
const MISSES: usize = 20;

/// Chance of a second step.
const SECOND: f64 = 0.35;

/// What a step does, by weight.
const STEPS: [(RuleOperator, f64); 4] = [
    (RuleOperator::AppendDeletion, 0.35),
    (RuleOperator::AppendNatural, 0.25),
    (RuleOperator::AppendStrip, 0.2),
    (RuleOperator::AppendShort, 0.2),
];

/// Where steps are taken from: rows of all that was evaluated.
#[derive(Debug)]
pub(crate) struct Footholds {
    front: Vec<u32>,
    feasible: Vec<u32>,
    misses: Vec<u32>,
}

impl Footholds {
    pub(crate) fn of(state: &State) -> Self {
        let rows = || state.rows.iter().zip(0u32..);
        let mut misses: Vec<u32> = rows().filter(|(row, _)| !row.is_feasible()).map(|(_, i)| i).collect();
        misses.sort_by(|&a, &b| {
            let [a, b] = [a, b].map(|i| state.rows[i as usize].violation);
            a.total_cmp(b)
        });
        misses.truncate(MISSES);
        Self {
            front: state.front.ids().map(|id| id as u32).collect(),
            feasible: rows().filter(|(row, _)| row.is_feasible()).map(|(_, i)| i).collect(),
            misses,
        }
    }

    /// A row to start from; `None` before anything was evaluated.
    fn draw(&self, rng: &mut Rng) -> Option<u32> {
        let wanted = if chance(rng, FRONT) {
            &self.front
        } else if chance(rng, FEASIBLE) {
            &self.feasible
        } else {
            &self.misses
        };
        let rows = [wanted, &self.front, &self.misses].into_iter().find(|rows| !rows.is_empty())?;
        Some(rows[below(rng, rows.len())])
    }
}

/// A string one or two steps from a foothold, and the operators that made it; `None` where no step applies.
pub(crate) fn step<P: Problem>(
    problem: &P,
    footholds: &Footholds,
    expressed: impl Fn(u32) -> Tokens,
    rng: &mut Rng,
) -> Option<(Tokens, Vec<RuleOperator>)> {
    let mut tokens = expressed(footholds.draw(rng)?);
    let mut made_by = Vec::new();
    let steps = if chance(rng, SECOND) { 2 } else { 1 };
    for _ in 0..steps {
        let operator = drawn(rng);
        if let Some(further) = problem.vary(operator, &tokens, rng) {
            tokens = further;
            made_by.push(operator);
        }
    }
    (!made_by.is_empty()).then_some((tokens, made_by))
}

fn drawn(rng: &mut Rng) -> RuleOperator {
    let mut left = unit(rng);
    let found = STEPS.iter().find(|(_, weight)| {
        left -= weight;
        left < 0.0
    });
    found.unwrap_or(&STEPS[0]).0
}
