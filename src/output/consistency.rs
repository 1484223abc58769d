//! Whether the tables of a results folder say the same: `pareto.csv`, `history.csv`, and what their columns promise.

use super::designs::{Columns, Naming, id};
use super::front::{self, Standing};
use super::load::{LoadError, Loaded, Record, Sheet, row};
use super::table::Cell;
use crate::evolve::{NonDominated, visible};
use crate::files::names::{HISTORY, PARETO};
use crate::mesh::canonical::Code;
use crate::search::EvaluatedRow;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Whether it is a column that results of before may not have.
fn is_new(column: &str) -> bool {
    const NEW: [&str; 12] = [
        "symmetry",
        "panel_warp_max_m",
        "distinct_members",
        "distinct_panels",
        "distinct_nodes",
        "cost",
        "carbon_kg",
        "deflection_vertical_combination",
        "utilisation_all_combination",
        "utilisation_von_mises_combination",
        "uplift_combination",
        "support_slide_combination",
    ];
    NEW.contains(&column) || front::LAST.contains(&column)
}

/// Something that a table says otherwise than the rest of the folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Contradiction {
    /// The design; none for a header.
    pub code: Option<Code>,
    /// File, line, design, column, what is expected and what was found.
    pub message: String,
}

/// Every contradiction in the tables of a folder: cells of `pareto.csv` that are not those of `history.csv`, cells of
/// either that do not follow from the rest of their row (`id`, `feasible`), and a front that is not the non-dominated
/// set of the feasible designs.
///
/// # Errors
/// [`LoadError`] if a file cannot be read or lacks a promised column.
pub fn contradictions(folder: &Path, loaded: &Loaded) -> Result<Vec<Contradiction>, LoadError> {
    let columns = Columns::of(&loaded.config.objectives);
    let of_history = columns.history_header();
    let mut found = header(folder, HISTORY, &of_history)?;
    found.extend(rows(folder, (HISTORY, loaded.naming), &of_history, |record| {
        let row = row(record, &columns)?;
        Ok((row.code, columns.history_cells(&row)))
    })?);
    let of_front = columns.front_header();
    found.extend(header(folder, PARETO, &of_front)?);
    let standing = Standing::of(&loaded.evaluated, &loaded.front, &loaded.config.objectives);
    let places: BTreeMap<Code, &EvaluatedRow> = loaded.evaluated.iter().map(|row| (row.code, row)).collect();
    found.extend(rows(folder, (PARETO, loaded.naming), &of_front, |record| {
        let code = row(record, &columns)?.code;
        let recorded =
            places.get(&code).ok_or_else(|| record.wrong(format!("{} is not in {HISTORY}", id(code))))?;
        Ok((code, [columns.cells(recorded), standing.cells(recorded).into()].concat()))
    })?);
    let counts_equal = Sheet::header(&folder.join(PARETO))?.iter().any(|c| front::LAST.contains(&c.as_str()));
    found.extend(listed(loaded, &columns, counts_equal));
    Ok(found)
}

/// Columns that stand elsewhere than promised, or that nobody promised.
fn header(folder: &Path, name: &str, promised: &[String]) -> Result<Vec<Contradiction>, LoadError> {
    let path = folder.join(name);
    let found = Sheet::header(&path)?;
    let promised: Vec<&String> = promised.iter().filter(|c| !is_new(c) || found.contains(c)).collect();
    let missing: Vec<&str> = promised.iter().filter(|c| !found.contains(c)).map(|c| c.as_str()).collect();
    if !missing.is_empty() {
        let message = format!("line 1: columns are missing: {}", missing.join(", "));
        return Err(LoadError::Format { path, message });
    }
    let places = (0..found.len()).filter(|&k| found.get(k) != promised.get(k).copied());
    let told = places.map(|k| {
        let expected = promised.get(k).map_or("no such column", |column| column.as_str());
        let message = format!("{name}: line 1, column {}: expected {expected}, found {}", k + 1, found[k]);
        Contradiction { code: None, message }
    });
    Ok(told.collect())
}

/// Compares each row of a table, cell by cell, with what `expect` says it holds.
fn rows(
    folder: &Path,
    (name, naming): (&str, Naming),
    header: &[String],
    expect: impl Fn(Record<'_>) -> Result<(Code, Vec<Cell>), LoadError>,
) -> Result<Vec<Contradiction>, LoadError> {
    let of_rows = Sheet::each(folder, name, |record| {
        let (code, expected) = expect(record)?;
        let mut told = Vec::new();
        for (column, cell) in header.iter().zip(&expected).filter(|(c, _)| !is_new(c) || record.has(c)) {
            let (expected, found) = (written(column, cell, naming), record.text(column)?);
            if !same(&expected, found) && !same(&expected, &record.plain(column)?) {
                let (line, id) = (record.line(), id(code));
                let (expected, found) = (shown(&expected), shown(found));
                let message =
                    format!("{name}: line {line}, {id}: {column}: expected {expected}, found {found}");
                told.push(Contradiction { code: Some(code), message });
            }
        }
        Ok(told)
    })?;
    Ok(of_rows.into_iter().flatten().collect())
}

/// A cell as a folder writes it.
fn written(column: &str, cell: &Cell, naming: Naming) -> String {
    match column {
        "id" | "code" => naming.apply(cell.text()),
        _ => cell.text(),
    }
}

/// Designs that are missing on the front, that do not belong there, or that are listed twice. Of equal designs the front
/// lists one; results of before, whose tables do not count them, may list any of them.
fn listed(loaded: &Loaded, columns: &Columns, counts_equal: bool) -> Vec<Contradiction> {
    let mut expected = NonDominated::default();
    for (place, row) in loaded.evaluated.iter().enumerate() {
        if row.is_feasible() && row.objectives.len() == columns.objectives.len() {
            expected.offer(place, &row.objectives);
        }
    }
    let expected: BTreeSet<usize> = expected.ids().collect();
    let values = |place: usize| visible(&loaded.evaluated[place].objectives);
    let stands_for =
        |listed: usize, place: usize| listed == place || (!counts_equal && values(listed) == values(place));
    let mut told = Vec::new();
    let mut tell = |place: usize, what: &str| {
        let code = loaded.evaluated[place].code;
        told.push(Contradiction { code: Some(code), message: format!("{PARETO}: {}: {what}", id(code)) });
    };
    let mut listed = BTreeSet::new();
    for &place in &loaded.front {
        if !listed.insert(place) {
            tell(place, "listed a second time");
        } else if !expected.iter().any(|&other| stands_for(place, other)) {
            tell(
                place,
                "not on the front: infeasible, dominated or equal to a design before it, according to history.csv",
            );
        }
    }
    for &place in expected.iter().filter(|&&place| !listed.iter().any(|&other| stands_for(other, place))) {
        tell(place, "missing, but on the front according to history.csv");
    }
    told
}

/// Equal as text or as numbers: `1.0` is `1`.
fn same(a: &str, b: &str) -> bool {
    a == b || matches!((a.parse::<f64>(), b.parse::<f64>()), (Ok(a), Ok(b)) if a == b)
}

fn shown(cell: &str) -> &str {
    if cell.is_empty() { "an empty cell" } else { cell }
}
