//! How new strings are made from old ones (docs/reference/search.md §2).

mod append_deletion;
mod append_path;
mod append_strip;
mod crossover;
mod drop_last;
mod growth;
mod insert;
mod neighbours;
mod paths;
mod remove;
mod substitute;
mod swap_pair;
mod walk;

use std::fmt;

use super::params::TokenBounds;
use crate::grammar::{Token, Tokens};
use crate::random::{Rng, below};

pub use crossover::crossover;
pub use drop_last::drop_last;
pub use growth::Growth;
pub use insert::insert;
pub use neighbours::Reach;
pub use remove::remove;
pub use substitute::substitute;
pub use swap_pair::swap_pair;

/// Everything that can have a part in making a string. A string may owe itself to several of them.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Operator {
    /// A new random string.
    Random,
    /// One cut at the same place in both parents.
    OnePoint,
    /// A middle piece exchanged, cut at the same places in both parents.
    TwoPoint,
    /// One cut, at a place of its own in each parent.
    CutAndSplice,
    /// One cut at the end of a rule in each parent.
    RuleEnds,
    /// Tokens inserted.
    Insert,
    /// Tokens removed.
    Remove,
    /// Tokens substituted.
    Substitute,
    /// Near the initial mesh, found step by step.
    Near,
    /// A strip appended along a valid polyedge.
    AppendStrip,
    /// A strip appended along a natural polyedge.
    AppendNatural,
    /// A strip appended along a short polyedge.
    AppendShort,
    /// A deletion appended.
    AppendDeletion,
    /// The last rule dropped.
    DropLast,
    /// `A`, `A*` and `A°` of a pair swapped.
    SwapPair,
}

/// All operators, in the order in which they are counted and listed.
pub const OPERATORS: [Operator; 15] = [
    Operator::Random,
    Operator::Near,
    Operator::OnePoint,
    Operator::TwoPoint,
    Operator::CutAndSplice,
    Operator::RuleEnds,
    Operator::Insert,
    Operator::Remove,
    Operator::Substitute,
    Operator::AppendStrip,
    Operator::AppendNatural,
    Operator::AppendShort,
    Operator::AppendDeletion,
    Operator::DropLast,
    Operator::SwapPair,
];

impl Operator {
    /// The name in files, in the words of the config.
    pub fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::OnePoint => "one_point",
            Self::TwoPoint => "two_point",
            Self::CutAndSplice => "cut_and_splice",
            Self::RuleEnds => "rule_ends",
            Self::Insert => "insert",
            Self::Remove => "remove",
            Self::Substitute => "substitute",
            Self::Near => "near",
            Self::AppendStrip => "append_strip",
            Self::AppendNatural => "append_natural",
            Self::AppendShort => "append_short",
            Self::AppendDeletion => "append_deletion",
            Self::DropLast => "drop_last",
            Self::SwapPair => "swap_pair",
        }
    }
}

/// Where rules end: after each `D` outside a pair, and after the second `A` of a pair. Ascending, in tokens.
pub fn rule_ends(tokens: &[Token]) -> Vec<usize> {
    let mut collecting = false;
    let mut ends = Vec::new();
    for (place, token) in tokens.iter().enumerate() {
        if token.is_addition() {
            collecting = !collecting;
        }
        let rule = token.is_addition() || *token == Token::Delete;
        if rule && !collecting {
            ends.push(place + 1);
        }
    }
    ends
}

/// Brings a string within the bounds: what is too long is cut, what is too short ends in turns, which mean nothing
/// there.
pub fn fit(tokens: &mut Tokens, bounds: TokenBounds) {
    tokens.truncate(bounds.max);
    while tokens.len() < bounds.min {
        tokens.push(Token::Turn);
    }
}

fn random_token(rng: &mut Rng) -> Token {
    Token::ALL[below(rng, Token::ALL.len())]
}

impl fmt::Display for Operator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::stream;

    #[test]
    fn rules_end_outside_pairs() {
        let tokens: Tokens = "TDATDTAPD".parse().unwrap();
        assert_eq!(rule_ends(&tokens), [2, 7, 9]);
    }

    #[test]
    fn rates_are_per_token_and_limits_hold() {
        let long: Tokens = "T".repeat(1000).parse().unwrap();
        let mut rng = stream(4, 0, 0);
        let mut inserted = long.clone();
        assert!(insert(&mut inserted, 0.1, 2000, &mut rng));
        assert!((1070..1130).contains(&inserted.len()), "{}", inserted.len());
        let mut removed = long.clone();
        assert!(remove(&mut removed, 0.1, 4, &mut rng));
        assert!((870..930).contains(&removed.len()), "{}", removed.len());
        let mut substituted = long.clone();
        assert!(substitute(&mut substituted, 0.1, &mut rng));
        let changed = substituted.hamming(&long).expect("same length");
        assert!((70..130).contains(&changed), "{changed}");

        let mut full = long.clone();
        assert!(!insert(&mut full, 1.0, 1000, &mut rng));
        remove(&mut full, 1.0, 4, &mut rng);
        assert_eq!(full.len(), 4);
        fit(&mut full, TokenBounds { min: 6, max: 9 });
        assert_eq!(full.to_string(), "TTTTTT");
    }
}
