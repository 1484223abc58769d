//! The coarse mesh as Wavefront OBJ.

use super::{Reading, faces};
use crate::output::number::shortest;
use std::fmt::Write as _;

/// Vertices (m, z up) and faces; pseudo-quads are triangles that begin with their pole.
pub fn obj(reading: Reading<'_>) -> String {
    let mesh = &reading.decoded.mesh;
    let mut text = format!("# quadrille coarse mesh of \"{}\"\n# units: m, z up\no coarse\n", reading.string);
    for position in mesh.positions() {
        let [x, y, z] = position.map(|x| shortest(x).unwrap_or_default());
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    for face in faces(mesh) {
        let corners: Vec<String> = face.iter().map(|v| (v + 1).to_string()).collect();
        let _ = writeln!(text, "f {}", corners.join(" "));
    }
    text
}
