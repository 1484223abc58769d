//! `run` and what works on its results: one small run, looked at from all sides.

use assert_cmd::Command;
use std::fs;
use std::path::{Path, PathBuf};

fn config(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("configs").join(name)
}

fn quadrille(folder: &Path, arguments: &[&str]) -> std::process::Output {
    Command::cargo_bin("quadrille").unwrap().current_dir(folder).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn run(folder: &Path, out: &str, more: &[&str]) -> std::process::Output {
    let ci = config("ci.toml");
    let mut arguments = vec!["run", ci.to_str().unwrap(), "--out", out, "--set", "search.generations=3"];
    arguments.extend(more);
    quadrille(folder, &arguments)
}

fn read(folder: &Path, name: &str) -> Vec<u8> {
    fs::read(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

const TABLES: [&str; 3] = ["pareto.csv", "history.csv", "generations.csv"];

fn first_id(folder: &Path) -> String {
    let pareto = text(&read(folder, "pareto.csv"));
    pareto.lines().nth(1).unwrap().split(',').next().unwrap().to_owned()
}

#[test]
fn writes_everything_and_nothing_twice() {
    let temporary = tempfile::tempdir().unwrap();
    let output = run(temporary.path(), "r", &["--csv-dialect", "excel-eu"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    // Stderr is no terminal here: one line a generation.
    let lines = text(&output.stderr);
    for part in ["generation 3/3", "feasible", "front", "hypervolume", "/s"] {
        assert!(lines.contains(part), "{part} not in {lines}");
    }
    let folder = temporary.path().join("r");
    let id = first_id(&folder);
    for name in
        TABLES.iter().chain(&["manifest.json", "report.html", "operators.csv", "design_explorer/data.csv"])
    {
        assert!(!read(&folder, name).is_empty(), "{name}");
    }
    for ending in [".obj", ".json", ".svg", ".vtu", "_members.vtu", "_nodes.csv", "_members.csv"] {
        assert!(!read(&folder, &format!("designs/{id}{ending}")).is_empty(), "{ending}");
    }
    assert_eq!(&read(&folder, "pareto.excel-eu.csv")[..3], b"\xEF\xBB\xBF");
    let header = text(&read(&folder, "pareto.csv")).lines().next().unwrap().to_owned();
    let start = "id,string,expressed,code,symmetry,generation,feasible,deflection_m,curvature,edge_spread_m,";
    assert!(header.starts_with(start), "{header}");
    let history = text(&read(&folder, "history.csv"));
    assert!(history.lines().next().unwrap().ends_with(",violation_stage,violation,reason"));
    assert!(!history.contains("NaN") && !history.contains("inf"));
    // The initial mesh is always evaluated.
    assert!(history.lines().any(|line| line.split(',').nth(1) == Some("\"\"")));

    let again = run(temporary.path(), "r", &[]);
    assert_eq!(again.status.code(), Some(2));
    assert!(text(&again.stderr).contains("--force"), "{}", text(&again.stderr));
    assert_eq!(run(temporary.path(), "r", &["--force"]).status.code(), Some(0));

    works_on_results(temporary.path(), &id);
}

/// What starts from a results folder, on the one just written.
fn works_on_results(temporary: &Path, id: &str) {
    let verified = quadrille(temporary, &["verify", "r"]);
    assert_eq!(verified.status.code(), Some(0), "{}", text(&verified.stdout));
    let obj = quadrille(temporary, &["export", "r", "--design", id, "--format", "obj"]);
    assert_eq!(obj.stdout, read(temporary, &format!("r/designs/{id}.obj")));
    let dual =
        quadrille(temporary, &["export", "r", "--design", &id[..6], "--format", "json", "--pattern", "dual"]);
    assert!(text(&dual.stdout).contains("compas.datastructures/Mesh"));
    let told = quadrille(temporary, &["explain", "r", id]);
    assert!(text(&told.stdout).contains("governs"), "{}", text(&told.stdout));
    let picture = text(&read(temporary, &format!("r/explained/{id}.svg")));
    for part in ["utilisation of members, uls", "largest deflection", "first buckling mode, uls: factor"] {
        assert!(picture.contains(part), "{part} not in the picture");
    }
    let elsewhere = quadrille(temporary, &["explain", "r", id, "--svg", "mine/plan.svg"]);
    assert!(elsewhere.status.success());
    assert_eq!(text(&read(temporary, "mine/plan.svg")), picture);
    let unknown = quadrille(temporary, &["explain", "r", "zzz"]);
    assert_eq!(unknown.status.code(), Some(2));

    // A changed number is noticed.
    let path = temporary.join("r/history.csv");
    let history = fs::read_to_string(&path).unwrap();
    let line = history.lines().find(|line| line.starts_with(id)).unwrap();
    let value = line.split(',').nth(7).unwrap();
    fs::write(&path, history.replace(value, "0.5")).unwrap();
    let verified = quadrille(temporary, &["verify", "r", "--design", id]);
    assert_eq!(verified.status.code(), Some(1));
    assert!(text(&verified.stdout).contains("deflection_m: file 0.5"), "{}", text(&verified.stdout));
}

#[test]
fn threads_and_interruption_change_no_byte() {
    let temporary = tempfile::tempdir().unwrap();
    assert!(run(temporary.path(), "one", &["--threads", "1"]).status.success());
    assert!(run(temporary.path(), "two", &["--threads", "2"]).status.success());
    // Ended early by a limit, then resumed with the limit raised.
    let short = ["--set", "search.generations=2"];
    assert!(run(temporary.path(), "resumed", &short).status.success());
    assert!(run(temporary.path(), "resumed", &["--resume"]).status.success());
    for table in TABLES {
        let expected = read(&temporary.path().join("one"), table);
        assert_eq!(read(&temporary.path().join("two"), table), expected, "{table}, two threads");
        assert_eq!(read(&temporary.path().join("resumed"), table), expected, "{table}, resumed");
    }
    let other = run(temporary.path(), "one", &["--resume", "--seed", "5"]);
    assert_eq!(other.status.code(), Some(2));
    assert!(text(&other.stderr).contains("run.seed"), "{}", text(&other.stderr));
}

#[test]
fn no_feasible_design_exits_3() {
    let temporary = tempfile::tempdir().unwrap();
    let more = ["--set", "structure.requirement=[{quantity=\"deflection\",combination=\"sls\",max=1e-9}]"];
    assert_eq!(run(temporary.path(), "r", &more).status.code(), Some(3));
}

#[test]
fn a_seed_is_drawn_told_and_recorded() {
    let temporary = tempfile::tempdir().unwrap();
    let ci = fs::read_to_string(config("ci.toml")).unwrap();
    fs::write(temporary.path().join("c.toml"), ci.replace("seed = 1\n", "")).unwrap();
    let arguments = ["run", "c.toml", "--generations", "0"];
    let output = quadrille(temporary.path(), &arguments);
    let told = text(&output.stderr);
    let seed = told.lines().find_map(|line| line.strip_prefix("seed ")?.strip_suffix(", drawn")).unwrap();
    let manifest = text(&read(&temporary.path().join("results/ci"), "manifest.json"));
    assert!(manifest.contains(&format!("\"seed\": {seed}")));
}

#[test]
fn evaluate_compares_given_strings() {
    let temporary = tempfile::tempdir().unwrap();
    fs::write(temporary.path().join("s.csv"), "name,string\ninitial,\nother,TPDAPTTTPTPA*TPP\n").unwrap();
    let ci = config("ci.toml");
    let ci = ci.to_str().unwrap();
    let output = quadrille(temporary.path(), &["evaluate", ci, "--strings", "s.csv", "--out", "o"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("deflection_m"));
    let table = text(&read(temporary.path(), "o/evaluation.csv"));
    assert_eq!(table.lines().count(), 3);
    let largest = text(&read(temporary.path(), "o/normalised.csv"));
    assert!(largest.lines().skip(1).any(|line| line.split(',').any(|cell| cell == "1")));
    let not_a_run = quadrille(temporary.path(), &["export", "o", "--design", "0", "--format", "obj"]);
    assert_eq!(not_a_run.status.code(), Some(2));
    assert!(text(&not_a_run.stderr).contains("`evaluate` wrote it"), "{}", text(&not_a_run.stderr));
    let wrong = quadrille(temporary.path(), &["evaluate", ci, "--string", "ATXA"]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(text(&wrong.stderr).contains("at character 2"), "{}", text(&wrong.stderr));
}

#[test]
fn neighbours_are_ranked() {
    let temporary = tempfile::tempdir().unwrap();
    let ci = config("ci.toml");
    let arguments = ["neighbours", ci.to_str().unwrap(), "--string", "", "--edges", "3", "--out", "n.csv"];
    let output = quadrille(temporary.path(), &arguments);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("better than all its neighbours in"), "{}", text(&output.stdout));
    assert!(text(&read(temporary.path(), "n.csv")).lines().count() > 2);
}
