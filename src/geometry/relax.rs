//! Relaxing a dense pattern: guarded Jacobi smoothing on its constraints (docs/reference/geometry.md §2.4). Boundary vertices slide along
//! their curves on a surface; on a free surface they stay where placing put them.

use super::boundary::{self, BoundaryLoop};
use super::params::{RelaxKind, RelaxParams};
use super::pattern::Panel;
use super::place::Placed;
use super::vector::{Vec3, add, cross, dot, norm, scale, sub};
use crate::domain::{Domain, Stretch};
use crate::surface::{Surface, SurfaceKind};

/// A step is halved at most this often, then dropped.
const MAX_HALVINGS: u8 = 8;
/// A corner whose double area in plan is over this share of the squared diagonals is not looked at more closely; one of a
/// 1 : 8 rectangle is just below.
const OPEN_SHARE: f64 = 0.06;
/// A cotangent is cut off where a triangle has no area left.
const MAX_COTANGENT: f64 = 1e6;

/// The panels of a mesh, ready for sweeps: a triangle is a quad whose last corner comes twice.
pub struct Mesh {
    quads: Vec<[u32; 4]>,
    /// Panels around each vertex.
    around: Around,
    edges: Vec<[u32; 2]>,
    loops: Vec<BoundaryLoop>,
    /// Inner vertices of panels that touch the boundary: only these can leave the domain without turning a triangle over.
    near_boundary: Vec<u32>,
    on_boundary: Vec<bool>,
}

struct Around {
    start: Vec<u32>,
    panels: Vec<u32>,
}

impl Around {
    fn of(vertex_count: usize, panels: &[Panel]) -> Self {
        let mut start = vec![0u32; vertex_count + 1];
        for v in panels.iter().flat_map(Panel::corners) {
            start[*v as usize + 1] += 1;
        }
        for v in 0..vertex_count {
            start[v + 1] += start[v];
        }
        let mut fill = start.clone();
        let mut list = vec![0; start[vertex_count] as usize];
        for (p, panel) in panels.iter().enumerate() {
            for &v in panel.corners() {
                list[fill[v as usize] as usize] = p as u32;
                fill[v as usize] += 1;
            }
        }
        Self { start, panels: list }
    }

    fn at(&self, v: u32) -> &[u32] {
        &self.panels[self.start[v as usize] as usize..self.start[v as usize + 1] as usize]
    }
}

impl Mesh {
    /// Prepares a dense mesh of `vertex_count` vertices.
    pub fn new(vertex_count: usize, panels: &[Panel], edges: &[[u32; 2]], loops: &[BoundaryLoop]) -> Self {
        let quads: Vec<[u32; 4]> = panels.iter().map(Panel::as_quad).collect();
        let on_boundary = boundary::marked(vertex_count, loops.iter().flat_map(|l| &l.vertices));
        Self {
            around: Around::of(vertex_count, panels),
            near_boundary: boundary::beside(panels, &on_boundary),
            edges: edges.to_vec(),
            loops: loops.to_vec(),
            quads,
            on_boundary,
        }
    }

    fn is_triangle(quad: &[u32; 4]) -> bool {
        quad[2] == quad[3]
    }
}

/// Runs all sweeps on a placed mesh. Corners stay, boundary vertices stay on their curves, the others on the surface; on a free
/// surface all boundary vertices stay.
///
/// With [`RelaxKind::Optimise`] and [`RelaxKind::ForceDensity`] no sweep is run here.
pub fn relax(placed: &mut Placed, mesh: &Mesh, domain: &Domain, surface: &dyn Surface, params: &RelaxParams) {
    let mut sweep = Sweep::new(placed, mesh, domain, surface, params.damping);
    for _ in 0..params.sweeps {
        match params.kind {
            RelaxKind::Uniform => sweep.uniform_targets(),
            RelaxKind::Area => sweep.area_targets(),
            RelaxKind::Cotangent => sweep.cotangent_targets(),
            RelaxKind::Optimise | RelaxKind::ForceDensity => return,
        }
        sweep.step();
    }
}

/// A boundary vertex that slides along its curve.
struct Slider {
    vertex: u32,
    label: usize,
    position: usize,
    /// Arc lengths between which it may move: its neighbouring corners'.
    range: [f64; 2],
    /// The curve between them.
    stretch: Stretch,
}

