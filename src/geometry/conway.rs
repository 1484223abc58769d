//! Conway operators on the dense mesh, for output (docs/reference/geometry.md §2.7; paper, Figure 22).
//!
//! A mesh with a boundary has no closed dual; here every operator covers the same region as the pattern and keeps its
//! outline: cells that the boundary cuts are closed along it.

use super::check::center;
use super::dense::{Edges, NO_PANEL};
use super::pattern::Pattern;
use super::vector::{Vec3, add, scale};

/// A mesh of polygons, counter-clockwise like the panels.
#[derive(Clone, PartialEq, Debug)]
pub struct PolyMesh {
    /// Vertex positions, m.
    pub positions: Vec<Vec3>,
    /// Faces.
    pub faces: Vec<Vec<u32>>,
}

/// A vertex for each panel, a face for each vertex, but for inner ones of two panels. On the boundary a face ends at the midpoints
/// of the two boundary edges and the vertex between them.
pub fn dual(pattern: &Pattern) -> PolyMesh {
    let parts = Parts::of(pattern);
    let mut mesh = Builder::default();
    let panels = mesh.push_all(parts.centers.clone());
    let midpoints: Vec<Option<u32>> = (0..parts.edges.list.len())
        .map(|e| parts.is_boundary(e).then(|| mesh.push(parts.midpoint(pattern, e))))
        .collect();
    for v in 0..pattern.positions.len() {
        let around = parts.around(pattern, v as u32);
        let mut face: Vec<u32> = around.panels.iter().map(|&p| panels + p).collect();
        if let Some([first, last]) = around.ends {
            face.insert(0, midpoints[first].unwrap_or_default());
            face.extend(midpoints[last]);
            face.push(mesh.push(pattern.positions[v]));
        }
        // An inner vertex of two panels has no face of its own.
        if face.len() > 2 {
            mesh.faces.push(face);
        }
    }
    mesh.finish()
}

/// A quad for each inner edge, between its ends and the centres of its two panels; a triangle for each boundary edge.
pub fn join(pattern: &Pattern) -> PolyMesh {
    let parts = Parts::of(pattern);
    let mut mesh = Builder::default();
    mesh.push_all(pattern.positions.clone());
    let panels = mesh.push_all(parts.centers.clone());
    for (&[u, v], &[left, right]) in parts.edges.list.iter().zip(&parts.edges.panels) {
        mesh.faces.push(match (left, right) {
            (NO_PANEL, right) => vec![v, u, panels + right],
            (left, NO_PANEL) => vec![u, v, panels + left],
            (left, right) => vec![u, panels + right, v, panels + left],
        });
    }
    mesh.finish()
}

/// A vertex at the middle of each edge; a face for each panel and one for each vertex. On the boundary the face of a vertex ends
/// at the vertex itself.
pub fn ambo(pattern: &Pattern) -> PolyMesh {
    let parts = Parts::of(pattern);
    let mut mesh = Builder::default();
    mesh.push_all((0..parts.edges.list.len()).map(|e| parts.midpoint(pattern, e)).collect());
    for panel in &pattern.panels {
        let corners = panel.corners();
        let n = corners.len();
        mesh.faces.push(
            (0..n)
                .filter_map(|i| parts.edges.find(corners[i], corners[(i + 1) % n]))
                .map(|e| e as u32)
                .collect(),
        );
    }
    for v in 0..pattern.positions.len() {
        let around = parts.around(pattern, v as u32);
        let mut face: Vec<u32> = around.edges.iter().map(|&e| e as u32).collect();
        if around.ends.is_some() {
            face.push(mesh.push(pattern.positions[v]));
        }
        // An inner vertex of two edges has no face of its own.
        if face.len() > 2 {
            mesh.faces.push(face);
        }
    }
    mesh.finish()
}

#[derive(Default)]
struct Builder {
    positions: Vec<Vec3>,
    faces: Vec<Vec<u32>>,
}

impl Builder {
    fn push(&mut self, position: Vec3) -> u32 {
        self.positions.push(position);
        self.positions.len() as u32 - 1
    }

    /// Adds positions and tells the number of the first.
    fn push_all(&mut self, positions: Vec<Vec3>) -> u32 {
        let first = self.positions.len() as u32;
        self.positions.extend(positions);
        first
    }

    fn finish(self) -> PolyMesh {
        PolyMesh { positions: self.positions, faces: self.faces }
    }
}

