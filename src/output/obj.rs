//! Wavefront OBJ.

use super::number::shortest;
use crate::geometry::Pattern;
use std::fmt::Write;

/// A pattern as OBJ: metres, z up, positive indices, quads and triangles, all digits.
///
/// COMPAS welds vertices at 3 decimals unless it is told otherwise: `Mesh.from_obj(path, precision=9)`.
pub fn obj(pattern: &Pattern, id: &str) -> Vec<u8> {
    let mut text = format!("# quadrille {}\n# units: m\n# z up\no {id}\n", env!("CARGO_PKG_VERSION"));
    for position in &pattern.positions {
        let [x, y, z] = position.map(|c| shortest(c).unwrap_or_default());
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    for panel in &pattern.panels {
        text.push('f');
        for vertex in panel.corners() {
            let _ = write!(text, " {}", vertex + 1);
        }
        text.push('\n');
    }
    text.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::sample::square_with_pole;

    #[test]
    fn is_written_whole() {
        let text = String::from_utf8(obj(&square_with_pole(), "0123456789ab")).unwrap();
        let expected = "# units: m\n# z up\no 0123456789ab\n\
            v 0 0 0\nv 1 0 0\nv 2 0.3333333333333333 0\nv 0 1 0.5\nv 1 1 0.25\nf 1 2 5 4\nf 3 5 2\n";
        assert!(text.ends_with(expected), "{text}");
    }
}
