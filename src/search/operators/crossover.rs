//! Crossover: a child from two parents, never longer than the limit.

use super::{Operator, rule_ends};
use crate::grammar::Tokens;
use crate::random::{Rng, below};
use crate::search::params::TokenBounds;

/// The kinds, of which each is as likely as the others.
const KINDS: [Operator; 4] =
    [Operator::OnePoint, Operator::TwoPoint, Operator::CutAndSplice, Operator::RuleEnds];

/// Draws a kind, and makes a child of `a` and `b` by it.
pub fn crossover(a: &Tokens, b: &Tokens, bounds: TokenBounds, rng: &mut Rng) -> (Operator, Tokens) {
    let kind = KINDS[below(rng, KINDS.len())];
    let child = match kind {
        Operator::TwoPoint => two_point(a, b, rng),
        Operator::CutAndSplice => splice(a, b, &places(a), &places(b), bounds, rng),
        Operator::RuleEnds => splice(a, b, &ends(a), &ends(b), bounds, rng),
        _ => one_point(a, b, rng),
    };
    (kind, child)
}

/// The head of `a` and the tail of `b`, cut at the same place inside both.
fn one_point(a: &Tokens, b: &Tokens, rng: &mut Rng) -> Tokens {
    let shorter = a.len().min(b.len());
    if shorter < 2 {
        return a.clone();
    }
    let cut = 1 + below(rng, shorter - 1);
    a[..cut].iter().chain(&b[cut..]).copied().collect()
}

/// `a` with a middle piece of `b` in the same place.
fn two_point(a: &Tokens, b: &Tokens, rng: &mut Rng) -> Tokens {
    let shorter = a.len().min(b.len());
    let (x, y) = (below(rng, shorter + 1), below(rng, shorter + 1));
    let (from, to) = (x.min(y), x.max(y));
    a[..from].iter().chain(&b[from..to]).chain(&a[to..]).copied().collect()
}

/// The head of `a` up to one of `cuts_a` and the tail of `b` from one of `cuts_b`, such that the length fits; `a`
/// where none does.
fn splice(
    a: &Tokens,
    b: &Tokens,
    cuts_a: &[usize],
    cuts_b: &[usize],
    bounds: TokenBounds,
    rng: &mut Rng,
) -> Tokens {
    let head = cuts_a[below(rng, cuts_a.len())];
    let fits = |tail: &usize| (bounds.min..=bounds.max).contains(&(head + b.len() - tail));
    let tails: Vec<usize> = cuts_b.iter().copied().filter(fits).collect();
    if tails.is_empty() {
        return a.clone();
    }
    let tail = tails[below(rng, tails.len())];
    a[..head].iter().chain(&b[tail..]).copied().collect()
}

/// Every place a string can be cut.
fn places(tokens: &Tokens) -> Vec<usize> {
    (0..=tokens.len()).collect()
}

/// The start and all rule ends.
fn ends(tokens: &Tokens) -> Vec<usize> {
    std::iter::once(0).chain(rule_ends(tokens)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::stream;

    #[test]
    fn every_kind_stays_within_the_limits_and_uses_both_parents() {
        let a: Tokens = "TTTTTTTTTT".parse().unwrap();
        let b: Tokens = "PPPPPPPPPPPPPPPP".parse().unwrap();
        let bounds = TokenBounds { min: 4, max: 18 };
        let mut seen = std::collections::BTreeSet::new();
        for k in 0..200 {
            let (kind, child) = crossover(&a, &b, bounds, &mut stream(5, k, 0));
            assert!((4..=18).contains(&child.len()), "{child}");
            seen.insert(kind);
        }
        assert_eq!(seen.len(), 4);
    }

    #[test]
    fn rule_ends_keep_rules_whole() {
        let a: Tokens = "PATTADPP".parse().unwrap();
        let b: Tokens = "TDTA*TTAoP".parse().unwrap();
        let bounds = TokenBounds { min: 0, max: 40 };
        for k in 0..100 {
            let (kind, child) = crossover(&a, &b, bounds, &mut stream(6, k, 0));
            if kind != Operator::RuleEnds {
                continue;
            }
            assert_eq!(child.iter().filter(|t| t.is_addition()).count() % 2, 0, "{child}");
        }
    }
}
