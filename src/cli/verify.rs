//! `quadrille verify`: evaluate rows of a results folder again and compare every number.

use super::folder_args::{find, open, same_code};
use super::{CliError, Console, exit};
use quadrille::objectives::METRICS;
use quadrille::output::designs::id;
use quadrille::search::EvaluatedRow;
use quadrille::study::{Effort, Study};
use rayon::prelude::*;
use std::path::PathBuf;
use std::process::ExitCode;

/// Largest relative difference that other processors may make.
const TOLERANCE: f64 = 1e-6;

/// Evaluate designs of a results folder again from their strings and compare every number.
///
/// Without --design: the front. Says for each design whether all numbers are identical, equal to 1e-6 relative (as
/// another processor may give), or different; exit code 1 if any is different.
#[derive(clap::Args)]
pub struct Args {
    /// The results folder of a run.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// One design only: its id, or the beginning of it; any of history.csv.
    #[arg(long, value_name = "ID")]
    design: Option<String>,
}

/// Evaluates and compares.
pub fn run(args: Args, console: &Console) -> Result<ExitCode, CliError> {
    let (loaded, study) = open(&args.folder)?;
    let rows: Vec<&EvaluatedRow> = match &args.design {
        Some(design) => vec![find(&loaded, design)?],
        None => loaded.front.iter().map(|&row| &loaded.evaluated[row]).collect(),
    };
    let found: Vec<Vec<String>> = rows.par_iter().map(|row| differences(&study, row)).collect();
    let mut different = 0;
    for (row, differences) in rows.iter().zip(&found) {
        different += usize::from(!differences.is_empty());
        for difference in differences {
            outln!("{}: {difference}", id(row.code));
        }
        if differences.is_empty() {
            console.detail(&format!("{}: verified", id(row.code)));
        }
    }
    outln!("{} of {} designs verified", rows.len() - different, rows.len());
    Ok(ExitCode::from(if different == 0 { exit::DONE } else { exit::FAILED }))
}

/// Every number that is not what the file says.
fn differences(study: &Study, row: &EvaluatedRow) -> Vec<String> {
    if !same_code(study, &row.tokens, row.code) {
        return vec![format!("string {} no longer has code {}", row.tokens, row.code)];
    }
    let evaluation = study.evaluate_topology(study.topology(&row.tokens), Effort::Promising);
    let mut differences = Vec::new();
    if evaluation.violation.stage != row.violation.stage {
        let (now, then) = (evaluation.violation.stage, row.violation.stage);
        differences.push(format!("violation_stage: file {then}, now {now}"));
    }
    for (index, metric) in METRICS.iter().enumerate() {
        let (then, now) = (row.metrics.get(index), evaluation.metrics.get(index).copied().flatten());
        if !agree(then, now) {
            let shown = |value: Option<f64>| value.map_or("none".into(), |value| value.to_string());
            differences.push(format!("{}: file {}, now {}", metric.column, shown(then), shown(now)));
        }
    }
    differences
}

fn agree(then: Option<f64>, now: Option<f64>) -> bool {
    match (then, now) {
        (Some(then), Some(now)) => (then - now).abs() <= TOLERANCE * then.abs().max(now.abs()).max(1e-9),
        (then, now) => then.is_none() && now.is_none(),
    }
}
