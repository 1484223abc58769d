//! Unfolding: a part is reflected and glued to its image along its seams.

use super::Fold;
use crate::mesh::load::label_strips;
use crate::mesh::quad_mesh::{Dart, Left, Mark, QuadMesh};
use crate::mesh::subdivide::subdivide;
use crate::mesh::{DartId, FaceId, StripId, VertexId};
use std::collections::BTreeSet;

/// Undoes the fold of this number.
pub fn unfold((mut part, marker): (QuadMesh, DartId), number: u32, fold: &Fold) -> (QuadMesh, DartId) {
    let seam = Left::seam(number);
    part_edges_between_seams(&mut part, seam);
    Glue::new(&part, seam, fold).whole(marker)
}

/// Halves the strips of inner edges with both ends on a seam: such an edge and its image would join the same two vertices.
fn part_edges_between_seams(part: &mut QuadMesh, seam: Left) {
    loop {
        let on_seam = seam_vertices(part, seam);
        let is_between = |&d: &DartId| {
            let twin = part.twin(d);
            let is_inner = !part.is_outside(d) && !part.is_outside(twin);
            is_inner && on_seam[part.origin(d).index()] && on_seam[part.origin(twin).index()]
        };
        let strips: BTreeSet<StripId> = part.darts().filter(is_between).map(|d| part.strip(d)).collect();
        if strips.is_empty() {
            return;
        }
        for strip in strips {
            subdivide(part, strip, 2);
        }
    }
}

fn seam_vertices(part: &QuadMesh, seam: Left) -> Vec<bool> {
    let mut on_seam = vec![false; part.vertex_count()];
    for d in part.darts().filter(|&d| part.left(d) == seam) {
        on_seam[part.origin(d).index()] = true;
        on_seam[part.end(d).index()] = true;
    }
    on_seam
}

/// A part and the numbers of its image: darts that are not on the seam keep their order, then come their images.
struct Glue<'a> {
    part: &'a QuadMesh,
    seam: Left,
    fold: &'a Fold,
    /// New number of each dart that stays.
    dart: Vec<u32>,
    kept: u32,
    /// The image of each vertex.
    image: Vec<VertexId>,
    vertex_count: u32,
}

impl<'a> Glue<'a> {
    fn new(part: &'a QuadMesh, seam: Left, fold: &'a Fold) -> Self {
        let mut kept = 0;
        let mut dart = vec![u32::MAX; part.darts.len()];
        for d in part.darts().filter(|&d| part.left(d) != seam) {
            dart[d.index()] = kept;
            kept += 1;
        }
        let mut vertex_count = part.vertex_count() as u32;
        let image = seam_vertices(part, seam)
            .into_iter()
            .zip(0..)
            .map(|(on_seam, v)| {
                if on_seam {
                    VertexId(v)
                } else {
                    vertex_count += 1;
                    VertexId(vertex_count - 1)
                }
            })
            .collect();
        Self { part, seam, fold, dart, kept, image, vertex_count }
    }

    fn same(&self, d: DartId) -> DartId {
        DartId(self.dart[d.index()])
    }

    /// The image of a dart runs the other way, so that what was on its left is again.
    fn reflected(&self, d: DartId) -> DartId {
        DartId(self.dart[d.index()] + self.kept)
    }

    fn is_seam(&self, d: DartId) -> bool {
        self.part.left(d) == self.seam
    }

    fn whole(&self, marker: DartId) -> (QuadMesh, DartId) {
        let part = self.part;
        let mirror = &self.fold.mirror;
        let staying = || part.darts().filter(|&d| !self.is_seam(d));
        let darts = staying().map(|d| self.kept_dart(d)).chain(staying().map(|d| self.reflected_dart(d)));
        let mut positions = part.positions.clone();
        positions.resize(self.vertex_count as usize, [0.0; 3]);
        for (position, image) in part.positions.iter().zip(&self.image) {
            if image.index() >= part.vertex_count() {
                positions[image.index()] = mirror.image(*position);
            }
        }
        let mut marks: Vec<Mark> = part
            .marks
            .iter()
            .filter(|mark| mark.corner < self.fold.corner_count)
            .flat_map(|&mark| {
                let corner = mirror.symmetry.corner(mark.corner);
                [mark, Mark { corner, vertex: self.image[mark.vertex.index()], ..mark }]
            })
            .collect();
        marks.sort_unstable();
        marks.dedup();
        let mut whole = QuadMesh {
            darts: darts.collect(),
            positions,
            marks,
            corner_count: self.fold.corner_count,
            face_count: 2 * part.face_count,
            loop_count: part.loop_count,
            next_strip: 0,
            images: self.fold.images.clone(),
            domain_corners: part.domain_corners,
        };
        label_strips(&mut whole);
        // On the seam's outside the marker is inside the image.
        let marker = if self.is_seam(marker) { self.reflected(part.twin(marker)) } else { self.same(marker) };
        (whole, marker)
    }

    fn kept_dart(&self, d: DartId) -> Dart {
        let old = self.part.dart(d);
        // Along a wall that ends at the seam its image comes next.
        let follow = |e: DartId| if self.is_seam(e) { self.reflected(d) } else { self.same(e) };
        let twin = if self.is_seam(old.twin) { self.reflected(d) } else { self.same(old.twin) };
        Dart { next: follow(old.next), prev: follow(old.prev), twin, strip: StripId(u32::MAX), ..*old }
    }

    fn reflected_dart(&self, d: DartId) -> Dart {
        let old = self.part.dart(d);
        let follow = |e: DartId| if self.is_seam(e) { self.same(d) } else { self.reflected(e) };
        let twin = if self.is_seam(old.twin) { self.same(d) } else { self.reflected(old.twin) };
        let left = match old.left.as_face() {
            Some(face) => Left::face(FaceId(face.0 + self.part.face_count)),
            None => self.fold.mirror.symmetry.left(old.left),
        };
        Dart {
            next: follow(old.prev),
            prev: follow(old.next),
            twin,
            origin: self.image[self.part.end(d).index()],
            left,
            strip: StripId(u32::MAX),
            pole: self.part.dart(old.next).pole,
            frozen: old.frozen,
        }
    }
}
