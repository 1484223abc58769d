//! COMPAS 2 JSON (`compas.datastructures/Mesh`), as COMPAS 2.15 reads it.

use super::polygons::Polygons;
use serde_json::{Map, Value, json};

/// A mesh as a COMPAS mesh, in metres, z up; each panel carries the number of its coarse face.
///
/// No `guid`: it would be drawn at random. Non-finite numbers do not occur in a mesh.
pub fn compas(mesh: &Polygons<'_>, id: &str) -> Vec<u8> {
    let numbered = |values: Vec<Value>| -> Map<String, Value> {
        values.into_iter().enumerate().map(|(key, value)| (key.to_string(), value)).collect()
    };
    let vertices = mesh.positions.iter().map(|[x, y, z]| json!({"x": x, "y": y, "z": z})).collect();
    let faces = mesh.faces.iter().map(|face| json!(face)).collect();
    let face_data = mesh.coarse_faces.iter().map(|face| json!({"coarse_face": face})).collect();
    let last = |count: usize| count as i64 - 1;
    let document = json!({
        "dtype": "compas.datastructures/Mesh",
        "data": {
            "attributes": {
                "name": id,
                "units": "m",
                "program": concat!("quadrille ", env!("CARGO_PKG_VERSION")),
            },
            "default_vertex_attributes": {"x": 0.0, "y": 0.0, "z": 0.0},
            "default_edge_attributes": {},
            "default_face_attributes": {},
            "vertex": numbered(vertices),
            "face": numbered(faces),
            "facedata": numbered(face_data),
            "edgedata": {},
            "max_vertex": last(mesh.positions.len()),
            "max_face": last(mesh.faces.len()),
        },
        "inheritance": [],
        "name": id,
    });
    let mut bytes = document.to_string().into_bytes();
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
}
