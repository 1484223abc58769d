//! What a run hands back.

use super::normalise::Normalisation;
use super::operators::OPERATORS;
use super::record::{Breeding, EvaluatedRow, GenerationRow, OperatorCount};
use super::state::State;
use crate::evolve::NonDominated;

/// Why a run ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Ended {
    /// All generations are done.
    Generations,
    /// The structural evaluations are used up; the last generation may be incomplete.
    Evaluations,
    /// The time is used up; the last generation may be incomplete.
    Minutes,
    /// The hypervolume has not grown for long enough.
    Stall,
    /// Nothing new could be bred for many generations.
    Exhausted,
    /// A signal asked for it (its number); the run can be resumed.
    Interrupted(i32),
}

/// The result of a run: all that was evaluated, and what stands out.
#[derive(Clone, PartialEq, Debug)]
pub struct Outcome {
    /// Every evaluated design, in order of (generation, slot).
    pub evaluated: Vec<EvaluatedRow>,
    /// Every generation; the last one may be incomplete, see `ended`.
    pub generations: Vec<GenerationRow>,
    /// The non-dominated set of all feasible evaluations, as indices into `evaluated`, sorted by objectives and then
    /// by code.
    pub front: Vec<usize>,
    /// What the hypervolume was measured in; `None` if too few feasible designs were found.
    pub normalisation: Option<Normalisation>,
    /// Breeding, summed over all generations.
    pub breeding: Breeding,
    /// Why the run ended.
    pub ended: Ended,
}

impl Outcome {
    pub(crate) fn of(state: State, ended: Ended) -> Self {
        let front = sorted_front(&state.rows, &state.front);
        Self {
            front,
            normalisation: state.normalisation().cloned(),
            breeding: total(&state.generations),
            evaluated: state.rows,
            generations: state.generations,
            ended,
        }
    }
}

pub(super) fn sorted_front(rows: &[EvaluatedRow], front: &NonDominated) -> Vec<usize> {
    let mut ids: Vec<usize> = front.ids().collect();
    ids.sort_by(|&a, &b| {
        let (a, b) = (&rows[a], &rows[b]);
        let by_objective = a.objectives.iter().zip(&b.objectives).map(|(x, y)| x.total_cmp(y));
        by_objective.fold(std::cmp::Ordering::Equal, std::cmp::Ordering::then).then(a.code.cmp(&b.code))
    });
    ids
}

pub(super) fn total(generations: &[GenerationRow]) -> Breeding {
    let mut total =
        Breeding { operators: vec![OperatorCount::default(); OPERATORS.len()], ..Breeding::default() };
    for Breeding { bred, duplicates, neighbours, rejected, cached, immigrants, empty, operators } in
        generations.iter().map(|g| &g.breeding)
    {
        total.bred += bred;
        total.duplicates += duplicates;
        total.neighbours += neighbours;
        total.rejected += rejected;
        total.cached += cached;
        total.immigrants += immigrants;
        total.empty += empty;
        for (sum, count) in total.operators.iter_mut().zip(operators) {
            sum.used += count.used;
            sum.evaluated += count.evaluated;
            sum.survived += count.survived;
            sum.entered_front += count.entered_front;
        }
    }
    total
}
