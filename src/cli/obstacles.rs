//! What keeps designs from being feasible, in a sentence.

use quadrille::search::EvaluatedRow;
use std::collections::BTreeMap;

/// The limits and requirements exceeded and the other failures, most frequent first, each with the number of designs;
/// a design may count under several.
pub fn obstacles(evaluated: &[EvaluatedRow]) -> Vec<(String, usize)> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for row in evaluated.iter().filter(|row| !row.is_feasible()) {
        match row.violation.stage {
            1 => row
                .reason
                .split("; ")
                .filter_map(|clause| clause.split_whitespace().next())
                .for_each(|limit| *counts.entry(limit).or_default() += 1),
            stage => *counts.entry(failure(stage)).or_default() += 1,
        }
    }
    let mut sorted: Vec<(String, usize)> = counts.into_iter().map(|(name, n)| (name.to_owned(), n)).collect();
    sorted.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
    sorted
}

/// RUN "Failures are data".
fn failure(stage: u8) -> &'static str {
    match stage {
        2 => "unstable or a mechanism",
        3 => "folds",
        4 => "pinched or flat faces",
        5 => "too many faces",
        _ => "failed",
    }
}

/// The sentence, for a run without a feasible design.
pub fn sentence(evaluated: &[EvaluatedRow]) -> String {
    let counted: Vec<String> =
        obstacles(evaluated).iter().take(5).map(|(name, count)| format!("{name} {count}")).collect();
    format!(
        "no feasible design was found; of {} designs fail: {}. history.csv says how far each one is from its limits, \
         which [pattern.limits] and [[structure.requirement]] set",
        evaluated.len(),
        counted.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use quadrille::evolve::Violation;
    use quadrille::mesh::Code;

    fn row(stage: u8, reason: &str) -> EvaluatedRow {
        EvaluatedRow {
            generation: 0,
            slot: 0,
            tokens: Default::default(),
            expressed: Default::default(),
            code: Code(0),
            violation: Violation { stage, measure: 1.0 },
            reason: reason.into(),
            objectives: Vec::new().into(),
            metrics: Vec::new().into_iter().collect(),
            structural: false,
        }
    }

    #[test]
    fn every_limit_of_a_design_counts() {
        let rows = [
            row(0, ""),
            row(1, "min_edge_m 0.1 (limit 0.5); min_angle_deg 3 (limit 20)"),
            row(1, "min_angle_deg 4 (limit 20)"),
            row(3, "7 of 300 panels folded"),
        ];
        let expected = [("min_angle_deg", 2), ("folds", 1), ("min_edge_m", 1)];
        assert_eq!(obstacles(&rows), expected.map(|(name, count)| (name.to_owned(), count)));
        assert!(sentence(&rows).contains("of 4 designs fail: min_angle_deg 2, folds 1, min_edge_m 1."));
    }
}
