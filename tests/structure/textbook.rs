//! Models with known answers beside the reference cases: other directions, supports, loads, sections. SI units.

use quadrille::structure::model::{
    FrameParts, LoadCase, Material, Member, MemberKind, NodalLoad, Support, UniformLoad,
};
use quadrille::structure::section::Section;
use quadrille::structure::{FrameAnalysis, FrameError, FrameModel, FrameResult, Order, frame};
use std::f64::consts::PI;

const E: f64 = 210e9;
const G: f64 = 81e9;
const STRONG: f64 = 3e-5;
const WEAK: f64 = 1e-5;
const FREE: [bool; 6] = [false; 6];
const CLAMPED: [bool; 6] = [true; 6];

fn section() -> Section {
    Section {
        area: 4e-3,
        iy: STRONG,
        iz: WEAK,
        j: 2e-5,
        wy: 2e-4,
        wz: 1e-4,
        asy: 0.0,
        asz: 0.0,
        shear: None,
        shape: None,
    }
}

/// A polyline of members; `held[i]` for the nodes named.
fn polyline(nodes: Vec<[f64; 3]>, up: [f64; 3], held: &[(usize, [bool; 6])]) -> FrameParts {
    let members = (1..nodes.len() as u32)
        .map(|end| Member { start: end - 1, end, up, section: 0, kind: MemberKind::RIGID })
        .collect();
    FrameParts {
        nodes,
        members,
        sections: vec![section()],
        material: Material {
            youngs_modulus: E,
            shear_modulus: G,
            density: 7850.0,
            strength: 355e6,
            thermal_expansion: 1.2e-5,
        },
        shear_deformation: false,
        supports: held.iter().map(|&(node, fixed)| Support::fixed(node as u32, fixed)).collect(),
        load_cases: vec![LoadCase::default()],
    }
}

/// `count` members from `a` to `b`.
fn straight(a: [f64; 3], b: [f64; 3], count: usize) -> Vec<[f64; 3]> {
    let at = |i: usize| std::array::from_fn(|d| a[d] + (b[d] - a[d]) * i as f64 / count as f64);
    (0..=count).map(at).collect()
}

fn push(parts: &mut FrameParts, node: usize, load: [f64; 6]) {
    parts.load_cases[0].nodal.push(NodalLoad { node: node as u32, load });
}

fn load_all(parts: &mut FrameParts, force_per_length: [f64; 3]) {
    let all = 0..parts.members.len() as u32;
    parts.load_cases[0].uniform = all.map(|member| UniformLoad { member, force_per_length }).collect();
}

fn answer(parts: FrameParts, order: Order, buckling_modes: usize) -> Result<FrameResult, FrameError> {
    frame(&FrameModel::new(parts).unwrap(), &FrameAnalysis { order, buckling_modes })
}

fn reaction(result: &FrameResult, node: u32, direction: usize) -> f64 {
    result.reactions.iter().find(|(n, _)| n.0 == node).unwrap().1[direction].unwrap()
}

#[track_caller]
fn close(got: f64, want: f64, relative: f64) {
    assert!((got / want - 1.0).abs() <= relative, "{got}, not {want}");
}

/// A propped cantilever under q: 3/8 qL at the prop, qL²/8 at the wall; and its utilisation.
#[test]
fn propped_cantilever() {
    let (q, l) = (5e3, 4.0);
    let prop = [false, true, true, true, false, false];
    let mut parts =
        polyline(straight([0.0; 3], [l, 0.0, 0.0], 4), [0.0, 0.0, 1.0], &[(0, CLAMPED), (4, prop)]);
    load_all(&mut parts, [0.0, 0.0, -q]);
    let result = answer(parts, Order::First, 0).unwrap();
    close(reaction(&result, 4, 2), 0.375 * q * l, 1e-9);
    close(reaction(&result, 0, 4).abs(), q * l * l / 8.0, 1e-9);
    close(result.utilisation().unwrap().0, q * l * l / 8.0 / 2e-4 / 355e6, 1e-9);
}

/// Two equal spans along y under q: 5/4 qL in the middle.
#[test]
fn two_spans() {
    let (q, l) = (5e3, 4.0);
    let held = [
        (0, [true, true, true, false, true, false]),
        (2, [true, false, true, false, false, false]),
        (4, [true, false, true, false, false, false]),
    ];
    let mut parts = polyline(straight([0.0; 3], [0.0, 2.0 * l, 0.0], 4), [0.0, 0.0, 1.0], &held);
    load_all(&mut parts, [0.0, 0.0, -q]);
    close(reaction(&answer(parts, Order::First, 0).unwrap(), 2, 2), 1.25 * q * l, 1e-9);
}

/// A cantilever bent at a right angle, loaded across its plane: bending of both parts and torsion of the first.
#[test]
fn bent_cantilever_twists() {
    let (p, a, b) = (1e3, 2.0, 1.0);
    let nodes = vec![[0.0; 3], [a, 0.0, 0.0], [a, b, 0.0]];
    let mut parts = polyline(nodes, [0.0, 0.0, 1.0], &[(0, CLAMPED)]);
    push(&mut parts, 2, [0.0, 0.0, -p, 0.0, 0.0, 0.0]);
    let sinks = -answer(parts, Order::First, 0).unwrap().displacements[2][2];
    close(sinks, p * (a.powi(3) + b.powi(3)) / (3.0 * E * STRONG) + p * b * b * a / (G * 2e-5), 1e-9);
}

