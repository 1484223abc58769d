//! Designs side by side: all metrics, absolute and normalised by the largest, non-dominated ones marked.

use super::CliError;
use quadrille::evolve::{Domination, compare_objectives, visible};
use quadrille::geometry::Pattern;
use quadrille::grammar::Tokens;
use quadrille::mesh::{CanonicalMesh, Code, Symmetries};
use quadrille::objectives::{GOVERNING, METRICS};
use quadrille::output::designs::id;
use quadrille::output::number::significant;
use quadrille::output::results::{DesignFiles, Developed};
use quadrille::output::table::{Cell, Table};
use quadrille::search::{Evaluation, thread_pool};
use quadrille::structure::gridshell::Proof;
use quadrille::study::{Effort, Reached, Study};
use quadrille::surface::SurfaceKind;
use rayon::prelude::*;
use std::fmt::Write;

/// One design.
pub struct Entry {
    /// What the user calls it.
    pub name: String,
    /// Its string.
    pub tokens: Tokens,
    /// Its placed + reduced code.
    pub code: Code,
    /// Which symmetries it has.
    pub symmetries: Symmetries,
    /// Its numbers, or why it has none.
    pub evaluation: Evaluation,
    /// Whether it has a pattern, sound or folded.
    pub has_pattern: bool,
    /// Its sound pattern, where there is no surface and so the forms of designs differ.
    pub form: Option<Pattern>,
}

/// Takes the files of a design as soon as it is developed: no need to develop it twice, nor to hold all of them.
pub type Save<'a> = dyn Fn(DesignFiles) -> Result<(), CliError> + Sync + 'a;

impl Entry {
    /// Its id ([`id`]).
    pub fn id(&self) -> String {
        id(self.code)
    }
}

/// Designs to compare.
pub struct Comparison {
    /// The designs, in the given order.
    pub entries: Vec<Entry>,
    objectives: Vec<&'static str>,
}

impl Comparison {
    /// Evaluates all strings on `threads` threads (0: one per core) with every number that can be had; `save` gets the files of all that have a pattern.
    ///
    /// # Errors
    /// The first of `save`, in the order of the strings; or the system does not give the threads.
    pub fn of(
        study: &Study,
        named: Vec<(String, Tokens)>,
        threads: usize,
        save: Option<&Save<'_>>,
    ) -> Result<Self, CliError> {
        let evaluate = |(name, tokens): (String, Tokens)| {
            let topology = study.topology(&tokens);
            let code = topology.code;
            let symmetries = study.symmetries_of(&topology);
            let (evaluation, reached) = match save {
                None => examine(study, topology),
                Some(save) => match Developed::of(study, topology, Proof::None) {
                    Err(failure) => (Evaluation::from(&failure), Reached::Nothing),
                    Ok(developed) => {
                        save(developed.files(&id(code)))?;
                        (developed.evaluation(study), developed.reached())
                    }
                },
            };
            let has_pattern = !matches!(reached, Reached::Nothing);
            let form = match reached {
                Reached::Pattern(design) if study.surface.kind() == SurfaceKind::Free => Some(design.pattern),
                _ => None,
            };
            Ok(Entry { name, tokens, code, symmetries, evaluation, has_pattern, form })
        };
        let all = || named.into_par_iter().map(evaluate).collect();
        let entries: Vec<Result<Entry, CliError>> = thread_pool(threads)?.install(all);
        Ok(Self {
            entries: entries.into_iter().collect::<Result<_, _>>()?,
            objectives: study.objectives.iter().map(|objective| objective.metric.name).collect(),
        })
    }

    /// Whether no other feasible design is at least as good in all objectives and better in one, to six digits as on a front.
    pub fn is_non_dominated(&self, index: usize) -> bool {
        let own = &self.entries[index].evaluation;
        let values = visible(&own.objectives);
        let better = |other: &Entry| {
            other.evaluation.violation.is_feasible()
                && compare_objectives(&visible(&other.evaluation.objectives), &values) == Domination::First
        };
        own.violation.is_feasible() && !self.entries.iter().any(better)
    }

    /// All metrics of all designs.
    pub fn table(&self) -> Table {
        self.with(|value, _| value)
    }

    /// Every metric divided by the largest of these designs.
    pub fn normalised(&self) -> Table {
        self.with(|value, largest| if largest > 0.0 { value / largest } else { 0.0 })
    }

