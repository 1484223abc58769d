//! From a layout to plain arrays, numbered in an order that depends on nothing but the mesh and its places.

use super::SkeletonError;
use super::layout::Layout;
use crate::domain::Domain;
use crate::mesh::BaseMesh;
use std::collections::BTreeSet;

/// The layout as a base mesh: boundary vertices loop by loop along the loop, then inner ones from bottom to top and left to right;
/// faces start at their smallest vertex and are sorted.
pub(super) fn base_mesh(layout: &Layout, domain: &Domain) -> Result<BaseMesh, SkeletonError> {
    check_boundary(layout, domain)?;
    let order = order(layout, domain);
    let mut number = vec![0u32; order.len()];
    for (&v, i) in order.iter().zip(0u32..) {
        number[v] = i;
    }
    let mut faces: Vec<Vec<u32>> = layout
        .faces
        .iter()
        .map(|face| {
            let mut face = face.map(|v| number[v]);
            let least = (0..4).fold(0, |best, k| if face[k] < face[best] { k } else { best });
            face.rotate_left(least);
            face.to_vec()
        })
        .collect();
    faces.sort();
    let mut vertices: Vec<[f64; 3]> = order
        .iter()
        .map(|&v| {
            let vertex = &layout.vertices[v];
            match vertex.site {
                Some(site) => domain.loops[site.loop_number].point(site.s),
                None => [vertex.xy[0], vertex.xy[1], f64::NAN],
            }
        })
        .collect();
    lift(&mut vertices, &faces, domain);
    Ok(BaseMesh { corners: corners(layout, domain, &number), vertices, faces, ..BaseMesh::default() })
}

/// All vertices in their new order.
fn order(layout: &Layout, domain: &Domain) -> Vec<usize> {
    let mut order = Vec::with_capacity(layout.vertices.len());
    for loop_number in 0..domain.loops.len() {
        let mut boundary = layout.boundary(loop_number);
        boundary.sort_by(|a, b| a.1.s.total_cmp(&b.1.s));
        order.extend(boundary.iter().map(|&(v, _)| v));
    }
    // Rounded, so that symmetric vertices compare alike whatever their last digits.
    let step = 1e-6 * domain.size();
    let rounded = |v: usize| layout.vertices[v].xy.map(|c| (c / step).round());
    let mut inner: Vec<usize> =
        (0..layout.vertices.len()).filter(|&v| layout.vertices[v].site.is_none()).collect();
    inner.sort_by(|&a, &b| {
        let (p, q) = (rounded(a), rounded(b));
        p[1].total_cmp(&q[1]).then(p[0].total_cmp(&q[0])).then(a.cmp(&b))
    });
    order.extend(inner);
    order
}

/// Refuses a layout whose boundary edges are not those between neighbours on the loops.
fn check_boundary(layout: &Layout, domain: &Domain) -> Result<(), SkeletonError> {
    let darts: BTreeSet<[usize; 2]> =
        layout.faces.iter().flat_map(|f| (0..4).map(|k| [f[k], f[(k + 1) % 4]])).collect();
    for loop_number in 0..domain.loops.len() {
        let boundary = layout.boundary(loop_number);
        for i in 0..boundary.len() {
            let [a, b] = [boundary[i], boundary[(i + 1) % boundary.len()]];
            if a.1.s == b.1.s || !darts.contains(&[a.0, b.0]) || darts.contains(&[b.0, a.0]) {
                let [x, y, _] = domain.loops[loop_number].point(a.1.s);
                let reason = format!("its quads do not follow loop {loop_number} near ({x:.3}, {y:.3})");
                return Err(SkeletonError::NoMesh { reason });
            }
        }
    }
    Ok(())
}

/// For each corner of the domain its vertex; for a domain without corners, the vertex at its mark.
fn corners(layout: &Layout, domain: &Domain, number: &[u32]) -> Vec<Vec<u32>> {
    let at = |loop_number: usize, s: f64| {
        let holds =
            |v: &usize| layout.vertices[*v].site.is_some_and(|t| t.loop_number == loop_number && t.s == s);
        (0..number.len()).filter(holds).map(|v| number[v]).collect::<Vec<u32>>()
    };
    match domain.mark() {
        Some(s) => vec![at(0, s)],
        None => (0..domain.corner_count()).filter_map(|c| domain.corner(c)).map(|(l, s)| at(l, s)).collect(),
    }
}

/// Heights of inner vertices: those of the surface, or on a free one harmonic between the boundaries.
fn lift(vertices: &mut [[f64; 3]], faces: &[Vec<u32>], domain: &Domain) {
    let inner: Vec<usize> = (0..vertices.len()).filter(|&v| vertices[v][2].is_nan()).collect();
    let mut neighbours = vec![BTreeSet::new(); vertices.len()];
    for face in faces {
        for k in 0..face.len() {
            let (a, b) = (face[k] as usize, face[(k + 1) % face.len()] as usize);
            neighbours[a].insert(b);
            neighbours[b].insert(a);
        }
    }
    for &v in &inner {
        let [x, y, _] = vertices[v];
        vertices[v][2] = domain.height(x, y).unwrap_or(0.0);
    }
    if domain.height(vertices[0][0], vertices[0][1]).is_some() {
        return;
    }
    for _ in 0..200 {
        for &v in &inner {
            let sum: f64 = neighbours[v].iter().map(|&w| vertices[w][2]).sum();
            vertices[v][2] = sum / neighbours[v].len() as f64;
        }
    }
}
