//! The upper skin of a mesh: what is seen of it from above. Faces below others (the soffit of a solid, a lower layer) and walls
//! carry no pattern, and so the winding of faces, which says what is inside and outside, does not count.

use super::tree::{Closest, Over, TriangleTree};
use super::triangle::{Triangle, angle_at, dot, is_steep, is_vertical, overlap, square, sub, vector_area};

/// Nearer than this share of the size, a point is on an edge or in a corner.
const EDGE: f64 = 1e-9;
/// Exporters round to millimetres (docs/reference/files.md §4): nearer than this share of the size, faces touch, and layers are one.
const ROUNDING: f64 = 1e-4;

/// Times the rounding that layers must be apart, so that a slit in the upper one is told from a bend.
const SLIT: f64 = 10.0;

/// How much of a triangle may be seen from above.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Seen {
    /// All of it.
    All,
    /// Not all of it, but its middle.
    Middle,
    /// Not its middle.
    NotMiddle,
}

/// The triangles of a mesh with several layers.
#[derive(Clone, Debug)]
struct Layers {
    /// Those that are seen from above altogether.
    clear: Option<TriangleTree>,
    /// Those that are below others, at least in part.
    covered: TriangleTree,
}

/// The upper skin. It depends on the set of triangles alone: not on their order, nor on that of their corners.
#[derive(Clone, Debug)]
pub struct Skin {
    /// All triangles.
    tree: TriangleTree,
    /// Where some lie below others: those that do not, and those that do.
    layers: Option<Layers>,
    triangles: Vec<Triangle>,
    /// Unit normal of each triangle, upwards.
    normals: Vec<[f64; 3]>,
    seen: Vec<Seen>,
    /// Smallest and largest x and y, m.
    pub bounds: [[f64; 2]; 2],
    edge: f64,
    rounding: f64,
}

impl Skin {
    /// The skin of these triangles; those without area do not count, and vertical ones only where there is nothing else. `None` if none is
    /// left.
    pub fn new(triangles: impl Iterator<Item = Triangle>) -> Option<Self> {
        let has_area = |t: &Triangle| square(vector_area(t)) > 0.0;
        let mut triangles: Vec<Triangle> = triangles.filter(has_area).map(sorted).collect();
        triangles.sort_unstable_by(|s, t| {
            let pairs = s.iter().flatten().zip(t.iter().flatten());
            pairs.map(|(a, b)| a.total_cmp(b)).find(|o| o.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
        });
        triangles.dedup();
        let size = size(plan_bounds(&triangles));
        let (edge, rounding) = (EDGE * size, ROUNDING * size);
        if !triangles.iter().all(is_vertical) {
            triangles.retain(|t| !is_vertical(t));
        }
        let normals = triangles.iter().map(upward).collect();
        let tree = TriangleTree::new(&triangles)?;
        let seen = vec![Seen::All; triangles.len()];
        let bounds = plan_bounds(&triangles);
        let mut skin = Self { tree, layers: None, triangles, normals, seen, bounds, edge, rounding };
        skin.look_from_above();
        Some(skin)
    }

    /// Finds the triangles that lie below others.
    fn look_from_above(&mut self) {
        let numbers = 0..self.triangles.len() as u32;
        let (covered, clear): (Vec<u32>, Vec<u32>) = numbers.partition(|&i| self.is_covered(i));
        if covered.is_empty() {
            return;
        }
        let tree = |numbers: &[u32]| {
            TriangleTree::of(numbers.iter().map(|&i| (self.triangles[i as usize], i)).collect())
        };
        self.layers =
            Some(Layers { clear: (!clear.is_empty()).then(|| tree(&clear)), covered: tree(&covered) });
        for &i in &covered {
            self.seen[i as usize] = Seen::NotMiddle;
        }
        let middle = |&i: &u32| {
            let [a, b, c] = self.triangles[i as usize];
            std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0)
        };
        let is_seen: Vec<bool> = covered.iter().map(|i| !self.is_below(middle(i))).collect();
        for (&i, _) in covered.iter().zip(is_seen).filter(|(_, is_seen)| *is_seen) {
            self.seen[i as usize] = Seen::Middle;
        }
    }

    /// Whether something may lie above some part of this triangle.
    fn is_covered(&self, i: u32) -> bool {
        let t = &self.triangles[i as usize];
        if is_steep(t, self.rounding) {
            // Of a wall only the upper edge is seen, of the rim of a dome all: each point tells.
            return true;
        }
        let bounds = plan_bounds(std::slice::from_ref(t));
        let lowest = t.iter().fold(f64::INFINITY, |z, p| z.min(p[2])) + self.rounding;
        self.tree.any_near(bounds, lowest, 0.0, |other, j| {
            j != i
                && other.iter().any(|&p| self.height_off(p, i) > self.rounding)
                && t.iter().any(|&p| self.height_off(p, j) < -self.rounding)
                && overlap(t, other, self.rounding)
        })
    }

