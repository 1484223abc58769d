//! How many different members, panels and nodes a pattern has: what repeats is made once (docs/reference/geometry.md §3).
//!
//! A piece is a few points in cyclic order, and its shape the distances between them: a member its two ends, a panel its corners, a node the
//! points one metre along its members. Two pieces are the same where, turned or mirrored, no distance differs by more than the tolerance.
//! In the order of their sizes each piece is counted as a new shape unless it is the same as one that was counted, so that the count depends
//! neither on the order of the pattern nor on where it lies, and a long row of gradually growing pieces is not taken for one.

use super::pattern::{Panel, Pattern};
use super::vector::{Vec3, distance, norm, scale, sub};

/// Numbers of different pieces.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Distinct {
    /// Members of different length.
    pub members: usize,
    /// Panels of different shape.
    pub panels: usize,
    /// Nodes at which members meet under different angles.
    pub nodes: usize,
}

impl Distinct {
    /// Counts the pieces of a pattern that differ by more than a tolerance, m.
    pub fn of(pattern: &Pattern, tolerance: f64) -> Self {
        let at = |v: u32| pattern.positions[v as usize];
        let members = pattern.edges.iter().map(|&[u, v]| Shape::of(&[at(u), at(v)], true));
        let corners = |panel: &Panel| -> Vec<Vec3> { panel.corners().iter().map(|&v| at(v)).collect() };
        let panels = pattern.panels.iter().map(|panel| Shape::of(&corners(panel), true));
        let nodes = stars(pattern).into_iter().enumerate().map(|(v, (ends, is_closed))| {
            let arm = |&end: &u32| {
                let along = sub(at(end), pattern.positions[v]);
                scale(along, 1.0 / norm(along).max(f64::MIN_POSITIVE))
            };
            Shape::of(&ends.iter().map(arm).collect::<Vec<_>>(), is_closed)
        });
        Self {
            members: count(members.collect(), tolerance),
            panels: count(panels.collect(), tolerance),
            nodes: count(nodes.collect(), tolerance),
        }
    }
}

/// Points in cyclic order, as their mutual distances.
struct Shape {
    /// How many points.
    count: usize,
    /// Whether the order closes: the last is followed by the first.
    is_closed: bool,
    /// From each point (row) to each other, m.
    distances: Vec<f64>,
    /// Those of every pair once, ascending.
    sorted: Vec<f64>,
    /// Their sum.
    size: f64,
}

impl Shape {
    fn of(points: &[Vec3], is_closed: bool) -> Self {
        let count = points.len();
        let distances: Vec<f64> =
            points.iter().flat_map(|&p| points.iter().map(move |&q| distance(p, q))).collect();
        let pairs = (0..count).flat_map(|i| (0..i).map(move |j| i * count + j));
        let mut sorted: Vec<f64> = pairs.map(|pair| distances[pair]).collect();
        sorted.sort_by(f64::total_cmp);
        let size = sorted.iter().sum();
        Self { count, is_closed, distances, sorted, size }
    }

    /// Whether another, turned or mirrored as it fits, has the same distances.
    fn is_like(&self, other: &Self, tolerance: f64) -> bool {
        let near = |(a, b): (&f64, &f64)| (a - b).abs() <= tolerance;
        (self.count, self.is_closed) == (other.count, other.is_closed)
            && self.sorted.iter().zip(&other.sorted).all(near)
            && (0..if self.is_closed { self.count } else { 1 })
                .any(|turn| [false, true].into_iter().any(|mirror| self.fits(other, turn, mirror, tolerance)))
    }

    fn fits(&self, other: &Self, turn: usize, mirror: bool, tolerance: f64) -> bool {
        let n = self.count;
        let place = |i: usize| (turn + if mirror { n - 1 - i } else { i }) % n;
        let near = |i: usize, j: usize| {
            (self.distances[i * n + j] - other.distances[place(i) * n + place(j)]).abs() <= tolerance
        };
        (0..n).all(|i| (0..i).all(|j| near(i, j)))
    }
}

/// How many shapes there are, those within the tolerance of one that was counted left out.
fn count(mut shapes: Vec<Shape>, tolerance: f64) -> usize {
    let by_distances = |a: &Shape, b: &Shape| {
        a.sorted.iter().zip(&b.sorted).map(|(x, y)| x.total_cmp(y)).find(|o| o.is_ne())
    };
    shapes.sort_by(|a, b| {
        let by_kind = (a.count, a.is_closed).cmp(&(b.count, b.is_closed)).then(a.size.total_cmp(&b.size));
        by_kind.then_with(|| by_distances(a, b).unwrap_or(std::cmp::Ordering::Equal))
    });
    let mut counted: Vec<&Shape> = Vec::new();
    for shape in &shapes {
        // What differs in no distance by more than the tolerance does not differ by more in their sum.
        let least = shape.size - tolerance * shape.sorted.len() as f64;
        let near = counted.iter().rev().take_while(|known| known.count == shape.count && known.size >= least);
        if !near.clone().any(|known| known.is_like(shape, tolerance)) {
            counted.push(shape);
        }
    }
    counted.len()
}

