//! From plain arrays to a checked mesh: every way in which an initial mesh can be wrong has its own message.

use std::collections::BTreeMap;

use super::base::BaseMesh;
use super::ids::{DartId, FaceId, StripId, VertexId};
use super::quad_mesh::{Left, Mark, QuadMesh};
use super::validate::{self, Invalid};

/// Corner numbers must fit a set in 128 bits with room for the factor 1000 of the canonical code.
pub const MAX_CORNERS: usize = 112;

/// Most faces of an initial mesh. It is to be coarse: work on it grows with the square of its faces and more.
pub const MAX_FACES: usize = 10_000;

/// So that means and areas of coordinates stay finite.
const MAX_COORDINATE_M: f64 = 1e100;

/// What is wrong with an initial mesh (docs/reference/grammar.md §1.7). Vertices, faces and corners are numbered as in the input, from 0.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum BaseMeshError {
    #[error("the mesh has no faces")]
    NoFaces,
    #[error("vertex {vertex} has a coordinate that is not a finite number, or one beyond ±1e100 m")]
    NotFinite { vertex: u32 },
    #[error("{what} refers to vertex {vertex}, but there are only {count} vertices (numbered from 0)")]
    VertexOutOfRange { what: String, vertex: u32, count: usize },
    #[error("poles name face {face}, but there are only {count} faces (numbered from 0)")]
    FaceOutOfRange { face: u32, count: usize },
    #[error("face {face} has {corners} vertices: a face is a quad, or a triangle with a pole")]
    FaceSize { face: u32, corners: usize },
    #[error("face {face} is a triangle without a pole: name its pole vertex in \"poles\"")]
    TriangleWithoutPole { face: u32 },
    #[error("face {face} is a quad, but \"poles\" gives it a pole (vertex {pole})")]
    QuadWithPole { face: u32, pole: u32 },
    #[error("the pole of face {face}, vertex {pole}, is not one of its vertices {vertices:?}")]
    PoleNotInFace { face: u32, pole: u32, vertices: Vec<u32> },
    #[error("face {face} uses vertex {vertex} twice")]
    RepeatedVertex { face: u32, vertex: u32 },
    #[error(
        "faces {first} and {second} run along edge {edge:?} in the same direction: the winding is inconsistent"
    )]
    InconsistentWinding { first: u32, second: u32, edge: [u32; 2] },
    #[error("edge {edge:?} has more than two faces (among them {face}): the mesh is not manifold")]
    NonManifoldEdge { edge: [u32; 2], face: u32 },
    #[error("the faces around vertex {vertex} do not form one fan: the mesh is not manifold")]
    NonManifoldVertex { vertex: u32 },
    #[error("vertex {vertex} belongs to no face")]
    VertexWithoutFace { vertex: u32 },
    #[error("the mesh is not connected: face {face} cannot be reached from face 0")]
    Disconnected { face: u32 },
    #[error("the boundary loop {vertices:?} has fewer than 3 edges")]
    ShortBoundary { vertices: Vec<u32> },
    #[error("the marker {marker:?} is not an edge of the mesh")]
    MarkerNotAnEdge { marker: [u32; 2] },
    #[error("corner {corner} marks vertex {vertex}, which is not on the boundary")]
    CornerInside { corner: usize, vertex: u32 },
    #[error(
        "{count} faces, but at most {MAX_FACES} are supported: the mesh is to be coarse, pattern.panels makes it dense"
    )]
    TooManyFaces { count: usize },
    #[error("{count} corners, but at most {MAX_CORNERS} are supported")]
    TooManyCorners { count: usize },
    #[error("the mesh breaks condition {0}")]
    Invalid(#[from] Invalid),
}

impl BaseMeshError {
    /// The face at fault, for a reader that knows where it stands in a file.
    pub fn face(&self) -> Option<usize> {
        match self {
            Self::FaceSize { face, .. }
            | Self::TriangleWithoutPole { face }
            | Self::QuadWithPole { face, .. }
            | Self::PoleNotInFace { face, .. }
            | Self::RepeatedVertex { face, .. }
            | Self::InconsistentWinding { second: face, .. }
            | Self::NonManifoldEdge { face, .. }
            | Self::Disconnected { face } => Some(*face as usize),
            _ => None,
        }
    }

