//! The frame solver on grid shells: one full analysis and one full sizing, in units of one numeric factorisation of the
//! same K in the same process (issue 4: at most 5 and 20), and how they grow with the number of unknowns (at most 1.4).
//!
//! `cargo bench --bench frame [-- NAME…]`, for instance `-- "court 2000"`; `-- --parts` shows what the time is made of.
//! Processor time, median of several. "Full" is everything from the pattern on: model, numbering, symbolic factor,
//! both combinations, buckling, metrics, requirements; order 2 with its proof of stability.
#![allow(clippy::print_stdout, clippy::unwrap_used, missing_docs, reason = "a bench talks, and fails aloud")]

#[path = "../tests/structure/support.rs"]
mod frame_support;

use frame_support::grid_shell;
use quadrille::config::ResolvedConfig;
use quadrille::geometry::Pattern;
use quadrille::structure::forces::BetweenAll;
use quadrille::structure::gridshell::{GridshellModel, analyse};
use quadrille::structure::params::{HeightParams, StructureParams};
use quadrille::structure::solver::Solver;
use quadrille::study::{Effort, Study};
use std::path::Path;
use std::time::Instant;

/// Processor time of this thread, seconds; none where the kernel does not tell.
fn processor_seconds() -> Option<f64> {
    // The kernel brings the figure up to date when the thread gives way.
    std::thread::yield_now();
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse::<f64>().ok().map(|ns| 1e-9 * ns)
}

/// Median of several, seconds.
fn median(times: usize, mut f: impl FnMut()) -> f64 {
    let mut taken: Vec<f64> = (0..times)
        .map(|_| {
            let (clock, start) = (Instant::now(), processor_seconds());
            f();
            match (start, processor_seconds()) {
                (Some(start), Some(end)) => end - start,
                _ => clock.elapsed().as_secs_f64(),
            }
        })
        .collect();
    taken.sort_by(f64::total_cmp);
    taken[times / 2]
}

/// Largest memory of the process so far, MB.
fn peak_megabytes() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().trim_end_matches("kB").trim().parse::<f64>().ok().map(|kb| kb / 1024.0)
}

/// Seconds of one row.
struct Row {
    unknowns: f64,
    order1: f64,
    order2: f64,
    sizing: f64,
}

fn row(name: &str, pattern: &Pattern, params: &StructureParams, parts: bool) -> Row {
    let at = |height, order| StructureParams { height, order, ..params.clone() };
    let fixed = HeightParams::Fixed { fixed_m: 0.45 };
    let sized = at(HeightParams::Sized { min_m: 0.08, max_m: 0.6, step_m: 0.01 }, 2);
    let model = GridshellModel::new(pattern, params, 0.45).unwrap();
    let mut solver = Solver::new(&model.frame).unwrap();
    solver.set_sections(model.frame.sections()).unwrap();
    let factor = median(9, || solver.refactorise().unwrap());
    let unknowns = solver.system().unknowns();
    if parts {
        print_parts(&mut solver, pattern, params, factor);
    }
    drop(solver);
    let [order1, order2] =
        [1, 2].map(|order| median(5, || drop(analyse(pattern, &at(fixed, order)).unwrap())));
    let sizing = median(5, || drop(analyse(pattern, &sized).unwrap()));
    let answer = analyse(pattern, &sized).unwrap();
    let met = if answer.violation() > 0.0 { "no height meets all" } else { "met" };
    println!(
        "{name:<12} {unknowns:>7} dof  factor {:>7.2} ms | order 1 {:>5.2}  order 2 {:>5.2}  sizing {:>5.2} ({:.4} m, {met}) | {:.0} MB",
        1e3 * factor,
        order1 / factor,
        order2 / factor,
        sizing / factor,
        answer.height_m,
        peak_megabytes().unwrap_or(0.0),
    );
    Row { unknowns: unknowns as f64, order1, order2, sizing }
}

