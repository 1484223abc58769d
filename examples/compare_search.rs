//! Compares ways of searching at equal budget, over paired seeds:
//!
//! ```text
//! cargo run --release --example compare_search -- RANDOM.toml OTHER.toml…
//!     [--seeds 11] [--first-seed 1] [--objectives mass,curvature] [--set key=value]… [--cache FILE]
//! ```
//!
//! Configs may differ in `[run]`, `[objectives]` and `[search]` only: evaluations are pure, so they are shared between
//! runs through a cache, which `--cache` keeps on disk; a design counts in every run that asks for it. All
//! hypervolumes are measured between the 1 % and the 95 % quantile of the feasible designs of the first config's runs,
//! one reference for all; the first config is also the one to beat, so name random sampling first. A config may be
//! followed by keys for it alone, as in `default.toml:search.archive.parents=0.2`. "Share closed" is how much of the
//! way from the first config's median to the best known (the front of all runs together) the median goes. After the
//! table come the pairs that each config wins against each before it, with the two-sided sign test.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    clippy::expect_used,
    reason = "a program for the developer"
)]

use std::collections::HashMap;
use std::error::Error;
use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use clap::Parser;
use quadrille::config::{Config, ResolvedConfig};
use quadrille::evolve::Violation;
use quadrille::grammar::Tokens;
use quadrille::mesh::canonical::Code;
use quadrille::objectives::{METRICS, Objective};
use quadrille::random::Rng;
use quadrille::search::{
    Evaluation, Identity, Normalisation, Outcome, Problem, RuleOperator, Settings, Silent, Steps, StopFlag,
    ThreadServer, operators, quantile, run,
};
use quadrille::study::Study;

#[derive(Parser)]
struct Arguments {
    #[arg(required = true, value_name = "CONFIG[:KEY=VALUE…]")]
    configs: Vec<String>,
    #[arg(long, default_value_t = 11)]
    seeds: u64,
    #[arg(long, default_value_t = 1)]
    first_seed: u64,
    #[arg(long, value_delimiter = ',')]
    objectives: Vec<String>,
    #[arg(long)]
    set: Vec<String>,
    #[arg(long)]
    cache: Option<PathBuf>,
    #[arg(long, default_value_t = 0)]
    threads: usize,
}

/// Evaluations by code, in memory and on disk.
struct Cache {
    known: Mutex<HashMap<Code, Evaluation>>,
    file: Option<Mutex<File>>,
}

impl Cache {
    fn open(path: Option<&Path>) -> Result<Self, Box<dyn Error>> {
        let mut known = HashMap::new();
        let Some(path) = path else { return Ok(Self { known: Mutex::default(), file: None }) };
        if path.exists() {
            for line in BufReader::new(File::open(path)?).lines() {
                type Line = (String, u8, f64, bool, Vec<Option<f64>>);
                let Ok((code, stage, measure, structural, metrics)) = serde_json::from_str::<Line>(&line?)
                else {
                    continue;
                };
                let violation = Violation { stage, measure };
                let evaluation = Evaluation {
                    violation,
                    reason: String::new(),
                    objectives: vec![],
                    metrics,
                    governing: vec![],
                    structural,
                };
                known.insert(Code(u128::from_str_radix(&code, 16)?), evaluation);
            }
            eprintln!("{} evaluations from {}", known.len(), path.display());
        }
        let file = OpenOptions::new().create(true).append(true).open(path)?;
        Ok(Self { known: Mutex::new(known), file: Some(Mutex::new(file)) })
    }

    fn look_up(&self, code: Code) -> Option<Evaluation> {
        self.known.lock().expect("lock").get(&code).cloned()
    }

    fn get(&self, code: Code, evaluate: impl FnOnce() -> Evaluation) -> Evaluation {
        if let Some(known) = self.look_up(code) {
            return known;
        }
        let evaluation = evaluate();
        if let Some(file) = &self.file {
            let Evaluation { violation, structural, ref metrics, .. } = evaluation;
            let line = (format!("{:032x}", code.0), violation.stage, violation.measure, structural, metrics);
            let line = serde_json::to_string(&line).expect("JSON");
            writeln!(file.lock().expect("lock"), "{line}").expect("cache file");
        }
        self.known.lock().expect("lock").insert(code, evaluation.clone());
        evaluation
    }
}

