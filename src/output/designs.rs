//! `pareto.csv` and `history.csv`: one row per design (docs/reference/files.md §2.1).

use super::front;
use super::table::{Cell, Dialect};
use crate::mesh::canonical::Code;
use crate::objectives::{self, GOVERNING, METRICS};
use crate::search::{EvaluatedRow, ObjectivesParams};
use std::io::{self, Write};

/// The first columns of both files.
pub const FIRST: [&str; 7] = ["id", "string", "expressed", "code", "symmetry", "generation", "feasible"];
/// The last columns of `history.csv`.
pub const LAST: [&str; 3] = ["violation_stage", "violation", "reason"];

/// Names of the columns with numbers, with units (`mass_kg`).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns {
    /// Of the objectives, in the order of the config.
    pub objectives: Vec<String>,
    /// How many of them, from the first on, are minimised; the rest is maximised.
    pub minimised: usize,
    /// Of all metrics, in the order of the registry; those of the objectives among them.
    pub metrics: Vec<String>,
}

/// What ids and codes begin with in files and on the terminal. No hex digit, so that no spreadsheet takes `642450766e43`
/// for a number and loses its digits.
const LETTER: char = 'q';

/// A design's name: a `q` and the first 12 hex digits of its placed + reduced code.
pub fn id(code: Code) -> String {
    written(code).chars().take(13).collect()
}

/// A code as the tables write it: a `q` and its first 16 hex digits.
fn written(code: Code) -> String {
    format!("{LETTER}{code}")
}

/// The hex digits of an id or code, or of the beginning of one: those of results of before have no letter.
pub fn digits(id: &str) -> &str {
    id.strip_prefix(LETTER).unwrap_or(id)
}

/// How a folder writes ids and codes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Naming {
    /// Beginning with a letter.
    Lettered,
    /// As bare digits: results of quadrille 0.1.
    Digits,
}

impl Naming {
    /// As in the folder that `text`, an id or a code, was read from.
    pub(crate) fn of(text: &str) -> Self {
        if text.starts_with(LETTER) { Self::Lettered } else { Self::Digits }
    }

    /// An id or code as such a folder writes it.
    pub(crate) fn apply(self, text: String) -> String {
        match self {
            Self::Lettered => text,
            Self::Digits => digits(&text).to_owned(),
        }
    }
}

impl Columns {
    /// The columns of a config with these objectives.
    pub fn of(objectives: &ObjectivesParams) -> Self {
        Self {
            minimised: objectives.minimise.len(),
            objectives: objectives
                .names()
                .map(|name| {
                    objectives::find(name).map_or_else(|| name.clone(), |metric| metric.column.to_owned())
                })
                .collect(),
            metrics: METRICS.iter().map(|metric| metric.column.to_owned()).collect(),
        }
    }

    /// The metrics that are no objectives: place and name.
    fn others(&self) -> impl Iterator<Item = (usize, &String)> {
        self.metrics.iter().enumerate().filter(|(_, name)| !self.objectives.contains(name))
    }

    /// The header of `history.csv`.
    pub(super) fn history_header(&self) -> Vec<String> {
        self.header().into_iter().chain(LAST.map(str::to_owned)).collect()
    }

    /// The header of `pareto.csv`.
    pub(super) fn front_header(&self) -> Vec<String> {
        self.header().into_iter().chain(front::LAST.map(str::to_owned)).collect()
    }

    /// What both headers begin with.
    fn header(&self) -> Vec<String> {
        let first = FIRST.iter().map(|&name| name.to_owned());
        first
            .chain(self.objectives.iter().cloned())
            .chain(self.others().map(|(_, name)| name.clone()))
            .chain(GOVERNING.iter().map(|(name, _)| (*name).to_owned()))
            .collect()
    }

    /// What the rows of both files begin with.
    pub(super) fn cells(&self, row: &EvaluatedRow) -> Vec<Cell> {
        let mut cells: Vec<Cell> = vec![
            id(row.code).into(),
            row.tokens.to_string().into(),
            row.expressed.to_string().into(),
            written(row.code).into(),
            Cell::words(&row.symmetries.to_string()),
            u64::from(row.generation).into(),
            row.is_feasible().into(),
        ];
        cells.extend((0..self.objectives.len()).map(|i| self.objective(row, i).into()));
        cells.extend(self.others().map(|(metric, _)| Cell::from(row.metrics.get(metric))));
        let governing = |i: usize| row.governing.get(i).filter(|name| !name.is_empty());
        cells.extend(
            (0..GOVERNING.len()).map(|i| governing(i).map_or(Cell::Empty, |name| Cell::from(&**name))),
        );
        cells
    }

    /// A row of `history.csv`.
    pub(super) fn history_cells(&self, row: &EvaluatedRow) -> Vec<Cell> {
        let mut cells = self.cells(row);
        cells.push(u64::from(row.violation.stage).into());
        cells.push(row.violation.measure.into());
        cells.push(Cell::words(&row.reason));
        cells
    }

    /// A value of the objective in this place as the search has it, made as files have it, or the other way round.
    pub fn turned(&self, place: usize, value: f64) -> f64 {
        if place < self.minimised { value } else { -value }
    }

    /// An objective's value; of a design that did not get far enough to have all of them, the metric of that name.
    fn objective(&self, row: &EvaluatedRow, index: usize) -> Option<f64> {
        row.objectives.get(index).map(|&value| self.turned(index, value)).or_else(|| {
            let metric = self.metrics.iter().position(|name| *name == self.objectives[index])?;
            row.metrics.get(metric)
        })
    }
}

/// Writes all evaluated designs, in the given order; none of them is kept in memory a second time.
///
/// # Errors
/// Those of `out`.
pub fn write_history(
    out: &mut dyn Write,
    dialect: Dialect,
    rows: &[EvaluatedRow],
    columns: &Columns,
) -> io::Result<()> {
    dialect.write(out, &columns.history_header(), rows.iter().map(|row| columns.history_cells(row)))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::evolve::Violation;
    use crate::mesh::Symmetries;

    pub(crate) fn columns() -> Columns {
        Columns {
            objectives: vec!["mass_kg".into(), "curvature".into()],
            minimised: 2,
            metrics: vec!["curvature".into(), "buckling_factor".into(), "mass_kg".into()],
        }
    }

    /// A row with a code that starts with `code`.
    pub(crate) fn row(code: u64, string: &str, objectives: &[f64], violation: Violation) -> EvaluatedRow {
        EvaluatedRow {
            generation: 3,
            slot: 0,
            tokens: string.parse().unwrap(),
            expressed: string.parse().unwrap(),
            code: Code(u128::from(code) << 64),
            symmetries: Symmetries::default(),
            violation,
            reason: if violation.is_feasible() { "".into() } else { "too weak, \"badly\"".into() },
            objectives: objectives.into(),
            metrics: [Some(0.125), None, Some(1e6)].into_iter().collect(),
            governing: Box::default(),
            structural: true,
        }
    }

    #[test]
    fn history_says_why() {
        let failed = row(0xabc << 52, "A*", &[], Violation::new(1, 0.25));
        let mut bytes = Vec::new();
        write_history(&mut bytes, Dialect::Canonical, &[failed], &columns()).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        let line = text.lines().nth(1).unwrap();
        assert_eq!(
            line,
            "qabc000000000,A*,A*,qabc0000000000000,,3,false,1000000,0.125,,,,,,,,,,1,0.25,\"too weak, \"\"badly\"\"\""
        );
        let header = text.lines().next().unwrap();
        assert!(header.ends_with("support_slide_combination,violation_stage,violation,reason"));
    }
}
