//! Insertion of random tokens.

use super::random_token;
use crate::grammar::Tokens;
use crate::random::{Rng, chance};

/// Before every token, and at the end, a random token is inserted with probability `rate`, as long as the string
/// stays within `max` tokens. Returns whether anything was.
pub fn insert(tokens: &mut Tokens, rate: f64, max: usize, rng: &mut Rng) -> bool {
    let mut room = max.saturating_sub(tokens.len());
    let old = std::mem::take(&mut tokens.0);
    let before = old.len();
    for token in old.into_iter().map(Some).chain([None]) {
        if chance(rng, rate) && room > 0 {
            tokens.push(random_token(rng));
            room -= 1;
        }
        tokens.extend(token);
    }
    tokens.len() > before
}
