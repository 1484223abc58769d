//! The reference cases of the grammar (`tests/data/grammar/README.md`), every one.

#![allow(clippy::unwrap_used, reason = "a test that cannot read its case fails")]

mod grammar_cases;

use grammar_cases::{base, bases, vectors};
use quadrille::grammar::{Effect, Rules, Tokens, decode};
use quadrille::mesh::code::{code, rooted_code};
use quadrille::mesh::{Distance, Equivalence, distance, strips, validate};
use serde_json::{Value, json};
use std::collections::BTreeMap;

fn kind(effect: &Effect) -> String {
    match effect {
        Effect::Turned => "turned".into(),
        Effect::Pivoted => "pivoted".into(),
        Effect::Collecting => "collecting".into(),
        Effect::Added(_) => "added".into(),
        Effect::Deleted(_) => "deleted".into(),
        Effect::Skipped(skip) if skip.is_invalid() => "skipped: invalid".into(),
        Effect::Skipped(_) => "skipped: not applicable".into(),
    }
}

fn class_of(kind: &str) -> String {
    match kind.strip_prefix("skipped: ") {
        Some(reason) if reason.starts_with("invalid:") => "skipped: invalid".into(),
        Some(_) => "skipped: not applicable".into(),
        None => kind.into(),
    }
}

fn histogram(values: impl Iterator<Item = usize>) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    values.for_each(|value| *counts.entry(value.to_string()).or_default() += 1);
    counts
}

#[test]
fn decode_gives_the_reference_meshes() {
    let bases = bases();
    let mut failures = Vec::new();
    for case in vectors()["decode"].as_array().unwrap() {
        let initial = &bases[case["base"].as_str().unwrap()];
        let tokens: Tokens = case["string"].as_str().unwrap().parse().unwrap();
        let rules = if case["mode"] == "domain" { Rules::Domain } else { Rules::Plain };
        let decoded = decode(initial, &tokens, rules);
        let mesh = &decoded.mesh;
        validate::check(mesh).unwrap();
        validate::check_invariants(mesh).unwrap();

        let kinds: Vec<String> = decoded.trace.iter().map(kind).collect();
        let expected: Vec<String> =
            case["kinds"].as_array().unwrap().iter().map(|k| class_of(k.as_str().unwrap())).collect();
        let mut wrong = Vec::new();
        if kinds != expected {
            wrong.push(format!("trace: {:?}", decoded.trace));
        }
        if decoded.expressed.to_string() != case["expressed"].as_str().unwrap() {
            wrong.push(format!("expressed: {}", decoded.expressed));
        }
        let boundary = mesh.boundary_vertices();
        let valences = mesh.valences();
        let of = |on_boundary: bool| {
            let valences = valences.iter().zip(&boundary);
            histogram(valences.filter(move |&(_, &b)| b == on_boundary).map(|(&valence, _)| valence))
        };
        let mut lengths: Vec<usize> = mesh.loops().iter().map(Vec::len).collect();
        lengths.sort_unstable();
        let chains = strips::all(mesh);
        let self_crossing = chains
            .iter()
            .filter(|chain| {
                let mut faces: Vec<_> = chain
                    .darts
                    .iter()
                    .filter_map(|&d| mesh.opposite(d).and(mesh.left(d).as_face()))
                    .collect();
                let count = faces.len();
                faces.sort_unstable();
                faces.dedup();
                faces.len() < count
            })
            .count();
        let summary = json!({
            "V": mesh.vertex_count(), "E": mesh.edge_count(), "F": mesh.face_count(),
            "euler": mesh.euler_characteristic(), "boundary_loops": lengths,
            "valences": {"inner": of(false), "boundary": of(true)},
            "poles": mesh.pole_vertices().iter().filter(|&&p| p).count(),
            "strips": {
                "open": chains.iter().filter(|c| !c.closed).count(),
                "closed": chains.iter().filter(|c| c.closed).count(),
                "with_pole": chains.iter().filter(|c| c.pole_count() > 0).count(),
                "self_crossing": self_crossing,
            },
            "code": code(mesh, false).to_string(),
            "code_placed": code(mesh, true).to_string(),
            "code_reduced": Equivalence { placed: false, ..Equivalence::default() }.code(mesh).to_string(),
            "code_placed_reduced": Equivalence::default().code(mesh).to_string(),
            "code_marker": rooted_code(mesh, decoded.marker, false).to_string(),
        });
        for (key, value) in summary.as_object().unwrap() {
            if &case["summary"][key] != value {
                wrong.push(format!("{key}: {value} instead of {}", case["summary"][key]));
            }
        }
        wrong.extend(wrong_rules(&decoded.trace, case));
        if !wrong.is_empty() {
            failures.push(format!("{} {}: {}", case["base"], case["string"], wrong.join("; ")));
        }
    }
    assert!(failures.is_empty(), "{} wrong:\n{}", failures.len(), failures.join("\n"));
}

