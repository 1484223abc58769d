//! A cheap problem over strings, shared by the tests of the search.

use std::sync::atomic::{AtomicU64, Ordering};

use quadrille::evolve::Violation;
use quadrille::grammar::random::uniform;
use quadrille::grammar::{Token, Tokens};
use quadrille::mesh::canonical::Code;
use quadrille::random::{Rng, below};
use quadrille::search::params::{Initialiser, TokenBounds};
use quadrille::search::{
    Evaluation, Identity, Observer, Outcome, Preview, Problem, RuleOperator, SearchParams, Settings, Silent,
    Steps, StopFlag, Store, StoreError, ThreadServer, run,
};

/// What happens to the evaluations of one design in ten.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(dead_code, reason = "every test file uses some of them")]
pub enum Planted {
    Nothing,
    Panic,
    NaN,
    Error,
}

/// Strings whose meaning is how many of each token they have, so many strings mean the same; trailing turns mean
/// nothing. Objectives: few turns, few pivots and many deletions conflict with each other.
pub struct Counting {
    pub planted: Planted,
    pub evaluated: AtomicU64,
    pub bounds: TokenBounds,
    pub objectives: usize,
    pub metrics: usize,
    /// Whether topology rules out half of all designs.
    pub fragile: bool,
    /// Whether all objectives but the first are known before the analysis.
    pub previews: bool,
}

impl Counting {
    pub fn new() -> Self {
        Self {
            planted: Planted::Nothing,
            evaluated: AtomicU64::new(0),
            bounds: TokenBounds { min: 4, max: 24 },
            objectives: 3,
            metrics: 3,
            fragile: false,
            previews: false,
        }
    }

    fn counts(tokens: &Tokens) -> [u64; 6] {
        Token::ALL.map(|kind| tokens.iter().filter(|t| **t == kind).count() as u64)
    }

    fn code(counts: &[u64; 6]) -> Code {
        Code(counts.iter().fold(0, |code, c| code * 1000 + u128::from(*c)))
    }
}

impl Problem for Counting {
    fn identify(&self, tokens: &Tokens) -> Identity {
        let mut expressed = tokens.clone();
        while expressed.last() == Some(&Token::Turn) {
            expressed.pop();
        }
        let counts = Self::counts(&expressed);
        let mut neighbourhood = vec![(Self::code(&counts), 0)];
        for k in 0..6 {
            let mut fewer = counts;
            if fewer[k] > 0 {
                fewer[k] -= 1;
                neighbourhood.push((Self::code(&fewer), 1));
            }
        }
        let many = counts[5] > 3 || (self.fragile && counts[0] % 2 == 1);
        let rejected = many.then(|| (Violation::new(4, counts[5] as f64), "too many".to_owned()));
        Identity {
            code: Self::code(&counts),
            neighbourhood,
            expressed,
            symmetries: Default::default(),
            rejected,
        }
    }

    fn evaluate(&self, tokens: &Tokens) -> Evaluation {
        self.evaluated.fetch_add(1, Ordering::Relaxed);
        let identity = self.identify(tokens);
        let [t, p, d, a, b, c] = Self::counts(&identity.expressed).map(|n| n as f64);
        let unlucky = identity.code.0 % 10 == 3;
        match self.planted {
            Planted::Panic if unlucky => panic!("planted"),
            Planted::NaN if unlucky => {
                return Evaluation {
                    violation: Violation::NONE,
                    reason: String::new(),
                    objectives: vec![f64::NAN; self.objectives],
                    metrics: vec![Some(f64::NAN)],
                    governing: vec![],
                    structural: true,
                };
            }
            Planted::Error if unlucky => return Evaluation::failed("planted error", true),
            _ => {}
        }
        if let Some((violation, reason)) = identity.rejected {
            return Evaluation {
                violation,
                reason,
                objectives: vec![],
                metrics: vec![],
                governing: vec![],
                structural: false,
            };
        }
        let all = [
            (t - 6.0).powi(2) + 0.3 * p + 0.1 * a,
            (p - 5.0).powi(2) + 0.3 * d + 0.1 * b,
            (d - 4.0).powi(2) + 0.3 * t + 0.1 * c,
            10.0 - a - b,
            (t + p + d) / 7.0,
        ];
        let over = a + b + c - 9.0;
        let violation = if over > 0.0 { Violation::new(1, over) } else { Violation::NONE };
        let reason = if over > 0.0 { format!("additions exceed 9 by {over}") } else { String::new() };
        Evaluation {
            violation,
            reason,
            objectives: all[..self.objectives].to_vec(),
            metrics: [Some(t), None, Some(p / 3.0)].into_iter().cycle().take(self.metrics).collect(),
            governing: vec![],
            structural: true,
        }
    }

    fn has_preview(&self) -> bool {
        self.previews
    }

    fn preview(&self, tokens: &Tokens) -> Preview {
        let evaluation = self.evaluate(tokens);
        self.evaluated.fetch_sub(1, Ordering::Relaxed);
        let known = evaluation.objectives.iter().enumerate().map(|(m, &f)| (m > 0).then_some(f));
        Preview { violation: evaluation.violation, objectives: known.collect() }
    }

    fn random(&self, rng: &mut Rng) -> Tokens {
        uniform(rng, self.bounds.min..=self.bounds.max)
    }

    fn steps(&self, steps: Steps, expressed: &Tokens) -> Vec<Tokens> {
        let rules: &[&str] = match steps {
            Steps::Natural => &["D", "PD", "PPD", "TD", "PTD", "ATA", "ATTA", "AoTAo"],
            Steps::Simple => &["TATA*", "PPATA"],
        };
        let append = |rule: &&str| {
            expressed.iter().copied().chain(rule.parse::<Tokens>().expect("a rule").0).collect()
        };
        rules.iter().map(append).collect()
    }

    fn vary(&self, operator: RuleOperator, expressed: &Tokens, rng: &mut Rng) -> Option<Tokens> {
        let mut tokens = expressed.clone();
        match operator {
            RuleOperator::AppendStrip => tokens.extend([Token::Add, Token::Turn, Token::AddPole]),
            _ => tokens.extend([Token::Turn, Token::ALL[below(rng, 6)], Token::Delete]),
        }
        Some(tokens)
    }
}

pub fn settings(generations: u32) -> Settings {
    let search = SearchParams {
        population: 16,
        generations,
        tokens: TokenBounds { min: 4, max: 24 },
        ..SearchParams::default()
    };
    Settings { search, objectives: 3, ideal: vec![], reference: vec![], seed: 7 }
}

/// Three islands that begin near the initial mesh and take local steps.
pub fn island_settings(generations: u32) -> Settings {
    let mut settings = settings(generations);
    let search = &mut settings.search;
    (search.population, search.islands, search.migrate, search.local) = (6, 3, 2, 0.4);
    search.initial.kind = Initialiser::Near;
    settings
}

#[allow(dead_code, reason = "every test file uses some of these")]
pub fn run_silently(problem: &Counting, settings: &Settings, threads: usize) -> Outcome {
    let server = ThreadServer::new(problem, threads).expect("threads");
    run(problem, &server, settings, &StopFlag::new(), None, &mut Silent).expect("no store, no error")
}

#[allow(dead_code, reason = "every test file uses some of these")]
pub fn run_stored(
    problem: &Counting,
    settings: &Settings,
    store: &mut Store,
    stop: &StopFlag,
    observer: &mut dyn Observer,
) -> Result<Outcome, StoreError> {
    let server = ThreadServer::new(problem, 2).expect("threads");
    run(problem, &server, settings, stop, Some(store), observer)
}
