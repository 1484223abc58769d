//! The reference cases of the grammar (`tests/data/grammar/README.md`), every one, and those made by an independent
//! reading of the specification (`tests/data/grammar_independent/README.md`).

use crate::cases::{GIVEN, INDEPENDENT, all_bases, base, vectors, vectors_in};
use quadrille::grammar::{Decoded, Effect, Rules, Tokens, decode};
use quadrille::mesh::code::{code, rooted_code};
use quadrille::mesh::{Distance, Equivalence, InitialMesh, VertexId, distance, strips, validate};
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
    check_decode(GIVEN);
}

#[test]
fn decode_gives_the_meshes_of_an_independent_reading() {
    check_decode(INDEPENDENT);
}

fn check_decode(set: &str) {
    let bases = all_bases();
    let mut failures = Vec::new();
    for case in vectors_in(set)["decode"].as_array().unwrap() {
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
        wrong.extend(wrong_strips_or_places(&decoded, case));
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

/// Compares what only the independent cases hold: strips by label (where none was subdivided), and sums over the
/// positions.
fn wrong_strips_or_places(decoded: &Decoded, case: &Value) -> Vec<String> {
    let mut wrong = Vec::new();
    if let Some(expected) = case.get("strips") {
        let mut found: Vec<_> = strips::all(&decoded.mesh)
            .iter()
            .map(|chain| (chain.label.0, chain.darts.len(), chain.closed, chain.pole_count()))
            .collect();
        found.sort_unstable();
        if expected != &json!(found) {
            wrong.push(format!("strips: {found:?} instead of {expected}"));
        }
    }
    if let Some(expected) = case.get("moments") {
        let mut found = [0.0; 4];
        for v in (0..decoded.mesh.vertex_count()).map(|v| decoded.mesh.position(VertexId(v as u32))) {
            (0..3).for_each(|i| found[i] += v[i]);
            found[3] += v.iter().map(|x| x * x).sum::<f64>();
        }
        let near = |(found, expected): (&f64, &Value)| {
            let expected = expected.as_f64().unwrap();
            (found - expected).abs() <= 1e-9 * (1.0 + expected.abs())
        };
        if !found.iter().zip(expected.as_array().unwrap()).all(near) {
            wrong.push(format!("sums over positions: {found:?} instead of {expected}"));
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
    let sets = [GIVEN, INDEPENDENT].map(|set| vectors_in(set)["parser"].take());
    let cases =
        |key: &str| sets.iter().flat_map(|parser| parser[key].as_array().unwrap()).collect::<Vec<_>>();
    for case in cases("tokens") {
        let tokens: Tokens = case["string"].as_str().unwrap().parse().unwrap();
        let printed: Vec<&str> = tokens.iter().map(|token| token.as_str()).collect();
        assert_eq!(case["tokens"], json!(printed), "{case}");
    }
    for case in cases("wrong") {
        let error = case["string"].as_str().unwrap().parse::<Tokens>().unwrap_err();
        assert_eq!(case["position"], error.position, "{case}");
    }
}

#[test]
fn string_distances() {
    for set in [GIVEN, INDEPENDENT] {
        for case in vectors_in(set)["distance"].as_array().unwrap() {
            let [a, b]: [Tokens; 2] = ["a", "b"].map(|key| case[key].as_str().unwrap().parse().unwrap());
            assert_eq!(case["levenshtein"], a.levenshtein(&b), "{case}");
            assert_eq!(case.get("hamming").cloned(), a.hamming(&b).map(Value::from), "{case}");
        }
    }
}

#[test]
fn topological_distances() {
    let bases = all_bases();
    for set in [GIVEN, INDEPENDENT] {
        for case in vectors_in(set)["distance"].as_array().unwrap() {
            check_distances(&bases[case["base"].as_str().unwrap()], case);
        }
    }
}

/// The distances of a case, both ways round; only the independent cases have those with `mirror`.
fn check_distances(initial: &InitialMesh, case: &Value) {
    let [a, b] = ["a", "b"].map(|key| {
        let tokens: Tokens = case[key].as_str().unwrap().parse().unwrap();
        decode(initial, &tokens, Rules::Plain).mesh
    });
    let max = case["max"].as_u64().unwrap() as usize;
    for (key, placed, reduce, mirror) in [
        ("distance_placed_reduce", true, true, false),
        ("distance_placed", true, false, false),
        ("distance_reduce", false, true, false),
        ("distance", false, false, false),
        ("distance_placed_reduce_mirror", true, true, true),
        ("distance_placed_mirror", true, false, true),
        ("distance_reduce_mirror", false, true, true),
        ("distance_mirror", false, false, true),
    ] {
        let Some(expected) = case.get(key) else {
            assert!(mirror, "{key} is missing in {case}");
            continue;
        };
        let expected = match expected.as_u64() {
            Some(d) => Distance::Exactly(d as usize),
            None => Distance::MoreThan(max),
        };
        let equivalence = Equivalence { placed, reduce, mirror };
        assert_eq!(distance(&a, &b, equivalence, max), expected, "{key} of {case}");
        assert_eq!(distance(&b, &a, equivalence, max), expected, "{key} of {case}, swapped");
    }
}
