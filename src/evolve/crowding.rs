//! Crowding distance (Deb et al. 2002, §III-B).

/// The crowding distance of every point of one front, in the order given.
///
/// For each objective the points are sorted (stably, without touching the caller's order); the two ends get ∞, the
/// others the gap between their neighbours divided by the range. An objective without range adds nothing. Fronts of
/// one or two points are all ends.
pub fn crowding_distance(front: &[&[f64]]) -> Vec<f64> {
    let n = front.len();
    let mut distance = vec![0.0; n];
    let objectives = front.first().map_or(0, |point| point.len());
    let mut order: Vec<usize> = (0..n).collect();
    let columns = (0..objectives).map(|m| front.iter().map(|point| point[m]).collect::<Vec<f64>>());
    for value in columns {
        order.sort_by(|&a, &b| value[a].total_cmp(&value[b]).then(a.cmp(&b)));
        let (first, last) = (order[0], order[n - 1]);
        distance[first] = f64::INFINITY;
        distance[last] = f64::INFINITY;
        let range = value[last] - value[first];
        if range > 0.0 {
            for triple in order.windows(3) {
                distance[triple[1]] += (value[triple[2]] - value[triple[0]]) / range;
            }
        }
    }
    distance
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_four_points() {
        let points: Vec<[f64; 2]> = vec![[0.0, 4.0], [4.0, 0.0], [1.0, 2.0], [3.0, 1.0]];
        let front: Vec<&[f64]> = points.iter().map(|p| p.as_slice()).collect();
        let d = crowding_distance(&front);
        assert_eq!(d[0], f64::INFINITY);
        assert_eq!(d[1], f64::INFINITY);
        assert_eq!(d[2], 3.0 / 4.0 + 3.0 / 4.0);
        assert_eq!(d[3], 3.0 / 4.0 + 2.0 / 4.0);
    }

    #[test]
    fn of_nothing_and_of_equal_points() {
        assert!(crowding_distance(&[]).is_empty());
        let same = [1.0, 1.0];
        let d = crowding_distance(&[&same, &same, &same]);
        assert_eq!(d, [f64::INFINITY, 0.0, f64::INFINITY]);
    }
}
