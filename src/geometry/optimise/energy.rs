//! The energy of a pattern that can be built, and its gradient by position (PATTERN §3).

use super::net::{Link, Net, Places};
use crate::geometry::vector::{Vec3, cross, dot, sub};
use crate::simd::wide;

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

/// Panels or edges that are worked on at once.
const LANES: usize = 8;

/// One number of each panel or edge of a batch.
type Lanes = [f64; LANES];

/// Three coordinates of each.
type Lanes3 = [Lanes; 3];

/// x to a whole power, by squaring; a constant power leaves multiplications only.
#[inline(always)]
fn power(mut x: f64, mut n: u32) -> f64 {
    let mut result = 1.0;
    while n > 0 {
        if n & 1 == 1 {
            result *= x;
        }
        n >>= 1;
        if n > 0 {
            x *= x;
        }
    }
    result
}

/// What is summed over, gathered once a mesh: quads, triangles and their corners that count, edges.
pub struct Terms {
    quads: Vec<[u32; 4]>,
    /// For each quad, 1 for a corner that counts, 0 for one that does not.
    counts: Vec<[f64; 4]>,
    /// `[corner, next, previous]` of triangles.
    corners: Vec<[u32; 3]>,
    edges: Vec<[u32; 2]>,
}

impl Terms {
    /// The terms of a net.
    pub fn of(net: &Net<'_>) -> Self {
        let counts = |v: u32| !net.is_silent[v as usize];
        let is_triangle = |quad: &&[u32; 4]| quad[2] == quad[3];
        let quads: Vec<[u32; 4]> = net.sheet.quads.iter().filter(|q| !is_triangle(q)).copied().collect();
        let corners = net
            .sheet
            .quads
            .iter()
            .filter(is_triangle)
            .flat_map(|&[a, b, c, _]| [[a, b, c], [b, c, a], [c, a, b]]);
        Self {
            counts: quads.iter().map(|quad| quad.map(|v| f64::from(u8::from(counts(v))))).collect(),
            quads,
            corners: corners.filter(|corner| counts(corner[0])).collect(),
            edges: net.sheet.edges.list.clone(),
        }
    }

    /// Whether some corner turns over in plan: cheap, and true of most steps that are too long.
    pub fn is_folded(&self, points: &[Vec3]) -> bool {
        let turn = |o: u32, u: u32, v: u32| {
            let (o, u, v) = (points[o as usize], points[u as usize], points[v as usize]);
            (u[0] - o[0]) * (v[1] - o[1]) - (u[1] - o[1]) * (v[0] - o[0])
        };
        let quad = |(quad, counts): (&[u32; 4], &[f64; 4])| {
            (0..4).any(|i| {
                let turn = turn(quad[i], quad[(i + 1) % 4], quad[(i + 3) % 4]);
                counts[i] > 0.0 && (turn.is_nan() || turn <= 0.0)
            })
        };
        self.quads.iter().zip(&self.counts).any(quad)
            || self.corners.iter().any(|&[o, u, v]| {
                let turn = turn(o, u, v);
                turn.is_nan() || turn <= 0.0
            })
    }

    /// The energy of angles and lengths; infinite where a corner turns over. `by_point` is its gradient.
    pub fn energy(&self, places: &Places, weights: &Weights, by_point: &mut [Vec3]) -> f64 {
        wide(
            #[inline(always)]
            || match weights.half_power {
                8 => self.powered::<8>(places, weights, by_point),
                _ => self.powered::<16>(places, weights, by_point),
            },
        )
    }

    #[inline(always)]
    fn powered<const P: u32>(&self, places: &Places, weights: &Weights, by_point: &mut [Vec3]) -> f64 {
        by_point.fill([0.0; 3]);
        let mut sum = 0.0;
        for (quads, counts) in self.quads.chunks(LANES).zip(self.counts.chunks(LANES)) {
            let energy = quad_batch::<P>(quads, counts, places, weights, by_point);
            if !energy.is_finite() {
                return f64::INFINITY;
            }
            sum += energy;
        }
        for &corner in &self.corners {
            sum += triangle_corner::<P>(corner, places, weights, by_point);
        }
        for edges in self.edges.chunks(LANES) {
            sum += edge_batch::<P>(edges, &places.points, weights, by_point);
        }
        if sum.is_finite() { sum } else { f64::INFINITY }
    }
}

#[inline(always)]
fn lanes(f: impl Fn(usize) -> f64) -> Lanes {
    std::array::from_fn(f)
}

#[inline(always)]
fn dot_lanes(a: &Lanes3, b: &Lanes3) -> Lanes {
    lanes(|l| (a[0][l] * b[0][l] + a[1][l] * b[1][l]) + a[2][l] * b[2][l])
}

