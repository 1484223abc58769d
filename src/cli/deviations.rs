//! How far apart the forms of several designs without a surface lie (paper, Figure 21).

use super::compare::Comparison;
use quadrille::geometry::Pattern;
use quadrille::geometry::deviation::{self, Deviation};
use quadrille::output::number::significant;
use quadrille::output::table::Table;
use std::fmt::Write;

/// Deviations of all pairs of designs that have a form.
pub struct Deviations {
    /// For each form its number in the comparison.
    designs: Vec<usize>,
    pairs: Vec<Deviation>,
    /// Mean edge length of all forms, m.
    unit: f64,
}

impl Deviations {
    /// Of all designs of a comparison; `None` on a surface, where all forms are the same, and for fewer than two designs.
    pub fn of(comparison: &Comparison) -> Option<Self> {
        let forms = comparison.entries.iter().enumerate();
        let (designs, patterns): (Vec<usize>, Vec<&Pattern>) =
            forms.filter_map(|(k, entry)| Some((k, entry.form.as_ref()?))).unzip();
        let pairs = deviation::of_pairs(&patterns);
        let unit = deviation::mean_edge(&patterns)?;
        (!pairs.is_empty()).then_some(Self { designs, pairs, unit })
    }

    /// The two designs of a deviation.
    fn names<'a>(&self, comparison: &'a Comparison, deviation: &Deviation) -> [&'a str; 2] {
        deviation.pair.map(|k| comparison.entries[self.designs[k]].name.as_str())
    }

    /// One line a pair.
    pub fn table(&self, comparison: &Comparison) -> Table {
        let mut table = Table::new(["first", "second", "mean_m", "max_m", "mean_per_edge", "max_per_edge"]);
        for deviation in &self.pairs {
            let [first, second] = self.names(comparison, deviation);
            let mut cells = vec![first.into(), second.into()];
            let Deviation { mean, max, .. } = deviation;
            cells.extend([*mean, *max, mean / self.unit, max / self.unit].map(Into::into));
            table.rows.push(cells);
        }
        table
    }

    /// The same for people, with the mean and the largest of all.
    pub fn to_text(&self) -> String {
        let unit = significant(self.unit);
        let mut text =
            format!("\ndistance of the forms, mean and largest, in % of the mean edge length ({unit} m)\n");
        let percent = |length: f64| 100.0 * length / self.unit;
        for Deviation { pair, mean, max } in &self.pairs {
            let [a, b] = pair.map(|k| self.designs[k] + 1);
            let _ = writeln!(text, "  [{a}] – [{b}]  {:>6.1}  {:>6.1}", percent(*mean), percent(*max));
        }
        let mean = self.pairs.iter().map(|d| d.mean).sum::<f64>() / self.pairs.len() as f64;
        let max = self.pairs.iter().map(|d| d.max).fold(0.0, f64::max);
        let _ = writeln!(text, "  all        {:>6.1}  {:>6.1}", percent(mean), percent(max));
        text
    }
}
