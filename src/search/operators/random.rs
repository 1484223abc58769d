//! Random strings without regard to what they decode to.

use super::random_token;
use crate::grammar::{Token, Tokens};
use crate::random::{Rng, below, chance};
use crate::search::params::TokenBounds;

/// Length uniform within the bounds, all tokens equally likely.
pub fn uniform(bounds: TokenBounds, rng: &mut Rng) -> Tokens {
    let length = random_length(bounds, rng);
    (0..length).map(|_| random_token(rng)).collect()
}

/// Length uniform within the bounds; A's in pairs with two or more T's between, D outside pairs: about 30 % A,
/// 10 % D, the rest moves.
pub fn structured(bounds: TokenBounds, rng: &mut Rng) -> Tokens {
    let length = random_length(bounds, rng);
    let mut tokens = Tokens::default();
    while tokens.len() < length {
        let room = length - tokens.len();
        match below(rng, 20) {
            0..6 if room >= 4 => pair(room, &mut tokens, rng),
            6..9 => tokens.push(Token::Delete),
            _ => tokens.push(random_move(rng)),
        }
    }
    tokens
}

/// A pair with at least two T's between, at most `room` ≥ 4 tokens long.
fn pair(room: usize, tokens: &mut Tokens, rng: &mut Rng) {
    tokens.push(random_addition(rng));
    tokens.extend([Token::Turn, Token::Turn]);
    let mut room = room - 4;
    while room > 0 && chance(rng, 0.5) {
        tokens.push(random_move(rng));
        room -= 1;
    }
    tokens.push(random_addition(rng));
}

/// A length within the bounds, uniformly.
pub(crate) fn random_length(bounds: TokenBounds, rng: &mut Rng) -> usize {
    bounds.min + below(rng, bounds.max.saturating_sub(bounds.min) + 1)
}

/// `T` or `P`.
pub(crate) fn random_move(rng: &mut Rng) -> Token {
    if chance(rng, 0.5) { Token::Turn } else { Token::Pivot }
}

/// `A` mostly, else `A*` or `A°`.
pub(crate) fn random_addition(rng: &mut Rng) -> Token {
    [Token::Add, Token::Add, Token::AddPole, Token::AddClosed][below(rng, 4)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::stream;

    #[test]
    fn lengths_are_within_the_bounds_and_pairs_are_whole() {
        let bounds = TokenBounds { min: 4, max: 12 };
        let mut lengths = std::collections::BTreeSet::new();
        for k in 0..300 {
            let mut rng = stream(2, k, 0);
            lengths.insert(uniform(bounds, &mut rng).len());
            let tokens = structured(bounds, &mut rng);
            assert!((4..=12).contains(&tokens.len()));
            assert_eq!(tokens.iter().filter(|t| t.is_addition()).count() % 2, 0, "{tokens}");
        }
        assert_eq!(lengths.into_iter().collect::<Vec<_>>(), (4..=12).collect::<Vec<_>>());
    }
}
