//! A dense mesh with its unknowns: two (on a surface reached by closest point, three) coordinates for each inner vertex, an arc length
//! for each boundary vertex that takes no corner (docs/reference/geometry.md §6.3).

use super::ground::{Foot, Ground};
use super::sheet::{NO_CORNER, Sheet, State, Twin};
use crate::geometry::sparse::Factor;
use crate::geometry::vector::{Vec3, add, dot, scale};
use std::cell::OnceCell;

/// Normal of a corner that was not asked for yet.
const UNKNOWN: Vec3 = [0.0; 3];

/// How a vertex moves.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Freedom {
    /// Not at all.
    Fixed,
    /// On the surface; the number of its first unknown.
    Inner(usize),
    /// Along its side; the number of its unknown.
    Slider(usize),
}

/// A boundary vertex that slides.
pub struct Slider {
    vertex: u32,
    label: usize,
    /// Arc lengths of the corners on both sides; infinite where there is none.
    range: [f64; 2],
    /// The rail at those ends, to go on straight beyond them.
    ends: [Foot; 2],
    /// Whether it is straight between them.
    is_straight: bool,
}

impl Slider {
    fn new(ground: &Ground<'_>, vertex: u32, label: usize, range: [f64; 2]) -> Self {
        let rail = &ground.rails[label];
        let end = |q: f64, inward: f64| {
            let q = if q.is_finite() { q } else { 0.0 };
            // The tangent is that of the side, not of what comes beyond the corner.
            Foot { tangent: rail.at(q + inward * rail.length).tangent, ..rail.at(q) }
        };
        let ends = [end(range[0], 1e-9), end(range[1], -1e-9)];
        let is_straight = range[0].is_finite() && rail.is_straight(range[0], range[1]);
        Self { vertex, label, range, ends, is_straight }
    }
}

/// What the unknowns stand for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Of {
    /// Where vertices are.
    Places,
    /// Which way they go.
    Direction,
}

/// The mean of a value and its images, added in pairs, so that every image gets the same: of two mirrors and the half turn, the value
/// and one mirror's, then the other two.
fn mean_of(own: f64, twins: &[Twin], image: impl Fn(&Twin) -> f64) -> f64 {
    let sum = match twins {
        [a, b, c] => (own + image(a)) + (image(b) + image(c)),
        _ => twins.iter().fold(own, |sum, twin| sum + image(twin)),
    };
    sum / (twins.len() + 1) as f64
}

/// An edge of the pattern's boundary, counter-clockwise.
pub struct Link {
    /// Its first vertex.
    pub from: u32,
    /// Its last vertex.
    pub to: u32,
    /// Arc length between the two if both stood at 0.
    pub offset: f64,
    /// Whether its side is a curve.
    pub is_curved: bool,
}

/// The unknowns of a dense mesh.
pub struct Net<'a> {
    /// What it lies on.
    pub ground: &'a Ground<'a>,
    /// The mesh.
    pub sheet: &'a Sheet,
    /// For each vertex, how it moves.
    pub freedom: Vec<Freedom>,
    /// Vertices of which no corner counts: inner ones with two members, and boundary ones with one panel that take no corner.
    pub is_silent: Vec<bool>,
    /// The boundary's edges.
    pub links: Vec<Link>,
    /// Number of unknowns.
    pub unknowns: usize,
    /// Unknowns of an inner vertex: 2 or 3.
    pub width: usize,
    /// Unknowns of inner vertices; those of the sliders follow.
    pub inner_unknowns: usize,
    sliders: Vec<Slider>,
    /// Inner vertices of panels at the boundary: only these can leave the domain without a corner turning over.
    near_boundary: Vec<u32>,
    /// Smooth loops that inner vertices may be beyond.
    smooth_loops: Vec<usize>,
    /// What descents begin from, once one was asked for.
    pub(super) factor: OnceCell<Option<Factor>>,
}

