//! Which nodes of a pattern the support rules of a config hold.

use super::AnalysisError;
use crate::geometry::pattern::Pattern;
use crate::structure::model::Support;
use crate::structure::params::{SupportNodes, SupportParams, SupportPlace};

/// A node found near a point of the config.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundNode {
    /// Key of the point, below `[structure]`.
    pub key: String,
    /// The point in plan, m.
    pub point: [f64; 2],
    /// The node.
    pub node: u32,
    /// Its distance from the point in plan, m.
    pub distance: f64,
}

/// The supports of a pattern, rule by rule, and which nodes points inside the roof have found.
pub fn supports(
    pattern: &Pattern,
    rules: &[SupportParams],
) -> Result<(Vec<Support>, Vec<FoundNode>), AnalysisError> {
    let mut supports = Vec::new();
    let mut found = Vec::new();
    for (i, rule) in rules.iter().enumerate() {
        let (fixed, stiffness) = rule.holds();
        for (name, named) in rule.nodes() {
            let nodes = if let SupportNodes::InsideNear(points) = named {
                let inside = columns(pattern, points, &format!("support[{i}].{name}"))?;
                found.extend(inside.iter().cloned());
                inside.iter().map(|column| column.node).collect()
            } else {
                nodes(pattern, named)?
            };
            supports.extend(nodes.into_iter().map(|node| Support { node, fixed, stiffness }));
        }
    }
    Ok((supports, found))
}

/// The nodes inside closest to points.
fn columns(pattern: &Pattern, points: &[[f64; 2]], key: &str) -> Result<Vec<FoundNode>, AnalysisError> {
    let mut is_inside = vec![true; pattern.positions.len()];
    pattern.loops.iter().flatten().for_each(|&v| is_inside[v as usize] = false);
    let limit = 0.5 * pattern.target_length;
    let mut all = Vec::new();
    for (k, &point) in points.iter().enumerate() {
        let key = format!("{key}[{k}]");
        let found = nearest(pattern, &key, point, |v| is_inside[v as usize]);
        match found.first() {
            Some(column) if column.distance <= limit => all.extend(found),
            Some(column) => {
                return Err(AnalysisError::NoColumn { key, point, distance: column.distance, limit });
            }
            None => return Err(AnalysisError::NoColumn { key, point, distance: f64::INFINITY, limit }),
        }
    }
    Ok(all)
}

/// The node closest to a point in plan, of those that are `wanted`; of equally close ones all, so that what is symmetric
/// stays so.
pub fn nearest(
    pattern: &Pattern,
    key: &str,
    point: [f64; 2],
    wanted: impl Fn(u32) -> bool,
) -> Vec<FoundNode> {
    let distance = |v: u32| squared(sub(plan(pattern, v), point)).sqrt();
    let nodes = || (0..pattern.positions.len() as u32).filter(|&v| wanted(v));
    let least = nodes().map(distance).fold(f64::INFINITY, f64::min);
    let found = nodes().filter(|&v| distance(v) <= least + EQUAL * pattern.target_length);
    found.map(|node| FoundNode { key: key.to_owned(), point, node, distance: distance(node) }).collect()
}

/// Share of the target length by which distances may differ and be equal.
const EQUAL: f64 = 1e-6;

fn nodes(pattern: &Pattern, named: SupportNodes<'_>) -> Result<Vec<u32>, AnalysisError> {
    Ok(match named {
        SupportNodes::Place(SupportPlace::Boundary) => pattern.loops.iter().flatten().copied().collect(),
        SupportNodes::Place(SupportPlace::Corners) => outer_corners(pattern).to_vec(),
        SupportNodes::Place(SupportPlace::All) => (0..pattern.positions.len() as u32).collect(),
        SupportNodes::Loop(k) => match pattern.loops.get(k) {
            Some(vertices) => vertices.clone(),
            None => return Err(AnalysisError::NoSuchLoop { index: k, loops: pattern.loops.len() }),
        },
        // Found with their distances, by `columns`.
        SupportNodes::InsideNear(_) => Vec::new(),
        SupportNodes::NodesNear(points) => points.iter().filter_map(|&p| closest_node(pattern, p)).collect(),
        SupportNodes::SidesNear(points) => {
            let sides = sides(pattern);
            points.iter().filter_map(|&p| closest_side(pattern, &sides, p)).flatten().copied().collect()
        }
    })
}

/// The vertices at the corners of loop 0.
pub(super) fn outer_corners(pattern: &Pattern) -> &[u32] {
    pattern.loop_corners.first().and_then(|range| pattern.corners.get(range.clone())).unwrap_or(&[])
}

