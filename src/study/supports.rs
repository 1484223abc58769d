//! What the supports of a config and its domain say together: points that must name something, and symmetries.

use super::{StudyError, loads};
use crate::domain::{self, Domain, Side};
use crate::mesh::isomorphism::Symmetry;
use crate::structure::StructureParams;
use crate::structure::model::Direction;
use crate::structure::params::{LoadParams, SupportNodes};

/// A point of `nodes_near_m` or `sides_near_m` may be this share of the domain's size away from the boundary.
const FAR: f64 = 0.1;
/// The side a point names must be closer than any other by this share of the domain's size.
const PLAIN: f64 = 0.02;
/// Refuses points that are nowhere near the boundary, or as near to one side as to another; those of columns and forces
/// outside the domain.
pub fn check_points(domain: &Domain, structure: &StructureParams) -> Result<(), StudyError> {
    for Near { key, point, kind, .. } in near_points(structure) {
        let reason = match kind {
            Kind::Inside => outside(domain, point),
            Kind::Node | Kind::Side => fault(domain, point, kind == Kind::Side),
        };
        if let Some(reason) = reason {
            return Err(StudyError::SupportPoint { key, reason });
        }
    }
    for (name, load) in &structure.loads {
        let LoadParams::Point { points_m, .. } = load else { continue };
        let wrong = points_m.iter().enumerate().find_map(|(k, &point)| Some((k, outside(domain, point)?)));
        if let Some((k, reason)) = wrong {
            return Err(StudyError::SupportPoint {
                key: format!("structure.loads.{name}.points_m[{k}]"),
                reason,
            });
        }
    }
    Ok(())
}

/// That a point is not in the domain, in words.
fn outside(domain: &Domain, point: [f64; 2]) -> Option<String> {
    let ([x, y], [low, high]) = (point, domain.bounds());
    (!domain.contains(point)).then(|| {
        format!(
            "found [{x}, {y}], which is not in the domain; allowed: points inside its boundary and outside its holes, in metres \
             (it lies within x {:.6} to {:.6}, y {:.6} to {:.6})",
            low[0], high[0], low[1], high[1]
        )
    })
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

/// Refuses symmetries that do not carry supports into supports and loads into loads. All else of a structure has every symmetry
/// in plan: supports at the boundary, the corners or everywhere do not tell nodes apart.
pub fn check_symmetries(
    domain: &Domain,
    symmetries: &[(domain::Symmetry, Symmetry)],
    structure: &StructureParams,
) -> Result<(), StudyError> {
    for (kind, symmetry) in symmetries {
        check_loops(symmetry, structure)?;
        check_near(domain, *kind, structure)?;
        loads::check_symmetry(domain, *kind, structure)?;
    }
    Ok(())
}

fn check_loops(symmetry: &Symmetry, structure: &StructureParams) -> Result<(), StudyError> {
    let holds = |label: usize| {
        let here = structure.supports.iter().filter(|support| support.boundary_loop == Some(label));
        here.fold(([false; 6], [0.0; 6]), |(fixed, springs), support| {
            let (also_fixed, also_sprung) = support.holds();
            (
                std::array::from_fn(|d| fixed[d] || also_fixed[d]),
                std::array::from_fn(|d: usize| springs[d] + also_sprung[d]),
            )
        })
    };
    let words = |(fixed, springs): ([bool; 6], [f64; 6])| {
        let name = |d: usize| Direction::ALL[d].name();
        let fixed = (0..6).filter(|&d| fixed[d]).map(name);
        let springs = (0..6).filter(|&d| springs[d] > 0.0).map(|d| format!("{} by {}", name(d), springs[d]));
        fixed.chain(springs).collect::<Vec<String>>().join(", ")
    };
    for (label, &image) in symmetry.loops.iter().enumerate() {
        let (here, there) = (holds(label), holds(image as usize));
        if here != there {
            let (fixed, image_fixed) = (words(here), words(there));
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
    let sides: Vec<Option<Side>> =
        near.iter().map(|n| (n.kind == Kind::Side).then(|| side(n.point)).flatten()).collect();
    for held in &near {
        let image = domain.plan_image(held.point, kind);
        let image_side = (held.kind == Kind::Side).then(|| side(image)).flatten();
        let is_there = near.iter().zip(&sides).any(|(other, other_side)| {
            let is_same = match held.kind {
                Kind::Side => image_side.is_some() && *other_side == image_side,
                Kind::Node | Kind::Inside => loads::is_at(domain, other.point, image),
            };
            other.kind == held.kind && other.holds == held.holds && is_same
        });
        if !is_there {
            let [x, y] = held.point;
            return Err(StudyError::SupportImage { symmetry: kind.name(), x, y, u: image[0], v: image[1] });
        }
    }
    Ok(())
}

/// What a point of a support rule names.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Node,
    Side,
    Inside,
}

/// A point of a support rule.
struct Near {
    key: String,
    point: [f64; 2],
    kind: Kind,
    /// What is fixed, and the springs.
    holds: ([bool; 6], [f64; 6]),
}

fn near_points(structure: &StructureParams) -> Vec<Near> {
    let mut near = Vec::new();
    for (i, support) in structure.supports.iter().enumerate() {
        for (name, nodes) in support.nodes() {
            let (points, kind) = match nodes {
                SupportNodes::NodesNear(points) => (points, Kind::Node),
                SupportNodes::SidesNear(points) => (points, Kind::Side),
                SupportNodes::InsideNear(points) => (points, Kind::Inside),
                SupportNodes::Place(_) | SupportNodes::Loop(_) => continue,
            };
            near.extend(points.iter().enumerate().map(|(k, &point)| Near {
                key: format!("structure.support[{i}].{name}[{k}]"),
                point,
                kind,
                holds: support.holds(),
            }));
        }
    }
    near
}
