//! Cutting a mesh along the axis of a reflection.

use super::{Fold, FoldError, Mirror};
use crate::mesh::automorphism::Shape;
use crate::mesh::isomorphism::Symmetry;
use crate::mesh::load::MAX_CORNERS;
use crate::mesh::quad_mesh::{Left, Mark, QuadMesh};
use crate::mesh::subdivide::subdivide;
use crate::mesh::{BaseMesh, DartId, InitialMesh, StripId, VertexId};
use std::collections::{BTreeMap, BTreeSet};

/// Vertices are told apart by this share of the mesh's size, where it is told why a mesh is not symmetric.
const NEAR: f64 = 1e-3;

/// The half of larger x (then y); `number` counts the folds before, `domain_corners` the corners that are the domain's.
pub fn cut(
    initial: &InitialMesh,
    number: u32,
    mirror: &Mirror,
    domain_corners: usize,
) -> Result<(InitialMesh, Fold), FoldError> {
    let mut mesh = initial.mesh.clone();
    let find = |mesh: &QuadMesh| {
        let found = Shape::of(mesh, domain_corners).find(&mirror.symmetry);
        found.ok_or_else(|| diagnose(mesh, mirror))
    };
    let map = find(&mesh)?;
    for strip in flipped_strips(&mesh, &map) {
        subdivide(&mut mesh, strip, 2);
    }
    let map = find(&mesh)?;
    let halves = Halves { mesh: &mesh, map: &map, mirror, domain_corners };
    let faces = halves.kept_faces()?;
    let (mut part, vertices) = halves.part(&faces, initial.marker)?;
    halves.name_boundary(&mut part.mesh, &vertices, number);
    mark_seam_ends(&mut part.mesh)?;
    let symmetry = Symmetry { corners: halves.corner_images(), ..mirror.symmetry.clone() };
    let mirror = Mirror { symmetry, ..mirror.clone() };
    let fold = Fold { mirror, corner_count: mesh.corner_count, images: mesh.images.clone() };
    Ok((part, fold))
}

/// Strips with an edge whose ends are exchanged.
fn flipped_strips(mesh: &QuadMesh, map: &[u32]) -> BTreeSet<StripId> {
    let is_flipped = |&d: &DartId| {
        let (u, v) = (mesh.origin(d), mesh.end(d));
        map[u.index()] == v.0 && map[v.index()] == u.0
    };
    mesh.darts().filter(is_flipped).map(|d| mesh.strip(d)).collect()
}

struct Halves<'a> {
    mesh: &'a QuadMesh,
    /// The reflection of the vertices.
    map: &'a [u32],
    mirror: &'a Mirror,
    domain_corners: usize,
}

