//! Nothing of a user's is lost: other people's files in the folder of a run, their changes to ours, and refused runs.
#![cfg(unix)]

use crate::roof;
use crate::roof::{command, everything, manifest, project, quadrille, signal, tables, told};
use std::fs;
use std::path::Path;

const RUN: [&str; 4] = ["run", "c.toml", "--out", "r"];

fn run(folder: &Path, more: &[&str]) -> (Option<i32>, String, String) {
    quadrille(folder, &[&RUN, more].concat())
}

fn first_design(folder: &Path) -> String {
    let pareto = fs::read_to_string(folder.join("r/pareto.csv")).unwrap();
    pareto.lines().nth(1).unwrap().split(',').next().unwrap().to_owned()
}

#[test]
fn files_of_others_stay_and_changes_to_ours_are_kept() {
    let folder = project();
    let path = |name: &str| folder.path().join("r").join(name);
    assert_eq!(run(folder.path(), &["--generations", "2"]).0, Some(0));
    for name in ["designs/mine.3dm", "design_explorer/mine.js", "explained/mine.svg", "notes.txt", ".lock"] {
        fs::create_dir_all(path(name).parent().unwrap()).unwrap();
        fs::write(path(name), "mine").unwrap();
    }
    let mine = |when: &str| {
        for name in
            ["designs/mine.3dm", "design_explorer/mine.js", "explained/mine.svg", "notes.txt", ".lock"]
        {
            assert_eq!(fs::read_to_string(path(name)).unwrap_or_default(), "mine", "{name}, {when}");
        }
    };
    let edited = path(&format!("designs/{}.obj", first_design(folder.path())));
    let ours = fs::read(&edited).unwrap();
    fs::write(&edited, "by hand").unwrap();
    // Nothing is left to do; then something is; then all is begun anew.
    let (code, _, stderr) = run(folder.path(), &["--resume", "--generations", "2"]);
    assert_eq!(code, Some(0), "{stderr}");
    assert!(stderr.contains(".obj: was changed after the run wrote it; it is kept as "), "{stderr}");
    assert_eq!(fs::read_to_string(edited.with_extension("obj.bak")).unwrap(), "by hand");
    assert_eq!(fs::read(&edited).unwrap(), ours);
    mine("nothing to do");
    assert_eq!(run(folder.path(), &["--resume", "--generations", "4"]).0, Some(0));
    mine("resumed");
    let id = first_design(folder.path());
    assert_eq!(quadrille(folder.path(), &["explain", "r", &id]).0, Some(0));
    let picture = path(&format!("explained/{id}.svg"));
    assert!(picture.exists());
    fs::write(path("generations.csv"), "my own figures").unwrap();
    assert_eq!(run(folder.path(), &["--force", "--generations", "1"]).0, Some(0));
    mine("forced");
    assert!(!picture.exists(), "a picture of a run that is no more");
    assert_eq!(fs::read_to_string(path("generations.csv.bak")).unwrap(), "my own figures");
    // Of our own files those are left that the manifest lists, and no other.
    let manifest = manifest(&path(""));
    let listed = manifest["files"].as_object().unwrap();
    for file in everything(&path("")).into_keys().filter(|file| file.is_file()) {
        let name = file.strip_prefix(path("")).unwrap().to_string_lossy().into_owned();
        let theirs =
            name.contains("mine") || name.ends_with(".bak") || name.ends_with(".lock") || name == "notes.txt";
        assert_eq!(listed.contains_key(&name), !theirs, "{name}");
    }
}

#[test]
fn designs_that_left_the_front_are_removed() {
    let folder = project();
    assert_eq!(run(folder.path(), &["--generations", "0"]).0, Some(0));
    let before: Vec<_> = everything(&folder.path().join("r/designs")).into_keys().collect();
    assert_eq!(run(folder.path(), &["--resume", "--generations", "5"]).0, Some(0));
    let pareto = fs::read_to_string(folder.path().join("r/pareto.csv")).unwrap();
    let history = fs::read_to_string(folder.path().join("r/history.csv")).unwrap();
    let baseline = history.lines().find(|line| line.split(',').nth(1) == Some("\"\"")).unwrap();
    let ids: Vec<&str> =
        pareto.lines().skip(1).chain([baseline]).map(|l| l.split(',').next().unwrap()).collect();
    let after = everything(&folder.path().join("r/designs"));
    let names =
        after.keys().filter(|file| file.is_file()).map(|file| file.file_name().unwrap().to_string_lossy());
    for name in names {
        assert!(ids.iter().any(|id| name.starts_with(id)), "{name} is not of the front");
    }
    assert!(before.iter().any(|file| !file.exists()), "the front has not changed: this test shows nothing");
}

