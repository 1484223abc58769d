//! What the page shows of a mesh beside its shape: per-panel measures, members, singular vertices.

use super::data::{Mark, Mesh, Singular};
use crate::geometry::metrics::{panel_curvature, panel_skewness};
use std::collections::{BTreeMap, BTreeSet};

/// A mesh with everything that follows from its shape; utilisation is left empty.
///
/// `panels` are quads, and triangles whose first corner is a pole; counter-clockwise, of vertices within `positions`.
pub(super) fn mesh(positions: Vec<[f64; 3]>, panels: Vec<Vec<u32>>) -> Mesh {
    let of_quads = |measure: fn(&[[f64; 3]]) -> f64| -> Vec<Option<f64>> {
        let corners = |panel: &[u32]| -> Vec<_> { panel.iter().map(|&v| positions[v as usize]).collect() };
        panels.iter().map(|panel| (panel.len() == 4).then(|| measure(&corners(panel)))).collect()
    };
    let (curvature, skewness) = (of_quads(panel_curvature), of_quads(panel_skewness));
    let edges = panels_of_edges(&panels).into_keys().collect();
    let singular = irregular(&panels).iter().filter_map(Irregular::marked).collect();
    Mesh { edges, positions, panels, singular, curvature, skewness, utilisation: Vec::new() }
}

/// A vertex with other than four edges inside or three on the boundary, or a pole.
struct Irregular {
    vertex: u32,
    valence: u32,
    on_boundary: bool,
    is_pole: bool,
}

impl Irregular {
    /// Its mark. None for a boundary vertex of one panel: every convex corner of a domain is one.
    fn marked(&self) -> Option<Singular> {
        let mark = match (self.is_pole, self.on_boundary) {
            (true, _) => Mark::Pole,
            (false, true) => (self.valence > 3).then_some(Mark::More)?,
            (false, false) if self.valence > 4 => Mark::More,
            (false, false) => Mark::Fewer,
        };
        Some(Singular { vertex: self.vertex, mark })
    }
}

fn panels_of_edges(panels: &[Vec<u32>]) -> BTreeMap<[u32; 2], u32> {
    let mut count = BTreeMap::new();
    for panel in panels {
        for (&a, &b) in panel.iter().zip(panel.iter().cycle().skip(1)) {
            *count.entry([a.min(b), a.max(b)]).or_default() += 1;
        }
    }
    count
}

fn irregular(panels: &[Vec<u32>]) -> Vec<Irregular> {
    let mut valences: BTreeMap<u32, u32> = BTreeMap::new();
    let mut boundary = BTreeSet::new();
    for (ends, panels) in panels_of_edges(panels) {
        for vertex in ends {
            *valences.entry(vertex).or_default() += 1;
            if panels == 1 {
                boundary.insert(vertex);
            }
        }
    }
    let poles: BTreeSet<u32> = panels.iter().filter(|p| p.len() == 3).map(|p| p[0]).collect();
    let all = valences.into_iter().map(|(vertex, valence)| Irregular {
        vertex,
        valence,
        on_boundary: boundary.contains(&vertex),
        is_pole: poles.contains(&vertex),
    });
    all.filter(|v| v.is_pole || v.valence != if v.on_boundary { 3 } else { 4 }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three quads around vertex 0, and a triangle with its pole at 6.
    fn tripod() -> Mesh {
        let at = |i: u32| {
            let angle = std::f64::consts::TAU * f64::from(i) / 6.0;
            [angle.cos(), angle.sin(), 0.0]
        };
        let mut positions = vec![[0.0; 3]];
        positions.extend((1..7).map(at));
        positions.push([2.0, -1.0, 0.0]);
        mesh(positions, vec![vec![0, 1, 2, 3], vec![0, 3, 4, 5], vec![0, 5, 6, 1], vec![6, 7, 1]])
    }

    #[test]
    fn marks_all_but_convex_corners() {
        let marks: Vec<(u32, Mark)> = tripod().singular.iter().map(|s| (s.vertex, s.mark)).collect();
        assert_eq!(marks, [(0, Mark::Fewer), (1, Mark::More), (6, Mark::Pole)]);
    }

    #[test]
    fn triangles_have_no_curvature_and_members_are_found_once() {
        let mesh = tripod();
        assert_eq!(mesh.curvature.iter().filter(|c| c.is_some()).count(), 3);
        assert!(mesh.curvature.iter().flatten().all(|&c| c < 1e-12));
        // A rhombus of 60° and 120°.
        assert!(mesh.skewness.iter().flatten().all(|&s| (s - 1.0 / 3.0).abs() < 1e-12));
        assert_eq!(mesh.edges.len(), 11);
    }
}
