//! `design_explorer/data.csv`: the front as Design Explorer reads it (`in:` and `out:` columns, units in brackets).

use super::designs::id;
use super::table::{Cell, Table};
use crate::search::EvaluatedRow;

/// A column of numbers: its metric, and its name with the unit in brackets.
pub struct Column {
    /// Place in the registry of metrics.
    pub metric: usize,
    /// Such as `mass[kg]`.
    pub name: String,
}

/// One row per design: inputs that tell its topology, outputs, and the picture in the same folder.
///
/// Design Explorer draws axes for numbers; the string is an input by its length and its counts of rules.
pub fn design_explorer(front: &[&EvaluatedRow], inputs: &[Column], outputs: &[Column]) -> Table {
    let head =
        ["in:tokens".to_owned()].into_iter().chain(inputs.iter().map(|column| format!("in:{}", column.name)));
    let tail = outputs.iter().map(|column| format!("out:{}", column.name)).chain(["img".to_owned()]);
    let mut table = Table::new(head.chain(tail));
    for row in front {
        let mut cells = vec![Cell::from(row.expressed.len() as u64)];
        let value = |column: &Column| Cell::from(row.metrics.get(column.metric));
        cells.extend(inputs.iter().chain(outputs).map(value));
        cells.push(picture(row).into());
        table.rows.push(cells);
    }
    table
}

/// Name of a design's picture.
pub fn picture(row: &EvaluatedRow) -> String {
    format!("{}.svg", id(row.code))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evolve::Violation;
    use crate::output::designs::tests::row;

    #[test]
    fn columns_are_prefixed() {
        let design = row(0xabc << 52, "ATTA", &[1e6, 0.125], Violation::NONE);
        let column = |metric, name: &str| Column { metric, name: name.into() };
        let table = design_explorer(&[&design], &[column(0, "strips")], &[column(2, "mass[kg]")]);
        let text = String::from_utf8(table.to_csv()).unwrap();
        assert_eq!(text, "in:tokens,in:strips,out:mass[kg],img\n4,0.125,1000000,qabc000000000.svg\n");
    }
}
