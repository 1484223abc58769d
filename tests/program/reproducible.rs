//! docs/reference/files.md §6: the run that continuous integration repeats.
//!
//! `results/ci/*.csv` was written by `cargo run --release -- run configs/ci.toml --out results/ci --force`. The same
//! program, CPU and seed give the same bytes for any number of threads; other CPUs the same strings and numbers to 1e-6.

use assert_cmd::Command;
use std::fs;
use std::path::{Path, PathBuf};

const TABLES: [&str; 3] = ["pareto.csv", "history.csv", "generations.csv"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn run_ci(folder: &Path, threads: &str) {
    Command::cargo_bin("quadrille")
        .unwrap()
        .args(["run", "configs/ci.toml", "--quiet", "--threads", threads, "--out"])
        .arg(folder)
        .current_dir(root())
        .assert()
        .success();
}

fn rows(file: PathBuf) -> Vec<Vec<String>> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_path(&file).unwrap();
    reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect()
}

/// Equal as text, or both numbers within 1e-6 relative.
fn agree(a: &str, b: &str) -> bool {
    a == b
        || matches!((a.parse::<f64>(), b.parse::<f64>()),
            (Ok(a), Ok(b)) if (a - b).abs() <= 1e-6 * a.abs().max(b.abs()).max(1e-9))
}

#[test]
fn any_number_of_threads_gives_the_same_bytes_and_the_committed_front() {
    let folders = ["1", "2", "3", "8"].map(|threads| {
        let folder = tempfile::tempdir().unwrap();
        run_ci(folder.path(), threads);
        folder
    });
    for table in TABLES {
        let [one, others @ ..] =
            folders.each_ref().map(|folder| fs::read(folder.path().join(table)).unwrap());
        assert!(others.iter().all(|other| *other == one), "{table} depends on the number of threads");
    }
    for table in ["pareto.csv", "generations.csv"] {
        let [now, committed] =
            [folders[0].path().join(table), root().join("results/ci").join(table)].map(rows);
        assert_eq!(now.len(), committed.len(), "{table}: other number of rows");
        assert!(now.len() > 3, "{table} is nearly empty: nothing is compared");
        for (line, (now, committed)) in now.iter().zip(&committed).enumerate() {
            assert_eq!(now.len(), committed.len(), "{table} line {}", line + 1);
            for (cell, (a, b)) in now.iter().zip(committed).enumerate() {
                assert!(agree(a, b), "{table} line {} cell {}: {a} now, {b} committed", line + 1, cell + 1);
            }
        }
    }
}
