//! Folds and vertices outside the domain (GEOMETRY §2.5).

use super::pattern::{Panel, Pattern};
use super::rejection::Rejection;
use super::vector::{Vec3, add, cross, dot, norm, scale, sub};
use crate::domain::Domain;
use crate::surface::{Surface, SurfaceKind};

/// A panel is folded when its vector area along the surface normal is at most this share of t².
const FOLD_SHARE: f64 = 1e-9;

/// ½ (c − a) × (d − b) of a quad, ½ (b − a) × (c − a) of a triangle.
pub fn vector_area(positions: &[Vec3], panel: &Panel) -> Vec3 {
    let p = |i: usize| positions[panel.corners()[i] as usize];
    let twice = if panel.is_triangle() {
        cross(sub(p(1), p(0)), sub(p(2), p(0)))
    } else {
        cross(sub(p(2), p(0)), sub(p(3), p(1)))
    };
    scale(twice, 0.5)
}

/// The mean of a panel's corners.
pub fn center(positions: &[Vec3], panel: &Panel) -> Vec3 {
    let corners = panel.corners();
    let sum = corners.iter().fold([0.0; 3], |sum, &v| add(sum, positions[v as usize]));
    scale(sum, 1.0 / corners.len() as f64)
}

/// Folded panels, ascending. On a free surface the normal is that of the panels around.
pub fn folded_panels(pattern: &Pattern, surface: &dyn Surface) -> Vec<u32> {
    let limit = FOLD_SHARE * pattern.target_length * pattern.target_length;
    let areas: Vec<Vec3> = pattern.panels.iter().map(|p| vector_area(&pattern.positions, p)).collect();
    let around = match surface.kind() {
        SurfaceKind::Free => Some(normals_around(pattern, &areas)),
        _ => None,
    };
    (0..pattern.panels.len())
        .filter(|&p| {
            let normal = match &around {
                Some(normals) => normals[p],
                None => surface.normal(center(&pattern.positions, &pattern.panels[p])),
            };
            // A NaN is a fold too.
            let along = dot(areas[p], normal);
            along.is_nan() || along <= limit
        })
        .map(|p| p as u32)
        .collect()
}

/// For each panel the unit sum of the vector areas of all panels at its corners.
fn normals_around(pattern: &Pattern, areas: &[Vec3]) -> Vec<Vec3> {
    let mut at_vertex = vec![[0.0; 3]; pattern.positions.len()];
    for (panel, &area) in pattern.panels.iter().zip(areas) {
        for &v in panel.corners() {
            at_vertex[v as usize] = add(at_vertex[v as usize], area);
        }
    }
    pattern
        .panels
        .iter()
        .map(|panel| {
            let sum = panel.corners().iter().fold([0.0; 3], |sum, &v| add(sum, at_vertex[v as usize]));
            scale(sum, 1.0 / norm(sum))
        })
        .collect()
}

/// Inner vertices outside the domain, ascending; none on a free surface.
pub fn vertices_outside(pattern: &Pattern, domain: &Domain, surface: &dyn Surface) -> Vec<u32> {
    if surface.kind() == SurfaceKind::Free {
        return Vec::new();
    }
    let mut on_boundary = vec![false; pattern.positions.len()];
    for &v in pattern.loops.iter().flatten() {
        on_boundary[v as usize] = true;
    }
    (0..pattern.positions.len())
        .filter(|&v| !on_boundary[v] && !domain.contains([pattern.positions[v][0], pattern.positions[v][1]]))
        .map(|v| v as u32)
        .collect()
}

/// Refuses a pattern with a position that is no number, a folded panel or a vertex outside the domain.
///
/// # Errors
/// [`Rejection::NotFinite`], [`Rejection::Folds`] or [`Rejection::OutsideDomain`], the first that holds.
pub fn check(pattern: &Pattern, domain: &Domain, surface: &dyn Surface) -> Result<(), Rejection> {
    if !pattern.positions.iter().flatten().all(|x| x.is_finite()) {
        return Err(Rejection::NotFinite { stage: "relaxing" });
    }
    let panels = pattern.panels.len();
    let folded = folded_panels(pattern, surface).len();
    if folded > 0 {
        return Err(Rejection::Folds { folded, panels });
    }
    match vertices_outside(pattern, domain, surface).len() {
        0 => Ok(()),
        vertices => Err(Rejection::OutsideDomain { vertices, panels }),
    }
}
