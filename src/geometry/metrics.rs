//! Fabrication metrics of a dense pattern (docs/reference/geometry.md §3); all to be minimised.

use super::boundary;
use super::check::{center, vector_area};
use super::coarse::{Coarse, corners_of};
use super::outline;
use super::pattern::{Panel, Pattern};
use super::vector::{Vec3, add, angle, cross, distance, dot, norm, scale, sub};
use crate::domain::Domain;
use crate::mesh::CanonicalMesh;
use std::f64::consts::FRAC_PI_2;

/// All that fabrication asks of a pattern. Curvature, skewness and planarity are of the quad panels; triangles are counted apart.
#[derive(Clone, PartialEq, Debug)]
pub struct Fabrication {
    /// C: mean over the quads of [`panel_curvature`].
    pub curvature: f64,
    /// S: mean over the quads of [`panel_skewness`].
    pub skewness: f64,
    /// L: standard deviation (population) of the edge lengths, m.
    pub edge_spread: f64,
    /// Mean of the curvatures weighted by panel area.
    pub curvature_by_area: f64,
    /// Mean of the skewnesses weighted by panel area.
    pub skewness_by_area: f64,
    /// Largest curvature.
    pub curvature_max: f64,
    /// Largest skewness.
    pub skewness_max: f64,
    /// Mean edge length, m.
    pub edge_mean: f64,
    /// Shortest edge, m.
    pub edge_min: f64,
    /// Longest edge, m.
    pub edge_max: f64,
    /// Mean panel area, m².
    pub panel_area_mean: f64,
    /// Standard deviation (population) of the panel areas, m².
    pub panel_area_spread: f64,
    /// Largest panel, m².
    pub panel_area_max: f64,
    /// Mean over all panels of longest ÷ shortest edge.
    pub aspect_mean: f64,
    /// Largest of them.
    pub aspect_max: f64,
    /// Mean over the quads of the distance between the diagonals ÷ their mean length.
    pub planarity: f64,
    /// Largest of them.
    pub planarity_max: f64,
    /// Largest of [`panel_warp`] over the quads, m.
    pub warp_max: f64,
    /// Smallest panel angle, rad.
    pub angle_min: f64,
    /// Panel corners over 180°.
    pub reflex_corners: usize,
    /// Vertices.
    pub nodes: usize,
    /// Edges.
    pub members: usize,
    /// Panels, triangles included.
    pub panels: usize,
    /// Triangles (at poles).
    pub triangles: usize,
    /// Most edges at a vertex.
    pub valence_max: usize,
    /// Fewest edges at an inner vertex; `None` where there is none.
    pub valence_min: Option<usize>,
    /// Farthest that the domain's boundary lies from the pattern's in plan, m.
    pub boundary_gap: f64,
    /// Plan area of the pattern ÷ that of the domain.
    pub area_covered: f64,
    /// Sum of the edge lengths, m.
    pub member_length: f64,
    /// Strips of the reduced coarse mesh.
    pub strips: usize,
    /// Its singular vertices.
    pub singularities: Singularities,
}

/// Singular vertices of the coarse mesh, each counted once.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Singularities {
    /// Inner vertices of a valence other than 4 that are no poles.
    pub inner: usize,
    /// Boundary vertices of a valence other than 3 that are no poles.
    pub boundary: usize,
    /// Poles.
    pub poles: usize,
}

impl Singularities {
    /// Counts those of a coarse mesh.
    pub fn of(mesh: &CanonicalMesh) -> Self {
        let coarse = Coarse::of(mesh);
        let mut is_pole = vec![false; mesh.vertex_count];
        for face in mesh.faces.iter().filter(|face| corners_of(face).count() == 3) {
            is_pole[face[0] as usize] = true;
        }
        let mut found = Self::default();
        for (v, &is_pole) in is_pole.iter().enumerate() {
            match (is_pole, coarse.on_loop[v].is_some(), coarse.valence[v]) {
                (true, _, _) => found.poles += 1,
                (false, true, valence) if valence != 3 => found.boundary += 1,
                (false, false, valence) if valence != 4 => found.inner += 1,
                _ => {}
            }
        }
        found
    }

    /// All of them.
    pub fn total(&self) -> usize {
        self.inner + self.boundary + self.poles
    }
}

