//! Wavefront OBJ.

use super::number::{push_integer, push_shortest};
use super::polygons::Polygons;

/// A mesh as OBJ: metres, z up, positive indices, all digits.
///
/// COMPAS welds vertices at 3 decimals unless it is told otherwise: `Mesh.from_obj(path, precision=9)`.
pub fn obj(mesh: &Polygons<'_>, id: &str) -> Vec<u8> {
    let mut text = format!("# quadrille {}\n# units: m\n# z up\no {id}\n", env!("CARGO_PKG_VERSION"));
    for position in mesh.positions {
        text.push('v');
        for &coordinate in position {
            text.push(' ');
            push_shortest(&mut text, coordinate);
        }
        text.push('\n');
    }
    for face in &mesh.faces {
        text.push('f');
        for vertex in *face {
            text.push(' ');
            push_integer(&mut text, vertex + 1);
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
        let text = String::from_utf8(obj(&Polygons::from(&square_with_pole()), "0123456789ab")).unwrap();
        let expected = "# units: m\n# z up\no 0123456789ab\n\
            v 0 0 0\nv 1 0 0\nv 2 0.3333333333333333 0\nv 0 1 0.5\nv 1 1 0.25\nf 1 2 5 4\nf 3 5 2\n";
        assert!(text.ends_with(expected), "{text}");
    }
}