/// What an analysis is made of, in factorisations.
fn print_parts(solver: &mut Solver<'_>, pattern: &Pattern, params: &StructureParams, factor: f64) {
    let model = solver.model();
    let n = solver.system().unknowns();
    println!(
        "  {:<14} {:.3}",
        "model",
        median(5, || drop(GridshellModel::new(pattern, params, 0.45))) / factor
    );
    println!("  {:<14} {:.3}", "symbolic", median(5, || drop(Solver::new(model))) / factor);
    println!(
        "  {:<14} {:.3}",
        "set sections",
        median(5, || solver.set_sections(model.sections()).unwrap()) / factor
    );
    let axial = vec![-1e4; model.members().len()];
    solver.factorise_shifted(&axial, 1.0).unwrap();
    println!(
        "  {:<14} {:.3}",
        "K + Kg",
        median(5, || solver.factorise_shifted(&axial, 1.0).unwrap()) / factor
    );
    let mut rhs = vec![0.0; 8 * n];
    for columns in [1, 2, 4, 8] {
        let seconds = median(9, || {
            rhs.fill(1e3);
            solver.solve(&mut rhs[..columns * n]);
        });
        println!("  solve {columns:<8} {:.3}", seconds / factor);
    }
    let (x, y) = rhs.split_at_mut(4 * n);
    println!(
        "  {:<14} {:.3}",
        "−Kg x, 2",
        median(9, || solver.minus_geometric(&axial, &x[..2 * n], &mut y[..2 * n])) / factor
    );
    let loads = vec![nalgebra::Vector3::zeros(); axial.len()];
    println!(
        "  {:<14} {:.3}",
        "member forces",
        median(9, || drop(
            solver.member_forces(&x[..n], BetweenAll { axial: Some(&axial), initial: &[], loads: &loads })
        )) / factor
    );
}

/// Slope of the logarithm of the time over that of the unknowns.
fn exponent(rows: &[Row], seconds: impl Fn(&Row) -> f64) -> f64 {
    let points: Vec<(f64, f64)> = rows.iter().map(|row| (row.unknowns.ln(), seconds(row).ln())).collect();
    let count = points.len() as f64;
    let (mx, my) =
        (points.iter().map(|p| p.0).sum::<f64>() / count, points.iter().map(|p| p.1).sum::<f64>() / count);
    let over: f64 = points.iter().map(|p| (p.0 - mx) * (p.1 - my)).sum();
    over / points.iter().map(|p| (p.0 - mx).powi(2)).sum::<f64>()
}

fn print_growth(rows: &[Row]) {
    if rows.len() > 1 {
        println!(
            "growth exponents: order 1 {:.2}, order 2 {:.2}, sizing {:.2}\n",
            exponent(rows, |row| row.order1),
            exponent(rows, |row| row.order2),
            exponent(rows, |row| row.sizing),
        );
    }
}

/// The pattern of the config's initial mesh with about this many panels, and the config's structure.
fn great_court(panels: u32) -> (Pattern, StructureParams) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/great_court.toml");
    let sets = [format!("pattern.panels={panels}"), "pattern.max_faces=100000".to_owned()];
    let config = ResolvedConfig::open(&file, &sets).unwrap();
    let study = Study::of(&config).unwrap();
    let design = study.develop(study.topology(&"".parse().unwrap()), Effort::Pattern).unwrap();
    (design.pattern, config.config().structure.clone().unwrap())
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let parts = arguments.iter().any(|a| a == "--parts");
    let filter: Vec<&String> = arguments.iter().filter(|a| !a.starts_with("--")).collect();
    let wanted = |name: &str| filter.is_empty() || filter.iter().any(|f| *f == name);
    let side = 40.0;
    let (_, structure) = great_court(500);
    let mut rows = Vec::new();
    for cells in [24, 48, 80] {
        let name = format!("grid {cells}");
        if wanted(&name) {
            let pattern =
                grid_shell([cells, cells], [side, side], |x, y| 0.15 * side * (1.0 - x * x) * (1.0 - y * y));
            rows.push(row(&name, &pattern, &structure, parts));
        }
    }
    print_growth(&rows);
    rows.clear();
    for panels in [2_000, 8_000, 20_000] {
        let name = format!("court {panels}");
        if wanted(&name) {
            let (pattern, structure) = great_court(panels);
            rows.push(row(&name, &pattern, &structure, parts));
        }
    }
    print_growth(&rows);
}
