//! All that a run knows after a finished generation.

use serde::{Deserialize, Serialize};

use super::child::Child;
use super::known::Known;
use super::normalise::{Normalisation, Volume, extremes};
use super::params::SearchParams;
use super::problem::Evaluation;
use super::record::{Breeding, EvaluatedRow, GenerationRow};
use crate::evolve::{Fitness, NonDominated, standings, survive, survive_by_contribution};
use crate::grammar::Tokens;
use crate::mesh::canonical::Code;

/// What stays fixed during a run.
#[derive(Clone, PartialEq, Debug)]
pub struct Settings {
    /// The `[search]` table.
    pub search: SearchParams,
    /// Number of objectives.
    pub objectives: usize,
    /// Ideal of each objective; empty = from the first feasible evaluations.
    pub ideal: Vec<f64>,
    /// Reference of each objective; empty = from the first feasible evaluations.
    pub reference: Vec<f64>,
    /// Seed of all chance.
    pub seed: u64,
}

/// A member of the population: a string, and the row that holds its values.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub(crate) struct Member {
    pub(crate) tokens: Tokens,
    pub(crate) row: u32,
}

/// A finished row with the codes that [`Known`] indexes it by.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Indexed {
    pub(crate) row: EvaluatedRow,
    pub(crate) neighbourhood: Vec<(Code, u8)>,
}

/// The state after the last finished generation. Everything but `rows`, `islands` and `generations` follows from
/// these three and the settings.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub(crate) rows: Vec<EvaluatedRow>,
    /// The populations that live side by side.
    pub(crate) islands: Vec<Vec<Member>>,
    pub(crate) generations: Vec<GenerationRow>,
    pub(crate) known: Known,
    pub(crate) front: NonDominated,
    volume: Option<Volume>,
    structural: u64,
    feasible: u64,
}

impl State {
    /// Before the first generation.
    pub(crate) fn new(search: &SearchParams) -> Self {
        Self {
            rows: Vec::new(),
            islands: vec![Vec::new(); search.islands],
            generations: Vec::new(),
            known: Known::new(search.duplicates.min_distance),
            front: NonDominated::default(),
            volume: None,
            structural: 0,
            feasible: 0,
        }
    }

    /// The state a checkpoint describes. `rows` are those of all its finished generations, in order.
    pub(crate) fn restore(
        settings: &Settings,
        rows: Vec<Indexed>,
        islands: Vec<Vec<Member>>,
        generations: Vec<GenerationRow>,
    ) -> Self {
        let mut state = Self::new(&settings.search);
        let mut rows = rows.into_iter().peekable();
        // Generation by generation, because the axes depend on what was known when they were fixed.
        for generation in generations {
            while let Some(indexed) = rows.next_if(|i| i.row.generation == generation.generation) {
                state.known.insert(indexed.row.code, &indexed.neighbourhood, state.rows.len() as u32);
                state.take(indexed.row);
            }
            state.normalise(settings);
            state.generations.push(generation);
        }
        let before = state.generations.last().and_then(|g| g.hypervolume).unwrap_or(0.0);
        if let Some(volume) = &mut state.volume {
            volume.restore(&state.front, before);
        }
        state.islands = islands;
        state
    }

    /// The number of the generation to come.
    pub(crate) fn next_generation(&self) -> u32 {
        self.generations.len() as u32
    }

    pub(crate) fn structural(&self) -> u64 {
        self.structural
    }

    pub(crate) fn feasible(&self) -> u64 {
        self.feasible
    }

    pub(crate) fn normalisation(&self) -> Option<&Normalisation> {
        self.volume.as_ref().map(Volume::normalisation)
    }

    /// Takes in an evaluated generation: rows, front, hypervolume, and who survives.
    ///
    /// `children` in the order in which they were accepted; an `Evaluation` for each that is new. A `None` there
    /// (the run was cut short) drops the child.
    pub(crate) fn finish(
        &mut self,
        settings: &Settings,
        children: Vec<Child>,
        evaluations: Vec<Option<Evaluation>>,
        mut breeding: Breeding,
    ) {
        let generation = self.next_generation();
        let first = self.rows.len();
        let mut islands: Vec<Vec<(Member, u16)>> = std::mem::take(&mut self.islands)
            .into_iter()
            .map(|members| members.into_iter().map(|member| (member, 0)).collect())
            .collect();
        for (slot, (child, evaluation)) in children.into_iter().zip(evaluations).enumerate() {
            let row = match (child.cached, evaluation) {
                (Some(row), _) if (row as usize) < self.rows.len() => row,
                (None, Some(evaluation)) => {
                    let row = self.rows.len() as u32;
                    let entered = self.take(row_of(generation, slot, &child, evaluation));
                    count(&mut breeding, child.operators, |c| {
                        c.evaluated += 1;
                        c.entered_front += u64::from(entered);
                    });
                    row
                }
                _ => continue,
            };
            islands[child.island].push((Member { tokens: child.tokens, row }, child.operators));
        }
        for members in islands {
            let survivors = self.survivors(members, settings);
            survivors.iter().for_each(|&(_, operators)| count(&mut breeding, operators, |c| c.survived += 1));
            self.islands.push(survivors.into_iter().map(|(member, _)| member).collect());
        }
        if (generation + 1).is_multiple_of(settings.search.migrate) {
            self.migrate(settings);
        }
        self.measure(settings, first);
        let row = self.generation_row(generation, first, breeding);
        self.generations.push(row);
    }