/// Where all vertices are for given unknowns.
pub struct Places {
    /// Positions, local units.
    pub points: Vec<Vec3>,
    /// Slopes of a height surface.
    pub slopes: Vec<[f64; 2]>,
    /// Normals of a surface reached by closest point.
    pub normals: Vec<Vec3>,
    /// Tangents of the sliders.
    pub tangents: Vec<Vec3>,
}

impl<'a> Net<'a> {
    /// The unknowns of a sheet, `width` for each inner vertex; with `is_held` its whole boundary is fixed.
    pub fn new(ground: &'a Ground<'a>, sheet: &'a Sheet, width: usize, is_held: bool) -> Self {
        let mut freedom = vec![Freedom::Inner(0); sheet.points.len()];
        let mut sliders = Vec::new();
        for (label, held) in sheet.loops.iter().enumerate() {
            let ranges = sheet.ranges(label);
            for ((&v, &corner), range) in held.vertices.iter().zip(&held.corner).zip(ranges) {
                freedom[v as usize] = Freedom::Fixed;
                if !is_held && corner == NO_CORNER {
                    sliders.push(Slider::new(ground, v, label, range));
                }
            }
        }
        let mut inner_unknowns = 0;
        for place in freedom.iter_mut().filter(|f| **f != Freedom::Fixed) {
            *place = Freedom::Inner(inner_unknowns);
            inner_unknowns += width;
        }
        for (i, slider) in sliders.iter().enumerate() {
            freedom[slider.vertex as usize] = Freedom::Slider(inner_unknowns + i);
        }
        Self {
            unknowns: inner_unknowns + sliders.len(),
            inner_unknowns,
            width,
            is_silent: sheet.silent_vertices(),
            links: sheet.links(ground),
            near_boundary: sheet.near_boundary(),
            smooth_loops: sheet.smooth_loops(),
            ground,
            sheet,
            freedom,
            sliders,
            factor: OnceCell::new(),
        }
    }

    /// The unknowns of the sheet as it stands.
    pub fn start(&self) -> Vec<f64> {
        let mut x = vec![0.0; self.unknowns];
        for (freedom, point) in self.freedom.iter().zip(&self.sheet.points) {
            if let Freedom::Inner(at) = *freedom {
                x[at..at + self.width].copy_from_slice(&point[..self.width]);
            }
        }
        for held in &self.sheet.loops {
            for (&v, &q) in held.vertices.iter().zip(&held.along) {
                if let Freedom::Slider(at) = self.freedom[v as usize] {
                    x[at] = q;
                }
            }
        }
        self.even(&mut x, Of::Places);
        x
    }

    /// Makes unknowns, or a direction, as symmetric as the sheet is to be: each the mean over its images.
    pub fn even(&self, x: &mut [f64], of: Of) {
        let twins = &self.sheet.twins;
        if twins.is_empty() {
            return;
        }
        let given = x.to_vec();
        for (v, freedom) in self.freedom.iter().enumerate() {
            let Freedom::Inner(at) = *freedom else { continue };
            for k in 0..self.width {
                let image = |twin: &Twin| match self.freedom[twin.vertices[v] as usize] {
                    Freedom::Inner(there) => twin.signs.get(k).copied().unwrap_or(1.0) * given[there + k],
                    _ => given[at + k],
                };
                x[at + k] = mean_of(given[at + k], twins, image);
            }
        }
        for (i, slider) in self.sliders.iter().enumerate() {
            let at = self.inner_unknowns + i;
            let image = |twin: &Twin| {
                let Freedom::Slider(there) = self.freedom[twin.vertices[slider.vertex as usize] as usize]
                else {
                    return given[at];
                };
                // Of the image's plan length q the one here that it is the image of is c ± q again: twins are their own inverse.
                let from = self.sliders[there - self.inner_unknowns].label;
                let (_, c, sign) = twin.loops[from];
                match of {
                    Of::Direction => sign * given[there],
                    Of::Places => {
                        let turn = self.sheet.loop_lengths[slider.label];
                        let more = c + sign * given[there] - given[at];
                        given[at] + (more - turn * libm::round(more / turn))
                    }
                }
            };
            x[at] = mean_of(given[at], twins, image);
        }
    }