#[test]
fn a_refused_run_leaves_the_folder_as_it_was() {
    let folder = project();
    assert_eq!(run(folder.path(), &["--generations", "1"]).0, Some(0));
    fs::remove_file(folder.path().join("r/.quadrille.lock")).unwrap();
    fs::write(folder.path().join("r/.lock"), "of another program").unwrap();
    fs::create_dir(folder.path().join("empty")).unwrap();
    fs::create_dir(folder.path().join("locked")).unwrap();
    fs::write(folder.path().join("locked/.lock"), "of another program").unwrap();
    fs::create_dir(folder.path().join("occupied")).unwrap();
    fs::write(folder.path().join("occupied/designs"), "a file").unwrap();
    let before = everything(folder.path());
    for arguments in [
        &["--out", "r"][..],
        &["--out", "r", "--resume", "--seed", "5"],
        &["--out", "r", "--resume", "--set", "pattern.panels=100"],
        &["--out", "empty", "--resume"],
        &["--out", "locked", "--resume"],
        &["--out", "occupied"],
        &["--out", "occupied", "--force"],
        &["--out", "not/there", "--resume"],
        &["--out", "r", "--force", "--set", "surface.file=none.obj"],
    ] {
        let (code, _, stderr) = quadrille(folder.path(), &[&["run", "c.toml"], arguments].concat());
        assert_eq!(code, Some(2), "{arguments:?}: {stderr}");
        assert!(everything(folder.path()) == before, "{arguments:?} changed something: {stderr}");
    }
    let (code, _, stderr) =
        quadrille(folder.path(), &["run", "c.toml", "--out", "locked", "--generations", "0"]);
    assert_eq!(code, Some(0), "{stderr}");
}

#[test]
fn one_of_two_runs_is_refused_and_changes_nothing() {
    let folder = project();
    let mut first = roof::begin(folder.path(), &["--generations", "100000"], 1);
    signal(&first, "STOP");
    let before = everything(folder.path());
    for more in [&["--force"][..], &["--resume"], &[]] {
        let (code, _, stderr) = run(folder.path(), more);
        assert!(code == Some(2) && stderr.contains("in use by another run"), "{stderr}");
        assert!(everything(folder.path()) == before, "{more:?}");
    }
    first.kill().unwrap();
    first.wait().unwrap();
}

#[test]
fn copies_for_spreadsheets_are_never_stale() {
    let folder = project();
    let path = |name: &str| folder.path().join("r").join(name);
    let lines = |name: &str| fs::read_to_string(path(name)).unwrap().lines().count();
    assert_eq!(run(folder.path(), &["--generations", "1", "--csv-dialect", "excel-eu"]).0, Some(0));
    assert_eq!(run(folder.path(), &["--resume", "--generations", "3"]).0, Some(0));
    for name in ["pareto", "history", "generations", "operators"] {
        assert_eq!(lines(&format!("{name}.excel-eu.csv")), lines(&format!("{name}.csv")), "{name}");
    }
    // Also where the sitting is cut short.
    let child = roof::begin(folder.path(), &["--resume", "--generations", "100000"], 6);
    signal(&child, "TERM");
    assert_eq!(child.wait_with_output().unwrap().status.code(), Some(143));
    for name in ["pareto", "history", "generations", "operators"] {
        assert_eq!(lines(&format!("{name}.excel-eu.csv")), lines(&format!("{name}.csv")), "{name}");
    }
    assert_eq!(run(folder.path(), &["--force", "--generations", "1"]).0, Some(0));
    assert!(!path("pareto.excel-eu.csv").exists());
}

#[test]
fn writing_designs_is_told() {
    let folder = project();
    let (_, _, stderr) = run(folder.path(), &["--generations", "1", "-v", "--progress", "plain"]);
    let last = stderr.lines().rfind(|line| line.starts_with("writing designs: ")).unwrap();
    let numbers: Vec<&str> = last["writing designs: ".len()..].split(" of ").collect();
    assert_eq!(numbers[0], numbers[1], "{last}");
}

/// Where locks are not to be had and folders cannot be synced: a C library that refuses both, put before the system's.
#[test]
#[cfg(target_os = "linux")]
fn a_file_system_without_locks_is_warned_of() {
    let folder = project();
    let source = "#define _GNU_SOURCE\n#include <errno.h>\n#include <sys/stat.h>\n#include <sys/syscall.h>\n#include <unistd.h>\n\
        int flock(int fd, int how) { errno = ENOTSUP; return -1; }\n\
        int fsync(int fd) {\n  struct stat s;\n  if (fstat(fd, &s) == 0 && S_ISDIR(s.st_mode)) { errno = EINVAL; return -1; }\n\
          return syscall(SYS_fsync, fd);\n}\n";
    fs::write(folder.path().join("no.c"), source).unwrap();
    let built = std::process::Command::new("cc")
        .args(["-shared", "-fPIC", "-o", "no.so", "no.c"])
        .current_dir(folder.path())
        .output();
    if !built.is_ok_and(|output| output.status.success()) {
        eprintln!("NOT TESTED: no C compiler here");
        return;
    }
    let mut command = command(folder.path(), &[&RUN[..], &["--generations", "0"]].concat());
    command.env("LD_PRELOAD", folder.path().join("no.so"));
    let (code, _, stderr) = told(command.output().unwrap());
    assert_eq!(code, Some(0), "{stderr}");
    assert!(stderr.contains("warning: r cannot be locked ("), "{stderr}");
    assert_eq!(tables(&folder.path().join("r")).len(), 3);
}
