//! Whatever a file holds, reading it gives a mesh or a message, never a panic: OBJ, COMPAS JSON, height expressions.

use quadrille::expression::Expression;
use quadrille::io::{compas, obj};
use quadrille::random::{self, Rng};
use quadrille::surface::HeightFunction as _;
use std::collections::BTreeMap;

/// A text of random pieces.
fn text(rng: &mut Rng, pieces: &[&str], most: usize) -> String {
    (0..random::below(rng, most)).map(|_| pieces[random::below(rng, pieces.len())]).collect()
}

#[test]
fn obj() {
    let pieces = [
        "v ",
        "f ",
        "l ",
        "o a",
        "\n",
        "\n",
        " ",
        "1",
        "2",
        "-1",
        "3/1",
        "4//2",
        "-3/2/1",
        "0",
        "0.5",
        "1e300",
        "nan",
        "#",
        "\\",
        "é",
        "999999999999999999999",
        "-9223372036854775808",
        "v 1 2 3\n",
        "v 0 0 1\n",
        "f 1 2 3\n",
        "l 1 2\n",
        "l 2 1\n",
    ];
    let mut read = 0;
    for seed in 0..20_000 {
        let mut rng = random::stream(21, seed, 0);
        let text = text(&mut rng, &pieces, 24);
        match obj::parse(&text) {
            Ok(file) => {
                read += 1;
                let count = file.vertices.len() as u32;
                assert!(file.faces.iter().chain(&file.polylines).flatten().all(|&v| v < count), "{text:?}");
            }
            Err((line, reason)) => assert!(line >= 1 && !reason.is_empty(), "{text:?}"),
        }
    }
    assert!(read > 500, "{read} of 20,000 could be read");
}

#[test]
fn compas_json() {
    let pieces = [
        "{",
        "}",
        "[",
        "]",
        ":",
        ",",
        "\"vertex\"",
        "\"face\"",
        "\"0\"",
        "\"1\"",
        "\"x\"",
        "\"data\"",
        "\"face_pole\"",
        "0",
        "1.5",
        "null",
        "{\"vertex\":{\"0\":{\"x\":0,\"y\":0,\"z\":0}},\"face\":{\"0\":[0,0,0]}",
        "{\"vertex\":{},\"face\":{}",
    ];
    for seed in 0..20_000 {
        let mut rng = random::stream(22, seed, 0);
        let text = text(&mut rng, &pieces, 16);
        if let Ok(value) = serde_json::from_str(&text) {
            let _ = compas::from_value(&value);
        }
    }
}

#[test]
fn expressions() {
    let pieces = [
        "x", "y", "+", "-", "*", "/", "^", "(", ")", ",", "sin(", "max(", "pow(", "atan2(", "1", "2.5", "1e",
        ".", " ", "a", "b", "e", "pi", "é",
    ];
    let constants = BTreeMap::from([("a".to_owned(), 2.0)]);
    let mut read = 0;
    for seed in 0..40_000 {
        let mut rng = random::stream(23, seed, 0);
        let text = text(&mut rng, &pieces, 14);
        match Expression::parse(&text, &constants, &[]) {
            Ok(f) => {
                read += 1;
                let _ = (f.z(0.3, -1.2), f.gradient(0.3, -1.2));
            }
            Err(error) => {
                assert!(error.position <= text.chars().count(), "{text:?}: {error}");
                assert!(!error.to_string().is_empty());
            }
        }
    }
    assert!(read > 1000, "{read} of 40,000 could be read");
}
