//! A tree of boxes over triangles: the closest point, and the height over a point of the plan.

use super::triangle::{Triangle, closest_on_triangle, over_triangle, square, sub};

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
    /// Whether the point is clearly within the triangle, away from its edges.
    pub is_inner: bool,
}

/// A point over a point of the plan, m, and its triangle.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Over {
    /// The point of the triangle; beside the point of the plan by no more than the tolerance.
    pub point: [f64; 3],
    /// Number of the triangle.
    pub triangle: u32,
}

/// The corners of a triangle and its number.
pub(super) type Corners = (Triangle, u32);

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

    /// Whether it is farther than `tolerance` from a box in plan.
    #[inline]
    fn is_beside(&self, [low, high]: [[f64; 2]; 2], tolerance: f64) -> bool {
        high[0] < self.low[0] - tolerance
            || low[0] > self.high[0] + tolerance
            || high[1] < self.low[1] - tolerance
            || low[1] > self.high[1] + tolerance
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
    triangles: Vec<Corners>,
}

impl TriangleTree {
    /// Builds the tree; `None` without triangles.
    pub fn new(triangles: &[Triangle]) -> Option<Self> {
        if triangles.is_empty() {
            return None;
        }
        Some(Self::of(triangles.iter().zip(0u32..).map(|(&t, i)| (t, i)).collect()))
    }

    /// Builds the tree of triangles with their numbers, at least one.
    pub(super) fn of(mut triangles: Vec<Corners>) -> Self {
        let mut nodes = Vec::with_capacity(2 * triangles.len() / LEAF + 1);
        split(&mut triangles, 0, &mut nodes);
        Self { nodes, triangles }
    }

    /// The point of all triangles that is closest to `p`. Of equally close triangles, the one found first.
    pub fn closest(&self, p: [f64; 3]) -> Closest {
        let none = Closest { point: p, triangle: 0, distance2: f64::INFINITY, is_inner: false };
        self.closer(p, none, |_| true)
    }

    /// The closest point to `p` that is closer than `best` and allowed by `holds`; else `best`. Of a triangle no other point than
    /// its closest is asked for.
    #[inline]
    pub(super) fn closer(&self, p: [f64; 3], mut best: Closest, holds: impl Fn([f64; 3]) -> bool) -> Closest {
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
                for &(ref corners, triangle) in self.leaf(node) {
                    let (point, is_inner) = closest_on_triangle(p, corners);
                    let distance2 = square(sub(point, p));
                    if distance2 < best.distance2 && holds(point) {
                        best = Closest { point, triangle, distance2, is_inner };
                    }
                }
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

    fn leaf(&self, node: &Node) -> &[Corners] {
        &self.triangles[node.start as usize..node.end as usize]
    }

    /// The highest point over (x, y); triangles reach `tolerance` beyond their edges in plan.
    pub fn highest(&self, x: f64, y: f64, tolerance: f64) -> Option<Over> {
        let mut best: Option<Over> = None;
        let (mut stack, mut top) = ([0u32; 64], 1);
        while top > 0 {
            top -= 1;
            let index = stack[top];
            let node = &self.nodes[index as usize];
            let beside = node.bounds.is_beside([[x, y]; 2], tolerance);
            if beside || best.is_some_and(|b| b.point[2] >= node.bounds.high[2]) {
                continue;
            }
            if node.right == 0 {
                for (corners, triangle) in self.leaf(node) {
                    if let Some(point) = over_triangle([x, y], corners, tolerance)
                        && best.is_none_or(|b| point[2] > b.point[2])
                    {
                        best = Some(Over { point, triangle: *triangle });
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

    /// Whether `found` holds for some triangle in a leaf whose box comes within `tolerance` of a box in plan and reaches above
    /// `lowest`.
    pub fn any_near(
        &self,
        plan: [[f64; 2]; 2],
        lowest: f64,
        tolerance: f64,
        mut found: impl FnMut(&Triangle, u32) -> bool,
    ) -> bool {
        let (mut stack, mut top) = ([0u32; 64], 1);
        while top > 0 {
            top -= 1;
            let index = stack[top];
            let node = &self.nodes[index as usize];
            if node.bounds.is_beside(plan, tolerance) || node.bounds.high[2] < lowest {
                continue;
            }
            if node.right == 0 {
                if self.leaf(node).iter().any(|(corners, triangle)| found(corners, *triangle)) {
                    return true;
                }
                continue;
            }
            stack[top] = index + 1;
            stack[top + 1] = node.right;
            top += 2;
        }
        false
    }
}

/// Adds the node of these triangles, which start at `offset` of all, and those below it; gives its number.
fn split(triangles: &mut [Corners], offset: u32, nodes: &mut Vec<Node>) -> u32 {
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
fn center(t: &Triangle) -> [f64; 3] {
    std::array::from_fn(|k| t[0][k] + t[1][k] + t[2][k])
}

#[cfg(test)]
mod tests {
    use super::super::triangle::tests::soup;
    use super::*;
    use crate::random;

    #[test]
    fn the_tree_finds_what_all_triangles_hold() {
        let triangles = soup(300);
        let tree = TriangleTree::new(&triangles).unwrap();
        let mut rng = random::stream(6, 0, 0);
        for _ in 0..500 {
            let p = std::array::from_fn(|_| 14.0 * random::unit(&mut rng) - 2.0);
            let all = triangles
                .iter()
                .map(|t| square(sub(closest_on_triangle(p, t).0, p)))
                .fold(f64::INFINITY, f64::min);
            let found = tree.closest(p);
            assert_eq!(found.distance2, all);
            let (on, _) = closest_on_triangle(found.point, &triangles[found.triangle as usize]);
            assert!(square(sub(on, found.point)) < 1e-20);
            let z = triangles
                .iter()
                .filter_map(|t| over_triangle([p[0], p[1]], t, 0.0))
                .map(|q| q[2])
                .reduce(f64::max);
            assert_eq!(tree.highest(p[0], p[1], 0.0).map(|over| over.point[2]), z);
        }
    }
}
