//! Making a generation: parents, operators, and the rule that refuses what is known already.

use super::child::Child;
use super::known::{Known, Verdict};
use super::local::{Footholds, step};
use super::near::Near;
use super::observer::Observer;
use super::operators::{OPERATORS, Operator, crossover, fit, insert, remove, substitute};
use super::params::{Initialiser, SearchParams};
use super::problem::{Identity, Problem, RuleOperator};
use super::record::{Breeding, EvaluatedRow, OperatorCount};
use super::server::Server;
use super::state::{Member, State};
use super::stop::StopFlag;
use crate::evolve::{Fitness, Standing, standings, tournament};
use crate::grammar::Tokens;
use crate::random::{Rng, chance, stream};

/// A place in the generation that is still to be filled.
struct Slot {
    rng: Rng,
    /// The population that the child will belong to, and its parents with it.
    island: usize,
    /// Strings refused so far.
    refused: u32,
}

/// A string as bred, before anybody looked at what it means.
struct Draft {
    tokens: Tokens,
    operators: u16,
    island: usize,
}

/// The strings of one generation so far.
#[derive(Clone, Debug)]
pub(crate) struct Brood {
    /// In the order in which they were accepted.
    pub(crate) children: Vec<Child>,
    /// What happened on the way.
    pub(crate) breeding: Breeding,
    /// Slots opened so far: the number of the next random stream.
    slots: usize,
    /// What is still to be looked at near the initial mesh, in the first generation.
    near: Near,
    /// Rows that the new children among them will have been given.
    rows: u32,
}

impl Default for Brood {
    fn default() -> Self {
        let operators = vec![OperatorCount::default(); OPERATORS.len()];
        let breeding = Breeding { operators, ..Breeding::default() };
        Self { children: Vec::new(), breeding, slots: 0, near: Near::new(), rows: 0 }
    }
}

/// Adds up to `wanted` strings to the brood of generation `state.next_generation()`: seeds and random strings in the
/// first generation, children later.
///
/// Rounds: every open slot drafts one string from its own random stream, in slot order; all drafts are identified
/// (in parallel, nothing is drawn there); then they are judged in slot order. A slot whose drafts were refused
/// `tries` times becomes a random immigrant's, and stays empty after as many refusals again.
///
/// Long strings take long. The signal that raised `stop` between two drafts is returned; the brood is then not whole.
pub(crate) fn breed<P: Problem>(
    problem: &P,
    server: &dyn Server,
    settings: (&SearchParams, u64, &StopFlag),
    state: &mut State,
    (brood, wanted): (&mut Brood, usize),
    observer: &mut dyn Observer,
) -> Option<i32> {
    let (search, seed, stop) = settings;
    let generation = state.next_generation();
    let mut known = std::mem::take(&mut state.known);
    let (mut slot, mut end) = (brood.slots, brood.slots + wanted);
    let mut nursery = Nursery {
        search,
        generation,
        tries: search.duplicates.tries.max(1),
        known: &mut known,
        first_row: state.rows.len() as u32,
        brood,
    };
    if generation == 0 && slot == 0 {
        nursery.take_seeds(problem, server, observer);
        slot = nursery.brood.children.len();
    }
    let mut stopped = None;
    if generation == 0 && search.initial.kind == Initialiser::Near {
        stopped = nursery.take_near(problem, server, end, stop);
        slot = slot.max(nursery.brood.children.len());
        // Beyond the neighbourhood, random strings for those who are still wanted in the population.
        end = slot.max(search.population * search.islands);
    }
    nursery.brood.slots = end.max(slot);
    let parents = Parents::of(state, search);
    let mut open: Vec<Slot> = (slot..end)
        .filter(|_| stopped.is_none())
        .map(|slot| Slot {
            rng: stream(seed, generation, slot as u32),
            island: slot % search.islands,
            refused: 0,
        })
        .collect();
    while !open.is_empty() {
        let drafts: Vec<Draft> = open
            .iter_mut()
            .take_while(|_| stop.raised().is_none())
            .map(|slot| match generation == 0 || slot.refused >= nursery.tries {
                true => random(problem, search, slot),
                false => draft(problem, search, &parents, slot),
            })
            .collect();
        stopped = stop.raised();
        if stopped.is_some() {
            break;
        }
        let strings: Vec<Tokens> = drafts.iter().map(|d| d.tokens.clone()).collect();
        let identities = server.identify(&strings);
        let offers = open.into_iter().zip(drafts).zip(identities);
        open = offers
            .filter_map(|((slot, draft), identity)| nursery.offer(slot, draft, identity, observer))
            .collect();
    }
    state.known = known;
    stopped
}

