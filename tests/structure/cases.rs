//! The reference cases (`tests/data/frames/README.md`): closed forms and independent programs, each within its own
//! tolerance. The rule of comparison is that of the cases' `compare.py`.

use quadrille::structure::{FrameError, file, frame};
use serde_json::Value;
use std::path::Path;

fn numbers<'a>(value: &'a Value, key: &str) -> impl Iterator<Item = &'a Value> {
    value.get(key).and_then(Value::as_array).into_iter().flatten()
}

/// What is compared, each on the scale of its kind: translations, rotations, forces, moments.
#[derive(Default)]
struct Comparison {
    pairs: Vec<(usize, f64, f64, String)>,
    scale: [f64; 4],
}

impl Comparison {
    fn add(&mut self, kind: usize, want: &Value, got: &Value, label: String) {
        let Some(want) = want.as_f64() else { return };
        self.scale[kind] = self.scale[kind].max(want.abs());
        self.pairs.push((kind, want, got.as_f64().unwrap_or(f64::NAN), label));
    }

    fn failures(mut self, size: f64, relative: f64) -> Vec<String> {
        let [t, r, f, m] = self.scale;
        self.scale[0] = t.max(1e-4 * r * size);
        self.scale[1] = r.max(1e-4 * self.scale[0] / size);
        self.scale[2] = f.max(1e-4 * m / size);
        self.scale[3] = m.max(1e-4 * self.scale[2] * size);
        let scale = self.scale;
        let close = |kind: usize, want: f64, got: f64| {
            (got - want).abs() <= relative * want.abs().max(scale[kind]).max(1e-300)
        };
        let wrong = self.pairs.iter().filter(|(kind, want, got, _)| !close(*kind, *want, *got));
        wrong.map(|(_, want, got, label)| format!("{label}: want {want}, got {got}")).collect()
    }
}

fn bounding_diagonal(case: &Value) -> f64 {
    let nodes: Vec<[f64; 3]> = serde_json::from_value(case["nodes"].clone()).unwrap();
    let extent = |d: usize| {
        let of = nodes.iter().map(|n| n[d]);
        of.clone().fold(f64::MIN, f64::max) - of.fold(f64::MAX, f64::min)
    };
    (0..3).map(|d| extent(d).powi(2)).sum::<f64>().sqrt()
}

/// By node, or by member and end.
fn find<'a>(result: &'a Value, key: &str, item: &Value) -> &'a Value {
    let same = |name: &str, other: &Value| item.get(name).is_none_or(|v| Some(v) == other.get(name));
    numbers(result, key)
        .find(|other| ["node", "member", "end"].iter().all(|name| same(name, other)))
        .unwrap_or(&Value::Null)
}

fn check(case: &Value, result: &Value) -> Vec<String> {
    let expected = &case["expected"];
    let tolerance = &case["tolerance"];
    let relative = tolerance["relative"].as_f64().unwrap();
    let mut comparison = Comparison::default();
    for (list, values) in [("displacements", "u"), ("reactions", "r")] {
        for item in numbers(expected, list) {
            let got = find(result, list, item);
            for d in 0..6 {
                let kind = if list == "displacements" { 0 } else { 2 } + usize::from(d > 2);
                let label = format!("{values}[{}][{d}]", item["node"]);
                comparison.add(kind, &item[values][d], &got[values][d], label);
            }
        }
    }
    for item in numbers(expected, "member_forces") {
        let got = find(result, "member_forces", item);
        for name in ["N", "Vy", "Vz", "Mt", "My", "Mz"] {
            let kind = if name.starts_with('M') { 3 } else { 2 };
            comparison.add(kind, &item[name], &got[name], format!("{name}[{}]", item["member"]));
        }
    }
    let mut wrong = comparison.failures(bounding_diagonal(case), relative);
    let mut compare = |label: &str, want: &Value, got: &Value, relative: f64| {
        if let Some(want) = want.as_f64() {
            let got = got.as_f64().unwrap_or(f64::NAN);
            if (got - want).abs().partial_cmp(&(relative * want.abs())) != Some(std::cmp::Ordering::Less)
                && got != want
            {
                wrong.push(format!("{label}: want {want}, got {got}"));
            }
        }
    };
    for key in ["max_displacement", "utilisation", "utilisation_at_member_ends"] {
        let own = tolerance.get(key).and_then(Value::as_f64);
        compare(key, &expected[key], &result[key], own.unwrap_or(relative));
    }
    for d in 0..3 {
        let scale =
            numbers(expected, "total_reaction").filter_map(Value::as_f64).fold(0.0f64, |a, v| a.max(v.abs()));
        if let Some(want) = expected["total_reaction"][d].as_f64() {
            let got = result["total_reaction"][d].as_f64().unwrap();
            assert!(
                (got - want).abs() <= 1e-6 * scale.max(1e-9),
                "total_reaction[{d}]: want {want}, got {got}"
            );
        }
    }
    if let Some(factors) = expected["buckling_factors"].as_array() {
        let relative = tolerance["buckling"].as_f64().unwrap_or(relative.max(1e-5));
        let got = result["buckling_factors"].as_array().unwrap();
        assert!(!factors.is_empty() || got.is_empty(), "no buckling factor is expected, got {got:?}");
        for (k, want) in factors.iter().enumerate() {
            compare(&format!("buckling[{k}]"), want, got.get(k).unwrap_or(&Value::Null), relative);
        }
    }
    wrong
}