struct Parts {
    edges: Edges,
    centers: Vec<Vec3>,
    /// For each vertex, one of its panels; the first counter-clockwise on the boundary.
    first_panel: Vec<u32>,
}

/// The panels and edges around a vertex, counter-clockwise.
struct AroundVertex {
    panels: Vec<u32>,
    edges: Vec<usize>,
    /// The first and the last edge, on the boundary only.
    ends: Option<[usize; 2]>,
}

impl Parts {
    fn of(pattern: &Pattern) -> Self {
        let edges = Edges::of(pattern.positions.len(), &pattern.panels);
        let mut first_panel = vec![NO_PANEL; pattern.positions.len()];
        for (p, panel) in pattern.panels.iter().enumerate() {
            let corners = panel.corners();
            for (i, &v) in corners.iter().enumerate() {
                // The panel on the left of a boundary dart that leaves v comes first around v.
                let next = corners[(i + 1) % corners.len()];
                let begins = edges.find(v, next).is_some_and(|e| edges.panels[e].contains(&NO_PANEL));
                if first_panel[v as usize] == NO_PANEL || begins {
                    first_panel[v as usize] = p as u32;
                }
            }
        }
        let centers = pattern.panels.iter().map(|p| center(&pattern.positions, p)).collect();
        Self { edges, centers, first_panel }
    }

    fn is_boundary(&self, edge: usize) -> bool {
        self.edges.panels[edge].contains(&NO_PANEL)
    }

    fn midpoint(&self, pattern: &Pattern, edge: usize) -> Vec3 {
        let [u, v] = self.edges.list[edge];
        scale(add(pattern.positions[u as usize], pattern.positions[v as usize]), 0.5)
    }

    fn around(&self, pattern: &Pattern, v: u32) -> AroundVertex {
        let first = self.first_panel[v as usize];
        let mut around = AroundVertex { panels: Vec::new(), edges: Vec::new(), ends: None };
        let mut panel = first;
        while panel != NO_PANEL {
            let corners = pattern.panels[panel as usize].corners();
            let n = corners.len();
            let at = corners.iter().position(|&w| w == v).unwrap_or(0);
            let (out, back) = (corners[(at + 1) % n], corners[(at + n - 1) % n]);
            let (Some(out), Some(back)) = (self.edges.find(v, out), self.edges.find(v, back)) else { break };
            around.panels.push(panel);
            around.edges.push(out);
            let sides = self.edges.panels[back];
            panel = if sides[0] == panel { sides[1] } else { sides[0] };
            if panel == NO_PANEL {
                around.ends = Some([around.edges[0], back]);
                around.edges.push(back);
            }
            if panel == first {
                break;
            }
        }
        around
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Panel;

    /// Two panels side by side on both sides of the inner vertex 4, which has two edges only.
    fn two_panels_about_a_vertex() -> Pattern {
        Pattern {
            positions: vec![[0.0; 3], [1.0, -1.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
            panels: vec![Panel::quad([0, 1, 2, 4]), Panel::quad([2, 3, 0, 4])],
            edges: vec![[0, 1], [0, 3], [0, 4], [1, 2], [2, 3], [2, 4]],
            loops: vec![vec![0, 1, 2, 3]],
            along: Vec::new(),
            corners: Vec::new(),
            loop_corners: std::iter::once(0..0).collect(),
            coarse: (0..5).collect(),
            coarse_face: vec![0, 1],
            target_length: 1.0,
        }
    }

    /// Twice the area in plan.
    fn doubled_area(mesh: &PolyMesh) -> f64 {
        let of_face = |face: &Vec<u32>| {
            let at = |i: usize| mesh.positions[face[i % face.len()] as usize];
            (0..face.len()).map(|i| at(i)[0] * at(i + 1)[1] - at(i + 1)[0] * at(i)[1]).sum::<f64>()
        };
        mesh.faces.iter().map(of_face).sum()
    }

    #[test]
    fn every_face_has_three_corners_and_the_region_is_that_of_the_pattern() {
        let pattern = two_panels_about_a_vertex();
        for operator in [dual, join, ambo] {
            let mesh = operator(&pattern);
            assert!(mesh.faces.iter().all(|face| face.len() > 2), "{:?}", mesh.faces);
            assert!((doubled_area(&mesh) - 4.0).abs() < 1e-12, "{mesh:?}");
        }
    }
}
