//! Designs grouped into a handful of families: by topological distance, where their singularities alone make too many.

use crate::mesh::canonical::Code;
use crate::mesh::distance::deletions;
use crate::mesh::{Equivalence, QuadMesh};
use crate::search::thread_pool;
use rayon::prelude::*;

/// Most families: as many as a reader tells apart, and as there are colours.
pub(super) const HANDFUL: usize = 6;
/// Strips deleted from each of two designs to find what they have in common.
const DEPTH: usize = 2;
/// The distance of designs that have nothing in common at that depth.
const FAR: f64 = 2.0 * DEPTH as f64 + 1.0;

/// The family of each design, numbered from 0, the largest family first.
pub(super) fn families(meshes: &[QuadMesh]) -> Vec<usize> {
    let reached = |mesh: &QuadMesh| -> Vec<(Code, u32)> {
        deletions(mesh, DEPTH, Equivalence::default()).into_iter().collect()
    };
    // Without threads it takes longer.
    let sets: Vec<_> = match thread_pool(0) {
        Ok(pool) => pool.install(|| meshes.par_iter().map(reached).collect()),
        Err(_) => meshes.iter().map(reached).collect(),
    };
    cluster(sets.len(), |a, b| apart(&sets[a], &sets[b]))
}

/// Fewest strips deleted from both designs until they are the same, of the depths known; both lists ascending.
fn apart(a: &[(Code, u32)], b: &[(Code, u32)]) -> f64 {
    let (mut i, mut j, mut least) = (0, 0, FAR);
    while let (Some((code_a, depth_a)), Some((code_b, depth_b))) = (a.get(i), b.get(j)) {
        match code_a.cmp(code_b) {
            std::cmp::Ordering::Less => i += 1,
            std::cmp::Ordering::Greater => j += 1,
            std::cmp::Ordering::Equal => {
                least = least.min(f64::from(depth_a + depth_b));
                (i, j) = (i + 1, j + 1);
            }
        }
    }
    least
}

/// Joins the two nearest groups, by the mean distance of their members, until a [`HANDFUL`] is left (average linkage,
/// Sokal & Michener 1958). Of equally near pairs the one with the fewest members is joined, so that no group swallows
/// all that are far from everything; then the earliest.
fn cluster(count: usize, distance: impl Fn(usize, usize) -> f64) -> Vec<usize> {
    let mut groups: Vec<Vec<usize>> = (0..count).map(|design| vec![design]).collect();
    let mut mean: Vec<Vec<f64>> =
        (0..count).map(|a| (0..count).map(|b| if a == b { 0.0 } else { distance(a, b) }).collect()).collect();
    while groups.len() > HANDFUL {
        let mut nearest = (f64::INFINITY, usize::MAX, 0, 0);
        for b in 1..groups.len() {
            for a in 0..b {
                let candidate = (mean[a][b], groups[a].len() + groups[b].len(), a, b);
                if candidate.0 < nearest.0 || (candidate.0 == nearest.0 && candidate.1 < nearest.1) {
                    nearest = candidate;
                }
            }
        }
        let (_, size, a, b) = nearest;
        let [share_a, share_b] = [a, b].map(|group| groups[group].len() as f64 / size as f64);
        let joined: Vec<f64> =
            (0..groups.len()).map(|c| share_a * mean[a][c] + share_b * mean[b][c]).collect();
        for (c, &value) in joined.iter().enumerate() {
            (mean[a][c], mean[c][a]) = (value, value);
        }
        mean[a][a] = 0.0;
        mean.remove(b);
        for row in &mut mean {
            row.remove(b);
        }
        let members = groups.remove(b);
        groups[a].extend(members);
    }
    groups.sort_by_key(|group| (std::cmp::Reverse(group.len()), group.iter().min().copied()));
    let mut family = vec![0; count];
    for (number, group) in groups.iter().enumerate() {
        group.iter().for_each(|&design| family[design] = number);
    }
    family
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_near_is_in_one_family() {
        // Eight places on a line, three of them crowds.
        let places: Vec<f64> = [0, 0, 1, 50, 51, 100, 100, 101, 200, 300, 400].map(f64::from).into();
        let family = cluster(places.len(), |a, b| (places[a] - places[b]).abs());
        assert_eq!(family, [0, 0, 0, 2, 2, 1, 1, 1, 3, 4, 5]);
    }

    #[test]
    fn a_handful_stays_as_it_is_and_what_is_far_from_all_is_shared_out() {
        assert_eq!(cluster(HANDFUL, |_, _| FAR), [0, 1, 2, 3, 4, 5]);
        let family = cluster(4 * HANDFUL, |_, _| FAR);
        for number in 0..HANDFUL {
            assert!(family.iter().filter(|&&f| f == number).count() <= 8, "{family:?}");
        }
    }

    #[test]
    fn distance_is_the_fewest_deletions_to_something_common() {
        let code = |bits: u128| Code(bits);
        assert_eq!(apart(&[(code(1), 0), (code(2), 1)], &[(code(2), 1), (code(3), 0)]), 2.0);
        assert_eq!(apart(&[(code(1), 0)], &[(code(1), 0)]), 0.0);
        assert_eq!(apart(&[(code(1), 0)], &[(code(3), 0)]), FAR);
    }
}
