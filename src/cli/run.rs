//! `quadrille run`: evolve, and write the front and all else.

use super::config_args::ConfigArgs;
use super::folder_args::refuse_file;
use super::progress::{Display, duration};
use super::quote::quote;
use super::watch::Watch;
use super::writing::WritingDisplay;
use super::{CliError, Console, exit, signals};
use quadrille::config::{Config, ResolvedConfig, to_toml};
use quadrille::files::names::{PARETO, REPORT, excel_name};
use quadrille::output::folder::{Folder, FolderError, Opening};
use quadrille::output::manifest::Status;
use quadrille::output::number::significant;
use quadrille::output::obstacles::Obstacles;
use quadrille::output::report;
use quadrille::output::results::{self, Run};
use quadrille::output::sitting::Sitting;
use quadrille::output::table::Dialect;
use quadrille::random;
use quadrille::search::{self, Ended, Outcome, Settings, StopFlag, Store, ThreadServer};
use quadrille::study::Study;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Evolve designs and write the Pareto front, all evaluated designs, meshes, pictures and a report.
///
/// The search is NSGA-II on strings of the grammar. Results go to `results/<name of the config>/` below the current
/// folder, or to --out. The same config and seed give the same results, with any number of threads. Ctrl-C (or
/// SIGTERM, SIGHUP) ends the run after the evaluations in flight; `--resume` goes on from there with the same result. A
/// second one aborts at once, if it comes more than a second later.
///
/// The folder then holds pareto.csv (the front), history.csv (every evaluated design, and why it failed),
/// generations.csv (convergence), operators.csv, report.html (open it in a browser), designs/ (each design of the front
/// as OBJ, COMPAS JSON, SVG, VTU, and CSV of nodes and members), design_explorer/data.csv and manifest.json. A folder that
/// holds a run, or something else under these names, is not overwritten without --force. What the run did not write is never
/// removed, and a file of its own that you changed is kept as NAME.bak. The config and the files that it names are read once, at
/// the start.
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
    let mut resolved = args.config.load(&args.sets())?;
    let study = args.config.study(&resolved)?;
    // Before the folder is touched: a run without threads leaves it as it was.
    let server = ThreadServer::new(&study, resolved.config().run.threads)?;
    let path = args.folder(resolved.config());
    refuse_file(&path)?;
    let seed = fix_seed(&mut resolved, &path, args.resume)?;
    let mut folder = args.open(&path, &resolved)?;
    for warning in study.warnings().into_iter().chain(folder.unlocked()) {
        console.warn(&warning);
    }
    seed.iter().for_each(|told| console.note(told));
    let (mut store, sitting) = args.begin(&mut folder, &resolved)?;
    folder.take_warnings().iter().for_each(|warning| console.warn(warning));
    let stop = StopFlag::new();
    let clock = Instant::now();
    let mut watch =
        Watch { display: Display::new(resolved.config(), study.baseline(), *console), sitting, folder };
    let outcome = evolve(&study, server, resolved.config(), &mut store, &stop, &mut watch, console)?;
    let Watch { mut sitting, mut folder, .. } = watch;
    let dialect = args.dialect(&folder);
    let run = Run { study: &study, resolved: &resolved, outcome: &outcome, dialect };
    let is_cut = matches!(outcome.ended, Ended::Interrupted(_));
    let names = if is_cut { run.table_names() } else { run.names() };
    sitting.searched(&mut folder, &outcome, store.worked(), names).map_err(failed)?;
    let is_whole = if is_cut {
        run.write_tables(&mut folder).map_err(failed)?;
        false
    } else {
        console.note(&match outcome.front.len() {
            0 => "writing the designs that came nearest".to_owned(),
            count => format!("writing {count} designs of the front"),
        });
        let threads = sitting.threads();
        run.write(&mut folder, threads, &mut WritingDisplay::new(&stop, *console)).map_err(failed)?
    };
    let status = if is_whole { Status::Finished } else { Status::Interrupted };
    sitting.end(&mut folder, status).map_err(failed)?;
    folder.take_warnings().iter().for_each(|warning| console.warn(warning));
    if !is_whole {
        console.always(&format!("interrupted; go on with: {}", args.resume_command(&folder)));
        return Ok(ExitCode::from(exit::interrupted(stop.raised().unwrap_or_default())));
    }
    drop(store);
    summarise(&study, &outcome, &folder, clock, console);
    let code = if outcome.front.is_empty() { exit::NOTHING_FEASIBLE } else { exit::DONE };
    // The report is made from the folder: no need to hold every design twice.
    drop(outcome);
    write_report(&mut folder)?;
    Ok(ExitCode::from(code))
}

