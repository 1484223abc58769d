//! The dense pattern: what geometry hands to structure, objectives and exporters.

/// A dense face: a quad, or a triangle at a pole. Counter-clockwise seen from above (from the surface normal's side).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Panel([u32; 4]);

const NONE: u32 = u32::MAX;

impl Panel {
    /// A quadrilateral panel.
    pub fn quad(corners: [u32; 4]) -> Self {
        Self(corners)
    }

    /// A triangular panel.
    pub fn triangle([a, b, c]: [u32; 3]) -> Self {
        Self([a, b, c, NONE])
    }

    /// Its three or four vertices.
    pub fn corners(&self) -> &[u32] {
        if self.is_triangle() { &self.0[..3] } else { &self.0 }
    }

    /// Its vertices as four, the last of a triangle coming twice.
    pub fn as_quad(&self) -> [u32; 4] {
        if self.is_triangle() { [self.0[0], self.0[1], self.0[2], self.0[2]] } else { self.0 }
    }

    /// Whether it has three corners.
    pub fn is_triangle(&self) -> bool {
        self.0[3] == NONE
    }
}

/// A dense mesh with positions, in metres, z up. Vertex, panel and edge order is a function of the canonical code.
#[derive(Clone, PartialEq, Debug)]
pub struct Pattern {
    /// Vertex positions, m.
    pub positions: Vec<[f64; 3]>,
    /// Panels.
    pub panels: Vec<Panel>,
    /// Every edge once, as `[smaller, larger]` vertex, sorted.
    pub edges: Vec<[u32; 2]>,
    /// For each boundary loop of the domain, its dense vertices in order, counter-clockwise seen from above.
    pub loops: Vec<Vec<u32>>,
    /// For each loop, the arc length along the domain's loop of each of its vertices, ascending over less than one turn, m.
    pub along: Vec<Vec<f64>>,
    /// For each corner of the domain (loop by loop, in the domain's order): the dense vertex that takes it.
    pub corners: Vec<u32>,
    /// For each loop, which entries of `corners` lie on it (as a range `start..end`).
    pub loop_corners: Vec<std::ops::Range<usize>>,
    /// For each coarse (canonical) vertex, its dense vertex.
    pub coarse: Vec<u32>,
    /// For each panel, the coarse face it belongs to.
    pub coarse_face: Vec<u32>,
    /// Target edge length t, m.
    pub target_length: f64,
}