/// The boundary node closest to a point in plan; of equally close ones the first along the loops.
fn closest_node(pattern: &Pattern, point: [f64; 2]) -> Option<u32> {
    let nodes = pattern.loops.iter().flatten().copied();
    nodes.min_by(|&a, &b| {
        let distance = |v| squared(sub(plan(pattern, v), point));
        distance(a).total_cmp(&distance(b))
    })
}

/// The nodes of every side, from corner to corner; a loop with fewer than two corners is one side, closed.
fn sides(pattern: &Pattern) -> Vec<Vec<u32>> {
    let mut sides = Vec::new();
    for (k, nodes) in pattern.loops.iter().enumerate() {
        let corners = pattern.loop_corners.get(k).and_then(|range| pattern.corners.get(range.clone()));
        let mut cuts: Vec<usize> =
            corners.unwrap_or(&[]).iter().filter_map(|c| nodes.iter().position(|v| v == c)).collect();
        cuts.sort_unstable();
        cuts.dedup();
        if cuts.len() < 2 {
            sides.push(nodes.iter().chain(nodes.first()).copied().collect());
            continue;
        }
        for (i, &from) in cuts.iter().enumerate() {
            let to = cuts.get(i + 1).copied().unwrap_or(cuts[0] + nodes.len());
            sides.push((from..=to).map(|n| nodes[n % nodes.len()]).collect());
        }
    }
    sides
}

/// The side that passes a point in plan most closely. A config is refused where this is not plain (`study`).
fn closest_side<'a>(pattern: &Pattern, sides: &'a [Vec<u32>], point: [f64; 2]) -> Option<&'a [u32]> {
    let distance = |side: &Vec<u32>| {
        let edges = side.windows(2).map(|e| to_segment(point, plan(pattern, e[0]), plan(pattern, e[1])));
        edges.fold(f64::INFINITY, f64::min)
    };
    sides.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).map(Vec::as_slice)
}

fn plan(pattern: &Pattern, vertex: u32) -> [f64; 2] {
    let [x, y, _] = pattern.positions[vertex as usize];
    [x, y]
}

fn sub(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn squared(v: [f64; 2]) -> f64 {
    v[0] * v[0] + v[1] * v[1]
}

/// Squared distance of a point from a segment.
fn to_segment(point: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (ab, ap) = (sub(b, a), sub(point, a));
    let length = squared(ab);
    let share = if length > 0.0 { ((ap[0] * ab[0] + ap[1] * ab[1]) / length).clamp(0.0, 1.0) } else { 0.0 };
    squared([ap[0] - share * ab[0], ap[1] - share * ab[1]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::pattern::Panel;

    /// A strip of two panels along x, 2 m × 1 m; `corners` of its only loop.
    fn strip(corners: Vec<u32>) -> Pattern {
        Pattern {
            positions: (0..6).map(|v| [f64::from(v % 3), f64::from(v / 3), 5.0]).collect(),
            panels: vec![Panel::quad([0, 1, 4, 3]), Panel::quad([1, 2, 5, 4])],
            edges: vec![[0, 1], [0, 3], [1, 2], [1, 4], [2, 5], [3, 4], [4, 5]],
            loops: vec![vec![0, 1, 2, 5, 4, 3]],
            along: Vec::new(),
            loop_corners: std::iter::once(0..corners.len()).collect(),
            corners,
            coarse: Vec::new(),
            coarse_face: vec![0, 0],
            target_length: 1.0,
        }
    }

    fn held(pattern: &Pattern, named: SupportNodes<'_>) -> Vec<u32> {
        nodes(pattern, named).unwrap_or_default()
    }

    #[test]
    fn near_nodes_and_sides() {
        let pattern = strip(vec![0, 2, 5, 3]);
        assert_eq!(held(&pattern, SupportNodes::NodesNear(&[[1.9, 0.2], [0.9, 1.4]])), [2, 4]);
        assert_eq!(held(&pattern, SupportNodes::SidesNear(&[[0.7, 0.1]])), [0, 1, 2]);
        // The last side of the loop ends in its first node.
        assert_eq!(held(&pattern, SupportNodes::SidesNear(&[[-0.1, 0.5], [2.0, 0.5]])), [3, 0, 2, 5]);
    }

    #[test]
    fn a_loop_without_two_corners_is_one_side() {
        for corners in [vec![], vec![2]] {
            let mut all = held(&strip(corners), SupportNodes::SidesNear(&[[1.0, -1.0]]));
            all.sort_unstable();
            all.dedup();
            assert_eq!(all, [0, 1, 2, 3, 4, 5]);
        }
    }
}
