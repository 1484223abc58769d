//! Removal of tokens.

use crate::grammar::Tokens;
use crate::random::{Rng, chance};

/// Every token is removed with probability `rate`, as long as `min` tokens remain. Returns whether any was.
pub fn remove(tokens: &mut Tokens, rate: f64, min: usize, rng: &mut Rng) -> bool {
    let mut spare = tokens.len().saturating_sub(min);
    let before = tokens.len();
    tokens.retain(|_| {
        let removed = chance(rng, rate) && spare > 0;
        spare -= usize::from(removed);
        !removed
    });
    tokens.len() < before
}