    /// The vertex at fault, where it is not a face.
    pub fn vertex(&self) -> Option<usize> {
        match self {
            Self::NotFinite { vertex }
            | Self::NonManifoldVertex { vertex }
            | Self::VertexWithoutFace { vertex } => Some(*vertex as usize),
            _ => None,
        }
    }
}

/// An initial mesh and the start of its marker.
#[derive(Clone, Debug)]
pub struct InitialMesh {
    /// The mesh, its strips labelled in the order of docs/reference/grammar.md §5.
    pub mesh: QuadMesh,
    /// Where the marker starts.
    pub marker: DartId,
    /// Whether strips may be added that end in poles.
    pub poles: bool,
}

impl InitialMesh {
    /// Checks an initial mesh and builds its map. Vertex numbers and face numbers are those of the input.
    ///
    /// The boundary loop with the largest absolute area of its xy projection gets label 0, the others 1, 2, … in
    /// the order of their smallest vertex number.
    ///
    /// # Errors
    /// What is wrong, and where.
    pub fn from_base(base: &BaseMesh) -> Result<Self, BaseMeshError> {
        check_plain(base)?;
        let mut mesh = QuadMesh {
            positions: base.vertices.clone(),
            face_count: base.faces.len() as u32,
            corner_count: base.corners.len() as u32,
            ..QuadMesh::default()
        };
        let edges = add_inside_darts(&mut mesh, base)?;
        add_outside_darts(&mut mesh)?;
        check_connected(&mesh)?;
        label_loops(&mut mesh)?;
        label_strips(&mut mesh);
        mark_corners(&mut mesh, base)?;
        validate::check(&mesh)?;
        let marker = match base.marker {
            None => DartId(0),
            Some([u, v]) => edges
                .get(&(u, v))
                .copied()
                .or_else(|| edges.get(&(v, u)).map(|&d| mesh.twin(d)))
                .ok_or(BaseMeshError::MarkerNotAnEdge { marker: [u, v] })?,
        };
        Ok(Self { mesh, marker, poles: true })
    }
}

/// All that can be said without looking at more than one face.
fn check_plain(base: &BaseMesh) -> Result<(), BaseMeshError> {
    let count = base.vertices.len();
    let in_range = |what: &dyn Fn() -> String, vertex: u32| {
        if (vertex as usize) < count {
            Ok(())
        } else {
            Err(BaseMeshError::VertexOutOfRange { what: what(), vertex, count })
        }
    };
    if base.faces.is_empty() {
        return Err(BaseMeshError::NoFaces);
    }
    if base.faces.len() > MAX_FACES {
        return Err(BaseMeshError::TooManyFaces { count: base.faces.len() });
    }
    if let Some(vertex) = base.vertices.iter().position(|p| !p.iter().all(|x| x.abs() <= MAX_COORDINATE_M)) {
        return Err(BaseMeshError::NotFinite { vertex: vertex as u32 });
    }
    for (face, vertices) in (0u32..).zip(&base.faces) {
        vertices.iter().try_for_each(|&v| in_range(&|| format!("face {face}"), v))?;
        check_face(face, vertices, base.poles.get(&face).copied())?;
    }
    if let Some((&face, _)) = base.poles.iter().find(|&(&face, _)| face as usize >= base.faces.len()) {
        return Err(BaseMeshError::FaceOutOfRange { face, count: base.faces.len() });
    }
    if base.corners.len() > MAX_CORNERS {
        return Err(BaseMeshError::TooManyCorners { count: base.corners.len() });
    }
    for (corner, vertices) in base.corners.iter().enumerate() {
        vertices.iter().try_for_each(|&v| in_range(&|| format!("corner {corner}"), v))?;
    }
    let marker = base.marker.iter().flatten();
    marker.copied().try_for_each(|v| in_range(&|| "the marker".into(), v))
}

