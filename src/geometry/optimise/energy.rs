//! The energy of a pattern that can be built, and its gradient by position (docs/reference/geometry.md §6.2).

use super::net::{Link, Net, Places};
use crate::geometry::vector::{Vec3, cross, dot, sub};
use crate::simd::{Vector, with_vectors};
use pulp::{Simd, WithSimd};
use std::ops::Mul;

/// What the energy is to reach, in local units, and how much each part of it weighs.
#[derive(Clone, Copy, Debug)]
pub struct Weights {
    /// w_A of the angles and w_L of the lengths; the barriers weigh 1.
    pub angle: f64,
    /// w_L.
    pub length: f64,
    /// Half of the barriers' power p.
    pub half_power: u32,
    /// ℓ, what edges are drawn to.
    pub rest: f64,
    /// l_min and l_max of the barriers.
    pub range: [f64; 2],
    /// sin² of the angle of the barrier.
    pub sin_squared: f64,
    /// Largest distance of a boundary edge from its curve.
    pub gap: f64,
}

/// x to a whole power n ≥ 1, by squaring; a constant power leaves multiplications only.
#[inline(always)]
fn power<T: Copy + Mul<Output = T>>(mut x: T, mut n: u32) -> T {
    while n & 1 == 0 {
        x = x * x;
        n >>= 1;
    }
    let mut result = x;
    while n > 1 {
        x = x * x;
        n >>= 1;
        if n & 1 == 1 {
            result = result * x;
        }
    }
    result
}

/// What is summed over, gathered once a mesh: quads, corners of triangles that count, edges.
pub struct Terms {
    quads: Vec<Quad>,
    /// `[corner, next, previous]` of triangles.
    corners: Vec<[u32; 3]>,
    edges: Vec<[u32; 2]>,
}

/// A panel with four corners, each with 1 if it counts, 0 if not.
#[derive(Clone, Copy)]
struct Quad {
    vertices: [u32; 4],
    counts: [f64; 4],
}

impl Terms {
    /// The terms of a net.
    pub fn of(net: &Net<'_>) -> Self {
        let counts = |v: u32| !net.is_silent[v as usize];
        let (triangles, quads): (Vec<[u32; 4]>, Vec<[u32; 4]>) =
            net.sheet.quads.iter().partition(|quad| quad[2] == quad[3]);
        let quad =
            |vertices: [u32; 4]| Quad { vertices, counts: vertices.map(|v| f64::from(u8::from(counts(v)))) };
        let corners = triangles.into_iter().flat_map(|[a, b, c, _]| [[a, b, c], [b, c, a], [c, a, b]]);
        Self {
            quads: quads.into_iter().map(quad).collect(),
            corners: corners.filter(|corner| counts(corner[0])).collect(),
            edges: net.sheet.edges.list.clone(),
        }
    }

    /// Whether some corner turns over in plan: cheap, and true of most steps that are too long.
    pub fn is_folded(&self, points: &[Vec3]) -> bool {
        let is_over = |o: u32, u: u32, v: u32| {
            let (o, u, v) = (points[o as usize], points[u as usize], points[v as usize]);
            let turn = (u[0] - o[0]) * (v[1] - o[1]) - (u[1] - o[1]) * (v[0] - o[0]);
            turn.is_nan() || turn <= 0.0
        };
        let is_quad_over = |quad: &Quad| {
            let v = quad.vertices;
            (0..4).any(|i| quad.counts[i] > 0.0 && is_over(v[i], v[(i + 1) % 4], v[(i + 3) % 4]))
        };
        self.quads.iter().any(is_quad_over) || self.corners.iter().any(|&[o, u, v]| is_over(o, u, v))
    }

    /// The energy of angles and lengths; infinite where a corner turns over. `by_point` is its gradient.
    pub fn energy(&self, places: &Places, weights: &Weights, by_point: &mut [Vec3]) -> f64 {
        by_point.fill([0.0; 3]);
        match weights.half_power {
            8 => with_vectors(Sum::<8> { terms: self, places, weights, by_point }),
            _ => with_vectors(Sum::<16> { terms: self, places, weights, by_point }),
        }
    }
}

/// The sum over all terms with barriers of half the power `P`.
struct Sum<'a, const P: u32> {
    terms: &'a Terms,
    places: &'a Places,
    weights: &'a Weights,
    by_point: &'a mut [Vec3],
}

impl<const P: u32> WithSimd for Sum<'_, P> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let Self { terms, places, weights, by_point } = self;
        let lanes = Vector::<S>::LANES;
        let mut sum = 0.0;
        for quads in terms.quads.chunks(lanes) {
            let Some(more) = quad_batch::<P, S>(simd, quads, places, weights, by_point) else {
                return f64::INFINITY;
            };
            // One after the other, so that the sum does not depend on the number of lanes.
            more.numbers()[..quads.len()].iter().for_each(|energy| sum += energy);
        }
        for &corner in &terms.corners {
            sum += triangle_corner::<P>(corner, places, weights, by_point);
        }
        for edges in terms.edges.chunks(lanes) {
            let more = edge_batch::<P, S>(simd, edges, &places.points, weights, by_point);
            more.numbers()[..edges.len()].iter().for_each(|energy| sum += energy);
        }
        if sum.is_finite() { sum } else { f64::INFINITY }
    }
}

