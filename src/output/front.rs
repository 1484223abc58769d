//! `pareto.csv`: the designs of the front, and what only a front can say of them (docs/reference/files.md §2.1).

use super::designs::Columns;
use super::table::{Cell, Table};
use crate::evolve::visible;
use crate::search::EvaluatedRow;
use std::collections::HashMap;

/// The last columns of `pareto.csv`.
pub(super) const LAST: [&str; 1] = ["equal_designs"];

/// What a front tells of its designs.
#[derive(Debug)]
pub struct Standing {
    /// How many feasible designs have these objectives, to six digits. Only looked up.
    equal: HashMap<Vec<u64>, u64>,
}

impl Standing {
    /// Of the front among all evaluated designs.
    pub fn of(evaluated: &[EvaluatedRow]) -> Self {
        let mut equal = HashMap::new();
        for row in evaluated.iter().filter(|row| row.is_feasible()) {
            *equal.entry(key(row)).or_insert(0) += 1;
        }
        Self { equal }
    }

    /// How many evaluated designs have the same objectives to six digits, itself included.
    pub fn equal_designs(&self, row: &EvaluatedRow) -> u64 {
        self.equal.get(&key(row)).copied().unwrap_or(1)
    }

    /// The cells that a design has in `pareto.csv` only.
    pub(super) fn cells(&self, row: &EvaluatedRow) -> [Cell; 1] {
        [self.equal_designs(row).into()]
    }
}

fn key(row: &EvaluatedRow) -> Vec<u64> {
    visible(&row.objectives).into_iter().map(f64::to_bits).collect()
}

/// The front, ordered by objectives, the first one first, and by code where all are equal.
pub fn pareto(front: &[&EvaluatedRow], standing: &Standing, columns: &Columns) -> Table {
    let mut rows: Vec<&EvaluatedRow> = front.to_vec();
    rows.sort_by(|a, b| {
        let pairs = a.objectives.iter().zip(&b.objectives);
        let by_objectives = pairs.map(|(x, y)| x.total_cmp(y)).find(|order| order.is_ne());
        by_objectives.unwrap_or(std::cmp::Ordering::Equal).then(a.code.cmp(&b.code))
    });
    let mut table = Table::new(columns.front_header());
    table.rows =
        rows.into_iter().map(|row| [columns.cells(row), standing.cells(row).into()].concat()).collect();
    table
}

#[cfg(test)]
mod tests {
    use super::super::designs::tests::{columns, row};
    use super::*;
    use crate::evolve::Violation;

    #[test]
    fn pareto_is_sorted_and_has_the_promised_columns() {
        let (mut a, b) =
            (row(1, "ATA", &[2.0, 0.5], Violation::NONE), row(2, "", &[1.5, 1.0], Violation::NONE));
        let image = row(3, "TATA", &[2.000_000_1, 0.5], Violation::NONE);
        let failed = row(4, "D", &[2.0, 0.5], Violation::new(1, 0.1));
        a.governing = ["sls", "uls", ""].map(Box::from).into();
        let standing = Standing::of(&[b.clone(), a.clone(), image, failed]);
        let text = String::from_utf8(pareto(&[&a, &b], &standing, &columns()).to_csv()).unwrap();
        assert_eq!(
            text,
            "id,string,expressed,code,symmetry,generation,feasible,mass_kg,curvature,buckling_factor,\
             deflection_combination,utilisation_combination,buckling_combination,equal_designs\n\
             q000000000000,\"\",\"\",q0000000000000002,,3,true,1.5,1,,,,,1\n\
             q000000000000,ATA,ATA,q0000000000000001,,3,true,2,0.5,,sls,uls,,2\n"
        );
    }
}
