//! `quadrille run`: evolve, and write the front and all else.

use super::config_args::ConfigArgs;
use super::folder_args::refuse_file;
use super::progress::{Display, duration};
use super::quote::quote;
use super::{CliError, Console, exit};
use quadrille::config::{Config, to_toml};
use quadrille::output::folder::{Folder, FolderError, Opening, REPORT};
use quadrille::output::number::significant;
use quadrille::output::obstacles::Obstacles;
use quadrille::output::report;
use quadrille::output::results::{self, Run, Sitting};
use quadrille::output::table::Dialect;
use quadrille::random;
use quadrille::search::{self, Ended, Outcome, Settings, StopFlag, Store, ThreadServer};
use quadrille::study::Study;
use std::io::ErrorKind;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{Instant, SystemTime};

/// Evolve designs and write the Pareto front, all evaluated designs, meshes, pictures and a report.
///
/// The search is NSGA-II on strings of the grammar. Results go to `results/<name of the config>/` below the current
/// folder, or to --out. The same config and seed give the same results, with any number of threads. Ctrl-C (or
/// SIGTERM) ends the run after the evaluations in flight; `--resume` goes on from there with the same result. A
/// second Ctrl-C aborts at once.
///
/// The folder then holds pareto.csv (the front), history.csv (every evaluated design, and why it failed),
/// generations.csv (convergence), operators.csv, report.html (open it in a browser), designs/ (each design of the front
/// as OBJ, COMPAS JSON, SVG, VTU, and CSV of nodes and members), design_explorer/data.csv and manifest.json. A folder that
/// holds a run, or something else under these names, is not overwritten without --force.
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    config: ConfigArgs,
    /// Folder for the results [default: results/<name>].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Seed of all chance; the same as `--set run.seed=N`.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    seed: Option<u64>,
    /// Threads, 0 = all cores; the same as `--set run.threads=N`.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    threads: Option<usize>,
    /// Generations after the first population; the same as `--set search.generations=N`.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    generations: Option<u32>,
    /// Go on with an interrupted run, or with a finished one whose limits were raised.
    #[arg(long, conflicts_with = "force")]
    resume: bool,
    /// Overwrite the results of an earlier run.
    #[arg(long)]
    force: bool,
    /// Write a copy of each table for other spreadsheets: `excel-eu` has a byte order mark, `;` and decimal commas.
    #[arg(long, value_enum, value_name = "DIALECT")]
    csv_dialect: Option<CsvDialect>,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum CsvDialect {
    /// Byte order mark, semicolons, decimal commas.
    ExcelEu,
}

/// Runs the search and writes the results folder.
pub fn run(args: Args, console: &Console) -> Result<ExitCode, CliError> {
    let mut config = args.config.load(&args.sets())?;
    let study = args.config.study(&config)?;
    // Before the folder is touched: a run without threads leaves it as it was.
    let server = ThreadServer::new(&study, config.run.threads)?;
    let folder = args.open_folder(&config)?;
    for warning in study.warnings() {
        console.warn(&warning);
    }
    fix_seed(&mut config, &folder, args.resume, console)?;
    let record =
        results::record(&config, args.config.folder()).map_err(|e| CliError::Input(e.to_string()))?;
    let mut store = open_store(&folder, record, args.resume)?;
    let (started, clock) = (SystemTime::now(), Instant::now());
    let (outcome, threads) = evolve(&study, server, &config, &mut store, console)?;
    let sitting = Sitting { started, seconds: clock.elapsed().as_secs_f64(), threads };
    let run = Run { study: &study, config: &config, config_folder: args.config.folder(), outcome: &outcome };
    let failed = |error: results::ResultsError| CliError::Failed(error.to_string());
    if let Ended::Interrupted(signal) = outcome.ended {
        run.write_interrupted(&folder, &sitting).map_err(failed)?;
        console.always(&format!("interrupted; go on with: {}", args.resume_command(&folder)));
        return Ok(ExitCode::from(exit::interrupted(signal)));
    }
    let dialect = args.csv_dialect.map_or(Dialect::Canonical, |CsvDialect::ExcelEu| Dialect::ExcelEu);
    console.note(&match outcome.front.len() {
        0 => "writing the designs that came nearest".to_owned(),
        count => format!("writing {count} designs of the front"),
    });
    run.write(&folder, &sitting, dialect).map_err(failed)?;
    drop(store);
    summarise(&study, &outcome, &folder, clock, console);
    let code = if outcome.front.is_empty() { exit::NOTHING_FEASIBLE } else { exit::DONE };
    // The report is made from the folder: no need to hold every design twice.
    drop(outcome);
    write_report(&folder)?;
    Ok(ExitCode::from(code))
}

impl Args {
    /// The arguments that stand for keys of the config.
    fn sets(&self) -> Vec<String> {
        let pairs = [
            self.seed.map(|seed| format!("run.seed={seed}")),
            self.threads.map(|threads| format!("run.threads={threads}")),
            self.generations.map(|generations| format!("search.generations={generations}")),
        ];
        pairs.into_iter().flatten().collect()
    }

