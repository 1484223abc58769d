//! Which designs of a large front get a mesh on the page: enough to see it whole, few enough to open at once.

/// Up to `most` rows of a table of objective values (smaller is better; rows of equal length), as ascending indices.
///
/// First the best row of each objective, then, one at a time, the row farthest from all that were taken, in
/// objectives scaled to 0…1 over the table. Rows with a missing value come last. Ties: the earlier row.
pub fn worth_a_mesh(rows: &[Vec<Option<f64>>], most: usize) -> Vec<usize> {
    if rows.len() <= most {
        return (0..rows.len()).collect();
    }
    let scaled = scale(rows);
    let mut taken: Vec<usize> = Vec::new();
    let objectives = rows.first().map_or(0, Vec::len);
    let best =
        |k: usize| (0..scaled.len()).min_by(|&a, &b| key(&scaled[a], k).total_cmp(&key(&scaled[b], k)));
    for row in (0..objectives).filter_map(best) {
        if taken.len() < most && !taken.contains(&row) {
            taken.push(row);
        }
    }
    let mut gap: Vec<f64> = vec![f64::INFINITY; rows.len()];
    let mut seen = 0;
    while taken.len() < most {
        for &t in &taken[seen..] {
            for (row, gap) in gap.iter_mut().enumerate() {
                *gap = gap.min(distance(&scaled[row], &scaled[t]));
            }
        }
        seen = taken.len();
        let farthest =
            (0..rows.len()).filter(|r| !taken.contains(r)).rev().max_by(|&a, &b| gap[a].total_cmp(&gap[b]));
        let Some(farthest) = farthest else { break };
        taken.push(farthest);
    }
    taken.sort_unstable();
    taken
}

type Scaled = Option<Vec<f64>>;

fn key(row: &Scaled, objective: usize) -> f64 {
    row.as_ref().map_or(f64::INFINITY, |r| r[objective])
}

/// Squared; −1 from or to a row that cannot be compared, so that it comes last.
fn distance(a: &Scaled, b: &Scaled) -> f64 {
    match (a, b) {
        (Some(a), Some(b)) => a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum(),
        (None, _) => -1.0,
        (_, None) => f64::INFINITY,
    }
}

fn scale(rows: &[Vec<Option<f64>>]) -> Vec<Scaled> {
    let complete: Vec<Scaled> =
        rows.iter().map(|r| r.iter().map(|v| v.filter(|v| v.is_finite())).collect()).collect();
    let width = rows.first().map_or(0, Vec::len);
    let range = |k: usize| {
        let column = || complete.iter().flatten().map(|r| r[k]);
        (column().fold(f64::INFINITY, f64::min), column().fold(f64::NEG_INFINITY, f64::max))
    };
    let ranges: Vec<(f64, f64)> = (0..width).map(range).collect();
    let unit =
        |(v, &(low, high)): (&f64, &(f64, f64))| if high > low { (v - low) / (high - low) } else { 0.0 };
    complete.iter().map(|row| row.as_ref().map(|r| r.iter().zip(&ranges).map(unit).collect())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(pairs: &[[f64; 2]]) -> Vec<Vec<Option<f64>>> {
        pairs.iter().map(|p| p.iter().map(|&v| Some(v)).collect()).collect()
    }

    #[test]
    fn a_small_front_is_taken_whole() {
        assert_eq!(worth_a_mesh(&rows(&[[1.0, 2.0], [2.0, 1.0]]), 2), [0, 1]);
    }

    #[test]
    fn the_ends_come_first_and_then_the_widest_gaps() {
        let front = rows(&[[0.0, 10.0], [1.0, 9.0], [5.0, 5.0], [6.0, 4.0], [10.0, 0.0]]);
        assert_eq!(worth_a_mesh(&front, 2), [0, 4]);
        assert_eq!(worth_a_mesh(&front, 3), [0, 2, 4]);
    }

    #[test]
    fn rows_without_all_values_come_last() {
        let mut front = rows(&[[0.0, 10.0], [5.0, 5.0], [10.0, 0.0], [4.0, 4.0]]);
        front[3][1] = None;
        assert_eq!(worth_a_mesh(&front, 3), [0, 1, 2]);
    }
}
