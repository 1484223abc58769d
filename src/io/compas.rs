//! Meshes in COMPAS JSON: 2.x, the 1.x wrapper, and the bare dictionaries before it (docs/reference/files.md §4).

use super::text::decode;
use super::{Input, ReadError};
use crate::json;
use crate::mesh::BaseMesh;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// Reads the first mesh of a file: vertices in the order of their keys, faces in that of theirs, and the poles of a COMPAS
/// pseudo-quad mesh (`face_pole`).
///
/// # Errors
/// Broken JSON with its line, no mesh in it, or the key whose value is wrong.
pub fn read(Input { file, bytes }: Input<'_>) -> Result<BaseMesh, ReadError> {
    let text =
        decode(bytes).map_err(|(line, reason)| ReadError::Line { file: file.to_owned(), line, reason })?;
    let content = |reason: String| ReadError::Content { file: file.to_owned(), reason };
    let value: Value = json::read(&text).map_err(|error| content(error.to_string()))?;
    from_value(&value).map_err(content)
}

/// Reads the first mesh in a JSON value.
///
/// # Errors
/// What is wrong, with its key.
pub fn from_value(value: &Value) -> Result<BaseMesh, String> {
    let data = find_mesh(value, 0).ok_or("no mesh found: an object with the keys `vertex` and `face`")?;
    let defaults = ["default_vertex_attributes", "dva"].iter().find_map(|k| data.get(*k)?.as_object());
    let vertices = keyed(data, "vertex")?;
    let mut mesh = BaseMesh::default();
    let mut number = BTreeMap::new();
    for (key, attributes) in vertices {
        number.insert(key, mesh.vertices.len() as u32);
        mesh.vertices.push(position(key, attributes, defaults)?);
    }
    let mut face_number = BTreeMap::new();
    for (key, corners) in keyed(data, "face")? {
        face_number.insert(key, mesh.faces.len() as u32);
        mesh.faces.push(face(key, corners, &number)?);
    }
    let poles = [data.get("attributes"), Some(&Value::Object(data.clone()))]
        .into_iter()
        .flatten()
        .find_map(|v| v.get("face_pole")?.as_object().cloned());
    for (key, pole) in poles.unwrap_or_default() {
        let found = key.parse().ok().and_then(|k: u64| face_number.get(&k));
        let vertex = id(&pole).and_then(|p| number.get(&p));
        let (Some(&f), Some(&v)) = (found, vertex) else {
            return Err(format!("face_pole.{key}: {pole} is not a vertex of a face"));
        };
        mesh.poles.insert(f, v);
    }
    Ok(mesh)
}

/// The first object that has both `vertex` and `face`, at most a few levels down (`data`, `value`, lists of meshes).
fn find_mesh(value: &Value, depth: usize) -> Option<&Map<String, Value>> {
    if depth > 8 {
        return None;
    }
    match value {
        Value::Object(object) if object.contains_key("vertex") && object.contains_key("face") => Some(object),
        Value::Object(object) => object.values().find_map(|v| find_mesh(v, depth + 1)),
        Value::Array(items) => items.iter().find_map(|v| find_mesh(v, depth + 1)),
        _ => None,
    }
}

/// The entries of an object whose keys are whole numbers, in their order. Keys may be quoted twice, as in the oldest files.
fn keyed<'a>(data: &'a Map<String, Value>, name: &str) -> Result<Vec<(u64, &'a Value)>, String> {
    let object = data.get(name).and_then(Value::as_object).ok_or(format!("{name} must be an object"))?;
    let mut entries = object
        .iter()
        .map(|(key, value)| match key.trim_matches(['\'', '"']).parse() {
            Ok(number) => Ok((number, value)),
            Err(_) => Err(format!("{name}: the key {key:?} is not a whole number")),
        })
        .collect::<Result<Vec<_>, _>>()?;
    entries.sort_by_key(|&(number, _)| number);
    Ok(entries)
}

