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

/// A portal with all that the format has beside rigid beams of one section.
fn everything() -> Value {
    json!({
        "material": {"E": 210e9, "G": 80.77e9, "density": 7850, "fy": 355e6, "thermal_expansion": 1.2e-5},
        "sections": [
            {"kind": "box", "width": 0.1, "height": 0.18, "thickness": 0.006},
            {"kind": "round", "diameter": 0.03},
        ],
        "nodes": [[0, 0, 0], [0, 0, 3], [4, 0, 3], [4, 0, 0]],
        "members": [
            {"start": 0, "end": 1, "up": [1, 0, 0], "section": 0, "end_release": {"bending_y": {"ei_per_l": 8}}},
            {"start": 1, "end": 2, "up": [0, 0, 1], "section": 0},
            {"start": 2, "end": 3, "up": [1, 0, 0], "section": 0,
             "start_release": {"bending_y": "hinge", "bending_z": {"nm_per_rad": 1e6}, "torsion": {"gj_per_l": 3}}},
            {"start": 0, "end": 2, "section": 1, "kind": "truss"},
        ],
        "supports": [
            {"node": 0, "fixed": [true, true, true, true, true, true], "displacement": [0, 0, -0.004, 0, 0, 0]},
            {"node": 3, "fixed": [false, true, true, true, false, true], "stiffness": [2e6, 0, 0, 0, 1e5, 0]},
        ],
        "loads": {
            "nodal": [{"node": 2, "force": [1000, 0, -2000]}],
            "pressure": [{"member": 1, "force_per_length": 500}],
            "temperature": [{"kelvin": 20}, {"member": 3, "kelvin": -10}],
            "gravity": 9.81,
        },
        "analysis": {"order": 2, "buckling_modes": 1},
    })
}

fn answered(model: &Value) -> (i32, Value, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.json");
    std::fs::write(&path, model.to_string()).unwrap();
    let (code, out, err) = frame(&[path.to_str().unwrap(), "--format", "json"]);
    (code, serde_json::from_str(&out).unwrap(), err)
}

#[test]
fn joints_springs_settlements_and_temperature_in_a_file() {
    let (code, answer, err) = answered(&everything());
    assert_eq!((code, err.as_str()), (0, ""));
    let reactions = answer["reactions"].as_array().unwrap();
    // Loads on nodes 1 kN and −2 kN, 0.5 kN/m on 4 m, weights by hand.
    let [box_area, bar_area] = [0.1 * 0.18 - 0.088 * 0.168, std::f64::consts::PI * 0.03 * 0.03 / 4.0];
    let weight = 9.81 * 7850.0 * (box_area * 10.0 + bar_area * 5.0);
    let sum = |d: usize| reactions.iter().filter_map(|r| r["r"][d].as_f64()).sum::<f64>();
    assert!((sum(0) + 1000.0).abs() < 1e-5 && (sum(2) - 4000.0 - weight).abs() < 1e-5, "{reactions:?}");
    assert_eq!(answer["displacements"][0]["u"][2], json!(-0.004));
    let spring = &reactions[1]["r"];
    let moved = answer["displacements"][3]["u"][0].as_f64().unwrap();
    assert!((spring[0].as_f64().unwrap() + 2e6 * moved).abs() < 1e-6, "the spring pushes back");
    assert!(answer["joint_rotations"].as_array().unwrap().len() == 2, "{}", answer["joint_rotations"]);
    // The hinge takes no moment.
    let ends = answer["member_forces"].as_array().unwrap();
    let at = |member: u64, end: &str| {
        ends.iter().find(|f| f["member"] == json!(member) && f["end"] == json!(end)).unwrap()
    };
    assert!(at(2, "start")["My"].as_f64().unwrap().abs() < 1e-6);
    assert!(at(3, "start")["My"].as_f64().unwrap() == 0.0 && at(3, "start")["N"].as_f64().unwrap() != 0.0);
}

#[test]
fn what_the_new_keys_may_not_say() {
    type Change = fn(&mut Value);
    let wrong: [(Change, &str); 14] = [
        (|m| m["section"] = json!({"kind": "round", "diameter": 0.1}), "give either `section`"),
        (|m| m["sections"] = json!([]), "give either `section`"),
        (|m| m["sections"][1]["diameter"] = json!(-1), "sections[1]: section diameter = -1"),
        (|m| m["members"][1]["section"] = json!(2), "members[1].section = 2"),
        (|m| m["members"][1]["section"] = Value::Null, "members[1]: missing key `section`"),
        (|m| m["members"][1]["up"] = Value::Null, "members[1]: missing key `up`"),
        (
            |m| m["members"][3]["start_release"] = json!({"torsion": "hinge"}),
            "members[3].start_release: a truss",
        ),
        (|m| m["members"][0]["end_release"] = json!({"bending_x": "hinge"}), "did you mean `bending_"),
        (|m| m["members"][0]["end_release"] = json!({"bending_y": "hinged"}), "\"rigid\", \"hinge\""),
        (
            |m| m["members"][0]["end_release"] = json!({"bending_y": {"ei_per_l": -8}}),
            "end_release.bending_y: ei_per_l = -8",
        ),
        (
            |m| {
                m["members"][0]["end_release"] = json!({"torsion": "hinge"});
                m["members"][0]["start_release"] = json!({"torsion": "hinge"});
            },
            "members[0]: torsion is released at both ends",
        ),
        (|m| m["supports"][1]["stiffness"][0] = json!(-2), "supports[1].stiffness[0]: -2 must be 0 or more"),
        (
            |m| m["supports"][1]["displacement"] = json!([0.1, 0, 0, 0, 0, 0]),
            "node 3: a displacement is prescribed in Ux",
        ),
        (|m| m["loads"]["temperature"][1]["member"] = json!(9), "loads.temperature"),
    ];
    for (change, expected) in wrong {
        let mut model = everything();
        change(&mut model);
        let (code, answer, err) = answered(&model);
        assert_eq!((code, &answer["error"]), (2, &json!("refused")), "{expected}: {err}");
        assert!(answer["message"].as_str().unwrap().contains(expected), "{expected:?} is not in {answer}");
    }
}
