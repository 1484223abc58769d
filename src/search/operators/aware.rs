//! Random strings that follow their own decoding.

use super::random::{random_addition, random_length, random_move};
use crate::grammar::{Token, Tokens, Walker};
use crate::random::{Rng, below, chance};
use crate::search::params::TokenBounds;

/// Fewest turns in a pair: with fewer, the strip is one face on a boundary edge, which a given domain has no room for.
const FEWEST_TURNS: usize = 2;

/// Length uniform within the bounds. A pair opens with `A` only on the boundary, closes only where the addition can
/// be applied, and a `D` is written only where it can be.
pub(super) fn aware(mut walker: Walker, bounds: TokenBounds, rng: &mut Rng) -> Tokens {
    let length = random_length(bounds, rng);
    let mut tokens = Tokens::default();
    let mut turns = 0;
    while tokens.len() < length {
        let token = match walker.polyedge() {
            Some(_) => within_a_pair(&mut walker, turns, rng),
            None => between_pairs(&walker, length - tokens.len(), rng),
        };
        turns = match token {
            Token::Turn => turns + 1,
            _ if token.is_addition() => 0,
            _ => turns,
        };
        walker.apply(token);
        tokens.push(token);
    }
    tokens
}

/// Closes the pair as soon as chance and the mesh allow, else goes on.
fn within_a_pair(walker: &mut Walker, turns: usize, rng: &mut Rng) -> Token {
    if turns >= FEWEST_TURNS && chance(rng, 0.6) {
        let closing = random_addition(rng);
        if matches!(walker.preview_addition(closing), Some(Ok(_))) {
            return closing;
        }
    }
    if chance(rng, 0.65) { Token::Turn } else { Token::Pivot }
}

/// Opens a pair, deletes, or goes on.
fn between_pairs(walker: &Walker, room: usize, rng: &mut Rng) -> Token {
    match below(rng, 20) {
        0..6 if room >= FEWEST_TURNS + 2 => match random_addition(rng) {
            Token::Add if walker.mesh().gap(walker.marker()).is_none() => Token::AddPole,
            opening => opening,
        },
        6..9 if walker.clone().apply(Token::Delete).is_applied() => Token::Delete,
        _ => random_move(rng),
    }
}
