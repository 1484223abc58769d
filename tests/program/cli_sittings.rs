//! `run` in several sittings, and what it says of itself on the way.

use assert_cmd::Command;
use std::fs;
use std::path::{Path, PathBuf};

fn config() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/ci.toml")
}

/// Runs `configs/ci.toml` in `folder`; exit code, stdout and stderr.
fn run(folder: &Path, out: &str, more: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::cargo_bin("quadrille").unwrap();
    command.current_dir(folder).arg("run").arg(config()).args(["--out", out]).args(more);
    let output = command.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

fn manifest(folder: &Path) -> serde_json::Value {
    serde_json::from_slice(&fs::read(folder.join("manifest.json")).unwrap()).unwrap()
}

#[test]
fn a_sitting_that_does_nothing_leaves_the_manifest_and_says_so() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path().join("r");
    assert_eq!(run(temporary.path(), "r", &["--generations", "2", "--threads", "2"]).0, Some(0));
    let first = manifest(&folder);
    for generations in ["2", "1"] {
        let more = ["--resume", "--generations", generations, "--threads", "1"];
        let (code, _, told) = run(temporary.path(), "r", &more);
        assert_eq!(code, Some(0), "{told}");
        let expected = format!(
            "note: the run has already done 2 generations, and {generations} generations are asked for: nothing is done\n"
        );
        assert!(told.contains(&expected), "{told}");
        assert_eq!(manifest(&folder), first);
    }
    let (_, _, told) = run(temporary.path(), "r", &["--resume", "--generations", "3", "--threads", "1"]);
    assert!(!told.contains("nothing is done"), "{told}");
    let last = manifest(&folder);
    assert!(last["seconds"].as_f64() > first["seconds"].as_f64());
    assert_eq!((&last["started"], last["threads"].as_u64()), (&first["started"], Some(1)));
}

#[test]
fn very_verbose_tells_every_design() {
    let temporary = tempfile::tempdir().unwrap();
    let (_, _, told) = run(temporary.path(), "r", &["--generations", "1", "-vv"]);
    let history = fs::read_to_string(temporary.path().join("r/history.csv")).unwrap();
    for line in history.lines().skip(1) {
        let id = line.split(',').next().unwrap();
        let of_design = told.lines().find(|told| told.starts_with(&format!("  {id}: "))).unwrap();
        assert_eq!(of_design.ends_with(": feasible"), line.contains(",true,"), "{of_design}");
    }
    let (_, _, once) = run(temporary.path(), "r", &["--generations", "1", "-v", "--force"]);
    assert!(once.contains("  bred ") && !once.contains(": feasible\n"), "{once}");
}

#[test]
fn a_bar_that_nobody_can_see_is_lines() {
    let temporary = tempfile::tempdir().unwrap();
    let (_, _, told) = run(temporary.path(), "r", &["--generations", "1", "--progress", "bar"]);
    assert!(told.contains("\ngeneration 1/1 "), "{told}");
}

#[test]
fn a_folder_with_a_space_is_quoted_in_what_is_to_be_typed() {
    let temporary = tempfile::tempdir().unwrap();
    let (_, _, told) = run(temporary.path(), "my r", &["--generations", "0"]);
    assert!(told.contains("open 'my r/report.html' in"), "{told}");
    assert!(told.contains("`quadrille explain 'my r' ID`"), "{told}");
}

#[test]
fn bounds_of_seed_and_length_are_told() {
    let temporary = tempfile::tempdir().unwrap();
    let seed = "allowed: a whole number ≥ 0 and ≤ 9007199254740991";
    let length = "search.tokens.max: found 100000000; allowed: a whole number ≥ 1 and ≤ 10000";
    for (more, expected) in [
        (["--seed", "18446744073709551615"], seed),
        (["--seed", "9007199254740992"], seed),
        (["--set", "run.seed=18446744073709551615"], seed),
        (["--set", "search.tokens.max=100000000"], length),
    ] {
        let (code, _, told) = run(temporary.path(), "r", &more);
        assert!(code == Some(2) && told.contains(expected), "{told}");
    }
    let text = fs::read_to_string(config()).unwrap().replace("seed = 1\n", "seed = 18446744073709551615\n");
    fs::write(temporary.path().join("c.toml"), text).unwrap();
    let mut command = Command::cargo_bin("quadrille").unwrap();
    let output = command.current_dir(temporary.path()).args(["check", "c.toml"]).output().unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(2) && told.contains("up to 9223372036854775807"), "{told}");
    assert!(told.contains("c.toml:"), "{told}");
    assert_eq!(run(temporary.path(), "r", &["--seed", "9007199254740991", "--generations", "0"]).0, Some(0));
}
