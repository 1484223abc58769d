//! A wrong config ends with exit code 2 and says where and what (docs/reference/files.md §7).

use assert_cmd::Command;
use std::path::Path;

/// `configs/dome.toml` with one line put in place of another, checked; stderr and the exit code.
fn check_with(old: &str, new: &str) -> (String, Option<i32>) {
    let dome = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/dome.toml");
    let text = std::fs::read_to_string(dome).unwrap();
    assert!(text.contains(old), "dome.toml no longer has {old}");
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("c.toml"), text.replacen(old, new, 1)).unwrap();
    run(folder.path(), &["check", "c.toml"])
}

fn run(folder: &Path, arguments: &[&str]) -> (String, Option<i32>) {
    let output =
        Command::cargo_bin("quadrille").unwrap().current_dir(folder).args(arguments).output().unwrap();
    (String::from_utf8(output.stderr).unwrap(), output.status.code())
}

fn line_of(text: &str) -> usize {
    let dome = include_str!("../../configs/dome.toml");
    1 + dome.lines().position(|line| line.contains(text)).unwrap()
}

/// One wrong line, and what the message must hold beside its file and line.
fn refused(old: &str, new: &str, parts: &[&str]) {
    let (stderr, code) = check_with(old, new);
    assert_eq!(code, Some(2), "{new}: {stderr}");
    let place = format!("c.toml:{}: ", line_of(old));
    for part in parts.iter().chain(&[place.as_str()]) {
        assert!(stderr.contains(part), "`{new}` should say `{part}`, says: {stderr}");
    }
}

#[test]
fn misspelt_key() {
    refused(
        "population = 24",
        "populaton = 24",
        &["search.populaton: unknown key, did you mean `population`?"],
    );
}

#[test]
fn misspelt_key_inside_a_tagged_table() {
    refused("rise_m = 4.0", "rice_m = 4.0", &["surface.rice_m: unknown key, did you mean `rise_m`?"]);
}

#[test]
fn key_in_the_wrong_table() {
    refused("panels = 200", "population = 200", &["`population` belongs in [search]"]);
}

#[test]
fn population_0() {
    refused(
        "population = 24",
        "population = 0",
        &["search.population: found 0; allowed: a whole number ≥ 2"],
    );
}

#[test]
fn negative_length() {
    refused(
        "width_m = 0.12",
        "width_m = -0.12",
        &["structure.section.width_m: found -0.12; allowed: a number > 0"],
    );
}

#[test]
fn not_a_number() {
    refused("rise_m = 4.0", "rise_m = nan", &["surface.rise_m: found nan"]);
    refused("rise_m = 4.0", "rise_m = inf", &["surface.rise_m: found inf"]);
    refused("rise_m = 4.0", "rise_m = \"4\"", &["surface.rise_m: found \"4\"; allowed: a number"]);
}

#[test]
fn unknown_objective() {
    refused("minimise = [\"mass\"", "minimise = [\"weight\"", &["no objective \"weight\"", "mass, "]);
}

#[test]
fn unknown_combination_and_load_case() {
    refused(
        "combination = \"sls\"",
        "combination = \"slz\"",
        &["no combination \"slz\", did you mean `sls`?"],
    );
    let old = "height = { fixed_m = 0.20 }";
    let new = format!("{old}\ncombinations = {{ sls = {{ wind = 1.0 }}, uls = {{ snow = 1.5 }} }}");
    let (stderr, code) = check_with(old, &new);
    assert_eq!(code, Some(2));
    let place = format!("c.toml:{}: structure.combinations.sls.wind", line_of(old) + 1);
    assert!(stderr.contains(&place) && stderr.contains("no load case \"wind\""), "{stderr}");
}

#[test]
fn missing_file() {
    let (stderr, _) = check_with("kind = \"paraboloid\"", "kind = \"mesh\"");
    assert!(stderr.contains("surface.file: missing; allowed: a string"), "{stderr}");
    assert!(stderr.contains("surface.rise_m: unknown key; allowed here: file, kind"), "{stderr}");
    let topology = "initial = { grid = [2, 2] }";
    refused(
        topology,
        "initial = { file = \"no.obj\" }",
        &["topology.initial.file", "there is no file", "no.obj"],
    );
}

