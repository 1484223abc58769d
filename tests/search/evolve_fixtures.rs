//! Sorting, crowding and hypervolume against a brute-force oracle and against pymoo 0.6.
//!
//! Reference: `tests/data/evolve/fixtures.json`, made by `make_fixtures.py` beside it.

use quadrille::evolve::{
    Domination, Fitness, NonDominated, SampledHypervolume, Violation, compare, crowding_distance, fronts,
    hypervolume, standings, survive, visible,
};
use quadrille::random::{Rng, below, stream, unit};
use serde::Deserialize;

#[derive(Deserialize)]
struct Fixtures {
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    kind: String,
    objectives: usize,
    points: Vec<Vec<f64>>,
    fronts: Vec<Vec<usize>>,
    crowding: Vec<Option<Vec<Option<f64>>>>,
    hypervolume: f64,
}

fn fixtures() -> Vec<Case> {
    let text = include_str!("../data/evolve/fixtures.json");
    serde_json::from_str::<Fixtures>(text).expect("fixtures").cases
}

fn feasible(points: &[Vec<f64>]) -> Vec<Fitness> {
    points.iter().map(|p| Fitness::new(Violation::NONE, p.clone())).collect()
}

#[test]
fn fronts_are_those_of_pymoo() {
    for case in fixtures() {
        assert_eq!(fronts(&feasible(&case.points)), case.fronts, "{} in {}D", case.kind, case.objectives);
    }
}

#[test]
fn crowding_distances_are_those_of_pymoo() {
    let mut compared = 0;
    for case in fixtures() {
        for (front, expected) in case.fronts.iter().zip(&case.crowding) {
            // pymoo gives a lone point 0 where Deb et al. give both ends, and so it, infinity.
            let Some(expected) = expected.as_ref().filter(|_| front.len() > 1) else { continue };
            let points: Vec<&[f64]> = front.iter().map(|&i| case.points[i].as_slice()).collect();
            for (ours, theirs) in crowding_distance(&points).iter().zip(expected) {
                match theirs {
                    None => assert_eq!(*ours, f64::INFINITY),
                    Some(theirs) => assert!((ours - theirs).abs() < 1e-9, "{ours} {theirs}"),
                }
                compared += 1;
            }
        }
    }
    assert!(compared > 200, "{compared}");
}

#[test]
fn hypervolumes_are_those_of_pymoo() {
    for case in fixtures() {
        let points: Vec<&[f64]> = case.points.iter().map(Vec::as_slice).collect();
        if case.objectives <= 4 {
            let ours = hypervolume(&points, &vec![1.0; case.objectives]);
            assert!((ours - case.hypervolume).abs() < 1e-12, "{} {}D", case.kind, case.objectives);
        }
        let mut sampled = SampledHypervolume::new(case.objectives);
        points.iter().for_each(|p| sampled.offer(p));
        let error = (sampled.value() - case.hypervolume).abs();
        assert!(error < 0.012 * case.hypervolume + 1e-4, "{} {}D: {error}", case.kind, case.objectives);
    }
}

/// Random fitnesses on a coarse grid, so that equal values and equal violations are common.
fn random_population(rng: &mut Rng, n: usize, objectives: usize) -> Vec<Fitness> {
    (0..n)
        .map(|_| match below(rng, 4) {
            0 => Fitness::new(Violation::new(1 + below(rng, 6) as u8, below(rng, 3) as f64), vec![]),
            1 => Fitness::new(Violation::NONE, vec![f64::NAN; objectives]),
            _ => Fitness::new(Violation::NONE, (0..objectives).map(|_| below(rng, 5) as f64).collect()),
        })
        .collect()
}

/// The definition, without any bookkeeping: peel off what nobody left dominates.
fn peel(all: &[Fitness]) -> Vec<Vec<usize>> {
    let mut left: Vec<usize> = (0..all.len()).collect();
    let mut fronts = Vec::new();
    while !left.is_empty() {
        let free = |&i: &usize| left.iter().all(|&j| compare(&all[j], &all[i]) != Domination::First);
        let front: Vec<usize> = left.iter().copied().filter(free).collect();
        left.retain(|i| !front.contains(i));
        fronts.push(front);
    }
    fronts
}

#[test]
fn sorting_and_survival_agree_with_the_definition() {
    for round in 0..300 {
        let mut rng = stream(11, round, 0);
        let (n, objectives) = (below(&mut rng, 30), 1 + below(&mut rng, 5));
        let all = random_population(&mut rng, n, objectives);
        let expected = peel(&all);
        assert_eq!(fronts(&all), expected);

        let mu = below(&mut rng, 35);
        let survivors = survive(&all, mu);
        assert_eq!(survivors.len(), mu.min(all.len()));
        let standing = standings(&all);
        let worst = survivors.iter().map(|&i| standing[i].rank).max();
        for i in (0..all.len()).filter(|i| !survivors.contains(i)) {
            assert!(Some(standing[i].rank) >= worst, "a better rank was dropped");
        }
        assert!(
            all.iter()
                .filter(|f| f.violation.is_feasible())
                .all(|f| f.objectives.iter().all(|x| x.is_finite()))
        );
    }
}

#[test]
fn the_exact_hypervolume_counts_the_cells_of_a_grid() {
    for round in 0..120 {
        let mut rng = stream(12, round, 0);
        let objectives = 1 + below(&mut rng, 4);
        let points: Vec<Vec<f64>> = (0..1 + below(&mut rng, 12))
            .map(|_| (0..objectives).map(|_| below(&mut rng, 6) as f64).collect())
            .collect();
        let cells = 5usize.pow(objectives as u32);
        let covered = (0..cells)
            .filter(|cell| {
                let corner: Vec<usize> = (0..objectives).map(|m| cell / 5usize.pow(m as u32) % 5).collect();
                points.iter().any(|p| p.iter().zip(&corner).all(|(x, c)| *x as usize <= *c))
            })
            .count();
        let slices: Vec<&[f64]> = points.iter().map(Vec::as_slice).collect();
        assert_eq!(hypervolume(&slices, &vec![5.0; objectives]), covered as f64);
    }
}

#[test]
fn the_unbounded_archive_is_the_first_front_of_all_that_was_offered() {
    for round in 0..100 {
        let mut rng = stream(13, round, 0);
        let points: Vec<Vec<f64>> = (0..40)
            .map(|_| (0..3).map(|_| if below(&mut rng, 2) == 0 { unit(&mut rng) } else { 0.5 }).collect())
            .collect();
        let mut archive = NonDominated::default();
        for (id, point) in points.iter().enumerate() {
            archive.offer(id, point);
        }
        let rounded: Vec<Vec<f64>> = points.iter().map(|point| visible(point)).collect();
        let mut first = fronts(&feasible(&rounded))[0].clone();
        first.retain(|&i| !rounded[..i].contains(&rounded[i]));
        assert_eq!(archive.ids().collect::<Vec<_>>(), first);
        assert!(!archive.offer(99, &[f64::NAN, 0.0, 0.0]));
    }
}