/// A study whose evaluations are shared, with objectives of its own.
struct Shared<'a> {
    study: &'a Study,
    cache: &'a Cache,
    objectives: Vec<usize>,
}

impl Problem for Shared<'_> {
    fn identify(&self, tokens: &Tokens) -> Identity {
        self.study.identify(tokens)
    }

    fn evaluate(&self, tokens: &Tokens) -> Evaluation {
        let topology = self.study.topology(tokens);
        let mut evaluation = self.cache.get(topology.code, || self.study.evaluate(tokens));
        let objectives: Option<Vec<f64>> =
            self.objectives.iter().map(|&m| evaluation.metrics.get(m).copied().flatten()).collect();
        evaluation.objectives = objectives.unwrap_or_default();
        evaluation
    }

    fn seeds(&self) -> Vec<Tokens> {
        self.study.seeds()
    }

    fn random(&self, rng: &mut Rng) -> Tokens {
        self.study.random(rng)
    }

    fn steps(&self, steps: Steps, expressed: &Tokens) -> Vec<Tokens> {
        self.study.steps(steps, expressed)
    }

    fn vary(&self, operator: RuleOperator, expressed: &Tokens, rng: &mut Rng) -> Option<Tokens> {
        self.study.vary(operator, expressed, rng)
    }
}

/// One way of searching: a config with its keys set.
struct Variant {
    name: String,
    config: ResolvedConfig,
}

impl Variant {
    fn load(text: &str, arguments: &Arguments) -> Result<Self, Box<dyn Error>> {
        let (path, keys) = text.split_once(':').unwrap_or((text, ""));
        let keys = keys.split(';').filter(|key| !key.is_empty()).map(str::to_owned);
        let mut sets: Vec<String> = arguments.set.iter().cloned().chain(keys).collect();
        if !arguments.objectives.is_empty() {
            sets.push(format!("objectives.minimise={:?}", arguments.objectives));
        }
        let path = Path::new(path);
        Ok(Self { name: text.to_owned(), config: ResolvedConfig::open(path, &sets)? })
    }

    /// Whether evaluations of `other` hold here too.
    fn shares(&self, other: &Self) -> bool {
        let worth = |c: &Config| {
            (c.domain.clone(), c.surface.clone(), c.topology.clone(), c.pattern.clone(), c.structure.clone())
        };
        worth(self.config.config()) == worth(other.config.config())
    }

    /// One run.
    fn search(&self, cache: &Cache, seed: u64, threads: usize) -> Result<Outcome, Box<dyn Error>> {
        let study = Study::of(&self.config)?;
        let place = |objective: &Objective| METRICS.iter().position(|m| m.name == objective.metric.name);
        let objectives: Vec<usize> = study.objectives.iter().filter_map(place).collect();
        let settings = Settings {
            search: self.config.config().search.clone(),
            objectives: objectives.len(),
            ideal: vec![],
            reference: vec![],
            seed,
        };
        let problem = Shared { study: &study, cache, objectives };
        let server = ThreadServer::new(&problem, threads)?;
        Ok(run(&problem, &server, &settings, &StopFlag::new(), None, &mut Silent)?)
    }
}

fn feasible(outcomes: &[Outcome]) -> Vec<Vec<f64>> {
    let rows = outcomes.iter().flat_map(|o| &o.evaluated).filter(|row| row.is_feasible());
    rows.map(|row| row.objectives.to_vec()).collect()
}

fn volume(points: &[Vec<f64>], axes: &Normalisation) -> f64 {
    axes.hypervolume(points.iter().map(Vec::as_slice))
}

/// How many of the pairs `a` wins and how many are decided, and how probable a result at least as one-sided is if
/// both win equally often: the two-sided sign test.
fn sign_test(a: &[f64], b: &[f64]) -> (usize, usize, f64) {
    let wins = a.iter().zip(b).filter(|(a, b)| a > b).count();
    let decided = a.iter().zip(b).filter(|(a, b)| a != b).count();
    // Binomial coefficients of the tail, each from the one before.
    let (mut tail, mut ways) = (0.0, 1.0);
    for k in 0..=wins.min(decided - wins) {
        tail += ways;
        ways *= (decided - k) as f64 / (k + 1) as f64;
    }
    (wins, decided, f64::min(1.0, 2.0 * tail / 2f64.powi(decided as i32)))
}