#[test]
fn what_designers_steer_by_is_checked() {
    let tokens = "tokens = { min = 4, max = 24 }";
    refused(
        tokens,
        "initial = { seeds = [\"\"] }",
        &["search.initial.seeds: unknown key: it is search.seeds now, which also takes a results folder"],
    );
    refused(tokens, "seeds = \"no/folder\"", &["search.seeds: found \"no/folder\"", "pareto.csv"]);
    refused(tokens, "seeds = \".\"", &["search.seeds: found \".\"", "a list of strings, or the folder"]);
    refused(
        tokens,
        &format!("seeds = [\"{}\"]", "T".repeat(50)),
        &["search.seeds[0]: found 50 tokens", "at most search.tokens.max, 40"],
    );
    refused(
        tokens,
        "frozen = { strips = [0, 77] }",
        &["search.frozen.strips[1]: found 77; allowed: numbers of strips of the initial mesh, at most "],
    );
    refused(
        tokens,
        "frozen = { regions_m = [[[90, 90], [91, 90], [91, 91]]] }",
        &["search.frozen.regions_m[0]: no face of the initial mesh has its middle in this polygon"],
    );
    refused(
        tokens,
        "frozen = { regions_m = [[[0, 0], [1, 0]]] }",
        &["search.frozen.regions_m[0]: found 2 points; allowed: a polygon of 3 or more"],
    );
    let minimise = "minimise = [\"mass\", \"deflection\", \"curvature\", \"edge_spread\"]";
    refused(
        minimise,
        &format!("weights = [1.0]\n{minimise}"),
        &["objectives.weights: found 1 numbers; allowed: one for each of the 4 objectives"],
    );
    refused(
        minimise,
        &format!("aspiration = [1.0, 2.0]\nweights = [1, 0, 1, 1]\n{minimise}"),
        &["objectives.aspiration: found 2 numbers", "objectives.weights[1]: found 0; allowed: more than 0"],
    );
}

#[test]
fn token_bounds_and_seeds() {
    let tokens = "tokens = { min = 4, max = 24 }";
    refused(tokens, "tokens = { min = 24, max = 4 }", &["found min = 24 and max = 4; allowed: min ≤ max"]);
    refused(
        tokens,
        "seeds = [\"ATXA\"]",
        &["search.seeds[0]: found \"ATXA\": unexpected 'X' at character 2"],
    );
}

#[test]
fn what_is_optimised_needs_a_surface() {
    let folder = tempfile::tempdir().unwrap();
    let text = "version = 1\n[[domain.loop]]\nkind = \"polyline\"\npoints_m = [[0,0],[9,0],[9,9],[0,9]]\n[surface]\nkind = \"free\"\n\
                [pattern]\nrelax = { kind = \"optimise\" }\n";
    std::fs::write(folder.path().join("c.toml"), text).unwrap();
    let (stderr, code) = run(folder.path(), &["check", "c.toml"]);
    assert_eq!(code, Some(2), "{stderr}");
    assert!(stderr.contains("c.toml:8: ") && stderr.contains("needs a surface"), "{stderr}");
}

#[test]
fn damping_ideal_and_probability() {
    refused(
        "panels = 200",
        "relax = { damping = 1.5 }",
        &["pattern.relax.damping: found 1.5; allowed: a number > 0 and ≤ 1"],
    );
    let objectives = "minimise = [\"mass\"";
    let (stderr, code) = check_with(objectives, &format!("ideal = [1.0]\nreference = [2.0]\n{objectives}"));
    assert_eq!(code, Some(2));
    assert!(stderr.contains("objectives.ideal: found 1 numbers for 4 objectives"), "{stderr}");
    refused(
        "population = 24",
        "crossover = 1.5",
        &["search.crossover: found 1.5; allowed: a number ≥ 0 and ≤ 1"],
    );
}

#[test]
fn broken_toml() {
    refused("[pattern]", "[pattern", &["c.toml:"]);
}

#[test]
fn every_problem_is_told_at_once() {
    let (stderr, _) = check_with("population = 24\ngenerations = 15", "population = 0\ngenerations = -1");
    assert_eq!(stderr.lines().count(), 2, "{stderr}");
}

#[test]
fn no_such_config() {
    let folder = tempfile::tempdir().unwrap();
    let (stderr, code) = run(folder.path(), &["check", "none.toml"]);
    assert_eq!(code, Some(2));
    assert!(stderr.contains("none.toml"), "{stderr}");
}

#[test]
fn set_is_checked_alike() {
    let configs = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs");
    for (set, part) in [
        ("search.population=0", "--set search.population=0: search.population: found 0"),
        ("search.populaton=3", "did you mean `population`?"),
        ("search.population", "found no `=`"),
        ("domain.loop[4].radius_m=3", "there is no entry 4; allowed: 0 to 0"),
        ("search.generations=5000000000", "found 5000000000; allowed: a whole number ≥ 0 and ≤ 4294967295"),
        (
            "structure.elements_per_member=5000000000",
            "found 5000000000; allowed: a whole number ≥ 1 and ≤ 100",
        ),
        ("search.population=1000000000000", "allowed: a whole number ≥ 2 and ≤ 1000000"),
        ("search.rules.drop_last=0.9", "found shares that add up to 1.55; allowed: at most 1"),
        ("pattern.max_faces=100000000000", "found 100000000000; allowed: a whole number ≥ 1 and ≤ 10000000"),
    ] {
        let (stderr, code) = run(&configs, &["check", "dome.toml", "--set", set]);
        assert_eq!(code, Some(2), "{set}");
        assert!(stderr.contains(part), "{set}: {stderr}");
    }
}
