//! The frame solver on grid shells. The unit of every figure is one numeric factorisation of the same K, timed in
//! between: `cargo bench --bench frame`. Machines differ less in that ratio than in seconds.
#![allow(clippy::print_stdout, clippy::unwrap_used, missing_docs, reason = "a bench talks, and fails aloud")]

#[path = "../tests/frame_support/mod.rs"]
mod frame_support;

use frame_support::{court, grid_shell};
use quadrille::geometry::Pattern;
use quadrille::structure::gridshell::{GridshellModel, analyse};
use quadrille::structure::params::{HeightParams, StructureParams};
use quadrille::structure::solver::Solver;
use std::time::Instant;

/// Best of several, seconds.
fn best(times: u32, mut f: impl FnMut()) -> f64 {
    (0..times)
        .map(|_| {
            let start = Instant::now();
            f();
            start.elapsed().as_secs_f64()
        })
        .fold(f64::INFINITY, f64::min)
}

fn at(height: HeightParams, order: u8) -> StructureParams {
    let paper: StructureParams = serde_json::from_str("{}").unwrap();
    StructureParams { height, order, ..paper }
}

fn row(name: &str, pattern: &Pattern, times: u32) {
    let fixed = at(HeightParams::Fixed { fixed_m: 0.45 }, 2);
    let first = at(HeightParams::Fixed { fixed_m: 0.45 }, 1);
    let sized = at(HeightParams::Sized { min_m: 0.08, max_m: 0.6, step_m: 0.01 }, 2);
    let model = GridshellModel::new(pattern, &fixed, 0.45).unwrap();
    let mut solver = Solver::new(&model.frame).unwrap();
    solver.set_sections(model.frame.sections()).unwrap();
    let n = solver.system().unknowns();
    let factor = best(times, || solver.refactorise().unwrap());
    let symbolic = best(times, || drop(Solver::new(&model.frame).unwrap()));
    let build = best(times, || drop(GridshellModel::new(pattern, &fixed, 0.45).unwrap()));
    let set = best(times, || solver.set_sections(model.frame.sections()).unwrap());
    let mut rhs = vec![1.0; 8 * n];
    let solve = |k: usize, solver: &mut Solver<'_>, rhs: &mut [f64]| {
        best(times, || {
            rhs.fill(1e3);
            solver.solve(&mut rhs[..k * n]);
        })
    };
    let (s1, s2, s4, s8) = (
        solve(1, &mut solver, &mut rhs),
        solve(2, &mut solver, &mut rhs),
        solve(4, &mut solver, &mut rhs),
        solve(8, &mut solver, &mut rhs),
    );
    let axial = vec![-1e5; model.frame.members().len()];
    let mut out = vec![0.0; n];
    let geometric = best(times, || solver.minus_geometric(&axial, &rhs[..n], &mut out));
    let loads = vec![nalgebra::Vector3::zeros(); axial.len()];
    let forces = best(times, || drop(solver.member_forces(&rhs[..n], None, &loads)));
    let full1 = best(times, || drop(analyse(pattern, &first).unwrap()));
    let full2 = best(times, || drop(analyse(pattern, &fixed).unwrap()));
    let sizing = best(times.min(3), || drop(analyse(pattern, &sized).unwrap()));
    println!(
        "{name:<12} {n:>7} dof  factor {:>8.2} ms | in factors: build {:.2} symbolic {:.2} set {:.2} solve1 {:.3} solve2 {:.3} \
         solve4 {:.3} solve8 {:.3} kg {:.3} forces {:.3} | order 1 {:.2} order 2 {:.2} sizing {:.2}",
        1e3 * factor,
        build / factor,
        symbolic / factor,
        set / factor,
        s1 / factor,
        s2 / factor,
        s4 / factor,
        s8 / factor,
        geometric / factor,
        forces / factor,
        full1 / factor,
        full2 / factor,
        sizing / factor,
    );
}

fn main() {
    let flat_dome = |cells: u32| {
        let side = 1.0 * f64::from(cells);
        grid_shell([cells, cells], [side, side], move |x, y| 0.15 * side * (1.0 - x * x) * (1.0 - y * y))
    };
    let filter: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let wanted = |name: &str| filter.is_empty() || filter.iter().any(|f| name.contains(f.as_str()));
    for cells in [24, 48, 80] {
        let name = format!("grid {cells}");
        if wanted(&name) {
            row(&name, &flat_dome(cells), 5);
        }
    }
    for (panels, around, across) in [(2_000, 144, 14), (8_000, 288, 28), (20_000, 452, 44)] {
        let name = format!("court {panels}");
        if wanted(&name) {
            row(&name, &court(around, across), 5);
        }
    }
}
