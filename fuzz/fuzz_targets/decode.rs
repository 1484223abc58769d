//! Any string on any of the reference meshes: valid after every token, same topology, expressed form the same mesh.
#![no_main]

#[path = "../../tests/grammar_cases/mod.rs"]
mod grammar_cases;
#[path = "../../tests/grammar_cases/oracle.rs"]
mod oracle;

use libfuzzer_sys::fuzz_target;
use quadrille::grammar::{Rules, Token, Tokens, decode};
use quadrille::mesh::{InitialMesh, canonical_mesh};
use std::sync::LazyLock;

static BASES: LazyLock<Vec<InitialMesh>> = LazyLock::new(|| grammar_cases::bases().into_values().collect());

fuzz_target!(|data: &[u8]| {
    let Some((&first, rest)) = data.split_first() else { return };
    let initial = &BASES[usize::from(first) % BASES.len()];
    let rules = if first >= 128 { Rules::Domain } else { Rules::Plain };
    let tokens: Tokens =
        rest.iter().take(200).map(|&byte| Token::ALL[usize::from(byte) % Token::ALL.len()]).collect();
    oracle::check_string(initial, &tokens, rules);
    let text = tokens.to_string();
    assert_eq!(text.parse::<Tokens>().as_ref(), Ok(&tokens));
    let mesh = decode(initial, &tokens, rules).mesh;
    if mesh.edge_count() < 150 {
        canonical_mesh(&mesh);
    }
});
