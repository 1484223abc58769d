//! Strip deletion: the faces of a strip vanish, its transverse edges become points (docs/reference/grammar.md §4.3).

use super::ids::{DartId, FaceId, StripId, VertexId};
use super::quad_mesh::{Dart, Left, Mark, QuadMesh};
use super::validate::{self, Invalid};

/// A mesh without one of its strips, and what became of the old one's parts.
#[derive(Clone, Debug)]
pub struct Contraction {
    /// The new mesh, valid, with the Euler characteristic and the boundary loops of the old one.
    pub mesh: QuadMesh,
    plan: Plan,
    new_dart: Vec<Option<DartId>>,
}

impl Contraction {
    /// The new vertex that an old one was merged into.
    pub fn vertex(&self, old: VertexId) -> VertexId {
        self.plan.class[old.index()]
    }

    /// The dart that an old one, of `old`, has become; `None` if its ends were merged.
    pub fn dart(&self, old: &QuadMesh, d: DartId) -> Option<DartId> {
        if self.plan.is_collapsed(old, d) {
            return None;
        }
        let mut image = d;
        while self.plan.is_removed(old, image) {
            image = old.twin(old.opposite(image)?);
        }
        self.new_dart[image.index()]
    }
}

/// Deletes `strip`, without step 2 (boundaries are not refined first).
///
/// # Errors
/// The condition that the result would break.
pub fn contract(mesh: &QuadMesh, strip: StripId) -> Result<Contraction, Invalid> {
    let plan = Plan::new(mesh, strip);
    if plan.removed.iter().all(|&removed| removed) {
        return Err(Invalid::NoFace);
    }
    let survivors: Vec<DartId> = mesh.darts().filter(|&d| plan.survives(mesh, d)).collect();
    let mut new_dart = vec![None; mesh.darts.len()];
    for (k, &d) in survivors.iter().enumerate() {
        new_dart[d.index()] = Some(DartId(k as u32));
    }
    let mut result = plan.empty_result(mesh);
    for &d in &survivors {
        let dart = plan.surviving_dart(mesh, d, &new_dart)?;
        result.darts.push(dart);
    }
    for k in 0..result.darts.len() as u32 {
        let next = result.next(DartId(k));
        result.at(next).prev = DartId(k);
    }
    validate::check(&result)?;
    if result.euler_characteristic() != mesh.euler_characteristic() {
        return Err(Invalid::Topology);
    }
    Ok(Contraction { mesh: result, plan, new_dart })
}

/// Which faces go and which vertices become one.
#[derive(Clone, Debug)]
struct Plan {
    /// By face: crossed by the strip.
    removed: Vec<bool>,
    /// By face that stays: its new number.
    face: Vec<FaceId>,
    /// By vertex: the new vertex it is merged into.
    class: Vec<VertexId>,
    class_count: usize,
    /// By new vertex: one of the old ones was a pole.
    holds_pole: Vec<bool>,
}

impl Plan {
    fn new(mesh: &QuadMesh, strip: StripId) -> Self {
        let mut removed = vec![false; mesh.face_count()];
        let mut parent: Vec<u32> = (0..mesh.vertex_count() as u32).collect();
        for d in mesh.darts().filter(|&d| mesh.strip(d) == strip) {
            if let Some(face) = mesh.left(d).as_face() {
                removed[face.index()] = true;
            }
            let (a, b) =
                (root(&mut parent, mesh.origin(d).0), root(&mut parent, mesh.origin(mesh.twin(d)).0));
            parent[a.max(b) as usize] = a.min(b);
        }
        // Roots are the lowest members, so they are numbered before anyone asks for their number.
        let mut class: Vec<VertexId> = Vec::with_capacity(parent.len());
        let mut class_count = 0;
        for v in 0..parent.len() as u32 {
            let r = root(&mut parent, v);
            class.push(if r == v { VertexId(class_count) } else { class[r as usize] });
            class_count += u32::from(r == v);
        }
        let mut holds_pole = vec![false; class_count as usize];
        for dart in mesh.darts.iter().filter(|dart| dart.pole) {
            holds_pole[class[dart.origin.index()].index()] = true;
        }
        let mut kept = 0;
        let face = removed
            .iter()
            .map(|&removed| {
                kept += u32::from(!removed);
                FaceId(kept.saturating_sub(1))
            })
            .collect();
        Self { removed, face, class, class_count: class_count as usize, holds_pole }
    }

