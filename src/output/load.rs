//! A results folder read back: what `report`, `export`, `verify` and `explain` start from.

use super::designs::{Columns, FIRST, LAST, Naming, digits, id};
use super::manifest::{Counts, Manifest, Status};
use crate::config::{self, Config};
use crate::evolve::Violation;
use crate::files::names::{self, CHECKPOINT, EVALUATION, GENERATIONS, HISTORY, MANIFEST, PARETO};
use crate::io::table;
use crate::mesh::Symmetries;
use crate::mesh::canonical::Code;
use crate::objectives::{GOVERNING, METRICS};
use crate::search::{Breeding, EvaluatedRow, GenerationRow, Snapshot};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};

/// Why a results folder cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// The folder is not that of a run.
    #[error("{}: not the results folder of a run: it has no {MANIFEST}; {}", folder.display(), cure(folder))]
    NotARun {
        /// The folder.
        folder: PathBuf,
    },
    /// The run has not written its tables yet.
    #[error("{}: the run there is not finished, and its tables are not written: end it with `quadrille run CONFIG --resume`", folder.display())]
    Unfinished {
        /// The folder.
        folder: PathBuf,
    },
    /// The run has nothing to show yet.
    #[error("{}: the run there has not finished a generation yet; look again later", folder.display())]
    Nothing {
        /// The folder.
        folder: PathBuf,
    },
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
    /// Every evaluated design, as in `history.csv`. Codes have their first 64 bits only.
    pub evaluated: Vec<EvaluatedRow>,
    /// The front in the order of `pareto.csv`, as places in `evaluated`.
    pub front: Vec<usize>,
    /// Every generation, as in `generations.csv`.
    pub generations: Vec<GenerationRow>,
    /// Whether the run goes on or was interrupted: then all this is what it had found after its last finished generation.
    pub is_unfinished: bool,
    /// How the tables and the names of the files in `designs/` write ids.
    pub naming: Naming,
    /// Columns of metrics and combinations that `history.csv` does not have: an older version wrote it.
    pub lacking: Vec<&'static str>,
}

/// Reads a results folder: a finished run from its tables, any other as it stood after its last finished generation.
///
/// # Errors
/// [`LoadError`] with file and line.
pub fn look(folder: &Path) -> Result<Loaded, LoadError> {
    let (mut manifest, config) = head(folder)?;
    if manifest.status == Status::Finished {
        return tables(folder, manifest, config);
    }
    let read = Snapshot::read(folder)
        .map_err(|error| LoadError::Format { path: names::journal(folder), message: error.to_string() })?;
    let Some(Snapshot { evaluated, generations, front, breeding }) = read else {
        return Err(LoadError::Nothing { folder: folder.to_path_buf() });
    };
    manifest.counts = Counts::of(&generations, &breeding, evaluated.len(), front.len());
    Ok(Loaded {
        manifest,
        config,
        evaluated,
        front,
        generations,
        is_unfinished: true,
        naming: Naming::Lettered,
        lacking: Vec::new(),
    })
}

/// Reads the tables of a results folder.
///
/// # Errors
/// [`LoadError`] with file and line.
pub fn load(folder: &Path) -> Result<Loaded, LoadError> {
    let (manifest, config) = head(folder)?;
    match manifest.status {
        Status::Running => Err(LoadError::Unfinished { folder: folder.to_path_buf() }),
        Status::Interrupted | Status::Finished => tables(folder, manifest, config),
    }
}

/// What was run.
fn head(folder: &Path) -> Result<(Manifest, Config), LoadError> {
    let path = folder.join(MANIFEST);
    if !path.exists() {
        return Err(LoadError::NotARun { folder: folder.to_path_buf() });
    }
    let wrong = |message: String| LoadError::Format { path: path.clone(), message };
    let manifest = Manifest::parse(&read(&path)?).map_err(|error| wrong(error.to_string()))?;
    let config: Config =
        config::recorded(&manifest.config).map_err(|error| wrong(format!("config: {}", error.message())))?;
    Ok((manifest, config))
}