/// Compares the applied rules; strip numbers only up to the first subdivision.
fn wrong_rules(trace: &[Effect], case: &Value) -> Vec<String> {
    let applied: Vec<&Effect> = trace.iter().filter(|effect| effect.is_applied()).collect();
    let expected = case["rules"].as_array().unwrap();
    let mut wrong = Vec::new();
    if applied.len() != expected.len() {
        wrong.push("number of rules".to_string());
    }
    let mut comparable = true;
    for (effect, expected) in applied.iter().zip(expected) {
        let same = match effect {
            Effect::Added(added) => {
                let same_strip = !comparable || expected["strip"] == added.strip.0;
                same_strip
                    && expected["edges"] == added.edges
                    && expected["faces"] == added.faces
                    && expected["ends"] == json!(added.ends())
            }
            Effect::Deleted(deleted) => {
                let same_strip = !comparable || expected["strip"] == deleted.strip.0;
                let refined: Vec<Value> =
                    deleted.refined.iter().map(|(s, n)| json!({"strip": s.0, "into": n})).collect();
                let same_refined = if comparable {
                    expected["refined"] == json!(refined)
                } else {
                    expected["refined"].as_array().unwrap().len() == refined.len()
                };
                comparable &= refined.is_empty();
                same_strip && same_refined
            }
            _ => true,
        };
        if !same {
            wrong.push(format!("{effect:?} instead of {expected}"));
        }
    }
    wrong
}

#[test]
fn given_mesh_and_marker_are_the_decoded_ones() {
    // The meshes written in the cases load, and have the marker code of the decoded ones.
    for case in vectors()["decode"].as_array().unwrap() {
        let initial = base(case).unwrap();
        let expected = case["summary"]["code_marker"].as_str().unwrap();
        assert_eq!(rooted_code(&initial.mesh, initial.marker, false).to_string(), expected, "{case}");
    }
}

#[test]
fn parser_cases() {
    let parser = &vectors()["parser"];
    for case in parser["tokens"].as_array().unwrap() {
        let tokens: Tokens = case["string"].as_str().unwrap().parse().unwrap();
        let printed: Vec<&str> = tokens.iter().map(|token| token.as_str()).collect();
        assert_eq!(case["tokens"], json!(printed), "{case}");
    }
    for case in parser["wrong"].as_array().unwrap() {
        let error = case["string"].as_str().unwrap().parse::<Tokens>().unwrap_err();
        assert_eq!(case["position"], error.position, "{case}");
    }
}

#[test]
fn string_distances() {
    for case in vectors()["distance"].as_array().unwrap() {
        let [a, b]: [Tokens; 2] = ["a", "b"].map(|key| case[key].as_str().unwrap().parse().unwrap());
        assert_eq!(case["levenshtein"], a.levenshtein(&b), "{case}");
        assert_eq!(case.get("hamming").cloned(), a.hamming(&b).map(Value::from), "{case}");
    }
}

#[test]
fn topological_distances() {
    let bases = bases();
    for case in vectors()["distance"].as_array().unwrap() {
        let initial = &bases[case["base"].as_str().unwrap()];
        let [a, b] = ["a", "b"].map(|key| {
            let tokens: Tokens = case[key].as_str().unwrap().parse().unwrap();
            decode(initial, &tokens, Rules::Plain).mesh
        });
        let max = case["max"].as_u64().unwrap() as usize;
        for (key, placed, reduce) in [
            ("distance_placed_reduce", true, true),
            ("distance_placed", true, false),
            ("distance_reduce", false, true),
            ("distance", false, false),
        ] {
            let expected = match case[key].as_u64() {
                Some(d) => Distance::Exactly(d as usize),
                None => Distance::MoreThan(max),
            };
            let equivalence = Equivalence { placed, reduce, mirror: false };
            assert_eq!(distance(&a, &b, equivalence, max), expected, "{key} of {case}");
            assert_eq!(distance(&b, &a, equivalence, max), expected, "{key} of {case}, swapped");
        }
    }
}