impl Halves<'_> {
    fn image(&self, v: VertexId) -> VertexId {
        VertexId(self.map[v.index()])
    }

    fn is_kept(&self, v: VertexId) -> bool {
        self.image(v) == v
    }

    fn is_on_axis(&self, d: DartId) -> bool {
        self.is_kept(self.mesh.origin(d)) && self.is_kept(self.mesh.end(d))
    }

    /// For each face, whether it is on the side of larger x (then y).
    fn kept_faces(&self) -> Result<Vec<bool>, FoldError> {
        let mesh = self.mesh;
        for first in mesh.face_darts() {
            let corners: BTreeSet<VertexId> = mesh.along(first).map(|d| mesh.origin(d)).collect();
            if corners.iter().all(|&v| corners.contains(&self.image(v))) {
                let vertices = corners.iter().map(|v| v.index()).collect();
                return Err(FoldError::Diagonal { mirror: self.mirror.name, vertices });
            }
        }
        let ahead = |v: VertexId| {
            let (a, b) = (mesh.position(v), mesh.position(self.image(v)));
            (a[0] - b[0]).max(a[1] - b[1])
        };
        let inside = mesh.darts().filter(|&d| !mesh.is_outside(d));
        let start = inside.max_by(|&a, &b| ahead(mesh.origin(a)).total_cmp(&ahead(mesh.origin(b))));
        let mut kept = vec![false; mesh.face_count()];
        let mut pending: Vec<DartId> = start.into_iter().collect();
        while let Some(d) = pending.pop() {
            if let Some(face) = mesh.left(d).as_face()
                && !std::mem::replace(&mut kept[face.index()], true)
            {
                pending.extend(mesh.along(d).filter(|&e| !self.is_on_axis(e)).map(|e| mesh.twin(e)));
            }
        }
        if 2 * kept.iter().filter(|&&kept| kept).count() == mesh.face_count() {
            Ok(kept)
        } else {
            Err(FoldError::NoAxis { mirror: self.mirror.name })
        }
    }

    /// The kept faces as a mesh of their own, its boundary one without names, and for each of its vertices the old one.
    fn part(&self, kept: &[bool], marker: DartId) -> Result<(InitialMesh, Vec<VertexId>), FoldError> {
        let mesh = self.mesh;
        let firsts: Vec<DartId> = mesh
            .face_darts()
            .into_iter()
            .filter(|&d| mesh.left(d).as_face().is_some_and(|face| kept[face.index()]))
            .collect();
        let used: BTreeSet<VertexId> =
            firsts.iter().flat_map(|&first| mesh.along(first)).map(|d| mesh.origin(d)).collect();
        let vertices: Vec<VertexId> = used.into_iter().collect();
        let number: BTreeMap<VertexId, u32> = vertices.iter().copied().zip(0..).collect();
        let faces = firsts.iter().map(|&first| mesh.along(first).map(|d| number[&mesh.origin(d)]).collect());
        let poles = firsts.iter().zip(0..).filter(|(first, _)| mesh.dart(**first).pole);
        let poles = poles.map(|(&first, face)| (face, number[&mesh.origin(first)])).collect();
        // The marker, or its image where it is not here.
        let start = [mesh.origin(marker), mesh.end(marker)];
        let is_here = |&[u, v]: &[VertexId; 2]| {
            let is_side = |d: DartId| mesh.left(d).as_face().is_some_and(|face| kept[face.index()]);
            mesh.find_dart(u, v).is_some_and(|d| is_side(d) || is_side(mesh.twin(d)))
        };
        let starts = [start, start.map(|v| self.image(v))];
        let marker = starts.into_iter().find(is_here).map(|start| start.map(|v| number[&v]));
        let corners = mesh.corners().into_iter();
        let base = BaseMesh {
            vertices: vertices.iter().map(|&v| mesh.position(v)).collect(),
            faces: faces.collect(),
            poles,
            marker,
            corners: corners.map(|c| c.iter().filter_map(|v| number.get(v).copied()).collect()).collect(),
        };
        // A part of a valid mesh is one.
        let part =
            InitialMesh::from_base(&base).map_err(|_| FoldError::NoAxis { mirror: self.mirror.name })?;
        Ok((part, vertices))
    }

    /// Gives the part's boundary edges the loops that they are on in the mesh, those of the axis the seam of this fold.
    fn name_boundary(&self, part: &mut QuadMesh, vertices: &[VertexId], number: u32) {
        let mesh = self.mesh;
        let mut is_there = vec![false; mesh.loop_count()];
        for d in (0..part.darts.len() as u32).map(DartId).filter(|&d| part.is_outside(d)).collect::<Vec<_>>()
        {
            let (u, v) = (vertices[part.origin(d).index()], vertices[part.end(d).index()]);
            let left = mesh.find_dart(u, v).map(|old| mesh.left(old)).filter(|left| left.is_outside());
            part.at(d).left = left.unwrap_or(Left::seam(number));
            if let Some(label) = part.left(d).as_loop() {
                is_there[label as usize] = true;
            }
        }
        part.loop_count = mesh.loop_count;
        part.domain_corners = self.domain_corners as u32;
        part.images = (0..mesh.loop_count)
            .map(|label| {
                let is_crossed = self.mirror.symmetry.left(Left::outside(label)) == Left::outside(label);
                let before = mesh.images_in_loop(label) as u32;
                if is_there[label as usize] { before * if is_crossed { 2 } else { 1 } } else { 0 }
            })
            .collect();
        for mark in &mut part.marks {
            mark.sharp = mesh.marks.iter().any(|old| old.corner == mark.corner && old.sharp);
        }
    }

    /// Where each corner goes: those of the domain as the reflection says, the ends of earlier seams with their vertices.
    fn corner_images(&self) -> Vec<u32> {
        let carriers = self.mesh.corners();
        let seam_ends = || self.mesh.marks.iter().filter(|mark| mark.corner as usize >= self.domain_corners);
        let image = |k: u32| {
            if (k as usize) < self.domain_corners {
                return self.mirror.symmetry.corner(k);
            }
            let there = carriers[k as usize].first().map(|&v| self.image(v));
            seam_ends().find(|mark| Some(mark.vertex) == there).map_or(k, |mark| mark.corner)
        };
        (0..self.mesh.corner_count).map(image).collect()
    }
}

/// Gives the ends of seams sharp marks, numbered after all others. One that has a sharp mark needs none.
fn mark_seam_ends(part: &mut QuadMesh) -> Result<(), FoldError> {
    let ends: BTreeSet<VertexId> = part
        .darts()
        .filter(|&d| part.is_outside(d) && part.is_seam_end(d))
        .map(|d| part.origin(d))
        .filter(|&v| !part.marks.iter().any(|mark| mark.vertex == v && mark.sharp))
        .collect();
    for vertex in ends {
        part.marks.push(Mark { corner: part.corner_count, vertex, sharp: true });
        part.corner_count += 1;
    }
    let count = part.corner_count();
    if count > MAX_CORNERS { Err(FoldError::TooManyCorners { count }) } else { Ok(()) }
}

/// What of a mesh has no image.
fn diagnose(mesh: &QuadMesh, mirror: &Mirror) -> FoldError {
    let name = mirror.name;
    let distance = |a: [f64; 3], b: [f64; 3]| libm::hypot(a[0] - b[0], a[1] - b[1]);
    let size = mesh.positions().iter().map(|&p| distance(p, mesh.position(VertexId(0)))).fold(0.0, f64::max);
    let mut images = Vec::with_capacity(mesh.vertex_count());
    for (vertex, &[x, y, z]) in mesh.positions().iter().enumerate() {
        let [u, v, w] = mirror.image([x, y, z]);
        let is_image = |p: &[f64; 3]| distance(*p, [u, v, w]) <= NEAR * size;
        match mesh.positions().iter().position(is_image) {
            Some(image) => images.push(image),
            None => return FoldError::Vertex { mirror: name, vertex, x, y, u, v },
        }
    }
    for d in mesh.darts() {
        let edge = [mesh.origin(d).index(), mesh.end(d).index()];
        let image = edge.map(|v| images[v]);
        if mesh.find_dart(VertexId(image[0] as u32), VertexId(image[1] as u32)).is_none() {
            return FoldError::Edge { mirror: name, edge, image };
        }
    }
    FoldError::Marks { mirror: name }
}
