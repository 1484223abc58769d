//! Folds, vertices outside the domain, vertices at one place (docs/reference/geometry.md §2.5).

use super::boundary;
use super::pattern::{Panel, Pattern};
use super::rejection::Rejection;
use super::vector::{Vec3, add, cross, distance, dot, norm, scale, sub};
use crate::domain::Domain;
use crate::surface::{Surface, SurfaceKind};

/// A panel is folded when its vector area along the surface normal is at most this share of t².
const FOLD_SHARE: f64 = 1e-9;

/// Vertices nearer than this share of t are at one place.
const COINCIDENT_SHARE: f64 = 1e-6;

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
    let on_boundary = boundary::marked(pattern.positions.len(), pattern.loops.iter().flatten());
    (0..pattern.positions.len())
        .filter(|&v| !on_boundary[v] && !domain.contains([pattern.positions[v][0], pattern.positions[v][1]]))
        .map(|v| v as u32)
        .collect()
}

/// Pairs of vertices at one place, the nearest first: the ends of edges, and boundary vertices without an edge between them. A
/// solver would find a singular system there and could not say where.
fn coincident_pairs(pattern: &Pattern) -> Vec<(f64, [u32; 2], bool)> {
    let limit = COINCIDENT_SHARE * pattern.target_length;
    let place = |v: u32| pattern.positions[v as usize];
    let mut pairs: Vec<(f64, [u32; 2], bool)> = Vec::new();
    let mut try_pair = |[u, v]: [u32; 2], is_edge: bool| {
        let gap = distance(place(u), place(v));
        if gap < limit {
            pairs.push((gap, [u, v], is_edge));
        }
    };
    for &edge in &pattern.edges {
        try_pair(edge, true);
    }
    // Swept by x: only those that are near in it are looked at.
    let mut boundary: Vec<u32> = pattern.loops.iter().flatten().copied().collect();
    boundary.sort_by(|&u, &v| place(u)[0].total_cmp(&place(v)[0]).then(u.cmp(&v)));
    for (i, &u) in boundary.iter().enumerate() {
        for &v in boundary[i + 1..].iter().take_while(|&&v| place(v)[0] - place(u)[0] < limit) {
            let pair = [u.min(v), u.max(v)];
            if pattern.edges.binary_search(&pair).is_err() {
                try_pair(pair, false);
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    pairs
}

/// Refuses a pattern with a position that is no number, a folded panel, a vertex outside the domain or two at one place.
///
/// # Errors
/// [`Rejection::NotFinite`], [`Rejection::Folds`], [`Rejection::OutsideDomain`] or [`Rejection::Coincident`], the first that
/// holds.
pub fn check(pattern: &Pattern, domain: &Domain, surface: &dyn Surface) -> Result<(), Rejection> {
    if !pattern.positions.iter().flatten().all(|x| x.is_finite()) {
        return Err(Rejection::NotFinite { stage: "relaxing" });
    }
    let panels = pattern.panels.len();
    let folded = folded_panels(pattern, surface).len();
    if folded > 0 {
        return Err(Rejection::Folds { folded, panels });
    }
    let vertices = vertices_outside(pattern, domain, surface).len();
    if vertices > 0 {
        return Err(Rejection::OutsideDomain { vertices, panels });
    }
    let pairs = coincident_pairs(pattern);
    match pairs.first() {
        None => Ok(()),
        Some(&(distance, vertices, is_edge)) => {
            let [a, b] = vertices.map(|v| pattern.positions[v as usize]);
            let place = scale(add(a, b), 0.5);
            Err(Rejection::Coincident { vertices, is_edge, place, distance, pairs: pairs.len(), panels })
        }
    }
}
