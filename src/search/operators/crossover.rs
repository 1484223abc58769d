//! Crossover: a child from two parents, never longer than the limit.

use super::{Operator, rule_ends};
use crate::grammar::Tokens;
use crate::random::{Rng, below, unit};
use crate::search::params::{CrossoverKinds, TokenBounds};

/// Draws a kind by its weight, and makes a child of `a` and `b` by it.
pub fn crossover(
    a: &Tokens,
    b: &Tokens,
    kinds: &CrossoverKinds,
    bounds: TokenBounds,
    rng: &mut Rng,
) -> (Operator, Tokens) {
    let weights = [
        (Operator::OnePoint, kinds.one_point),
        (Operator::TwoPoint, kinds.two_point),
        (Operator::CutAndSplice, kinds.cut_and_splice),
        (Operator::RuleEnds, kinds.rule_ends),
    ];
    let total: f64 = weights.iter().map(|(_, w)| w).sum();
    let mut left = unit(rng) * total;
    let drawn = weights.iter().find(|(_, weight)| {
        left -= weight;
        left < 0.0
    });
    let kind = drawn.map_or(Operator::OnePoint, |(kind, _)| *kind);
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
        let kinds = CrossoverKinds { one_point: 1.0, two_point: 1.0, cut_and_splice: 1.0, rule_ends: 0.0 };
        let mut seen = std::collections::BTreeSet::new();
        for k in 0..200 {
            let (kind, child) = crossover(&a, &b, &kinds, bounds, &mut stream(5, k, 0));
            assert!((4..=18).contains(&child.len()), "{child}");
            seen.insert(kind);
        }
        assert_eq!(seen.len(), 3);
    }

    #[test]
    fn rule_ends_keep_rules_whole() {
        let a: Tokens = "PATTADPP".parse().unwrap();
        let b: Tokens = "TDTA*TTAoP".parse().unwrap();
        let bounds = TokenBounds { min: 0, max: 40 };
        let kinds = CrossoverKinds { one_point: 0.0, two_point: 0.0, cut_and_splice: 0.0, rule_ends: 1.0 };
        for k in 0..100 {
            let child = crossover(&a, &b, &kinds, bounds, &mut stream(6, k, 0)).1;
            assert_eq!(child.iter().filter(|t| t.is_addition()).count() % 2, 0, "{child}");
        }
    }
}
