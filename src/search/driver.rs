//! The run: generation after generation until a stopping rule holds (NSGA-II, Deb et al. 2002, §III-C).

use std::cell::RefCell;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use super::breeding::{Brood, breed};
use super::child::Child;
use super::observer::{Observer, Progress};
use super::outcome::{Ended, Outcome};
use super::params::SearchParams;
use super::problem::{Evaluation, Problem};
use super::record::GenerationRow;
use super::server::Server;
use super::state::{Settings, State};
use super::stop::StopFlag;
use super::store::{Store, StoreError};

/// A run ends when this many generations in a row bring nothing new.
const BARREN: usize = 100;

/// Runs the search, from the beginning or from where `store` left off.
///
/// The same `problem`, `settings` and recorded state give the same [`Outcome`], whatever the server's threads and
/// however often the run was interrupted; only a run ended by minutes or a signal ends wherever it was.
///
/// # Errors
/// If the store cannot be read or written; what is on disk can be resumed.
pub fn run<P: Problem>(
    problem: &P,
    server: &dyn Server,
    settings: &Settings,
    stop: &StopFlag,
    mut store: Option<&mut Store>,
    observer: &mut dyn Observer,
) -> Result<Outcome, StoreError> {
    let limits = Limits::of(&settings.search);
    let mut state = match store.as_deref_mut() {
        Some(store) => store.recover(settings, observer),
        None => State::new(&settings.search),
    };
    let resumed = state.next_generation();
    loop {
        if let Some(signal) = stop.raised() {
            return Ok(Outcome::of(state, Ended::Interrupted(signal)));
        }
        if let Some(ended) = limits.reached(&state) {
            if resumed > 0 && resumed == state.next_generation() {
                observer.notice(&nothing_to_do(resumed - 1, ended, settings));
            }
            return Ok(Outcome::of(state, ended));
        }
        let mut brood = Brood::default();
        let mut evaluations = Vec::new();
        let mut ended = None;
        let size = match state.next_generation() {
            0 => settings.search.first(),
            _ => settings.search.population.saturating_mul(settings.search.islands),
        };
        for _ in 0..=settings.search.refills {
            let wanted = size.saturating_sub(filled(&brood.children, &evaluations));
            if wanted == 0 || ended.is_some() {
                break;
            }
            let chance = (&settings.search, settings.seed, stop);
            let stopped = breed(problem, server, chance, &mut state, (&mut brood, wanted), observer);
            let batch = Batch { children: &brood.children, state: &state, settings, limits: &limits, stop };
            (evaluations, ended) = batch.evaluate(evaluations, server, store.as_deref_mut(), observer)?;
            // What was bred may all be known, yet the generation is not whole.
            ended = ended.or(stopped.map(Ended::Interrupted));
        }
        state.finish(settings, brood.children, evaluations, brood.breeding);
        if let Some(ended) = ended {
            return Ok(Outcome::of(state, ended));
        }
        if let Some(store) = store.as_deref_mut() {
            store.checkpoint(&state)?;
        }
        if let Some(row) = state.generations.last() {
            observer.generation(row);
        }
    }
}

/// Why a resumed run is over before it goes on.
fn nothing_to_do(done: u32, ended: Ended, settings: &Settings) -> String {
    let asked = match ended {
        Ended::Generations => format!("{} generations are asked for", settings.search.generations),
        _ => "another of its limits is reached".to_owned(),
    };
    format!("the run has already done {done} generations, and {asked}: nothing is done")
}

/// How many children count, rather than being cheap failures: analysed, feasible, or known before.
fn filled(children: &[Child], evaluations: &[Option<Evaluation>]) -> usize {
    let counts = |e: &Evaluation| e.structural || e.violation.is_feasible();
    let children = children.iter().zip(evaluations);
    children.filter(|(child, e)| child.cached.is_some() || e.as_ref().is_some_and(counts)).count()
}

/// The stopping rules.
struct Limits {
    generations: u32,
    evaluations: Option<u64>,
    deadline: Option<Instant>,
    stall: Option<u32>,
}

impl Limits {
    fn of(search: &SearchParams) -> Self {
        let minutes = search.minutes.and_then(|m| Duration::try_from_secs_f64(m * 60.0).ok());
        Self {
            generations: search.generations,
            evaluations: search.evaluations,
            deadline: minutes.and_then(|d| Instant::now().checked_add(d)),
            stall: search.stall_generations,
        }
    }

    /// Whether the time of this sitting is used up.
    fn late(&self) -> bool {
        self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }

    fn reached(&self, state: &State) -> Option<Ended> {
        // The first population is generation 0; `generations` more are bred from it.
        if state.next_generation() > self.generations {
            return Some(Ended::Generations);
        }
        if self.evaluations.is_some_and(|budget| state.structural() >= budget) {
            return Some(Ended::Evaluations);
        }
        if self.stall.is_some_and(|stall| stalled(state) >= stall as usize) {
            return Some(Ended::Stall);
        }
        if barren(state) >= BARREN {
            return Some(Ended::Exhausted);
        }
        self.late().then_some(Ended::Minutes)
    }
}

/// For how many generations since the first feasible design the search has not got further: the hypervolume has not grown, or,
/// before it is known, no feasible design was found. None while it is 0: a reference that dominates nothing does not tell.
fn stalled(state: &State) -> usize {
    let Some(last) = state.generations.last().filter(|g| g.feasible > 0) else { return 0 };
    let same = |g: &&GenerationRow| match last.hypervolume {
        Some(volume) => volume > 0.0 && g.hypervolume == last.hypervolume,
        None => g.feasible == last.feasible,
    };
    state.generations.iter().rev().take_while(same).count().saturating_sub(1)
}

