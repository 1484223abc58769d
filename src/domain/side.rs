//! The sides of the boundary, from corner to corner, as seen from a point in plan.

use super::curve::closest_on_segment;
use super::params::Symmetry;
use super::{BoundaryLoop, Domain};

/// A side: its loop, and how many corners of the loop come before its first.
pub type Side = (usize, usize);

impl Domain {
    /// Distance of a point in plan from every side, m, the closest first. A loop with fewer than two corners is one side.
    pub fn sides_from(&self, point: [f64; 2]) -> Vec<(f64, Side)> {
        let spacing = self.size() / 200.0;
        let loops = self.loops.iter().enumerate();
        let mut sides: Vec<(f64, Side)> =
            loops.flat_map(|(l, curve)| from_loop(l, curve, spacing, point)).collect();
        sides.sort_by(|a, b| a.0.total_cmp(&b.0));
        sides
    }

    /// Image of a point in plan under a symmetry, about the middle of the bounding box.
    pub fn plan_image(&self, [x, y]: [f64; 2], kind: Symmetry) -> [f64; 2] {
        let [x, y, _] = self.image([x, y, 0.0], kind);
        [x, y]
    }
}

fn from_loop(label: usize, curve: &BoundaryLoop, spacing: f64, point: [f64; 2]) -> Vec<(f64, Side)> {
    let cuts = match curve.corners() {
        [] | [_] => vec![0.0],
        corners => corners.to_vec(),
    };
    let mut stations = curve.sample(spacing);
    stations.extend(&cuts);
    stations.sort_by(f64::total_cmp);
    stations.dedup();
    let places: Vec<[f64; 3]> = stations.iter().map(|&s| curve.point(s)).collect();
    let mut least = vec![f64::INFINITY; cuts.len()];
    for (i, &s) in stations.iter().enumerate() {
        // The piece from this station to the next; what comes before the first corner belongs to the last side.
        let side = cuts.partition_point(|c| *c <= s).checked_sub(1).unwrap_or(cuts.len() - 1);
        let distance2 =
            closest_on_segment([point[0], point[1], 0.0], places[i], places[(i + 1) % places.len()], 2).0;
        least[side] = least[side].min(distance2.sqrt());
    }
    least.into_iter().enumerate().map(|(k, distance)| (distance, (label, k))).collect()
}
