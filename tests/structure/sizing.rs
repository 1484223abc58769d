//! The sized height against all heights: roofs small enough to be analysed at every one of them.

use crate::support::grid_shell;
use quadrille::geometry::Pattern;
use quadrille::random;
use quadrille::structure::gridshell::{AnalysisError, GridshellModel, analyse};
use quadrille::structure::params::{HeightParams, Quantity, StructureParams};
use quadrille::structure::second_order::{Aim, Room};
use quadrille::structure::solver::Solver;
use std::collections::BTreeMap;

const MIN: f64 = 0.06;
const MAX: f64 = 0.6;
/// Step of the heights that are all analysed.
const STEP: f64 = 0.01;
/// Width of the bracket in which sizing ends.
const RESOLUTION: f64 = 1e-4;

/// A dome, a barrel or a saddle on a rectangular plan, and requirements of which now this, now that one governs.
fn roof(seed: u32) -> (Pattern, StructureParams) {
    let rng = &mut random::stream(2026, 11, seed);
    let mut between = |low: f64, high: f64| low + (high - low) * random::unit(rng);
    let cells = [between(4.0, 7.9), between(4.0, 7.9)].map(|n| n as u32);
    let plan = [between(10.0, 40.0), between(10.0, 40.0)];
    let rise = between(0.08, 0.25) * plan[0].min(plan[1]);
    let kind = seed % 3;
    let pattern = grid_shell(cells, plan, move |x, y| match kind {
        0 => rise * (1.0 - x * x) * (1.0 - y * y),
        1 => rise * (1.0 - x * x),
        _ => rise * (x * x - y * y),
    });
    let mut params: StructureParams = serde_json::from_str("{}").unwrap();
    params.order = if seed.is_multiple_of(4) { 1 } else { 2 };
    params.requirements[0].max = Some(between(0.02, 0.3));
    params.requirements[1].max = Some(between(0.3, 1.5));
    params.requirements[2].min = Some(between(2.0, 40.0));
    (pattern, params)
}

fn at(params: &StructureParams, height: HeightParams) -> StructureParams {
    StructureParams { height, ..params.clone() }
}

fn sized(params: &StructureParams) -> StructureParams {
    at(params, HeightParams::Sized { min_m: MIN, max_m: MAX, step_m: STEP })
}

/// Whether all requirements are met at a height; a roof that does not stand meets none.
fn meets(pattern: &Pattern, params: &StructureParams, fixed_m: f64) -> bool {
    match analyse(pattern, &at(params, HeightParams::Fixed { fixed_m })) {
        Ok(response) => response.violation() == 0.0,
        Err(AnalysisError::Unstable { .. } | AnalysisError::NoConvergence(_)) => false,
        Err(error) => panic!("{error}"),
    }
}