fn tables(folder: &Path, manifest: Manifest, config: Config) -> Result<Loaded, LoadError> {
    let columns = Columns::of(&config.objectives);
    let naming = Cell::new(Naming::Lettered);
    let evaluated = Sheet::each(folder, HISTORY, |record| {
        let row = row(record, &columns)?;
        naming.set(Naming::of(record.text("code")?));
        Ok(row)
    })?;
    let places: BTreeMap<Code, usize> = evaluated.iter().enumerate().map(|(i, row)| (row.code, i)).collect();
    let front = Sheet::each(folder, PARETO, |record| {
        let code = row(record, &columns)?.code;
        places.get(&code).copied().ok_or_else(|| record.wrong(format!("{} is not in {HISTORY}", id(code))))
    })?;
    let generations = Sheet::each(folder, GENERATIONS, |record| generation(record, &columns))?;
    let is_unfinished = manifest.status != Status::Finished;
    let header = Sheet::header(&folder.join(HISTORY))?;
    let columns = METRICS.iter().map(|metric| metric.column).chain(GOVERNING.map(|(column, _)| column));
    let lacking = columns.filter(|column| !header.iter().any(|name| name == column)).collect();
    let naming = naming.get();
    Ok(Loaded { manifest, config, evaluated, front, generations, is_unfinished, naming, lacking })
}

/// What a folder without a manifest is, and what to do.
fn cure(folder: &Path) -> &'static str {
    if folder.join(EVALUATION).exists() {
        "`evaluate` wrote it, and its designs are in designs/ already; to have them in a run's folder, give their \
         strings as search.seeds"
    } else if folder.join(CHECKPOINT).exists() || names::journal(folder).exists() {
        "the run there is unfinished: end it with `quadrille run CONFIG --resume`"
    } else {
        "give the folder that `run` wrote"
    }
}

pub(super) fn read(path: &Path) -> Result<Vec<u8>, LoadError> {
    std::fs::read(path).map_err(|source| LoadError::Read { path: path.to_path_buf(), source })
}

/// A CSV file by column names.
pub(super) struct Sheet {
    path: PathBuf,
    columns: BTreeMap<String, usize>,
    delimiter: u8,
}

impl Sheet {
    /// What `take` makes of each record below the header; the records themselves are not kept, since a history may be long.
    pub(super) fn each<T>(
        folder: &Path,
        name: &str,
        take: impl Fn(Record<'_>) -> Result<T, LoadError>,
    ) -> Result<Vec<T>, LoadError> {
        let path = folder.join(name);
        let wrong = |error: csv::Error| LoadError::Format { path: path.clone(), message: error.to_string() };
        let (mut reader, delimiter) = Self::open(&path)?;
        let header = reader.headers().map_err(wrong)?;
        let columns = header.iter().enumerate().map(|(i, name)| (name.to_owned(), i)).collect();
        let sheet = Self { path: path.clone(), columns, delimiter };
        let mut cells = csv::StringRecord::new();
        let mut taken = Vec::new();
        while reader.read_record(&mut cells).map_err(wrong)? {
            taken.push(take(Record { sheet: &sheet, cells: &cells, line: taken.len() + 2 })?);
        }
        Ok(taken)
    }

    /// The names of a file's columns, in order.
    pub(super) fn header(path: &Path) -> Result<Vec<String>, LoadError> {
        let wrong =
            |error: csv::Error| LoadError::Format { path: path.to_path_buf(), message: error.to_string() };
        Ok(Self::open(path)?.0.headers().map_err(wrong)?.iter().map(str::to_owned).collect())
    }

    /// The file, and what stands between its cells: a spreadsheet may have saved it again.
    fn open(path: &Path) -> Result<(csv::Reader<BufReader<File>>, u8), LoadError> {
        let unread = |source| LoadError::Read { path: path.to_path_buf(), source };
        let mut file = BufReader::new(File::open(path).map_err(unread)?);
        let (delimiter, has_hint) = table::delimiter(file.fill_buf().map_err(unread)?);
        if has_hint {
            file.skip_until(b'\n').map_err(unread)?;
        }
        Ok((csv::ReaderBuilder::new().delimiter(delimiter).from_reader(file), delimiter))
    }
}

/// One line of a sheet.
#[derive(Clone, Copy)]
pub(super) struct Record<'a> {
    sheet: &'a Sheet,
    cells: &'a csv::StringRecord,
    /// Counted from 1, the header's.
    line: usize,
}

impl<'a> Record<'a> {
    /// Its number, that of the header being 1.
    pub(super) fn line(&self) -> usize {
        self.line
    }

    pub(super) fn wrong(&self, message: String) -> LoadError {
        LoadError::Format { path: self.sheet.path.clone(), message: format!("line {}: {message}", self.line) }
    }

    pub(super) fn has(&self, column: &str) -> bool {
        self.sheet.columns.contains_key(column)
    }

