//! Substitution of tokens.

use crate::grammar::{Token, Tokens};
use crate::random::{Rng, below, chance};

/// Every token is replaced by a random other one with probability `rate`. Returns whether any was.
pub fn substitute(tokens: &mut Tokens, rate: f64, rng: &mut Rng) -> bool {
    let mut changed = false;
    for token in tokens.iter_mut() {
        if chance(rng, rate) {
            let others: Vec<Token> = Token::ALL.into_iter().filter(|t| t != token).collect();
            *token = others[below(rng, others.len())];
            changed = true;
        }
    }
    changed
}
