//! `quadrille frame` from outside: what it prints, and how it says no.

use assert_cmd::Command;
use serde_json::{Value, json};
use std::path::PathBuf;

fn case(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/frames").join(name)
}

fn frame(args: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_quadrille")).arg("frame").args(args).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// Runs a changed copy of a small case.
fn changed(change: impl Fn(&mut Value)) -> (i32, String, String) {
    let text = std::fs::read_to_string(case("portal_fixed.json")).unwrap();
    let mut model: Value = serde_json::from_str(&text).unwrap();
    change(&mut model);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.json");
    std::fs::write(&path, model.to_string()).unwrap();
    frame(&[path.to_str().unwrap(), "--format", "json"])
}

#[test]
fn json_has_every_node_and_member() {
    let path = case("space_frame_2storey.json");
    let (code, out, err) = frame(&[path.to_str().unwrap(), "--format", "json"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let result: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(result["displacements"].as_array().unwrap().len(), 12);
    assert_eq!(result["member_forces"].as_array().unwrap().len(), 34);
    assert_eq!(result["buckling_factors"].as_array().unwrap().len(), 3);
}

#[test]
fn text_is_a_summary() {
    let path = case("space_frame_2storey.json");
    let (code, out, _) = frame(&[path.to_str().unwrap()]);
    assert_eq!(code, 0);
    for words in ["largest displacement", "utilisation", "buckling factors", "80.01"] {
        assert!(out.contains(words), "{words:?} is not in\n{out}");
    }
}

#[test]
fn a_mechanism_is_json_with_node_and_direction_and_exit_1() {
    let path = case("edge_singular_rigid_body.json");
    let (code, out, err) = frame(&[path.to_str().unwrap(), "--format", "json"]);
    assert_eq!(code, 1);
    let answer: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(answer["error"], "singular");
    assert!(answer["node"].is_u64() && answer["direction"].is_string());
    assert!(err.contains("moves freely"), "{err}");
    let path = case("edge_order2_beyond_critical.json");
    let (code, out, _) = frame(&[path.to_str().unwrap(), "--format", "json"]);
    let answer: Value = serde_json::from_str(&out).unwrap();
    assert_eq!((code, &answer["error"], &answer["node"]), (1, &json!("unstable"), &json!(6)));
}

#[test]
fn wrong_input_says_what_and_where_with_exit_2() {
    type Change = fn(&mut Value);
    let wrong: [(Change, &str); 9] = [
        (|m| drop(m.as_object_mut().unwrap().remove("material")), "material"),
        (|m| m["nodes"][1][2] = json!("high"), "nodes[1][2]"),
        (|m| m["members"][0]["end"] = json!(77), "members[0].end = 77"),
        (|m| m["nodes"][1] = m["nodes"][0].clone(), "its length is 0"),
        (|m| m["nodes"].as_array_mut().unwrap().push(json!([9, 9, 9])), "belongs to no member"),
        (
            |m| {
                let first = m["members"][0].clone();
                m["members"].as_array_mut().unwrap().push(first);
            },
            "joins the same nodes",
        ),
        (|m| m["analysis"]["order"] = json!(3), "analysis.order = 3"),
        (|m| m["material"]["E"] = json!(-1.0), "material.E"),
        (|m| m["members"][1]["up"] = json!([0, 0, 0]), "members[1].up"),
    ];
    for (change, expected) in wrong {
        let (code, out, err) = changed(change);
        let answer: Value = serde_json::from_str(&out).unwrap();
        assert_eq!((code, &answer["error"]), (2, &json!("refused")), "{expected}: {err}");
        assert!(answer["message"].as_str().unwrap().contains(expected), "{expected:?} is not in {answer}");
        assert!(err.contains("model.json") && err.contains(expected), "{expected:?} is not in {err}");
    }
    let (code, out, err) = changed(|m| {
        m["section"] = json!({"kind": "properties", "A": 1e-3, "Iy": 1e-5, "Iz": 1e-5, "J": 1e-5});
    });
    // Moduli that are not given leave the utilisation out, no more.
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(serde_json::from_str::<Value>(&out).unwrap()["utilisation"].is_null());
    let (code, _, err) = frame(&["no_such_file.json"]);
    assert!(code == 2 && err.contains("no_such_file.json"), "{err}");
}

#[test]
fn an_unknown_key_is_an_error_with_the_nearest_at_every_depth() {
    type Change = fn(&mut Value);
    fn rename(object: &mut Value, from: &str, to: &str) {
        let object = object.as_object_mut().unwrap();
        let value = object.remove(from).unwrap_or(json!(1));
        object.insert(to.into(), value);
    }
    let wrong: [(Change, &str); 12] = [
        (|m| rename(m, "supports", "suports"), "unknown key `suports`, did you mean `supports`?"),
        (|m| rename(m, "none", "temperature"), "unknown key `temperature`; allowed here: material"),
        (|m| rename(&mut m["loads"], "member_uniform", "member_unifrom"), "did you mean `member_uniform`?"),
        (|m| rename(&mut m["members"][0], "none", "releases"), "members[0].releases: unknown key `releases`"),
        (|m| rename(&mut m["material"], "none", "nu"), "unknown key `nu`"),
        (|m| rename(&mut m["supports"][0], "fixed", "fixd"), "did you mean `fixed`?"),
        (|m| rename(&mut m["analysis"], "none", "buckling_mode"), "did you mean `buckling_modes`?"),
        (|m| rename(&mut m["section"], "none", "heigth"), "unknown key `heigth`"),
        (|m| m["section"]["kind"] = json!("pipe"), "unknown word `pipe`"),
        (|m| m["loads"]["nodal"] = json!([{"node": 1, "froce": [1, 0, 0]}]), "did you mean `force`?"),
        (
            |m| m["loads"]["member_uniform"] = json!([{"member": 0, "force_per_lenght": [1, 0, 0]}]),
            "force_per_length",
        ),
        (|m| m["analysis"]["order"] = json!(0), "analysis.order = 0"),
    ];
    for (change, expected) in wrong {
        let (code, out, err) = changed(change);
        let answer: Value = serde_json::from_str(&out).unwrap();
        assert_eq!((code, &answer["error"]), (2, &json!("refused")), "{expected}: {err}");
        assert!(answer["message"].as_str().unwrap().contains(expected), "{expected:?} is not in {answer}");
    }
    let (code, _, err) = changed(|m| {
        for key in ["name", "description", "source", "expected", "tolerance", "verification"] {
            m[key] = json!({"for": "people"});
        }
    });
    assert_eq!((code, err.as_str()), (0, ""));
}

#[test]
fn bending_without_a_factor_says_what_the_model_leaves_out() {
    let beam = |order: u32, modes: u32, force: [f64; 3]| {
        changed(move |m| {
            m["supports"] = json!([{"node": 0, "fixed": [true, true, true, true, true, true]}]);
            let last = m["nodes"].as_array().unwrap().len() - 1;
            m["nodes"] = json!((0..=last).map(|i| [i as f64, 0.0, 0.0]).collect::<Vec<_>>());
            m["members"] = json!(
                (0..last).map(|i| json!({"start": i, "end": i + 1, "up": [0, 0, 1]})).collect::<Vec<_>>()
            );
            m["loads"] = json!({"nodal": [{"node": last, "force": force}]});
            m["analysis"] = json!({"order": order, "buckling_modes": modes});
        })
    };
    let remarks = |(code, out, err): (i32, String, String)| {
        assert_eq!((code, err.as_str()), (0, ""));
        serde_json::from_str::<Value>(&out).unwrap()["remarks"].to_string()
    };
    for order in [1, 2] {
        assert!(remarks(beam(order, 1, [0.0, 0.0, -10.0])).contains("lateral-torsional buckling"));
        // Tension: nothing buckles, and nothing bends. Compression has a factor. Who asked for none is told nothing.
        assert_eq!(remarks(beam(order, 1, [10.0, 0.0, 0.0])), "[]");
        assert_eq!(remarks(beam(order, 1, [-10.0, 0.0, -10.0])), "[]");
        assert_eq!(remarks(beam(order, 0, [0.0, 0.0, -10.0])), "[]");
    }
}

#[test]
fn help_tells_the_format() {
    let (code, out, _) = frame(&["--help"]);
    assert_eq!(code, 0);
    for key in [
        "member_uniform",
        "buckling_modes",
        "shear_deformation",
        "\"fixed\"",
        "docs/frame.md",
        "lateral-torsional",
    ] {
        assert!(out.contains(key), "{key} is not in\n{out}");
    }
}