/// The neighbours of each vertex in their order around it, and whether that order closes.
fn stars(pattern: &Pattern) -> Vec<(Vec<u32>, bool)> {
    // From each neighbour to the next, counter-clockwise: the two are sides of one panel.
    let mut steps: Vec<Vec<(u32, u32)>> = vec![Vec::new(); pattern.positions.len()];
    for panel in &pattern.panels {
        let corners = panel.corners();
        let n = corners.len();
        for (i, &v) in corners.iter().enumerate() {
            steps[v as usize].push((corners[(i + 1) % n], corners[(i + n - 1) % n]));
        }
    }
    steps.iter().map(|steps| in_order(steps)).collect()
}

fn in_order(steps: &[(u32, u32)]) -> (Vec<u32>, bool) {
    let has_no_step_to = |from: &&(u32, u32)| steps.iter().all(|(_, to)| *to != from.0);
    let start = steps.iter().find(has_no_step_to);
    let Some(&(first, _)) = start.or(steps.first()) else { return (Vec::new(), true) };
    let mut ends = vec![first];
    while let Some(&(_, next)) = steps.iter().find(|(from, _)| Some(from) == ends.last()) {
        if next == first || ends.len() > steps.len() {
            break;
        }
        ends.push(next);
    }
    (ends, start.is_none())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pattern of quads; edges are the sides, once each.
    fn pattern(positions: Vec<Vec3>, quads: &[[u32; 4]]) -> Pattern {
        let sides = quads.iter().flat_map(|q| (0..4).map(|i| [q[i], q[(i + 1) % 4]]));
        let mut edges: Vec<[u32; 2]> = sides.map(|[a, b]| [a.min(b), a.max(b)]).collect();
        edges.sort_unstable();
        edges.dedup();
        Pattern {
            positions,
            panels: quads.iter().map(|&q| Panel::quad(q)).collect(),
            edges,
            loops: vec![],
            along: vec![],
            corners: vec![],
            loop_corners: vec![],
            coarse: vec![],
            coarse_face: vec![0; quads.len()],
            target_length: 1.0,
        }
    }

    /// Columns of the widths 1, 2, 2.004, 2.008 m, one row of 1 m:
    ///
    /// ```text
    /// 5-6---7---8---9
    /// | |   |   |   |     lengths 1; 2, 2.004 and 2.008: within 5 mm of the first the second, not the third
    /// 0-1---2---3---4
    /// ```
    fn row(order: [u32; 10]) -> Pattern {
        let xs = [0.0, 1.0, 3.0, 5.004, 7.012];
        let mut positions = vec![[0.0; 3]; 10];
        for (i, &name) in order.iter().enumerate() {
            positions[name as usize] = [xs[i % 5], if i < 5 { 0.0 } else { 1.0 }, 0.0];
        }
        let quads: Vec<[u32; 4]> = (0..4).map(|k| [k, k + 1, k + 6, k + 5].map(|v| order[v])).collect();
        pattern(positions, &quads)
    }

    #[test]
    fn what_lies_within_the_tolerance_is_one_and_a_chain_is_not() {
        let found = Distinct::of(&row([0, 1, 2, 3, 4, 5, 6, 7, 8, 9]), 0.005);
        // Members 1; 2 and 2.004; 2.008. Panels 1 × 1; 2 × 1 and 2.004 × 1; 2.008 × 1. Nodes: corners; those between.
        assert_eq!(found, Distinct { members: 3, panels: 3, nodes: 2 });
        let same = Distinct::of(&row([7, 2, 9, 4, 0, 1, 8, 3, 5, 6]), 0.005);
        assert_eq!(same, found, "the numbers of the nodes do not matter");
        assert_eq!(Distinct::of(&row([0, 1, 2, 3, 4, 5, 6, 7, 8, 9]), 0.001).members, 4);
        assert_eq!(Distinct::of(&row([0, 1, 2, 3, 4, 5, 6, 7, 8, 9]), 0.009).members, 2);
    }

    /// A kite-like quad and its mirror image share the side on the axis x = 0.
    #[test]
    fn mirror_images_are_one() {
        let half = [[0.0, 0.0, 0.0], [1.0, 0.1, 0.3], [1.2, 1.4, 0.1], [0.0, 1.1, 0.0]];
        let image = |[x, y, z]: Vec3| [-x, y, z];
        let positions = vec![half[0], half[1], half[2], half[3], image(half[1]), image(half[2])];
        let found = Distinct::of(&pattern(positions, &[[0, 1, 2, 3], [0, 3, 5, 4]]), 1e-9);
        assert_eq!(found, Distinct { members: 4, panels: 1, nodes: 4 });
    }

    #[test]
    fn nodes_are_told_by_angles_not_by_lengths() {
        // A 2 × 2 grid of squares, and the same stretched: the angles stay.
        let grid = |dx: f64| {
            let positions = (0..9).map(|v| [dx * f64::from(v % 3), f64::from(v / 3), 0.0]).collect();
            pattern(positions, &[[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]])
        };
        assert_eq!(Distinct::of(&grid(1.0), 0.005), Distinct { members: 1, panels: 1, nodes: 3 });
        assert_eq!(Distinct::of(&grid(1.5), 0.005), Distinct { members: 2, panels: 1, nodes: 3 });
        let mut lifted = grid(1.0);
        lifted.positions[4][2] = 0.1;
        assert_eq!(Distinct::of(&lifted, 0.005).nodes, 3, "one of four, four of three, four of two members");
        lifted.positions[0][2] = 0.1;
        assert!(Distinct::of(&lifted, 0.005).nodes > 3);
    }
}
