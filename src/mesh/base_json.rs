//! Base mesh files: `{"vertices", "faces", "poles", "marker", "corners"}` (docs/reference/files.md §3.1).

use std::collections::BTreeMap;

use serde::Deserialize;

use super::base::BaseMesh;
use crate::json::{self, JsonError};

/// A base mesh file that cannot be read. The message names the key and, for broken JSON, line and column.
#[derive(Debug, thiserror::Error)]
pub enum BaseJsonError {
    /// Not JSON, or not of this shape.
    #[error(transparent)]
    Shape(#[from] JsonError),
    /// A key of `poles` that is no face number.
    #[error("poles: {key:?} is not a face number")]
    PoleKey {
        /// The key as found.
        key: String,
    },
}

#[derive(Deserialize)]
#[serde(expecting = "an object with the keys vertices and faces")]
struct File {
    vertices: Vec<[f64; 3]>,
    faces: Vec<Vec<u32>>,
    #[serde(default)]
    poles: BTreeMap<String, u32>,
    #[serde(default)]
    marker: Option<[u32; 2]>,
    #[serde(default)]
    corners: Vec<Corner>,
}

#[derive(Deserialize)]
#[serde(untagged, expecting = "expected a vertex number or a list of vertex numbers")]
enum Corner {
    One(u32),
    Several(Vec<u32>),
}

/// Reads a base mesh; keys other than the five are ignored. Nothing is checked here but the shape of the file:
/// that is [`InitialMesh::from_base`](super::InitialMesh::from_base)'s.
///
/// # Errors
/// Where the file is not as described.
pub fn read(text: &str) -> Result<BaseMesh, BaseJsonError> {
    let file: File = json::read(text)?;
    let mut poles = BTreeMap::new();
    for (key, pole) in file.poles {
        match key.parse::<u32>() {
            Ok(face) if face.to_string() == key => poles.insert(face, pole),
            _ => return Err(BaseJsonError::PoleKey { key }),
        };
    }
    let corners = file.corners.into_iter().map(|corner| match corner {
        Corner::One(vertex) => vec![vertex],
        Corner::Several(vertices) => vertices,
    });
    Ok(BaseMesh {
        vertices: file.vertices,
        faces: file.faces,
        poles,
        marker: file.marker,
        corners: corners.collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn optional_keys_and_both_forms_of_corners() {
        let base =
            read(r#"{"vertices": [[0, 0, 0]], "faces": [], "corners": [0, [1, 2], []], "note": 1}"#).unwrap();
        assert_eq!(base.corners, [vec![0], vec![1, 2], vec![]]);
        assert_eq!(base.marker, None);
    }

    #[test]
    fn errors_name_the_key() {
        let message = |text: &str| read(text).unwrap_err().to_string();
        assert!(message(r#"{"vertices": [[0, 0, "x"]], "faces": []}"#).starts_with("vertices[0][2]: "));
        assert!(message(r#"{"vertices": [[0, 0, NaN]], "faces": []}"#).contains("line 1 column"));
        assert!(message(r#"{"vertices": [], "faces": [[0, -1, 2]]}"#).starts_with("faces[0][1]: "));
        assert!(message(r#"{"vertices": []}"#).contains("missing key `faces`"));
        assert!(message(r#"{"vertices": [], "faces": [], "poles": {"a": 0}}"#).contains("\"a\""));
        assert!(message(r#"{"vertices": [], "faces": [], "corners": ["x"]}"#).contains("corners[0]"));
    }
}