struct Sweep<'a> {
    placed: &'a mut Placed,
    mesh: &'a Mesh,
    domain: &'a Domain,
    surface: &'a dyn Surface,
    damping: f64,
    is_free: bool,
    sliders: Vec<Slider>,
    /// Weighted sum of the targets and of the weights, by vertex.
    sums: Vec<[f64; 4]>,
    /// Full step and the place it leads to.
    steps: Vec<Vec3>,
    slides: Vec<f64>,
    next: Vec<Vec3>,
    next_along: Vec<f64>,
    /// Which slider a vertex is; `u32::MAX` for none.
    slider_of: Vec<u32>,
    halvings: Vec<u8>,
}

impl<'a> Sweep<'a> {
    fn new(
        placed: &'a mut Placed,
        mesh: &'a Mesh,
        domain: &'a Domain,
        surface: &'a dyn Surface,
        damping: f64,
    ) -> Self {
        let n = placed.positions.len();
        // A free form is held by its whole boundary: vertices that may slide along it bunch up where the net pulls them.
        let is_free = surface.kind() == SurfaceKind::Free;
        let sliders: Vec<Slider> = if is_free {
            Vec::new()
        } else {
            mesh.loops.iter().enumerate().flat_map(|(label, held)| sliders_of(held, domain, label)).collect()
        };
        let mut slider_of = vec![u32::MAX; n];
        for (i, slider) in sliders.iter().enumerate() {
            slider_of[slider.vertex as usize] = i as u32;
        }
        Self {
            is_free,
            sums: vec![[0.0; 4]; n],
            steps: vec![[0.0; 3]; n],
            slides: vec![0.0; sliders.len()],
            next: placed.positions.clone(),
            next_along: vec![0.0; sliders.len()],
            halvings: vec![0; n],
            placed,
            mesh,
            domain,
            surface,
            damping,
            sliders,
            slider_of,
        }
    }

    /// Mean of the neighbours.
    fn uniform_targets(&mut self) {
        self.sums.fill([0.0; 4]);
        let p = &self.placed.positions;
        for &[u, v] in &self.mesh.edges {
            accumulate(&mut self.sums[u as usize], p[v as usize], 1.0);
            accumulate(&mut self.sums[v as usize], p[u as usize], 1.0);
        }
    }

    /// Mean of the centroids of the adjacent panels, weighted by their areas (those of their vector areas).
    fn area_targets(&mut self) {
        self.sums.fill([0.0; 4]);
        let p = &self.placed.positions;
        for quad in &self.mesh.quads {
            let [a, b, c, d] = quad.map(|v| p[v as usize]);
            let area = 0.5 * norm(cross(sub(c, a), sub(d, b)));
            let centroid = middle(quad, &[a, b, c, d]);
            let count = if Mesh::is_triangle(quad) { 3 } else { 4 };
            for &v in &quad[..count] {
                accumulate(&mut self.sums[v as usize], centroid, area);
            }
        }
    }

    /// Cotangent weights (Pinkall, Polthier 1993) of the two ways to split each quad, half and half.
    fn cotangent_targets(&mut self) {
        self.sums.fill([0.0; 4]);
        let p = &self.placed.positions;
        for quad in &self.mesh.quads {
            let (count, share) = if Mesh::is_triangle(quad) { (1, 1.0) } else { (4, 0.5) };
            for i in 0..count {
                let corners = [quad[(i + count - 1) % 4], quad[i], quad[(i + 1) % 4]];
                let corners = if count == 1 { [quad[0], quad[1], quad[2]] } else { corners };
                for j in 0..3 {
                    let [o, u, v] = [corners[j], corners[(j + 1) % 3], corners[(j + 2) % 3]];
                    let weight = share * cotangent(p[o as usize], p[u as usize], p[v as usize]);
                    accumulate(&mut self.sums[u as usize], p[v as usize], weight);
                    accumulate(&mut self.sums[v as usize], p[u as usize], weight);
                }
            }
        }
    }

    /// Moves all vertices at once by the damped step to their targets, guarded.
    fn step(&mut self) {
        self.propose();
        let mut bad = self.first_check();
        while !bad.is_empty() {
            for &v in &bad {
                self.shorten(v);
            }
            bad = self.check_around(&bad);
        }
        std::mem::swap(&mut self.placed.positions, &mut self.next);
        for (slider, &s) in self.sliders.iter().zip(&self.next_along) {
            self.placed.along[slider.label][slider.position] = s;
        }
    }

