//! The conditions V1–V5 of a valid mesh (docs/reference/grammar.md §1.2), and the invariants of the map behind them.

use super::ids::{DartId, VertexId};
use super::quad_mesh::QuadMesh;

/// The condition that the result of a rule would break.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Invalid {
    /// A face that is neither a quad nor a pseudo-quad of distinct vertices.
    #[error("V1 face")]
    Face,
    /// Two edges that join the same two vertices.
    #[error("V2 edge")]
    DoubleEdge,
    /// A vertex whose faces do not form one fan.
    #[error("V3 vertex")]
    Vertex,
    /// A vertex that no face is left at.
    #[error("V3 vertex without face")]
    VertexWithoutFace,
    /// An edge that no face is left at.
    #[error("V3 edge without face")]
    EdgeWithoutFace,
    /// No face at all.
    #[error("V3 no face")]
    NoFace,
    /// More than one piece.
    #[error("V4 connected")]
    Disconnected,
    /// A boundary loop of fewer than 3 edges.
    #[error("V5 boundary")]
    ShortLoop,
    /// Another Euler characteristic than before.
    #[error("topology")]
    Topology,
}

/// Checks V1–V5.
///
/// # Errors
/// The first condition broken.
pub fn check(mesh: &QuadMesh) -> Result<(), Invalid> {
    if mesh.face_count == 0 {
        return Err(Invalid::NoFace);
    }
    check_faces(mesh)?;
    check_vertices(mesh)?;
    check_simple(mesh)?;
    check_loops(mesh)?;
    check_connected(mesh)
}

/// V1: quads and pseudo-quads, all vertices of a face distinct.
fn check_faces(mesh: &QuadMesh) -> Result<(), Invalid> {
    let mut corners = vec![0u8; mesh.face_count()];
    let mut poles = vec![0u8; mesh.face_count()];
    for d in mesh.darts() {
        if let Some(face) = mesh.left(d).as_face() {
            let count = &mut corners[face.index()];
            *count = count.saturating_add(1);
            poles[face.index()] += u8::from(mesh.dart(d).pole && *count <= 4);
            let (origin, next) = (mesh.origin(d), mesh.next(d));
            if origin == mesh.origin(next) || origin == mesh.origin(mesh.next(next)) {
                return Err(Invalid::Face);
            }
        }
    }
    let sound = corners.iter().zip(&poles).all(|shape| matches!(shape, (4, 0) | (3, 1)));
    if sound { Ok(()) } else { Err(Invalid::Face) }
}

/// V3: one orbit of darts around every vertex, with at most one boundary gap; no edge without a face.
fn check_vertices(mesh: &QuadMesh) -> Result<(), Invalid> {
    let mut fans = vec![0u8; mesh.vertex_count()];
    let mut seen = vec![false; mesh.darts.len()];
    for d in mesh.darts() {
        if mesh.is_outside(d) && mesh.is_outside(mesh.twin(d)) {
            return Err(Invalid::EdgeWithoutFace);
        }
        if seen[d.index()] {
            continue;
        }
        let fan = &mut fans[mesh.origin(d).index()];
        *fan += 1;
        let mut gaps = 0;
        for e in mesh.around(d) {
            seen[e.index()] = true;
            gaps += u32::from(mesh.is_outside(e));
        }
        if gaps > 1 || *fan > 1 {
            return Err(Invalid::Vertex);
        }
    }
    if fans.contains(&0) { Err(Invalid::VertexWithoutFace) } else { Ok(()) }
}

/// V2 alone: the darts that leave a vertex lead to different vertices. Relies on V3 to find them by rotation.
///
/// # Errors
/// [`Invalid::DoubleEdge`].
pub fn check_simple(mesh: &QuadMesh) -> Result<(), Invalid> {
    let mut reached_from = vec![u32::MAX; mesh.vertex_count()];
    let mut seen = vec![false; mesh.vertex_count()];
    for d in mesh.darts() {
        let origin = mesh.origin(d);
        if std::mem::replace(&mut seen[origin.index()], true) {
            continue;
        }
        for e in mesh.around(d) {
            let end = mesh.origin(mesh.twin(e));
            if std::mem::replace(&mut reached_from[end.index()], origin.0) == origin.0 {
                return Err(Invalid::DoubleEdge);
            }
        }
    }
    Ok(())
}

