//! What the supports of a config and its domain say together: points that must name something, and symmetries.

use super::StudyError;
use crate::domain::{self, Domain, Side};
use crate::mesh::isomorphism::Symmetry;
use crate::structure::StructureParams;
use crate::structure::model::Direction;
use crate::structure::params::SupportNodes;
use std::collections::BTreeSet;

/// A point of `nodes_near_m` or `sides_near_m` may be this share of the domain's size away from the boundary.
const FAR: f64 = 0.1;
/// The side a point names must be closer than any other by this share of the domain's size.
const PLAIN: f64 = 0.02;
/// Points may differ by this share of the domain's size from the image of another.
const TOLERANCE: f64 = 1e-6;

/// Refuses points that are nowhere near the boundary, or as near to one side as to another.
pub fn check_points(domain: &Domain, structure: &StructureParams) -> Result<(), StudyError> {
    for Near { key, point, is_side, .. } in near_points(structure) {
        if let Some(reason) = fault(domain, point, is_side) {
            return Err(StudyError::SupportPoint { key, reason });
        }
    }
    Ok(())
}

/// What is wrong with a point, in words.
fn fault(domain: &Domain, point: [f64; 2], is_side: bool) -> Option<String> {
    let [x, y] = point;
    let sides = domain.sides_from(point);
    let &(closest, _) = sides.first()?;
    let size = domain.size();
    if closest > FAR * size {
        let [low, high] = domain.bounds();
        return Some(format!(
            "found [{x}, {y}], {closest:.3} m from the boundary; allowed: points on the boundary or near it, in metres (the \
             domain lies within x {:.6} to {:.6}, y {:.6} to {:.6})",
            low[0], high[0], low[1], high[1]
        ));
    }
    let is_plain = sides.get(1).is_none_or(|(next, _)| next - closest >= PLAIN * size);
    (is_side && !is_plain).then(|| {
        format!(
            "found [{x}, {y}], about as close to one side as to another; allowed: points near the middle of a side"
        )
    })
}

/// Refuses symmetries that do not carry supports into supports. All else of a structure has every symmetry in plan: loads act
/// evenly and downwards, and supports at the boundary, the corners or everywhere do not tell nodes apart.
pub fn check_symmetries(
    domain: &Domain,
    symmetries: &[(domain::Symmetry, Symmetry)],
    structure: &StructureParams,
) -> Result<(), StudyError> {
    for (kind, symmetry) in symmetries {
        check_loops(symmetry, structure)?;
        check_near(domain, *kind, structure)?;
    }
    Ok(())
}

fn check_loops(symmetry: &Symmetry, structure: &StructureParams) -> Result<(), StudyError> {
    let fixed = |label: usize| {
        let here = structure.supports.iter().filter(|support| support.boundary_loop == Some(label));
        here.flat_map(|support| support.fixed.iter().copied()).collect::<BTreeSet<_>>()
    };
    let words = |fixed: &BTreeSet<Direction>| {
        let names: Vec<String> = fixed.iter().map(|direction| direction.name()).collect();
        names.join(", ")
    };
    for (label, &image) in symmetry.loops.iter().enumerate() {
        let (here, there) = (fixed(label), fixed(image as usize));
        if here != there {
            let (fixed, image_fixed) = (words(&here), words(&there));
            return Err(StudyError::Supports { label, fixed, image: image as usize, image_fixed });
        }
    }
    Ok(())
}

/// Every point must have an image that fixes the same: a point there, or one that names the same side.
fn check_near(
    domain: &Domain,
    kind: domain::Symmetry,
    structure: &StructureParams,
) -> Result<(), StudyError> {
    let near = near_points(structure);
    let side = |point| domain.sides_from(point).first().map(|&(_, side)| side);
    let sides: Vec<Option<Side>> = near.iter().map(|n| n.is_side.then(|| side(n.point)).flatten()).collect();
    for held in &near {
        let image = domain.plan_image(held.point, kind);
        let image_side = held.is_side.then(|| side(image)).flatten();
        let is_there = near.iter().zip(&sides).any(|(other, other_side)| {
            let distance = (other.point[0] - image[0]).hypot(other.point[1] - image[1]);
            let is_same = if held.is_side {
                image_side.is_some() && *other_side == image_side
            } else {
                distance <= TOLERANCE * domain.size()
            };
            other.is_side == held.is_side && other.fixed == held.fixed && is_same
        });
        if !is_there {
            let [x, y] = held.point;
            return Err(StudyError::SupportImage { symmetry: kind.name(), x, y, u: image[0], v: image[1] });
        }
    }
    Ok(())
}

/// A point of a support rule.
struct Near {
    key: String,
    point: [f64; 2],
    is_side: bool,
    fixed: BTreeSet<Direction>,
}

fn near_points(structure: &StructureParams) -> Vec<Near> {
    let mut near = Vec::new();
    for (i, support) in structure.supports.iter().enumerate() {
        for (name, nodes) in support.nodes() {
            let (points, is_side) = match nodes {
                SupportNodes::NodesNear(points) => (points, false),
                SupportNodes::SidesNear(points) => (points, true),
                SupportNodes::Place(_) | SupportNodes::Loop(_) => continue,
            };
            let fixed: BTreeSet<Direction> = support.fixed.iter().copied().collect();
            near.extend(points.iter().enumerate().map(|(k, &point)| Near {
                key: format!("structure.support[{i}].{name}[{k}]"),
                point,
                is_side,
                fixed: fixed.clone(),
            }));
        }
    }
    near
}