/// The generation as it fills.
struct Nursery<'a> {
    search: &'a SearchParams,
    generation: u32,
    /// Refusals before a slot becomes an immigrant's.
    tries: u32,
    known: &'a mut Known,
    first_row: u32,
    brood: &'a mut Brood,
}

impl Nursery<'_> {
    /// The empty string and the seeds, refused only if equal to one before.
    fn take_seeds<P: Problem>(&mut self, problem: &P, server: &dyn Server, observer: &mut dyn Observer) {
        let seeds: Vec<Tokens> = [Tokens::default()].into_iter().chain(problem.seeds()).collect();
        let identities = server.identify(&seeds);
        for (tokens, identity) in seeds.into_iter().zip(identities) {
            match identity {
                Ok(identity) if matches!(self.known.judge(&identity), Verdict::New | Verdict::Neighbour) => {
                    let island = self.brood.children.len() % self.search.islands;
                    self.accept(Draft { tokens, operators: 0, island }, identity);
                }
                Ok(_) => {}
                Err(message) => observer.notice(&format!("seed {tokens}: {message}")),
            }
        }
    }

    /// What lies near the initial mesh, each topology once, until there are `wanted` children. Gives back the signal if one
    /// came first.
    fn take_near<P: Problem>(
        &mut self,
        problem: &P,
        server: &dyn Server,
        wanted: usize,
        stop: &StopFlag,
    ) -> Option<i32> {
        while self.brood.children.len() < wanted {
            if let Some(signal) = stop.raised() {
                return Some(signal);
            }
            let Some((tokens, identity)) = self.brood.near.next(problem, server) else { break };
            let operators = bit(Operator::Near);
            self.brood.breeding.bred += 1;
            self.count(operators, |c| c.used += 1);
            match self.known.judge(&identity) {
                Verdict::New => {
                    let island = self.brood.children.len() % self.search.islands;
                    self.accept(Draft { tokens, operators, island }, identity);
                }
                Verdict::Neighbour => self.brood.breeding.neighbours += 1,
                Verdict::Duplicate | Verdict::Cached(_) => self.brood.breeding.duplicates += 1,
            }
        }
        None
    }

    /// Gives back a draft that may be accepted, or refuses it.
    fn judge(
        &mut self,
        draft: Draft,
        identity: Result<Identity, String>,
        observer: &mut dyn Observer,
    ) -> Option<(Draft, Identity)> {
        self.brood.breeding.bred += 1;
        self.count(draft.operators, |c| c.used += 1);
        let identity = match identity {
            Ok(identity) => identity,
            Err(message) => {
                observer.notice(&format!("string {}: {message}", draft.tokens));
                self.brood.breeding.rejected += 1;
                return None;
            }
        };
        match self.known.judge(&identity) {
            Verdict::Duplicate => self.brood.breeding.duplicates += 1,
            Verdict::Neighbour => self.brood.breeding.neighbours += 1,
            _ if self.search.rebreed_rejected && identity.rejected.is_some() => {
                self.brood.breeding.rejected += 1
            }
            _ => return Some((draft, identity)),
        }
        None
    }

    /// Offers a draft to a slot; gives the slot back if it is still open.
    fn offer(
        &mut self,
        mut slot: Slot,
        draft: Draft,
        identity: Result<Identity, String>,
        observer: &mut dyn Observer,
    ) -> Option<Slot> {
        // The first population is random anyway.
        let given_up = self.generation > 0 && slot.refused >= self.tries;
        if let Some((draft, identity)) = self.judge(draft, identity, observer) {
            self.accept(draft, identity);
            self.brood.breeding.immigrants += u64::from(given_up);
            return None;
        }
        slot.refused += 1;
        let empty = slot.refused >= 2 * self.tries;
        self.brood.breeding.empty += u64::from(empty);
        (!empty).then_some(slot)
    }

    fn accept(&mut self, draft: Draft, identity: Identity) {
        let cached = match self.known.judge(&identity) {
            Verdict::Cached(row) => Some(row),
            _ => {
                self.known.insert(identity.code, &identity.neighbourhood, self.first_row + self.brood.rows);
                self.brood.rows += 1;
                None
            }
        };
        self.brood.breeding.cached += u64::from(cached.is_some());
        self.brood.children.push(Child {
            tokens: draft.tokens,
            identity,
            operators: draft.operators,
            island: draft.island,
            cached,
        });
    }

    fn count(&mut self, operators: u16, change: impl Fn(&mut OperatorCount)) {
        for (bit, counts) in self.brood.breeding.operators.iter_mut().enumerate() {
            if operators >> bit & 1 == 1 {
                change(counts);
            }
        }
    }
}