/// Self weight of a beam that climbs 4 m over 3 m, clamped at both ends: (w cos) L²/12 and (w sin) L/2.
#[test]
fn inclined_beam_under_its_weight() {
    let mut parts = polyline(vec![[0.0; 3], [3.0, 0.0, 4.0]], [0.0, 0.0, 1.0], &[(0, CLAMPED), (1, CLAMPED)]);
    parts.load_cases[0].gravity = 9.81;
    let w = 7850.0 * 4e-3 * 9.81;
    let result = answer(parts, Order::First, 0).unwrap();
    close(result.total_reaction[2], 5.0 * w, 1e-12);
    close(result.member_forces[0].start.my.abs(), 0.6 * w * 25.0 / 12.0, 1e-9);
    close(result.member_forces[0].start.n, -0.8 * w * 2.5, 1e-9);
}

/// A beam on two hinges under q, pulled or pushed by N (Timoshenko and Gere 1961, §1.5, §1.11): the closed forms with
/// k² = |N|/EI, and both Euler loads of the push.
#[test]
fn tie_and_strut_under_load_across() {
    let (q, n, l, count) = (5e3, 3e5, 6.0, 16);
    let k = f64::sqrt(n / (E * STRONG));
    let half = 0.5 * k * l;
    let pulled = q / (n * k * k) * (1.0 / half.cosh() - 1.0) + q * l * l / (8.0 * n);
    let pushed = q / (n * k * k) * (1.0 / half.cos() - 1.0) - q * l * l / (8.0 * n);
    for (sign, expected) in [(1.0, pulled), (-1.0, pushed)] {
        let held =
            [(0, [true, true, true, true, false, false]), (count, [false, true, true, false, false, false])];
        let mut parts = polyline(straight([0.0; 3], [l, 0.0, 0.0], count), [0.0, 0.0, 1.0], &held);
        load_all(&mut parts, [0.0, 0.0, -q]);
        push(&mut parts, count, [sign * n, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let result = answer(parts, Order::Second, 2).unwrap();
        close(-result.displacements[count / 2][2], expected, 1e-6);
        if sign > 0.0 {
            assert!(result.buckling_factors.is_empty(), "{:?}", result.buckling_factors);
        } else {
            close(result.buckling_factors[0], PI * PI * E * WEAK / (l * l * n), 1e-5);
            close(result.buckling_factors[1], PI * PI * E * STRONG / (l * l * n), 1e-5);
        }
    }
}

/// A portal on hinges sways at k h tan(k h) = 6 h / b (columns and beam alike; Timoshenko and Gere 1961, §2.4).
#[test]
fn portal_on_hinges_sways() {
    let (h, b, p, count) = (4.0, 6.0, 1e5, 10);
    let mut nodes = straight([0.0; 3], [0.0, 0.0, h], count);
    nodes.extend_from_slice(&straight([0.0, 0.0, h], [b, 0.0, h], count)[1..]);
    nodes.extend_from_slice(&straight([b, 0.0, h], [b, 0.0, 0.0], count)[1..]);
    let last = nodes.len() - 1;
    let in_plane = [false, true, false, true, false, true];
    let hinge = [true, true, true, true, false, true];
    let mut held: Vec<_> = (1..last).map(|n| (n, in_plane)).collect();
    held.extend([(0, hinge), (last, hinge)]);
    // Height across the plane, so that the weak axis bends in it; stiff against shortening.
    let mut parts = polyline(nodes, [0.0, 1.0, 0.0], &held);
    parts.sections[0].area = 4.0;
    for top in [count, 2 * count] {
        push(&mut parts, top, [0.0, 0.0, -p, 0.0, 0.0, 0.0]);
    }
    let (mut low, mut high) = (0.0, 0.5 * PI);
    for _ in 0..60 {
        let x: f64 = 0.5 * (low + high);
        if x * x.tan() < 6.0 * h / b { low = x } else { high = x }
    }
    close(
        answer(parts, Order::First, 1).unwrap().buckling_factors[0],
        low * low * E * WEAK / (h * h * p),
        1e-6,
    );
}

/// A column clamped at both ends, just below and just above its Euler load 4π²EI/L².
#[test]
fn clamped_column_up_to_its_load_and_no_further() {
    for share in [0.95, 1.05] {
        let held = [(0, CLAMPED), (8, [true, true, false, true, true, true])];
        let mut parts = polyline(straight([0.0; 3], [0.0, 0.0, 5.0], 8), [1.0, 0.0, 0.0], &held);
        push(&mut parts, 8, [0.0, 0.0, -share * 4.0 * PI * PI * E * WEAK / 25.0, 0.0, 0.0, 0.0]);
        match answer(parts, Order::Second, 1) {
            Ok(result) => {
                assert!(share < 1.0);
                close(result.buckling_factors[0], 1.0 / share, 1e-3);
            }
            Err(FrameError::Unstable(motion)) => assert!(share > 1.0 && motion.node.0 == 4, "{motion:?}"),
            Err(error) => panic!("{error}"),
        }
    }
}

/// Shear areas count per direction: along y given, along z rigid.
#[test]
fn shear_in_one_direction_only() {
    let mut parts = polyline(vec![[0.0; 3], [1.0, 0.0, 0.0]], [0.0, 0.0, 1.0], &[(0, CLAMPED), (1, FREE)]);
    parts.shear_deformation = true;
    parts.sections[0].asy = 2e-3;
    push(&mut parts, 1, [0.0, 1e3, 1e3, 0.0, 0.0, 0.0]);
    let u = answer(parts, Order::First, 0).unwrap().displacements[1];
    close(u[1], 1e3 / (3.0 * E * WEAK) + 1e3 / (G * 2e-3), 1e-9);
    close(u[2], 1e3 / (3.0 * E * STRONG), 1e-9);
}
