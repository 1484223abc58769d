//! `generations.csv`, one row per generation, and `operators.csv`, how each operator fared in it.

use super::designs::Columns;
use super::table::{Cell, Table};
use crate::search::GenerationRow;
use crate::search::operators::OPERATORS;

/// Counts, front and hypervolume, best and mean of each objective (named as in `pareto.csv`).
pub fn generations(rows: &[GenerationRow], columns: &Columns) -> Table {
    let counts = [
        "generation",
        "evaluations",
        "structural_evaluations",
        "feasible",
        "front_size",
        "hypervolume",
        "bred",
        "duplicates_refused",
        "neighbours_refused",
        "rejected_by_topology",
        "cached",
        "immigrants",
        "empty_slots",
    ];
    let objectives = &columns.objectives;
    let best = objectives.iter().map(|name| format!("best_{name}"));
    let mean = objectives.iter().map(|name| format!("mean_{name}"));
    let mut table = Table::new(counts.map(str::to_owned).into_iter().chain(best).chain(mean));
    for row in rows {
        let breeding = &row.breeding;
        let mut cells: Vec<Cell> = vec![
            u64::from(row.generation).into(),
            row.evaluations.into(),
            row.structural.into(),
            row.feasible.into(),
            row.front.into(),
            row.hypervolume.into(),
            breeding.bred.into(),
            breeding.duplicates.into(),
            breeding.neighbours.into(),
            breeding.rejected.into(),
            breeding.cached.into(),
            breeding.immigrants.into(),
            breeding.empty.into(),
        ];
        for values in [&row.best, &row.mean] {
            let value = |i: usize| values.get(i).map(|&value| columns.turned(i, value));
            cells.extend((0..objectives.len()).map(|i| Cell::from(value(i))));
        }
        table.rows.push(cells);
    }
    table
}

/// For each generation and operator: strings it had a part in, and what became of them.
pub fn operators(rows: &[GenerationRow]) -> Table {
    let mut table = Table::new(["generation", "operator", "used", "evaluated", "survived", "entered_front"]);
    for row in rows {
        for (operator, count) in OPERATORS.iter().zip(&row.breeding.operators) {
            table.rows.push(vec![
                u64::from(row.generation).into(),
                operator.name().into(),
                count.used.into(),
                count.evaluated.into(),
                count.survived.into(),
                count.entered_front.into(),
            ]);
        }
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::{Breeding, OperatorCount};

    #[test]
    fn missing_values_are_empty_cells() {
        let breeding = Breeding {
            bred: 60,
            duplicates: 12,
            operators: vec![OperatorCount { used: 5, evaluated: 4, survived: 2, entered_front: 1 }],
            ..Breeding::default()
        };
        let row = GenerationRow {
            evaluations: 48,
            feasible: 3,
            best: vec![1.5],
            breeding,
            ..GenerationRow::default()
        };
        let columns = Columns { objectives: vec!["mass_kg".into()], minimised: 1, metrics: vec![] };
        let table = |columns: &Columns| {
            String::from_utf8(generations(std::slice::from_ref(&row), columns).to_csv()).unwrap()
        };
        let text = table(&columns);
        assert!(text.lines().next().unwrap().ends_with("empty_slots,best_mass_kg,mean_mass_kg"), "{text}");
        assert_eq!(text.lines().nth(1).unwrap(), "0,48,0,3,0,,60,12,0,0,0,0,0,1.5,");
        // What is maximised is kept with the other sign.
        let text = table(&Columns { minimised: 0, ..columns });
        assert_eq!(text.lines().nth(1).unwrap(), "0,48,0,3,0,,60,12,0,0,0,0,0,-1.5,");
        let text = String::from_utf8(operators(&[row]).to_csv()).unwrap();
        assert_eq!(text, "generation,operator,used,evaluated,survived,entered_front\n0,random,5,4,2,1\n");
    }
}
