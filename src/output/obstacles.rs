//! What keeps designs from being feasible: counted, in words, and the designs that come nearest.

use crate::evolve::Violation;
use crate::search::EvaluatedRow;
use std::collections::BTreeMap;

/// How many of the nearest misses are drawn where nothing is feasible.
const MISSES: usize = 12;
/// The last stage at which a design has a pattern to draw: folds (docs/reference/search.md §1.2).
const DRAWN: u8 = 3;

/// Counts of designs and of what they exceed; a design may count under several limits.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Obstacles {
    counts: BTreeMap<String, u64>,
    designs: u64,
    feasible: u64,
}

impl Obstacles {
    /// Of all these designs.
    pub fn of(evaluated: &[EvaluatedRow]) -> Self {
        let mut obstacles = Self::default();
        for row in evaluated {
            obstacles.add(row.violation, &row.reason);
        }
        obstacles
    }

    /// Counts one design more.
    pub fn add(&mut self, violation: Violation, reason: &str) {
        self.designs += 1;
        match violation.stage {
            0 => self.feasible += 1,
            1 => {
                for limit in reason.split("; ").filter_map(|clause| clause.split_whitespace().next()) {
                    *self.counts.entry(limit.to_owned()).or_default() += 1;
                }
            }
            stage => *self.counts.entry(failure(stage).to_owned()).or_default() += 1,
        }
    }

    /// The limits and requirements exceeded and the other failures, most frequent first, each with the number of designs.
    pub fn counted(&self) -> Vec<(String, u64)> {
        let mut sorted: Vec<(String, u64)> =
            self.counts.iter().map(|(name, &count)| (name.clone(), count)).collect();
        sorted.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
        sorted
    }

    /// The most frequent ones in a phrase: `min_angle_deg 20, max_valence 3`.
    fn phrase(&self) -> String {
        let counted: Vec<String> =
            self.counted().iter().take(5).map(|(name, count)| format!("{name} {count}")).collect();
        counted.join(", ")
    }

    /// What is said after the first generation.
    pub fn first_generation(&self) -> String {
        let Self { designs, feasible, .. } = self;
        match self.counts.is_empty() {
            true => format!("first generation: {feasible} of {designs} designs feasible"),
            false => format!(
                "first generation: {feasible} of {designs} designs feasible; the others exceed or fail by: {} (one design \
                 may count several times)",
                self.phrase()
            ),
        }
    }

    /// What is said of a run without a feasible design.
    pub fn none_feasible(&self) -> String {
        format!(
            "no feasible design was found; of {} designs fail: {}. history.csv says how far each one is from its limits, \
             which [pattern.limits] and [[structure.requirement]] set; report.html shows the nearest misses",
            self.designs,
            self.phrase()
        )
    }
}

/// How the initial mesh stands, in words.
pub fn initial_mesh(violation: Violation, reason: &str) -> String {
    match violation.stage {
        0 => "the initial mesh is feasible".into(),
        1 => format!("the initial mesh exceeds {reason}"),
        _ => format!("the initial mesh fails: {reason}"),
    }
}

/// docs/reference/search.md §1.2.
fn failure(stage: u8) -> &'static str {
    match stage {
        2 => "unstable or a mechanism",
        3 => "folds or vertices on one place",
        4 => "refused by topology",
        5 => "too many faces",
        _ => "failed",
    }
}

/// Where nothing is feasible: the designs beside the initial mesh that come nearest, the nearest first, as far as they have a
/// pattern to draw. Otherwise none.
pub fn nearest_misses(evaluated: &[EvaluatedRow]) -> Vec<usize> {
    if evaluated.iter().any(EvaluatedRow::is_feasible) {
        return Vec::new();
    }
    let drawn = |&place: &usize| {
        let row = &evaluated[place];
        row.violation.stage <= DRAWN && !row.expressed.is_empty()
    };
    let mut misses: Vec<usize> = (0..evaluated.len()).filter(drawn).collect();
    misses.sort_by(|&a, &b| {
        let [a, b] = [a, b].map(|place| &evaluated[place].violation);
        a.stage.cmp(&b.stage).then(a.measure.total_cmp(&b.measure))
    });
    misses.truncate(MISSES);
    misses
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Code;

    fn row(stage: u8, measure: f64, reason: &str) -> EvaluatedRow {
        EvaluatedRow {
            generation: 0,
            slot: 0,
            tokens: Default::default(),
            expressed: "ATTA".parse().unwrap(),
            code: Code(0),
            symmetries: crate::mesh::Symmetries::default(),
            violation: Violation { stage, measure },
            reason: reason.into(),
            objectives: Vec::new().into(),
            metrics: Vec::new().into_iter().collect(),
            governing: Box::default(),
            structural: false,
        }
    }

    #[test]
    fn every_limit_of_a_design_counts() {
        let rows = [
            row(0, 0.0, ""),
            row(1, 1.0, "min_edge_m 0.1 (limit 0.5); min_angle_deg 3 (limit 20)"),
            row(1, 1.0, "min_angle_deg 4 (limit 20)"),
            row(3, 1.0, "7 of 300 panels folded"),
        ];
        let obstacles = Obstacles::of(&rows);
        let expected = [("min_angle_deg", 2), ("folds or vertices on one place", 1), ("min_edge_m", 1)];
        assert_eq!(obstacles.counted(), expected.map(|(name, count)| (name.to_owned(), count)));
        assert!(
            obstacles.none_feasible().contains(
                "of 4 designs fail: min_angle_deg 2, folds or vertices on one place 1, min_edge_m 1."
            )
        );
        let first = obstacles.first_generation();
        assert!(first.starts_with("first generation: 1 of 4 designs feasible; "), "{first}");
        assert!(
            first.contains("min_angle_deg 2, folds or vertices on one place 1, min_edge_m 1 "),
            "{first}"
        );
    }

    #[test]
    fn the_nearest_misses_are_those_of_the_earliest_stage_and_least_measure() {
        let mut rows = vec![
            row(3, 0.1, "folds"),
            row(1, 0.7, "far"),
            row(4, 1.0, "pinched"),
            row(1, 0.2, "near"),
            row(2, 1.0, "mechanism"),
            row(1, 0.1, "the initial mesh"),
        ];
        rows[5].expressed = Default::default();
        assert_eq!(nearest_misses(&rows), [3, 1, 4, 0]);
        rows.push(row(0, 0.0, ""));
        assert!(nearest_misses(&rows).is_empty());
        assert_eq!(nearest_misses(&vec![row(1, 1.0, ""); 40]).len(), MISSES);
    }
}
