//! Random strings to start a search from (measured in `tests/data/grammar/README.md`).
//!
//! Tokens drawn alike are a bad start: most pairs of `A` have no `T` between them, so deletion wins.

use std::ops::RangeInclusive;

use crate::mesh::InitialMesh;
use crate::random::{Rng, below, chance, unit, weighted};

use super::rules::Rules;
use super::tokens::{Token, Tokens};
use super::walker::Walker;

/// How often what is drawn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Shares {
    /// Chance of a token outside a pair to open one, and of one inside to close it once it may be closed.
    pub addition: f64,
    /// Chance of a token outside a pair to be `D`. The rest are moves.
    pub deletion: f64,
    /// Of the moves, how many are `P`; the others are `T`.
    pub pivot: f64,
    /// Of the `A`s, how many are `A*`. Rare: a dense pole has as many members as its strips have rows, and of 1,439
    /// random Great Court designs with a pole none kept the limits of a pattern that can be built.
    pub pole: f64,
    /// Of the `A`s, how many are `A°`.
    pub closed: f64,
    /// Fewest `T`s between the `A`s of a pair. With 1 most new strips are single faces stuck onto an edge.
    pub least_turns: usize,
}

impl Default for Shares {
    fn default() -> Self {
        Self { addition: 0.3, deletion: 0.1, pivot: 0.5, pole: 0.04, closed: 0.15, least_turns: 2 }
    }
}

/// How often [`aware`] gives up a pair that cannot be closed before it fills up with moves.
const TRIES: u32 = 8;

/// Every token alike, a length drawn from `lengths`.
pub fn uniform(rng: &mut Rng, lengths: RangeInclusive<usize>) -> Tokens {
    let length = draw_length(rng, &lengths);
    (0..length).map(|_| Token::ALL[below(rng, Token::ALL.len())]).collect()
}

/// `A`s in pairs with `least_turns` `T`s or more between them, `D` outside pairs; a length drawn from `lengths`.
pub fn structured(rng: &mut Rng, lengths: RangeInclusive<usize>, shares: &Shares) -> Tokens {
    let length = draw_length(rng, &lengths);
    let mut tokens = Vec::with_capacity(length);
    let mut turns = None;
    while tokens.len() < length {
        let rest = length - tokens.len();
        let token = match turns {
            None if rest >= shares.least_turns + 2 => outside_pair(rng, shares),
            None => without_pair(rng, shares),
            Some(turns) => {
                let missing = shares.least_turns.saturating_sub(turns);
                if missing == 0 && (rest == 1 || chance(rng, shares.addition)) {
                    addition(rng, shares)
                } else if missing > 0 && rest <= missing + 1 {
                    Token::Turn
                } else {
                    step(rng, shares)
                }
            }
        };
        turns = match (token, turns) {
            (token, None) if token.is_addition() => Some(0),
            (token, Some(_)) if token.is_addition() => None,
            (Token::Turn, Some(turns)) => Some(turns + 1),
            (_, turns) => turns,
        };
        tokens.push(token);
    }
    Tokens(tokens)
}

/// As [`structured`], but follows the decoding: a pair is closed only where that is applicable, and `D` stands only
/// where it is. A string may be longer than the length drawn, up to the longest, if that lets its last pair close.
pub fn aware(
    rng: &mut Rng,
    lengths: RangeInclusive<usize>,
    shares: &Shares,
    initial: &InitialMesh,
    rules: Rules,
) -> Tokens {
    let mut author =
        Author { walker: Walker::new(initial, rules), tokens: Vec::new(), shares, longest: *lengths.end() };
    let length = draw_length(rng, &lengths);
    let mut tries = 0;
    while author.tokens.len() < length {
        let room = author.longest - author.tokens.len() >= shares.least_turns + 2;
        let token = if room && tries < TRIES { outside_pair(rng, shares) } else { without_pair(rng, shares) };
        if token.is_addition() {
            tries += u32::from(!author.write_pair(rng));
        } else if token != Token::Delete || !author.write_if_applied(token) {
            let token = if token == Token::Delete { step(rng, shares) } else { token };
            author.write(token);
        }
    }
    Tokens(author.tokens)
}

/// Writes a string and reads it along.
struct Author<'a> {
    walker: Walker,
    tokens: Vec<Token>,
    shares: &'a Shares,
    longest: usize,
}