    /// Room for positions.
    pub fn places(&self) -> Places {
        let n = self.freedom.len();
        Places {
            points: self.sheet.points.clone(),
            slopes: vec![[0.0; 2]; n],
            normals: vec![UNKNOWN; if self.ground.is_height() { 0 } else { n }],
            tangents: vec![[0.0; 3]; self.sliders.len()],
        }
    }

    /// Places all vertices in plan, at height 0.
    pub fn place_in_plan(&self, x: &[f64], places: &mut Places) {
        for ((point, start), freedom) in places.points.iter_mut().zip(&self.sheet.points).zip(&self.freedom) {
            *point = match *freedom {
                Freedom::Inner(at) => [x[at], x[at + 1], 0.0],
                _ => [start[0], start[1], 0.0],
            };
        }
        self.place_sliders(x, places);
    }

    /// Places all vertices on the surface. On one reached by closest point the unknowns of inner vertices are brought back onto it.
    pub fn place(&self, x: &mut [f64], places: &mut Places) {
        self.place_in_plan(x, places);
        self.lift(x, places);
    }

    /// The second half of [`Net::place`]: from the plan onto the surface.
    pub fn lift(&self, x: &mut [f64], places: &mut Places) {
        if self.ground.is_height() {
            self.ground.lift(&mut places.points, &mut places.slopes);
        } else {
            self.place_by_foot(x, places);
        }
        for ((point, start), freedom) in places.points.iter_mut().zip(&self.sheet.points).zip(&self.freedom) {
            if *freedom == Freedom::Fixed {
                *point = *start;
            }
        }
    }

    fn place_by_foot(&self, x: &mut [f64], places: &mut Places) {
        for (v, freedom) in self.freedom.iter().enumerate() {
            let Freedom::Inner(at) = *freedom else { continue };
            let raised = if self.width == 3 {
                [x[at], x[at + 1], x[at + 2]]
            } else {
                self.ground.above([x[at], x[at + 1], self.sheet.points[v][2]])
            };
            let (foot, normal) = self.ground.foot(raised);
            x[at..at + self.width].copy_from_slice(&foot[..self.width]);
            (places.points[v], places.normals[v]) = (foot, normal);
        }
        for (slider, tangent) in self.sliders.iter().zip(&mut places.tangents) {
            let v = slider.vertex as usize;
            let [px, py, _] = places.points[v];
            let above = self.ground.above([px, py, self.sheet.points[v][2]]);
            let (_, normal) = self.ground.foot(above);
            // On a vertical tangent plane a horizontal curve stays horizontal.
            let is_steep = normal[2].abs() <= 1e-6;
            let rise = -(normal[0] * tangent[0] + normal[1] * tangent[1]) / normal[2];
            *tangent = [tangent[0], tangent[1], if is_steep { 0.0 } else { rise }];
            (places.points[v], places.normals[v]) = (above, normal);
        }
        for (v, _) in self.freedom.iter().enumerate().filter(|(_, f)| **f == Freedom::Fixed) {
            if places.normals[v] == UNKNOWN {
                places.normals[v] = self.ground.foot(self.sheet.points[v]).1;
            }
        }
    }

    fn place_sliders(&self, x: &[f64], places: &mut Places) {
        for (i, slider) in self.sliders.iter().enumerate() {
            let q = x[self.inner_unknowns + i];
            let rail = &self.ground.rails[slider.label];
            let beyond = |end: usize| {
                let Foot { point, tangent } = slider.ends[end];
                let more = q - slider.range[end];
                Foot { point: [point[0] + more * tangent[0], point[1] + more * tangent[1]], tangent }
            };
            let foot = match q {
                q if q < slider.range[0] || slider.is_straight => beyond(0),
                q if q > slider.range[1] => beyond(1),
                q => rail.at(q),
            };
            places.points[slider.vertex as usize] = [foot.point[0], foot.point[1], 0.0];
            places.tangents[i] = [foot.tangent[0], foot.tangent[1], 0.0];
        }
    }

