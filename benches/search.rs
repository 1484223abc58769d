//! Selection at the sizes of a run: it must cost nothing beside an evaluation.
#![allow(missing_docs, reason = "criterion's macros")]

use criterion::{Criterion, criterion_group, criterion_main};
use quadrille::evolve::{Fitness, SampledHypervolume, Violation, fronts, hypervolume, survive};
use quadrille::random::{stream, unit};
use std::hint::black_box;

/// Points of which most do not dominate each other: on a simplex, a little disturbed.
fn points(count: usize, objectives: usize) -> Vec<Vec<f64>> {
    let mut rng = stream(1, 0, 0);
    let mut point = || {
        let raw: Vec<f64> = (0..objectives).map(|_| 0.05 + unit(&mut rng)).collect();
        let sum: f64 = raw.iter().sum();
        raw.iter().map(|x| x / sum + 0.01 * unit(&mut rng)).collect()
    };
    (0..count).map(|_| point()).collect()
}

fn selection(criterion: &mut Criterion) {
    let population: Vec<Fitness> =
        points(240, 6).into_iter().map(|p| Fitness::new(Violation::NONE, p)).collect();
    criterion.bench_function("fronts/240x6", |b| b.iter(|| fronts(black_box(&population))));
    criterion.bench_function("survive/48_of_240x6", |b| b.iter(|| survive(black_box(&population), 48)));
}

fn volumes(criterion: &mut Criterion) {
    for objectives in [3, 4] {
        let points = points(200, objectives);
        let points: Vec<&[f64]> = points.iter().map(Vec::as_slice).collect();
        let reference = vec![1.0; objectives];
        criterion.bench_function(&format!("hypervolume/200x{objectives}"), |b| {
            b.iter(|| hypervolume(black_box(&points), &reference));
        });
    }
    let points = points(20, 6);
    let empty = SampledHypervolume::new(6);
    criterion.bench_function("sampled_hypervolume/20x6", |b| {
        b.iter(|| {
            let mut sampled = empty.clone();
            points.iter().for_each(|p| sampled.offer(black_box(p)));
            sampled.value()
        });
    });
}

criterion_group!(benches, selection, volumes);
criterion_main!(benches);