/// Measures a pattern on its domain; `mesh` is the canonical mesh it was developed from.
pub fn measure(pattern: &Pattern, mesh: &CanonicalMesh, domain: &Domain) -> Fabrication {
    let lengths: Vec<f64> = edge_lengths(pattern);
    let edges = Spread::of(&lengths);
    let all: Vec<PanelShape> =
        pattern.panels.iter().map(|panel| PanelShape::of(&pattern.positions, panel)).collect();
    let quads: Vec<&PanelShape> =
        pattern.panels.iter().zip(&all).filter(|(panel, _)| !panel.is_triangle()).map(|(_, s)| s).collect();
    let areas = Spread::of(&all.iter().map(|s| s.area).collect::<Vec<_>>());
    let curvature = Spread::of(&quads.iter().map(|s| s.curvature).collect::<Vec<_>>());
    let skewness = Spread::of(&quads.iter().map(|s| s.skewness).collect::<Vec<_>>());
    let planarity = Spread::of(&quads.iter().map(|s| s.planarity).collect::<Vec<_>>());
    let valences = valences(pattern);
    let aspect = Spread::of(&all.iter().map(|s| s.aspect).collect::<Vec<_>>());
    let by_area = |value: fn(&PanelShape) -> f64| {
        let total: f64 = quads.iter().map(|s| s.area).sum();
        if total > 0.0 { quads.iter().map(|s| s.area * value(s)).sum::<f64>() / total } else { 0.0 }
    };
    Fabrication {
        curvature: curvature.mean,
        skewness: skewness.mean,
        edge_spread: edges.deviation,
        curvature_by_area: by_area(|s| s.curvature),
        skewness_by_area: by_area(|s| s.skewness),
        curvature_max: curvature.max,
        skewness_max: skewness.max,
        edge_mean: edges.mean,
        edge_min: edges.min,
        edge_max: edges.max,
        panel_area_mean: areas.mean,
        panel_area_spread: areas.deviation,
        panel_area_max: areas.max,
        aspect_mean: aspect.mean,
        aspect_max: aspect.max,
        planarity: planarity.mean,
        planarity_max: planarity.max,
        warp_max: quads.iter().map(|s| s.warp).fold(0.0, f64::max),
        angle_min: all.iter().map(|s| s.angle_min).fold(f64::INFINITY, f64::min),
        reflex_corners: all.iter().map(|s| s.reflex).sum(),
        nodes: pattern.positions.len(),
        members: pattern.edges.len(),
        panels: pattern.panels.len(),
        triangles: pattern.panels.iter().filter(|p| p.is_triangle()).count(),
        valence_max: valences.iter().copied().max().unwrap_or(0),
        valence_min: least_inner(&valences, pattern),
        boundary_gap: outline::gap(pattern, domain),
        area_covered: outline::area(pattern) / domain.area(),
        member_length: lengths.iter().sum(),
        strips: mesh.strips.len(),
        singularities: Singularities::of(mesh),
    }
}

/// Length of every edge, m.
pub fn edge_lengths(pattern: &Pattern) -> Vec<f64> {
    pattern
        .edges
        .iter()
        .map(|&[u, v]| distance(pattern.positions[u as usize], pattern.positions[v as usize]))
        .collect()
}

/// Number of edges at every vertex.
pub fn valences(pattern: &Pattern) -> Vec<usize> {
    let mut valences = vec![0; pattern.positions.len()];
    for &v in pattern.edges.iter().flatten() {
        valences[v as usize] += 1;
    }
    valences
}

/// The least of the valences of inner vertices.
pub fn least_inner(valences: &[usize], pattern: &Pattern) -> Option<usize> {
    let on_boundary = boundary::marked(valences.len(), pattern.loops.iter().flatten());
    valences
        .iter()
        .zip(on_boundary)
        .filter_map(|(&valence, on_boundary)| (!on_boundary).then_some(valence))
        .min()
}

/// Smallest angle of all corners of all panels, triangles included, rad; 0 where an arm has no length.
pub fn smallest_angle(pattern: &Pattern) -> f64 {
    let of_panel = |panel: &Panel| {
        let mut corners = [[0.0; 3]; 4];
        for (place, &v) in corners.iter_mut().zip(panel.corners()) {
            *place = pattern.positions[v as usize];
        }
        least_angle(&corners[..panel.corners().len()])
    };
    pattern.panels.iter().map(of_panel).fold(f64::INFINITY, f64::min)
}

/// Area of a panel: the four triangles about the mean of its corners; of a triangle its own, m².
pub fn panel_area(positions: &[Vec3], panel: &Panel) -> f64 {
    if panel.is_triangle() {
        return norm(vector_area(positions, panel));
    }
    let middle = center(positions, panel);
    let c = panel.corners();
    (0..4)
        .map(|i| {
            let (a, b) = (positions[c[i] as usize], positions[c[(i + 1) % 4] as usize]);
            0.5 * norm(cross(sub(a, middle), sub(b, middle)))
        })
        .sum()
}

/// Largest distance of the corners from their best-fit plane ÷ their mean distance from their centroid
/// (COMPAS 2 `Mesh.face_curvature`).
pub fn panel_curvature(corners: &[Vec3]) -> f64 {
    let share = 1.0 / corners.len() as f64;
    let centroid = scale(corners.iter().fold([0.0; 3], |sum, &p| add(sum, p)), share);
    let normal = best_fit_normal(corners, centroid);
    let farthest = corners.iter().map(|&p| dot(sub(p, centroid), normal).abs()).fold(0.0, f64::max);
    let mean = corners.iter().map(|&p| distance(p, centroid)).sum::<f64>() * share;
    farthest / mean
}