fn check_face(face: u32, vertices: &[u32], pole: Option<u32>) -> Result<(), BaseMeshError> {
    let repeated = vertices.iter().enumerate().find(|&(i, v)| vertices[..i].contains(v));
    match (vertices.len(), pole) {
        (3, None) => Err(BaseMeshError::TriangleWithoutPole { face }),
        (4, Some(pole)) => Err(BaseMeshError::QuadWithPole { face, pole }),
        (3 | 4, _) => match (repeated, pole) {
            (Some((_, &vertex)), _) => Err(BaseMeshError::RepeatedVertex { face, vertex }),
            (None, Some(pole)) if !vertices.contains(&pole) => {
                Err(BaseMeshError::PoleNotInFace { face, pole, vertices: vertices.to_vec() })
            }
            _ => Ok(()),
        },
        (corners, _) => Err(BaseMeshError::FaceSize { face, corners }),
    }
}

/// One dart for each side of each face, in the order of the input, glued where two faces share an edge.
/// A dart not yet glued is its own twin.
fn add_inside_darts(
    mesh: &mut QuadMesh,
    base: &BaseMesh,
) -> Result<BTreeMap<(u32, u32), DartId>, BaseMeshError> {
    let mut edges: BTreeMap<(u32, u32), DartId> = BTreeMap::new();
    for (face, vertices) in (0u32..).zip(&base.faces) {
        let first = mesh.darts.len() as u32;
        let count = vertices.len() as u32;
        for k in 0..count {
            let (u, v) = (vertices[k as usize], vertices[((k + 1) % count) as usize]);
            let d = DartId(first + k);
            if let Some(&other) = edges.get(&(u, v)) {
                let other = mesh.left(other).as_face().map_or(0, |face| face.0);
                return Err(if edges.contains_key(&(v, u)) {
                    BaseMeshError::NonManifoldEdge { edge: [u, v], face }
                } else {
                    BaseMeshError::InconsistentWinding { first: other, second: face, edge: [u, v] }
                });
            }
            mesh.darts.push(super::quad_mesh::Dart {
                next: DartId(first + (k + 1) % count),
                prev: DartId(first + (k + count - 1) % count),
                twin: edges.get(&(v, u)).copied().unwrap_or(d),
                origin: VertexId(u),
                left: Left::face(FaceId(face)),
                strip: StripId(u32::MAX),
                pole: base.poles.get(&face) == Some(&u),
                frozen: false,
            });
            let twin = mesh.twin(d);
            mesh.at(twin).twin = d;
            edges.insert((u, v), d);
        }
    }
    Ok(edges)
}

/// Gives every unglued dart an outside twin and closes these into loops; checks that every vertex has one fan.
fn add_outside_darts(mesh: &mut QuadMesh) -> Result<(), BaseMeshError> {
    let inside = mesh.darts.len();
    let mut outside_from: Vec<Option<DartId>> = vec![None; mesh.vertex_count()];
    for d in (0..inside as u32).map(DartId) {
        if mesh.twin(d) != d {
            continue;
        }
        let origin = mesh.end(d);
        let outside = DartId(mesh.darts.len() as u32);
        if outside_from[origin.index()].replace(outside).is_some() {
            return Err(BaseMeshError::NonManifoldVertex { vertex: origin.0 });
        }
        mesh.darts.push(super::quad_mesh::Dart {
            twin: d,
            next: outside,
            prev: outside,
            origin,
            left: Left::outside(0),
            ..*mesh.dart(d)
        });
        mesh.at(d).twin = outside;
        mesh.at(outside).pole = false;
    }
    for outside in (inside as u32..mesh.darts.len() as u32).map(DartId) {
        let end = mesh.origin(mesh.twin(outside));
        // A boundary edge ends at `end`, so its fan there has another boundary edge, and that leaves `end`.
        let next = outside_from[end.index()].ok_or(BaseMeshError::NonManifoldVertex { vertex: end.0 })?;
        mesh.link(outside, next);
    }
    check_fans(mesh)
}

