//! Laws that hold whatever the numbers: symmetry, equilibrium, Betti, invariance, convergence.

use crate::support::{Bend, random_tower, renumbered, rotated};
use quadrille::random;
use quadrille::structure::model::FrameParts;
use quadrille::structure::section::Section;
use quadrille::structure::{FrameAnalysis, FrameModel, FrameResult, Order, frame};

const FIRST: FrameAnalysis = FrameAnalysis { order: Order::First, buckling_modes: 3 };
const SECOND: FrameAnalysis = FrameAnalysis { order: Order::Second, buckling_modes: 3 };

fn solve(parts: &FrameParts, analysis: &FrameAnalysis) -> FrameResult {
    frame(&FrameModel::new(parts.clone()).unwrap(), analysis).unwrap()
}

/// Σ over all nodal loads of load · displacement.
fn work(parts: &FrameParts, result: &FrameResult) -> f64 {
    let loads = parts.load_cases.iter().flat_map(|case| &case.nodal);
    loads.map(|l| (0..6).map(|d| l.load[d] * result.displacements[l.node as usize][d]).sum::<f64>()).sum()
}

#[test]
fn reactions_balance_the_loads_in_force_and_moment() {
    for seed in 0..20 {
        let parts = random_tower(seed);
        let result = solve(&parts, &FIRST);
        let mut force = [0.0; 3];
        let mut moment = [0.0; 3];
        let mut add = |at: [f64; 3], load: [f64; 6]| {
            for d in 0..3 {
                let (e, f) = ((d + 1) % 3, (d + 2) % 3);
                force[d] += load[d];
                moment[d] += load[3 + d] + at[e] * load[f] - at[f] * load[e];
            }
        };
        for load in &parts.load_cases[0].nodal {
            add(parts.nodes[load.node as usize], load.load);
        }
        for (node, reaction) in &result.reactions {
            add(parts.nodes[node.0 as usize], reaction.map(|r| r.unwrap_or(0.0)));
        }
        let size = parts.load_cases[0].nodal.iter().flat_map(|l| l.load).fold(0.0f64, |a, v| a.max(v.abs()));
        assert!(force.iter().all(|v| v.abs() < 1e-9 * size), "seed {seed}: {force:?}");
        assert!(moment.iter().all(|v| v.abs() < 1e-7 * size), "seed {seed}: {moment:?}");
    }
}

#[test]
fn betti_the_work_of_one_load_on_the_other_displacement_is_mutual() {
    for seed in 0..20 {
        let (a, mut b) = (random_tower(seed), random_tower(seed));
        let mut rng = random::stream(99, 0, seed);
        for load in &mut b.load_cases[0].nodal {
            load.load = std::array::from_fn(|_| 1e3 * (random::unit(&mut rng) - 0.5));
        }
        let (of_a, of_b) = (solve(&a, &FIRST), solve(&b, &FIRST));
        let (ab, ba) = (work(&a, &of_b), work(&b, &of_a));
        assert!((ab - ba).abs() < 1e-9 * ab.abs().max(work(&a, &of_a).abs()), "seed {seed}: {ab} {ba}");
        assert!(work(&a, &of_a) > 0.0, "the stiffness is positive");
    }
}

#[test]
fn rotation_of_the_whole_rotates_the_answer() {
    for seed in 0..10 {
        let parts = random_tower(seed);
        let (turned, turn) = rotated(&parts, seed);
        for analysis in [FIRST, SECOND] {
            let (a, b) = (solve(&parts, &analysis), solve(&turned, &analysis));
            assert!((a.max_displacement.0 / b.max_displacement.0 - 1.0).abs() < 1e-8);
            for (ua, ub) in a.displacements.iter().zip(&b.displacements) {
                let expected = turn * nalgebra::Vector3::new(ua[0], ua[1], ua[2]);
                let off = (expected - nalgebra::Vector3::new(ub[0], ub[1], ub[2])).norm();
                assert!(off < 1e-8 * a.max_displacement.0, "seed {seed}");
            }
            for (fa, fb) in a.buckling_factors.iter().zip(&b.buckling_factors) {
                assert!((fa / fb - 1.0).abs() < 1e-7, "seed {seed}: {fa} {fb}");
            }
            assert!((a.utilisation().unwrap().0 / b.utilisation().unwrap().0 - 1.0).abs() < 1e-8);
        }
    }
}