/// The unit normal of COMPAS 2 `bestfit_plane`: least squares along the coordinate axis whose 2 × 2 determinant is largest
/// (Ernerfeldt, *Fitting a plane to many points in 3D*, 2015).
fn best_fit_normal(points: &[Vec3], centroid: Vec3) -> Vec3 {
    let (mut xx, mut xy, mut xz, mut yy, mut yz, mut zz) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for &point in points {
        let [x, y, z] = sub(point, centroid);
        xx += x * x;
        xy += x * y;
        xz += x * z;
        yy += y * y;
        yz += y * z;
        zz += z * z;
    }
    let det_x = yy * zz - yz * yz;
    let det_y = xx * zz - xz * xz;
    let det_z = xx * yy - xy * xy;
    let normal = if det_x >= det_y && det_x >= det_z {
        [1.0, (xz * yz - xy * zz) / det_x, (xy * yz - xz * yy) / det_x]
    } else if det_y >= det_z {
        [(yz * xz - xy * zz) / det_y, 1.0, (xy * xz - yz * xx) / det_y]
    } else {
        [(yz * xy - xz * yy) / det_z, (xz * xy - yz * xx) / det_z, 1.0]
    };
    scale(normal, 1.0 / norm(normal))
}

/// How far a pane would have to be bent: the largest distance of a corner of a quad from the plane of its other three, m.
pub fn panel_warp(corners: &[Vec3]) -> f64 {
    let n = corners.len();
    let off = |i: usize| {
        let [before, opposite, after] = [i + n - 1, i + 2, i + 1].map(|k| corners[k % n]);
        let normal = cross(sub(opposite, before), sub(after, before));
        let area = norm(normal);
        if area > 0.0 { dot(sub(corners[i], before), normal).abs() / area } else { 0.0 }
    };
    (0..n).map(off).fold(0.0, f64::max)
}

/// max((θmax − 90°)/90°, (90° − θmin)/90°) over the corners of a quad (COMPAS 2 `Mesh.face_skewness`).
pub fn panel_skewness(corners: &[Vec3]) -> f64 {
    let (least, most) =
        corner_angles(corners).fold((f64::INFINITY, 0.0f64), |(least, most), a| (least.min(a), most.max(a)));
    ((most - FRAC_PI_2) / FRAC_PI_2).max((FRAC_PI_2 - least) / FRAC_PI_2)
}

/// Angle at each corner of a panel, 0..π.
fn corner_angles(corners: &[Vec3]) -> impl Iterator<Item = f64> {
    let n = corners.len();
    (0..n)
        .map(move |i| angle(sub(corners[(i + 1) % n], corners[i]), sub(corners[(i + n - 1) % n], corners[i])))
}

/// The smallest of them.
fn least_angle(corners: &[Vec3]) -> f64 {
    corner_angles(corners).fold(f64::INFINITY, f64::min)
}

struct PanelShape {
    curvature: f64,
    skewness: f64,
    planarity: f64,
    warp: f64,
    area: f64,
    aspect: f64,
    angle_min: f64,
    reflex: usize,
}

impl PanelShape {
    fn of(positions: &[Vec3], panel: &Panel) -> Self {
        let corners: Vec<Vec3> = panel.corners().iter().map(|&v| positions[v as usize]).collect();
        let n = corners.len();
        let sides: Vec<f64> = (0..n).map(|i| distance(corners[i], corners[(i + 1) % n])).collect();
        let facing = vector_area(positions, panel);
        let is_reflex = |i: &usize| {
            let (before, after) = (corners[(i + n - 1) % n], corners[(i + 1) % n]);
            dot(cross(sub(after, corners[*i]), sub(before, corners[*i])), facing) < 0.0
        };
        let quad = n == 4;
        Self {
            curvature: if quad { panel_curvature(&corners) } else { 0.0 },
            skewness: if quad { panel_skewness(&corners) } else { 0.0 },
            planarity: if quad { diagonal_distance(&corners) } else { 0.0 },
            warp: if quad { panel_warp(&corners) } else { 0.0 },
            area: panel_area(positions, panel),
            aspect: sides.iter().copied().fold(0.0, f64::max)
                / sides.iter().copied().fold(f64::INFINITY, f64::min),
            angle_min: least_angle(&corners),
            reflex: (0..n).filter(is_reflex).count(),
        }
    }
}

/// Distance between the lines of the two diagonals ÷ their mean length.
fn diagonal_distance(corners: &[Vec3]) -> f64 {
    let (first, second) = (sub(corners[2], corners[0]), sub(corners[3], corners[1]));
    let across = cross(first, second);
    let gap = dot(sub(corners[1], corners[0]), across).abs() / norm(across);
    gap / (0.5 * (norm(first) + norm(second)))
}

/// Mean, population standard deviation and extremes; zeros for no value.
struct Spread {
    mean: f64,
    deviation: f64,
    min: f64,
    max: f64,
}

impl Spread {
    fn of(values: &[f64]) -> Self {
        if values.is_empty() {
            return Self { mean: 0.0, deviation: 0.0, min: 0.0, max: 0.0 };
        }
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let variance = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / n;
        Self {
            mean,
            deviation: variance.sqrt(),
            min: values.iter().copied().fold(f64::INFINITY, f64::min),
            max: values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        }
    }
}
