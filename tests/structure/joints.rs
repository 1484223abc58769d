//! Joints, trusses, spring supports, settlements and temperature: closed forms, limits, invariance, and a second solver.

use crate::independent::Dense;
use crate::support::{dome, random_tower, renumbered, rotated};
use quadrille::random;
use quadrille::structure::gridshell::GridshellModel;
use quadrille::structure::model::{
    EndJoint, FrameParts, Joint, LoadCase, Material, Member, MemberKind, ModelError, NodalLoad, PressureLoad,
    Settlement, Support, TemperatureLoad, UniformLoad,
};
use quadrille::structure::params::StructureParams;
use quadrille::structure::section::Section;
use quadrille::structure::{FrameAnalysis, FrameError, FrameModel, FrameResult, Order, frame};
use std::f64::consts::PI;

const E: f64 = 210e9;
const IY: f64 = 3e-5;
const IZ: f64 = 1e-5;
const AREA: f64 = 4e-3;
const ALPHA: f64 = 1.2e-5;
const EI: f64 = E * IY;
/// What keeps a plane frame in the x–z plane.
const IN_PLANE: [bool; 6] = [false, true, false, true, false, true];
const CLAMPED: [bool; 6] = [true; 6];

/// A model of members in a row or otherwise, all of one section, without loads.
fn parts(nodes: Vec<[f64; 3]>, members: &[(u32, u32)], up: [f64; 3], supports: Vec<Support>) -> FrameParts {
    let member = |&(start, end): &(u32, u32)| Member { start, end, up, section: 0, kind: MemberKind::RIGID };
    FrameParts {
        nodes,
        members: members.iter().map(member).collect(),
        sections: vec![Section {
            area: AREA,
            iy: IY,
            iz: IZ,
            j: 2e-5,
            wy: 2e-4,
            wz: 1e-4,
            asy: 0.0,
            asz: 0.0,
            shear: None,
            shape: None,
        }],
        material: Material {
            youngs_modulus: E,
            shear_modulus: 81e9,
            density: 7850.0,
            strength: 355e6,
            thermal_expansion: ALPHA,
        },
        shear_deformation: false,
        supports,
        load_cases: vec![LoadCase::default()],
    }
}

/// A beam along x of `count` members; every node kept in the x–z plane.
fn beam(length: f64, count: u32, mut supports: Vec<Support>) -> FrameParts {
    let at = |i: u32| [length * f64::from(i) / f64::from(count), 0.0, 0.0];
    let members: Vec<(u32, u32)> = (0..count).map(|i| (i, i + 1)).collect();
    supports.extend((0..=count).map(|n| Support::fixed(n, IN_PLANE)));
    parts((0..=count).map(at).collect(), &members, [0.0, 0.0, 1.0], supports)
}

fn uniform(parts: &mut FrameParts, force_per_length: [f64; 3]) {
    let all = 0..parts.members.len() as u32;
    parts.load_cases[0].uniform = all.map(|member| UniformLoad { member, force_per_length }).collect();
}

fn push(parts: &mut FrameParts, node: u32, load: [f64; 6]) {
    parts.load_cases[0].nodal.push(NodalLoad { node, load });
}

fn bending(joint: Joint) -> EndJoint {
    EndJoint { bending_y: joint, ..EndJoint::RIGID }
}

fn try_solve(parts: &FrameParts, order: Order, buckling_modes: usize) -> Result<FrameResult, FrameError> {
    frame(&FrameModel::new(parts.clone()).unwrap(), &FrameAnalysis { order, buckling_modes })
}

fn solve(parts: &FrameParts, order: Order, buckling_modes: usize) -> FrameResult {
    try_solve(parts, order, buckling_modes).unwrap()
}

fn close(found: f64, expected: f64, share: f64, what: &str) {
    let error = (found - expected).abs();
    assert!(error <= share * expected.abs().max(1e-12), "{what}: {found} instead of {expected}");
}

/// The stiffness of springs beside EI/L, from hinge to rigid.
const SPRINGS: [f64; 8] = [0.0, 1e-9, 0.1, 1.0, 8.0, 25.0, 1e6, 1e13];