#[test]
fn renumbering_renumbers_the_answer() {
    for seed in 0..10 {
        let parts = random_tower(seed);
        let (other, place) = renumbered(&parts, seed);
        let (a, b) = (solve(&parts, &SECOND), solve(&other, &SECOND));
        for (n, u) in a.displacements.iter().enumerate() {
            for (ours, theirs) in u.iter().zip(&b.displacements[place[n]]).take(3) {
                assert!((ours - theirs).abs() < 1e-9 * a.max_displacement.0);
            }
        }
        for (fa, fb) in a.buckling_factors.iter().zip(&b.buckling_factors) {
            assert!((fa / fb - 1.0).abs() < 1e-8, "seed {seed}: {fa} {fb}");
        }
    }
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let parts = random_tower(3);
    let bytes = || quadrille::structure::file::answer(&solve(&parts, &SECOND)).unwrap();
    let first = bytes();
    let others = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..3).map(|_| scope.spawn(bytes)).collect();
        threads.into_iter().map(|t| t.join().unwrap()).collect::<Vec<_>>()
    });
    assert!(others.iter().all(|other| *other == first));
}

/// Euler's column, pinned at both ends, L = 5 m, split into n: λ tends to π²EI/(P L²) like h⁴ (cubic elements).
#[test]
fn the_buckling_factor_of_a_column_converges_with_the_fourth_order() {
    let error = |elements: u32| {
        let column = Bend { elements }.pinned_column();
        let factor =
            solve(&column, &FrameAnalysis { order: Order::First, buckling_modes: 1 }).buckling_factors[0];
        let section = Section::rectangular_hollow(0.1, 0.18, 0.006).unwrap();
        let euler = std::f64::consts::PI.powi(2) * 210e9 * section.iz / (25.0 * 1e5);
        factor / euler - 1.0
    };
    let (two, four, eight) = (error(2), error(4), error(8));
    assert!(two > four && four > eight && eight > 0.0, "an upper bound that falls: {two} {four} {eight}");
    assert!((two / four).log2() > 3.7 && (four / eight).log2() > 3.9, "{two} {four} {eight}");
}

/// A cantilever under its own uniform load is exact at its nodes, whatever the number of elements: tip q L⁴ / 8EI.
#[test]
fn uniform_load_is_exact_at_the_nodes_of_every_mesh() {
    let section = Section::rectangular_hollow(0.1, 0.18, 0.006).unwrap();
    for elements in [1, 3, 10] {
        let result = solve(&Bend { elements }.cantilever(2e3), &FIRST);
        let exact = 2e3 * 625.0 / (8.0 * 210e9 * section.iy);
        let tip = result.displacements[elements as usize][2];
        assert!((tip / -exact - 1.0).abs() < 1e-9, "{elements}: {tip} {exact}");
    }
}

/// Timoshenko, Gere (1961), *Theory of Elastic Stability*, §1.11: cantilever column with axial load P and lateral
/// load H at the tip: δ = (H/P) (tan(kL)/k − L), k² = P/EI.
///
/// ```text
///          │ P
///     H ──►●           L = 5 m, box 100 × 180 × 6 mm, bending about the weak axis
///          │
///          │
///        ▔▔▔▔▔
/// ```
#[test]
fn beam_column_of_timoshenko_and_gere() {
    let section = Section::rectangular_hollow(0.1, 0.18, 0.006).unwrap();
    let (p, h, length) = (5e4, 500.0, 5.0f64);
    let column = Bend { elements: 10 }.column_with_tip_load(p, h);
    let tip = solve(&column, &SECOND).displacements[10][1];
    let k = (p / (210e9 * section.iz)).sqrt();
    let exact = h / p * ((k * length).tan() / k - length);
    assert!((tip / exact - 1.0).abs() < 1e-5, "{tip} {exact}");
}
