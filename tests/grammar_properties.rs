//! What holds of every string on every mesh (GRAMMAR §1–§6), on random strings of fixed seeds.
#![allow(clippy::unwrap_used, reason = "tests")]

mod grammar_cases;
#[path = "grammar_cases/oracle.rs"]
mod oracle;

use grammar_cases::bases;
use oracle::check_string;
use quadrille::grammar::{Rules, Token, Tokens};
use quadrille::random::{Rng, below, stream};

fn random_string(rng: &mut Rng, longest: usize) -> Tokens {
    let length = below(rng, longest + 1);
    (0..length).map(|_| Token::ALL[below(rng, Token::ALL.len())]).collect()
}

#[test]
fn every_string_is_a_valid_mesh_after_every_token() {
    let bases = bases();
    for (k, initial) in bases.values().enumerate() {
        for i in 0..400 {
            let mut rng = stream(1, k as u32, i);
            let tokens = random_string(&mut rng, 200);
            let rules = if i % 2 == 0 { Rules::Plain } else { Rules::Domain };
            check_string(initial, &tokens, rules);
        }
    }
}