/// Whom children come from.
struct Parents<'a> {
    rows: &'a [EvaluatedRow],
    /// Members and standings of each population.
    islands: Vec<(&'a [Member], Vec<Standing>)>,
    footholds: Footholds,
}

impl<'a> Parents<'a> {
    fn of(state: &'a State, search: &SearchParams) -> Self {
        let rows = &state.rows;
        let island = |members: &'a Vec<Member>| {
            let fitness: Vec<Fitness> = members.iter().map(|m| rows[m.row as usize].fitness()).collect();
            (members.as_slice(), standings(&fitness))
        };
        Self {
            rows,
            islands: state.islands.iter().map(island).collect(),
            footholds: Footholds::of(state, search.survival),
        }
    }

    /// A parent from the population.
    fn pick(&self, island: usize, rng: &mut Rng) -> Option<&'a Member> {
        let (members, standings) = &self.islands[island];
        Some(&members[tournament(standings, rng)?])
    }
}

fn bit(operator: Operator) -> u16 {
    let place = OPERATORS.iter().position(|o| *o == operator);
    place.map_or(0, |place| 1 << place)
}

fn random<P: Problem>(problem: &P, search: &SearchParams, slot: &mut Slot) -> Draft {
    let mut tokens = problem.random(&mut slot.rng);
    fit(&mut tokens, search.tokens);
    Draft { tokens, operators: bit(Operator::Random), island: slot.island }
}

/// One string: random, a local step, or token-wise from one or two parents.
fn draft<P: Problem>(problem: &P, search: &SearchParams, parents: &Parents<'_>, slot: &mut Slot) -> Draft {
    let rng = &mut slot.rng;
    if chance(rng, search.immigrants) {
        return random(problem, search, slot);
    }
    let made = if chance(rng, search.local) { local(problem, parents, slot.island, rng) } else { None };
    let Some((mut tokens, operators)) = made.or_else(|| token_wise(search, parents, slot.island, rng)) else {
        return random(problem, search, slot);
    };
    fit(&mut tokens, search.tokens);
    Draft { tokens, operators, island: slot.island }
}

/// One or two steps from what is good so far.
fn local<P: Problem>(
    problem: &P,
    parents: &Parents<'_>,
    island: usize,
    rng: &mut Rng,
) -> Option<(Tokens, u16)> {
    let row = match parents.footholds.draw(rng) {
        Some(row) => row,
        None => parents.pick(island, rng)?.row,
    };
    let (tokens, made_by) = step(problem, &parents.rows[row as usize].expressed, rng)?;
    Some((tokens, made_by.into_iter().fold(0, |bits, operator| bits | bit(named(operator)))))
}

/// How an operator is listed.
fn named(operator: RuleOperator) -> Operator {
    match operator {
        RuleOperator::AppendStrip => Operator::AppendStrip,
        RuleOperator::AppendNatural => Operator::AppendNatural,
        RuleOperator::AppendShort => Operator::AppendShort,
        RuleOperator::AppendDeletion => Operator::AppendDeletion,
        RuleOperator::SwapPair => Operator::SwapPair,
    }
}

/// Crossover of two parents or a copy of one, then insertion, removal and substitution.
fn token_wise(
    search: &SearchParams,
    parents: &Parents<'_>,
    island: usize,
    rng: &mut Rng,
) -> Option<(Tokens, u16)> {
    let first = &parents.pick(island, rng)?.tokens;
    let mut operators = 0;
    let mut tokens = if chance(rng, search.crossover) {
        let second = &parents.pick(island, rng)?.tokens;
        let (kind, child) = crossover(first, second, search.tokens, rng);
        operators |= bit(kind);
        child
    } else {
        first.clone()
    };
    let rates = search.mutation;
    if remove(&mut tokens, rates.remove, search.tokens.min, rng) {
        operators |= bit(Operator::Remove);
    }
    if substitute(&mut tokens, rates.substitute, rng) {
        operators |= bit(Operator::Substitute);
    }
    if insert(&mut tokens, rates.insert, search.tokens.max, rng) {
        operators |= bit(Operator::Insert);
    }
    Some((tokens, operators))
}