#[test]
fn every_reference_case_is_met() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/frames");
    let mut names: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    names.retain(|path| path.extension().is_some_and(|e| e == "json"));
    names.sort();
    assert_eq!(names.len(), 44, "a case is missing");
    for path in names {
        let name = path.file_stem().unwrap().to_string_lossy();
        let text = std::fs::read_to_string(&path).unwrap();
        let case: Value = serde_json::from_str(&text).unwrap();
        let (model, analysis) = file::read(&text).unwrap();
        let answer = frame(&model, &analysis);
        match (&answer, case["expected"]["error"].as_str()) {
            (Err(FrameError::Singular(_)), Some("singular"))
            | (Err(FrameError::Unstable(_)), Some("unstable")) => {}
            (Ok(result), None) => {
                let printed: Value = serde_json::from_slice(&file::answer(result).unwrap()).unwrap();
                let wrong = check(&case, &printed);
                assert!(wrong.is_empty(), "{name}: {wrong:#?}");
            }
            (answer, expected) => {
                panic!("{name}: expected error {expected:?}, got {:?}", answer.as_ref().err())
            }
        }
    }
}

#[test]
fn the_free_node_and_direction_are_named() {
    let read = |name: &str| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/frames").join(name);
        file::read(&std::fs::read_to_string(path).unwrap()).unwrap()
    };
    // A beam on two vertical rollers along x: slides along x, rolls about x.
    let (model, analysis) = read("edge_singular_rigid_body.json");
    let Err(FrameError::Singular(motion)) = frame(&model, &analysis) else { panic!("must be singular") };
    assert!(matches!(format!("{:?}", motion.direction).as_str(), "Ux" | "Rx"), "{motion:?}");
    // A column past its critical load: the free top gives way sideways, about the weak axis (along y).
    let (model, analysis) = read("edge_order2_beyond_critical.json");
    let Err(FrameError::Unstable(motion)) = frame(&model, &analysis) else { panic!("must be unstable") };
    assert_eq!((motion.node.0, format!("{:?}", motion.direction).as_str()), (6, "Uy"));
}

/// However many modes are asked for, the first are the same; from a quarter of the unknowns on the dense problem gives them.
#[test]
fn many_buckling_modes_begin_as_few_do() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/frames/gridshell_court_16x3.json");
    let text = std::fs::read_to_string(path).unwrap();
    let factors = |modes: u32| {
        let mut case: Value = serde_json::from_str(&text).unwrap();
        case["analysis"]["buckling_modes"] = modes.into();
        let (model, analysis) = file::read(&case.to_string()).unwrap();
        frame(&model, &analysis).unwrap().buckling_factors
    };
    let dense = factors(150);
    assert_eq!(dense.len(), 150);
    for modes in [1, 2, 6, 25, 34, 46, 60, 80] {
        let found = factors(modes);
        assert_eq!(found.len(), modes as usize);
        for (k, (a, b)) in found.iter().zip(&dense).enumerate() {
            assert!((a - b).abs() <= 1e-9 * b, "mode {k} of {modes}: {a} {b}");
        }
    }
    let mut case: Value = serde_json::from_str(&text).unwrap();
    case["analysis"]["buckling_modes"] = 100_000.into();
    assert!(file::read(&case.to_string()).unwrap_err().to_string().contains("at most 1000"));
}