    fn class(&self, mesh: &QuadMesh, d: DartId) -> VertexId {
        self.class[mesh.origin(d).index()]
    }

    fn is_collapsed(&self, mesh: &QuadMesh, d: DartId) -> bool {
        self.class(mesh, d) == self.class(mesh, mesh.twin(d))
    }

    /// The face on the left of `d` goes.
    fn is_removed(&self, mesh: &QuadMesh, d: DartId) -> bool {
        mesh.left(d).as_face().is_some_and(|face| self.removed[face.index()])
    }

    fn survives(&self, mesh: &QuadMesh, d: DartId) -> bool {
        !self.is_removed(mesh, d) && !self.is_collapsed(mesh, d)
    }

    /// The result's vertices, marks and counts; no darts yet.
    fn empty_result(&self, mesh: &QuadMesh) -> QuadMesh {
        let mut positions = vec![[0.0; 3]; self.class_count];
        let mut members = vec![0.0; self.class_count];
        for (class, position) in self.class.iter().zip(&mesh.positions) {
            members[class.index()] += 1.0;
            (0..3).for_each(|i| positions[class.index()][i] += position[i]);
        }
        for (position, members) in positions.iter_mut().zip(&members) {
            (0..3).for_each(|i| position[i] /= members);
        }
        let mut marks: Vec<Mark> =
            mesh.marks.iter().map(|m| Mark { vertex: self.class[m.vertex.index()], ..*m }).collect();
        marks.sort_unstable();
        marks.dedup();
        QuadMesh {
            darts: Vec::with_capacity(mesh.darts.len()),
            positions,
            marks,
            corner_count: mesh.corner_count,
            face_count: self.removed.iter().filter(|&&removed| !removed).count() as u32,
            loop_count: mesh.loop_count,
            next_strip: mesh.next_strip,
            images: mesh.images.clone(),
            domain_corners: mesh.domain_corners,
        }
    }

    /// A surviving dart in the new numbers; `prev` is set later.
    fn surviving_dart(
        &self,
        mesh: &QuadMesh,
        d: DartId,
        new_dart: &[Option<DartId>],
    ) -> Result<Dart, Invalid> {
        let old = mesh.dart(d);
        let next = mesh.along(old.next).find_map(|e| new_dart[e.index()]).ok_or(Invalid::Face)?;
        // Along a chain of removed faces the lateral edges are one.
        let mut twin = old.twin;
        while self.is_removed(mesh, twin) {
            twin = mesh.twin(mesh.opposite(twin).ok_or(Invalid::Face)?);
        }
        let twin = new_dart[twin.index()].ok_or(Invalid::Face)?;
        let left = old.left.as_face().map_or(old.left, |face| Left::face(self.face[face.index()]));
        let origin = self.class(mesh, d);
        let mut pole = old.pole;
        if !left.is_outside() && self.is_collapsed(mesh, old.prev) {
            // The edge before collapsed: a quad becomes a pseudo-quad if a pole was merged into this vertex.
            if !self.holds_pole[origin.index()] || pole {
                return Err(Invalid::Face);
            }
            pole = true;
        }
        Ok(Dart { next, prev: d, twin, origin, left, strip: old.strip, pole, frozen: old.frozen })
    }
}

fn root(parent: &mut [u32], mut v: u32) -> u32 {
    while parent[v as usize] != v {
        parent[v as usize] = parent[parent[v as usize] as usize];
        v = parent[v as usize];
    }
    v
}
