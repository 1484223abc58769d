//! Operators that follow the decoding, gathered over one initial mesh.

use super::append_deletion::append_deletion;
use super::append_path::{append_natural, append_short};
use super::append_strip::append_strip;
use super::neighbours::{Reach, additions, deletions, natural_additions};
use super::swap_pair::swap_pair;
use crate::grammar::random::{self, Shares};
use crate::grammar::{Rules, Token, Tokens, Walker};
use crate::mesh::InitialMesh;
use crate::random::Rng;
use crate::search::params::TokenBounds;
use crate::search::problem::{RuleOperator, Steps};

/// Most edges of the simple polyedges along which strips near the initial mesh are added.
const NEAR: usize = 6;

/// How strings grow from an initial mesh: what a [`Problem`](crate::search::Problem) on real meshes answers to
/// `random` and `vary`.
#[derive(Clone, Copy, Debug)]
pub struct Growth<'a> {
    /// Where decoding starts.
    pub initial: &'a InitialMesh,
    /// Which results a string may have.
    pub rules: Rules,
    /// How long a string may be.
    pub bounds: TokenBounds,
}

impl Growth<'_> {
    /// A random string.
    pub fn random(&self, rng: &mut Rng) -> Tokens {
        random::aware(rng, self.bounds.min..=self.bounds.max, &Shares::default(), self.initial, self.rules)
    }

    /// A rule-wise operator on an expressed string; `None` where it does not apply.
    pub fn vary(&self, operator: RuleOperator, expressed: &Tokens, rng: &mut Rng) -> Option<Tokens> {
        match operator {
            RuleOperator::AppendStrip => append_strip(self.read(expressed), expressed, self.bounds.max, rng),
            RuleOperator::AppendDeletion => {
                append_deletion(self.read(expressed), expressed, self.bounds.max, rng)
            }
            RuleOperator::AppendNatural => {
                append_natural(&self.read(expressed), expressed, self.bounds.max, rng)
            }
            RuleOperator::AppendShort => append_short(&self.read(expressed), expressed, self.bounds.max, rng),
            RuleOperator::SwapPair => swap_pair(expressed, rng),
        }
    }

    /// All strings that lead from an expressed string one strip further; several may have the same topology.
    pub fn neighbours(&self, expressed: &Tokens, reach: Reach) -> Vec<Tokens> {
        let walker = self.read(expressed);
        appended(expressed, [deletions(&walker), additions(&walker, reach)].concat())
    }

    /// The strings that lead from an expressed string one step of a kind further, as far as they are not too long.
    pub fn steps(&self, steps: Steps, expressed: &Tokens) -> Vec<Tokens> {
        let walker = self.read(expressed);
        let rules = match steps {
            Steps::Natural => [deletions(&walker), natural_additions(&walker)].concat(),
            Steps::Simple => additions(&walker, Reach { edges: NEAR, poles: false }),
        };
        let mut strings = appended(expressed, rules);
        strings.retain(|tokens| tokens.len() <= self.bounds.max);
        strings
    }

    fn start(&self) -> Walker {
        Walker::new(self.initial, self.rules)
    }

    fn read(&self, tokens: &Tokens) -> Walker {
        let mut walker = self.start();
        tokens.iter().for_each(|&token| {
            walker.apply(token);
        });
        walker
    }
}

/// An expressed string with each of these rules at its end.
fn appended(expressed: &Tokens, rules: Vec<Vec<Token>>) -> Vec<Tokens> {
    let append = |rule: Vec<Token>| expressed.iter().copied().chain(rule).collect();
    rules.into_iter().map(append).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grammar::{Token, decode};
    use crate::mesh::samples;
    use crate::random::stream;

    fn grid() -> InitialMesh {
        InitialMesh::from_base(&samples::grid(3, 3)).expect("a grid")
    }

    fn growth(initial: &InitialMesh) -> Growth<'_> {
        Growth { initial, rules: Rules::Domain, bounds: TokenBounds { min: 4, max: 40 } }
    }

    #[test]
    fn aware_strings_apply_most_of_their_pairs() {
        let initial = grid();
        let growth = growth(&initial);
        let (mut tokens, mut applied, mut rules) = (0, 0, 0);
        for k in 0..300 {
            let string = growth.random(&mut stream(3, k, 0));
            assert!((4..=40).contains(&string.len()));
            let decoded = decode(&initial, &string, Rules::Domain);
            tokens += string.iter().filter(|t| t.is_addition()).count();
            applied += decoded.expressed.iter().filter(|t| t.is_addition()).count();
            rules += decoded.trace.iter().filter(|effect| effect.is_applied()).count();
        }
        assert!(applied * 10 > tokens * 8, "{applied} of {tokens} A's have an effect");
        assert!(rules > 600, "{rules} rules in 300 strings");
    }

    #[test]
    fn appended_rules_are_applied_and_leave_the_rest_alone() {
        let initial = grid();
        let growth = growth(&initial);
        let mut appended = [0, 0];
        for k in 0..200 {
            let mut rng = stream(4, k, 0);
            let string = growth.random(&mut rng);
            let before = decode(&initial, &string, Rules::Domain).expressed;
            for (n, operator) in
                [RuleOperator::AppendStrip, RuleOperator::AppendDeletion].into_iter().enumerate()
            {
                let Some(longer) = growth.vary(operator, &before, &mut rng) else { continue };
                appended[n] += 1;
                assert!(longer.len() <= 40 && longer[..before.len()] == before[..]);
                let decoded = decode(&initial, &longer, Rules::Domain);
                assert_eq!(decoded.expressed, longer, "nothing is skipped");
                assert!(decoded.trace.last().is_some_and(|effect| effect.is_applied()));
                let rule = longer[before.len()..].iter().filter(|t| **t == Token::Delete).count();
                assert_eq!(rule, n, "{longer}");
            }
        }
        assert!(appended[0] > 100 && appended[1] > 100, "{appended:?}");
    }
}
