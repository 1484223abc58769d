//! Who breeds and who survives: binary tournament and (μ+λ) truncation (Deb et al. 2002, §III-B, III-C).

use std::cmp::Ordering;

use super::contribution::Contributions;
use super::crowding::crowding_distance;
use super::domination::Fitness;
use super::sorting::fronts;
use crate::random::{Rng, below};

/// The place of a design in its population.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Standing {
    /// Number of its front, 0 the best.
    pub rank: usize,
    /// Crowding distance within its front; larger is better.
    pub crowding: f64,
}

impl Standing {
    /// The crowded-comparison order: lower rank first, then the less crowded.
    pub fn crowded_cmp(&self, other: &Self) -> Ordering {
        self.rank.cmp(&other.rank).then(other.crowding.total_cmp(&self.crowding))
    }
}

/// Rank and crowding distance of every design, in the order given.
pub fn standings(all: &[Fitness]) -> Vec<Standing> {
    let mut standings = vec![Standing { rank: 0, crowding: 0.0 }; all.len()];
    for (rank, front) in fronts(all).iter().enumerate() {
        for (&i, crowding) in front.iter().zip(front_crowding(all, front)) {
            standings[i] = Standing { rank, crowding };
        }
    }
    standings
}

/// Crowding within one front; a front of infeasible designs has equal violations, and its objectives say nothing.
fn front_crowding(all: &[Fitness], front: &[usize]) -> Vec<f64> {
    match feasible_points(all, front) {
        Some(points) => crowding_distance(&points),
        None => vec![0.0; front.len()],
    }
}

/// The objectives of one front; `None` for a front of infeasible designs.
fn feasible_points<'a>(all: &'a [Fitness], front: &[usize]) -> Option<Vec<&'a [f64]>> {
    let point = |&i: &usize| all[i].violation.is_feasible().then_some(all[i].objectives.as_slice());
    front.iter().map(point).collect()
}

/// Binary tournament: of two different members drawn at random, the better by the crowded comparison; of two equal
/// ones, the first drawn. `None` when there is nobody.
pub fn tournament(standings: &[Standing], rng: &mut Rng) -> Option<usize> {
    match standings.len() {
        0 => None,
        1 => Some(0),
        n => {
            let a = below(rng, n);
            let b = (a + 1 + below(rng, n - 1)) % n;
            let winner = if standings[b].crowded_cmp(&standings[a]).is_lt() { b } else { a };
            Some(winner)
        }
    }
}

/// (μ+λ) survival: the best `mu` of `all`, whole fronts first, the last one cut by crowding distance.
///
/// Returns ascending indices, all of them when there are no more than `mu`. Ties go to the earlier index.
pub fn survive(all: &[Fitness], mu: usize) -> Vec<usize> {
    survive_with(all, mu, |front, room| {
        let mut by_crowding: Vec<(f64, usize)> = front_crowding(all, &front).into_iter().zip(front).collect();
        by_crowding.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        by_crowding.into_iter().take(room).map(|(_, i)| i).collect()
    })
}

/// As [`survive`], but from the last front goes, one at a time, the design that adds least to its hypervolume before
/// `reference` (Beume, Naujoks and Emmerich 2007, doi:10.1016/j.ejor.2006.08.008); of those that add alike the most crowded.
///
/// With many objectives most designs are non-dominated, and crowding distance does not tell good from bad.
pub fn survive_by_contribution(all: &[Fitness], mu: usize, reference: &[f64]) -> Vec<usize> {
    survive_with(all, mu, |mut front, room| {
        let Some(points) = feasible_points(all, &front) else {
            front.truncate(room);
            return front;
        };
        let crowding = crowding_distance(&points);
        let mut contributions = Contributions::new(&points, reference);
        let mut left: Vec<usize> = (0..front.len()).collect();
        while left.len() > room {
            let order = |&a: &usize, &b: &usize| {
                let (x, y) = (contributions.of(a), contributions.of(b));
                x.cmp(&y).then(crowding[a].total_cmp(&crowding[b])).then(b.cmp(&a))
            };
            let Some(least) = left.iter().copied().min_by(order) else { break };
            contributions.remove(least);
            left.retain(|&k| k != least);
        }
        left.into_iter().map(|k| front[k]).collect()
    })
}

