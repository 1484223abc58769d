//! NSGA-II put together from `evolve` on ZDT and DTLZ problems: as good as pymoo's at the same budget.
//!
//! Reference: `tests/data/evolve/spread.json`, hypervolumes of pymoo 0.6 over 11 seeds, made by `make_fixtures.py`
//! beside it. Simulated binary crossover and polynomial mutation (Deb and Agrawal 1995) live here only.
//! Problems: Zitzler, Deb, Thiele 2000; Deb, Thiele, Laumanns, Zitzler 2002.

use std::f64::consts::PI;

use quadrille::evolve::{
    Fitness, SampledHypervolume, Violation, hypervolume, standings, survive, survive_by_contribution,
    tournament,
};
use quadrille::random::{Rng, chance, stream, unit};
use serde::Deserialize;

#[derive(Deserialize)]
struct Spread {
    population: usize,
    generations: u32,
    rows: Vec<Row>,
}

#[derive(Deserialize)]
struct Row {
    problem: String,
    variables: usize,
    reference: Vec<f64>,
    hypervolume: Vec<f64>,
}

fn zdt_g(x: &[f64]) -> f64 {
    1.0 + 9.0 * x[1..].iter().sum::<f64>() / (x.len() - 1) as f64
}

fn dtlz_g(x: &[f64]) -> f64 {
    x[2..].iter().map(|x| (x - 0.5).powi(2)).sum()
}

fn on_sphere(g: f64, a: f64, b: f64) -> Vec<f64> {
    vec![(1.0 + g) * a.cos() * b.cos(), (1.0 + g) * a.cos() * b.sin(), (1.0 + g) * a.sin()]
}

fn evaluate(problem: &str, x: &[f64]) -> Vec<f64> {
    match problem {
        "zdt1" => vec![x[0], zdt_g(x) * (1.0 - (x[0] / zdt_g(x)).sqrt())],
        "zdt2" => vec![x[0], zdt_g(x) * (1.0 - (x[0] / zdt_g(x)).powi(2))],
        "zdt3" => {
            let (g, r) = (zdt_g(x), x[0] / zdt_g(x));
            vec![x[0], g * (1.0 - r.sqrt() - r * (10.0 * PI * x[0]).sin())]
        }
        "zdt6" => {
            let f = 1.0 - (-4.0 * x[0]).exp() * (6.0 * PI * x[0]).sin().powi(6);
            let g = 1.0 + 9.0 * (x[1..].iter().sum::<f64>() / (x.len() - 1) as f64).powf(0.25);
            vec![f, g * (1.0 - (f / g).powi(2))]
        }
        "dtlz2" => on_sphere(dtlz_g(x), x[0] * PI / 2.0, x[1] * PI / 2.0),
        "dtlz5" => {
            let g = dtlz_g(x);
            on_sphere(g, x[0] * PI / 2.0, (1.0 + 2.0 * g * x[1]) / (2.0 * (1.0 + g)) * PI / 2.0)
        }
        other => panic!("unknown problem {other}"),
    }
}

/// SBX on [0, 1] variables, each crossed with probability ½ and swapped with probability ½.
fn sbx(a: &mut [f64], b: &mut [f64], eta: f64, rng: &mut Rng) {
    for (x, y) in a.iter_mut().zip(b) {
        if !chance(rng, 0.5) || (*x - *y).abs() < 1e-14 {
            continue;
        }
        let (low, high) = (x.min(*y), x.max(*y));
        let u = unit(rng);
        let spread = |room: f64| {
            let alpha = 2.0 - (1.0 + 2.0 * room / (high - low)).powf(-(eta + 1.0));
            let q = if u <= 1.0 / alpha { u * alpha } else { 1.0 / (2.0 - u * alpha) };
            q.powf(1.0 / (eta + 1.0))
        };
        let c = 0.5 * (low + high - spread(low) * (high - low));
        let d = 0.5 * (low + high + spread(1.0 - high) * (high - low));
        (*x, *y) = if chance(rng, 0.5) { (d, c) } else { (c, d) };
        (*x, *y) = (x.clamp(0.0, 1.0), y.clamp(0.0, 1.0));
    }
}

/// Polynomial mutation on [0, 1] variables at rate 1/n.
fn polynomial_mutation(x: &mut [f64], eta: f64, rng: &mut Rng) {
    let rate = 1.0 / x.len() as f64;
    for v in x {
        if !chance(rng, rate) {
            continue;
        }
        let u = unit(rng);
        let delta = if u < 0.5 {
            (2.0 * u + (1.0 - 2.0 * u) * (1.0 - *v).powf(eta + 1.0)).powf(1.0 / (eta + 1.0)) - 1.0
        } else {
            1.0 - (2.0 * (1.0 - u) + 2.0 * (u - 0.5) * v.powf(eta + 1.0)).powf(1.0 / (eta + 1.0))
        };
        *v = (*v + delta).clamp(0.0, 1.0);
    }
}

