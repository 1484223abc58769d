//! A tree of boxes over triangles: the closest point, and the height over a point of the plan.

/// Triangles in a leaf.
const LEAF: usize = 4;

/// What a search finds: a point, its triangle, and its squared distance.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Closest {
    /// The point on the triangle, m.
    pub point: [f64; 3],
    /// Number of the triangle.
    pub triangle: u32,
    /// Squared distance, m².
    pub distance2: f64,
}

/// An axis-aligned box.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    low: [f64; 3],
    high: [f64; 3],
}

impl Bounds {
    const EMPTY: Self = Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    fn with(mut self, p: [f64; 3]) -> Self {
        for (k, &value) in p.iter().enumerate() {
            self.low[k] = self.low[k].min(value);
            self.high[k] = self.high[k].max(value);
        }
        self
    }

    /// Squared distance of a point, 0 inside.
    #[inline]
    fn distance2(&self, p: [f64; 3]) -> f64 {
        let beside = |k: usize| (self.low[k] - p[k]).max(p[k] - self.high[k]).max(0.0);
        square([beside(0), beside(1), beside(2)])
    }
}

/// A node: its left child is the next node; a leaf has no right child.
#[derive(Clone, Debug)]
struct Node {
    bounds: Bounds,
    /// Right child, or 0 in a leaf.
    right: u32,
    /// Triangles of a leaf, as a range of the sorted ones.
    start: u32,
    end: u32,
}

/// A binary tree of bounding boxes, halved at the median along the longest side.
#[derive(Clone, Debug)]
pub struct TriangleTree {
    nodes: Vec<Node>,
    /// Triangles in the order of the leaves, each with its number.
    triangles: Vec<([[f64; 3]; 3], u32)>,
}

impl TriangleTree {
    /// Builds the tree; `None` without triangles.
    pub fn new(triangles: &[[[f64; 3]; 3]]) -> Option<Self> {
        if triangles.is_empty() {
            return None;
        }
        let mut sorted: Vec<_> = triangles.iter().zip(0u32..).map(|(&t, i)| (t, i)).collect();
        let mut nodes = Vec::with_capacity(2 * triangles.len() / LEAF + 1);
        split(&mut sorted, 0, &mut nodes);
        Some(Self { nodes, triangles: sorted })
    }

    /// The point of all triangles that is closest to `p`. Of equally close triangles, the one found first.
    pub fn closest(&self, p: [f64; 3]) -> Closest {
        let mut best = Closest { point: p, triangle: 0, distance2: f64::INFINITY };
        // Depth is at most log₂ of the number of triangles, far below 64.
        let (mut stack, mut top) = ([(0u32, 0.0f64); 64], 1);
        while top > 0 {
            top -= 1;
            let (index, distance2) = stack[top];
            if distance2 >= best.distance2 {
                continue;
            }
            let node = &self.nodes[index as usize];
            if node.right == 0 {
                self.search_leaf(node, p, &mut best);
                continue;
            }
            let (left, right) = (index + 1, node.right);
            let a = self.nodes[left as usize].bounds.distance2(p);
            let b = self.nodes[right as usize].bounds.distance2(p);
            let (near, far) = if a <= b { ((left, a), (right, b)) } else { ((right, b), (left, a)) };
            stack[top] = far;
            stack[top + 1] = near;
            top += 2;
        }
        best
    }

    fn search_leaf(&self, node: &Node, p: [f64; 3], best: &mut Closest) {
        for (corners, triangle) in &self.triangles[node.start as usize..node.end as usize] {
            let point = closest_on_triangle(p, corners);
            let distance2 = square(sub(point, p));
            if distance2 < best.distance2 {
                *best = Closest { point, triangle: *triangle, distance2 };
            }
        }
    }

    /// The largest z over (x, y); triangles reach `tolerance` beyond their edges in plan.
    pub fn highest(&self, x: f64, y: f64, tolerance: f64) -> Option<f64> {
        let mut best: Option<f64> = None;
        let (mut stack, mut top) = ([0u32; 64], 1);
        while top > 0 {
            top -= 1;
            let index = stack[top];
            let node = &self.nodes[index as usize];
            let Bounds { low, high } = node.bounds;
            let beside = x < low[0] - tolerance
                || x > high[0] + tolerance
                || y < low[1] - tolerance
                || y > high[1] + tolerance;
            if beside || best.is_some_and(|z| z >= high[2]) {
                continue;
            }
            if node.right == 0 {
                for (corners, _) in &self.triangles[node.start as usize..node.end as usize] {
                    if let Some(z) = height_of_triangle([x, y], corners, tolerance) {
                        best = Some(best.map_or(z, |b| b.max(z)));
                    }
                }
                continue;
            }
            stack[top] = index + 1;
            stack[top + 1] = node.right;
            top += 2;
        }
        best
    }
}

