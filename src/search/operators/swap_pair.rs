//! `A`, `A*` and `A°` of a pair swapped.

use crate::grammar::{Token, Tokens};
use crate::random::{Rng, below};

/// What a pair can mean: regular or pole at each end, or closed.
const KINDS: [[Token; 2]; 5] = [
    [Token::Add, Token::Add],
    [Token::AddPole, Token::Add],
    [Token::Add, Token::AddPole],
    [Token::AddPole, Token::AddPole],
    [Token::AddClosed, Token::AddClosed],
];

/// Gives one pair of an expressed string another meaning; `None` if there is no pair.
pub(super) fn swap_pair(expressed: &Tokens, rng: &mut Rng) -> Option<Tokens> {
    let additions: Vec<usize> = (0..expressed.len()).filter(|&k| expressed[k].is_addition()).collect();
    let pairs: Vec<&[usize]> = additions.chunks_exact(2).collect();
    if pairs.is_empty() {
        return None;
    }
    let pair = pairs[below(rng, pairs.len())];
    let now = meaning([expressed[pair[0]], expressed[pair[1]]]);
    let others: Vec<[Token; 2]> = KINDS.into_iter().filter(|kind| *kind != now).collect();
    let [first, second] = others[below(rng, others.len())];
    let mut swapped = expressed.clone();
    swapped[pair[0]] = first;
    swapped[pair[1]] = second;
    Some(swapped)
}

/// A pair is closed if either of its tokens is.
fn meaning(pair: [Token; 2]) -> [Token; 2] {
    if pair.contains(&Token::AddClosed) { [Token::AddClosed; 2] } else { pair }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::stream;

    #[test]
    fn one_pair_changes_and_the_walk_stays() {
        let before: Tokens = "PATTADTA*TPAo".parse().unwrap();
        for k in 0..50 {
            let after = swap_pair(&before, &mut stream(1, k, 0)).expect("two pairs");
            assert_eq!(after.len(), before.len());
            assert!((1..=2).contains(&before.hamming(&after).expect("same length")), "{after}");
        }
        assert_eq!(swap_pair(&"TTD".parse().unwrap(), &mut stream(1, 0, 0)), None);
    }
}
