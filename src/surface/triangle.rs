//! One triangle: closest point, the point over a point of the plan, area, angles, overlap with another.

use std::f64::consts::{PI, TAU};

/// The corners of a triangle, m.
pub type Triangle = [[f64; 3]; 3];

pub(super) fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn square(a: [f64; 3]) -> f64 {
    dot(a, a)
}

/// Closest point of a triangle by the regions of its corners, edges and inside (Ericson 2005, *Real-Time Collision Detection*,
/// §5.1.5). On an edge it depends on nothing but that edge, so that triangles that share it, their corners in the same order,
/// give the same point. Beside it, whether it is clearly within, farther from each edge than 1e-6 of the height there.
#[inline]
pub(super) fn closest_on_triangle(p: [f64; 3], &[a, b, c]: &Triangle) -> ([f64; 3], bool) {
    let (ab, ac) = (sub(b, a), sub(c, a));
    let along = |o: [f64; 3], d: [f64; 3], s: f64| (std::array::from_fn(|k| o[k] + s * d[k]), false);
    let ap = sub(p, a);
    let (d1, d2) = (dot(ab, ap), dot(ac, ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return (a, false);
    }
    let bp = sub(p, b);
    let (d3, d4) = (dot(ab, bp), dot(ac, bp));
    if d3 >= 0.0 && d4 <= d3 {
        return (b, false);
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return along(a, ab, (d1 / square(ab)).min(1.0));
    }
    let cp = sub(p, c);
    let (d5, d6) = (dot(ab, cp), dot(ac, cp));
    if d6 >= 0.0 && d5 <= d6 {
        return (c, false);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return along(a, ac, (d2 / square(ac)).min(1.0));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let bc = sub(c, b);
        return along(b, bc, (dot(bc, bp) / square(bc)).clamp(0.0, 1.0));
    }
    let denominator = 1.0 / (va + vb + vc);
    let (v, w) = (vb * denominator, vc * denominator);
    let is_inner = v.min(w).min(1.0 - v - w) > 1e-6;
    (std::array::from_fn(|k| a[k] + v * ab[k] + w * ac[k]), is_inner)
}

/// The point of a triangle over a point of the plan, or the nearest in plan where that is within `tolerance` beside it; `None`
/// beyond and for vertical ones.
pub(super) fn over_triangle([x, y]: [f64; 2], [a, b, c]: &Triangle, tolerance: f64) -> Option<[f64; 3]> {
    let cross = |p: &[f64; 3], q: &[f64; 3], r: [f64; 2]| {
        (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    };
    let area = cross(a, b, [c[0], c[1]]);
    let shares = [cross(b, c, [x, y]), cross(c, a, [x, y]), cross(a, b, [x, y])];
    let lengths = [(b, c), (c, a), (a, b)].map(|(p, q)| (q[0] - p[0]).hypot(q[1] - p[1]));
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    if area.abs() <= 1e-12 * longest * longest {
        return None;
    }
    let inside = (0..3).all(|k| shares[k] * area.signum() >= -tolerance * lengths[k]);
    // Clamped onto the triangle, so that a sliver does not shoot up beyond its edge.
    let weights = shares.map(|s| (s / area).clamp(0.0, 1.0));
    let sum: f64 = weights.iter().sum();
    inside.then(|| std::array::from_fn(|k| (weights[0] * a[k] + weights[1] * b[k] + weights[2] * c[k]) / sum))
}

/// Half the cross product of two sides.
pub(super) fn vector_area([a, b, c]: &Triangle) -> [f64; 3] {
    let (u, v) = (sub(*b, *a), sub(*c, *a));
    [0.5 * (u[1] * v[2] - u[2] * v[1]), 0.5 * (u[2] * v[0] - u[0] * v[2]), 0.5 * (u[0] * v[1] - u[1] * v[0])]
}

/// Whether a triangle is vertical, but for rounding.
pub(super) fn is_vertical(t: &Triangle) -> bool {
    let area = vector_area(t);
    area[2] * area[2] <= 1e-12 * square(area)
}

/// Whether a triangle is steeper than 10 : 1 and in plan no wider than `tolerance`, as the walls of files in millimetres are.
pub(super) fn is_steep(t: &Triangle, tolerance: f64) -> bool {
    let area = vector_area(t);
    let side = |k: usize| (t[k][0] - t[(k + 1) % 3][0]).hypot(t[k][1] - t[(k + 1) % 3][1]);
    let longest = side(0).max(side(1)).max(side(2));
    area[2] * area[2] <= 0.01 * square(area) && 2.0 * area[2].abs() <= tolerance * longest
}

/// Whether two triangles overlap in plan by more than `tolerance` in every direction (separating axes).
pub(super) fn overlap(s: &Triangle, t: &Triangle, tolerance: f64) -> bool {
    let span = |triangle: &Triangle, [nx, ny]: [f64; 2]| {
        let at = triangle.map(|p| nx * p[0] + ny * p[1]);
        [at[0].min(at[1]).min(at[2]), at[0].max(at[1]).max(at[2])]
    };
    let sides = |triangle: &Triangle| {
        let [a, b, c] = *triangle;
        [(a, b), (b, c), (c, a)].map(|(p, q)| [p[1] - q[1], q[0] - p[0]])
    };
    sides(s).into_iter().chain(sides(t)).all(|n| {
        let ([low, high], [from, to]) = (span(s, n), span(t, n));
        let length = (n[0] * n[0] + n[1] * n[1]).sqrt();
        length == 0.0 || high.min(to) - low.max(from) > tolerance * length
    })
}

/// The angle under which a triangle is seen from a point of it: 2π inside, π on an edge, its own angle in a corner; none farther
/// than `reach` from it. What is nearer than `reach` counts as at.
pub(super) fn angle_at(t: &Triangle, p: [f64; 3], reach: f64) -> Option<f64> {
    let is_beside = |k: usize| {
        let at = t.map(|corner| corner[k]);
        p[k] < at[0].min(at[1]).min(at[2]) - reach || p[k] > at[0].max(at[1]).max(at[2]) + reach
    };
    if (0..3).any(is_beside) {
        return None;
    }
    let near = |q: [f64; 3]| square(sub(q, p)) <= reach * reach;
    if let Some(k) = (0..3).find(|&k| near(t[k])) {
        let (u, v) = (sub(t[(k + 1) % 3], t[k]), sub(t[(k + 2) % 3], t[k]));
        let cosine = dot(u, v) / (square(u) * square(v)).sqrt();
        return Some(libm::acos(cosine.clamp(-1.0, 1.0)));
    }
    let on_edge = |k: usize| {
        let (a, along) = (t[k], sub(t[(k + 1) % 3], t[k]));
        let share = (dot(sub(p, a), along) / square(along)).clamp(0.0, 1.0);
        near(std::array::from_fn(|i| a[i] + share * along[i]))
    };
    if (0..3).any(on_edge) {
        return Some(PI);
    }
    near(closest_on_triangle(p, t).0).then_some(TAU)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::random;

    /// Small triangles in a box of 10 m.
    pub fn soup(count: usize) -> Vec<Triangle> {
        let mut rng = random::stream(5, 0, 0);
        let mut number = || random::unit(&mut rng);
        (0..count)
            .map(|_| {
                let o = [10.0 * number(), 10.0 * number(), number()];
                std::array::from_fn(|_| std::array::from_fn(|k| o[k] + number()))
            })
            .collect()
    }

    /// No point of the triangle is closer than the closest one.
    #[test]
    fn closest_of_a_triangle_by_sampling() {
        let mut rng = random::stream(7, 0, 0);
        for t in soup(100) {
            let p: [f64; 3] = std::array::from_fn(|k| t[0][k] + 4.0 * random::unit(&mut rng) - 2.0);
            let found = square(sub(closest_on_triangle(p, &t).0, p));
            for i in 0..=20 {
                for j in 0..=(20 - i) {
                    let (v, w) = (f64::from(i) / 20.0, f64::from(j) / 20.0);
                    let q =
                        std::array::from_fn(|k| t[0][k] + v * (t[1][k] - t[0][k]) + w * (t[2][k] - t[0][k]));
                    assert!(square(sub(q, p)) >= found - 1e-12);
                }
            }
        }
    }
}