fn check_fans(mesh: &QuadMesh) -> Result<(), BaseMeshError> {
    let mut first: Vec<Option<DartId>> = vec![None; mesh.vertex_count()];
    let valences = mesh.valences();
    for d in mesh.darts() {
        first[mesh.origin(d).index()].get_or_insert(d);
    }
    for (vertex, (first, valence)) in (0u32..).zip(first.iter().zip(valences)) {
        match first {
            None => return Err(BaseMeshError::VertexWithoutFace { vertex }),
            Some(d) if mesh.around(*d).count() != valence => {
                return Err(BaseMeshError::NonManifoldVertex { vertex });
            }
            Some(_) => {}
        }
    }
    Ok(())
}

fn check_connected(mesh: &QuadMesh) -> Result<(), BaseMeshError> {
    let mut reached = vec![false; mesh.face_count()];
    let mut pending = vec![DartId(0)];
    while let Some(d) = pending.pop() {
        if let Some(face) = mesh.left(d).as_face()
            && !std::mem::replace(&mut reached[face.index()], true)
        {
            pending.extend(mesh.along(d).map(|e| mesh.twin(e)));
        }
    }
    match reached.iter().position(|&reached| !reached) {
        Some(face) => Err(BaseMeshError::Disconnected { face: face as u32 }),
        None => Ok(()),
    }
}

fn label_loops(mesh: &mut QuadMesh) -> Result<(), BaseMeshError> {
    let mut seen = vec![false; mesh.darts.len()];
    let mut loops: Vec<Vec<DartId>> = Vec::new();
    for d in mesh.darts().filter(|&d| mesh.is_outside(d)) {
        if !seen[d.index()] {
            let darts: Vec<DartId> = mesh.along(d).collect();
            darts.iter().for_each(|e| seen[e.index()] = true);
            loops.push(darts);
        }
    }
    if let Some(short) = loops.iter().find(|darts| darts.len() < 3) {
        let vertices = short.iter().map(|&d| mesh.origin(d).0).collect();
        return Err(BaseMeshError::ShortBoundary { vertices });
    }
    loops.sort_by_key(|darts| darts.iter().map(|&d| mesh.origin(d)).min());
    let areas: Vec<f64> = loops.iter().map(|darts| area_xy(mesh, darts)).collect();
    let mut outer = 0;
    for (label, area) in areas.iter().enumerate() {
        if *area > areas[outer] {
            outer = label;
        }
    }
    if outer > 0 {
        let darts = loops.remove(outer);
        loops.insert(0, darts);
    }
    mesh.loop_count = loops.len() as u32;
    for (label, darts) in (0u32..).zip(&loops) {
        darts.iter().for_each(|&d| mesh.at(d).left = Left::outside(label));
    }
    Ok(())
}

/// Absolute area of a loop's projection on the xy plane, m² (shoelace formula).
fn area_xy(mesh: &QuadMesh, darts: &[DartId]) -> f64 {
    let doubled: f64 = darts
        .iter()
        .map(|&d| {
            let ([x0, y0, _], [x1, y1, _]) = (mesh.position(mesh.origin(d)), mesh.position(mesh.end(d)));
            x0 * y1 - x1 * y0
        })
        .sum();
    doubled.abs() / 2.0
}

/// Labels 0, 1, 2, … in the order in which a strip's first edge comes when faces are read in order and each face's
/// edges in order (docs/reference/grammar.md §5): the order in which inside darts were made.
pub(super) fn label_strips(mesh: &mut QuadMesh) {
    for d in mesh.darts() {
        if mesh.strip(d).0 == u32::MAX {
            let label = mesh.push_strip();
            super::strips::relabel(mesh, d, label);
        }
    }
}

fn mark_corners(mesh: &mut QuadMesh, base: &BaseMesh) -> Result<(), BaseMeshError> {
    let boundary = mesh.boundary_vertices();
    for (corner, vertices) in base.corners.iter().enumerate() {
        for &vertex in vertices {
            if !boundary[vertex as usize] {
                return Err(BaseMeshError::CornerInside { corner, vertex });
            }
            mesh.marks.push(Mark { corner: corner as u32, vertex: VertexId(vertex), sharp: true });
        }
    }
    mesh.marks.sort_unstable();
    mesh.marks.dedup();
    Ok(())
}
