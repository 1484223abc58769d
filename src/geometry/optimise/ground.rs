//! Surface and boundary in the optimiser's own units: lengths divided by the target length, about the middle of the domain, so that
//! neither the scale nor the place of a domain decides anything (docs/reference/geometry.md §6).

use crate::domain::{BoundaryLoop, Domain};
use crate::geometry::images::Image;
use crate::geometry::vector::{Vec3, scale, sub};
use crate::mesh::quad_mesh::Left;
use crate::surface::{Surface, SurfaceKind};
use std::cell::OnceCell;

/// The surface and the boundary curves of a domain in units of the target length.
pub struct Ground<'a> {
    surface: &'a dyn Surface,
    domain: &'a Domain,
    /// Where the local origin lies, m.
    origin: Vec3,
    /// Length of the local unit, m.
    unit: f64,
    /// One for each boundary loop.
    pub rails: Vec<Rail<'a>>,
    /// Symmetries that patterns on it are kept to.
    pub images: Vec<Image>,
}

impl<'a> Ground<'a> {
    /// The ground of a domain on its surface; `unit` in metres.
    pub fn new(domain: &'a Domain, surface: &'a dyn Surface, unit: f64) -> Self {
        let [low, high] = domain.bounds();
        let middle = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])];
        let origin = [middle[0], middle[1], domain.loops[0].point(0.0)[2]];
        let rail = |(curve, flat): (&'a BoundaryLoop, &'a BoundaryLoop)| Rail::new(curve, flat, middle, unit);
        let rails = domain.loops.iter().zip(&domain.plan_loops).map(rail).collect();
        Self { surface, domain, origin, unit, rails, images: Vec::new() }
    }

    /// The same for patterns that are kept to symmetries of their design.
    pub fn with_images(self, images: Vec<Image>) -> Self {
        Self { images, ..self }
    }

    /// Where a symmetry takes the plan lengths of a loop: the label of its image, and `c` and ±1 for q → c ± q.
    pub fn rail_image(&self, image: &Image, label: usize) -> (usize, f64, f64) {
        let to = image.symmetry.left(Left::outside(label as u32)).as_loop().map_or(label, |to| to as usize);
        let start = self.domain.image(self.rails[label].flat.point(0.0), image.kind);
        let at_start = self.rails[to].flat.closest(start) / self.unit;
        (to, at_start, if image.symmetry.reversed { -1.0 } else { 1.0 })
    }

    /// Whether points are brought back vertically.
    pub fn is_height(&self) -> bool {
        self.surface.kind() == SurfaceKind::Height
    }

    /// From metres to local units.
    pub fn local(&self, point: Vec3) -> Vec3 {
        scale(sub(point, self.origin), 1.0 / self.unit)
    }

    /// From local units to metres.
    pub fn global(&self, point: Vec3) -> Vec3 {
        std::array::from_fn(|k| self.origin[k] + self.unit * point[k])
    }

    /// Sets the heights of all points, and the slopes of the surface there.
    pub fn lift(&self, points: &mut [Vec3], slopes: &mut [[f64; 2]]) {
        for point in points.iter_mut() {
            *point = self.global(*point);
        }
        self.surface.lift_all(points, slopes);
        for point in points {
            *point = self.local(*point);
        }
    }

    /// Brings a point back onto the surface: vertically or to the closest point; and the normal there.
    pub fn foot(&self, point: Vec3) -> (Vec3, Vec3) {
        let (foot, normal) = self.surface.foot(self.global(point));
        (self.local(foot), normal)
    }

    /// The point of the surface above or below a point in plan, where the surface reaches; else the closest.
    pub fn above(&self, point: Vec3) -> Vec3 {
        let [x, y, z] = self.global(point);
        match self.surface.height(x, y) {
            Some(height) => self.local([x, y, height]),
            None => self.local(self.surface.project([x, y, z])),
        }
    }

    /// A point back on the surface: vertically on a height surface, else to the closest point.
    pub fn onto(&self, point: Vec3) -> Vec3 {
        self.local(self.surface.project(self.global(point)))
    }

    /// Whether a point lies in the domain.
    pub fn contains(&self, point: Vec3) -> bool {
        let [x, y, _] = self.global(point);
        self.domain.contains([x, y])
    }

    /// How far a point in plan is beyond a smooth loop (inside a hole, outside the outer loop), negative in the domain, and the unit
    /// direction in which that grows.
    pub fn depth(&self, label: usize, point: Vec3) -> Option<(f64, [f64; 2])> {
        let curve = &self.domain.loops[label];
        let [x, y, z] = self.global(point);
        let nearest = curve.closest_point([x, y, z]);
        let way = [x - nearest[0], y - nearest[1]];
        let distance = (way[0] * way[0] + way[1] * way[1]).sqrt();
        let beyond = curve.surrounds([x, y]) == (label > 0);
        let sign = if beyond { 1.0 } else { -1.0 };
        (distance > 1e-12 * self.unit)
            .then(|| (sign * distance / self.unit, way.map(|d| sign * d / distance)))
    }

    /// The boundary point nearest to a point in plan.
    pub fn nearest_boundary(&self, point: Vec3) -> Vec3 {
        let given = self.global(point);
        let plan_distance =
            |p: &Vec3| (p[0] - given[0]) * (p[0] - given[0]) + (p[1] - given[1]) * (p[1] - given[1]);
        let nearest = self
            .domain
            .loops
            .iter()
            .map(|curve| curve.closest_point(given))
            .min_by(|a, b| plan_distance(a).total_cmp(&plan_distance(b)));
        nearest.map_or(point, |p| self.local(p))
    }
}

