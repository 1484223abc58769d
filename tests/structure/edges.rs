//! At the edges of what can be computed: mechanisms that rounding hides, states off the path from nothing, chains of
//! elements so short that digits run out. An answer is right or is refused, and the refusal names the reason.

use crate::support::columns;
use quadrille::structure::model::{FrameParts, LoadCase, NodalLoad, Support};
use quadrille::structure::{FrameAnalysis, FrameError, FrameModel, FrameResult, Order, file, frame};

fn answer(name: &str) -> Result<FrameResult, FrameError> {
    let path = format!("{}/tests/data/frame_faults/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    let (model, analysis) = file::read(&text).unwrap();
    frame(&model, &analysis)
}

/// Each model is refused, and for this reason.
fn refused(names: &[&str], is_reason: fn(&FrameError) -> bool) {
    for name in names {
        let answer = answer(name);
        let told = answer.as_ref().map(|a| a.max_displacement);
        assert!(answer.as_ref().is_err_and(is_reason), "{name}: {told:?}");
    }
}

#[test]
fn a_state_beyond_a_limit_point_is_no_answer() {
    assert!(answer("dome_0.460").is_ok());
    refused(
        &["dome_0.492", "offpath_200162_0.765", "offpath_200162_0.770", "offpath_dome_300035"],
        |error| matches!(error, FrameError::Unstable(_)),
    );
}

#[test]
fn a_mechanism_of_slender_members_is_one() {
    refused(&["mech_inplane_3000_1", "mech_none_2000_4"], |error| matches!(error, FrameError::Singular(_)));
}

#[test]
fn what_members_without_stiffness_do_not_hold_is_named() {
    refused(&["noJ_axis", "truss_bar_axis", "truss_triangle", "zeroI_10651"], |error| {
        matches!(error, FrameError::Singular(_))
    });
}

#[test]
fn a_mechanism_among_motions_next_to_free_is_not_answered() {
    // Two motions are free, and the next have 3e-15, 3e-14 and 4e-14 of the stiffness.
    assert!(answer("zeroI_10036").is_err());
}

/// A cantilever of 10 m in an odd direction, in `count` elements, pushed along itself and across at its tip; and the factor
/// of the load along it, by Euler.
fn column(count: u32, axis: [f64; 3], across: f64) -> (FrameParts, f64) {
    let length = axis.iter().map(|a| a * a).sum::<f64>().sqrt();
    let x = axis.map(|a| a / length);
    let mut parts = columns(1, count, 0.0);
    for (k, node) in parts.nodes.iter_mut().enumerate() {
        *node = x.map(|x| 10.0 * x * k as f64 / f64::from(count));
    }
    parts.members.iter_mut().for_each(|member| member.up = [-x[1], x[0], 0.5]);
    parts.supports = vec![Support::fixed(0, [true; 6])];
    let push = 1e4;
    // Across: perpendicular to x, in the plan.
    let side = x[0].hypot(x[1]);
    let load = [
        -push * x[0] - across * x[1] / side,
        -push * x[1] + across * x[0] / side,
        -push * x[2],
        0.0,
        0.0,
        0.0,
    ];
    parts.load_cases = vec![LoadCase { nodal: vec![NodalLoad { node: count, load }], ..LoadCase::default() }];
    let stiffness = parts.material.youngs_modulus * parts.sections[0].iy;
    (parts, std::f64::consts::PI.powi(2) * stiffness / (400.0 * push))
}

fn analyse(parts: FrameParts, order: Order, buckling_modes: usize) -> Result<FrameResult, FrameError> {
    frame(&FrameModel::new(parts).unwrap(), &FrameAnalysis { order, buckling_modes })
}

fn is_ill_conditioned(error: &FrameError) -> bool {
    matches!(
        error,
        FrameError::Inexact(_)
            | FrameError::InexactFactors(_)
            | FrameError::IllConditioned(_)
            | FrameError::NoDigits
    )
}

#[test]
fn buckling_factors_of_fine_chains_are_right_or_refused() {
    for axis in [[1.0, 2.0, 2.0], [1.0, 0.0, 0.0]] {
        for count in [100, 1_000, 3_000, 10_000] {
            let (parts, euler) = column(count, axis, 0.0);
            match analyse(parts, Order::First, 2) {
                Ok(result) => {
                    let factors = result.buckling_factors;
                    assert_eq!(factors.len(), 2, "{axis:?}, {count}");
                    assert!(
                        factors.iter().all(|f| (f / euler - 1.0).abs() < 1e-6),
                        "{count}: {factors:?} for {euler}"
                    );
                }
                Err(error) => {
                    assert!(count > 1_000 && is_ill_conditioned(&error), "{axis:?}, {count}: {error}")
                }
            }
        }
    }
}

#[test]
fn displacements_of_fine_chains_are_right_or_refused() {
    let mut answered = 0;
    for axis in [[1.0, 2.0, 2.0], [1.0, 0.0, 0.0]] {
        for order in [Order::First, Order::Second] {
            let exact = analyse(column(20, axis, 100.0).0, order, 0).unwrap().max_displacement.0;
            for count in [200, 2_000, 20_000] {
                match analyse(column(count, axis, 100.0).0, order, 0) {
                    Ok(result) => {
                        let off = result.max_displacement.0 / exact - 1.0;
                        assert!(off.abs() < 2e-6, "{axis:?}, {order:?}, {count}: {off:e}");
                        answered += 1;
                    }
                    Err(error) => {
                        assert!(is_ill_conditioned(&error), "{axis:?}, {order:?}, {count}: {error}")
                    }
                }
            }
        }
    }
    assert!(answered >= 8, "{answered} of 12 answered");
}

#[test]
fn nearly_equal_columns_each_have_their_factor() {
    let text = include_str!("../data/frame_faults/columns_near.json");
    let (model, _) = file::read(text).unwrap();
    let mut loads: Vec<f64> = model.load_cases()[0]
        .nodal
        .iter()
        .map(|load| load.load.iter().map(|f| f * f).sum::<f64>().sqrt())
        .collect();
    loads.sort_by(|a, b| b.total_cmp(a));
    let factors = answer("columns_near").unwrap().buckling_factors;
    // Each column has its own twice, for its two equal axes; load times factor is that of all.
    let critical = factors[0] * loads[0];
    for (k, factor) in factors.iter().enumerate() {
        let off = factor * loads[k / 2] / critical - 1.0;
        assert!(off.abs() < 2e-9, "{k}: {factor}, {off:e} off");
    }
}

#[test]
fn fewer_factors_than_asked_for_are_remarked_on() {
    let result = answer("two_columns").unwrap();
    assert_eq!(result.buckling_factors.len(), 4);
    assert!(
        result.remarks().iter().any(|remark| remark.contains("1e8 times the least")),
        "{:?}",
        result.remarks()
    );
}

#[test]
fn no_factor_of_an_ill_conditioned_model_is_wrong() {
    // Of 50 digits.
    let exact = [4.791981373e-5, 5.806450446e-4, 8.230470483e-4];
    match answer("ill_42") {
        Ok(result) => {
            for (factor, exact) in result.buckling_factors.iter().zip(exact) {
                assert!((factor / exact - 1.0).abs() < 1e-6, "{factor} for {exact}");
            }
            assert_eq!(result.buckling_factors.len(), 3);
        }
        Err(error) => assert!(is_ill_conditioned(&error), "{error}"),
    }
}
