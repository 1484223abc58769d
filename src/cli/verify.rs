//! `quadrille verify`: evaluate rows of a results folder again and compare every number.

use super::folder_args::{FolderArgs, find, same_code};
use super::{CliError, Console, exit};
use quadrille::mesh::{Code, Symmetries};
use quadrille::objectives::{GOVERNING, METRICS};
use quadrille::output::consistency::{Contradiction, contradictions};
use quadrille::output::designs::id;
use quadrille::output::load::Loaded;
use quadrille::search::{EvaluatedRow, Evaluation, Identity, Problem, evaluate, thread_pool};
use quadrille::study::Study;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::process::ExitCode;

/// Largest relative difference that other processors may make.
const TOLERANCE: f64 = 1e-6;

/// Evaluate designs of a results folder again from their strings and compare every number.
///
/// Without --design: the front, and whether pareto.csv says what history.csv says and lists all non-dominated designs.
/// Names every number that differs by more than 1e-6 relative (as much as another processor may make), and every cell in
/// which the two files differ; exit code 1 if there is any.
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    run: FolderArgs,
    /// One design only: its id, or the beginning of it; any of history.csv.
    #[arg(long, value_name = "ID")]
    design: Option<String>,
}

/// Evaluates and compares.
pub fn run(args: Args, console: &Console) -> Result<ExitCode, CliError> {
    let (loaded, study) = args.run.load()?;
    let mut told =
        contradictions(&args.run.folder, &loaded).map_err(|error| CliError::Input(error.to_string()))?;
    let rows: Vec<&EvaluatedRow> = match &args.design {
        Some(design) => {
            let row = find(&loaded, design)?;
            told.retain(|contradiction| contradiction.code.is_none_or(|code| code == row.code));
            vec![row]
        }
        None => front(&loaded, &told),
    };
    let all = || rows.par_iter().map(|row| differences(&study, row, &loaded.lacking)).collect();
    let found: Vec<Vec<String>> = thread_pool(0)?.install(all);
    for contradiction in &told {
        outln!("{}", contradiction.message);
    }
    let mut verified = 0;
    for (row, differences) in rows.iter().zip(&found) {
        for difference in differences {
            outln!("{}: {difference}", id(row.code));
        }
        if differences.is_empty() && !told.iter().any(|t| t.code == Some(row.code)) {
            verified += 1;
            console.detail(&format!("{}: verified", id(row.code)));
        }
    }
    match rows.len() {
        0 => outln!("no feasible design to verify: the front is empty"),
        all => outln!("{verified} of {all} designs verified"),
    }
    Ok(ExitCode::from(if told.is_empty() && verified == rows.len() { exit::DONE } else { exit::FAILED }))
}

/// The rows of pareto.csv, and all others of which it says something wrong: those it lacks.
fn front<'a>(loaded: &'a Loaded, told: &[Contradiction]) -> Vec<&'a EvaluatedRow> {
    let named: BTreeSet<Code> = told.iter().filter_map(|contradiction| contradiction.code).collect();
    let listed: BTreeSet<usize> = loaded.front.iter().copied().collect();
    let others = loaded.evaluated.iter().enumerate();
    let others = others.filter(|(place, row)| named.contains(&row.code) && !listed.contains(place));
    let front = listed.iter().map(|&place| &loaded.evaluated[place]);
    front.chain(others.map(|(_, row)| row)).collect()
}

/// Everything that is not what the file says; it says nothing of the columns that it lacks.
fn differences(study: &Study, row: &EvaluatedRow, lacking: &[&str]) -> Vec<String> {
    if !same_code(study, &row.tokens, row.code) {
        return vec![format!("string {} no longer gives this design", row.tokens)];
    }
    let now = evaluate(study, &row.tokens).sanitised(study.objectives.len());
    let identity = study.identify(&row.tokens);
    let mut differences = words(row, &now, &identity, lacking);
    let measure = ("violation", Some(row.violation.measure), Some(now.violation.measure));
    let metrics = METRICS
        .iter()
        .enumerate()
        .map(|(i, metric)| (metric.column, row.metrics.get(i), now.metrics.get(i).copied().flatten()));
    let numbers = std::iter::once(measure)
        .chain(metrics)
        .filter(|&(column, then, now)| !lacking.contains(&column) && !agree(then, now));
    differences.extend(numbers.map(|(column, then, now)| {
        let shown = |value: Option<f64>| value.map_or("none".into(), |value| value.to_string());
        format!("{column}: file {}, now {}", shown(then), shown(now))
    }));
    differences
}

/// What is no number of its own.
fn words(row: &EvaluatedRow, now: &Evaluation, identity: &Identity, lacking: &[&str]) -> Vec<String> {
    let (then, reason) = (row.violation, row.reason.to_string());
    // Folders of older versions name none.
    let symmetry = (row.symmetries != Symmetries::default())
        .then(|| ("symmetry", row.symmetries.to_string(), identity.symmetries.to_string()));
    let cells = [
        ("expressed", row.expressed.to_string(), identity.expressed.to_string()),
        ("feasible", row.is_feasible().to_string(), now.violation.is_feasible().to_string()),
        ("violation_stage", then.stage.to_string(), now.violation.stage.to_string()),
        ("reason", reason, now.reason.clone()),
    ];
    let governing = GOVERNING.iter().zip(row.governing.iter().zip(&now.governing));
    let governing = governing.filter(|((column, _), _)| !lacking.contains(column));
    let governing = governing.map(|((column, _), (then, now))| (*column, then.to_string(), now.clone()));
    let different =
        cells.into_iter().chain(symmetry).chain(governing).filter(|(_, then, now)| !same_words(then, now));
    different.map(|(column, then, now)| format!("{column}: file \"{then}\", now \"{now}\"")).collect()
}

/// Equal word by word; a number in them may round to the next of its four decimals.
fn same_words(then: &str, now: &str) -> bool {
    let number = |word: &str| word.trim_matches(['(', ')', ',', ';', ':']).parse::<f64>().ok();
    let near = |a: f64, b: f64| (a - b).abs() <= 1.01e-4 + TOLERANCE * a.abs().max(b.abs());
    let same =
        |(a, b): (&str, &str)| a == b || matches!((number(a), number(b)), (Some(a), Some(b)) if near(a, b));
    then.split(' ').count() == now.split(' ').count() && then.split(' ').zip(now.split(' ')).all(same)
}

fn agree(then: Option<f64>, now: Option<f64>) -> bool {
    match (then, now) {
        (Some(then), Some(now)) => (then - now).abs() <= TOLERANCE * then.abs().max(now.abs()).max(1e-9),
        (then, now) => then.is_none() && now.is_none(),
    }
}
