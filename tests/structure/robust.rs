//! Random models, sound and broken: the answer is in equilibrium, or the error has a name. Never a panic, never NaN.

use quadrille::random::{self, Rng};
use quadrille::structure::{FrameError, FrameResult, file, frame};
use serde_json::{Value, json};

/// How many models; `QUADRILLE_MODELS=10000` runs the whole promise (about a minute).
fn models() -> u32 {
    std::env::var("QUADRILLE_MODELS").ok().and_then(|n| n.parse().ok()).unwrap_or(400)
}

fn pick(rng: &mut Rng, values: &[f64]) -> f64 {
    values[random::below(rng, values.len())]
}

fn spread(rng: &mut Rng) -> f64 {
    random::unit(rng) - 0.5
}

/// A model of 2 to 30 nodes: a random tree with some cycles; then, often, something is broken.
fn model(seed: u32) -> Value {
    let rng = &mut random::stream(2026, 0, seed);
    let count = 2 + random::below(rng, 29);
    let size = pick(rng, &[1.0, 10.0, 10.0, 1e-3, 1e4]);
    let mut nodes: Vec<Vec<f64>> = (0..count).map(|_| (0..3).map(|_| size * spread(rng)).collect()).collect();
    let up = |rng: &mut Rng| vec![spread(rng), spread(rng), 0.5 + spread(rng)];
    let mut members: Vec<Value> =
        (1..count).map(|n| json!({"start": random::below(rng, n), "end": n, "up": up(rng)})).collect();
    for _ in 0..random::below(rng, count) {
        let (a, b) = (random::below(rng, count), random::below(rng, count));
        let joins = |m: &Value, x: usize, y: usize| m["start"] == json!(x) && m["end"] == json!(y);
        let there = members.iter().any(|m| joins(m, a, b) || joins(m, b, a));
        if a != b && !there {
            members.push(json!({"start": a, "end": b, "up": up(rng)}));
        }
    }
    let mut supports: Vec<Value> = (0..1 + random::below(rng, 3))
        .map(|_| {
            let all = random::chance(rng, 0.6);
            let fixed: Vec<bool> = (0..6).map(|_| all || random::chance(rng, 0.5)).collect();
            json!({"node": random::below(rng, count), "fixed": fixed})
        })
        .collect();
    let load = pick(rng, &[1.0, 1e3, 1e3, 1e5, 1e-9, 0.0]);
    let mut nodal: Vec<Value> = (0..random::below(rng, 5))
        .map(|_| {
            let force: Vec<f64> = (0..3).map(|_| load * spread(rng)).collect();
            let moment: Vec<f64> = (0..3).map(|_| load * size * spread(rng)).collect();
            json!({"node": random::below(rng, count), "force": force, "moment": moment})
        })
        .collect();
    let mut e = pick(rng, &[210e9, 210e9, 1e3, 1e18]);
    match random::below(rng, 16) {
        0 => supports.clear(),
        1 => nodes[0] = nodes[1].clone(),
        2 => nodes.push(vec![9.0 * size, 0.0, 0.0]),
        3 => members.push(members[0].clone()),
        4 => nodal.push(json!({"node": 0, "force": [f64::INFINITY, 0.0, 0.0]})),
        5 => nodal.push(json!({"node": count + 7, "force": [1.0, 0.0, 0.0]})),
        6 => members[0]["end"] = json!(count),
        7 => e = pick(rng, &[1e-300, 1e300, 0.0, -1.0]),
        8 => nodes[0][0] = 1e12,
        9 => nodes[1] = nodes[0].iter().map(|x| x + 1e-7 * size).collect(),
        10 => members[0]["up"] = json!([0.0, 0.0, 0.0]),
        _ => {}
    }
    let section = if random::chance(rng, 0.5) {
        json!({"kind": "box", "width": 0.02 * size, "height": 0.04 * size, "thickness": 0.002 * size})
    } else {
        let i = size.powi(4) * pick(rng, &[1e-6, 1e-9, 1e-14]);
        json!({"kind": "properties", "A": 1e-3 * size * size, "Iy": i, "Iz": 0.3 * i, "J": i, "Wy": i, "Wz": i})
    };
    json!({
        "material": {"E": e, "G": 0.4 * e, "density": 7850.0, "fy": 355e6},
        "section": section,
        "shear_deformation": random::chance(rng, 0.3),
        "nodes": nodes, "members": members, "supports": supports,
        "loads": {"nodal": nodal, "gravity": pick(rng, &[0.0, 9.81])},
        "analysis": {"order": 1 + random::below(rng, 2), "buckling_modes": random::below(rng, 3)},
    })
}

