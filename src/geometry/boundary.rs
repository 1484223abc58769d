//! Where the dense boundary vertices stand along their curves (docs/reference/geometry.md §0.2, §2.1).

use super::coarse::Coarse;
use super::corners::LoopCorners;
use super::dense::Dense;
use super::pattern::Panel;
use super::rejection::Rejection;
use crate::domain::Domain;

/// The dense vertices of one boundary loop along its curve.
#[derive(Clone, PartialEq, Debug)]
pub struct BoundaryLoop {
    /// The loop's vertices, counter-clockwise, the first of them an anchor if there is one.
    pub vertices: Vec<u32>,
    /// Position in `vertices` and arc length of each vertex that takes a corner or the mark, ascending; the arc lengths
    /// go on beyond the loop's length where the loop closes.
    pub anchors: Vec<(usize, f64)>,
    /// The dense vertex that takes each corner, in the order of the corners.
    pub corners: Vec<u32>,
    /// Whether its corners are kinks; false for the mark.
    pub is_sharp: bool,
    /// Length of the curve, m.
    pub length: f64,
}

/// For each of `count` vertices, whether it is one of a boundary's.
pub fn marked<'a>(count: usize, boundary: impl Iterator<Item = &'a u32>) -> Vec<bool> {
    let mut on_boundary = vec![false; count];
    boundary.for_each(|&v| on_boundary[v as usize] = true);
    on_boundary
}

/// Inner vertices of panels that touch the boundary, ascending: only these can leave the domain without a corner turning over.
pub fn beside(panels: &[Panel], on_boundary: &[bool]) -> Vec<u32> {
    let mut is_beside = vec![false; on_boundary.len()];
    for panel in panels.iter().map(Panel::corners) {
        if panel.iter().any(|&v| on_boundary[v as usize]) {
            for &v in panel {
                is_beside[v as usize] = !on_boundary[v as usize];
            }
        }
    }
    (0..is_beside.len() as u32).filter(|&v| is_beside[v as usize]).collect()
}

/// Finds the dense vertex of every corner, also of those that no coarse vertex took.
///
/// # Errors
/// [`Rejection::CornerLost`] where a stretch has too few vertices for its corners.
pub fn anchor(
    coarse: &Coarse<'_>,
    dense: &Dense,
    domain: &Domain,
    corners: &[LoopCorners],
) -> Result<Vec<BoundaryLoop>, Rejection> {
    (0..corners.len()).map(|k| anchor_loop(coarse, dense, domain, &corners[k], k)).collect()
}

fn anchor_loop(
    coarse: &Coarse<'_>,
    dense: &Dense,
    domain: &Domain,
    corners: &LoopCorners,
    label: usize,
) -> Result<BoundaryLoop, Rejection> {
    let length = domain.loops[label].length();
    let vertices = &dense.loops[label];
    let count = corners.at.len();
    let Some(first) = corners.taken.iter().position(Option::is_some) else {
        // The loop's smallest coarse vertex leads, so that its order is a function of the code.
        let start = smallest(&coarse.loops[label], vertices);
        return Ok(BoundaryLoop {
            vertices: rotated(vertices, start),
            anchors: Vec::new(),
            corners: Vec::new(),
            is_sharp: corners.sharp,
            length,
        });
    };
    let position_of = |v: u32| vertices.iter().position(|&w| w == v).unwrap_or(0);
    let start = corners.taken[first].map_or(0, position_of);
    let vertices = rotated(vertices, start);
    let n = vertices.len();

    // Corners counter-clockwise from the first taken one, which comes again at the end.
    let order: Vec<usize> = (0..=count).map(|i| (first + i) % count).collect();
    let arc = |i: usize| corners.at[order[i]] + if first + i >= count { length } else { 0.0 };
    let place = |i: usize| {
        let v = corners.taken[order[i]]?;
        Some(if i == count { n } else { vertices.iter().position(|&w| w == v)? })
    };
    let mut anchors = vec![(0, arc(0))];
    for i in 1..=count {
        let Some(end) = place(i) else { continue };
        let done = anchors.len() - 1;
        let (begin, from) = anchors[done];
        let untaken = i - done - 1;
        if end - begin <= untaken {
            return Err(Rejection::CornerLost { corner: corners.numbers.start + order[done + 1] });
        }
        for j in 1..=untaken {
            let share = (arc(done + j) - from) / (arc(i) - from);
            let nearest = begin + libm::round(share * (end - begin) as f64) as usize;
            let after = anchors[anchors.len() - 1].0 + 1;
            anchors.push((nearest.clamp(after, end - (untaken + 1 - j)), arc(done + j)));
        }
        anchors.push((end, arc(i)));
    }
    anchors.pop();
    let mut taken = vec![0; count];
    for (i, &(position, _)) in anchors.iter().enumerate() {
        taken[order[i]] = vertices[position];
    }
    Ok(BoundaryLoop { vertices, anchors, corners: taken, is_sharp: corners.sharp, length })
}

fn smallest(coarse: &[u32], dense: &[u32]) -> usize {
    let least = coarse.iter().min();
    dense.iter().position(|v| Some(v) == least).unwrap_or(0)
}

fn rotated(vertices: &[u32], start: usize) -> Vec<u32> {
    vertices[start..].iter().chain(&vertices[..start]).copied().collect()
}

impl BoundaryLoop {
    /// Arc lengths of all vertices, evenly between anchors; without an anchor from `phase` on.
    pub fn even(&self, phase: f64) -> Vec<f64> {
        let n = self.vertices.len();
        let closing = self.anchors.first().map_or((n, phase + self.length), |&(_, s)| (n, s + self.length));
        let mut stations = if self.anchors.is_empty() { vec![(0, phase)] } else { self.anchors.clone() };
        stations.push(closing);
        let mut along = Vec::with_capacity(n);
        for pair in stations.windows(2) {
            let ((begin, from), (end, to)) = (pair[0], pair[1]);
            let step = (to - from) / (end - begin) as f64;
            along.extend((begin..end).map(|i| from + step * (i - begin) as f64));
        }
        along
    }
}
