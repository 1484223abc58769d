//! How far a hole without corners is turned, where several holes leave no chart that tells: every such hole is filled with a
//! hub vertex, the mesh laid flat in the outer loop (Tutte 1963), and each hole turned as it lies there (docs/reference/geometry.md §2.1).

use super::centroid;
use super::polar::Polar;
use crate::domain::Domain;
use crate::geometry::boundary::BoundaryLoop;
use crate::geometry::laplacian::{Laplacian, Weights};
use std::f64::consts::TAU;

/// For each loop the arc length of its first vertex; 0 for those with an anchor. `None` if the system is singular.
pub fn phases(
    domain: &Domain,
    edges: &[[u32; 2]],
    loops: &[BoundaryLoop],
    vertex_count: usize,
) -> Option<Vec<f64>> {
    let mut phases = vec![0.0; loops.len()];
    let turning: Vec<usize> = (0..loops.len()).filter(|&k| loops[k].anchors.is_empty()).collect();
    if turning.is_empty() {
        return Some(phases);
    }
    let mut spoked = edges.to_vec();
    for (hub, &k) in (vertex_count as u32..).zip(&turning) {
        spoked.extend(loops[k].vertices.iter().map(|&v| [v, hub]));
    }
    let count = vertex_count + turning.len();
    let mut is_fixed = vec![false; count];
    let (mut x, mut y) = (vec![0.0; count], vec![0.0; count]);
    for (held, curve) in loops.iter().zip(&domain.loops).filter(|(held, _)| !held.anchors.is_empty()) {
        for (&v, s) in held.vertices.iter().zip(held.even(0.0)) {
            is_fixed[v as usize] = true;
            [x[v as usize], y[v as usize], _] = curve.point(s);
        }
    }
    let harmonic = Laplacian::new(&spoked, Weights::Equal, &is_fixed)?;
    harmonic.extend(&mut x);
    harmonic.extend(&mut y);

    for (hub, &k) in (vertex_count..).zip(&turning) {
        let curve = &domain.loops[k];
        let Some(polar) = Polar::of(curve, centroid(curve)) else { continue };
        let n = loops[k].vertices.len() as f64;
        // Mean direction of how far each vertex is ahead of its place in even spacing.
        let (mut sin, mut cos) = (0.0, 0.0);
        for (i, &v) in loops[k].vertices.iter().enumerate() {
            let at = v as usize;
            let ahead = libm::atan2(y[at] - y[hub], x[at] - x[hub]) - TAU * i as f64 / n;
            sin += libm::sin(ahead);
            cos += libm::cos(ahead);
        }
        phases[k] = polar.arc(libm::atan2(sin, cos));
    }
    Some(phases)
}