    /// From a gradient by position to one by unknown.
    pub fn pull(&self, places: &Places, by_point: &[Vec3], gradient: &mut [f64], in_plan: bool) {
        for (v, freedom) in self.freedom.iter().enumerate() {
            let g = by_point[v];
            match *freedom {
                Freedom::Fixed => {}
                Freedom::Inner(at) if self.width == 3 => {
                    let n = places.normals[v];
                    let tangential = add(g, scale(n, -dot(n, g)));
                    gradient[at..at + 3].copy_from_slice(&tangential);
                }
                Freedom::Inner(at) if in_plan => gradient[at..at + 2].copy_from_slice(&g[..2]),
                Freedom::Inner(at) => {
                    let [zx, zy] = places.slopes[v];
                    gradient[at] = g[0] + g[2] * zx;
                    gradient[at + 1] = g[1] + g[2] * zy;
                }
                Freedom::Slider(at) => {
                    let t = places.tangents[at - self.inner_unknowns];
                    gradient[at] = if in_plan || self.width == 3 {
                        (g[0] * t[0] + g[1] * t[1]) + g[2] * t[2]
                    } else {
                        let [zx, zy] = places.slopes[v];
                        (g[0] + g[2] * zx) * t[0] + (g[1] + g[2] * zy) * t[1]
                    };
                }
            }
        }
    }

    /// Takes the part of a direction out that leaves the surface.
    pub fn make_tangential(&self, places: &Places, direction: &mut [f64]) {
        if self.width != 3 {
            return;
        }
        for (v, freedom) in self.freedom.iter().enumerate() {
            if let Freedom::Inner(at) = *freedom {
                let n = places.normals[v];
                let d = [direction[at], direction[at + 1], direction[at + 2]];
                direction[at..at + 3].copy_from_slice(&add(d, scale(n, -dot(n, d))));
            }
        }
    }

    /// The arc length of a boundary vertex.
    pub fn station(&self, x: &[f64], v: u32) -> f64 {
        match self.freedom[v as usize] {
            Freedom::Slider(at) => x[at],
            _ => self.sheet.station[v as usize],
        }
    }

    /// Arc length from the first to the second vertex of a boundary edge; not positive where the two have changed order.
    pub fn arc(&self, x: &[f64], link: &Link) -> f64 {
        self.station(x, link.to) - self.station(x, link.from) + link.offset
    }

    /// Whether two neighbours on the boundary have changed order.
    pub fn is_out_of_order(&self, x: &[f64]) -> bool {
        self.links.iter().any(|link| self.arc(x, link) <= 0.0)
    }

    /// Whether some vertex has left the domain.
    pub fn is_outside(&self, places: &Places) -> bool {
        self.near_boundary.iter().any(|&v| !self.ground.contains(places.points[v as usize]))
    }

    /// Inner vertices that are beyond a smooth loop or nearer to it than `margin`: the vertex, how far, and in which direction that grows.
    pub fn beyond_smooth_loops(&self, places: &Places, margin: f64) -> Vec<(u32, f64, [f64; 2])> {
        let mut found = Vec::new();
        for &label in &self.smooth_loops {
            for (v, freedom) in self.freedom.iter().enumerate() {
                if let (Freedom::Inner(_), Some((depth, way))) =
                    (freedom, self.ground.depth(label, places.points[v]))
                    && depth > -margin
                {
                    found.push((v as u32, depth, way));
                }
            }
        }
        found
    }

    /// The sheet's positions and arc lengths for given unknowns.
    pub fn state(&self, mut x: Vec<f64>) -> State {
        self.even(&mut x, Of::Places);
        let mut places = self.places();
        self.place(&mut x, &mut places);
        let along =
            self.sheet.loops.iter().map(|held| held.vertices.iter().map(|&v| self.station(&x, v)).collect());
        (places.points, along.collect())
    }
}
