//! A deletion appended, of a strip reached by the shortest walk.

use super::walk::Walks;
use crate::grammar::{Token, Tokens, Walker};
use crate::mesh::StripId;
use crate::random::{Rng, below};

/// Appends to an expressed string, whose decoding `walker` has followed to the end, the shortest walk to a strip
/// drawn at random among those that can be deleted, and a `D`. `None` if none can within `max` tokens.
pub(super) fn append_deletion(
    walker: Walker,
    expressed: &Tokens,
    max: usize,
    rng: &mut Rng,
) -> Option<Tokens> {
    let room = max.checked_sub(expressed.len() + 1)?;
    let walks = Walks::from(walker.mesh(), walker.marker());
    let darts = walks.within(room);
    let mut strips: Vec<StripId> = darts.iter().map(|&d| walker.mesh().strip(d)).collect();
    strips.sort_unstable();
    strips.dedup();
    while !strips.is_empty() {
        let strip = strips.swap_remove(below(rng, strips.len()));
        // The nearest darts of the strip: where the marker stands decides whether it survives the deletion.
        for &dart in darts.iter().filter(|d| walker.mesh().strip(**d) == strip).take(2) {
            let mut tokens = walks.to(dart);
            tokens.push(Token::Delete);
            let mut ahead = walker.clone();
            let last = tokens.iter().map(|&token| ahead.apply(token)).last();
            if last.is_some_and(|effect| effect.is_applied()) {
                return Some(expressed.iter().chain(&tokens).copied().collect());
            }
        }
    }
    None
}
