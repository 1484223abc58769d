//! What a model must satisfy.

use super::{Direction, Frame3, FrameParts, LoadCase, Material, Member, MemberKind, ModelError, Spring};
use nalgebra::Vector3;

/// That all are numbers.
pub fn finite(values: &[f64], place: impl Fn() -> String) -> Result<(), ModelError> {
    match values.iter().position(|v| !v.is_finite()) {
        None => Ok(()),
        Some(i) => Err(ModelError::NotFinite { place: format!("{}[{i}]", place()), value: values[i] }),
    }
}

fn in_range(
    index: u32,
    len: usize,
    what: &'static str,
    place: impl Fn() -> String,
) -> Result<(), ModelError> {
    if (index as usize) < len {
        Ok(())
    } else {
        Err(ModelError::OutOfRange { place: place(), index, what, len })
    }
}

/// That there is something, and not too much.
pub fn sizes(parts: &FrameParts) -> Result<(), ModelError> {
    // Six unknowns a node, 36 values a block, all counted in u32.
    const MOST: usize = 20_000_000;
    match (parts.nodes.len(), parts.members.len()) {
        (0, _) => Err(ModelError::NoNodes),
        (_, 0) => Err(ModelError::NoMembers),
        (n, _) if n > MOST => Err(ModelError::TooLarge("more than 20 million nodes")),
        (_, m) if m > MOST => Err(ModelError::TooLarge("more than 20 million members")),
        _ => Ok(()),
    }
}

/// That its numbers can be computed with.
pub fn material(material: &Material) -> Result<(), ModelError> {
    let positive = [("E", material.youngs_modulus), ("G", material.shear_modulus), ("fy", material.strength)];
    for (name, value) in positive {
        if !(value > 0.0 && value.is_finite()) {
            return Err(ModelError::Material { name, value, allowed: "greater than 0" });
        }
    }
    if !(material.density >= 0.0 && material.density.is_finite()) {
        return Err(ModelError::Material { name: "density", value: material.density, allowed: "0 or more" });
    }
    if !material.thermal_expansion.is_finite() {
        let (name, value) = ("thermal_expansion", material.thermal_expansion);
        return Err(ModelError::Material { name, value, allowed: "a finite number" });
    }
    Ok(())
}

/// The local axes of members that can be.
pub fn members(parts: &FrameParts) -> Result<Vec<Frame3>, ModelError> {
    let nodes = &parts.nodes;
    let mut axes = Vec::with_capacity(parts.members.len());
    for (m, member) in parts.members.iter().enumerate() {
        in_range(member.start, nodes.len(), "nodes", || format!("members[{m}].start"))?;
        in_range(member.end, nodes.len(), "nodes", || format!("members[{m}].end"))?;
        in_range(member.section, parts.sections.len(), "sections", || format!("members[{m}].section"))?;
        finite(&member.up, || format!("members[{m}].up"))?;
        joints(m, &member.kind)?;
        axes.push(local_axes(m, member, nodes)?);
    }
    let mut pairs: Vec<(u32, u32, usize)> = parts
        .members
        .iter()
        .enumerate()
        .map(|(m, member)| (member.start.min(member.end), member.start.max(member.end), m))
        .collect();
    pairs.sort_unstable();
    match pairs.windows(2).filter(|w| (w[0].0, w[0].1) == (w[1].0, w[1].1)).min_by_key(|w| w[1].2) {
        None => Ok(axes),
        Some(w) => {
            Err(ModelError::DuplicateMember { first: w[0].2, second: w[1].2, start: w[0].0, end: w[0].1 })
        }
    }
}

/// x from start to end, y = up × x normalised, z = x × y.
fn local_axes(m: usize, member: &Member, nodes: &[[f64; 3]]) -> Result<Frame3, ModelError> {
    let (start, end) = (member.start, member.end);
    let a = Vector3::from(nodes[start as usize]);
    let b = Vector3::from(nodes[end as usize]);
    let chord = b - a;
    let length = chord.norm();
    // Below this the direction is rounding noise of the coordinates, and 1/L³ soon overflows.
    let least = 1e-12 * a.amax().max(b.amax()).max(1e-100);
    if !(length > least && length.is_finite()) {
        return Err(ModelError::ZeroLength { member: m, start, end, length });
    }
    let x = chord / length;
    let scale = member.up.iter().fold(0.0f64, |s, v| s.max(v.abs()));
    let up = Vector3::from(member.up) / if scale > 0.0 { scale } else { 1.0 };
    let across = up.cross(&x);
    let sine = across.norm();
    if sine.is_nan() || sine <= 1e-9 {
        return Err(ModelError::UpAlongMember { member: m, up: member.up });
    }
    let y = across / sine;
    Ok(Frame3 { x, y, z: x.cross(&y), length })
}

/// That every node belongs to a member.
pub fn connected(parts: &FrameParts) -> Result<(), ModelError> {
    let mut reached = vec![false; parts.nodes.len()];
    for member in &parts.members {
        reached[member.start as usize] = true;
        reached[member.end as usize] = true;
    }
    match reached.iter().position(|r| !r) {
        None => Ok(()),
        Some(node) => Err(ModelError::LooseNode { node }),
    }
}

