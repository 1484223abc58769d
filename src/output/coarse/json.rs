//! The JSON of `decode`; what it says of the mesh loads again as a base mesh.

use super::{Reading, Singularities, faces, singularities};
use crate::grammar::{Decoded, Effect};
use crate::mesh::code::{code, rooted_code};
use crate::mesh::{DartId, Equivalence, QuadMesh, strips};
use serde::Serialize;
use std::collections::BTreeMap;

#[derive(Serialize)]
struct Document {
    vertices: Vec<[f64; 3]>,
    faces: Vec<Vec<u32>>,
    poles: BTreeMap<usize, u32>,
    marker: [u32; 2],
    corners: Vec<Vec<u32>>,
    loops: Vec<Vec<u32>>,
    string: String,
    expressed: String,
    trace: Vec<Record>,
    strips: Vec<Strip>,
    summary: Summary,
    code: String,
    code_reduced: String,
    code_placed: String,
    code_placed_reduced: String,
    code_marker: String,
    /// The part that was decoded, where patterns are to be symmetric.
    #[serde(skip_serializing_if = "Option::is_none")]
    part: Option<Part>,
}

/// A part of a symmetric mesh.
#[derive(Serialize)]
struct Part {
    vertices: Vec<[f64; 3]>,
    faces: Vec<Vec<u32>>,
    poles: BTreeMap<usize, u32>,
    marker: [u32; 2],
    corners: Vec<Vec<u32>>,
    strips: Vec<Strip>,
    /// The edges of each fold's seams.
    seams: BTreeMap<u32, Vec<[u32; 2]>>,
}

impl Part {
    fn of(decoded: &Decoded) -> Self {
        let mesh = &decoded.mesh;
        let edge = |d: DartId| [mesh.origin(d).0, mesh.end(d).0];
        let mut seams: BTreeMap<u32, Vec<[u32; 2]>> = BTreeMap::new();
        for d in mesh.darts() {
            if let Some(fold) = mesh.left(d).as_seam() {
                seams.entry(fold).or_default().push(edge(d));
            }
        }
        Self {
            vertices: mesh.positions().to_vec(),
            faces: faces(mesh),
            poles: poles(mesh),
            marker: edge(decoded.marker),
            corners: corners(mesh),
            strips: strips(mesh),
            seams,
        }
    }
}

#[derive(Serialize)]
struct Record {
    token: &'static str,
    #[serde(flatten)]
    effect: Outcome,
}

#[derive(Serialize)]
#[serde(tag = "effect", rename_all = "lowercase")]
enum Outcome {
    Turned,
    Pivoted,
    Collecting,
    Added { strip: u32, edges: usize, faces: usize, ends: Vec<&'static str> },
    Deleted { strip: u32, refined: Vec<Refined> },
    Skipped { reason: String },
}

#[derive(Serialize)]
struct Refined {
    strip: u32,
    into: usize,
}

#[derive(Serialize)]
struct Strip {
    label: u32,
    closed: bool,
    poles: u8,
    edges: Vec<[u32; 2]>,
}

#[derive(Serialize)]
struct Summary {
    vertices: usize,
    edges: usize,
    faces: usize,
    euler: i64,
    boundary_loops: Vec<usize>,
    singularities: Singularities,
}

/// One line of JSON: mesh, marker, loops, trace, strips, summary and codes.
///
/// # Errors
/// What the JSON writer says.
pub fn json(reading: Reading<'_>) -> Result<String, serde_json::Error> {
    let decoded = reading.decoded;
    let mesh = &decoded.mesh;
    let origin = |d: DartId| mesh.origin(d).0;
    let equivalence = Equivalence::default();
    let records = reading.string.iter().zip(&decoded.trace);
    let document = Document {
        vertices: mesh.positions().to_vec(),
        faces: faces(mesh),
        poles: poles(mesh),
        marker: [origin(decoded.marker), mesh.end(decoded.marker).0],
        corners: corners(mesh),
        loops: loops(mesh),
        string: reading.string.to_string(),
        expressed: decoded.expressed.to_string(),
        trace: records
            .map(|(token, effect)| Record { token: token.as_str(), effect: outcome(effect) })
            .collect(),
        strips: strips(mesh),
        summary: summary(mesh),
        code: code(mesh, false).to_string(),
        code_reduced: Equivalence { placed: false, ..equivalence }.code(mesh).to_string(),
        code_placed: code(mesh, true).to_string(),
        code_placed_reduced: equivalence.code(mesh).to_string(),
        code_marker: rooted_code(mesh, decoded.marker, false).to_string(),
        part: reading.part.map(Part::of),
    };
    serde_json::to_string(&document)
}

fn corners(mesh: &QuadMesh) -> Vec<Vec<u32>> {
    mesh.corners().iter().map(|carriers| carriers.iter().map(|v| v.0).collect()).collect()
}

fn poles(mesh: &QuadMesh) -> BTreeMap<usize, u32> {
    let first = mesh.face_darts().into_iter().enumerate();
    first.filter(|&(_, d)| mesh.dart(d).pole).map(|(face, d)| (face, mesh.origin(d).0)).collect()
}

/// Each loop from its lowest vertex number on, so that the list does not depend on the numbers of darts.
fn loops(mesh: &QuadMesh) -> Vec<Vec<u32>> {
    let from_lowest = |darts: &Vec<DartId>| {
        let mut vertices: Vec<u32> = darts.iter().map(|&d| mesh.origin(d).0).collect();
        let lowest = (0..vertices.len()).min_by_key(|&i| vertices[i]).unwrap_or(0);
        vertices.rotate_left(lowest);
        vertices
    };
    mesh.loops().iter().map(from_lowest).collect()
}

fn outcome(effect: &Effect) -> Outcome {
    match effect {
        Effect::Turned => Outcome::Turned,
        Effect::Pivoted => Outcome::Pivoted,
        Effect::Collecting => Outcome::Collecting,
        Effect::Added(added) => Outcome::Added {
            strip: added.strip.0,
            edges: added.edges,
            faces: added.faces,
            ends: added.ends(),
        },
        Effect::Deleted(deleted) => Outcome::Deleted {
            strip: deleted.strip.0,
            refined: deleted.refined.iter().map(|&(strip, into)| Refined { strip: strip.0, into }).collect(),
        },
        Effect::Skipped(skip) => Outcome::Skipped { reason: skip.to_string() },
    }
}

fn strips(mesh: &QuadMesh) -> Vec<Strip> {
    let edge = |d: DartId| [mesh.origin(d).0, mesh.end(d).0];
    strips::all(mesh)
        .into_iter()
        .map(|chain| Strip {
            label: chain.label.0,
            closed: chain.closed,
            poles: chain.pole_count(),
            edges: chain.darts.iter().map(|&d| edge(d)).collect(),
        })
        .collect()
}

fn summary(mesh: &QuadMesh) -> Summary {
    let mut boundary_loops: Vec<usize> = mesh.loops().iter().map(Vec::len).collect();
    boundary_loops.sort_unstable();
    Summary {
        vertices: mesh.vertex_count(),
        edges: mesh.edge_count(),
        faces: mesh.face_count(),
        euler: mesh.euler_characteristic(),
        boundary_loops,
        singularities: singularities(mesh),
    }
}