/// Adds the node of these triangles, which start at `offset` of all, and those below it; gives its number.
fn split(triangles: &mut [([[f64; 3]; 3], u32)], offset: u32, nodes: &mut Vec<Node>) -> u32 {
    let bounds = triangles.iter().flat_map(|(t, _)| *t).fold(Bounds::EMPTY, Bounds::with);
    let index = nodes.len();
    let end = offset + triangles.len() as u32;
    nodes.push(Node { bounds, right: 0, start: offset, end });
    if triangles.len() > LEAF {
        let centers = triangles.iter().map(|(t, _)| center(t)).fold(Bounds::EMPTY, Bounds::with);
        let span = |k: usize| centers.high[k] - centers.low[k];
        let axis = (1..3).fold(0, |best, k| if span(k) > span(best) { k } else { best });
        let half = triangles.len() / 2;
        triangles.select_nth_unstable_by(half, |(s, i), (t, j)| {
            center(s)[axis].total_cmp(&center(t)[axis]).then(i.cmp(j))
        });
        let (left, right) = triangles.split_at_mut(half);
        split(left, offset, nodes);
        nodes[index].right = split(right, offset + half as u32, nodes);
    }
    index as u32
}

/// Three times the centroid.
fn center(t: &[[f64; 3]; 3]) -> [f64; 3] {
    std::array::from_fn(|k| t[0][k] + t[1][k] + t[2][k])
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn square(a: [f64; 3]) -> f64 {
    dot(a, a)
}

/// Closest point of a triangle by the regions of its corners, edges and inside (Ericson 2005, *Real-Time Collision Detection*,
/// §5.1.5).
fn closest_on_triangle(p: [f64; 3], &[a, b, c]: &[[f64; 3]; 3]) -> [f64; 3] {
    let (ab, ac) = (sub(b, a), sub(c, a));
    let along = |o: [f64; 3], d: [f64; 3], s: f64| std::array::from_fn(|k| o[k] + s * d[k]);
    let ap = sub(p, a);
    let (d1, d2) = (dot(ab, ap), dot(ac, ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bp = sub(p, b);
    let (d3, d4) = (dot(ab, bp), dot(ac, bp));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return along(a, ab, d1 / (d1 - d3));
    }
    let cp = sub(p, c);
    let (d5, d6) = (dot(ab, cp), dot(ac, cp));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return along(a, ac, d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return along(b, sub(c, b), (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let denominator = 1.0 / (va + vb + vc);
    let (v, w) = (vb * denominator, vc * denominator);
    std::array::from_fn(|k| a[k] + v * ab[k] + w * ac[k])
}

/// Height of a triangle's plane over a point of its plan, widened by `tolerance`; `None` outside and for vertical ones.
fn height_of_triangle([x, y]: [f64; 2], [a, b, c]: &[[f64; 3]; 3], tolerance: f64) -> Option<f64> {
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
    inside.then(|| (weights[0] * a[2] + weights[1] * b[2] + weights[2] * c[2]) / sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random;

    fn soup(count: usize) -> Vec<[[f64; 3]; 3]> {
        let mut rng = random::stream(5, 0, 0);
        let mut number = || random::unit(&mut rng);
        (0..count)
            .map(|_| {
                let o = [10.0 * number(), 10.0 * number(), number()];
                std::array::from_fn(|_| std::array::from_fn(|k| o[k] + number()))
            })
            .collect()
    }

    #[test]
    fn the_tree_finds_what_all_triangles_hold() {
        let triangles = soup(300);
        let tree = TriangleTree::new(&triangles).unwrap();
        let mut rng = random::stream(6, 0, 0);
        for _ in 0..500 {
            let p = std::array::from_fn(|_| 14.0 * random::unit(&mut rng) - 2.0);
            let all = triangles
                .iter()
                .map(|t| square(sub(closest_on_triangle(p, t), p)))
                .fold(f64::INFINITY, f64::min);
            let found = tree.closest(p);
            assert_eq!(found.distance2, all);
            let on = closest_on_triangle(found.point, &triangles[found.triangle as usize]);
            assert!(square(sub(on, found.point)) < 1e-20);
            let z =
                triangles.iter().filter_map(|t| height_of_triangle([p[0], p[1]], t, 0.0)).reduce(f64::max);
            assert_eq!(tree.highest(p[0], p[1], 0.0), z);
        }
    }

    /// No point of the triangle is closer than the closest one.
    #[test]
    fn closest_of_a_triangle_by_sampling() {
        let mut rng = random::stream(7, 0, 0);
        for t in soup(100) {
            let p: [f64; 3] = std::array::from_fn(|k| t[0][k] + 4.0 * random::unit(&mut rng) - 2.0);
            let found = square(sub(closest_on_triangle(p, &t), p));
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
