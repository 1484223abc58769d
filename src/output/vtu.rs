//! VTK XML unstructured grids (`.vtu`), as ParaView and meshio read them.

use super::number::{push_integer, push_shortest};
use super::svg::escape;
use std::fmt::Write;

/// One named array: one value (or vector) for each point or cell.
pub struct Field<'a> {
    /// Name, with its unit; any text.
    pub name: &'a str,
    /// Numbers a point or cell.
    pub components: usize,
    /// All numbers, point by point or cell by cell. All must be finite.
    pub values: &'a [f64],
}

/// Points, cells and fields of one file.
pub struct Grid<'a> {
    /// Positions, m.
    pub points: &'a [[f64; 3]],
    /// Cells: two points are a line, three a triangle, four a quad.
    pub cells: &'a [&'a [u32]],
    /// One value a point.
    pub point_fields: &'a [Field<'a>],
    /// One value a cell.
    pub cell_fields: &'a [Field<'a>],
}

/// The file, ASCII.
pub fn vtu(grid: &Grid<'_>) -> Vec<u8> {
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt64\">\n<UnstructuredGrid>\n",
    );
    let _ = writeln!(
        text,
        "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">",
        grid.points.len(),
        grid.cells.len()
    );
    fields(&mut text, "PointData", grid.point_fields);
    fields(&mut text, "CellData", grid.cell_fields);
    text.push_str("<Points>\n");
    let points: Vec<f64> = grid.points.iter().flatten().copied().collect();
    floats(&mut text, &Field { name: "Points", components: 3, values: &points });
    text.push_str("</Points>\n<Cells>\n");
    integers(
        &mut text,
        "Int64",
        "connectivity",
        grid.cells.iter().flat_map(|cell| cell.iter().map(|&v| v as usize)),
    );
    let offsets = grid.cells.iter().scan(0, |end, cell| {
        *end += cell.len();
        Some(*end)
    });
    integers(&mut text, "Int64", "offsets", offsets);
    integers(&mut text, "UInt8", "types", grid.cells.iter().map(|cell| cell_type(cell)));
    text.push_str("</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    text.into_bytes()
}

/// VTK's number for a cell of so many points (vtkCellType.h).
fn cell_type(cell: &[u32]) -> usize {
    match cell.len() {
        2 => 3,
        3 => 5,
        4 => 9,
        _ => 7,
    }
}

fn fields(text: &mut String, element: &str, fields: &[Field<'_>]) {
    let _ = writeln!(text, "<{element}>");
    for field in fields {
        floats(text, field);
    }
    let _ = writeln!(text, "</{element}>");
}

fn floats(text: &mut String, field: &Field<'_>) {
    let Field { name, components, values } = field;
    let _ = writeln!(
        text,
        "<DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{components}\" format=\"ascii\">",
        escape(name)
    );
    for entry in values.chunks((*components).max(1)) {
        for (place, &value) in entry.iter().enumerate() {
            if place > 0 {
                text.push(' ');
            }
            push_shortest(text, if value.is_finite() { value } else { 0.0 });
        }
        text.push('\n');
    }
    text.push_str("</DataArray>\n");
}

fn integers(text: &mut String, kind: &str, name: &str, values: impl Iterator<Item = usize>) {
    let _ = writeln!(text, "<DataArray type=\"{kind}\" Name=\"{name}\" format=\"ascii\">");
    for (place, value) in values.enumerate() {
        if place > 0 {
            text.push(' ');
        }
        push_integer(text, value);
    }
    text.push_str("\n</DataArray>\n");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::sample::square_with_pole;

    #[test]
    fn names_are_escaped() {
        let grid = Grid {
            points: &[[0.0; 3]],
            cells: &[],
            point_fields: &[Field { name: "G & \"Q\" <max>_m", components: 1, values: &[1.0] }],
            cell_fields: &[],
        };
        let text = String::from_utf8(vtu(&grid)).unwrap();
        assert!(text.contains("Name=\"G &amp; &quot;Q&quot; &lt;max&gt;_m\""), "{text}");
    }

    #[test]
    fn panels_with_values() {
        let pattern = square_with_pole();
        let cells: Vec<&[u32]> = pattern.panels.iter().map(|panel| panel.corners()).collect();
        let grid = Grid {
            points: &pattern.positions,
            cells: &cells,
            point_fields: &[],
            cell_fields: &[Field { name: "curvature", components: 1, values: &[0.25, 0.0] }],
        };
        let text = String::from_utf8(vtu(&grid)).unwrap();
        for part in [
            "<Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">",
            "Name=\"curvature\" NumberOfComponents=\"1\" format=\"ascii\">\n0.25\n0\n</DataArray>",
            "Name=\"connectivity\" format=\"ascii\">\n0 1 4 3 2 4 1\n",
            "Name=\"offsets\" format=\"ascii\">\n4 7\n",
            "Name=\"types\" format=\"ascii\">\n9 5\n",
        ] {
            assert!(text.contains(part), "{part} not in\n{text}");
        }
    }
}