/// Uniform load q on a beam whose two ends are joined to walls by springs k, κ = kL/EI (Chen and Lui 1991, *Stability
/// Design of Steel Frames*, §5.3): the end moment is qL²/12 · κ/(κ + 2), and the deflection in the middle that of the
/// simple beam less M L²/8EI.
#[test]
fn beam_with_end_springs() {
    let (length, q) = (6.0, 5e3);
    for kappa in SPRINGS {
        let walls = vec![Support::fixed(0, CLAMPED), Support::fixed(2, CLAMPED)];
        let mut model = beam(length, 2, walls);
        // EI/L is that of a member: of half the beam.
        let joint = bending(Joint::Relative(0.5 * kappa));
        model.members[0].kind = MemberKind::Beam([joint, EndJoint::RIGID]);
        model.members[1].kind =
            MemberKind::Beam([EndJoint::RIGID, bending(Joint::Absolute(kappa * EI / length))]);
        uniform(&mut model, [0.0, 0.0, -q]);
        let found = solve(&model, Order::First, 0);
        let moment = q * length * length / 12.0 * kappa / (kappa + 2.0);
        let sag = 5.0 * q * length.powi(4) / (384.0 * EI) - moment * length * length / (8.0 * EI);
        let what = format!("κ = {kappa}");
        close(-found.displacements[1][2], sag, 1e-9, &what);
        assert!((found.member_forces[0].start.my - moment).abs() < 1e-7 * q * length * length, "{what}");
        assert!((found.member_forces[1].end.my - moment).abs() < 1e-7 * q * length * length, "{what}");
        // What the springs give: M / k; of a hinge qL³/24EI.
        let slip =
            if kappa > 0.0 { moment / (kappa * EI / length) } else { q * length.powi(3) / (24.0 * EI) };
        let [start, _] = found.joint_rotations[0].1;
        close(start[1].abs(), slip, 1e-8, &what);
    }
}

/// Two springs and one member: the moment between the ends, which decides the utilisation, is that of the beam itself.
#[test]
fn inner_extremes_are_those_of_the_released_beam() {
    let (length, q) = (6.0, 5e3);
    let walls = vec![Support::fixed(0, CLAMPED), Support::fixed(1, CLAMPED)];
    let mut model = beam(length, 1, walls);
    model.members[0].kind = MemberKind::Beam([bending(Joint::HINGE); 2]);
    uniform(&mut model, [0.0, 0.0, -q]);
    let used = solve(&model, Order::First, 0).member_utilisation[0].unwrap();
    close(used.inner, q * length * length / 8.0 / 2e-4 / 355e6, 1e-12, "qL²/8 in the middle");
    assert!(used.ends < 1e-12);
}

