//! What is refused before any geometry: flat faces and pinched vertices (docs/reference/geometry.md §1.4).

use super::coarse::{Coarse, corners_of, sides_of};
use super::corners::LoopCorners;
use super::limits::Limits;
use super::rejection::Rejection;
use crate::domain::Domain;
use std::f64::consts::PI;

/// Refuses meshes that no placing can make into a pattern on this domain.
///
/// Flat: a face all of whose vertices lie on one side between taken corners, or at least all but one of its edges on one
/// loop without sharp corners; an inner edge with both ends on the same straight side. Pinched, unless
/// `pinched_allowed`: a boundary vertex with one face that takes no corner.
pub fn reject(
    coarse: &Coarse<'_>,
    domain: &Domain,
    corners: &[LoopCorners],
    pinched_allowed: bool,
) -> Option<Rejection> {
    if coarse.loops.len() != domain.loops.len() {
        return Some(Rejection::OtherLoops { mesh: coarse.loops.len(), domain: domain.loops.len() });
    }
    let sides: Vec<Side> =
        (0..corners.len()).flat_map(|k| sides_of_loop(coarse, domain, corners, k)).collect();
    let on_sides = sides_by_vertex(coarse, &sides);
    let faces: Vec<u32> = (0..coarse.mesh.faces.len())
        .filter(|&f| is_flat(coarse, corners, &on_sides, &coarse.mesh.faces[f]))
        .map(|f| f as u32)
        .collect();
    let edges: Vec<[u32; 2]> = coarse
        .edges
        .iter()
        .zip(&coarse.edge_faces)
        .filter(|&(&[u, v], &faces)| {
            let shared = |&&s: &&u32| on_sides[v as usize].contains(&s) && sides[s as usize].straight;
            faces == 2 && on_sides[u as usize].iter().any(|s| shared(&s))
        })
        .map(|(&edge, _)| edge)
        .collect();
    if !faces.is_empty() || !edges.is_empty() {
        return Some(Rejection::Flat { faces, edges });
    }
    let vertices = pinched(coarse, corners);
    (!pinched_allowed && !vertices.is_empty()).then_some(Rejection::Pinched { vertices })
}

/// Boundary vertices with one face that take no sharp corner, ascending.
pub fn pinched(coarse: &Coarse<'_>, corners: &[LoopCorners]) -> Vec<u32> {
    let takes_corner = |v: u32| corners.iter().any(|l| l.sharp && l.taken.contains(&Some(v)));
    (0..coarse.mesh.vertex_count as u32)
        .filter(|&v| {
            let i = v as usize;
            coarse.on_loop[i].is_some() && coarse.vertex_faces[i] == 1 && !takes_corner(v)
        })
        .collect()
}

/// A stretch of a boundary loop from one taken sharp corner to the next.
struct Side {
    vertices: Vec<u32>,
    straight: bool,
}

fn sides_of_loop(coarse: &Coarse<'_>, domain: &Domain, corners: &[LoopCorners], label: usize) -> Vec<Side> {
    let LoopCorners { at, taken, sharp, .. } = &corners[label];
    if !sharp {
        return Vec::new();
    }
    let vertices = &coarse.loops[label];
    let n = vertices.len();
    let ends: Vec<(usize, f64)> = taken
        .iter()
        .zip(at)
        .filter_map(|(v, &s)| Some((coarse.on_loop[(*v)? as usize]?.position, s)))
        .collect();
    (0..ends.len())
        .map(|i| {
            let (start, from) = ends[i];
            let (end, to) = ends[(i + 1) % ends.len()];
            let edges = (end + n - start - 1) % n + 1;
            Side {
                vertices: (0..=edges).map(|j| vertices[(start + j) % n]).collect(),
                straight: domain.loops[label].is_straight(from, to),
            }
        })
        .collect()
}

fn sides_by_vertex(coarse: &Coarse<'_>, sides: &[Side]) -> Vec<Vec<u32>> {
    let mut on_sides = vec![Vec::new(); coarse.mesh.vertex_count];
    for (s, side) in sides.iter().enumerate() {
        for &v in &side.vertices {
            if on_sides[v as usize].last() != Some(&(s as u32)) {
                on_sides[v as usize].push(s as u32);
            }
        }
    }
    on_sides
}

