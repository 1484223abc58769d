//! How far apart the forms of several patterns with one boundary lie (docs/reference/geometry.md §5; paper, Figure 21).

use super::metrics::edge_lengths;
use super::pattern::Pattern;
use super::vector::Vec3;
use crate::surface::TriangleTree;

/// The two-sided distance between the surfaces of two patterns, m.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Deviation {
    /// Numbers of the two patterns.
    pub pair: [usize; 2],
    /// Mean over the vertices of both of their distance to the other surface.
    pub mean: f64,
    /// Largest of these distances.
    pub max: f64,
}

/// Deviations of all pairs of patterns that have panels. They are compared as surfaces, for vertices of different topologies have
/// no partners: each panel is taken as two triangles, and of them the closest point counts.
pub fn of_pairs(patterns: &[&Pattern]) -> Vec<Deviation> {
    let trees: Vec<Option<TriangleTree>> = patterns.iter().map(|pattern| tree(pattern)).collect();
    let mut deviations = Vec::new();
    for i in 0..patterns.len() {
        for j in i + 1..patterns.len() {
            let (Some(tree_i), Some(tree_j)) = (&trees[i], &trees[j]) else { continue };
            let to = |tree: &TriangleTree, p: &Vec3| tree.closest(*p).distance2.sqrt();
            let there = patterns[i].positions.iter().map(|p| to(tree_j, p));
            let back = patterns[j].positions.iter().map(|p| to(tree_i, p));
            let (mut sum, mut max, mut count) = (0.0, 0.0f64, 0.0);
            for distance in there.chain(back) {
                sum += distance;
                max = max.max(distance);
                count += 1.0;
            }
            deviations.push(Deviation { pair: [i, j], mean: sum / count, max });
        }
    }
    deviations
}

/// Mean length of all edges of all patterns: the unit in which the paper gives deviations, m. `None` without an edge.
pub fn mean_edge(patterns: &[&Pattern]) -> Option<f64> {
    let lengths: Vec<f64> = patterns.iter().flat_map(|pattern| edge_lengths(pattern)).collect();
    (!lengths.is_empty()).then(|| lengths.iter().sum::<f64>() / lengths.len() as f64)
}

fn tree(pattern: &Pattern) -> Option<TriangleTree> {
    let mut triangles = Vec::with_capacity(2 * pattern.panels.len());
    for panel in &pattern.panels {
        let [a, b, c, d] = panel.as_quad().map(|v| pattern.positions[v as usize]);
        triangles.push([a, b, c]);
        if !panel.is_triangle() {
            triangles.push([a, c, d]);
        }
    }
    TriangleTree::new(&triangles)
}
