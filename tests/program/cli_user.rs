//! What a new user needs: sizes and limits before a run, files in their own units, pictures of what fails, and why nothing is
//! feasible.

use assert_cmd::Command;
use serde_json::Value as Json;
use std::fs;
use std::path::Path;
use std::process::Output;

const CI: &str = include_str!("../../configs/ci.toml");

fn quadrille(folder: &Path, arguments: &[&str]) -> Output {
    Command::cargo_bin("quadrille").unwrap().current_dir(folder).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// A folder with `c.toml`, which is `config` with one text put in place of another.
fn folder(config: &str, changes: &[(&str, &str)]) -> tempfile::TempDir {
    let mut config = config.to_owned();
    for (old, new) in changes {
        assert!(config.contains(old), "no {old} in the config");
        config = config.replacen(old, new, 1);
    }
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("c.toml"), config).unwrap();
    folder
}

fn contains_all(told: &str, parts: &[&str]) {
    for part in parts {
        assert!(told.contains(part), "{part} not in\n{told}");
    }
}

/// Cells of a table by the names of its columns.
fn rows(table: &Path) -> Vec<std::collections::BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_path(table).unwrap();
    reader.deserialize().map(Result::unwrap).collect()
}

#[test]
fn check_tells_sizes_corners_and_how_the_initial_mesh_fares() {
    let ci = folder(CI, &[]);
    let told = quadrille(ci.path(), &["check", "c.toml"]);
    assert_eq!(told.status.code(), Some(0));
    // z = 4 (1 − (x² + y²)/200): 0 in the corners, 4 in the middle; √(area/120) is a little more than √(400/120).
    contains_all(
        &text(&told.stdout),
        &[
            "extents: x -10 to 10 m (20 m), y -10 to 10 m (20 m), z 0 to 3.9",
            "area: 400 m² in plan, 420.",
            "target length t: 1.87",
            "corners of the outer boundary: 4, at (-10, -10), (10, -10), (10, 10), (-10, 10)\n",
            "initial mesh: 121 panels, 264 members of 1.8",
            "initial mesh: max_valence 4, limit 8: kept\n",
            "the initial mesh keeps every limit of the pattern",
        ],
    );
    let tight = folder(CI, &[("min_angle_deg = 12.0", "min_angle_deg = 89.0")]);
    let told = text(&quadrille(tight.path(), &["check", "c.toml"]).stdout);
    contains_all(&told, &[", limit 89: EXCEEDED\n", "the initial mesh exceeds 1 of the limits"]);
}

#[test]
fn millimetres_taken_for_metres_are_noticed() {
    let points = "[[-10.0, -10.0], [10.0, -10.0], [10.0, 10.0], [-10.0, 10.0]]";
    let large = folder(CI, &[(points, "[[0, 0], [20000, 0], [20000, 20000], [0, 20000]]")]);
    let told = text(&quadrille(large.path(), &["check", "c.toml"]).stderr);
    contains_all(
        &told,
        &["warning: domain.loop: 20000 m × 20000 m: are these millimetres?", "unit = \"mm\""],
    );
    let right = text(&quadrille(folder(CI, &[]).path(), &["check", "c.toml"]).stderr);
    assert!(!right.contains("millimetres"), "{right}");
}

/// A square of 12.345 m with a low roof as mesh, on `scale` × metres.
fn write_files(folder: &Path, scale: f64) {
    let vertex = |x: f64, y: f64, z: f64| format!("v {} {} {}\n", x * scale, y * scale, z * scale);
    let side = 12.345;
    let corners = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)];
    let ring: String = corners.iter().map(|&(x, y)| vertex(x, y, 1.25)).collect();
    fs::write(folder.join("ring.obj"), format!("{ring}l 1 2 3 4 1\n")).unwrap();
    fs::write(folder.join("start.obj"), format!("{ring}f 1 2 3 4\n")).unwrap();
    let top = vertex(6.125, 6.125, 2.5);
    fs::write(folder.join("roof.obj"), format!("{ring}{top}f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n")).unwrap();
}

fn of_files(unit: &str) -> String {
    format!(
        "version = 1\n[[domain.loop]]\nkind = \"obj\"\nfile = \"ring.obj\"{unit}\n[surface]\nkind = \"mesh\"\n\
         file = \"roof.obj\"{unit}\n[topology.initial]\nfile = \"start.obj\"{unit}\n[pattern]\npanels = 60\n\
         [objectives]\nminimise = [\"curvature\"]\n"
    )
}

#[test]
fn files_in_millimetres_give_what_files_in_metres_give() {
    let table = |unit: &str, scale: f64| {
        let folder = folder(&of_files(unit), &[]);
        write_files(folder.path(), scale);
        let told = quadrille(folder.path(), &["evaluate", "c.toml", "--string", "", "--out", "e"]);
        assert_eq!(told.status.code(), Some(0), "{}", text(&told.stderr));
        fs::read(folder.path().join("e/evaluation.csv")).unwrap()
    };
    let metres = table("", 1.0);
    assert!(text(&metres).contains(",curvature,"));
    assert_eq!(table("\nunit = \"mm\"", 1000.0), metres);
    assert_eq!(table("\nunit = \"m\"", 1.0), metres);
}