/// Three coordinates of each lane.
type Vector3<S> = [Vector<S>; 3];

#[inline(always)]
fn dot_lanes<S: Simd>(a: &Vector3<S>, b: &Vector3<S>) -> Vector<S> {
    (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]
}

/// c w_A (Q − 1) + (sin² · Q)^p/2 of the corners of a quad in each lane, Q = |e|²|f|² / |e × f|² with the corner's arms e and f; `None`
/// where a corner that counts turns over.
#[inline(always)]
fn quad_batch<const P: u32, S: Simd>(
    simd: S,
    quads: &[Quad],
    places: &Places,
    weights: &Weights,
    by_point: &mut [Vec3],
) -> Option<Vector<S>> {
    // A lane without a quad repeats the last.
    let quad = |l: usize| &quads[l.min(quads.len() - 1)];
    let zero = Vector::splat(simd, 0.0);
    let points: [Vector3<S>; 4] = std::array::from_fn(|k| {
        std::array::from_fn(|c| Vector::of(simd, |l| places.points[quad(l).vertices[k] as usize][c]))
    });
    // Side k runs from vertex k to the next; corner k has the arms side k and minus side k − 1.
    let sides: [Vector3<S>; 4] =
        std::array::from_fn(|k| std::array::from_fn(|c| points[(k + 1) % 4][c] - points[k][c]));
    let squares: [Vector<S>; 4] = std::array::from_fn(|k| dot_lanes(&sides[k], &sides[k]));
    let mut by_side = [[zero; 3]; 4];
    let mut energy = zero;
    let mut turned = zero;
    for k in 0..4 {
        let before = (k + 3) % 4;
        let (e, f) = (&sides[k], &sides[before]);
        let (ee, ff) = (squares[k], squares[before]);
        let count = Vector::of(simd, |l| quad(l).counts[k]);
        let ef = -dot_lanes(e, f);
        let area = ee * ff - ef * ef;
        let facing = facing(e, f, places, |l| quad(l).vertices[k]);
        let open = facing.where_positive(area, zero);
        turned = turned + open.where_positive(zero, count);
        // Any number that is not 0 where nothing counts.
        let inverse = open.constant(1.0) / open.where_positive(open, open.constant(1.0));
        let q = ee * ff * inverse;
        let ratio = q * weights.sin_squared;
        let steep = power(ratio, P - 1);
        energy = energy + count * ((q - 1.0) * weights.angle + steep * ratio);
        let by_q = count
            * (steep * (f64::from(P) * weights.sin_squared) + weights.angle)
            * (inverse * inverse)
            * 2.0;
        let by_ef = by_q * ee * ff * ef;
        let by_ee = by_q * ff * ef * ef;
        let by_ff = by_q * ee * ef * ef;
        for c in 0..3 {
            by_side[k][c] = by_side[k][c] - (by_ee * e[c] + by_ef * f[c]);
            by_side[before][c] = by_side[before][c] - (by_ff * f[c] + by_ef * e[c]);
        }
    }
    if turned.numbers()[..quads.len()].iter().any(|&corners| corners > 0.0) {
        return None;
    }
    for (l, quad) in quads.iter().enumerate() {
        for (k, &v) in quad.vertices.iter().enumerate() {
            let g = &mut by_point[v as usize];
            for c in 0..3 {
                g[c] += by_side[(k + 3) % 4][c].numbers()[l] - by_side[k][c].numbers()[l];
            }
        }
    }
    Some(energy)
}

/// How far the corner between side `e` and the side `f` before it is from turning over: in plan, or against the surface normal.
#[inline(always)]
fn facing<S: Simd>(
    e: &Vector3<S>,
    f: &Vector3<S>,
    places: &Places,
    corner: impl Fn(usize) -> u32,
) -> Vector<S> {
    let up = f[0] * e[1] - f[1] * e[0];
    if places.normals.is_empty() {
        return up;
    }
    let across = [f[1] * e[2] - f[2] * e[1], f[2] * e[0] - f[0] * e[2], up];
    let normal = std::array::from_fn(|c| up.lane_by_lane(|l| places.normals[corner(l) as usize][c]));
    dot_lanes(&across, &normal)
}