/// V5: every boundary loop has at least 3 edges, in the whole mesh where this is a part of one.
fn check_loops(mesh: &QuadMesh) -> Result<(), Invalid> {
    let mut lengths = vec![0usize; mesh.loop_count()];
    for d in mesh.darts() {
        if let Some(label) = mesh.left(d).as_loop() {
            lengths[label as usize] += 1;
        }
    }
    let is_short = |(&length, label): (&usize, u32)| match mesh.images_in_loop(label) {
        0 => false,
        images => images * length < 3,
    };
    if lengths.iter().zip(0..).any(is_short) { Err(Invalid::ShortLoop) } else { Ok(()) }
}

/// V4: every dart is reached from the first.
fn check_connected(mesh: &QuadMesh) -> Result<(), Invalid> {
    let mut seen = vec![false; mesh.darts.len()];
    let mut pending = vec![DartId(0)];
    let mut reached = 0;
    while let Some(d) = pending.pop() {
        if !std::mem::replace(&mut seen[d.index()], true) {
            reached += 1;
            pending.extend([mesh.next(d), mesh.twin(d)]);
        }
    }
    if reached == mesh.darts.len() { Ok(()) } else { Err(Invalid::Disconnected) }
}

/// Checks the invariants of the map itself, which hold whatever a string says; for tests and fuzzing.
///
/// # Errors
/// A sentence that names the dart or vertex at fault: a bug of this crate.
pub fn check_invariants(mesh: &QuadMesh) -> Result<(), String> {
    let count = mesh.darts.len() as u32;
    for d in mesh.darts() {
        let dart = mesh.dart(d);
        let fault = |what: &str| Err(format!("{what} at {d:?}: {dart:?}"));
        if [dart.next, dart.prev, dart.twin].iter().any(|e| e.0 >= count)
            || dart.origin.index() >= mesh.vertex_count()
        {
            return fault("index out of range");
        }
        if dart.twin == d || mesh.twin(dart.twin) != d {
            return fault("twin is not an involution");
        }
        if mesh.prev(dart.next) != d || mesh.next(dart.prev) != d {
            return fault("prev is not the inverse of next");
        }
        if mesh.origin(dart.next) != mesh.origin(dart.twin) {
            return fault("next and twin disagree on the end");
        }
        let is_mixed = mesh.is_folded() && dart.left.is_outside() && mesh.is_outside(dart.next);
        if mesh.left(dart.next) != dart.left && !is_mixed {
            return fault("left changes along a face");
        }
        if mesh.strip(dart.twin) != dart.strip || dart.strip.0 >= mesh.next_strip {
            return fault("strip label");
        }
        if let Some(o) = mesh.opposite(d)
            && (mesh.strip(o) != dart.strip || mesh.opposite(o) != Some(d))
        {
            return fault("opposite edges in different strips");
        }
        if dart.left.as_loop().is_some_and(|label| label >= mesh.loop_count) {
            return fault("loop label");
        }
    }
    check_marks(mesh)
}

fn check_marks(mesh: &QuadMesh) -> Result<(), String> {
    let boundary = mesh.boundary_vertices();
    let on_boundary = |v: VertexId| boundary.get(v.index()) == Some(&true);
    if !mesh.marks.is_sorted() {
        return Err("marks are not sorted".into());
    }
    match mesh.marks.iter().find(|m| m.corner >= mesh.corner_count || !on_boundary(m.vertex)) {
        Some(mark) => Err(format!("{mark:?} is not on the boundary")),
        None => Ok(()),
    }
}
