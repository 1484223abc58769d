//! Symmetric patterns: where symmetries of the domain take the vertices of a design that has them, and how its geometry is kept
//! symmetric, in the end to the last bit, so that members which are images of each other are equal.

use super::coarse::Coarse;
use super::pattern::{Panel, Pattern};
use super::rejection::Rejection;
use super::vector::{Vec3, distance};
use crate::domain::{Domain, Symmetry as Kind};
use crate::mesh::automorphism::Shape;
use crate::mesh::isomorphism::Symmetry;
use crate::mesh::{CanonicalMesh, Symmetries};
use crate::surface::Surface;

/// Corners may be moved by this share of the domain's size: by rounding, not by more.
const CORNERS_APART: f64 = 1e-11;

/// A pattern with vertices farther than this share of the domain's size from where symmetry has them is left as it is: smoothing, unlike
/// optimising, can let boundary vertices slide one way at the tip of a slender domain.
const NEARLY: f64 = 1e-6;

/// A symmetry of the domain that maps a coarse mesh onto itself.
#[derive(Clone, Debug)]
pub struct Image {
    /// Which.
    pub kind: Kind,
    /// Where it takes loops and corners.
    pub symmetry: Symmetry,
    /// Where it takes each coarse vertex.
    pub vertices: Vec<u32>,
}

impl Image {
    /// All symmetries that domain and mesh have in common, the identity left out; with any two of them their product is there too. None
    /// of a mesh whose vertices do not carry one corner each: of several at one vertex geometry gives it the first, and finds the others
    /// vertices along the boundary.
    pub fn all(mesh: &CanonicalMesh, domain: &Domain) -> Vec<Self> {
        let symmetries = domain.own_symmetries();
        let mut carriers: Vec<&[u32]> = mesh.corners.iter().map(Vec::as_slice).collect();
        carriers.sort_unstable();
        let are_apart = carriers.windows(2).all(|pair| pair[0] != pair[1]);
        if symmetries.is_empty() || !are_apart || carriers.iter().any(|vertices| vertices.len() != 1) {
            return Vec::new();
        }
        let shape = Shape::of_canonical(mesh);
        let image = |(kind, symmetry): &(Kind, Symmetry)| {
            let vertices = shape.find(symmetry)?;
            Some(Self { kind: *kind, symmetry: symmetry.clone(), vertices })
        };
        symmetries.iter().filter_map(image).collect()
    }

    /// Where it takes each vertex of a dense mesh; `None` if strips that are images of each other have different rows.
    pub fn of_dense(&self, vertex_count: usize, panels: &[Panel], loops: &[Vec<u32>]) -> Option<Vec<u32>> {
        // Every coarse vertex, which keeps its number, is a corner to this.
        let Symmetry { loops: labels, reversed, .. } = self.symmetry.clone();
        let symmetry = Symmetry { loops: labels, corners: self.vertices.clone(), reversed };
        Shape::of_panels(vertex_count, panels.iter().map(Panel::corners), loops, self.vertices.len())
            .find(&symmetry)
    }
}

/// Refuses a design that has lost a symmetry it is to have, which merging of parallel strips can do where validity keeps one of them on one
/// side only, and, unless `pinched_allowed`, one with an inner vertex on an axis that has a single panel on each side.
pub fn rejection(
    mesh: &CanonicalMesh,
    images: &[Image],
    kinds: &[Kind],
    pinched_allowed: bool,
) -> Option<Rejection> {
    let coarse = Coarse::of(mesh);
    for &kind in kinds {
        let Some(image) = images.iter().find(|image| image.kind == kind) else {
            return Some(Rejection::NotSymmetric { symmetry: kind.name() });
        };
        let is_pinched = |&v: &u32| {
            let i = v as usize;
            image.vertices[i] == v && coarse.valence[i] == 2 && coarse.on_loop[i].is_none()
        };
        let vertices: Vec<u32> = (0..mesh.vertex_count as u32).filter(is_pinched).collect();
        if !pinched_allowed && !vertices.is_empty() {
            return Some(Rejection::Pinched { vertices });
        }
    }
    None
}

/// Rows of strips that are images of each other made equal: the most of them.
pub fn even_rows(coarse: &Coarse<'_>, images: &[Image], rows: &mut [u32]) {
    loop {
        let before = rows.to_vec();
        for image in images {
            for (&[u, v], &strip) in coarse.edges.iter().zip(&coarse.edge_strip) {
                let there = coarse.edge(image.vertices[u as usize], image.vertices[v as usize]);
                let other = coarse.edge_strip[there] as usize;
                rows[other] = rows[other].max(rows[strip as usize]);
            }
        }
        if rows == before {
            return;
        }
    }
}

/// Which symmetries of the domain a design has, by name.
pub fn symmetries(images: &[Image]) -> Symmetries {
    let has = |kind| images.iter().any(|image| image.kind == kind);
    Symmetries {
        mirror_x: has(Kind::MirrorX),
        mirror_y: has(Kind::MirrorY),
        turns: if has(Kind::Rotate180) { 2 } else { 1 },
    }
}

/// Makes a pattern that is symmetric but for rounding so to the last bit: of vertices that are images of each other one decides, and
/// those on an axis are put on it. Corners that are images of each other but for more than rounding stay where they are.
pub fn even_out(pattern: &mut Pattern, images: &[Image], domain: &Domain, surface: &dyn Surface) {
    let count = pattern.positions.len();
    let maps: Option<Vec<(Kind, Vec<u32>)>> = images
        .iter()
        .map(|image| Some((image.kind, image.of_dense(count, &pattern.panels, &pattern.loops)?)))
        .collect();
    let Some(maps) = maps.filter(|maps| !maps.is_empty()) else { return };
    let is_near_its_image = |(kind, map): &(Kind, Vec<u32>)| {
        let apart = |v: usize| {
            distance(pattern.positions[map[v] as usize], domain.image(pattern.positions[v], *kind))
        };
        (0..count).all(|v| apart(v) <= NEARLY * domain.size())
    };
    if !maps.iter().all(is_near_its_image) {
        return;
    }
    let mut is_corner = vec![false; count];
    for &v in &pattern.corners {
        is_corner[v as usize] = true;
    }
    let stays =
        |v: usize, from: Vec3, to: Vec3| is_corner[v] && distance(from, to) > CORNERS_APART * domain.size();
    let mut is_done = vec![false; count];
    for v in 0..count {
        if std::mem::replace(&mut is_done[v], true) {
            continue;
        }
        let given = pattern.positions[v];
        let on_axis = maps
            .iter()
            .filter(|(_, map)| map[v] as usize == v)
            .fold(given, |p, &(kind, _)| middle(p, domain.image(p, kind)));
        let decided = if stays(v, given, on_axis) {
            given
        } else if on_axis == given || is_on_boundary(pattern, v) {
            on_axis
        } else {
            surface.project(on_axis)
        };
        pattern.positions[v] = decided;
        for (kind, map) in &maps {
            let image = map[v] as usize;
            let place = domain.image(decided, *kind);
            if !std::mem::replace(&mut is_done[image], true) && !stays(image, pattern.positions[image], place)
            {
                pattern.positions[image] = place;
            }
        }
    }
}

fn is_on_boundary(pattern: &Pattern, v: usize) -> bool {
    pattern.loops.iter().flatten().any(|&w| w as usize == v)
}

fn middle(p: Vec3, q: Vec3) -> Vec3 {
    std::array::from_fn(|k| 0.5 * (p[k] + q[k]))
}