/// Whole fronts while there is room, then what `cut` leaves of the next one; ascending indices.
fn survive_with(all: &[Fitness], mu: usize, cut: impl Fn(Vec<usize>, usize) -> Vec<usize>) -> Vec<usize> {
    let mut survivors = Vec::with_capacity(mu.min(all.len()));
    for front in fronts(all) {
        let room = mu - survivors.len();
        if front.len() > room {
            survivors.extend(cut(front, room));
            break;
        }
        survivors.extend(front);
    }
    survivors.sort_unstable();
    survivors
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evolve::{FAILED, Violation};
    use crate::random::stream;

    fn feasible(objectives: &[f64]) -> Fitness {
        Fitness::new(Violation::NONE, objectives.to_vec())
    }

    #[test]
    fn survival_keeps_the_ends_of_the_front_it_cuts() {
        let all: Vec<Fitness> = [[0.0, 4.0], [1.0, 2.9], [1.1, 2.8], [2.0, 2.0], [4.0, 0.0], [5.0, 5.0]]
            .iter()
            .map(|p| feasible(p))
            .collect();
        assert_eq!(survive(&all, 3), [0, 3, 4]);
        assert_eq!(survive(&all, 10), [0, 1, 2, 3, 4, 5]);
        assert_eq!(survive(&all, 0), [0usize; 0]);
    }

    #[test]
    fn the_least_contribution_goes_first_and_bad_ends_go() {
        let all: Vec<Fitness> = [[0.0, 9.0], [1.0, 2.9], [1.1, 2.8], [2.0, 2.0], [4.0, 0.0], [5.0, 5.0]]
            .iter()
            .map(|p| feasible(p))
            .collect();
        assert_eq!(
            survive_by_contribution(&all, 4, &[6.0, 6.0]),
            [1, 2, 3, 4],
            "an end beyond the reference"
        );
        assert_eq!(survive_by_contribution(&all, 3, &[6.0, 6.0]), [1, 3, 4]);
        assert_eq!(
            survive_by_contribution(&all, 3, &[-1.0, -1.0]),
            survive(&all, 3),
            "nothing before it: crowding"
        );
        assert_eq!(survive_by_contribution(&all, 10, &[6.0, 6.0]), [0, 1, 2, 3, 4, 5]);
        let failed = vec![Fitness::new(Violation::new(1, 2.0), vec![1.0, 1.0]); 3];
        assert_eq!(survive_by_contribution(&failed, 2, &[6.0, 6.0]), [0, 1]);
    }

    #[test]
    fn a_failed_design_survives_only_where_nothing_else_is_left() {
        let all = [Fitness::new(Violation::new(FAILED, 0.0), vec![]), feasible(&[1.0]), feasible(&[2.0])];
        assert_eq!(survive(&all, 2), [1, 2]);
        assert_eq!(survive(&all, 3), [0, 1, 2]);
    }

    #[test]
    fn the_tournament_prefers_rank_then_crowding() {
        let standings = [
            Standing { rank: 1, crowding: f64::INFINITY },
            Standing { rank: 0, crowding: 0.5 },
            Standing { rank: 0, crowding: 0.7 },
        ];
        let mut rng = stream(3, 0, 0);
        let mut wins = [0; 3];
        for _ in 0..3000 {
            wins[tournament(&standings, &mut rng).expect("three members")] += 1;
        }
        assert_eq!(wins[0], 0, "two different members always meet");
        assert!(wins[2] > 1800 && wins[1] > 900, "{wins:?}");
        assert_eq!(tournament(&[], &mut rng), None);
    }
}
