//! `quadrille evaluate`: the designer's mode (paper, Figure 24).

use super::compare::{Comparison, Save};
use super::config_args::ConfigArgs;
use super::deviations::Deviations;
use super::folder_args::refuse_file;
use super::topology::parse_string;
use super::{CliError, Console};
use quadrille::files::atomic;
use quadrille::files::names::{CHECKPOINT, DESIGNS, EVALUATION, JOURNAL, JOURNAL_BEFORE, MANIFEST};
use quadrille::grammar::Tokens;
use quadrille::io::table;
use quadrille::io::text::decode;
use quadrille::output::results::DesignFiles;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Decode and evaluate given strings: a table of all metrics, absolute and normalised by the largest.
///
/// Every number is computed even where a limit is exceeded. Designs that no other of these dominates are marked with
/// `*`. Where there is no surface, the distances between the forms follow. With --out, tables (evaluation.csv,
/// normalised.csv, deviations.csv) and the files of every design that has a pattern are written too, mesh and picture
/// also where the structure gives no answer or the pattern is folded: the table says in words what is wrong with it.
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    config: ConfigArgs,
    /// A string, such as ATTA; may be given several times.
    #[arg(long, value_name = "S")]
    string: Vec<String>,
    /// A CSV file (fields separated by commas, semicolons or tabs) with a column `string` and, if wanted, a column `name`.
    #[arg(long, value_name = "FILE.csv")]
    strings: Option<PathBuf>,
    /// Write tables, meshes and pictures into this folder.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Evaluates and compares.
pub fn run(args: Args, console: &Console) -> Result<ExitCode, CliError> {
    let resolved = args.config.load(&[])?;
    let mut named: Vec<(String, Tokens)> = Vec::new();
    for text in &args.string {
        named.push((text.clone(), parse_string("--string", text)?));
    }
    if let Some(file) = &args.strings {
        named.extend(read_strings(file)?);
    } else if named.is_empty() {
        return Err(CliError::Input("no string to evaluate; give --string S or --strings FILE.csv".into()));
    }
    if let Some(folder) = &args.out {
        refuse_file(folder)?;
        refuse_results(folder)?;
    }
    let study = args.config.study(&resolved)?;
    let save = args.out.as_deref().map(Designs::below).transpose()?;
    let save = save.as_ref().map(|designs| |files: DesignFiles| designs.save(&files));
    let comparison = Comparison::of(
        &study,
        named,
        resolved.config().run.threads,
        save.as_ref().map(|save| save as &Save<'_>),
    )?;
    out!("{}", comparison.to_text());
    let deviations = Deviations::of(&comparison);
    if let Some(deviations) = &deviations {
        out!("{}", deviations.to_text());
    }
    if let Some(folder) = &args.out {
        write(folder, &comparison, deviations.as_ref())?;
        for entry in comparison.entries.iter().filter(|entry| !entry.has_pattern) {
            console.warn(&format!("no files for {}: {}", entry.name, entry.evaluation.reason));
        }
    }
    Ok(ExitCode::SUCCESS)
}

fn read_strings(file: &Path) -> Result<Vec<(String, Tokens)>, CliError> {
    let wrong = |message: String| CliError::Input(format!("{}: {message}", file.display()));
    let bytes = std::fs::read(file).map_err(CliError::read(file))?;
    let text = decode(&bytes).map_err(|(line, reason)| wrong(format!("line {line}: {reason}")))?;
    let (delimiter, has_hint) = table::delimiter(text.as_bytes());
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter)
        .flexible(true)
        .has_headers(false)
        .from_reader(text.as_bytes());
    let mut records = reader.records().skip(usize::from(has_hint));
    let header = records.next().transpose().map_err(|error| wrong(error.to_string()))?.unwrap_or_default();
    let column = |name: &str| header.iter().position(|heading| heading.trim().eq_ignore_ascii_case(name));
    let strings = column("string").ok_or_else(|| match header.iter().collect::<Vec<_>>().join(", ") {
        found if found.is_empty() => {
            wrong("the file is empty; its first line must name a column `string`".into())
        }
        found => wrong(format!("line {}: no column `string`; found {found}", 1 + usize::from(has_hint))),
    })?;
    let mut named = Vec::new();
    for record in records {
        let record = record.map_err(|error| wrong(error.to_string()))?;
        // What spreadsheets leave below a table.
        if record.len() > 1 && record.iter().all(|cell| cell.trim().is_empty()) {
            continue;
        }
        let line = record.position().map_or(0, csv::Position::line);
        let text = record.get(strings).unwrap_or_default().trim();
        let name =
            column("name").and_then(|index| record.get(index)).map(str::trim).filter(|name| !name.is_empty());
        let tokens = parse_string(&format!("{}:{line}:", file.display()), text)?;
        named.push((name.unwrap_or(text).to_owned(), tokens));
    }
    match named.is_empty() {
        true => Err(wrong("no strings below the header".into())),
        false => Ok(named),
    }
}

/// A run's folder holds what the run found, and nothing else; a table of that name that somebody else wrote is theirs.
fn refuse_results(folder: &Path) -> Result<(), CliError> {
    let table = folder.join(EVALUATION);
    if std::fs::read(&table).is_ok_and(|bytes| !bytes.starts_with(b"name,string,")) {
        return Err(CliError::Input(format!(
            "--out {}: its {EVALUATION} was not written by `evaluate`; give another folder",
            folder.display()
        )));
    }
    match [MANIFEST, CHECKPOINT, JOURNAL, JOURNAL_BEFORE].iter().find(|name| folder.join(name).exists()) {
        None => Ok(()),
        Some(name) => Err(CliError::Input(format!(
            "--out {}: the results folder of a run (it has {name}); give another folder",
            folder.display()
        ))),
    }
}

/// The folder that the files of designs go to.
struct Designs(PathBuf);

impl Designs {
    /// Makes it, before anything is evaluated for it.
    fn below(folder: &Path) -> Result<Self, CliError> {
        let designs = folder.join(DESIGNS);
        std::fs::create_dir_all(&designs).map_err(CliError::write(&designs))?;
        Ok(Self(designs))
    }

    fn save(&self, files: &DesignFiles) -> Result<(), CliError> {
        files.iter().try_for_each(|(name, bytes)| save(self.0.join(name), bytes))
    }
}

fn save(path: PathBuf, bytes: &[u8]) -> Result<(), CliError> {
    atomic::write_named(&path, bytes).map_err(CliError::write(&path))
}

/// Writes the tables.
fn write(folder: &Path, comparison: &Comparison, deviations: Option<&Deviations>) -> Result<(), CliError> {
    save(folder.join(EVALUATION), &comparison.table().to_csv())?;
    save(folder.join("normalised.csv"), &comparison.normalised().to_csv())?;
    match deviations {
        Some(deviations) => save(folder.join("deviations.csv"), &deviations.table(comparison).to_csv()),
        None => Ok(()),
    }
}
