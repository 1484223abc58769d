//! Areas and normals of panels (docs/reference/geometry.md §3): true area, plan projection, each corner's share.

use crate::geometry::pattern::Pattern;
use nalgebra::Vector3;

/// What the panels give to each vertex.
pub struct Panels {
    true_shares: Vec<f64>,
    plan_shares: Vec<f64>,
    normals: Vec<Vector3<f64>>,
    total_area: f64,
}

impl Panels {
    /// Panel area = the triangles about the mean of its corners; a corner's share = its two half-triangles; plan
    /// projection = max(0, vertical part of the vector area), shared likewise.
    pub fn new(pattern: &Pattern) -> Self {
        let count = pattern.positions.len();
        let mut panels = Self {
            true_shares: vec![0.0; count],
            plan_shares: vec![0.0; count],
            normals: vec![Vector3::zeros(); count],
            total_area: 0.0,
        };
        for panel in &pattern.panels {
            panels.add(pattern, panel.corners());
        }
        for normal in &mut panels.normals {
            let length = normal.norm();
            if length > 0.0 {
                *normal /= length;
            }
        }
        panels
    }

    fn add(&mut self, pattern: &Pattern, corners: &[u32]) {
        let shape = PanelShape::new(pattern, corners);
        let plan = shape.plan();
        self.total_area += shape.area;
        for (&corner, share) in corners.iter().zip(shape.shares) {
            self.true_shares[corner as usize] += share;
            if shape.area > 0.0 {
                self.plan_shares[corner as usize] += plan * share / shape.area;
            }
            self.normals[corner as usize] += shape.vector_area;
        }
    }

    /// True area that belongs to each vertex, m².
    pub fn true_shares(&self) -> &[f64] {
        &self.true_shares
    }

    /// Plan area that belongs to each vertex, m².
    pub fn plan_shares(&self) -> &[f64] {
        &self.plan_shares
    }

    /// Unit mean of the area-weighted normals of the panels at a vertex; zero if it has none.
    pub fn up(&self, vertex: u32) -> Vector3<f64> {
        self.normals[vertex as usize]
    }

    /// Sum of the true areas, m².
    pub fn total_area(&self) -> f64 {
        self.total_area
    }
}

/// Area, normal and middle of one panel.
pub struct PanelShape {
    /// True area, m².
    pub area: f64,
    /// Vector area, m²: of what length and direction a pressure acts on.
    pub vector_area: Vector3<f64>,
    /// Mean of the corners, m.
    pub middle: Vector3<f64>,
    /// True area that belongs to each corner, m²; as many as there are corners.
    pub shares: [f64; 4],
}

impl PanelShape {
    /// Of the panel with these corners.
    pub fn new(pattern: &Pattern, corners: &[u32]) -> Self {
        let point = |i: usize| Vector3::from(pattern.positions[corners[i % corners.len()] as usize]);
        let middle = (0..corners.len()).map(point).sum::<Vector3<f64>>() / corners.len() as f64;
        let mut triangles = [0.0; 4];
        let mut vector_area = Vector3::zeros();
        for (i, triangle) in triangles.iter_mut().enumerate().take(corners.len()) {
            let twice = (point(i) - middle).cross(&(point(i + 1) - middle));
            *triangle = 0.5 * twice.norm();
            vector_area += twice * 0.5;
        }
        let mut shares = [0.0; 4];
        for (i, share) in shares.iter_mut().enumerate().take(corners.len()) {
            let before = triangles[(i + corners.len() - 1) % corners.len()];
            *share = 0.5 * (before + triangles[i]);
        }
        Self { area: triangles.iter().sum(), vector_area, middle, shares }
    }

    /// Area of the plan projection, m².
    pub fn plan(&self) -> f64 {
        self.vector_area.z.max(0.0)
    }
}