/// A boundary loop in plan by its plan length, in local units.
pub struct Rail<'a> {
    /// The curve in plan, m.
    flat: &'a BoundaryLoop,
    /// The same on the surface, m.
    curve: &'a BoundaryLoop,
    middle: [f64; 2],
    unit: f64,
    /// Its plan length, local units.
    pub length: f64,
    /// Curvature all along it, once it was asked for.
    curvature: OnceCell<Vec<f64>>,
}

/// A point of a rail and the unit tangent there, counter-clockwise.
#[derive(Clone, Copy, Debug)]
pub struct Foot {
    /// x and y, local units.
    pub point: [f64; 2],
    /// Direction in which the arc length grows.
    pub tangent: [f64; 2],
}

impl<'a> Rail<'a> {
    fn new(curve: &'a BoundaryLoop, flat: &'a BoundaryLoop, middle: [f64; 2], unit: f64) -> Self {
        Self { length: flat.length() / unit, flat, curve, middle, unit, curvature: OnceCell::new() }
    }

    /// The point at a plan length, modulo the loop's.
    pub fn at(&self, q: f64) -> Foot {
        let (p, tangent) = self.flat.place(q * self.unit);
        let point = [(p[0] - self.middle[0]) / self.unit, (p[1] - self.middle[1]) / self.unit];
        Foot { point, tangent: [tangent[0], tangent[1]] }
    }

    /// The plan length of a point given by its length on the surface in metres; goes on beyond the loop's end as that does.
    pub fn plan_station(&self, s: f64) -> f64 {
        let turns = (s / self.curve.length()).floor();
        self.flat.arc_length(self.curve.parameter(s)) / self.unit + turns * self.length
    }

    /// The length on the surface, m, of a point given by its plan length.
    pub fn surface_station(&self, q: f64) -> f64 {
        let turns = (q / self.length).floor();
        self.curve.arc_length(self.flat.parameter(q * self.unit)) + turns * self.curve.length()
    }

    /// Its curvature from its start on as `measure` finds it, measured once.
    pub fn curvature(&self, measure: impl FnOnce(&Self, [f64; 2]) -> Vec<f64>) -> &[f64] {
        self.curvature.get_or_init(|| measure(self, [0.0, self.length]))
    }

    /// Whether the stretch between two plan lengths is one straight line.
    pub fn is_straight(&self, from: f64, to: f64) -> bool {
        to - from < self.length * (1.0 - 1e-9) && self.flat.is_straight(from * self.unit, to * self.unit)
    }

    /// Length on the surface between two plan lengths, local units.
    pub fn surface_length(&self, from: f64, to: f64) -> f64 {
        (self.surface_station(to) - self.surface_station(from)) / self.unit
    }

    /// Lengths on the surface, m, of a loop's stations from vertex `first` on, ascending.
    pub fn turned(&self, along: &[f64], first: usize) -> Vec<f64> {
        let n = along.len();
        (0..n)
            .map(|i| {
                let turn = if first + i >= n { self.length } else { 0.0 };
                self.surface_station(along[(first + i) % n] + turn)
            })
            .collect()
    }
}
