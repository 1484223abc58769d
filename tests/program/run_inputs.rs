//! The files that a config names are read once, at the start: what happens to them later changes nothing, and is told.
#![cfg(unix)]

use crate::roof;
use crate::roof::{begin, command, manifest, project, quadrille, roof as roof_of, signal, tables, told};
use std::fs;
use std::path::Path;
use std::process::Stdio;

fn finished(more: &[&str]) -> tempfile::TempDir {
    let folder = project();
    let (code, _, stderr) = quadrille(folder.path(), &[&["run", "c.toml", "--out", "r"], more].concat());
    assert_eq!(code, Some(0), "{stderr}");
    folder
}

/// The first design of the front.
fn id(folder: &Path) -> String {
    let pareto = fs::read_to_string(folder.join("r/pareto.csv")).unwrap();
    pareto.lines().nth(1).unwrap().split(',').next().unwrap().to_owned()
}

#[test]
fn what_happens_to_inputs_during_a_run_changes_nothing() {
    let undisturbed = finished(&["--generations", "12"]);
    let changes: [fn(&Path); 3] = [
        |folder| fs::rename(folder.join("in"), folder.join("elsewhere")).unwrap(),
        |folder| fs::write(folder.join("in/roof.obj"), roof_of(1.0)).unwrap(),
        |folder| fs::write(folder.join("c.toml"), "nonsense").unwrap(),
    ];
    for change in changes {
        let folder = project();
        let child = begin(folder.path(), &["--generations", "12"], 1);
        change(folder.path());
        let (code, _, stderr) = told(child.wait_with_output().unwrap());
        assert_eq!(code, Some(0), "{stderr}");
        assert!(tables(&folder.path().join("r")) == tables(&undisturbed.path().join("r")));
        let hashes = |folder: &Path| manifest(&folder.join("r"))["input_files"].clone();
        assert_eq!(hashes(folder.path()), hashes(undisturbed.path()));
    }
}