/// c w_A (Q − 1) + (sin² · Q)^p/2 of the corners of up to [`LANES`] quads, Q = |e|²|f|² / |e × f|² with the corner's arms e and f.
#[inline(always)]
fn quad_batch<const P: u32>(
    quads: &[[u32; 4]],
    counts: &[[f64; 4]],
    places: &Places,
    weights: &Weights,
    by_point: &mut [Vec3],
) -> f64 {
    // A lane without a quad repeats the first with no corner that counts.
    let quad = |l: usize| quads.get(l).unwrap_or(&quads[0]);
    let count: [Lanes; 4] = std::array::from_fn(|k| lanes(|l| counts.get(l).map_or(0.0, |c| c[k])));
    let points: [Lanes3; 4] = std::array::from_fn(|k| {
        let at: [Vec3; LANES] = std::array::from_fn(|l| places.points[quad(l)[k] as usize]);
        std::array::from_fn(|c| lanes(|l| at[l][c]))
    });
    // Side k runs from vertex k to the next; corner k has the arms side k and minus side k − 1.
    let sides: [Lanes3; 4] = std::array::from_fn(|k| {
        std::array::from_fn(|c| lanes(|l| points[(k + 1) % 4][c][l] - points[k][c][l]))
    });
    let squares: [Lanes; 4] = std::array::from_fn(|k| dot_lanes(&sides[k], &sides[k]));
    let mut by_side = [[[0.0; LANES]; 3]; 4];
    let mut energy = [0.0; LANES];
    let mut open = [true; LANES];
    for k in 0..4 {
        let before = (k + 3) % 4;
        let (e, f) = (&sides[k], &sides[before]);
        let facing = facing(e, f, places, |l| quad(l)[k]);
        let (ee, ff) = (&squares[k], &squares[before]);
        let ef = dot_lanes(e, f).map(|d| -d);
        let area = lanes(|l| ee[l] * ff[l] - ef[l] * ef[l]);
        for l in 0..LANES {
            let is_open = facing[l] > 0.0 && area[l] > 0.0;
            open[l] &= is_open || count[k][l] == 0.0;
            // Any number that is not 0 where nothing counts.
            let inverse = 1.0 / if is_open { area[l] } else { 1.0 };
            let q = ee[l] * ff[l] * inverse;
            let ratio = weights.sin_squared * q;
            let steep = power(ratio, P - 1);
            energy[l] += count[k][l] * (weights.angle * (q - 1.0) + steep * ratio);
            let by_q = count[k][l]
                * (weights.angle + f64::from(P) * weights.sin_squared * steep)
                * (inverse * inverse);
            let by_ee = -2.0 * by_q * ff[l] * ef[l] * ef[l];
            let by_ff = -2.0 * by_q * ee[l] * ef[l] * ef[l];
            let by_ef = 2.0 * by_q * ee[l] * ff[l] * ef[l];
            for c in 0..3 {
                by_side[k][c][l] += by_ee * e[c][l] - by_ef * f[c][l];
                by_side[before][c][l] += by_ff * f[c][l] - by_ef * e[c][l];
            }
        }
    }
    if open.contains(&false) {
        return f64::INFINITY;
    }
    for (l, quad) in quads.iter().enumerate() {
        for k in 0..4 {
            let g = &mut by_point[quad[k] as usize];
            for c in 0..3 {
                g[c] += by_side[(k + 3) % 4][c][l] - by_side[k][c][l];
            }
        }
    }
    energy[..quads.len()].iter().sum()
}

/// How far the corner between side `e` and the side `f` before it is from turning over: in plan, or against the surface normal.
#[inline(always)]
fn facing(e: &Lanes3, f: &Lanes3, places: &Places, corner: impl Fn(usize) -> u32) -> Lanes {
    if places.normals.is_empty() {
        return lanes(|l| f[0][l] * e[1][l] - f[1][l] * e[0][l]);
    }
    lanes(|l| {
        let at = |a: &Lanes3| [a[0][l], a[1][l], a[2][l]];
        dot(cross(at(f), at(e)), places.normals[corner(l) as usize])
    })
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

/// w_L (x + 1/x − 2) + (l / l_max)^p + (l_min / l)^p, x = (l/ℓ)², of up to [`LANES`] edges.
#[inline(always)]
fn edge_batch<const P: u32>(
    edges: &[[u32; 2]],
    points: &[Vec3],
    weights: &Weights,
    by_point: &mut [Vec3],
) -> f64 {
    let edge = |l: usize| edges.get(l).unwrap_or(&edges[0]);
    let ways: [Vec3; LANES] = std::array::from_fn(|l| {
        let [u, v] = edge(l).map(|v| points[v as usize]);
        sub(v, u)
    });
    let d: Lanes3 = std::array::from_fn(|c| lanes(|l| ways[l][c]));
    let square = dot_lanes(&d, &d);
    let rest = weights.rest * weights.rest;
    let (to_rest, to_largest) = (1.0 / rest, 1.0 / (weights.range[1] * weights.range[1]));
    let least = weights.range[0] * weights.range[0];
    let mut energy = [0.0; LANES];
    let mut by_square = [0.0; LANES];
    for l in 0..LANES {
        let inverse = 1.0 / square[l];
        let long = power(square[l] * to_largest, P);
        let short = power(least * inverse, P);
        energy[l] = weights.length * (square[l] * to_rest + rest * inverse - 2.0) + (long + short);
        by_square[l] = 2.0
            * (weights.length * (to_rest - rest * inverse * inverse)
                + f64::from(P) * (long - short) * inverse);
    }
    for (l, &[u, v]) in edges.iter().enumerate() {
        for c in 0..3 {
            let g = by_square[l] * d[c][l];
            by_point[v as usize][c] += g;
            by_point[u as usize][c] -= g;
        }
    }
    energy[..edges.len()].iter().sum()
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