    fn propose(&mut self) {
        self.halvings.fill(0);
        let p = &self.placed.positions;
        self.next.copy_from_slice(p);
        for (v, (&here, &[x, y, z, weight])) in p.iter().zip(&self.sums).enumerate() {
            let slides = self.slider_of[v] != u32::MAX;
            if (self.mesh.on_boundary[v] && !slides) || weight <= 0.0 {
                self.steps[v] = [0.0; 3];
                continue;
            }
            self.steps[v] = scale(sub(scale([x, y, z], 1.0 / weight), here), self.damping);
            self.next[v] = add(here, self.steps[v]);
        }
        let held: Vec<(u32, Vec3)> = self.held_places();
        self.surface.project_all(&mut self.next);
        for (v, place) in held {
            self.next[v as usize] = place;
        }
    }

    /// Where all boundary vertices go: sliders to the closest point of their side, corners nowhere.
    fn held_places(&mut self) -> Vec<(u32, Vec3)> {
        let mut held = Vec::new();
        for (i, slider) in self.sliders.iter().enumerate() {
            let curve = &self.domain.loops[slider.label];
            let s = self.placed.along[slider.label][slider.position];
            let length = curve.length();
            let (found, place) = curve.nearest(self.next[slider.vertex as usize], slider.stretch);
            let slide = (found - s) - length * libm::round((found - s) / length);
            let next = (s + slide).clamp(slider.range[0], slider.range[1]);
            self.slides[i] = next - s;
            self.next_along[i] = next;
            held.push((slider.vertex, if next == s + slide { place } else { curve.point(next) }));
        }
        for (l, loop_) in self.mesh.loops.iter().enumerate() {
            for &(position, _) in &loop_.anchors {
                let v = loop_.vertices[position];
                debug_assert!(self.mesh.on_boundary[v as usize], "loop {l}");
                held.push((v, self.placed.positions[v as usize]));
            }
        }
        held
    }

    /// Halves a vertex's step once more.
    fn shorten(&mut self, v: u32) {
        let i = v as usize;
        self.halvings[i] += 1;
        let share =
            if self.halvings[i] > MAX_HALVINGS { 0.0 } else { 0.5f64.powi(i32::from(self.halvings[i])) };
        if self.slider_of[i] != u32::MAX {
            let k = self.slider_of[i] as usize;
            let slider = &self.sliders[k];
            let s = self.placed.along[slider.label][slider.position] + share * self.slides[k];
            self.next_along[k] = s;
            self.next[i] = if share == 0.0 {
                self.placed.positions[i]
            } else {
                self.domain.loops[slider.label].point(s)
            };
        } else if share == 0.0 || self.mesh.on_boundary[i] {
            self.next[i] = self.placed.positions[i];
        } else {
            self.next[i] = self.surface.project(add(self.placed.positions[i], scale(self.steps[i], share)));
        }
    }

    /// Vertices whose steps turn a corner triangle over or leave the domain.
    fn first_check(&self) -> Vec<u32> {
        let mut bad = Vec::new();
        for p in 0..self.mesh.quads.len() as u32 {
            self.check_panel(p, &mut bad);
        }
        self.check_inside(&self.mesh.near_boundary, &mut bad);
        self.movable(bad)
    }

    fn check_around(&self, changed: &[u32]) -> Vec<u32> {
        let mut panels: Vec<u32> = changed.iter().flat_map(|&v| self.mesh.around.at(v)).copied().collect();
        panels.sort_unstable();
        panels.dedup();
        let mut bad = Vec::new();
        for p in panels {
            self.check_panel(p, &mut bad);
        }
        let near: Vec<u32> =
            changed.iter().copied().filter(|v| self.mesh.near_boundary.binary_search(v).is_ok()).collect();
        self.check_inside(&near, &mut bad);
        self.movable(bad)
    }

    fn movable(&self, mut bad: Vec<u32>) -> Vec<u32> {
        bad.sort_unstable();
        bad.dedup();
        bad.retain(|&v| self.halvings[v as usize] <= MAX_HALVINGS);
        bad
    }

    #[inline]
    fn check_panel(&self, p: u32, bad: &mut Vec<u32>) {
        let quad = &self.mesh.quads[p as usize];
        let plan = quad.map(|v| {
            let [x, y, _] = self.next[v as usize];
            [x, y]
        });
        if self.is_free || !is_plainly_open(&plan, Mesh::is_triangle(quad)) {
            self.check_corners(quad, bad);
        }
    }