/// The last population.
fn nsga2(
    evaluate: impl Fn(&[f64]) -> Vec<f64>,
    variables: usize,
    (population, generations): (usize, u32),
    survive: impl Fn(&[Fitness], usize) -> Vec<usize>,
    seed: u64,
) -> Vec<Fitness> {
    let fitness = |x: &Vec<f64>| Fitness::new(Violation::NONE, evaluate(x));
    let mut rng = stream(seed, 0, 0);
    let mut genes: Vec<Vec<f64>> =
        (0..population).map(|_| (0..variables).map(|_| unit(&mut rng)).collect()).collect();
    let mut fits: Vec<Fitness> = genes.iter().map(fitness).collect();
    for _ in 1..generations {
        let standings = standings(&fits);
        while genes.len() < 2 * population {
            let mut pick = || tournament(&standings, &mut rng).expect("a population");
            let (mut a, mut b) = (genes[pick()].clone(), genes[pick()].clone());
            if chance(&mut rng, 0.9) {
                sbx(&mut a, &mut b, 15.0, &mut rng);
            }
            for mut child in [a, b] {
                if chance(&mut rng, 0.9) {
                    polynomial_mutation(&mut child, 20.0, &mut rng);
                }
                if !genes.contains(&child) && genes.len() < 2 * population {
                    genes.push(child);
                }
            }
        }
        fits.extend(genes[population..].iter().map(fitness));
        let survivors = survive(&fits, population);
        genes = survivors.iter().map(|&i| genes[i].clone()).collect();
        fits = survivors.iter().map(|&i| fits[i].clone()).collect();
    }
    fits
}

/// DTLZ2 with any number of objectives, the last variables being its distance.
fn dtlz2(objectives: usize, x: &[f64]) -> Vec<f64> {
    let (angles, rest) = x.split_at(objectives - 1);
    let radius = 1.0 + rest.iter().map(|x| (x - 0.5).powi(2)).sum::<f64>();
    let cosines = |n: usize| angles[..n].iter().fold(radius, |r, a| r * (a * PI / 2.0).cos());
    let sine = |k: usize| if k == 0 { 1.0 } else { (angles[objectives - 1 - k] * PI / 2.0).sin() };
    (0..objectives).map(|k| cosines(objectives - 1 - k) * sine(k)).collect()
}

#[test]
fn with_six_objectives_contribution_keeps_what_crowding_loses() {
    const REFERENCE: f64 = 1.2;
    let volume = |fits: &[Fitness]| {
        let mut sampled = SampledHypervolume::new(6);
        fits.iter()
            .for_each(|f| sampled.offer(&f.objectives.iter().map(|x| x / REFERENCE).collect::<Vec<_>>()));
        sampled.value()
    };
    for seed in 1..=5 {
        let budget = (24, 40);
        let crowding = nsga2(|x| dtlz2(6, x), 10, budget, survive, seed);
        let by_contribution = |all: &[Fitness], mu: usize| survive_by_contribution(all, mu, &[REFERENCE; 6]);
        let contribution = nsga2(|x| dtlz2(6, x), 10, budget, by_contribution, seed);
        let (a, b) = (volume(&crowding), volume(&contribution));
        println!("seed {seed}: crowding {a:.3}, contribution {b:.3}");
        assert!(b > 1.1 * a, "seed {seed}: crowding {a}, contribution {b}");
    }
}

fn volume_of(row: &Row, budget: (usize, u32), seed: u64) -> f64 {
    let fits = nsga2(|x| evaluate(&row.problem, x), row.variables, budget, survive, seed);
    let points: Vec<&[f64]> = fits.iter().map(|f| f.objectives.as_slice()).collect();
    hypervolume(&points, &row.reference)
}

#[test]
fn as_good_as_pymoo_on_zdt_and_dtlz() {
    let spread: Spread = serde_json::from_str(include_str!("../data/evolve/spread.json")).expect("spread");
    for row in &spread.rows {
        let mut ours: Vec<f64> =
            (1..=11).map(|seed| volume_of(row, (spread.population, spread.generations), seed)).collect();
        ours.sort_by(f64::total_cmp);
        let lowest = row.hypervolume.iter().copied().fold(f64::INFINITY, f64::min);
        println!(
            "{}: ours {:.4} … {:.4} … {:.4}, pymoo from {lowest:.4}",
            row.problem, ours[0], ours[5], ours[10]
        );
        assert!(ours[5] >= lowest, "{}: median {} below pymoo's worst {lowest}", row.problem, ours[5]);
        assert!(
            ours[10] < 1.01 * row.hypervolume.iter().copied().fold(0.0, f64::max),
            "{}: too good",
            row.problem
        );
    }
}