fn is_flat(coarse: &Coarse<'_>, corners: &[LoopCorners], on_sides: &[Vec<u32>], face: &[u32; 4]) -> bool {
    let mut vertices = corners_of(face);
    let Some(first) = vertices.next() else { return false };
    let one_side =
        on_sides[first as usize].iter().any(|s| vertices.clone().all(|v| on_sides[v as usize].contains(s)));
    one_side || (0..corners.len()).any(|label| wraps_smooth_loop(coarse, corners, face, label))
}

/// Whether all edges of a face but at most one are on one loop without sharp corners.
fn wraps_smooth_loop(coarse: &Coarse<'_>, corners: &[LoopCorners], face: &[u32; 4], label: usize) -> bool {
    if corners[label].sharp && corners[label].taken.iter().any(Option::is_some) {
        return false;
    }
    let on_this = |v: u32| coarse.on_loop[v as usize].is_some_and(|on| on.label == label);
    let on_boundary = sides_of(face)
        .filter(|&[u, v]| on_this(u) && on_this(v) && coarse.edge_faces[coarse.edge(u, v)] == 1)
        .count();
    on_boundary + 1 >= corners_of(face).count()
}

/// The angle that panels can share at each coarse vertex.
pub struct Available<'a> {
    coarse: &'a Coarse<'a>,
    domain: &'a Domain,
    /// For each vertex, the corner of the domain that it takes.
    corner: Vec<Option<usize>>,
}

impl<'a> Available<'a> {
    /// Collects the corners that are taken.
    pub fn of(coarse: &'a Coarse<'a>, domain: &'a Domain, corners: &[LoopCorners]) -> Self {
        let mut corner = vec![None; coarse.mesh.vertex_count];
        for numbering in corners.iter().filter(|numbering| numbering.sharp) {
            for (k, v) in numbering.numbers.clone().zip(&numbering.taken) {
                if let Some(v) = v {
                    corner[*v as usize] = Some(k);
                }
            }
        }
        Self { coarse, domain, corner }
    }

    /// Angle at a vertex, rad: 2π inside, π on a smooth boundary, the corner's own at a corner.
    pub fn angle(&self, v: u32) -> f64 {
        match self.corner[v as usize] {
            Some(corner) => self.domain.corner_angle(corner),
            None if self.coarse.on_loop[v as usize].is_some() => PI,
            None => 2.0 * PI,
        }
    }

    /// Fewest panels at a vertex: ⌊α/180°⌋ + 1 at a corner.
    fn least_panels(&self, v: u32) -> u32 {
        match self.corner[v as usize] {
            Some(_) => (self.angle(v) / PI + 1e-9).floor() as u32 + 1,
            None => 1,
        }
    }
}

/// Refuses meshes whose vertices break the limits in every pattern: too many panels for the valence or for the angle there is, too few at
/// a corner or inside (docs/reference/geometry.md §1.4). The strips that end in a pole count with one row.
pub fn reject_crowded(
    coarse: &Coarse<'_>,
    domain: &Domain,
    corners: &[LoopCorners],
    limits: &Limits,
) -> Option<Rejection> {
    let available = Available::of(coarse, domain, corners);
    let mut is_pole = vec![false; coarse.mesh.vertex_count];
    for face in coarse.mesh.faces.iter().filter(|face| face[0] == face[1]) {
        is_pole[face[0] as usize] = true;
    }
    let excess = |v: u32| {
        let panels = coarse.vertex_faces[v as usize];
        let is_inner = coarse.on_loop[v as usize].is_none();
        let valence = panels as usize + usize::from(!is_inner);
        let angle = f64::from(panels) * limits.min_angle;
        let too_many = valence as f64 / limits.max_valence as f64 - 1.0;
        let too_narrow = angle / available.angle(v) - 1.0 - 1e-9;
        let fewest = available.least_panels(v);
        let too_few = 1.0 - f64::from(panels) / f64::from(fewest);
        let lonely = if is_inner && !is_pole[v as usize] {
            1.0 - valence as f64 / limits.min_valence as f64
        } else {
            0.0
        };
        too_many.max(too_narrow).max(too_few).max(lonely)
    };
    let vertices: Vec<u32> = (0..coarse.mesh.vertex_count as u32).filter(|&v| excess(v) > 0.0).collect();
    let excess = vertices.iter().map(|&v| excess(v)).sum();
    (!vertices.is_empty()).then_some(Rejection::Crowded { vertices, excess })
}
