//! Making a generation: parents, operators, and the rule that refuses what is known already.

use super::child::Child;
use super::known::{Known, Verdict};
use super::local::{Footholds, step};
use super::near::Near;
use super::observer::Observer;
use super::operators::{
    OPERATORS, Operator, crossover, drop_last, fit, insert, remove, substitute, swap_pair,
};
use super::params::{Initialiser, SearchParams};
use super::problem::{Identity, Preview, Problem, RuleOperator};
use super::record::{Breeding, EvaluatedRow, OperatorCount};
use super::screening::Screening;
use super::server::Server;
use super::state::{Member, State};
use super::stop::StopFlag;
use crate::evolve::{Fitness, Standing, standings, tournament};
use crate::grammar::Tokens;
use crate::random::{Rng, below, chance, stream, unit};

/// A place in the generation that is still to be filled.
struct Slot {
    rng: Rng,
    /// The population that the child will belong to, and its parents with it.
    island: usize,
    /// Strings refused so far.
    refused: u32,
    /// What could fill it, each of another topology, when geometry chooses.
    candidates: Vec<(Draft, Identity)>,
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
/// `tries` times becomes a random immigrant's, and stays empty after as many refusals again. Where geometry chooses
/// ([`Screening`]), a slot gathers candidates until it has enough or its drafts were refused that often.
///
/// Long strings take long, and so do many previews. The signal that raised `stop` between two drafts is returned; the brood is then not whole.
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
        screening: Screening::of(problem, search, state),
        known: &mut known,
        first_row: state.rows.len() as u32,
        brood,
        full: Vec::new(),
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
            candidates: Vec::new(),
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
        if open.is_empty() {
            (open, stopped) = nursery.choose(server, stop);
        }
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
    screening: Option<Screening<'a>>,
    known: &'a mut Known,
    first_row: u32,
    brood: &'a mut Brood,
    /// Slots with enough candidates.
    full: Vec<Slot>,
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
        match (self.judge(draft, identity, observer), self.screening) {
            (Some((draft, identity)), Some(_)) if !given_up => {
                if slot.candidates.iter().all(|(_, other)| other.code != identity.code) {
                    slot.candidates.push((draft, identity));
                } else {
                    self.brood.breeding.duplicates += 1;
                    slot.refused += 1;
                }
            }
            (Some((draft, identity)), _) => {
                self.accept(draft, identity);
                self.brood.breeding.immigrants += u64::from(given_up);
                return None;
            }
            (None, _) => slot.refused += 1,
        }
        let enough = self.screening.is_some_and(|screening| slot.candidates.len() == screening.candidates);
        if enough || (slot.refused >= self.tries && !slot.candidates.is_empty()) {
            self.full.push(slot);
            return None;
        }
        let empty = slot.refused >= 2 * self.tries;
        self.brood.breeding.empty += u64::from(empty);
        (!empty).then_some(slot)
    }

    /// Fills each full slot with the most promising of its candidates that no slot before it took. Gives back the slots
    /// that found nothing, and the signal if one came first.
    fn choose(&mut self, server: &dyn Server, stop: &StopFlag) -> (Vec<Slot>, Option<i32>) {
        let Some(screening) = self.screening else { return (Vec::new(), None) };
        let strings =
            self.full.iter().flat_map(|slot| &slot.candidates).map(|(draft, _)| draft.tokens.clone());
        let previews = server.preview(&strings.collect::<Vec<_>>(), &|| stop.raised().is_some());
        if let Some(signal) = stop.raised() {
            return (Vec::new(), Some(signal));
        }
        let mut previews = previews.into_iter().flatten();
        let mut emptied = Vec::new();
        for mut slot in std::mem::take(&mut self.full) {
            let mut candidates: Vec<_> = std::mem::take(&mut slot.candidates).into_iter().map(Some).collect();
            let of_slot: Vec<Preview> = previews.by_ref().take(candidates.len()).collect();
            let order = screening.order(&of_slot, &mut slot.rng).into_iter();
            let free = |(_, identity): &(Draft, Identity)| {
                matches!(self.known.judge(identity), Verdict::New | Verdict::Cached(_))
            };
            if let Some((draft, identity)) = order.filter_map(|k| candidates[k].take()).find(free) {
                self.brood.breeding.screened += of_slot.len() as u64 - 1;
                self.accept(draft, identity);
            } else {
                self.brood.breeding.duplicates += of_slot.len() as u64;
                slot.refused += 1;
                emptied.push(slot);
            }
        }
        (emptied, None)
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
    archive: Vec<usize>,
    from_archive: f64,
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
            footholds: Footholds::of(state),
            archive: state.archive.ids().collect(),
            from_archive: search.archive.parents,
        }
    }

    /// A parent's string and its expressed string.
    fn pick(&self, island: usize, rng: &mut Rng) -> Option<(&'a Tokens, &'a Tokens)> {
        if chance(rng, self.from_archive) && !self.archive.is_empty() {
            let row = &self.rows[self.archive[below(rng, self.archive.len())]];
            return Some((&row.tokens, &row.expressed));
        }
        let (members, standings) = &self.islands[island];
        let member = &members[tournament(standings, rng)?];
        Some((&member.tokens, &self.rows[member.row as usize].expressed))
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

/// One string: random, a local step, rule-wise from one parent, or token-wise from one or two.
fn draft<P: Problem>(problem: &P, search: &SearchParams, parents: &Parents<'_>, slot: &mut Slot) -> Draft {
    let rng = &mut slot.rng;
    if chance(rng, search.immigrants) {
        return random(problem, search, slot);
    }
    let made = if search.local > 0.0 && chance(rng, search.local) {
        local(problem, parents, rng)
    } else {
        rule_operator(search, rng)
            .and_then(|operator| rule_wise(problem, operator, parents, slot.island, rng))
    };
    let Some((mut tokens, operators)) = made.or_else(|| token_wise(search, parents, slot.island, rng)) else {
        return random(problem, search, slot);
    };
    fit(&mut tokens, search.tokens);
    Draft { tokens, operators, island: slot.island }
}

/// One or two steps from what is good so far.
fn local<P: Problem>(problem: &P, parents: &Parents<'_>, rng: &mut Rng) -> Option<(Tokens, u16)> {
    let expressed = |row: u32| parents.rows[row as usize].expressed.clone();
    let (tokens, made_by) = step(problem, &parents.footholds, expressed, rng)?;
    Some((tokens, made_by.into_iter().fold(0, |bits, operator| bits | bit(named(operator)))))
}

/// How an operator is listed.
fn named(operator: RuleOperator) -> Operator {
    match operator {
        RuleOperator::AppendStrip => Operator::AppendStrip,
        RuleOperator::AppendNatural => Operator::AppendNatural,
        RuleOperator::AppendShort => Operator::AppendShort,
        RuleOperator::AppendDeletion => Operator::AppendDeletion,
        RuleOperator::DropLast => Operator::DropLast,
        RuleOperator::SwapPair => Operator::SwapPair,
    }
}

/// Draws a rule-wise operator by its share, or none.
fn rule_operator(search: &SearchParams, rng: &mut Rng) -> Option<RuleOperator> {
    let rules = &search.rules;
    let shares = [
        (RuleOperator::AppendStrip, rules.append_strip),
        (RuleOperator::AppendDeletion, rules.append_deletion),
        (RuleOperator::DropLast, rules.drop_last),
        (RuleOperator::SwapPair, rules.swap_pair),
    ];
    let mut left = unit(rng);
    let drawn = shares.into_iter().find(|(_, share)| {
        left -= share;
        left < 0.0
    });
    drawn.map(|(operator, _)| operator)
}

/// On the parent's expressed string, to which a rule can be appended without changing what comes before.
fn rule_wise<P: Problem>(
    problem: &P,
    operator: RuleOperator,
    parents: &Parents<'_>,
    island: usize,
    rng: &mut Rng,
) -> Option<(Tokens, u16)> {
    let (_, expressed) = parents.pick(island, rng)?;
    let tokens = match operator {
        RuleOperator::DropLast => drop_last(expressed)?,
        RuleOperator::SwapPair => swap_pair(expressed, rng)?,
        _ => problem.vary(operator, expressed, rng)?,
    };
    Some((tokens, bit(named(operator))))
}

/// Crossover of two parents or a copy of one, then insertion, removal and substitution.
fn token_wise(
    search: &SearchParams,
    parents: &Parents<'_>,
    island: usize,
    rng: &mut Rng,
) -> Option<(Tokens, u16)> {
    let (first, _) = parents.pick(island, rng)?;
    let mut operators = 0;
    let mut tokens = if chance(rng, search.crossover) {
        let (second, _) = parents.pick(island, rng)?;
        let (kind, child) = crossover(first, second, &search.crossover_kinds, search.tokens, rng);
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
