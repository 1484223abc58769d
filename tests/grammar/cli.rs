//! `quadrille decode` and `quadrille distance`, as a user runs them (docs/reference/files.md §3).

use crate::cases::vectors;
use assert_cmd::Command;
use serde_json::{Value, json};
use std::path::PathBuf;

fn base_file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("tests/data/grammar/bases/{name}.json"))
}

fn quadrille(arguments: &[&str]) -> Command {
    let mut command = Command::cargo_bin("quadrille").unwrap();
    command.args(arguments);
    command
}

fn stdout(arguments: &[&str]) -> String {
    let output = quadrille(arguments).assert().success().get_output().stdout.clone();
    String::from_utf8(output).unwrap()
}

fn decode(base: &str, string: &str, more: &[&str]) -> Value {
    let file = base_file(base);
    let mut arguments =
        vec!["decode", "--base", file.to_str().unwrap(), "--string", string, "--format", "json"];
    arguments.extend(more);
    serde_json::from_str(&stdout(&arguments)).unwrap()
}

#[test]
fn decode_json_has_the_promised_keys_and_codes() {
    for case in vectors()["decode"].as_array().unwrap().iter().step_by(11) {
        let rules = case["mode"].as_str().unwrap();
        let printed =
            decode(case["base"].as_str().unwrap(), case["string"].as_str().unwrap(), &["--rules", rules]);
        for key in ["code", "code_reduced", "code_placed", "code_placed_reduced", "code_marker"] {
            assert_eq!(printed[key], case["summary"][key], "{key} of {case}");
        }
        assert_eq!(printed["expressed"], case["expressed"]);
        assert_eq!(printed["summary"]["vertices"], case["summary"]["V"]);
        assert_eq!(printed["summary"]["euler"], case["summary"]["euler"]);
        assert_eq!(printed["summary"]["boundary_loops"], case["summary"]["boundary_loops"]);
        assert_eq!(printed["summary"]["singularities"]["poles"], case["summary"]["poles"]);
        let tokens = printed["trace"].as_array().unwrap().len();
        assert_eq!(tokens, case["kinds"].as_array().unwrap().len());
        let edges: usize =
            printed["strips"].as_array().unwrap().iter().map(|s| s["edges"].as_array().unwrap().len()).sum();
        assert_eq!(printed["summary"]["edges"], edges, "every edge is in exactly one strip");
    }
}

#[test]
fn decode_json_of_one_string_in_full() {
    let printed = decode("single", "ATA", &[]);
    let trace = json!([
        {"token": "A", "effect": "collecting"},
        {"token": "T", "effect": "turned"},
        {"token": "A", "effect": "added", "strip": 2, "edges": 2, "faces": 1, "ends": ["boundary", "boundary"]},
    ]);
    assert_eq!(printed["trace"], trace);
    let summary = json!({"vertices": 6, "edges": 7, "faces": 2, "euler": 1, "boundary_loops": [6],
        "singularities": {"inner": {}, "boundary": {"2": 4}, "poles": 0}});
    assert_eq!(printed["summary"], summary);
    assert_eq!(printed["corners"].as_array().unwrap().len(), 4);
    assert_eq!(printed["loops"][0].as_array().unwrap().len(), 6);
    let skipped = decode("single", "AA", &[]);
    assert_eq!(skipped["trace"][1], json!({"token": "A", "effect": "skipped", "reason": "empty path"}));
}

#[test]
fn what_decode_prints_loads_again() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("printed.json");
    for (base, string) in
        [("fan", "A*PTTA*ATDPTTDTTD"), ("frei_otto", "TATPTPPTPPTPPTTA"), ("cube", "A*TPTA*")]
    {
        let printed = decode(base, string, &[]);
        std::fs::write(&file, printed.to_string()).unwrap();
        let arguments = ["decode", "--base", file.to_str().unwrap(), "--string", "", "--format", "json"];
        let again: Value = serde_json::from_str(&stdout(&arguments)).unwrap();
        for key in ["vertices", "faces", "poles", "marker", "corners", "loops", "code_placed", "code_marker"]
        {
            assert_eq!(again[key], printed[key], "{key} of {string} on {base}");
        }
    }
}

#[test]
fn distance_json_is_exact() {
    for case in vectors()["distance"].as_array().unwrap().iter().step_by(5) {
        let file = base_file(case["base"].as_str().unwrap());
        let (a, b) = (case["a"].as_str().unwrap(), case["b"].as_str().unwrap());
        let arguments = [
            "distance",
            "--base",
            file.to_str().unwrap(),
            "--a",
            a,
            "--b",
            b,
            "--max",
            "3",
            "--format",
            "json",
        ];
        let printed: Value = serde_json::from_str(&stdout(&arguments)).unwrap();
        let topological = &case["distance_placed_reduce"];
        let expected = json!({"topological": topological, "more_than": if topological.is_null() { json!(3) } else { Value::Null },
            "comparable": true, "levenshtein": case["levenshtein"], "hamming": case.get("hamming")});
        assert_eq!(printed, expected, "{case}");
    }
}