    fn with(&self, number: impl Fn(f64, f64) -> f64) -> Table {
        let head = ["name", "string", "id", "symmetry", "feasible", "non_dominated"];
        let columns = METRICS.iter().map(|metric| metric.column);
        let governing = GOVERNING.iter().map(|(column, _)| *column);
        let mut table = Table::new(head.into_iter().chain(columns).chain(governing).chain(["reason"]));
        for (index, entry) in self.entries.iter().enumerate() {
            let evaluation = &entry.evaluation;
            let mut cells: Vec<Cell> = vec![
                entry.name.clone().into(),
                entry.tokens.to_string().into(),
                entry.id().into(),
                Cell::words(&entry.symmetries.to_string()),
                evaluation.violation.is_feasible().into(),
                self.is_non_dominated(index).into(),
            ];
            cells.extend(
                (0..METRICS.len())
                    .map(|m| Cell::from(self.value(entry, m).map(|value| number(value, self.largest(m))))),
            );
            cells
                .extend((0..GOVERNING.len()).map(|i| governing_in(entry, i).map_or(Cell::Empty, Cell::from)));
            cells.push(Cell::words(&evaluation.reason));
            table.rows.push(cells);
        }
        table
    }

    fn value(&self, entry: &Entry, metric: usize) -> Option<f64> {
        entry.evaluation.metrics.get(metric).copied().flatten()
    }

    fn largest(&self, metric: usize) -> f64 {
        let values = self.entries.iter().filter_map(|entry| self.value(entry, metric));
        values.fold(0.0, |largest, value| largest.max(value.abs()))
    }

    /// One column a design, one line a metric: the objectives first, absolute and (normalised).
    pub fn to_text(&self) -> String {
        let mut text = String::new();
        for (index, entry) in self.entries.iter().enumerate() {
            let mark = if self.is_non_dominated(index) { "*" } else { " " };
            let state = match entry.evaluation.violation.is_feasible() {
                true => "feasible".to_owned(),
                false => format!("not feasible: {}", entry.evaluation.reason),
            };
            let _ = writeln!(text, "{mark} [{}] {}  {}  {state}", index + 1, entry.id(), shown(&entry.name));
        }
        text.push_str("\n* no other of these designs is better in every objective\n\n");
        let _ = write!(text, "{:<26}", "");
        for index in 0..self.entries.len() {
            let _ = write!(text, "{:>20}", format!("[{}]", index + 1));
        }
        text.push('\n');
        let (first, rest): (Vec<usize>, Vec<usize>) =
            (0..METRICS.len()).partition(|&m| self.objectives.contains(&METRICS[m].name));
        for metric in first.into_iter().chain(rest) {
            self.line(&mut text, metric);
        }
        for (index, (column, _)) in GOVERNING.iter().enumerate() {
            if self.entries.iter().any(|entry| governing_in(entry, index).is_some()) {
                let _ = write!(text, "{column:<26}");
                for entry in &self.entries {
                    let _ = write!(text, "{:>20}", governing_in(entry, index).unwrap_or("–"));
                }
                text.push('\n');
            }
        }
        text
    }

    fn line(&self, text: &mut String, metric: usize) {
        if self.entries.iter().all(|entry| self.value(entry, metric).is_none()) {
            return;
        }
        let largest = self.largest(metric);
        let _ = write!(text, "{:<26}", METRICS[metric].column);
        for entry in &self.entries {
            let cell = match self.value(entry, metric) {
                Some(value) if largest > 0.0 => format!("{} ({:.2})", significant(value), value / largest),
                Some(value) => significant(value),
                None => "–".into(),
            };
            let _ = write!(text, "{cell:>20}");
        }
        text.push('\n');
    }
}

/// One of the combinations that govern a design.
fn governing_in(entry: &Entry, index: usize) -> Option<&str> {
    entry.evaluation.governing.get(index).map(String::as_str).filter(|name| !name.is_empty())
}

/// The numbers of a topology, and what there is of it.
fn examine(study: &Study, topology: CanonicalMesh) -> (Evaluation, Reached) {
    match study.develop(topology, Effort::Everything) {
        Ok(design) => (study.evaluation(&design), Reached::Pattern(Box::new(design))),
        Err(failure) => (Evaluation::from(&failure), failure.reached),
    }
}

fn shown(name: &str) -> &str {
    if name.is_empty() { "(the empty string: the initial mesh)" } else { name }
}