    /// Height over (x, y), of the uppermost layer.
    pub fn height(&self, x: f64, y: f64) -> Option<f64> {
        // Edges belong to the faces at them, else a point exactly on one falls through; farther off, a neighbour must not lift it.
        let near = self.tree.highest(x, y, self.edge);
        if near.is_some() && self.layers.is_none() {
            return near.map(|n| n.point[2]);
        }
        let wide = self.tree.highest(x, y, self.rounding);
        let best = match (near, wide) {
            (Some(n), Some(w)) if self.is_slit(n, w) => w,
            (Some(n), _) => n,
            (None, w) => w?,
        };
        Some(best.point[2])
    }

    /// How far a point is above the plane of a triangle, along its normal.
    fn height_off(&self, p: [f64; 3], triangle: u32) -> f64 {
        dot(sub(p, self.triangles[triangle as usize][0]), self.normals[triangle as usize])
    }

    /// Whether the point found near by is one of a lower layer, seen through a slit between faces of the upper one: what is found
    /// farther off lies apart from it, and not because it is steep there.
    fn is_slit(&self, near: Over, wide: Over) -> bool {
        let is_off = |p, triangle| self.height_off(p, triangle).abs() > SLIT * self.rounding;
        self.seen[near.triangle as usize] == Seen::NotMiddle
            && is_off(wide.point, near.triangle)
            && is_off(near.point, wide.triangle)
    }

    /// Whether the skin lies above a point.
    fn is_below(&self, [x, y, z]: [f64; 3]) -> bool {
        self.height(x, y).is_some_and(|height| height > z + self.rounding)
    }

    /// The closest point that is seen from above.
    pub fn closest(&self, p: [f64; 3]) -> Closest {
        let Some(Layers { clear, covered }) = &self.layers else { return self.tree.closest(p) };
        let none = Closest { point: p, triangle: 0, distance2: f64::INFINITY, is_inner: false };
        let best = clear.as_ref().map_or(none, |clear| clear.closest(p));
        let best = covered.closer(p, best, |point| !self.is_below(point));
        if best.distance2 < f64::INFINITY {
            return best;
        }
        // Of every triangle the closest point is below another: up from the nearest.
        let below = self.tree.closest(p);
        let above = self.tree.highest(below.point[0], below.point[1], self.rounding);
        above.map_or(below, |Over { point, triangle }| Closest {
            point,
            triangle,
            distance2: square(sub(point, p)),
            is_inner: false,
        })
    }

    /// Unit normal at a closest point, upwards. On an edge and in a corner it is the mean of those of the faces
    /// there, weighted by their angles (Bærentzen, Aanæs 2005, *Signed distance computation using the angle weighted pseudonormal*):
    /// with that of one face alone, a vertex on a ridge is drawn off to that side.
    pub fn normal(&self, &Closest { point, triangle, is_inner, .. }: &Closest) -> [f64; 3] {
        let own = self.normals[triangle as usize];
        if is_inner {
            return own;
        }
        let mut around = Vec::new();
        let [x, y, z] = point;
        self.tree.any_near([[x, y]; 2], z - self.edge, self.edge, |corners, i| {
            if self.seen[i as usize] != Seen::NotMiddle
                && let Some(angle) = angle_at(corners, point, self.edge)
            {
                around.push((i, angle));
            }
            false
        });
        around.sort_unstable_by_key(|&(i, _)| i);
        let mut sum = [0.0; 3];
        for (i, angle) in around {
            let n = self.normals[i as usize];
            sum = std::array::from_fn(|k| sum[k] + angle * n[k]);
        }
        let length = square(sum).sqrt();
        if length > 0.0 { sum.map(|v| v / length) } else { own }
    }
}

/// A triangle with its corners in order of x, y, z.
fn sorted(mut t: Triangle) -> Triangle {
    // −0 is 0.
    t.iter_mut().flatten().for_each(|x| *x += 0.0);
    t.sort_by(|p, q| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])).then(p[2].total_cmp(&q[2])));
    t
}

/// Unit normal of a triangle, upwards.
fn upward(t: &Triangle) -> [f64; 3] {
    let n = vector_area(t);
    let length = square(n).sqrt();
    let sign = if n[2] < 0.0 { -length } else { length };
    n.map(|v| v / sign)
}

/// Smallest and largest x and y.
fn plan_bounds(triangles: &[Triangle]) -> [[f64; 2]; 2] {
    let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for p in triangles.iter().flatten() {
        for k in 0..2 {
            bounds[0][k] = bounds[0][k].min(p[k]);
            bounds[1][k] = bounds[1][k].max(p[k]);
        }
    }
    bounds
}

/// Diagonal of a box in plan.
fn size([low, high]: [[f64; 2]; 2]) -> f64 {
    (high[0] - low[0]).hypot(high[1] - low[1])
}
