//! A results folder read back: what `report`, `export`, `verify` and `explain` start from.

use super::designs::{Columns, FIRST, LAST};
use super::folder::{GENERATIONS, HISTORY, MANIFEST, PARETO};
use super::manifest::Manifest;
use crate::config::Config;
use crate::evolve::Violation;
use crate::mesh::canonical::Code;
use crate::search::{Breeding, EvaluatedRow, GenerationRow};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Why a results folder cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// A file is missing or cannot be read.
    #[error("{}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A file is not what the program writes.
    #[error("{}: {message}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// Where and what.
        message: String,
    },
}

/// A run as its folder tells it.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// What was run.
    pub manifest: Manifest,
    /// The config as resolved.
    pub config: Config,
    /// The folder to which paths in it are relative.
    pub config_folder: PathBuf,
    /// Every evaluated design, as in `history.csv`. Codes have their first 64 bits only.
    pub evaluated: Vec<EvaluatedRow>,
    /// The front in the order of `pareto.csv`, as places in `evaluated`.
    pub front: Vec<usize>,
    /// Every generation, as in `generations.csv`.
    pub generations: Vec<GenerationRow>,
}

/// Reads a results folder.
///
/// # Errors
/// [`LoadError`] with file and line.
pub fn load(folder: &Path) -> Result<Loaded, LoadError> {
    let path = folder.join(MANIFEST);
    let wrong = |message: String| LoadError::Format { path: path.clone(), message };
    let manifest: Manifest =
        serde_json::from_slice(&read(&path)?).map_err(|error| wrong(error.to_string()))?;
    let config: Config =
        toml::from_str(&manifest.config).map_err(|error| wrong(format!("config: {}", error.message())))?;
    let columns = Columns::of(&config.objectives.minimise);
    let evaluated = rows(&Sheet::read(folder, HISTORY)?, &columns)?;
    let places: BTreeMap<Code, usize> = evaluated.iter().enumerate().map(|(i, row)| (row.code, i)).collect();
    let sheet = Sheet::read(folder, PARETO)?;
    let front = rows(&sheet, &columns)?;
    let place = |(line, row): (usize, &EvaluatedRow)| {
        let missing = || sheet.wrong(line, format!("{} is not in {HISTORY}", row.code));
        places.get(&row.code).copied().ok_or_else(missing)
    };
    let front = front.iter().enumerate().map(place).collect::<Result<_, _>>()?;
    let generations = generations(&Sheet::read(folder, GENERATIONS)?, &columns)?;
    let config_folder = PathBuf::from(&manifest.config_folder);
    Ok(Loaded { manifest, config, config_folder, evaluated, front, generations })
}

pub(super) fn read(path: &Path) -> Result<Vec<u8>, LoadError> {
    std::fs::read(path).map_err(|source| LoadError::Read { path: path.to_path_buf(), source })
}

/// A CSV file by column names.
pub(super) struct Sheet {
    path: PathBuf,
    columns: BTreeMap<String, usize>,
    lines: Vec<csv::StringRecord>,
}

impl Sheet {
    pub(super) fn read(folder: &Path, name: &str) -> Result<Self, LoadError> {
        let path = folder.join(name);
        let bytes = read(&path)?;
        let wrong = |error: csv::Error| LoadError::Format { path: path.clone(), message: error.to_string() };
        let mut reader = csv::Reader::from_reader(bytes.as_slice());
        let header = reader.headers().map_err(wrong)?.clone();
        let columns = header.iter().enumerate().map(|(i, name)| (name.to_owned(), i)).collect();
        let lines = reader.records().collect::<Result<_, _>>().map_err(wrong)?;
        Ok(Self { path, columns, lines })
    }

    /// Number of records below the header.
    pub(super) fn len(&self) -> usize {
        self.lines.len()
    }

    /// An error in a record, counted from 0 below the header.
    fn wrong(&self, record: usize, message: String) -> LoadError {
        LoadError::Format { path: self.path.clone(), message: format!("line {}: {message}", record + 2) }
    }

