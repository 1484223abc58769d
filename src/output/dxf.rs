//! DXF: edges as lines, faces as 3D faces, on layers (docs/reference/files.md §7).
//!
//! Release 12 (AC1009), which every program reads and which needs neither handles nor classes. It knows no unit: metres, z up.

use super::number::shortest;
use super::polygons::Polygons;
use std::collections::BTreeMap;

/// Layers, and their colours of the AutoCAD index.
const LAYERS: [(&str, u8); 4] = [("MEMBERS", 7), ("BOUNDARY", 1), ("PANELS", 8), ("SUPPORTS", 3)];

/// A mesh with its supports: edges on MEMBERS, those of one face alone on BOUNDARY, faces on PANELS, supports as points on SUPPORTS.
/// A face of more than four corners is a fan of triangles whose inner edges are hidden.
pub fn dxf(mesh: &Polygons<'_>, supports: &[[f64; 3]], id: &str) -> Vec<u8> {
    let mut file = Groups(String::new());
    file.comment(&format!("quadrille {}: design {id}; metres, z up", env!("CARGO_PKG_VERSION")));
    file.section("HEADER", |file| {
        file.text(9, "$ACADVER");
        file.text(1, "AC1009");
    });
    file.section("TABLES", |file| {
        file.text(0, "TABLE");
        file.text(2, "LAYER");
        file.text(70, &LAYERS.len().to_string());
        for (name, colour) in LAYERS {
            file.text(0, "LAYER");
            file.text(2, name);
            file.text(70, "0");
            file.text(62, &colour.to_string());
            file.text(6, "CONTINUOUS");
        }
        file.text(0, "ENDTAB");
    });
    file.section("ENTITIES", |file| {
        for ([a, b], faces) in edges(mesh) {
            file.entity("LINE", if faces == 1 { "BOUNDARY" } else { "MEMBERS" });
            file.point(0, mesh.positions[a as usize]);
            file.point(1, mesh.positions[b as usize]);
        }
        for face in &mesh.faces {
            let corners: Vec<[f64; 3]> = face.iter().map(|&v| mesh.positions[v as usize]).collect();
            file.face(&corners);
        }
        for &support in supports {
            file.entity("POINT", "SUPPORTS");
            file.point(0, support);
        }
    });
    file.text(0, "EOF");
    file.0.into_bytes()
}

/// Every edge once, sorted, and how many faces it has.
fn edges(mesh: &Polygons<'_>) -> BTreeMap<[u32; 2], usize> {
    let mut edges = BTreeMap::new();
    for face in &mesh.faces {
        for (i, &a) in face.iter().enumerate() {
            let b = face[(i + 1) % face.len()];
            *edges.entry([a.min(b), a.max(b)]).or_insert(0) += 1;
        }
    }
    edges
}

/// Pairs of a group code and a value, each on its own line.
struct Groups(String);

impl Groups {
    fn text(&mut self, code: u16, value: &str) {
        self.0.push_str(&format!("{code:>3}\n{value}\n"));
    }

    /// A comment is one line of ASCII.
    fn comment(&mut self, text: &str) {
        self.text(999, text);
    }

    fn section(&mut self, name: &str, content: impl FnOnce(&mut Self)) {
        self.text(0, "SECTION");
        self.text(2, name);
        content(self);
        self.text(0, "ENDSEC");
    }

    fn entity(&mut self, kind: &str, layer: &str) {
        self.text(0, kind);
        self.text(8, layer);
    }

    /// The `k`-th point of an entity.
    fn point(&mut self, k: u16, position: [f64; 3]) {
        for (axis, coordinate) in (1..).zip(position) {
            self.text(10 * axis + k, &shortest(coordinate).unwrap_or_default());
        }
    }

    /// One 3D face of a triangle or quad; of more corners triangles from the first, what is between them hidden (group 70, a bit an edge).
    fn face(&mut self, corners: &[[f64; 3]]) {
        let mut piece = |places: [usize; 4], hidden: u8| {
            self.entity("3DFACE", "PANELS");
            for (k, place) in (0..).zip(places) {
                self.point(k, corners[place]);
            }
            if hidden > 0 {
                self.text(70, &hidden.to_string());
            }
        };
        match corners.len() {
            3 => piece([0, 1, 2, 2], 0),
            4 => piece([0, 1, 2, 3], 0),
            n => (1..n.saturating_sub(1)).for_each(|k| {
                let (first, last) = (u8::from(k > 1), 8 * u8::from(k + 2 < n));
                piece([0, k, k + 1, k + 1], first | last);
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::sample::square_with_pole;

    /// What stands between two entities, by kind and layer.
    fn count(text: &str, kind: &str, layer: &str) -> usize {
        text.matches(&format!("  0\n{kind}\n  8\n{layer}\n")).count()
    }

    #[test]
    fn edges_faces_and_supports_are_on_their_layers() {
        let pattern = square_with_pole();
        let bytes = dxf(&Polygons::from(&pattern), &[pattern.positions[0]], "q1");
        let text = String::from_utf8(bytes).unwrap();
        // A quad and a triangle that share one edge.
        assert_eq!(count(&text, "LINE", "MEMBERS"), 1);
        assert_eq!(count(&text, "LINE", "BOUNDARY"), 5);
        assert_eq!(count(&text, "3DFACE", "PANELS"), 2);
        assert_eq!(count(&text, "POINT", "SUPPORTS"), 1);
        assert!(text.contains(" 12\n2\n") || text.contains(" 10\n2\n"), "{text}");
        assert!(text.ends_with("  0\nENDSEC\n  0\nEOF\n"));
        let lines = text.lines().count();
        assert_eq!(lines % 2, 0, "a code and a value each");
    }

    #[test]
    fn a_pentagon_is_a_fan_with_two_edges_hidden() {
        let positions: Vec<[f64; 3]> =
            [[0.0, 0.0], [2.0, 0.0], [3.0, 1.0], [1.0, 2.0], [-1.0, 1.0]].map(|[x, y]| [x, y, 0.0]).into();
        let face = [0u32, 1, 2, 3, 4];
        let mesh = Polygons { positions: &positions, faces: vec![&face], coarse_faces: &[] };
        let text = String::from_utf8(dxf(&mesh, &[], "q1")).unwrap();
        assert_eq!(count(&text, "3DFACE", "PANELS"), 3);
        // First: the diagonal back to 0; middle: both; last: the diagonal from 0.
        let hidden: Vec<&str> =
            text.split("3DFACE").skip(1).map(|face| face.split(" 70\n").nth(1).unwrap()).collect();
        assert_eq!(hidden.iter().map(|h| h.lines().next().unwrap()).collect::<Vec<_>>(), ["8", "9", "1"]);
    }
}
