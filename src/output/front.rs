//! `pareto.csv`: the designs of the front, and what only a front can say of them (docs/reference/files.md §2.1).

use super::designs::Columns;
use super::table::{Cell, Table};
use crate::evolve::{Preference, visible};
use crate::mesh::canonical::Code;
use crate::search::{EvaluatedRow, ObjectivesParams};
use std::collections::HashMap;

/// The last columns of `pareto.csv`.
pub(super) const LAST: [&str; 2] = ["equal_designs", "preferred"];

/// What a front tells of its designs. The maps are only looked up.
#[derive(Debug, Default)]
pub struct Standing {
    /// How many feasible designs have these objectives, to six digits.
    equal: HashMap<Vec<u64>, u64>,
    /// The place of each design of the front by what the config prefers.
    preferred: HashMap<Code, u64>,
}

impl Standing {
    /// Of a front, given by places in all evaluated designs.
    pub fn of(evaluated: &[EvaluatedRow], front: &[usize], objectives: &ObjectivesParams) -> Self {
        let mut equal = HashMap::new();
        for row in evaluated.iter().filter(|row| row.is_feasible()) {
            *equal.entry(key(row)).or_insert(0) += 1;
        }
        let front: Vec<&EvaluatedRow> = sorted(front.iter().map(|&place| &evaluated[place]));
        let places = preferred(&front, objectives).unwrap_or_default();
        let preferred = front.iter().zip(places).map(|(row, place)| (row.code, place as u64)).collect();
        Self { equal, preferred }
    }

    /// How many evaluated designs have the same objectives to six digits, itself included.
    pub fn equal_designs(&self, row: &EvaluatedRow) -> u64 {
        self.equal.get(&key(row)).copied().unwrap_or(1)
    }

    /// Its place on the front, from 1, by weights and aspiration of the config; none without these.
    pub fn preferred(&self, row: &EvaluatedRow) -> Option<u64> {
        self.preferred.get(&row.code).copied()
    }

    /// The cells that a design has in `pareto.csv` only.
    pub(super) fn cells(&self, row: &EvaluatedRow) -> [Cell; 2] {
        [self.equal_designs(row).into(), self.preferred(row).map_or(Cell::Empty, Cell::from)]
    }
}

fn key(row: &EvaluatedRow) -> Vec<u64> {
    visible(&row.objectives).into_iter().map(f64::to_bits).collect()
}

/// The places of the front's designs by what the config prefers; `None` where it says nothing. Objectives are compared in the
/// axes of the config, or else in those that the front spans.
fn preferred(front: &[&EvaluatedRow], params: &ObjectivesParams) -> Option<Vec<usize>> {
    let count = params.count();
    let points: Vec<&[f64]> = front.iter().map(|row| &*row.objectives).filter(|f| f.len() == count).collect();
    if (params.weights.is_empty() && params.aspiration.is_empty()) || points.len() < front.len() {
        return None;
    }
    let [given_ideal, given_reference, aspiration] =
        [&params.ideal, &params.reference, &params.aspiration].map(|given| params.turned(given));
    let extreme = |m: usize, pick: fn(f64, f64) -> f64| points.iter().map(|f| f[m]).reduce(pick);
    let axis = |given: &[f64], pick| {
        (0..count).map(|m| given.get(m).copied().or_else(|| extreme(m, pick))).collect::<Option<Vec<f64>>>()
    };
    let (ideal, reference) = (axis(&given_ideal, f64::min)?, axis(&given_reference, f64::max)?);
    let length = |(low, high): (&f64, &f64)| if high > low { high - low } else { 1.0 };
    let lengths: Vec<f64> = ideal.iter().zip(&reference).map(length).collect();
    let weights = if params.weights.is_empty() { vec![1.0; count] } else { params.weights.clone() };
    let aspiration = if aspiration.is_empty() { &ideal } else { &aspiration };
    Some(Preference { aspiration, weights: &weights, lengths: &lengths }.places(&points))
}

/// Ordered by objectives, the first one first, and by code where all are equal.
fn sorted<'a>(front: impl Iterator<Item = &'a EvaluatedRow>) -> Vec<&'a EvaluatedRow> {
    let mut rows: Vec<&EvaluatedRow> = front.collect();
    rows.sort_by(|a, b| {
        let pairs = a.objectives.iter().zip(&b.objectives);
        let by_objectives = pairs.map(|(x, y)| x.total_cmp(y)).find(|order| order.is_ne());
        by_objectives.unwrap_or(std::cmp::Ordering::Equal).then(a.code.cmp(&b.code))
    });
    rows
}

/// The front, ordered by objectives, the first one first, and by code where all are equal.
pub fn pareto(front: &[&EvaluatedRow], standing: &Standing, columns: &Columns) -> Table {
    let mut table = Table::new(columns.front_header());
    let cells = |row| [columns.cells(row), standing.cells(row).into()].concat();
    table.rows = sorted(front.iter().copied()).into_iter().map(cells).collect();
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
        let evaluated = [b.clone(), a.clone(), image, failed];
        let mut objectives =
            ObjectivesParams { minimise: vec!["mass".into(), "curvature".into()], ..Default::default() };
        let standing = Standing::of(&evaluated, &[0, 1], &objectives);
        let text = String::from_utf8(pareto(&[&a, &b], &standing, &columns()).to_csv()).unwrap();
        assert_eq!(
            text,
            "id,string,expressed,code,symmetry,generation,feasible,mass_kg,curvature,buckling_factor,\
             deflection_combination,utilisation_combination,buckling_combination,deflection_vertical_combination,\
             utilisation_all_combination,utilisation_von_mises_combination,uplift_combination,\
             support_slide_combination,equal_designs,preferred\n\
             q000000000000,\"\",\"\",q0000000000000002,,3,true,1.5,1,,,,,,,,,,1,\n\
             q000000000000,ATA,ATA,q0000000000000001,,3,true,2,0.5,,sls,uls,,,,,,,2,\n"
        );
        objectives.weights = vec![1.0, 10.0];
        let standing = Standing::of(&evaluated, &[0, 1], &objectives);
        assert_eq!([&b, &a].map(|row| standing.preferred(row)), [Some(2), Some(1)]);
        (objectives.weights, objectives.aspiration) = (vec![], vec![1.4, 2.0]);
        let standing = Standing::of(&evaluated, &[0, 1], &objectives);
        assert_eq!([&b, &a].map(|row| standing.preferred(row)), [Some(1), Some(2)]);
    }
}
