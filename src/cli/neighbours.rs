//! `quadrille neighbours`: every design one strip away.

use super::compare::Comparison;
use super::config_args::ConfigArgs;
use super::folder_args::{folder_exists, refuse_other_kind};
use super::topology::parse_string;
use super::{CliError, Console};
use quadrille::files::atomic;
use quadrille::objectives::Objective;
use quadrille::output::number::significant;
use quadrille::search::operators::Reach;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Evaluate every design one strip added or deleted away, and compare.
///
/// Every strip that can be deleted is; strips are added along every simple polyedge of at most --edges edges from
/// boundary to boundary (with --poles also from and to inner vertices). Says in how many objectives the given string
/// is better than all of them, and lists the best neighbours for each. The same topology is evaluated once.
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    config: ConfigArgs,
    /// The string.
    #[arg(long, value_name = "S")]
    string: String,
    /// Most edges of a polyedge along which a strip is added.
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u64).range(1..))]
    edges: u64,
    /// Add strips that end in poles too.
    #[arg(long)]
    poles: bool,
    /// Write the table of all of them into this CSV file.
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
}

/// How many neighbours are listed for each objective.
const LISTED: usize = 5;

/// Evaluates and ranks.
pub fn run(args: Args, console: &Console) -> Result<ExitCode, CliError> {
    let resolved = args.config.load(&[])?;
    let tokens = parse_string("--string", &args.string)?;
    if let Some(path) = &args.out {
        writable(path)?;
    }
    let study = args.config.study(&resolved)?;
    let expressed = study.decode(&tokens).expressed;
    let mut seen = BTreeSet::from([study.topology(&tokens).code]);
    let mut named = vec![(expressed.to_string(), expressed.clone())];
    for neighbour in study.neighbours(&expressed, Reach { edges: args.edges as usize, poles: args.poles }) {
        if seen.insert(study.topology(&neighbour).code) {
            named.push((neighbour.to_string(), neighbour));
        }
    }
    console.note(&format!("evaluating {} different designs one strip away", named.len() - 1));
    let comparison = Comparison::of(&study, named, resolved.config().run.threads, None)?;
    let count = comparison.entries.len() - 1;
    let feasible = comparison.entries[1..].iter().filter(|e| e.evaluation.violation.is_feasible()).count();
    let meant = match tokens == expressed {
        true => String::new(),
        false => format!(", expressed \"{expressed}\""),
    };
    outln!(
        "\"{tokens}\"{meant} ({}): {count} neighbours, {feasible} of them feasible",
        comparison.entries[0].id()
    );
    if !comparison.entries[0].evaluation.violation.is_feasible() {
        outln!("the string itself is not feasible: {}", comparison.entries[0].evaluation.reason);
    }
    let mut won = 0;
    for (index, objective) in study.objectives.iter().enumerate() {
        won += usize::from(rank(&comparison, index, objective));
    }
    if feasible > 0 {
        outln!("\n{}", verdict(won, study.objectives.len()));
    }
    if let Some(path) = &args.out {
        atomic::write_named(path, &comparison.table().to_csv()).map_err(CliError::write(path))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Whether the folder of a file to be written is there, before anything is evaluated for it.
fn writable(path: &Path) -> Result<(), CliError> {
    let place = format!("--out {}", path.display());
    folder_exists(path).map_err(|reason| CliError::Input(format!("{place}: {reason}")))?;
    match path.is_dir() {
        true => Err(CliError::Input(format!("{place}: a folder; allowed: a file"))),
        false => refuse_other_kind("--out", path, "csv"),
    }
}

fn verdict(won: usize, objectives: usize) -> String {
    match won {
        0 => "better than all its neighbours in no objective".into(),
        _ if won == objectives => "better than all its neighbours in every objective".into(),
        _ => format!("better than all its neighbours in {won} of {objectives} objectives"),
    }
}

/// Prints the best feasible neighbours of one objective; true if the given design is better than all of them.
fn rank(comparison: &Comparison, index: usize, objective: &Objective) -> bool {
    let value = |entry: usize| comparison.entries[entry].evaluation.objectives.get(index).copied();
    let own = value(0);
    let mut others: Vec<(f64, usize)> = (1..comparison.entries.len())
        .filter(|&entry| comparison.entries[entry].evaluation.violation.is_feasible())
        .filter_map(|entry| Some((value(entry)?, entry)))
        .collect();
    others.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let own_is_feasible = comparison.entries[0].evaluation.violation.is_feasible();
    let best = own_is_feasible && own.zip(others.first()).is_some_and(|(own, &(other, _))| own < other);
    let told = |value: f64| significant(objective.turned(value));
    let shown = own.map_or_else(|| "–".into(), told);
    outln!(
        "\n{}: {shown}{}",
        objective.metric.column,
        if best { ", better than all neighbours" } else { "" }
    );
    for (value, entry) in others.into_iter().take(LISTED) {
        let entry = &comparison.entries[entry];
        outln!("  {:>12}  {}  {}", told(value), entry.id(), entry.name);
    }
    best
}