#[test]
fn a_changed_input_is_named() {
    let folder = finished(&["--generations", "1"]);
    let id = id(folder.path());
    let original = fs::read(folder.path().join("in/roof.obj")).unwrap();
    fs::create_dir(folder.path().join("backup")).unwrap();
    fs::write(folder.path().join("backup/roof.obj"), original).unwrap();
    fs::copy(folder.path().join("in/outline.obj"), folder.path().join("backup/outline.obj")).unwrap();
    fs::write(folder.path().join("in/roof.obj"), roof_of(1.0)).unwrap();
    let commands: [&[&str]; 3] =
        [&["export", "r", "--design", &id, "--format", "obj"], &["explain", "r", &id], &["verify", "r"]];
    for arguments in commands {
        let (code, _, stderr) = quadrille(folder.path(), arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {stderr}");
        assert!(stderr.contains("in/roof.obj: was changed since the run"), "{stderr}");
        assert!(stderr.contains("--inputs DIR") && !stderr.contains("outline.obj"), "{stderr}");
        let (code, _, stderr) = quadrille(folder.path(), &[arguments, &["--inputs", "backup"]].concat());
        assert_eq!(code, Some(0), "{arguments:?}: {stderr}");
    }
    // The page needs no inputs.
    let (code, _, stderr) = quadrille(folder.path(), &["report", "r"]);
    assert_eq!(code, Some(0), "{stderr}");
    assert!(stderr.contains("warning: ") && stderr.contains("in/roof.obj: was changed"), "{stderr}");
    let (_, _, stderr) = quadrille(folder.path(), &["report", "r", "--inputs", "backup"]);
    assert_eq!(stderr, "");
    let (code, _, stderr) = quadrille(folder.path(), &["report", "r", "--inputs", "nowhere"]);
    assert!(code == Some(2) && stderr.contains("there is no such folder"), "{stderr}");
    let (code, _, stderr) = quadrille(folder.path(), &["run", "c.toml", "--out", "r", "--resume"]);
    assert!(code == Some(2) && stderr.contains("what is in the file in/roof.obj"), "{stderr}");
}

#[test]
fn a_moved_input_is_found_with_inputs() {
    let folder = finished(&["--generations", "1"]);
    let id = id(folder.path());
    fs::rename(folder.path().join("in"), folder.path().join("archive")).unwrap();
    let (code, _, stderr) = quadrille(folder.path(), &["explain", "r", &id]);
    assert_eq!(code, Some(2), "{stderr}");
    assert!(stderr.contains("in/roof.obj: is no longer there"), "{stderr}");
    assert!(stderr.contains("in/outline.obj: is no longer there"), "{stderr}");
    let expected = fs::read(folder.path().join(format!("r/designs/{id}.obj"))).unwrap();
    let export = ["export", "r", "--design", &id, "--format", "obj", "--inputs", "archive"];
    let (code, stdout, stderr) = quadrille(folder.path(), &export);
    assert_eq!(code, Some(0), "{stderr}");
    assert!(stdout.as_bytes() == expected);
}

#[test]
fn the_folder_of_the_config_is_told_without_detours() {
    let folder = project();
    fs::create_dir(folder.path().join("sub")).unwrap();
    std::os::unix::fs::symlink(folder.path(), folder.path().join("sub/link")).unwrap();
    for (n, config) in ["../c.toml", "link/c.toml", "./../sub/../c.toml"].into_iter().enumerate() {
        let out = format!("../r{n}");
        let arguments = ["run", config, "--out", &out, "--generations", "0"];
        let (code, _, stderr) = quadrille(&folder.path().join("sub"), &arguments);
        assert_eq!(code, Some(0), "{stderr}");
        let told = manifest(&folder.path().join(format!("r{n}")))["config_folder"].clone();
        assert_eq!(told.as_str(), folder.path().canonicalize().unwrap().to_str(), "{config}");
    }
    // From anywhere.
    assert_eq!(quadrille(Path::new("/"), &["verify", folder.path().join("r1").to_str().unwrap()]).0, Some(0));
}

#[test]
fn a_config_may_come_through_a_pipe() {
    let folder = project();
    for (n, config) in ["-", "/dev/stdin"].into_iter().enumerate() {
        let out = format!("r{n}");
        let mut command = command(folder.path(), &["run", config, "--out", &out, "--generations", "0"]);
        command.stdin(Stdio::from(fs::File::open(folder.path().join("c.toml")).unwrap()));
        let (code, _, stderr) = told(command.output().unwrap());
        assert_eq!(code, Some(0), "{config}: {stderr}");
        assert_eq!(quadrille(folder.path(), &["verify", &out]).0, Some(0));
    }
}

#[test]
fn an_unfinished_run_can_be_looked_at() {
    let folder = project();
    let mut child = begin(folder.path(), &["--generations", "100000"], 3);
    // Still, so that what is looked at does not change.
    signal(&child, "STOP");
    looked_at(folder.path(), "goes on");
    child.kill().unwrap();
    child.wait().unwrap();
    looked_at(folder.path(), "was interrupted");
    let child = begin(folder.path(), &["--generations", "100000", "--resume"], 5);
    signal(&child, "TERM");
    assert_eq!(child.wait_with_output().unwrap().status.code(), Some(143));
    looked_at(folder.path(), "was interrupted");
}

/// All three commands, on the last finished generation.
fn looked_at(folder: &Path, state: &str) {
    let (code, _, stderr) = quadrille(folder, &["report", "r"]);
    assert_eq!(code, Some(0), "{stderr}");
    let generation = roof::finished(&folder.join("r")) - 1;
    let expected = format!("the run in r {state}: what it had found after generation {generation}, ");
    assert!(stderr.contains(&expected), "{expected} not in {stderr}");
    let page = fs::read_to_string(folder.join("r/report.html")).unwrap();
    assert!(page.contains(&format!("ci (unfinished, after generation {generation})")));
    // The initial mesh is there from the first generation on.
    let id = {
        let mut command = command(folder, &["decode", "c.toml", "--string", "", "--format", "json"]);
        let told: serde_json::Value = serde_json::from_slice(&command.output().unwrap().stdout).unwrap();
        told["code_placed_reduced"].as_str().unwrap()[..6].to_owned()
    };
    let (code, stdout, stderr) = quadrille(folder, &["export", "r", "--design", &id, "--format", "obj"]);
    assert_eq!(code, Some(0), "{stderr}");
    assert!(stdout.contains("\nv ") && stderr.contains(&expected), "{stderr}");
    let (code, stdout, stderr) = quadrille(folder, &["explain", "r", &id]);
    assert_eq!(code, Some(0), "{stderr}");
    assert!(stdout.contains("limits of the pattern") && stderr.contains(&expected), "{stderr}");
}

#[test]
fn before_the_first_generation_there_is_nothing_to_look_at() {
    let folder = project();
    let child = begin(folder.path(), &["--set", "search.population=5000"], 0);
    while !folder.path().join("r/manifest.json").exists() {
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    signal(&child, "KILL");
    child.wait_with_output().unwrap();
    let (code, _, stderr) = quadrille(folder.path(), &["report", "r"]);
    assert!(code == Some(2) && stderr.contains("has not finished a generation yet"), "{stderr}");
    let (code, _, stderr) = quadrille(folder.path(), &["verify", "r"]);
    assert!(code == Some(2) && stderr.contains("--resume"), "{stderr}");
}