    pub(super) fn text(&self, column: &str) -> Result<&'a str, LoadError> {
        let missing = || self.wrong(format!("column {column} is missing"));
        let index = self.sheet.columns.get(column).ok_or_else(missing)?;
        self.cells.get(*index).ok_or_else(missing)
    }

    /// A cell as this program writes it, also where a spreadsheet wrote it.
    pub(super) fn plain(&self, column: &str) -> Result<String, LoadError> {
        Ok(table::plain(self.text(column)?, self.sheet.delimiter))
    }

    pub(super) fn parse<T: std::str::FromStr>(&self, column: &str) -> Result<T, LoadError> {
        let text = self.text(column)?;
        let parsed = text.parse().or_else(|_| table::plain(text, self.sheet.delimiter).parse());
        parsed.map_err(|_| self.wrong(format!("{column}: found \"{text}\"")))
    }

    /// A number, or none for an empty cell or a column that is not there.
    pub(super) fn number(&self, column: &str) -> Result<Option<f64>, LoadError> {
        if !self.sheet.columns.contains_key(column) || self.text(column)?.is_empty() {
            return Ok(None);
        }
        self.parse(column).map(Some)
    }

    /// The values of all objectives in these columns, as the search has them; none if one is missing.
    fn objectives(&self, columns: &Columns, named: &[String]) -> Result<Vec<f64>, LoadError> {
        let values: Option<Vec<f64>> = self.numbers(named)?.into_iter().collect();
        let values = values.unwrap_or_default().into_iter().enumerate();
        Ok(values.map(|(place, value)| columns.turned(place, value)).collect())
    }

    fn numbers(&self, columns: &[String]) -> Result<Vec<Option<f64>>, LoadError> {
        columns.iter().map(|column| self.number(column)).collect()
    }
}

/// The evaluation that a line of `history.csv` or `pareto.csv` tells.
pub(super) fn row(record: Record<'_>, columns: &Columns) -> Result<EvaluatedRow, LoadError> {
    let [_, string, expressed, code, symmetry, generation, _] = FIRST;
    let [stage, measure, reason] = LAST;
    let bits = u64::from_str_radix(digits(record.text(code)?), 16).map_err(|_| {
        record.wrong(format!(
            "code: found \"{}\"; allowed: q and 16 hex digits",
            record.text(code).unwrap_or_default()
        ))
    })?;
    let objectives = record.objectives(columns, &columns.objectives)?;
    let in_history = record.sheet.columns.contains_key(stage);
    let violation = match in_history {
        true => Violation::new(record.parse(stage)?, record.parse(measure)?),
        false => Violation::NONE,
    };
    Ok(EvaluatedRow {
        generation: record.parse(generation)?,
        slot: 0,
        tokens: record.parse(string)?,
        expressed: record.parse(expressed)?,
        code: Code(u128::from(bits) << 64),
        // Results of before have no such column.
        symmetries: match record.has(symmetry) {
            true => record.parse(symmetry)?,
            false => Symmetries::default(),
        },
        violation,
        reason: if in_history { record.text(reason)?.into() } else { "".into() },
        objectives: objectives.into(),
        metrics: record.numbers(&columns.metrics)?.into_iter().collect(),
        governing: governing(&record),
        structural: false,
    })
}

/// The combinations that govern; none where an older version wrote none.
fn governing(record: &Record<'_>) -> Box<[Box<str>]> {
    let named: Vec<Box<str>> =
        GOVERNING.iter().map(|(column, _)| record.text(column).unwrap_or_default().into()).collect();
    if named.iter().all(|name| name.is_empty()) { Box::default() } else { named.into() }
}

fn generation(record: Record<'_>, columns: &Columns) -> Result<GenerationRow, LoadError> {
    let all = |prefix: &str| -> Result<Vec<f64>, LoadError> {
        let named: Vec<String> = columns.objectives.iter().map(|name| format!("{prefix}_{name}")).collect();
        record.objectives(columns, &named)
    };
    Ok(GenerationRow {
        generation: record.parse("generation")?,
        evaluations: record.parse("evaluations")?,
        structural: record.parse("structural_evaluations")?,
        feasible: record.parse("feasible")?,
        front: record.parse("front_size")?,
        hypervolume: record.number("hypervolume")?,
        breeding: Breeding {
            bred: record.parse("bred")?,
            duplicates: record.parse("duplicates_refused")?,
            neighbours: record.parse("neighbours_refused")?,
            rejected: record.parse("rejected_by_topology")?,
            cached: record.parse("cached")?,
            immigrants: record.parse("immigrants")?,
            empty: record.parse("empty_slots")?,
            operators: Vec::new(),
        },
        best: all("best")?,
        mean: all("mean")?,
    })
}
