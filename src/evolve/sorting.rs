//! Fast non-dominated sort (Deb et al. 2002, §III-A).

use super::domination::{Domination, Fitness, compare};

/// Sorts designs into fronts: front 0 is dominated by nobody, front *k* only by members of earlier fronts.
///
/// Returns the fronts as ascending indices into `all`; every index is in exactly one front. O(M·N²).
pub fn fronts(all: &[Fitness]) -> Vec<Vec<usize>> {
    let mut dominates: Vec<Vec<usize>> = vec![Vec::new(); all.len()];
    let mut dominators = vec![0usize; all.len()];
    for (i, a) in all.iter().enumerate() {
        for (j, b) in all.iter().enumerate().skip(i + 1) {
            match compare(a, b) {
                Domination::First => {
                    dominates[i].push(j);
                    dominators[j] += 1;
                }
                Domination::Second => {
                    dominates[j].push(i);
                    dominators[i] += 1;
                }
                Domination::Neither => {}
            }
        }
    }
    let mut fronts = Vec::new();
    let mut current: Vec<usize> = (0..all.len()).filter(|&i| dominators[i] == 0).collect();
    while !current.is_empty() {
        let mut next = Vec::new();
        for &i in &current {
            for &j in &dominates[i] {
                dominators[j] -= 1;
                if dominators[j] == 0 {
                    next.push(j);
                }
            }
        }
        next.sort_unstable();
        fronts.push(std::mem::replace(&mut current, next));
    }
    fronts
}