/// An error of the work itself; for `map_err`.
fn failed(error: impl std::fmt::Display) -> CliError {
    CliError::Failed(error.to_string())
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

    /// Where the results go.
    fn folder(&self, config: &Config) -> PathBuf {
        let name = config.run.name.as_deref().unwrap_or("run");
        self.out.clone().unwrap_or_else(|| PathBuf::from("results").join(name))
    }

    /// The results folder, locked, of a run that can be begun or gone on with there.
    fn open(&self, path: &Path, resolved: &ResolvedConfig) -> Result<Folder, CliError> {
        let opening = match (self.resume, self.force) {
            (true, _) => Opening::Resume,
            (_, true) => Opening::Overwrite,
            _ => Opening::New,
        };
        if self.resume {
            Store::check(path, &results::record(resolved)).map_err(refused)?;
        }
        Folder::open(path, opening).map_err(|error| match error {
            FolderError::Io { ref source, .. } if source.kind() == ErrorKind::StorageFull => {
                CliError::Failed(error.to_string())
            }
            refused => CliError::Input(refused.to_string()),
        })
    }

    /// Makes the folder this run's.
    fn begin(&self, folder: &mut Folder, resolved: &ResolvedConfig) -> Result<(Store, Sitting), CliError> {
        let record = results::record(resolved);
        let threads = match resolved.config().run.threads {
            0 => std::thread::available_parallelism().map_or(1, usize::from),
            threads => threads,
        };
        let begin = |folder: &mut Folder| -> Result<Sitting, CliError> {
            folder.begin().map_err(failed)?;
            Sitting::begin(folder, resolved, threads).map_err(failed)
        };
        if self.resume {
            let store = Store::resume(folder.path(), record).map_err(refused)?;
            Ok((store, begin(folder)?))
        } else {
            let sitting = begin(folder)?;
            Ok((Store::create(folder.path(), record).map_err(refused)?, sitting))
        }
    }

    /// Which copies of the tables are wanted: those that are asked for, or that there are already.
    fn dialect(&self, folder: &Folder) -> Dialect {
        match self.csv_dialect {
            None if !folder.lists(&excel_name(PARETO)) => Dialect::Canonical,
            _ => Dialect::ExcelEu,
        }
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

/// A store that cannot be used; for `map_err`.
fn refused(error: search::StoreError) -> CliError {
    match error {
        search::StoreError::Io { .. } => CliError::Failed(error.to_string()),
        refused => CliError::Input(refused.to_string()),
    }
}

/// The seed of the config, else that of the run to be resumed, else one drawn; what is told of one not in the config.
fn fix_seed(resolved: &mut ResolvedConfig, folder: &Path, resume: bool) -> Result<Option<String>, CliError> {
    if resolved.config().run.seed.is_some() {
        return Ok(None);
    }
    let recorded = match resume {
        true => Store::recorded_config(folder).map_err(|error| CliError::Input(error.to_string()))?,
        false => None,
    };
    let recorded = recorded.and_then(|config| config.get("run")?.get("seed")?.as_u64());
    let seed = recorded.unwrap_or_else(random::fresh_seed);
    resolved.seed_with(seed);
    Ok(Some(format!("seed {seed}{}", if recorded.is_some() { ", of the run resumed" } else { ", drawn" })))
}

/// Runs the search.
fn evolve(
    study: &Study,
    server: ThreadServer<'_, Study>,
    config: &Config,
    store: &mut Store,
    stop: &StopFlag,
    watch: &mut Watch,
    console: &Console,
) -> Result<Outcome, CliError> {
    let settings = Settings {
        search: config.search.clone(),
        objectives: study.objectives.len(),
        ideal: config.objectives.turned(&config.objectives.ideal),
        reference: config.objectives.turned(&config.objectives.reference),
        seed: config.run.seed.unwrap_or_default(),
    };
    let tell = watch.display.teller();
    let told = "ending with the evaluations in flight; another signal after a second aborts at once";
    signals::install(stop, move || tell(told)).map_err(failed)?;
    console.note(&format!(
        "{}: population {}, {} generations, {} threads, {}",
        config.run.name.as_deref().unwrap_or_default(),
        config.search.population,
        config.search.generations,
        watch.sitting.threads(),
        config.objectives.in_words()
    ));
    console.detail(&to_toml(config));
    let outcome = search::run(study, &server, &settings, stop, Some(store), watch);
    watch.display.finish();
    outcome.map_err(failed)
}

fn write_report(folder: &mut Folder) -> Result<(), CliError> {
    let data = report::read(folder.path()).map_err(failed)?;
    let page = report::render(&data).map_err(failed)?;
    folder.write(REPORT, page.as_bytes()).map_err(failed)
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
        let values = outcome.front.iter().map(|&row| objective.turned(outcome.evaluated[row].objectives[i]));
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        if low.is_finite() {
            outln!("  {:<24} {:>12} to {:>12}", objective.metric.column, significant(low), significant(high));
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