/// The same of one corner of a triangle, whose angle weighs half.
#[inline(always)]
fn triangle_corner<const P: u32>(
    [o, u, v]: [u32; 3],
    places: &Places,
    weights: &Weights,
    by_point: &mut [Vec3],
) -> f64 {
    let [o, u, v] = [o as usize, u as usize, v as usize];
    let at = places.points[o];
    let (e, f) = (sub(places.points[u], at), sub(places.points[v], at));
    let facing = match places.normals.get(o) {
        None => e[0] * f[1] - e[1] * f[0],
        Some(&normal) => dot(cross(e, f), normal),
    };
    let (ee, ff, ef) = (dot(e, e), dot(f, f), dot(e, f));
    let area = ee * ff - ef * ef;
    if facing.is_nan() || facing <= 0.0 || area.is_nan() || area <= 0.0 {
        return f64::INFINITY;
    }
    let q = ee * ff / area;
    let angle = 0.5 * weights.angle;
    let ratio = weights.sin_squared * q;
    let steep = power(ratio, P - 1);
    let by_q = (angle + f64::from(P) * weights.sin_squared * steep) / (area * area);
    let by_ee = -2.0 * by_q * ff * ef * ef;
    let by_ff = -2.0 * by_q * ee * ef * ef;
    let by_ef = 2.0 * by_q * ee * ff * ef;
    for k in 0..3 {
        let ge = by_ee * e[k] + by_ef * f[k];
        let gf = by_ff * f[k] + by_ef * e[k];
        by_point[u][k] += ge;
        by_point[v][k] += gf;
        by_point[o][k] -= ge + gf;
    }
    angle * (q - 1.0) + steep * ratio
}

/// w_L (x + 1/x − 2) + (l / l_max)^p + (l_min / l)^p, x = (l/ℓ)², of an edge in each lane.
#[inline(always)]
fn edge_batch<const P: u32, S: Simd>(
    simd: S,
    edges: &[[u32; 2]],
    points: &[Vec3],
    weights: &Weights,
    by_point: &mut [Vec3],
) -> Vector<S> {
    let end = |l: usize, end: usize| points[edges[l.min(edges.len() - 1)][end] as usize];
    let d: Vector3<S> = std::array::from_fn(|c| Vector::of(simd, |l| end(l, 1)[c] - end(l, 0)[c]));
    let square = dot_lanes(&d, &d);
    let rest = weights.rest * weights.rest;
    let least = weights.range[0] * weights.range[0];
    let inverse = square.constant(1.0) / square;
    let long = power(square * (1.0 / (weights.range[1] * weights.range[1])), P);
    let short = power(inverse * least, P);
    let by_square = ((-(inverse * inverse * rest) + 1.0 / rest) * weights.length
        + (long - short) * inverse * f64::from(P))
        * 2.0;
    let by_way = d.map(|d| by_square * d);
    for (l, &[u, v]) in edges.iter().enumerate() {
        for c in 0..3 {
            let g = by_way[c].numbers()[l];
            by_point[v as usize][c] += g;
            by_point[u as usize][c] -= g;
        }
    }
    (square * (1.0 / rest) + inverse * rest - 2.0) * weights.length + (long + short)
}

/// The energy of boundary edges on curves, (⅜ s (s − c) / gap²)^(p/2) with arc s and chord c in plan; adds its gradient by unknown.
pub fn gaps(net: &Net<'_>, x: &[f64], places: &Places, weights: &Weights, gradient: &mut [f64]) -> f64 {
    let mut sum = 0.0;
    for link in net.links.iter().filter(|link| link.is_curved) {
        sum += gap(net, x, places, weights, link, gradient);
    }
    if sum.is_finite() { sum } else { f64::INFINITY }
}

fn gap(
    net: &Net<'_>,
    x: &[f64],
    places: &Places,
    weights: &Weights,
    link: &Link,
    gradient: &mut [f64],
) -> f64 {
    let arc = net.arc(x, link);
    let (p, q) = (places.points[link.from as usize], places.points[link.to as usize]);
    let way = [q[0] - p[0], q[1] - p[1]];
    let chord = (way[0] * way[0] + way[1] * way[1]).sqrt();
    let scale = 0.375 / (weights.gap * weights.gap);
    let ratio = scale * arc * (arc - chord).max(0.0);
    // A straight piece leaves rounding errors only.
    if arc <= 0.0 || chord <= 0.0 || ratio <= 1e-12 {
        return 0.0;
    }
    let value = power(ratio, weights.half_power);
    let by_ratio = f64::from(weights.half_power) * value / ratio * scale;
    let (by_arc, by_chord) = (by_ratio * (2.0 * arc - chord), -by_ratio * arc);
    let along = |v: u32| net.slide(places, v).map(|(at, t)| (at, (way[0] * t[0] + way[1] * t[1]) / chord));
    if let Some((at, forward)) = along(link.from) {
        gradient[at] -= by_arc + by_chord * forward;
    }
    if let Some((at, forward)) = along(link.to) {
        gradient[at] += by_arc + by_chord * forward;
    }
    value
}