/// Largest stiffness against stretching over the smallest against bending, A/L over 12 I/L³, of all members. Forces are
/// differences of displacements: with 16 digits they are balanced to that many times 2e-16, and no better.
fn spread_of_stiffness(case: &Value) -> f64 {
    let section = &case["section"];
    let number = |key: &str| section[key].as_f64().unwrap_or(f64::NAN);
    let (area, i) = if section["kind"] == "box" {
        let (b, h, t) = (number("width"), number("height"), number("thickness"));
        (2.0 * t * (b + h), t * b * b * (b / 6.0 + 0.5 * h))
    } else {
        (number("A"), number("Iy").min(number("Iz")))
    };
    let nodes: Vec<[f64; 3]> = serde_json::from_value(case["nodes"].clone()).unwrap();
    let (mut stiff, mut soft) = (0.0f64, f64::INFINITY);
    for member in case["members"].as_array().unwrap() {
        let [a, b] = ["start", "end"].map(|end| nodes[member[end].as_u64().unwrap() as usize]);
        let length = (0..3).map(|d| (a[d] - b[d]).powi(2)).sum::<f64>().sqrt();
        stiff = stiff.max(area / length);
        soft = soft.min(12.0 * i / length.powi(3));
    }
    stiff / soft
}

/// Whether every number is finite and the free directions of every node are in equilibrium.
fn in_equilibrium(case: &Value, result: &FrameResult) -> Result<(), String> {
    let numbers = result.displacements.iter().flatten().chain(&result.buckling_factors);
    if numbers.into_iter().any(|v| !v.is_finite()) {
        return Err("a number is not finite".into());
    }
    let nodes: Vec<[f64; 3]> = serde_json::from_value(case["nodes"].clone()).unwrap();
    // Whole structure: reactions against loads, self weight included, in force.
    let mut sum = [0.0; 3];
    let mut size = 0.0f64;
    let mut add = |values: [f64; 3]| sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
    for load in case["loads"]["nodal"].as_array().unwrap() {
        add(serde_json::from_value(load["force"].clone()).unwrap());
    }
    add(result.total_reaction);
    // Reactions may be far larger than what they add up to.
    for (_, reaction) in &result.reactions {
        size = reaction.iter().take(3).flatten().fold(size, |a, r| a.max(r.abs()));
    }
    let weight: f64 = result.member_forces.iter().map(|f| f.load.norm() * f.length).sum();
    add([0.0, 0.0, -weight]);
    let loads =
        case["loads"]["nodal"].as_array().unwrap().iter().flat_map(|l| l["force"].as_array().unwrap());
    size = loads.filter_map(Value::as_f64).fold(size.max(weight), |a, v| a.max(v.abs()));
    if sum.iter().any(|s| s.abs() > 1e-5 * size.max(1e-300)) {
        return Err(format!("out of balance by {sum:?} of {size} ({} nodes)", nodes.len()));
    }
    Ok(())
}

#[test]
fn every_model_is_answered_or_its_error_named() {
    let mut tally = std::collections::BTreeMap::<&str, u32>::new();
    for seed in 0..models() {
        let case = model(seed);
        // Infinity cannot be written as a JSON value: as text they can.
        let text = case.to_string().replace("null", "1e999");
        let outcome = match file::read(&text) {
            Err(error) => {
                assert!(!error.to_string().is_empty());
                "refused"
            }
            Ok((model, analysis)) => match frame(&model, &analysis) {
                Ok(result) => {
                    if let Err(message) = in_equilibrium(&case, &result) {
                        panic!("seed {seed}: {message}\n{case}");
                    }
                    "answered"
                }
                Err(FrameError::Singular(motion)) => {
                    assert!((motion.node.0 as usize) < model.nodes().len());
                    "singular"
                }
                Err(FrameError::Unstable(_)) => "unstable",
                Err(FrameError::NotFinite) => "not finite",
                Err(FrameError::IllConditioned(left)) => {
                    // Said only where it cannot be otherwise.
                    let spread = spread_of_stiffness(&case);
                    assert!(spread > 1e8, "seed {seed}: {left:e} left over, spread {spread:e}\n{case}");
                    "ill-conditioned"
                }
                Err(FrameError::NoDigits | FrameError::Inexact(_) | FrameError::InexactFactors(_)) => {
                    let spread = spread_of_stiffness(&case);
                    let modulus = case["material"]["E"].as_f64().unwrap_or(f64::NAN);
                    assert!(
                        spread > 1e8 || !(1e-150..1e150).contains(&modulus),
                        "seed {seed}: no digits left, spread {spread:e}\n{case}"
                    );
                    "ill-conditioned"
                }
                Err(FrameError::NoConvergence | FrameError::NotSettled { .. }) => "not converged",
                Err(error) => panic!("seed {seed}: {error}\n{case}"),
            },
        };
        *tally.entry(outcome).or_default() += 1;
    }
    println!("{tally:?}");
    let count = |outcome| tally.get(outcome).copied().unwrap_or(0);
    assert!(count("not converged") <= models() / 200, "{tally:?}");
    for outcome in ["answered", "refused", "singular"] {
        assert!(tally.get(outcome).is_some_and(|n| *n > models() / 50), "{outcome} is too rare: {tally:?}");
    }
}
