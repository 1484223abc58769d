//! Small meshes of any faces, poles, marker and corners: refused with a reason, or sound under a string.
#![no_main]

#[path = "../../tests/grammar_cases/oracle.rs"]
mod oracle;

use libfuzzer_sys::arbitrary::{Arbitrary, Unstructured};
use libfuzzer_sys::fuzz_target;
use quadrille::grammar::{Rules, Token, Tokens};
use quadrille::mesh::{BaseMesh, InitialMesh, validate};

fn mesh(u: &mut Unstructured<'_>) -> Option<BaseMesh> {
    let vertex = |u: &mut Unstructured<'_>| u8::arbitrary(u).ok().map(|v| u32::from(v % 16));
    let count = u.int_in_range(0..=16usize).ok()?;
    let mut base = BaseMesh { vertices: (0..count).map(|v| [v as f64, (v * v) as f64, 0.0]).collect(), ..BaseMesh::default() };
    for face in 0..u.int_in_range(0..=12u32).ok()? {
        let kind = u8::arbitrary(u).ok()?;
        let corners = match kind % 16 {
            0 => 5,
            1..=6 => 3,
            _ => 4,
        };
        let vertices: Vec<u32> = (0..corners).map(|_| vertex(u)).collect::<Option<_>>()?;
        if corners == 3 {
            base.poles.insert(face, vertices[usize::from(kind / 16) % 3]);
        }
        base.faces.push(vertices);
    }
    if bool::arbitrary(u).ok()? {
        base.marker = Some([vertex(u)?, vertex(u)?]);
    }
    for _ in 0..u.int_in_range(0..=3u32).ok()? {
        base.corners.push(vec![vertex(u)?]);
    }
    Some(base)
}

fuzz_target!(|data: &[u8]| {
    let mut u = Unstructured::new(data);
    let Some(base) = mesh(&mut u) else { return };
    let Ok(initial) = InitialMesh::from_base(&base) else { return };
    validate::check(&initial.mesh).unwrap();
    validate::check_invariants(&initial.mesh).unwrap();
    let tokens: Tokens = u
        .take_rest()
        .iter()
        .take(60)
        .map(|&byte| Token::ALL[usize::from(byte) % Token::ALL.len()])
        .collect();
    oracle::check_string(&initial, &tokens, Rules::Plain);
    oracle::check_string(&initial, &tokens, Rules::Domain);
});