fn position(key: u64, attributes: &Value, defaults: Option<&Map<String, Value>>) -> Result<[f64; 3], String> {
    let mut position = [0.0_f64; 3];
    for (value, axis) in position.iter_mut().zip(["x", "y", "z"]) {
        let given = attributes.get(axis).or_else(|| defaults?.get(axis));
        match given.and_then(Value::as_f64) {
            Some(number) if number.is_finite() => *value = number,
            _ => {
                let found = given.map_or("nothing".to_owned(), Value::to_string);
                return Err(format!("vertex.{key}.{axis} must be a finite number, found {found}"));
            }
        }
    }
    Ok(position)
}

fn face(key: u64, corners: &Value, number: &BTreeMap<u64, u32>) -> Result<Vec<u32>, String> {
    let list = corners.as_array().ok_or(format!("face.{key} must be a list of vertices"))?;
    list.iter()
        .map(|v| {
            id(v).and_then(|v| number.get(&v).copied()).ok_or(format!("face.{key}: {v} is not a vertex"))
        })
        .collect()
}

/// A key given as a number or as a string.
fn id(value: &Value) -> Option<u64> {
    value.as_u64().or_else(|| value.as_str()?.parse().ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<BaseMesh, String> {
        from_value(&serde_json::from_str(text).unwrap())
    }

    #[test]
    fn all_layouts() {
        let vertices =
            r#"{"0":{"x":0,"y":0},"7":{"x":1,"y":0.5,"z":2},"10":{"y":1,"x":1},"3":{"x":0,"y":1}}"#;
        let inner = format!(
            r#""default_vertex_attributes":{{"x":0.0,"y":0.0,"z":0.25}},"vertex":{vertices},"face":{{"4":[0,7,10,3]}}"#
        );
        let new = format!(r#"{{"dtype":"compas.datastructures/Mesh","data":{{{inner}}},"guid":"x"}}"#);
        let wrapper = format!(r#"{{"dtype":"compas.datastructures/Mesh","value":{{{inner}}}}}"#);
        let nested = format!(r#"{{"note":1,"meshes":[{new}]}}"#);
        let old = format!(
            r#"{{"attributes":{{}},"dva":{{"z":0.25}},"dea":{{}},"dfa":{{}},"vertex":{vertices},"face":{{"4":["0","7","10","3"]}},"max_int_key":10}}"#
        );
        for text in [new, wrapper, nested, old] {
            let mesh = parse(&text).unwrap();
            assert_eq!(
                mesh.vertices,
                [[0.0, 0.0, 0.25], [0.0, 1.0, 0.25], [1.0, 0.5, 2.0], [1.0, 1.0, 0.25]],
                "{text}"
            );
            assert_eq!(mesh.faces, [[0, 2, 3, 1]]);
        }
    }

    #[test]
    fn poles_come_along() {
        let text = r#"{"dtype":"x","data":{"attributes":{"face_pole":{"3":9}},"face":{"3":[4,9,5]},
            "vertex":{"4":{"x":0,"y":0,"z":0},"5":{"x":1,"y":0,"z":0},"9":{"x":0,"y":1,"z":0}}}}"#;
        let mesh = parse(text).unwrap();
        assert_eq!(mesh.faces, [[0, 2, 1]]);
        assert_eq!(mesh.poles, BTreeMap::from([(0, 2)]));
    }

    #[test]
    fn faults_name_their_key() {
        for (text, part) in [
            (r#"{"a":1}"#, "no mesh found"),
            (r#"{"vertex":[],"face":{}}"#, "vertex must be an object"),
            (r#"{"vertex":{"a":{}},"face":{}}"#, "not a whole number"),
            (
                r#"{"vertex":{"0":{"x":null,"y":0,"z":0}},"face":{}}"#,
                "vertex.0.x must be a finite number, found null",
            ),
            (r#"{"vertex":{"0":{"x":1,"y":0}},"face":{}}"#, "vertex.0.z"),
            (r#"{"vertex":{"0":{"x":1,"y":0,"z":0}},"face":{"2":[0,5]}}"#, "face.2: 5 is not a vertex"),
            (r#"{"vertex":{"0":{"x":1,"y":0,"z":0}},"face":{"2":{}}}"#, "face.2 must be a list"),
        ] {
            let error = parse(text).unwrap_err();
            assert!(error.contains(part), "{text}: {error}");
        }
    }
}