/// For how many generations nothing was evaluated.
fn barren(state: &State) -> usize {
    let evaluations = state.rows.len() as u64;
    let same = state.generations.iter().rev().take_while(|g| g.evaluations == evaluations).count();
    same.saturating_sub(1)
}

/// The new designs of one generation so far.
struct Batch<'a> {
    children: &'a [Child],
    state: &'a State,
    settings: &'a Settings,
    limits: &'a Limits,
    stop: &'a StopFlag,
}

impl Batch<'_> {
    /// An evaluation for every new child, those of the first children being there already; and why the run ends here
    /// if it does, with some of them missing.
    ///
    /// A budget of structural evaluations is kept exactly and independently of threads: near its end only as many
    /// designs are begun as may still count.
    fn evaluate(
        &self,
        done: Vec<Option<Evaluation>>,
        server: &dyn Server,
        store: Option<&mut Store>,
        observer: &mut dyn Observer,
    ) -> Result<(Vec<Option<Evaluation>>, Option<Ended>), StoreError> {
        let new: Vec<usize> =
            (done.len()..self.children.len()).filter(|&k| self.children[k].cached.is_none()).collect();
        let mut sitting = Sitting::new(self, done, new.len(), store, observer);
        let mut structural = sitting.progress.structural;
        let mut begun = 0;
        while begun < new.len() {
            let room = match self.limits.evaluations {
                Some(budget) => usize::try_from(budget.saturating_sub(structural)).unwrap_or(usize::MAX),
                None => usize::MAX,
            };
            if room == 0 {
                return Ok((sitting.evaluations, Some(Ended::Evaluations)));
            }
            let part = &new[begun..new.len().min(begun.saturating_add(room))];
            if let Some(ended) = sitting.serve(part, server)? {
                return Ok((sitting.evaluations, Some(ended)));
            }
            let done = part.iter().filter_map(|&k| sitting.evaluations[k].as_ref());
            structural += done.filter(|e| e.structural).count() as u64;
            begun += part.len();
        }
        Ok((sitting.evaluations, None))
    }
}

/// Takes evaluations as they come, and writes them down at once.
struct Sitting<'a> {
    batch: &'a Batch<'a>,
    store: Option<&'a mut Store>,
    observer: &'a mut dyn Observer,
    evaluations: Vec<Option<Evaluation>>,
    progress: Progress,
}

impl<'a> Sitting<'a> {
    fn new(
        batch: &'a Batch<'a>,
        done: Vec<Option<Evaluation>>,
        pending: usize,
        store: Option<&'a mut Store>,
        observer: &'a mut dyn Observer,
    ) -> Self {
        let state = batch.state;
        let count =
            |holds: fn(&Evaluation) -> bool| done.iter().flatten().filter(|&e| holds(e)).count() as u64;
        let progress = Progress {
            generation: state.next_generation(),
            evaluations: state.rows.len() as u64 + count(|_| true),
            structural: state.structural() + count(|e| e.structural),
            feasible: state.feasible() + count(|e| e.violation.is_feasible()),
            pending: pending as u64,
            recovered: 0,
        };
        let mut evaluations = done;
        evaluations.resize(batch.children.len(), None);
        Self { batch, store, observer, evaluations, progress }
    }

    /// Evaluates the children with the numbers `part`; returns why it stopped before all were done.
    fn serve(&mut self, part: &[usize], server: &dyn Server) -> Result<Option<Ended>, StoreError> {
        let Batch { children, limits, stop, .. } = *self.batch;
        let mut missing = Vec::new();
        for &k in part {
            match self.store.as_deref_mut().and_then(|store| store.recovered(children[k].identity.code)) {
                Some(evaluation) => self.take(k, evaluation, true),
                None => missing.push(k),
            }
        }
        let strings: Vec<_> = missing.iter().map(|&k| children[k].tokens.clone()).collect();
        let broken = AtomicBool::new(false);
        let failure = RefCell::new(None);
        let halt = || stop.raised().is_some() || limits.late() || broken.load(Ordering::Relaxed);
        server.serve(&strings, &halt, &mut |index, evaluation| {
            let k = missing[index];
            let evaluation = evaluation.sanitised(self.batch.settings.objectives);
            if let Err(error) = self.record(k, &evaluation) {
                broken.store(true, Ordering::Relaxed);
                failure.borrow_mut().get_or_insert(error);
            }
            self.take(k, evaluation, false);
        });
        if let Some(error) = failure.into_inner() {
            return Err(error);
        }
        if part.iter().all(|&k| self.evaluations[k].is_some()) {
            return Ok(None);
        }
        Ok(Some(stop.raised().map_or(Ended::Minutes, Ended::Interrupted)))
    }

    fn record(&mut self, k: usize, evaluation: &Evaluation) -> Result<(), StoreError> {
        let generation = self.batch.state.next_generation();
        match self.store.as_deref_mut() {
            Some(store) => store.append(generation, k as u32, &self.batch.children[k], evaluation),
            None => Ok(()),
        }
    }

    fn take(&mut self, k: usize, evaluation: Evaluation, recovered: bool) {
        self.progress.evaluations += 1;
        self.progress.structural += u64::from(evaluation.structural);
        self.progress.feasible += u64::from(evaluation.violation.is_feasible());
        self.progress.pending -= 1;
        self.progress.recovered += u64::from(recovered);
        self.observer.design(self.batch.children[k].identity.code, &evaluation);
        self.evaluations[k] = Some(evaluation);
        self.observer.evaluated(&self.progress);
    }
}
