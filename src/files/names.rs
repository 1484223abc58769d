//! The names of what a results folder holds, and which of them are this program's.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Files of the front as a table.
pub const PARETO: &str = "pareto.csv";
/// Every evaluated design.
pub const HISTORY: &str = "history.csv";
/// One row per generation.
pub const GENERATIONS: &str = "generations.csv";
/// One row per generation and operator.
pub const OPERATORS: &str = "operators.csv";
/// What was run, with what, where and when.
pub const MANIFEST: &str = "manifest.json";
/// The designs that `evaluate` compares.
pub const EVALUATION: &str = "evaluation.csv";
/// State of an unfinished run.
pub const CHECKPOINT: &str = "checkpoint.json";
/// The one before.
pub const CHECKPOINT_PREVIOUS: &str = "checkpoint.previous.json";
/// The page to look at.
pub const REPORT: &str = "report.html";
/// Folder of the front's designs.
pub const DESIGNS: &str = "designs";
/// Folder for Design Explorer.
pub const DESIGN_EXPLORER: &str = "design_explorer";
/// Folder of the pictures that `explain` draws.
pub const EXPLAINED: &str = "explained";
/// Every evaluation of a run, as they come.
pub const JOURNAL: &str = "evaluations.journal";
/// Its name in runs of quadrille 0.1, which go on with it.
pub const JOURNAL_BEFORE: &str = "evaluations.jsonl";

/// The tables of a run.
pub const TABLES: [&str; 4] = [PARETO, HISTORY, GENERATIONS, OPERATORS];
/// Files that change while a run goes on, or whenever somebody asks for it: the program's own, whatever is in them.
pub const CHANGING: [&str; 5] = [MANIFEST, CHECKPOINT, CHECKPOINT_PREVIOUS, JOURNAL, REPORT];
/// Folders that hold nothing of the run's own but what its manifest lists.
pub const FOLDERS: [&str; 3] = [DESIGNS, DESIGN_EXPLORER, EXPLAINED];

/// The journal of a folder: a run that was begun under its old name keeps it.
pub fn journal(folder: &Path) -> PathBuf {
    let [path, before] = [JOURNAL, JOURNAL_BEFORE].map(|name| folder.join(name));
    // Tables of evaluations by other programs have that name too.
    if !path.exists() && is_journal(&before) { before } else { path }
}

/// The name of a table's copy for a spreadsheet with decimal commas: `pareto.csv` → `pareto.excel-eu.csv`.
pub fn excel_name(name: &str) -> String {
    format!("{}.excel-eu.csv", name.trim_end_matches(".csv"))
}

/// Whether a file is the journal of a run.
pub fn is_journal(path: &Path) -> bool {
    begins_with(path, "{\"journal\":")
}

/// Whether a file has `mark` near its beginning: other programs have files of the same names.
pub fn begins_with(path: &Path, mark: &str) -> bool {
    let mut start = Vec::new();
    let read = File::open(path).and_then(|file| file.take(128).read_to_end(&mut start));
    read.is_ok() && String::from_utf8_lossy(&start).contains(mark)
}