    fn text(&self, record: usize, column: &str) -> Result<&str, LoadError> {
        let missing = || self.wrong(record, format!("column {column} is missing"));
        let index = self.columns.get(column).ok_or_else(missing)?;
        self.lines[record].get(*index).ok_or_else(missing)
    }

    pub(super) fn parse<T: std::str::FromStr>(&self, record: usize, column: &str) -> Result<T, LoadError> {
        let text = self.text(record, column)?;
        text.parse().map_err(|_| self.wrong(record, format!("{column}: found \"{text}\"")))
    }

    /// A number, or none for an empty cell or a column that is not there.
    pub(super) fn number(&self, record: usize, column: &str) -> Result<Option<f64>, LoadError> {
        if !self.columns.contains_key(column) || self.text(record, column)?.is_empty() {
            return Ok(None);
        }
        self.parse(record, column).map(Some)
    }

    fn numbers(&self, record: usize, columns: &[String]) -> Result<Vec<Option<f64>>, LoadError> {
        columns.iter().map(|column| self.number(record, column)).collect()
    }
}

fn rows(sheet: &Sheet, columns: &Columns) -> Result<Vec<EvaluatedRow>, LoadError> {
    (0..sheet.len()).map(|record| row(sheet, record, columns)).collect()
}

fn row(sheet: &Sheet, record: usize, columns: &Columns) -> Result<EvaluatedRow, LoadError> {
    let [_, string, expressed, code, generation, _] = FIRST;
    let [stage, measure, reason] = LAST;
    let digits = sheet.text(record, code)?;
    let bits = u64::from_str_radix(digits, 16)
        .map_err(|_| sheet.wrong(record, format!("code: found \"{digits}\"")))?;
    let objectives = sheet.numbers(record, &columns.objectives)?;
    let in_history = sheet.columns.contains_key(stage);
    let violation = match in_history {
        true => Violation::new(sheet.parse(record, stage)?, sheet.parse(record, measure)?),
        false => Violation::NONE,
    };
    Ok(EvaluatedRow {
        generation: sheet.parse(record, generation)?,
        slot: 0,
        tokens: sheet.parse(record, string)?,
        expressed: sheet.parse(record, expressed)?,
        code: Code(u128::from(bits) << 64),
        violation,
        reason: if in_history { sheet.text(record, reason)?.into() } else { "".into() },
        objectives: objectives.into_iter().collect::<Option<Vec<f64>>>().unwrap_or_default().into(),
        metrics: sheet.numbers(record, &columns.metrics)?.into_iter().collect(),
        structural: false,
    })
}

fn generations(sheet: &Sheet, columns: &Columns) -> Result<Vec<GenerationRow>, LoadError> {
    let named =
        |prefix: &str| columns.objectives.iter().map(|name| format!("{prefix}_{name}")).collect::<Vec<_>>();
    let (best, mean) = (named("best"), named("mean"));
    let all = |record: usize, columns: &[String]| -> Result<Vec<f64>, LoadError> {
        Ok(sheet.numbers(record, columns)?.into_iter().collect::<Option<_>>().unwrap_or_default())
    };
    (0..sheet.len())
        .map(|record| {
            Ok(GenerationRow {
                generation: sheet.parse(record, "generation")?,
                evaluations: sheet.parse(record, "evaluations")?,
                structural: sheet.parse(record, "structural_evaluations")?,
                feasible: sheet.parse(record, "feasible")?,
                front: sheet.parse(record, "front_size")?,
                hypervolume: sheet.number(record, "hypervolume")?,
                breeding: Breeding {
                    bred: sheet.parse(record, "bred")?,
                    duplicates: sheet.parse(record, "duplicates_refused")?,
                    neighbours: sheet.parse(record, "neighbours_refused")?,
                    rejected: sheet.parse(record, "rejected_by_topology")?,
                    cached: sheet.parse(record, "cached")?,
                    immigrants: sheet.parse(record, "immigrants")?,
                    empty: sheet.parse(record, "empty_slots")?,
                    operators: Vec::new(),
                },
                best: all(record, &best)?,
                mean: all(record, &mean)?,
            })
        })
        .collect()
}
