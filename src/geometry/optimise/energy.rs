//! The energy of a pattern that can be built, and its gradient by position (PATTERN §3).

use super::net::{Link, Net, Places};
use crate::geometry::vector::{Vec3, cross, dot, sub};

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

/// x to a whole power, by squaring.
#[inline(always)]
fn power(mut x: f64, mut n: u32) -> f64 {
    let mut result = 1.0;
    while n > 0 {
        if n & 1 == 1 {
            result *= x;
        }
        x *= x;
        n >>= 1;
    }
    result
}

/// The energy of angles and lengths; infinite where a corner turns over. `by_point` is its gradient.
pub fn shape(net: &Net<'_>, places: &Places, weights: &Weights, by_point: &mut [Vec3]) -> f64 {
    by_point.fill([0.0; 3]);
    let mut sum = 0.0;
    for quad in &net.sheet.quads {
        let is_triangle = quad[2] == quad[3];
        let (count, share) = if is_triangle { (3, 0.5) } else { (4, 1.0) };
        for i in 0..count {
            let o = quad[i];
            if net.is_silent[o as usize] {
                continue;
            }
            let (u, v) = (quad[(i + 1) % count], quad[(i + count - 1) % count]);
            let corner = corner(net, places, [o, u, v], share, weights, by_point);
            if !corner.is_finite() {
                return f64::INFINITY;
            }
            sum += corner;
        }
    }
    for &[u, v] in &net.sheet.edges.list {
        sum += edge(places, u, v, weights, by_point);
    }
    if sum.is_finite() { sum } else { f64::INFINITY }
}

/// One corner `[o, u, v]` with the arms e to u and f to v: c w_A (Q − 1) + (sin² · Q)^(p/2), Q = |e|²|f|² / |e × f|².
#[inline(always)]
fn corner(
    net: &Net<'_>,
    places: &Places,
    [o, u, v]: [u32; 3],
    share: f64,
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
    let barrier = power(weights.sin_squared * q, weights.half_power);
    // dE/dQ / area²: Q's derivatives are −ff ef², −ee ef² and 2 ee ff ef over area².
    let by_q = (share * weights.angle + f64::from(weights.half_power) * barrier / q) / (area * area);
    let by_ee = -by_q * ff * ef * ef;
    let by_ff = -by_q * ee * ef * ef;
    let by_ef = 2.0 * by_q * ee * ff * ef;
    for k in 0..3 {
        let ge = 2.0 * by_ee * e[k] + by_ef * f[k];
        let gf = 2.0 * by_ff * f[k] + by_ef * e[k];
        by_point[u][k] += ge;
        by_point[v][k] += gf;
        by_point[o][k] -= ge + gf;
    }
    let _ = net;
    share * weights.angle * (q - 1.0) + barrier
}

/// One edge: w_L (x + 1/x − 2) + (l / l_max)^p + (l_min / l)^p, x = (l/ℓ)².
#[inline(always)]
fn edge(places: &Places, u: u32, v: u32, weights: &Weights, by_point: &mut [Vec3]) -> f64 {
    let [u, v] = [u as usize, v as usize];
    let d = sub(places.points[v], places.points[u]);
    let square = dot(d, d);
    if square.is_nan() || square <= 0.0 {
        return f64::INFINITY;
    }
    let rest = weights.rest * weights.rest;
    let x = square / rest;
    let [least, largest] = weights.range;
    let long = power(square / (largest * largest), weights.half_power);
    let short = power(least * least / square, weights.half_power);
    let by_square = weights.length * (1.0 / rest - rest / (square * square))
        + f64::from(weights.half_power) * (long - short) / square;
    for k in 0..3 {
        let g = 2.0 * by_square * d[k];
        by_point[v][k] += g;
        by_point[u][k] -= g;
    }
    weights.length * (x + 1.0 / x - 2.0) + (long + short)
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