    /// The results folder, locked.
    fn open_folder(&self, config: &Config) -> Result<Folder, CliError> {
        let name = config.run.name.as_deref().unwrap_or("run");
        let path = self.out.clone().unwrap_or_else(|| PathBuf::from("results").join(name));
        let opening = match (self.resume, self.force) {
            (true, _) => Opening::Resume,
            (_, true) => Opening::Overwrite,
            _ => Opening::New,
        };
        refuse_file(&path)?;
        Folder::open(&path, opening).map_err(|error| match error {
            FolderError::Io { ref source, .. } if source.kind() == ErrorKind::StorageFull => {
                CliError::Failed(error.to_string())
            }
            refused => CliError::Input(refused.to_string()),
        })
    }

    /// What a user types to go on.
    fn resume_command(&self, folder: &Folder) -> String {
        let mut words = vec!["quadrille run".to_owned(), quote(&self.config.config.to_string_lossy())];
        words.extend(self.config.set.iter().chain(&self.sets()).map(|set| format!("--set {}", quote(set))));
        if self.out.is_some() {
            words.push(format!("--out {}", quote(&folder.path().to_string_lossy())));
        }
        if self.csv_dialect.is_some() {
            words.push("--csv-dialect excel-eu".into());
        }
        words.push("--resume".into());
        words.join(" ")
    }
}

/// The seed of the config, else that of the run to be resumed, else one drawn and told.
fn fix_seed(config: &mut Config, folder: &Folder, resume: bool, console: &Console) -> Result<(), CliError> {
    if config.run.seed.is_some() {
        return Ok(());
    }
    let recorded = match resume {
        true => Store::recorded_config(folder.path()).map_err(|error| CliError::Input(error.to_string()))?,
        false => None,
    };
    let recorded = recorded.and_then(|config| config.get("run")?.get("seed")?.as_u64());
    let seed = recorded.unwrap_or_else(random::fresh_seed);
    console
        .note(&format!("seed {seed}{}", if recorded.is_some() { ", of the run resumed" } else { ", drawn" }));
    config.run.seed = Some(seed);
    Ok(())
}

fn open_store(folder: &Folder, record: serde_json::Value, resume: bool) -> Result<Store, CliError> {
    let opened =
        if resume { Store::resume(folder.path(), record) } else { Store::create(folder.path(), record) };
    opened.map_err(|error| match error {
        search::StoreError::Io { .. } => CliError::Failed(error.to_string()),
        refused => CliError::Input(refused.to_string()),
    })
}

/// Runs the search; gives the outcome and the number of threads.
fn evolve(
    study: &Study,
    server: ThreadServer<'_, Study>,
    config: &Config,
    store: &mut Store,
    console: &Console,
) -> Result<(Outcome, usize), CliError> {
    let failed = |error: &dyn std::fmt::Display| CliError::Failed(error.to_string());
    let settings = Settings {
        search: config.search.clone(),
        objectives: study.objectives.len(),
        ideal: config.objectives.ideal.clone(),
        reference: config.objectives.reference.clone(),
        seed: config.run.seed.unwrap_or_default(),
    };
    let stop = StopFlag::new();
    stop.install().map_err(|error| failed(&error))?;
    let threads = match config.run.threads {
        0 => std::thread::available_parallelism().map_or(1, usize::from),
        threads => threads,
    };
    console.note(&format!(
        "{}: population {}, {} generations, {threads} threads, minimising {}",
        config.run.name.as_deref().unwrap_or_default(),
        config.search.population,
        config.search.generations,
        config.objectives.minimise.join(", ")
    ));
    console.detail(&to_toml(config));
    let mut display = Display::new(config, study.baseline(), *console);
    let outcome = search::run(study, &server, &settings, &stop, Some(store), &mut display);
    display.finish();
    Ok((outcome.map_err(|error| failed(&error))?, threads))
}

fn write_report(folder: &Folder) -> Result<(), CliError> {
    let failed = |error: &dyn std::fmt::Display| CliError::Failed(error.to_string());
    let data = report::read(folder.path()).map_err(|error| failed(&error))?;
    let page = report::render(&data).map_err(|error| failed(&error))?;
    folder.write(REPORT, page.as_bytes()).map_err(|error| failed(&error))
}

/// What was found, on stdout: the folder, and the best of each objective.
fn summarise(study: &Study, outcome: &Outcome, folder: &Folder, clock: Instant, console: &Console) {
    let feasible = outcome.evaluated.iter().filter(|row| row.is_feasible()).count();
    console.note(&format!(
        "{} designs evaluated, {feasible} feasible, in {}",
        outcome.evaluated.len(),
        duration(clock.elapsed().as_secs_f64())
    ));
    outln!("{}: {} designs on the front", folder.path().display(), outcome.front.len());
    for (i, objective) in study.objectives.iter().enumerate() {
        let values = outcome.front.iter().map(|&row| outcome.evaluated[row].objectives[i]);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        if low.is_finite() {
            outln!("  {:<24} {:>12} to {:>12}", objective.column, significant(low), significant(high));
        }
    }
    if outcome.front.is_empty() {
        console.always(&Obstacles::of(&outcome.evaluated).none_feasible());
    }
    let page = quote(&folder.join(REPORT).to_string_lossy());
    let folder = quote(&folder.path().to_string_lossy());
    console.note(&format!(
        "open {page} in a browser; `quadrille explain {folder} ID` says what governs a design"
    ));
}
