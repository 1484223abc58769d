//! `quadrille axes`: `ideal` and `reference` of a config from random designs.

use super::config_args::ConfigArgs;
use super::{CliError, Console};
use quadrille::mesh::CanonicalMesh;
use quadrille::random::stream;
use quadrille::search::{Evaluation, Normalisation, Problem, thread_pool};
use quadrille::study::{Effort, Study};
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::process::ExitCode;

/// Evaluate random designs and print `ideal` and `reference` for the config's [objectives].
///
/// The designs are those of the config's initialiser and seed, of different topology, none of them pinched or flat.
/// Limits and requirements do not count here, so that also a config which few random designs satisfy has its axes.
/// `ideal` is the 1 % quantile of each objective, `reference` the 95 % quantile.
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    config: ConfigArgs,
    /// How many designs.
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    designs: u32,
    /// Threads; 0 = one per core.
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
}

/// Strings drawn per design wanted before giving up.
const TRIES: usize = 1000;

/// Prints the two lines.
pub fn run(args: Args, console: &Console) -> Result<ExitCode, CliError> {
    let resolved = args.config.load(&[])?;
    let study = args.config.study(&resolved)?;
    let config = resolved.config();
    let topologies = different(&study, config.run.seed.unwrap_or(0), args.designs as usize);
    console.note(&format!("evaluating {} random designs", topologies.len()));
    let pool = thread_pool(args.threads.unwrap_or(config.run.threads))?;
    let evaluate = |topology| study.evaluate_topology(topology, Effort::Everything);
    let evaluations: Vec<Evaluation> = pool.install(|| topologies.into_par_iter().map(evaluate).collect());
    let points = evaluations.iter().map(|e| &e.objectives[..]).filter(|objectives| !objectives.is_empty());
    let Some(axes) = Normalisation::quantiles(points.clone()) else {
        return Err(CliError::Failed("none of these designs has all objectives".into()));
    };
    let spans = config.objectives.names().zip(axes.ideal.iter().zip(&axes.reference));
    for (name, (value, _)) in spans.filter(|(_, (ideal, reference))| ideal >= reference) {
        console.warn(&format!(
            "{name} is {value} in all these designs: no axis, and a config with it is refused; more --designs, or leave it out"
        ));
    }
    outln!("# 1 % and 95 % quantiles of {} of {} random designs", points.count(), evaluations.len());
    outln!("ideal = {}", list(&config.objectives.turned(&axes.ideal)));
    outln!("reference = {}", list(&config.objectives.turned(&axes.reference)));
    Ok(ExitCode::SUCCESS)
}

/// `wanted` topologies, as the initialiser gives them, each once.
fn different(study: &Study, seed: u64, wanted: usize) -> Vec<CanonicalMesh> {
    let mut rng = stream(seed, 0, 0);
    let mut seen = BTreeSet::new();
    let mut topologies = Vec::new();
    for _ in 0..wanted.saturating_mul(TRIES) {
        if topologies.len() == wanted {
            break;
        }
        let tokens = study.random(&mut rng);
        let identity = study.identify(&tokens);
        if identity.rejected.is_none() && seen.insert(identity.code) {
            topologies.push(study.topology(&tokens));
        }
    }
    topologies
}

/// To four digits: axes are a scale, not a result.
fn list(values: &[f64]) -> String {
    let four = |x: &f64| format!("{x:.3e}").parse().unwrap_or(*x).to_string();
    format!("[{}]", values.iter().map(four).collect::<Vec<_>>().join(", "))
}