fn front(outcome: &Outcome) -> Vec<Vec<f64>> {
    outcome.front.iter().map(|&i| outcome.evaluated[i].objectives.to_vec()).collect()
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    let cache = Cache::open(arguments.cache.as_deref())?;
    let load = |text: &String| Variant::load(text, &arguments);
    let variants: Vec<Variant> = arguments.configs.iter().map(load).collect::<Result<_, _>>()?;
    if let Some(other) = variants.iter().find(|variant| !variant.shares(&variants[0])) {
        return Err(format!("{} and {} do not evaluate alike", variants[0].name, other.name).into());
    }
    let mut outcomes: Vec<Vec<Outcome>> = Vec::new();
    for variant in &variants {
        let mut of_variant = Vec::new();
        for seed in (arguments.first_seed..).take(arguments.seeds as usize) {
            of_variant.push(variant.search(&cache, seed, arguments.threads)?);
            eprint!("\r{}: seed {seed} ", variant.name);
        }
        eprintln!();
        outcomes.push(of_variant);
    }
    print(&variants, &outcomes)
}

fn print(variants: &[Variant], outcomes: &[Vec<Outcome>]) -> Result<(), Box<dyn Error>> {
    let sample = feasible(&outcomes[0]);
    let axes =
        Normalisation::quantiles(sample.iter().map(Vec::as_slice)).ok_or("nothing feasible in the first")?;
    let volumes: Vec<Vec<f64>> =
        outcomes.iter().map(|of| of.iter().map(|o| volume(&front(o), &axes)).collect()).collect();
    let union: Vec<Vec<f64>> = outcomes.iter().flatten().flat_map(front).collect();
    let best = volume(&union, &axes);
    println!("ideal {:?}\nreference {:?}\nbest known {best:.4}", axes.ideal, axes.reference);
    let median = |values: &[f64]| {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        [0.25, 0.5, 0.75].map(|q| quantile(&sorted, q))
    };
    let base = median(&volumes[0])[1];
    println!(
        "| variant | q1 | median | q3 | share closed | beats first | feasible | evaluated | refused equal | rejected | cached |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|");
    for ((Variant { name, .. }, of), values) in variants.iter().zip(outcomes).zip(&volumes) {
        let [q1, q2, q3] = median(values);
        let wins = values.iter().zip(&volumes[0]).filter(|(a, b)| a > b).count();
        let mean = |count: &dyn Fn(&Outcome) -> u64| of.iter().map(count).sum::<u64>() / of.len() as u64;
        println!(
            "| {name} | {q1:.4} | {q2:.4} | {q3:.4} | {:.0} % | {wins}/{} | {} | {} | {} | {} | {} |",
            100.0 * (q2 - base) / (best - base),
            values.len(),
            mean(&|o| o.evaluated.iter().filter(|r| r.is_feasible()).count() as u64),
            mean(&|o| o.evaluated.len() as u64),
            mean(&|o| o.breeding.duplicates + o.breeding.neighbours),
            mean(&|o| o.breeding.rejected),
            mean(&|o| o.breeding.cached),
        );
    }
    println!();
    for (k, (row, a)) in variants.iter().zip(&volumes).enumerate() {
        for (column, b) in variants.iter().zip(&volumes).take(k) {
            let (wins, decided, p) = sign_test(a, b);
            println!("{} beats {} in {wins} of {decided} pairs (p = {p:.3})", row.name, column.name);
        }
    }
    for (Variant { name, .. }, of) in variants.iter().zip(outcomes) {
        println!("\n{name}: operator used/evaluated/survived/entered the front, sums over seeds");
        for (k, operator) in operators::OPERATORS.iter().enumerate() {
            let sum = |f: fn(&quadrille::search::OperatorCount) -> u64| {
                of.iter().map(|o| f(&o.breeding.operators[k])).sum::<u64>()
            };
            let used = sum(|c| c.used);
            if used > 0 {
                let (evaluated, survived, entered) =
                    (sum(|c| c.evaluated), sum(|c| c.survived), sum(|c| c.entered_front));
                println!("  {operator}: {used} {evaluated} {survived} {entered}");
            }
        }
    }
    Ok(())
}