/// Test the largest, then bisect (docs/reference/structure.md §6.3).
fn bisected(pattern: &Pattern, params: &StructureParams) -> Option<f64> {
    let (mut low, mut high) = (MIN, MAX);
    if !meets(pattern, params, high) {
        return None;
    }
    if meets(pattern, params, low) {
        return Some(low);
    }
    while high - low > 0.1 * RESOLUTION {
        let middle = 0.5 * (low + high);
        if meets(pattern, params, middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(high)
}

#[test]
fn the_sized_height_is_the_least_of_all_heights() {
    let mut governing: BTreeMap<String, u32> = BTreeMap::new();
    for seed in 0..48 {
        let (pattern, params) = roof(seed);
        let response = analyse(&pattern, &sized(&params)).unwrap();
        let Some(expected) = bisected(&pattern, &params) else {
            assert!(response.height_m == MAX && response.violation() > 0.0, "{seed}: {response:?}");
            *governing.entry("none is enough".into()).or_default() += 1;
            continue;
        };
        assert!(
            (response.height_m - expected).abs() <= RESOLUTION,
            "{seed}: {} {expected}",
            response.height_m
        );
        assert_eq!(response.violation(), 0.0, "{seed}: {response:?}");
        // Nothing below it will do; what is above will.
        let steps = ((MAX - MIN) / STEP).round() as u32;
        for height in (0..=steps).map(|i| MIN + STEP * f64::from(i)) {
            if (height - expected).abs() > RESOLUTION {
                assert_eq!(
                    meets(&pattern, &params, height),
                    height > expected,
                    "{seed}: {height} {expected}"
                );
            }
        }
        let name = if response.height_m == MIN {
            "the least height".into()
        } else {
            response.governing().unwrap().quantity.to_string()
        };
        *governing.entry(name).or_default() += 1;
    }
    for name in ["deflection", "utilisation", "buckling_factor", "the least height", "none is enough"] {
        assert!(governing.contains_key(name), "{name} never governs: {governing:?}");
    }
}

#[test]
fn more_load_or_a_stricter_requirement_asks_for_no_less_height() {
    for seed in 0..12 {
        let (pattern, params) = roof(seed);
        let height = |change: &dyn Fn(&mut StructureParams)| {
            let mut params = sized(&params);
            change(&mut params);
            analyse(&pattern, &params).unwrap().height_m
        };
        let asked = height(&|_| ());
        for share in [0.95, 0.7, 0.4] {
            let stricter = height(&|params| {
                for required in &mut params.requirements {
                    required.max = required.max.map(|max| max * share);
                    required.min = required.min.map(|min| min / share);
                }
            });
            let heavier = height(&|params| {
                for factors in params.combinations.values_mut() {
                    factors.values_mut().for_each(|factor| *factor /= share);
                }
            });
            assert!(stricter >= asked - RESOLUTION && heavier >= asked - RESOLUTION, "{seed}: {asked}");
        }
        let without =
            height(&|params| params.requirements.retain(|r| r.analysed() == Some(Quantity::Deflection)));
        assert!(without <= asked + RESOLUTION, "{seed}: {without} {asked}");
    }
}

/// A vault held all around: past its first factor, where it sways to one side, the symmetric equilibrium that the
/// symmetric load asks for is still there, and the iteration settles on it.
#[test]
fn an_equilibrium_that_is_not_stable_is_no_answer() {
    let mut settled = 0;
    for cells in [8, 10, 12] {
        let pattern = grid_shell([cells, 4], [20.0, 60.0], |x, _| 5.0 * (1.0 - x * x));
        let mut params: StructureParams = serde_json::from_str(
            r#"{"support":[{"at":"boundary","fixed":["ux","uy","uz"]}], "height":{"fixed_m":0.1}}"#,
        )
        .unwrap();
        params.combinations.remove("sls");
        params.requirements.clear();
        let scaled = |factor: f64, order| {
            let mut params = StructureParams { order, ..params.clone() };
            params.combinations.values_mut().flat_map(|c| c.values_mut()).for_each(|f| *f *= factor);
            params
        };
        let first = analyse(&pattern, &scaled(1.0, 1)).unwrap().buckling_factor;
        assert!(analyse(&pattern, &scaled(0.9 * first, 2)).is_ok(), "{cells}");
        let past = scaled(1.05 * first, 2);
        let answer = analyse(&pattern, &past);
        assert!(matches!(answer, Err(AnalysisError::Unstable { .. })), "{cells}: {answer:?}");
        settled += u32::from(settles(&pattern, &past));
    }
    assert!(settled > 0);
}

/// Whether the iteration with the factor of K settles.
fn settles(pattern: &Pattern, params: &StructureParams) -> bool {
    let model = GridshellModel::new(pattern, params, 0.1).unwrap();
    let mut solver = Solver::new(&model.frame).unwrap();
    solver.set_sections(model.frame.sections()).unwrap();
    let cases: Vec<(usize, f64)> = params.combinations["uls"].values().copied().enumerate().collect();
    let mut loads = Vec::new();
    solver.member_loads(&cases, &mut loads);
    let action = solver.action(&cases, &loads);
    let mut u = solver.first_order(&action).0.u;
    let aim = Aim { second_order: true, tolerance: 1e-6 };
    solver.iterate(&action.f, &[&[]], &mut u, aim, &mut Room::default())
}