#[test]
fn other_formats_are_what_they_say() {
    let file = base_file("great_court");
    let print = |format: &str| {
        stdout(&["decode", "--base", file.to_str().unwrap(), "--string", "TATPTPTA*", "--format", format])
    };
    assert!(print("text").contains("inside     "), "{}", print("text"));
    assert!(print("obj").lines().filter(|line| line.starts_with("f ")).count() > 12);
    let svg = print("svg");
    assert!(
        svg.starts_with("<svg") && svg.contains("<title>marker</title>") && !svg.contains("NaN"),
        "{svg}"
    );
}

#[test]
fn a_wrong_string_exits_2_and_names_the_character() {
    let file = base_file("single");
    let output = quadrille(&["decode", "--base", file.to_str().unwrap(), "--string", "ATX"]).assert().code(2);
    let message = String::from_utf8(output.get_output().stderr.clone()).unwrap();
    assert!(message.contains("'X' at character 2"), "{message}");
}

#[test]
fn a_wrong_base_mesh_exits_2_and_names_the_culprit() {
    let quad = |more: &str| format!(r#"{{"vertices": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], {more}}}"#);
    let square = r#""vertices": [[0,0,0],[1,0,0],[1,1,0],[0,1,0],[2,0,0],[2,1,0],[3,0,0],[3,1,0]]"#;
    let cases = [
        ("not JSON", "{".to_string(), "line 1"),
        ("NaN", r#"{"vertices": [[0,0,NaN]], "faces": []}"#.into(), "line 1"),
        ("null", quad(r#""faces": [[0,1,2,null]]"#), "faces[0][3]"),
        ("huge", r#"{"vertices": [[0,0,0],[1,0,0],[1,1,0],[0,1,1e300]], "faces": [[0,1,2,3]]}"#.into(), "vertex 3"),
        ("no faces", quad(r#""faces": []"#), "no faces"),
        ("index out of range", quad(r#""faces": [[0,1,2,4]]"#), "face 0 refers to vertex 4"),
        ("pole index", quad(r#""faces": [[0,1,2,3]], "poles": {"7": 0}"#), "face 7"),
        ("pentagon", format!(r#"{{{square}, "faces": [[0,1,4,5,2]]}}"#), "face 0 has 5 vertices"),
        ("triangle", quad(r#""faces": [[0,1,2]]"#), "face 0 is a triangle without a pole"),
        ("pole not in face", quad(r#""faces": [[0,1,2]], "poles": {"0": 3}"#), "vertex 3"),
        ("quad with pole", quad(r#""faces": [[0,1,2,3]], "poles": {"0": 3}"#), "face 0 is a quad"),
        ("repeated", quad(r#""faces": [[0,1,2,1]]"#), "face 0 uses vertex 1 twice"),
        ("winding", format!(r#"{{{square}, "faces": [[0,1,2,3],[1,2,5,4]]}}"#), "edge [1, 2]"),
        (
            "three faces on an edge",
            format!(r#"{{{square}, "faces": [[0,1,2,3],[2,1,4,5],[1,2,7,6]]}}"#),
            "not manifold",
        ),
        ("isolated vertex", format!(r#"{{{square}, "faces": [[0,1,2,3],[1,4,5,2]]}}"#), "vertex 6"),
        ("disconnected", format!(r#"{{{square}, "faces": [[0,1,2,3],[4,6,7,5]]}}"#), "not connected"),
        (
            "two fans",
            r#"{"vertices": [[0,0,0],[1,0,0],[1,1,0],[0,1,0],[2,1,0],[2,2,0],[1,2,0]], "faces": [[0,1,2,3],[2,4,5,6]]}"#.into(),
            "vertex 2",
        ),
        ("marker", quad(r#""faces": [[0,1,2,3]], "marker": [0,2]"#), "marker [0, 2]"),
        ("corner", quad(r#""faces": [[0,1,2,3]], "corners": [0, 9]"#), "corner 1 refers to vertex 9"),
    ];
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("base.json");
    for (what, text, culprit) in cases {
        std::fs::write(&file, text).unwrap();
        let output =
            quadrille(&["decode", "--base", file.to_str().unwrap(), "--string", "T"]).assert().code(2);
        let message = String::from_utf8(output.get_output().stderr.clone()).unwrap();
        assert!(message.contains(culprit) && message.contains("base.json"), "{what}: {message}");
    }
    let missing = quadrille(&["decode", "--base", "no/such.json", "--string", "T"]).assert().code(2);
    assert!(String::from_utf8_lossy(&missing.get_output().stderr).contains("no/such.json"));
}

#[test]
fn no_bound_is_too_far_to_look() {
    // Nothing is left of either mesh after a few deletions, so there is an answer however far one may look.
    let text = r#"{"vertices": [[0,0,0],[2,0,0],[1,2,0]], "faces": [[0,1,2]], "poles": {"0": 2}}"#;
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(&file, text).unwrap();
    let base = file.path().to_str().unwrap();
    let (a, b) = ("Ao", "APTTA*DA*PDA*");
    let printed = stdout(&["distance", "--base", base, "--a", a, "--b", b, "--max", "18446744073709551615"]);
    assert!(printed.starts_with("topological  more than 18446744073709551615"), "{printed}");
}
