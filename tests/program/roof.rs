//! A project in a folder of its own, with inputs as files: an outline and a mesh surface. And the program run on it.
#![allow(dead_code, clippy::unwrap_used, reason = "each test uses a part; a test that cannot go on fails")]

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

use tempfile::TempDir;

pub const PROGRAM: &str = env!("CARGO_BIN_EXE_quadrille");
pub const TABLES: [&str; 3] = ["pareto.csv", "history.csv", "generations.csv"];

/// `c.toml`, `in/outline.obj` and `in/roof.obj`: `configs/ci.toml` on files.
pub fn project() -> TempDir {
    let folder = TempDir::new().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("in")).unwrap();
    fs::write(path("in/outline.obj"), "v -10 -10 0\nv 10 -10 0\nv 10 10 0\nv -10 10 0\nl 1 2 3 4 1\n")
        .unwrap();
    fs::write(path("in/roof.obj"), roof(4.0)).unwrap();
    let ci = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/ci.toml")).unwrap();
    let (before, rest) = ci.split_once("[[domain.loop]]").unwrap();
    let after = rest.split_once("[topology]").unwrap().1;
    let text = format!(
        "{before}[[domain.loop]]\nkind = \"obj\"\nfile = \"in/outline.obj\"\n\n\
         [surface]\nkind = \"mesh\"\nfile = \"in/roof.obj\"\n\n[topology]{after}"
    );
    fs::write(path("c.toml"), text).unwrap();
    folder
}

/// A paraboloid of quads, so many metres high.
pub fn roof(rise: f64) -> String {
    let mut obj = String::new();
    for j in 0..=12 {
        for i in 0..=12 {
            let (x, y) = (f64::from(2 * i - 12), f64::from(2 * j - 12));
            writeln!(obj, "v {x} {y} {}", rise * (1.0 - (x * x + y * y) / 200.0)).unwrap();
        }
    }
    for j in 0..12 {
        for i in 0..12 {
            let v = 13 * j + i + 1;
            writeln!(obj, "f {v} {} {} {}", v + 1, v + 14, v + 13).unwrap();
        }
    }
    obj
}

/// The program in a folder.
pub fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(PROGRAM);
    command.current_dir(folder).args(arguments).stdin(Stdio::null());
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Exit code, stdout and stderr.
pub fn quadrille(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    told(command(folder, arguments).output().unwrap())
}

pub fn told(output: Output) -> (Option<i32>, String, String) {
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// Begins a run into `r` and waits until so many generations are finished.
pub fn begin(folder: &Path, more: &[&str], generations: usize) -> Child {
    let arguments = [&["run", "c.toml", "--out", "r", "--quiet"], more].concat();
    let mut child = command(folder, &arguments).spawn().unwrap();
    while finished(&folder.join("r")) < generations {
        assert!(child.try_wait().unwrap().is_none(), "it ended before {generations} generations");
        sleep(Duration::from_millis(2));
    }
    child
}

/// Finished generations by the checkpoint.
pub fn finished(folder: &Path) -> usize {
    let text = fs::read_to_string(folder.join("checkpoint.json")).unwrap_or_default();
    text.matches("\"hypervolume\":").count()
}

pub fn signal(child: &Child, name: &str) {
    assert!(Command::new("kill").args(["-s", name, &child.id().to_string()]).status().unwrap().success());
}

pub fn manifest(folder: &Path) -> serde_json::Value {
    serde_json::from_slice(&fs::read(folder.join("manifest.json")).unwrap()).unwrap()
}

pub fn tables(folder: &Path) -> Vec<Vec<u8>> {
    TABLES.iter().map(|name| fs::read(folder.join(name)).unwrap()).collect()
}

/// Everything below a folder: what each file holds and when it was last changed, and when each folder was.
pub fn everything(folder: &Path) -> BTreeMap<PathBuf, (Vec<u8>, std::time::SystemTime)> {
    let mut found = BTreeMap::new();
    let modified = |path: &Path| fs::metadata(path).unwrap().modified().unwrap();
    found.insert(folder.to_path_buf(), (Vec::new(), modified(folder)));
    for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        match path.is_dir() {
            true => found.extend(everything(&path)),
            false => _ = found.insert(path.clone(), (fs::read(&path).unwrap(), modified(&path))),
        }
    }
    found
}