impl Author<'_> {
    fn write(&mut self, token: Token) {
        self.walker.apply(token);
        self.tokens.push(token);
    }

    fn write_if_applied(&mut self, token: Token) -> bool {
        let mut ahead = self.walker.clone();
        let applied = ahead.apply(token).is_applied();
        if applied {
            self.walker = ahead;
            self.tokens.push(token);
        }
        applied
    }

    /// Writes a whole pair, or nothing if no way to close it was met in time.
    fn write_pair(&mut self, rng: &mut Rng) -> bool {
        let (before, start) = (self.walker.clone(), self.tokens.len());
        let mut opening = addition(rng, self.shares);
        if opening == Token::Add && self.walker.mesh().gap(self.walker.marker()).is_none() {
            opening = if chance(rng, 0.5) { Token::AddPole } else { Token::AddClosed };
        }
        self.write(opening);
        let mut turns = 0;
        while self.tokens.len() < self.longest {
            if turns >= self.shares.least_turns
                && let Some(closing) = self.closing(rng)
            {
                self.write(closing);
                return true;
            }
            if self.tokens.len() + 1 < self.longest {
                let token = step(rng, self.shares);
                turns += usize::from(token == Token::Turn);
                self.write(token);
            } else {
                break;
            }
        }
        self.walker = before;
        self.tokens.truncate(start);
        false
    }

    /// A closing `A…` that is applicable here, or none: there is none, or the path goes on.
    fn closing(&mut self, rng: &mut Rng) -> Option<Token> {
        let mut choices: Vec<(Token, f64)> = Vec::new();
        let shares = self.shares;
        let weights = [
            (Token::Add, 1.0 - shares.pole - shares.closed),
            (Token::AddPole, shares.pole),
            (Token::AddClosed, shares.closed),
        ];
        for (token, weight) in weights {
            if matches!(self.walker.preview_addition(token), Some(Ok(_))) {
                choices.push((token, weight.max(0.0)));
            }
        }
        let total: f64 = choices.iter().map(|(_, weight)| weight).sum();
        // A pole can nearly always close a pair: by its own share, lest every path ends in one at once.
        let only_pole = choices.iter().all(|&(token, _)| token == Token::AddPole);
        let go = if only_pole { shares.addition * shares.pole } else { shares.addition.max(0.5) };
        if choices.is_empty() || total <= 0.0 || !chance(rng, go) {
            return None;
        }
        weighted(rng, &choices)
    }
}

fn draw_length(rng: &mut Rng, lengths: &RangeInclusive<usize>) -> usize {
    let (low, high) = (*lengths.start(), *lengths.end());
    low + below(rng, high.saturating_sub(low) + 1)
}

fn step(rng: &mut Rng, shares: &Shares) -> Token {
    if chance(rng, shares.pivot) { Token::Pivot } else { Token::Turn }
}

fn addition(rng: &mut Rng, shares: &Shares) -> Token {
    let drawn = unit(rng);
    if drawn < shares.pole {
        Token::AddPole
    } else if drawn < shares.pole + shares.closed {
        Token::AddClosed
    } else {
        Token::Add
    }
}

fn outside_pair(rng: &mut Rng, shares: &Shares) -> Token {
    if chance(rng, shares.addition) { addition(rng, shares) } else { without_pair(rng, shares) }
}

fn without_pair(rng: &mut Rng, shares: &Shares) -> Token {
    if chance(rng, shares.deletion) { Token::Delete } else { step(rng, shares) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grammar::Effect;
    use crate::mesh::BaseMesh;
    use crate::random::stream;

    fn square() -> InitialMesh {
        let base = BaseMesh {
            vertices: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
            faces: vec![vec![0, 1, 2, 3]],
            corners: vec![vec![0], vec![1], vec![2], vec![3]],
            ..BaseMesh::default()
        };
        InitialMesh::from_base(&base).unwrap()
    }

    /// How many of a string's `A` tokens belong to an applied pair, and of its `D` tokens are applied: (applied, all).
    fn applied(initial: &InitialMesh, tokens: &Tokens, rules: Rules) -> [(usize, usize); 2] {
        let mut walker = Walker::new(initial, rules);
        let mut counts = [(0, 0); 2];
        for &token in tokens.iter() {
            match (token, walker.apply(token)) {
                (Token::Delete, effect) => {
                    counts[1].0 += usize::from(effect.is_applied());
                    counts[1].1 += 1;
                }
                (token, effect) if token.is_addition() => {
                    counts[0].0 += if matches!(effect, Effect::Added(_)) { 2 } else { 0 };
                    counts[0].1 += 1;
                }
                _ => {}
            }
        }
        counts
    }

    #[test]
    fn lengths_are_respected() {
        let initial = square();
        for i in 0..300 {
            let mut rng = stream(3, 0, i);
            for (low, high) in [(0, 0), (1, 3), (4, 12), (10, 10), (30, 40)] {
                let shares = Shares::default();
                let strings = [
                    uniform(&mut rng, low..=high),
                    structured(&mut rng, low..=high, &shares),
                    aware(&mut rng, low..=high, &shares, &initial, Rules::Plain),
                ];
                for string in strings {
                    assert!((low..=high).contains(&string.len()), "{string} is not of {low}..={high}");
                }
            }
        }
    }

    #[test]
    fn structured_closes_every_pair_with_turns_between() {
        for i in 0..300 {
            let string = structured(&mut stream(4, 0, i), 5..=30, &Shares::default());
            let mut turns = None;
            for token in string.iter() {
                match (token, turns) {
                    (token, None) if token.is_addition() => turns = Some(0),
                    (token, Some(n)) if token.is_addition() => {
                        assert!(n >= 2, "{string}");
                        turns = None;
                    }
                    (Token::Turn, Some(n)) => turns = Some(n + 1),
                    (Token::Delete, Some(_)) => panic!("D inside a pair: {string}"),
                    _ => {}
                }
            }
            assert_eq!(turns, None, "{string} ends while collecting");
        }
    }

    #[test]
    fn aware_writes_only_what_is_applied() {
        let initial = square();
        let mut additions = 0;
        for i in 0..200 {
            for rules in [Rules::Plain, Rules::Domain] {
                let string = aware(&mut stream(5, 0, i), 4..=40, &Shares::default(), &initial, rules);
                for (applied, all) in applied(&initial, &string, rules) {
                    assert_eq!(applied, all, "{string}");
                }
                additions += string.iter().filter(|token| token.is_addition()).count();
            }
        }
        assert!(additions > 400, "only {additions} additions");
    }
}