#[test]
fn a_unit_that_is_none_is_refused_with_those_that_are() {
    let folder = folder(&of_files("\nunit = \"mile\""), &[]);
    write_files(folder.path(), 1.0);
    let told = quadrille(folder.path(), &["check", "c.toml"]);
    assert_eq!(told.status.code(), Some(2));
    contains_all(&text(&told.stderr), &["domain.loop[0].unit", "mile", "\"mm\"", "\"ft\""]);
}

#[test]
fn a_design_whose_structure_fails_is_written_and_measured() {
    // Held in x alone, everything moves.
    let free = folder(CI, &[("fixed = [\"ux\", \"uy\", \"uz\"]", "fixed = [\"ux\"]")]);
    let evaluate = |more: &[&str]| {
        let mut arguments = vec!["evaluate", "c.toml", "--string", "", "--string", "ATTA"];
        arguments.extend(more);
        quadrille(free.path(), &arguments)
    };
    let told = evaluate(&["--out", "e"]);
    assert_eq!(told.status.code(), Some(0), "{}", text(&told.stderr));
    // The same with files and without.
    assert_eq!(text(&told.stdout), text(&evaluate(&[]).stdout));
    let rows = rows(&free.path().join("e/evaluation.csv"));
    assert_eq!(rows.len(), 2);
    for row in rows {
        assert_eq!(row["feasible"], "false");
        assert!(row["reason"].starts_with("mechanism: "), "{}", row["reason"]);
        assert!(row["deflection_m"].is_empty() && row["buckling_factor"].is_empty());
        for column in ["curvature", "skewness", "edge_spread_m", "faces", "angle_min_deg"] {
            assert!(row[column].parse::<f64>().unwrap() >= 0.0, "{column}");
        }
        for ending in [".obj", ".json", ".svg", ".vtu", "_members.csv"] {
            let file = free.path().join(format!("e/designs/{}{ending}", row["id"]));
            assert!(fs::metadata(&file).unwrap().len() > 0, "{}", file.display());
        }
    }
}

/// The data that a page holds.
fn facts(page: &Path) -> Json {
    let page = fs::read_to_string(page).unwrap();
    let after = page.split_once("id=\"facts-data\">").unwrap().1;
    serde_json::from_str(after.split_once("</script>").unwrap().0).unwrap()
}

#[test]
fn a_run_without_a_feasible_design_says_why_and_draws_the_nearest() {
    let hopeless = folder(CI, &[("min_angle_deg = 12.0", "min_angle_deg = 12.0\nmin_edge_m = 3.0")]);
    let told = quadrille(
        hopeless.path(),
        &["run", "c.toml", "--out", "r", "--generations", "1", "--progress", "plain"],
    );
    assert_eq!(told.status.code(), Some(3));
    let stderr = text(&told.stderr);
    contains_all(
        &stderr,
        &["first generation: 0 of ", "min_edge_m ", "the initial mesh exceeds min_edge_m ", "(limit 3)"],
    );
    assert!(stderr.find("first generation") < stderr.find("generation 1/1"), "{stderr}");

    let folder = hopeless.path().join("r");
    let history = rows(&folder.join("history.csv"));
    let facts = facts(&folder.join("report.html"));
    assert_eq!(facts["front"].as_array().unwrap().len(), 0);
    let blocked = history.iter().filter(|row| row["reason"].contains("min_edge_m ")).count();
    let obstacle = facts["obstacles"].as_array().unwrap().iter().find(|o| o["name"] == "min_edge_m").unwrap();
    assert_eq!(obstacle["designs"], blocked);

    let misses = facts["misses"].as_array().unwrap();
    assert!(!misses.is_empty() && misses.len() <= 12);
    let measure = |id: &str| {
        let row = history.iter().find(|row| row["id"] == id).unwrap();
        (row["violation_stage"].clone(), row["violation"].parse::<f64>().unwrap())
    };
    let measures: Vec<_> = misses.iter().map(|miss| measure(miss["id"].as_str().unwrap())).collect();
    assert!(measures.is_sorted_by(|a, b| a <= b), "{measures:?}");
    let least = history.iter().filter(|row| !row["expressed"].is_empty()).map(|row| measure(&row["id"]));
    assert_eq!(Some(measures[0].clone()), least.min_by(|a, b| a.partial_cmp(b).unwrap()));
    for miss in misses {
        let id = miss["id"].as_str().unwrap();
        for ending in [".obj", ".svg", ".json"] {
            assert!(folder.join(format!("designs/{id}{ending}")).exists(), "{id}{ending}");
        }
    }
    // Made again from the folder: the same page.
    let page = fs::read(folder.join("report.html")).unwrap();
    assert!(quadrille(hopeless.path(), &["report", "r"]).status.success());
    assert_eq!(fs::read(folder.join("report.html")).unwrap(), page);
}

#[test]
fn a_run_with_feasible_designs_says_so_after_the_first_generation() {
    let ci = folder(CI, &[]);
    let arguments = ["run", "c.toml", "--out", "r", "--generations", "1", "--progress"];
    let told = |how: &str, more: &[&str]| {
        let arguments: Vec<&str> = arguments.iter().chain(&[how]).chain(more).copied().collect();
        let output = quadrille(ci.path(), &arguments);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        text(&output.stderr)
    };
    contains_all(
        &told("plain", &[]),
        &["first generation: ", " designs feasible", "the initial mesh is feasible"],
    );
    let quiet = told("none", &["--force"]);
    assert!(!quiet.contains("first generation"), "{quiet}");
    assert!(facts(&ci.path().join("r/report.html"))["misses"].as_array().unwrap().is_empty());
}
