//! What is said of objectives that cannot be meant, and of threads that the system does not give.

use assert_cmd::Command;
use std::process::Output;

fn quadrille(arguments: &[&str]) -> Output {
    let mut command = Command::cargo_bin("quadrille").unwrap();
    command.current_dir(env!("CARGO_MANIFEST_DIR")).args(arguments).output().unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// `check` of the ci config with other objectives.
fn check(minimise: &str, more: &[&str]) -> Output {
    let minimise = format!("objectives.minimise={minimise}");
    let axes = ["--set", "objectives.ideal=[]", "--set", "objectives.reference=[]"];
    quadrille(&[&["check", "configs/ci.toml", "--set", &minimise], &axes[..], more].concat())
}

#[test]
fn what_is_better_large_is_refused_with_the_right_name() {
    for (name, instead) in [
        ("buckling_factor", "buckling"),
        ("angle_min", "skewness_max"),
        ("edge_min", "edge_spread"),
        ("area_covered", "boundary_gap"),
    ] {
        let refused = check(&format!("[\"mass\", \"{name}\"]"), &[]);
        let told = stderr(&refused);
        assert_eq!(refused.status.code(), Some(2), "{told}");
        assert!(told.contains(&format!("objectives.minimise[1]: found \"{name}\"")), "{told}");
        assert!(told.contains(&format!("did you mean \"{instead}\"?")), "{told}");
        assert!(check(&format!("[\"mass\", \"{instead}\"]"), &[]).status.success());
    }
    // Nor are they among what is allowed.
    let told = stderr(&check("[\"nonsense\"]", &[]));
    assert!(told.contains("buckling,") && !told.contains("buckling_factor"), "{told}");
}

#[test]
fn the_warning_of_many_objectives_says_what_happens() {
    let five = "[\"mass\", \"deflection\", \"curvature\", \"skewness\", \"edge_spread\"]";
    let told = stderr(&check(five, &[]));
    assert!(told.contains("5 objectives") && told.contains("add to the hypervolume"), "{told}");
    let told = stderr(&check(five, &["--set", "search.survival=\"crowding\""]));
    assert!(told.contains("by crowding alone"), "{told}");
}

#[test]
fn constant_and_dependent_objectives_are_warned_of_after_the_first_generation() {
    let folder = tempfile::tempdir().unwrap();
    let run = |minimise: &str| {
        let minimise = format!("objectives.minimise={minimise}");
        let arguments = ["run", "configs/ci.toml", "--generations", "1", "--force", "--set", &minimise];
        let axes = ["--set", "objectives.ideal=[]", "--set", "objectives.reference=[]", "--out"];
        stderr(&quadrille(&[&arguments[..], &axes, &[folder.path().to_str().unwrap()]].concat()))
    };
    // One section for all: the mass is that of the length.
    let told = run("[\"mass\", \"curvature\", \"member_length\", \"height\"]");
    assert_eq!(told.matches("warning: objective").count(), 2, "{told}");
    assert!(told.contains("objectives \"mass\" and \"member_length\" put all 36 designs"), "{told}");
    assert!(told.contains("objective \"height\" is 0.2 for all 36 designs"), "{told}");
    let told = run("[\"deflection\", \"curvature\", \"edge_spread\"]");
    assert!(!told.contains("warning"), "{told}");
}

#[cfg(unix)]
#[test]
fn threads_that_the_system_does_not_give_are_told_and_nothing_is_touched() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let program = assert_cmd::cargo::cargo_bin("quadrille");
    for arguments in [
        "run configs/ci.toml --threads 1024 --out",
        "evaluate configs/ci.toml --string A --set run.threads=1024 --out",
    ] {
        // Room for the program, not for the stacks of so many threads; these are large, so that what is left when one finds no room
        // is enough for all else.
        let limits = "ulimit -v 700000; export RUST_MIN_STACK=50000000";
        let script = format!("{limits}; exec '{}' {arguments} '{}'", program.display(), out.display());
        let mut shell = Command::new("sh");
        let output = shell.current_dir(env!("CARGO_MANIFEST_DIR")).args(["-c", &script]).output().unwrap();
        let told = stderr(&output);
        assert_eq!(output.status.code(), Some(1), "{told}");
        assert!(
            told.contains("cannot start 1024 threads: ") && told.contains("--set run.threads=N"),
            "{told}"
        );
        assert!(!out.join("history.csv").exists() && !out.join(".quadrille.lock").exists());
    }
}
