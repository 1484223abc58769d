//! COMPAS 2 JSON (`compas.datastructures/Mesh`), as COMPAS 2.15 reads it.

use super::polygons::Polygons;
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;

#[derive(Serialize)]
struct Document<'a> {
    dtype: &'static str,
    data: Data<'a>,
    inheritance: [(); 0],
    name: &'a str,
}

/// Vertices and faces by number, in that order: COMPAS lists them as they stand in the file, and tables by nodes are
/// then told apart by place alone.
#[derive(Serialize)]
struct Data<'a> {
    attributes: Value,
    default_vertex_attributes: Value,
    default_edge_attributes: Value,
    default_face_attributes: Value,
    vertex: BTreeMap<usize, Vertex>,
    face: BTreeMap<usize, &'a [u32]>,
    facedata: BTreeMap<usize, FaceData>,
    edgedata: Value,
    max_vertex: i64,
    max_face: i64,
}

#[derive(Serialize)]
struct Vertex {
    x: f64,
    y: f64,
    z: f64,
}

#[derive(Serialize)]
struct FaceData {
    coarse_face: u32,
}

/// A mesh as a COMPAS mesh, in metres, z up; each panel carries the number of its coarse face.
///
/// No `guid`: it would be drawn at random. Non-finite numbers do not occur in a mesh.
pub fn compas(mesh: &Polygons<'_>, id: &str) -> Vec<u8> {
    let last = |count: usize| count as i64 - 1;
    let data = Data {
        attributes: json!({
            "name": id,
            "units": "m",
            "program": concat!("quadrille ", env!("CARGO_PKG_VERSION")),
        }),
        default_vertex_attributes: json!({"x": 0.0, "y": 0.0, "z": 0.0}),
        default_edge_attributes: json!({}),
        default_face_attributes: json!({}),
        vertex: mesh.positions.iter().map(|&[x, y, z]| Vertex { x, y, z }).enumerate().collect(),
        face: mesh.faces.iter().copied().enumerate().collect(),
        facedata: mesh.coarse_faces.iter().map(|&coarse_face| FaceData { coarse_face }).enumerate().collect(),
        edgedata: json!({}),
        max_vertex: last(mesh.positions.len()),
        max_face: last(mesh.faces.len()),
    };
    let document = Document { dtype: "compas.datastructures/Mesh", data, inheritance: [], name: id };
    // Plain numbers and text under string keys: there is nothing in it that JSON has no form for.
    let mut bytes = serde_json::to_vec(&document).unwrap_or_default();
    bytes.push(b'\n');
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::sample::square_with_pole;

    #[test]
    fn has_every_key_of_the_schema() {
        let mesh: Value =
            serde_json::from_slice(&compas(&Polygons::from(&square_with_pole()), "0123456789ab")).unwrap();
        assert_eq!(mesh["dtype"], "compas.datastructures/Mesh");
        let keys: Vec<&str> = mesh["data"].as_object().unwrap().keys().map(String::as_str).collect();
        let expected = [
            "attributes",
            "default_edge_attributes",
            "default_face_attributes",
            "default_vertex_attributes",
            "edgedata",
            "face",
            "facedata",
            "max_face",
            "max_vertex",
            "vertex",
        ];
        assert_eq!(keys, expected);
        assert_eq!(mesh["data"]["vertex"]["2"], json!({"x": 2.0, "y": 1.0 / 3.0, "z": 0.0}));
        assert_eq!(mesh["data"]["face"]["1"], json!([2, 4, 1]));
        assert_eq!(mesh["data"]["max_vertex"], 4);
    }
    #[test]
    fn vertices_stand_in_the_order_of_their_numbers() {
        let positions: Vec<[f64; 3]> = (0..12).map(|k| [f64::from(k), 0.0, 0.0]).collect();
        let mesh = Polygons { positions: &positions, faces: vec![&[0, 1, 2]; 12], coarse_faces: &[0; 12] };
        let text = String::from_utf8(compas(&mesh, "a")).unwrap();
        for places in ["\"2\":{\"x\":2.0", "\"3\":[0,1,2]", "\"9\":{\"coarse_face\":0},\"10\""] {
            assert!(text.contains(places), "{text}");
        }
        let place = |key: &str| text.find(key).unwrap();
        assert!(place("\"9\":{\"x\"") < place("\"10\":{\"x\"") && place("\"9\":[") < place("\"10\":["));
    }
}