    /// Who of parents and children stays.
    fn survivors<T: Clone>(&self, all: Vec<(Member, T)>, settings: &Settings) -> Vec<(Member, T)> {
        let search = &settings.search;
        let fitness: Vec<Fitness> = all.iter().map(|(m, _)| self.rows[m.row as usize].fitness()).collect();
        let by_hypervolume = search.survival.by_hypervolume(settings.objectives);
        let survivors = match self.normalisation() {
            Some(axes) if by_hypervolume => {
                survive_by_contribution(&fitness, search.population, &axes.reference)
            }
            _ => survive(&fitness, search.population),
        };
        survivors.into_iter().map(|i| all[i].clone()).collect()
    }

    /// Each island hands copies of its best to the next one, the last to the first; all leave before any arrives.
    fn migrate(&mut self, settings: &Settings) {
        let count = self.islands.len();
        if count < 2 {
            return;
        }
        let emigrants: Vec<Vec<Member>> = self.islands.iter().map(|members| self.best(members)).collect();
        for (from, members) in emigrants.into_iter().enumerate() {
            let to = (from + 1) % count;
            let mut all: Vec<(Member, ())> =
                std::mem::take(&mut self.islands[to]).into_iter().map(|member| (member, ())).collect();
            for member in members {
                if all.iter().all(|(other, ())| other.row != member.row) {
                    all.push((member, ()));
                }
            }
            let survivors = self.survivors(all, settings).into_iter();
            self.islands[to] = survivors.map(|(member, ())| member).collect();
        }
    }

    /// The best eighth of a population, one member at least.
    fn best(&self, members: &[Member]) -> Vec<Member> {
        let fitness: Vec<Fitness> = members.iter().map(|m| self.rows[m.row as usize].fitness()).collect();
        let standings = standings(&fitness);
        let mut order: Vec<usize> = (0..members.len()).collect();
        order.sort_by(|&a, &b| standings[a].crowded_cmp(&standings[b]).then(a.cmp(&b)));
        order.into_iter().take((members.len() / 8).max(1)).map(|i| members[i].clone()).collect()
    }

    /// Adds a row; true if it enters the front.
    fn take(&mut self, row: EvaluatedRow) -> bool {
        let id = self.rows.len();
        self.structural += u64::from(row.structural);
        self.feasible += u64::from(row.is_feasible());
        let entered = row.is_feasible() && self.front.offer(id, &row.objectives);
        self.rows.push(row);
        entered
    }

    /// Measures the front, once the normalisation is known, which may be now. `first` is the first row that is new.
    fn measure(&mut self, settings: &Settings, first: usize) {
        let known = self.volume.is_some();
        self.normalise(settings);
        let unseen = if known { first } else { 0 };
        if let Some(volume) = &mut self.volume {
            volume.update(&self.front, |id| id >= unseen);
        }
    }

    /// Fixes the axes, if there are enough feasible designs to take them from.
    fn normalise(&mut self, settings: &Settings) {
        if self.volume.is_none() {
            let feasible: Vec<&[f64]> =
                self.rows.iter().filter(|r| r.is_feasible()).map(|r| &*r.objectives).collect();
            self.volume =
                Normalisation::establish(&settings.ideal, &settings.reference, feasible.into_iter())
                    .map(Volume::new);
        }
    }

    fn generation_row(&self, generation: u32, first: usize, breeding: Breeding) -> GenerationRow {
        let feasible = |row: &&EvaluatedRow| row.is_feasible();
        let of_this: Vec<&[f64]> =
            self.rows[first..].iter().filter(feasible).map(|r| &*r.objectives).collect();
        let best = extremes(self.front.points()).map(|(low, _)| low).unwrap_or_default();
        GenerationRow {
            generation,
            evaluations: self.rows.len() as u64,
            structural: self.structural,
            feasible: self.feasible,
            front: self.front.len() as u64,
            hypervolume: self.volume.as_ref().map(Volume::value),
            breeding,
            best,
            mean: mean(&of_this),
        }
    }
}

fn row_of(generation: u32, slot: usize, child: &Child, evaluation: Evaluation) -> EvaluatedRow {
    EvaluatedRow {
        generation,
        slot: slot as u32,
        tokens: child.tokens.clone(),
        expressed: child.identity.expressed.clone(),
        code: child.identity.code,
        symmetries: child.identity.symmetries,
        violation: evaluation.violation,
        reason: evaluation.reason.into(),
        objectives: evaluation.objectives.into(),
        metrics: evaluation.metrics.into_iter().collect(),
        governing: evaluation.governing.into_iter().map(String::into_boxed_str).collect(),
        structural: evaluation.structural,
    }
}

/// Applies `change` to the counts of every operator in a child's bit set.
fn count(breeding: &mut Breeding, operators: u16, change: impl Fn(&mut super::record::OperatorCount)) {
    let of_child = breeding.operators.iter_mut().enumerate().filter(|(bit, _)| operators >> bit & 1 == 1);
    of_child.for_each(|(_, counts)| change(counts));
}

fn mean(points: &[&[f64]]) -> Vec<f64> {
    let Some(first) = points.first() else { return Vec::new() };
    let sum = |m: usize| points.iter().fold(0.0, |sum, p| sum + p[m]);
    (0..first.len()).map(|m| sum(m) / points.len() as f64).collect()
}
