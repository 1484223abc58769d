//! One hole: two harmonic functions, u from the hole to the outer wall and θ around it, and the rays between the two
//! curves (docs/reference/geometry.md §2.1).

use super::polar::Polar;
use super::{Shape, centroid};
use crate::domain::Domain;
use crate::geometry::boundary::BoundaryLoop;
use crate::geometry::dense::{Edges, NO_PANEL};
use crate::geometry::laplacian::{Laplacian, Weights};
use crate::geometry::pattern::Panel;
use std::f64::consts::TAU;

/// The two curves seen from the middle of the hole; `None` unless both can be seen whole from there.
pub fn chart(domain: &Domain) -> Option<[Polar<'_>; 2]> {
    let [outer, hole] = &domain.loops[..] else { return None };
    let center = centroid(hole);
    Some([Polar::of(outer, center)?, Polar::of(hole, center)?])
}

/// Plan positions of all vertices and the arc lengths of the boundary vertices; `None` if a system is singular.
pub fn place(
    domain: &Domain,
    [outer_polar, hole_polar]: &[Polar<'_>; 2],
    panels: &[Panel],
    edges: &Edges,
    loops: &[BoundaryLoop],
    vertex_count: usize,
) -> Option<Shape> {
    let [outer, hole] = loops else { return None };
    let mut is_fixed = vec![false; vertex_count];
    for &v in outer.vertices.iter().chain(&hole.vertices) {
        is_fixed[v as usize] = true;
    }
    let harmonic = Laplacian::new(&edges.list, Weights::Equal, &is_fixed)?;
    let mut u = vec![0.0; vertex_count];
    for &v in &outer.vertices {
        u[v as usize] = 1.0;
    }
    harmonic.extend(&mut u);

    let cut = Cut::of(panels, edges, outer, hole)?;
    let outer_along = outer.even(0.0);
    let mut theta = vec![0.0; vertex_count];
    for (&v, &s) in outer.vertices.iter().zip(&outer_along) {
        theta[v as usize] = outer_polar.angle(s);
    }
    // θ = θ₀ + φ θ₁ with the hole turned by φ; φ is free and makes the sum of squared differences smallest.
    let relative = hole_angles(hole, hole_polar, &cut, None);
    let mut turned = theta.clone();
    for (&v, &angle) in hole.vertices.iter().zip(&relative) {
        turned[v as usize] = angle;
    }
    harmonic.solve(&mut turned, |e| cut.jumps[e], |_| 0.0);
    let mut unit = vec![0.0; vertex_count];
    for &v in &hole.vertices {
        unit[v as usize] = 1.0;
    }
    harmonic.extend(&mut unit);
    let phase = best_phase(edges, &turned, &unit, &cut.jumps);

    let (hole_along, angles) = if hole.anchors.is_empty() {
        let first = hole_polar.arc(phase);
        (hole.even(first), hole_angles(hole, hole_polar, &cut, Some(first)))
    } else {
        // The corners fix the hole up to whole turns: the nearest turn twists least.
        let turns = TAU * libm::round(phase / TAU);
        (hole.even(0.0), relative.iter().map(|angle| angle + turns).collect())
    };
    for (&v, &angle) in hole.vertices.iter().zip(&angles) {
        theta[v as usize] = angle;
    }
    harmonic.solve(&mut theta, |e| cut.jumps[e], |_| 0.0);

    let [outer_curve, hole_curve] = &domain.loops[..] else { return None };
    let plan = (0..vertex_count)
        .map(|v| {
            let [ax, ay, _] = hole_curve.point(hole_polar.arc(theta[v]));
            let [bx, by, _] = outer_curve.point(outer_polar.arc(theta[v]));
            [ax + u[v] * (bx - ax), ay + u[v] * (by - ay)]
        })
        .collect();
    Some(Shape { plan, along: vec![outer_along, hole_along] })
}

/// A path of panels from the outer wall to the hole; θ jumps by a turn where one crosses it.
struct Cut {
    /// For each edge, what θ gains from its smaller to its larger vertex beside the difference of the values.
    jumps: Vec<f64>,
    /// The position in the hole's loop of the first vertex after the cut.
    hole_start: usize,
}

impl Cut {
    fn of(panels: &[Panel], edges: &Edges, outer: &BoundaryLoop, hole: &BoundaryLoop) -> Option<Self> {
        let ends = [*outer.vertices.last()?, *outer.vertices.first()?];
        let entry = edges.find(ends[0], ends[1])?;
        let mut at_hole = vec![usize::MAX; edges.list.len()];
        let n = hole.vertices.len();
        for i in 0..n {
            at_hole[edges.find(hole.vertices[i], hole.vertices[(i + 1) % n])?] = i;
        }
        let first = edges.panels[entry].iter().copied().find(|&p| p != NO_PANEL)?;
        let mut came_by = vec![usize::MAX; panels.len()];
        came_by[first as usize] = entry;
        let mut queue = std::collections::VecDeque::from([first]);
        while let Some(p) = queue.pop_front() {
            let corners = panels[p as usize].corners();
            for i in 0..corners.len() {
                let e = edges.find(corners[i], corners[(i + 1) % corners.len()])?;
                if at_hole[e] != usize::MAX {
                    let jumps = Self::trace_back(panels, edges, &came_by, entry, p, e)?;
                    return Some(Self { jumps, hole_start: (at_hole[e] + 1) % n });
                }
                let other = edges.panels[e].iter().copied().find(|&q| q != p)?;
                if other != NO_PANEL && came_by[other as usize] == usize::MAX {
                    came_by[other as usize] = e;
                    queue.push_back(other);
                }
            }
        }
        None
    }

    /// Walks from the panel at the hole back to the wall; each panel is entered where θ, counter-clockwise, gains a turn.
    fn trace_back(
        panels: &[Panel],
        edges: &Edges,
        came_by: &[usize],
        entry: usize,
        last: u32,
        exit: usize,
    ) -> Option<Vec<f64>> {
        let mut jumps = vec![0.0; edges.list.len()];
        // On the left of `smaller → larger` lies panels[0]: leaving it through this edge, θ loses a turn along it.
        let mut cross = |e: usize, left_behind: u32| {
            jumps[e] = if edges.panels[e][0] == left_behind { -TAU } else { TAU };
        };
        cross(exit, last);
        let mut panel = last;
        for _ in 0..panels.len() {
            let e = came_by[panel as usize];
            let before = edges.panels[e].iter().copied().find(|&q| q != panel)?;
            cross(e, before);
            if e == entry {
                return Some(jumps);
            }
            panel = before;
        }
        None
    }
}

/// Angles of the hole's vertices in loop order, one turn from the cut on. Held by corners, or from arc length `first`
/// on; equally spaced from 0 where neither is given.
fn hole_angles(hole: &BoundaryLoop, polar: &Polar<'_>, cut: &Cut, first: Option<f64>) -> Vec<f64> {
    let n = hole.vertices.len();
    let mut angles: Vec<f64> = match (hole.anchors.is_empty(), first) {
        (true, None) => (0..n).map(|i| TAU * i as f64 / n as f64).collect(),
        (_, first) => hole.even(first.unwrap_or(0.0)).into_iter().map(|s| polar.angle(s)).collect(),
    };
    // Those before the cut in loop order come last around the hole.
    for angle in &mut angles[..cut.hole_start] {
        *angle += TAU;
    }
    angles
}

/// The φ for which Σ over edges of (difference of θ₀ + φ θ₁)² is smallest.
fn best_phase(edges: &Edges, zero: &[f64], one: &[f64], jumps: &[f64]) -> f64 {
    let (mut product, mut square) = (0.0, 0.0);
    for (&[u, v], jump) in edges.list.iter().zip(jumps) {
        let d0 = zero[v as usize] - zero[u as usize] + jump;
        let d1 = one[v as usize] - one[u as usize];
        product += d0 * d1;
        square += d1 * d1;
    }
    -product / square
}