    /// The close look at a panel, without and with its step: a corner that turns over names its triangle.
    #[inline(never)]
    fn check_corners(&self, quad: &[u32; 4], bad: &mut Vec<u32>) {
        let corners = if Mesh::is_triangle(quad) { 1 } else { 4 };
        let new = quad.map(|v| self.next[v as usize]);
        let old = quad.map(|v| self.placed.positions[v as usize]);
        let (before, after) = if self.is_free {
            let (areas, new_areas) = (corner_areas(&old), corner_areas(&new));
            (
                std::array::from_fn(|k| dot(areas[k], areas[k])),
                std::array::from_fn(|k: usize| dot(new_areas[k], areas[k])),
            )
        } else {
            let after = self.openness(quad, &new);
            if after[..corners].iter().all(|open| *open > 0.0) {
                return;
            }
            (self.openness(quad, &old), after)
        };
        for i in 0..corners {
            if before[i] > 0.0 && after[i] <= 0.0 {
                bad.extend([quad[i], quad[(i + 1) % 4], quad[(i + 2) % 4]]);
            }
        }
    }

    /// For each corner triangle, how far it is from turning over, in plan and against the surface normal; the lesser counts.
    fn openness(&self, quad: &[u32; 4], panel: &[Vec3; 4]) -> [f64; 4] {
        let normal = self.surface.normal(middle(quad, panel));
        corner_areas(panel).map(|area| area[2].min(dot(area, normal)))
    }

    fn check_inside(&self, vertices: &[u32], bad: &mut Vec<u32>) {
        if self.is_free {
            return;
        }
        let inside = |[x, y, _]: Vec3| self.domain.contains([x, y]);
        for &v in vertices {
            if !inside(self.next[v as usize]) && inside(self.placed.positions[v as usize]) {
                bad.push(v);
            }
        }
    }
}

fn sliders_of(held: &BoundaryLoop, domain: &Domain, label: usize) -> Vec<Slider> {
    let unbounded = [f64::NEG_INFINITY, f64::INFINITY];
    let range = |position: usize| {
        let after = held.anchors.partition_point(|&(p, _)| p <= position);
        match (after.checked_sub(1), held.anchors.get(after)) {
            (None, _) => unbounded,
            (Some(i), Some(next)) => [held.anchors[i].1, next.1],
            (Some(i), None) => [held.anchors[i].1, held.anchors[0].1 + held.length],
        }
    };
    (0..held.vertices.len())
        .filter(|position| !held.anchors.iter().any(|(p, _)| p == position))
        .map(|position| {
            let range = range(position);
            let stretch = domain.loops[label].stretch(range[0], range[1]);
            Slider { vertex: held.vertices[position], label, position, range, stretch }
        })
        .collect()
}

/// The mean of a panel's corners.
#[inline]
fn middle(quad: &[u32; 4], &[a, b, c, d]: &[Vec3; 4]) -> Vec3 {
    if Mesh::is_triangle(quad) {
        scale(add(add(a, b), c), 1.0 / 3.0)
    } else {
        scale(add(add(a, b), add(c, d)), 0.25)
    }
}

/// Cross products of the sides at corners 1, 2, 3 and 0 of a panel.
#[inline]
fn corner_areas(&[a, b, c, d]: &[Vec3; 4]) -> [Vec3; 4] {
    let at = |o: Vec3, u: Vec3, v: Vec3| cross(sub(u, o), sub(v, o));
    [at(a, b, c), at(b, c, d), at(c, d, a), at(d, a, b)]
}

/// Whether a panel is so far from folded in plan that it cannot be folded on a roof either: most panels.
#[inline]
fn is_plainly_open(&[a, b, c, d]: &[[f64; 2]; 4], is_triangle: bool) -> bool {
    let to = |p: [f64; 2], q: [f64; 2]| [q[0] - p[0], q[1] - p[1]];
    let square = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
    let turn = |v: [f64; 2], w: [f64; 2]| v[0] * w[1] - v[1] * w[0];
    let enough = OPEN_SHARE * (square(to(a, c)) + square(to(b, d)));
    let first = turn(to(a, b), to(b, c));
    if is_triangle {
        return first > enough;
    }
    // One comparison, which is nearly always true, for all four.
    let rest = [(b, c, d), (c, d, a), (d, a, b)].map(|(p, q, r)| turn(to(p, q), to(q, r)));
    rest.into_iter().fold(first, f64::min) > enough
}

#[inline]
fn accumulate(sum: &mut [f64; 4], point: Vec3, weight: f64) {
    sum[0] += weight * point[0];
    sum[1] += weight * point[1];
    sum[2] += weight * point[2];
    sum[3] += weight;
}

/// Cotangent of the angle at `o` between `u` and `v`.
fn cotangent(o: Vec3, u: Vec3, v: Vec3) -> f64 {
    let (a, b) = (sub(u, o), sub(v, o));
    (dot(a, b) / norm(cross(a, b))).clamp(-MAX_COTANGENT, MAX_COTANGENT)
}