/// A column between walls, joined by equal springs: tan(u)/u = −2/κ, u = ½ L √(P/EI) between π/2 and π (Timoshenko and
/// Gere 1961, §2.3): π²EI/L² between hinges, 4π²EI/L² between rigid joints.
#[test]
fn column_with_end_springs_buckles_at_the_root_of_its_equation() {
    const COUNT: u32 = 24;
    let length = 5.0;
    for kappa in SPRINGS {
        let mut walls = vec![Support::fixed(0, CLAMPED)];
        walls.push(Support::fixed(COUNT, [false, true, true, true, true, true]));
        let mut model = beam(length, COUNT, walls);
        let joint = bending(Joint::Absolute(kappa * EI / length));
        model.members[0].kind = MemberKind::Beam([joint, EndJoint::RIGID]);
        model.members[COUNT as usize - 1].kind = MemberKind::Beam([EndJoint::RIGID, joint]);
        push(&mut model, COUNT, [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let (mut low, mut high) = (0.5 * PI + 1e-12, PI);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if kappa * middle.sin() + 2.0 * middle * middle.cos() > 0.0 {
                low = middle
            } else {
                high = middle
            }
        }
        let critical = EI * (2.0 * low / length).powi(2);
        close(solve(&model, Order::First, 1).buckling_factors[0], critical, 2e-5, &format!("κ = {kappa}"));
    }
}

/// A bar of one element between two hinges still has a load at which it buckles by itself: 12 EI/L² with the cubic
/// shape, that is its own ends turn though its nodes stay. (Kg condensed with the shape of K alone would have none.)
#[test]
fn hinges_do_not_take_the_euler_load_from_a_bar() {
    let length = 5.0;
    let walls = vec![Support::fixed(0, CLAMPED), Support::fixed(1, [false, true, true, true, true, true])];
    let mut model = beam(length, 1, walls);
    let hinged = EndJoint { bending_z: Joint::HINGE, ..bending(Joint::HINGE) };
    model.members[0].kind = MemberKind::Beam([hinged; 2]);
    push(&mut model, 1, [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let found = solve(&model, Order::First, 2).buckling_factors;
    close(found[0], 12.0 * E * IZ / length.powi(2), 1e-9, "about z");
    close(found[1], 12.0 * EI / length.powi(2), 1e-9, "about y");
}

/// A three-hinged frame, statically determinate: under q on its beam the feet push with H = qL²/8h, and the corners take
/// H h.
#[test]
fn three_hinged_portal() {
    let (span, height, q) = (8.0, 4.0, 3e3);
    let nodes = vec![
        [0.0, 0.0, 0.0],
        [0.0, 0.0, height],
        [0.5 * span, 0.0, height],
        [span, 0.0, height],
        [span, 0.0, 0.0],
    ];
    let mut supports: Vec<Support> = (0..5).map(|n| Support::fixed(n, IN_PLANE)).collect();
    supports.extend([0, 4].map(|n| Support::fixed(n, [true, true, true, true, false, true])));
    let mut model = parts(nodes, &[(0, 1), (1, 2), (2, 3), (3, 4)], [0.6, 0.0, 0.8], supports);
    model.members[1].kind = MemberKind::Beam([EndJoint::RIGID, bending(Joint::HINGE)]);
    for member in [1, 2] {
        let load = UniformLoad { member, force_per_length: [0.0, 0.0, -q] };
        model.load_cases[0].uniform.push(load);
    }
    let found = solve(&model, Order::First, 0);
    let thrust = q * span * span / (8.0 * height);
    close(found.reactions[0].1[0].unwrap(), thrust, 1e-9, "H");
    close(found.member_forces[0].end.my.abs(), thrust * height, 1e-9, "corner");
    assert!(found.member_forces[1].end.my.abs() < 1e-6 * thrust * height, "the hinge takes none");
}

/// A bridge of three panels, by the method of joints: load P at one third.
///
/// ```text
///     3────4          bottom chord 0–1–2–5, each a; top chord 3–4; height a
///    ╱│ ╲  │╲         P down on node 1: supports take 2P/3 and P/3
///   0─1────2─5
/// ```
#[test]
fn truss_by_the_method_of_joints() {
    let (a, p) = (3.0, 9e4);
    let nodes = vec![
        [0.0, 0.0, 0.0],
        [a, 0.0, 0.0],
        [2.0 * a, 0.0, 0.0],
        [a, 0.0, a],
        [2.0 * a, 0.0, a],
        [3.0 * a, 0.0, 0.0],
    ];
    let bars = [(0, 1), (1, 2), (2, 5), (3, 4), (0, 3), (1, 3), (3, 2), (2, 4), (4, 5)];
    let mut supports: Vec<Support> =
        (0..6).map(|n| Support::fixed(n, [false, true, false, false, false, false])).collect();
    supports.push(Support::fixed(0, [true, false, true, false, false, false]));
    supports.push(Support::fixed(5, [false, false, true, false, false, false]));
    let mut model = parts(nodes, &bars, [0.0, 1.0, 0.0], supports);
    model.members.iter_mut().for_each(|m| m.kind = MemberKind::Truss);
    push(&mut model, 1, [0.0, 0.0, -p, 0.0, 0.0, 0.0]);
    let found = solve(&model, Order::First, 0);
    let root = 2f64.sqrt();
    let expected = [
        2.0 / 3.0,
        2.0 / 3.0,
        1.0 / 3.0,
        -1.0 / 3.0,
        -2.0 * root / 3.0,
        1.0,
        -root / 3.0,
        1.0 / 3.0,
        -root / 3.0,
    ];
    for (m, share) in expected.into_iter().enumerate() {
        let forces = &found.member_forces[m];
        close(forces.start.n, share * p, 1e-9, &format!("member {m}"));
        assert_eq!((forces.start.my, forces.start.mz, forces.start.mt), (0.0, 0.0, 0.0));
    }
    assert!(found.displacements.iter().all(|u| u[3..] == [0.0; 3]), "there are no rotations");
}

/// A cable of two trusses, level: it carries P only as far as it sags, and only in second order with pretension N:
/// w = P L / 2N for half spans L/2 … as a string.
#[test]
fn a_pretensioned_string_carries_by_its_geometry() {
    let (half, tension, p) = (4.0, 2e5, 100.0);
    let nodes = vec![[-half, 0.0, 0.0], [0.0, 0.0, 0.0], [half, 0.0, 0.0]];
    let supports = vec![
        Support::fixed(0, CLAMPED),
        Support::fixed(1, [false, true, false, false, false, false]),
        Support::fixed(2, CLAMPED),
    ];
    let mut model = parts(nodes, &[(0, 1), (1, 2)], [0.0, 0.0, 1.0], supports);
    model.members.iter_mut().for_each(|m| m.kind = MemberKind::Truss);
    // Something that resists a little, or the first order is a mechanism.
    let soft = 1.0;
    model.supports.push(Support { node: 1, fixed: [false; 6], stiffness: [0.0, 0.0, soft, 0.0, 0.0, 0.0] });
    // Cooled until it pulls: N = EAα ΔT.
    let kelvin = -tension / (E * AREA * ALPHA);
    model.load_cases[0].temperature = (0..2).map(|member| TemperatureLoad { member, kelvin }).collect();
    push(&mut model, 1, [0.0, 0.0, -p, 0.0, 0.0, 0.0]);
    let found = solve(&model, Order::Second, 0);
    close(-found.displacements[1][2], p / (2.0 * tension / half + soft), 1e-9, "w");
    close(found.member_forces[0].start.n, tension, 1e-9, "N");
}

/// A long beam on springs, k' N/m per m, under P: β = (k'/4EI)^¼, w = Pβ/2k' and M = P/4β below the load (Hetényi 1946,
/// *Beams on Elastic Foundation*, eq. 5).
#[test]
fn beam_on_elastic_foundation() {
    const COUNT: u32 = 400;
    let (length, per_metre, p) = (40.0, 2e6, 1e5);
    let step = length / f64::from(COUNT);
    let mut model = beam(length, COUNT, vec![Support::fixed(0, [true, false, false, false, false, false])]);
    for node in 0..=COUNT {
        let stiffness = [0.0, 0.0, per_metre * step, 0.0, 0.0, 0.0];
        model.supports.push(Support { node, fixed: [false; 6], stiffness });
    }
    push(&mut model, COUNT / 2, [0.0, 0.0, -p, 0.0, 0.0, 0.0]);
    let found = solve(&model, Order::First, 0);
    let beta = (per_metre / (4.0 * EI)).powf(0.25);
    let middle = COUNT as usize / 2;
    close(-found.displacements[middle][2], p * beta / (2.0 * per_metre), 1e-4, "w");
    close(found.member_forces[middle].start.my.abs(), p / (4.0 * beta), 1e-3, "M");
    close(found.total_reaction[2], p, 1e-9, "the springs carry it");
}

/// A beam of two spans L whose middle support sinks by δ: M there is 3EIδ/L².
#[test]
fn settlement_of_a_beam_of_two_spans() {
    let (span, sinks) = (5.0, 0.02);
    let pin = [true, true, true, true, false, true];
    let slide = [false, true, true, true, false, true];
    let mut model =
        beam(2.0 * span, 2, vec![Support::fixed(0, pin), Support::fixed(1, slide), Support::fixed(2, slide)]);
    model.load_cases[0].settlements =
        vec![Settlement { node: 1, displacement: [0.0, 0.0, -sinks, 0.0, 0.0, 0.0] }];
    for order in [Order::First, Order::Second] {
        let found = solve(&model, order, 0);
        close(found.member_forces[0].end.my.abs(), 3.0 * EI * sinks / (span * span), 1e-9, "M");
        close(found.displacements[1][2], -sinks, 1e-15, "δ");
        let [pull, push] = [found.reactions[1].1[2].unwrap(), found.reactions[0].1[2].unwrap()];
        close(pull, -6.0 * EI * sinks / span.powi(3), 1e-9, "pulled down");
        close(push, 3.0 * EI * sinks / span.powi(3), 1e-9, "the outer ones hold against it");
    }
}

/// Supports that move together move the structure as a whole: no force at all.
#[test]
fn a_settlement_of_all_supports_alike_costs_nothing() {
    let mut model = random_tower(3);
    model.load_cases[0].nodal.clear();
    let displacement = [0.1, -0.2, 0.05, 0.0, 0.0, 0.0];
    model.load_cases[0].settlements = (0..4).map(|node| Settlement { node, displacement }).collect();
    for order in [Order::First, Order::Second] {
        let found = solve(&model, order, 0);
        for (node, u) in found.displacements.iter().enumerate() {
            (0..6).for_each(|d| assert!((u[d] - displacement[d]).abs() < 1e-12, "{node}: {u:?}"));
        }
        // 1e-12 of EA/L × 0.1 m.
        assert!(found.member_forces.iter().all(|f| f.start.n.abs() < 1e-3));
    }
}

/// A bar warmed by ΔT: N = −EAα ΔT between walls, and u = α ΔT L where one end is free.
#[test]
fn heated_bar() {
    let (length, kelvin) = (7.0, 30.0);
    let walls = vec![Support::fixed(0, CLAMPED), Support::fixed(1, CLAMPED)];
    let mut model = beam(length, 1, walls);
    model.load_cases[0].temperature = vec![TemperatureLoad { member: 0, kelvin }];
    let held = solve(&model, Order::First, 0);
    close(held.member_forces[0].start.n, -E * AREA * ALPHA * kelvin, 1e-12, "N");
    close(held.reactions[0].1[0].unwrap(), E * AREA * ALPHA * kelvin, 1e-12, "the wall");
    model.supports.truncate(1);
    for order in [Order::First, Order::Second] {
        let free = solve(&model, order, 0);
        close(free.displacements[1][0], ALPHA * kelvin * length, 1e-12, "u");
        assert!(free.member_forces[0].end.n.abs() < 1e-6);
    }
}

/// A load against the members' own z is the same as one in global axes along it.
#[test]
fn pressure_acts_against_the_height_of_the_member() {
    let nodes = vec![[0.0; 3], [3.0, 0.0, 4.0]];
    let mut model = parts(nodes, &[(0, 1)], [0.0, 0.0, 1.0], vec![Support::fixed(0, CLAMPED)]);
    model.load_cases[0].pressure = vec![PressureLoad { member: 0, force_per_length: 1e3 }];
    let found = solve(&model, Order::First, 0);
    // q L⁴ / 8EI across a cantilever of 5 m; its z is (−0.8, 0, 0.6).
    let across = 1e3 * 5f64.powi(4) / (8.0 * EI);
    close(found.displacements[1][0], 0.8 * across, 1e-9, "x");
    close(found.displacements[1][2], -0.6 * across, 1e-9, "z");
}

/// A tower under a twentieth of its loads, so that it stands with hinges too.
fn lightly_loaded(seed: u32) -> FrameParts {
    let mut model = random_tower(seed);
    model.load_cases[0].nodal.iter_mut().for_each(|load| load.load = load.load.map(|f| 0.05 * f));
    model
}

/// What a random model has of all that there is.
fn random_frame(seed: u32) -> FrameParts {
    let mut model = lightly_loaded(seed);
    let rng = &mut random::stream(77, 0, seed);
    let count = model.members.len() as u32;
    let mut joint = |is_torsion: bool| match random::below(rng, if is_torsion { 3 } else { 5 }) {
        0 => Joint::Rigid,
        1 => Joint::Relative(20.0 * random::unit(rng)),
        2 => Joint::Absolute(1e6 * random::unit(rng)),
        3 => Joint::Relative(1e5),
        _ => Joint::HINGE,
    };
    for m in (0..count as usize).filter(|m| m % 3 != 2) {
        let end = |joint: &mut dyn FnMut(bool) -> Joint, hinged: bool| EndJoint {
            torsion: joint(true),
            bending_y: if hinged { joint(false) } else { joint(true) },
            bending_z: if hinged { joint(false) } else { joint(true) },
        };
        let ends = [end(&mut joint, true), end(&mut joint, false)];
        model.members[m].kind = MemberKind::Beam(ends);
    }
    // The braces, every fifth member of a storey's nine.
    for storey in 0..count / 9 {
        model.members[(9 * storey + 8) as usize].kind = MemberKind::Truss;
    }
    for (s, support) in model.supports.iter_mut().enumerate() {
        if s > 0 {
            support.fixed = [false, s != 1, true, false, false, true];
            support.stiffness = [1e7, 3e7, 0.0, 2e5, 1e6, 0.0];
        }
    }
    let case = &mut model.load_cases[0];
    case.uniform = (0..count)
        .map(|member| {
            let force_per_length = std::array::from_fn(|_| 2e2 * (random::unit(rng) - 0.5));
            UniformLoad { member, force_per_length }
        })
        .collect();
    case.temperature = (0..count).step_by(4).map(|member| TemperatureLoad { member, kelvin: 25.0 }).collect();
    case.pressure = vec![PressureLoad { member: 1, force_per_length: 800.0 }];
    case.settlements = vec![Settlement { node: 2, displacement: [0.0, 0.001, -0.002, 0.0, 0.0, 0.0] }];
    case.gravity = 9.81;
    model
}

/// The largest difference of displacements and of end forces, beside the largest of each.
fn agree(model: &FrameParts, share: f64, what: &str) {
    let dense = Dense::new(model);
    let (u, first) = dense.first_order();
    let (v, second) = dense.second_order();
    let found = [solve(model, Order::First, 1), solve(model, Order::Second, 0)];
    for ((result, u), axial) in found.iter().zip([&u, &v]).zip([None, Some(second.as_slice())]) {
        let largest = result.displacements.iter().flatten().fold(0.0f64, |a, x| a.max(x.abs()));
        for (n, d) in result.displacements.iter().enumerate() {
            for i in 0..6 {
                assert!(
                    (d[i] - u[6 * n + i]).abs() < share * largest,
                    "{what}, {:?}, node {n}",
                    result.order
                );
            }
        }
        let of = |f: &quadrille::structure::forces::MemberForces| -> [f64; 12] {
            let six = |r: &quadrille::structure::forces::Resultants| [r.n, r.vy, r.vz, r.mt, r.my, r.mz];
            let (start, end) = (six(&f.start), six(&f.end));
            std::array::from_fn(|i| if i < 6 { start[i] } else { end[i - 6] })
        };
        let most = result.member_forces.iter().flat_map(of).fold(0.0f64, |a, x| a.max(x.abs()));
        for (m, forces) in result.member_forces.iter().enumerate() {
            let expected = dense.forces(m, u, axial);
            for (i, found) in of(forces).into_iter().enumerate() {
                assert!(
                    (found - expected[i]).abs() < share * most,
                    "{what}, {:?}, member {m}, force {i}: {found} {}",
                    result.order,
                    expected[i]
                );
            }
        }
    }
    let factor = found[0].buckling_factors[0];
    assert!(dense.stands(&first, factor * (1.0 - share)), "{what}: a factor below {factor}");
    assert!(!dense.stands(&first, factor * (1.0 + share)), "{what}: none at {factor}");
}

#[test]
fn random_frames_agree_with_a_second_assembly() {
    for seed in 0..12 {
        agree(&random_frame(seed), 1e-8, &format!("seed {seed}"));
    }
}

/// A whole roof with rigid joints, and with springs of 25 and 8 EI/L at all member ends.
#[test]
fn a_roof_agrees_with_a_second_assembly() {
    let params: StructureParams = toml::from_str("height = { fixed_m = 0.2 }").unwrap();
    let roof = GridshellModel::new(&dome(8, 30.0, 4.0), &params, 0.2).unwrap().frame;
    let fixed = roof.fixed().iter().enumerate();
    let mut case = roof.load_cases()[0].clone();
    for other in &roof.load_cases()[1..] {
        case.nodal.extend(&other.nodal);
        case.gravity += other.gravity;
    }
    let mut model = FrameParts {
        nodes: roof.nodes().to_vec(),
        members: roof.members().to_vec(),
        sections: roof.sections().to_vec(),
        material: *roof.material(),
        shear_deformation: false,
        supports: fixed.map(|(n, fixed)| Support::fixed(n as u32, *fixed)).collect(),
        load_cases: vec![case],
    };
    let mut sags = Vec::new();
    for times in [f64::INFINITY, 25.0, 8.0] {
        let spring = Joint::Relative(times);
        let joint = EndJoint { torsion: Joint::Rigid, bending_y: spring, bending_z: spring };
        let kind = if times.is_finite() { MemberKind::Beam([joint; 2]) } else { MemberKind::RIGID };
        model.members.iter_mut().for_each(|m| m.kind = kind);
        agree(&model, 1e-8, &format!("{times} EI/L"));
        sags.push(solve(&model, Order::Second, 1).max_displacement.0);
    }
    assert!(sags[0] < sags[1] && sags[1] < sags[2], "{sags:?}");
}

/// Springs of 1e13 EI/L are rigid joints, those of 1e-13 EI/L hinges.
#[test]
fn limits_of_the_springs() {
    for seed in 0..4 {
        for (spring, limit) in [(Joint::Relative(1e13), Joint::Rigid), (Joint::Relative(1e-13), Joint::HINGE)]
        {
            let of = |joint: Joint| {
                let mut model = lightly_loaded(seed);
                let end = EndJoint { torsion: Joint::Rigid, bending_y: joint, bending_z: joint };
                model.members.iter_mut().step_by(3).for_each(|m| m.kind = MemberKind::Beam([end; 2]));
                solve(&model, Order::Second, 2)
            };
            let (near, exact) = (of(spring), of(limit));
            close(near.max_displacement.0, exact.max_displacement.0, 1e-9, "displacement");
            for (a, b) in near.buckling_factors.iter().zip(&exact.buckling_factors) {
                close(*a, *b, 1e-8, "factor");
            }
        }
    }
}

#[test]
fn turned_and_renumbered_the_answer_is_the_same() {
    for seed in 0..6 {
        let mut model = random_frame(seed);
        // What is given in global axes and not turned by `rotated`.
        let case = &mut model.load_cases[0];
        (case.uniform, case.settlements, case.gravity) = (Vec::new(), Vec::new(), 0.0);
        let mut turned = model.clone();
        for parts in [&mut model, &mut turned] {
            parts.supports = (0..4).map(|node| Support::fixed(node, CLAMPED)).collect();
        }
        let here = solve(&model, Order::Second, 2);
        let (turned, turn) = rotated(&turned, seed);
        let there = solve(&turned, Order::Second, 2);
        close(there.max_displacement.0, here.max_displacement.0, 1e-8, "turned");
        let n = here.max_displacement.1.0 as usize;
        let expected = turn * nalgebra::Vector3::from_row_slice(&here.displacements[n][..3]);
        (0..3)
            .for_each(|d| assert!((there.displacements[n][d] - expected[d]).abs() < 1e-8 * expected.norm()));
        let mut other = random_frame(seed);
        other.load_cases[0] =
            LoadCase { nodal: other.load_cases[0].nodal.clone(), gravity: 9.81, ..LoadCase::default() };
        let here = solve(&other, Order::Second, 2);
        let (numbered, place) = renumbered(&other, seed);
        let there = solve(&numbered, Order::Second, 2);
        for (n, u) in here.displacements.iter().enumerate() {
            (0..6).for_each(|d| {
                assert!((there.displacements[place[n]][d] - u[d]).abs() < 1e-8 * here.max_displacement.0);
            });
        }
        close(there.buckling_factors[0], here.buckling_factors[0], 1e-8, "renumbered");
    }
}

/// Where all members at a node are hinged, the node turns freely: it is named.
#[test]
fn a_node_that_nothing_turns_is_a_mechanism() {
    let pin = [true, true, true, true, false, true];
    let mut model = beam(6.0, 2, vec![Support::fixed(0, CLAMPED), Support::fixed(2, pin)]);
    model.members[0].kind = MemberKind::Beam([EndJoint::RIGID, bending(Joint::HINGE)]);
    assert!(try_solve(&model, Order::First, 0).is_ok(), "one hinge is none");
    model.members[1].kind = MemberKind::Beam([bending(Joint::HINGE), EndJoint::RIGID]);
    let found = try_solve(&model, Order::First, 0);
    let Err(FrameError::Singular(motion)) = &found else { panic!("{found:?}") };
    assert_eq!(motion.node.0, 1, "{motion:?}");
    // Held by a spring, it is none.
    let stiffness = [0.0, 0.0, 0.0, 0.0, 1e3, 0.0];
    model.supports.push(Support { node: 1, fixed: [false; 6], stiffness });
    assert!(try_solve(&model, Order::First, 0).is_ok());
}

#[test]
fn three_hinges_in_a_row_are_a_mechanism() {
    let pin = [true, true, true, true, false, true];
    let mut model = beam(6.0, 2, vec![Support::fixed(0, pin), Support::fixed(2, pin)]);
    model.members[0].kind = MemberKind::Beam([EndJoint::RIGID, bending(Joint::HINGE)]);
    push(&mut model, 1, [0.0, 0.0, -1e3, 0.0, 0.0, 0.0]);
    let found = try_solve(&model, Order::First, 0);
    assert!(matches!(found, Err(FrameError::Singular(_))), "{found:?}");
}

#[test]
fn what_cannot_be_is_refused_with_its_place() {
    let refused = |change: &dyn Fn(&mut FrameParts)| {
        let mut model = beam(6.0, 2, vec![Support::fixed(0, CLAMPED)]);
        change(&mut model);
        FrameModel::new(model).unwrap_err()
    };
    let hinge = EndJoint { torsion: Joint::HINGE, ..EndJoint::RIGID };
    let free = refused(&|m| m.members[1].kind = MemberKind::Beam([hinge; 2]));
    assert_eq!(free, ModelError::TurnsFreely { member: 1 });
    let negative = bending(Joint::Relative(-1.0));
    let text = refused(&|m| m.members[0].kind = MemberKind::Beam([EndJoint::RIGID, negative])).to_string();
    assert!(text.starts_with("members[0].end_release.bending_y: -1 must be 0 or more"), "{text}");
    let text = refused(&|m| m.supports[0].stiffness[2] = -5.0).to_string();
    assert!(text.starts_with("supports[0].stiffness[2]: -5 must be 0 or more"), "{text}");
    let moved = Settlement { node: 2, displacement: [0.0, 0.0, 0.1, 0.0, 0.0, 0.0] };
    let text = refused(&|m| m.load_cases[0].settlements.push(moved)).to_string();
    assert!(text.contains("node 2") && text.contains("fix it there too"), "{text}");
    let text = refused(&|m| {
        m.members.iter_mut().for_each(|m| m.kind = MemberKind::Truss);
        push(m, 1, [0.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    });
    assert!(text.to_string().contains("nothing but trusses"), "{text}");
}