/// Held directions of each node, and the springs elsewhere.
pub fn supports(parts: &FrameParts) -> Result<(Vec<[bool; 6]>, Vec<Spring>), ModelError> {
    let mut fixed = vec![[false; 6]; parts.nodes.len()];
    let mut springs: Vec<Spring> = Vec::new();
    for (s, support) in parts.supports.iter().enumerate() {
        in_range(support.node, fixed.len(), "nodes", || format!("supports[{s}].node"))?;
        for (held, also) in fixed[support.node as usize].iter_mut().zip(support.fixed) {
            *held |= also;
        }
        for (direction, &stiffness) in support.stiffness.iter().enumerate() {
            if !(stiffness >= 0.0 && stiffness.is_finite()) {
                let place = format!("supports[{s}].stiffness[{direction}]");
                return Err(ModelError::Stiffness { place, value: stiffness, infinite: false });
            }
            if stiffness > 0.0 {
                springs.push(Spring { node: support.node, direction, stiffness });
            }
        }
    }
    springs.retain(|spring| !fixed[spring.node as usize][spring.direction]);
    springs.sort_by_key(|spring| (spring.node, spring.direction));
    // Two springs side by side.
    springs.dedup_by(|next, kept| {
        let same = (next.node, next.direction) == (kept.node, kept.direction);
        if same {
            kept.stiffness += next.stiffness;
        }
        same
    });
    Ok((fixed, springs))
}

/// The nodes that join nothing but trusses.
pub fn unturned(parts: &FrameParts) -> Vec<u32> {
    if parts.members.iter().all(|member| member.kind != MemberKind::Truss) {
        return Vec::new();
    }
    let mut turns = vec![false; parts.nodes.len()];
    for member in parts.members.iter().filter(|member| member.kind != MemberKind::Truss) {
        turns[member.start as usize] = true;
        turns[member.end as usize] = true;
    }
    (0..turns.len() as u32).filter(|&n| !turns[n as usize]).collect()
}

fn joints(m: usize, kind: &MemberKind) -> Result<(), ModelError> {
    let MemberKind::Beam(ends) = kind else { return Ok(()) };
    for (end, joint) in ["start", "end"].into_iter().zip(ends) {
        for (axis, joint) in ["torsion", "bending_y", "bending_z"].into_iter().zip(joint.about()) {
            let value = joint.stiffness(1.0);
            if value.is_nan() || value < 0.0 {
                let place = format!("members[{m}].{end}_release.{axis}");
                return Err(ModelError::Stiffness { place, value, infinite: true });
            }
        }
    }
    if ends.iter().all(|end| end.torsion.is_hinge()) {
        return Err(ModelError::TurnsFreely { member: m });
    }
    Ok(())
}

/// That loads act on what there is.
pub fn loads(
    parts: &FrameParts,
    fixed: &[[bool; 6]],
    unturned: &[u32],
    c: usize,
    case: &LoadCase,
) -> Result<(), ModelError> {
    let place = |list: &str, i: usize| {
        if parts.load_cases.len() > 1 {
            format!("loads[{c}].{list}[{i}]")
        } else {
            format!("loads.{list}[{i}]")
        }
    };
    let nodes = parts.nodes.len();
    let member = |list: &str, i: usize, member: u32| {
        in_range(member, parts.members.len(), "members", || format!("{}.member", place(list, i)))
    };
    for (i, load) in case.nodal.iter().enumerate() {
        in_range(load.node, nodes, "nodes", || format!("{}.node", place("nodal", i)))?;
        finite(&load.load, || place("nodal", i))?;
        if load.load[3..].iter().any(|m| *m != 0.0) && unturned.binary_search(&load.node).is_ok() {
            return Err(ModelError::MomentOnTrusses { place: place("nodal", i), node: load.node });
        }
    }
    for (i, load) in case.uniform.iter().enumerate() {
        member("member_uniform", i, load.member)?;
        finite(&load.force_per_length, || place("member_uniform", i))?;
    }
    for (i, load) in case.pressure.iter().enumerate() {
        member("pressure", i, load.member)?;
        finite(&[load.force_per_length], || place("pressure", i))?;
    }
    for (i, load) in case.temperature.iter().enumerate() {
        member("temperature", i, load.member)?;
        finite(&[load.kelvin], || place("temperature", i))?;
    }
    for (i, moved) in case.settlements.iter().enumerate() {
        in_range(moved.node, nodes, "nodes", || format!("{}.node", place("settlements", i)))?;
        finite(&moved.displacement, || place("settlements", i))?;
        let held = &fixed[moved.node as usize];
        if let Some(d) = (0..6).find(|&d| moved.displacement[d] != 0.0 && !held[d]) {
            return Err(ModelError::NotFixed { node: moved.node, direction: Direction::ALL[d] });
        }
    }
    finite_gravity(case.gravity)
}

fn finite_gravity(value: f64) -> Result<(), ModelError> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(ModelError::NotFinite { place: "loads.gravity".into(), value })
    }
}
