//! Wavefront OBJ: vertices, faces and polylines. Every fault is told with its line.
//!
//! What exporters really do (docs/reference/files.md §4): `a/b/c` corners, negative indices, `\`-continued lines, line ends of all systems,
//! comments in other encodings or ending in a path's `\`, and curves in pieces of two vertices. All of that is read; other keywords
//! are left out, those of the format (free-form geometry, groups, materials) and those of exporters alike.

use super::join::{Chain, join};
use super::text::{decode_lossy, lines};
use super::{Input, LengthUnit, ReadError};
use crate::mesh::BaseMesh;
use std::fmt::Write as _;

/// So that products of coordinates stay finite.
const MAX_COORDINATE: f64 = 1e50;

/// What an OBJ file holds, vertex numbers from 0.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct ObjFile {
    /// Vertex positions: in metres from [`read`], in the file's unit from [`parse`].
    pub vertices: Vec<[f64; 3]>,
    /// For each vertex, its line in the file, from 1.
    pub vertex_lines: Vec<usize>,
    /// Faces of three vertices or more.
    pub faces: Vec<Vec<u32>>,
    /// For each face, its line in the file, from 1.
    pub face_lines: Vec<usize>,
    /// Polylines; pieces that meet end to end are joined. A closed one ends in its first vertex, or at the place of it.
    pub polylines: Vec<Vec<u32>>,
    /// For each polyline, the line of its first piece.
    pub polyline_lines: Vec<usize>,
    /// For each polyline, the widest gap between pieces that were joined, in the unit of the vertices.
    pub polyline_gaps: Vec<f64>,
    /// The first keyword that was left out though it is none of the format, and its line.
    pub unknown: Option<(usize, String)>,
}

impl ObjFile {
    /// What to tell where something was looked for in vain: what the file has instead.
    pub fn hint(&self) -> String {
        match &self.unknown {
            _ if self.vertices.is_empty() && self.unknown.is_none() => {
                "; the file has no vertices".to_owned()
            }
            Some((line, word)) => format!("; line {line} begins with `{word}`, which is no keyword of OBJ"),
            None => String::new(),
        }
    }
}

/// Reads a file whose coordinates have the given unit.
///
/// # Errors
/// The first line that is wrong.
pub fn read(Input { file, bytes }: Input<'_>, unit: LengthUnit) -> Result<ObjFile, ReadError> {
    let parsed = decode_lossy(bytes).and_then(|text| parse(&text));
    let mut obj = parsed.map_err(|(line, reason)| ReadError::Line { file: file.to_owned(), line, reason })?;
    obj.vertices.iter_mut().for_each(|position| *position = position.map(|c| unit.metres(c)));
    obj.polyline_gaps.iter_mut().for_each(|gap| *gap = unit.metres(*gap));
    Ok(obj)
}

/// Keywords of the format that are followed by names, which may end in anything.
const NAMES: [&str; 10] =
    ["g", "o", "usemtl", "mtllib", "maplib", "usemap", "shadow_obj", "trace_obj", "call", "csh"];

/// Keywords of the format that say nothing about a polygon mesh.
const IGNORED: [&str; 36] = [
    "vt",
    "vn",
    "vp",
    "cstype",
    "deg",
    "bmat",
    "step",
    "p",
    "curv",
    "curv2",
    "surf",
    "parm",
    "trim",
    "hole",
    "scrv",
    "sp",
    "end",
    "con",
    "g",
    "s",
    "mg",
    "o",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "usemtl",
    "mtllib",
    "maplib",
    "usemap",
    "shadow_obj",
    "trace_obj",
    "ctech",
    "stech",
    "call",
    "csh",
];

/// Reads the text of a file.
///
/// # Errors
/// The line (from 1) and the fault.
pub fn parse(text: &str) -> Result<ObjFile, (usize, String)> {
    let mut obj = ObjFile::default();
    let mut pieces = Vec::new();
    for (line, content) in logical_lines(text) {
        let mut words = content.split_whitespace();
        let Some(keyword) = words.next() else { continue };
        let fault = |reason: String| (line, reason);
        match keyword {
            "v" => {
                obj.vertices.push(vertex(words).map_err(fault)?);
                obj.vertex_lines.push(line);
            }
            "f" => {
                obj.faces.push(corners(words, obj.vertices.len(), 3, "face").map_err(fault)?);
                obj.face_lines.push(line);
            }
            "l" => {
                let vertices = corners(words, obj.vertices.len(), 2, "polyline").map_err(fault)?;
                pieces.push(Chain { vertices, line, gap: 0.0 });
            }
            _ if IGNORED.contains(&keyword) => {}
            _ if obj.unknown.is_none() => obj.unknown = Some((line, shortened(keyword))),
            _ => {}
        }
    }
    let count = obj.vertices.len();
    let faces = obj.faces.iter().zip(obj.face_lines.iter().copied());
    let faults = [in_range(faces, count), in_range(pieces.iter().map(|p| (&p.vertices, p.line)), count)];
    if let Some(first) = faults.into_iter().filter_map(Result::err).min_by_key(|(line, _)| *line) {
        return Err(first);
    }
    for Chain { vertices, line, gap } in join(pieces, &obj.vertices) {
        obj.polylines.push(vertices);
        obj.polyline_lines.push(line);
        obj.polyline_gaps.push(gap);
    }
    Ok(obj)
}

/// A word as messages show it.
fn shortened(word: &str) -> String {
    match word.char_indices().nth(24) {
        Some((end, _)) => format!("{}…", &word[..end]),
        None => word.to_owned(),
    }
}

/// Lines without comments, with their numbers. One of numbers that ends in `\` goes on in the next; a comment or a name that does,
/// as a Windows path, does not.
fn logical_lines(text: &str) -> Vec<(usize, String)> {
    let mut logical: Vec<(usize, String)> = Vec::new();
    let mut continued = false;
    for (i, raw) in lines(text).enumerate() {
        let content = raw.split('#').next().unwrap_or("").trim();
        let (content, ends_so) = match content.strip_suffix('\\') {
            Some(rest) => (rest, true),
            None => (content, false),
        };
        match logical.last_mut().filter(|_| continued) {
            Some((_, before)) => {
                before.push(' ');
                before.push_str(content);
            }
            None => logical.push((i + 1, content.to_owned())),
        }
        let has_numbers = |line: &str| {
            let keyword = line.split_whitespace().next().unwrap_or("");
            ["v", "f", "l"].contains(&keyword) || (IGNORED.contains(&keyword) && !NAMES.contains(&keyword))
        };
        continued = ends_so && logical.last().is_some_and(|(_, line)| has_numbers(line));
    }
    logical
}

/// The first three numbers after `v`; a weight or a colour may follow.
fn vertex<'a>(mut words: impl Iterator<Item = &'a str>) -> Result<[f64; 3], String> {
    let mut position = [0.0_f64; 3];
    for (value, axis) in position.iter_mut().zip(["x", "y", "z"]) {
        let word = words.next().ok_or_else(|| format!("a vertex needs x, y and z; {axis} is missing"))?;
        *value = word.parse().map_err(|_| format!("{axis} is `{word}`, which is not a number"))?;
        if !value.is_finite() {
            return Err(format!("{axis} is `{word}`, which is not finite"));
        }
        if value.abs() > MAX_COORDINATE {
            return Err(format!("{axis} is `{word}`, which is beyond ±{MAX_COORDINATE:e}"));
        }
    }
    Ok(position)
}

/// The vertex numbers (from 0) of a face or polyline whose corners are `a`, `a/b`, `a//c` or `a/b/c`, negative ones counted
/// back from the `known` vertices read so far.
fn corners<'a>(
    words: impl Iterator<Item = &'a str>,
    known: usize,
    least: usize,
    what: &str,
) -> Result<Vec<u32>, String> {
    let corners = words.map(|word| corner(word, known)).collect::<Result<Vec<_>, _>>()?;
    if corners.len() < least {
        return Err(format!("a {what} needs at least {least} vertices, found {}", corners.len()));
    }
    Ok(corners)
}

fn corner(word: &str, known: usize) -> Result<u32, String> {
    let first = word.split('/').next().unwrap_or("");
    let number: i64 = first.parse().map_err(|_| format!("`{word}` is not a vertex number"))?;
    let index = if number < 0 { known as i64 + number } else { number - 1 };
    u32::try_from(index).map_err(|_| match number {
        0 => "vertex number 0: OBJ counts from 1".to_owned(),
        _ => format!("vertex {number} does not exist: {known} vertices so far"),
    })
}

fn in_range<'a>(
    items: impl Iterator<Item = (&'a Vec<u32>, usize)>,
    count: usize,
) -> Result<(), (usize, String)> {
    for (item, line) in items {
        if let Some(&v) = item.iter().find(|&&v| v as usize >= count) {
            return Err((line, format!("vertex {} does not exist: the file has {count}", u64::from(v) + 1)));
        }
    }
    Ok(())
}

/// A mesh as OBJ text: z up, metres, positive indices from 1, shortest numbers that read back the same.
pub fn write(name: &str, mesh: &BaseMesh) -> String {
    // A name is one line, whatever a file is called.
    let name: String = name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let mut text = format!("# units: m, z up\no {name}\n");
    for [x, y, z] in &mesh.vertices {
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    for face in &mesh.faces {
        text.push('f');
        for v in face {
            let _ = write!(text, " {}", v + 1);
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_in_all_their_forms() {
        let text = "\u{feff}# r\u{e9}sum\u{e9}\r\nv 0 0 0\r\nv 1 0 0 1.0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\nvn 0 0 1\n\
                    f 1/1/1 2/2/1 3//1 4\nf -4 -3 \\\n -2\ng a\nusemtl b\n";
        let obj = parse(text).unwrap();
        assert_eq!(obj.vertices.len(), 4);
        assert_eq!(obj.faces, vec![vec![0, 1, 2, 3], vec![0, 1, 2]]);
        assert_eq!(obj.face_lines, vec![7, 8]);
    }

    #[test]
    fn pieces_of_a_curve_are_joined() {
        let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 0\nv 6 5 0\nv 6 6 0\n\
                    l 1 2\nl 3 2\nl 5 6 7\nl 3 4\nl 4 1\n";
        let obj = parse(text).unwrap();
        assert_eq!(obj.polylines, vec![vec![0, 1, 2, 3, 0], vec![4, 5, 6]]);
        assert_eq!(obj.polyline_lines, vec![8, 10]);
    }

    #[test]
    fn a_backslash_ends_comments_and_names_but_joins_numbers() {
        let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 5 0 0\nv 6 0 0\n# from C:\\roofs\\\nl 1 2 3\nmtllib C:\\roofs\\\n\
                    l 4 \\ # on\n5 \nusemtl a \\\nf 1 \\\n2 \\\n 3\n";
        let obj = parse(text).unwrap();
        assert_eq!(obj.polylines, [vec![0, 1, 2], vec![3, 4]]);
        assert_eq!((obj.faces, obj.face_lines), (vec![vec![0, 1, 2]], vec![12]));
    }

    #[test]
    fn other_keywords_are_left_out_and_the_first_is_kept_for_messages() {
        let text = "vc 1 0 0\nv 0 0 0\nv 1 0 0\nv 1 1 0\nfo 1 2 3\nF 1 2 3\nf 1 2 3\n";
        let obj = parse(text).unwrap();
        assert_eq!(obj.faces.len(), 1);
        assert_eq!(obj.unknown, Some((1, "vc".to_owned())));
        assert!(parse("solid roof\n").unwrap().hint().contains("line 1 begins with `solid`"));
    }

    #[test]
    fn pieces_that_share_no_vertex_are_joined_by_their_places() {
        let square =
            "v 0 0 0\nv 10 0 0\nv 10 0 0\nv 10 10 0\nv 10 10 0\nv 0 10 0\nl 1 2\nl 3 4\nl 5 6\nl 6 1\n";
        let obj = parse(square).unwrap();
        assert_eq!(obj.polylines, [vec![0, 1, 3, 5, 0]]);
        assert_eq!(obj.polyline_gaps, [0.0]);
        // A gap at two corners: what is within 1e-4 of the size is joined, what is farther is not.
        let apart =
            |gap: &str| square.replacen("v 10 0 0\nv 10 10 0", &format!("v 10 {gap} 0\nv 10 9.9997 0"), 1);
        let obj = parse(&apart("0.0004")).unwrap();
        assert_eq!(obj.polylines, [vec![4, 5, 0, 1, 3]]);
        assert!((obj.polyline_gaps[0] - 0.0004).abs() < 1e-12);
        assert_eq!(parse(&apart("0.01")).unwrap().polylines.len(), 1, "open, joined at the other corner");
    }

    #[test]
    fn three_pieces_at_one_vertex_stay_apart() {
        let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nl 1 2\nl 1 3\nl 1 4\n";
        assert_eq!(parse(text).unwrap().polylines.len(), 3);
    }

    #[test]
    fn faults_name_their_line() {
        for (text, line, part) in [
            ("v 0 0\n", 1, "z is missing"),
            ("v 0 0 0\nv 0 1,5 0\n", 2, "not a number"),
            ("v 0 nan 0\n", 1, "not finite"),
            ("v 0 0 0\nf 1 1\n", 2, "at least 3"),
            ("v 0 0 0\n\nf 1 2 3\n", 3, "vertex 2 does not exist"),
            ("v 0 0 0\nf 1 0 1\n", 2, "counts from 1"),
            ("v 0 0 0\nf -1 -2 -1\n", 2, "vertex -2"),
            ("v 0 0 0\nf a b c\n", 2, "not a vertex number"),
            ("v 0 0 1e51\n", 1, "beyond"),
            ("v 0 0 1e400\n", 1, "not finite"),
            ("v 0 0 0\rv 1 0 0\rf 1 2 9", 3, "vertex 9"),
            ("l 1\n", 1, "at least 2"),
            ("v 0 0 0\nf 99999999999 1 1\n", 2, "does not exist"),
        ] {
            let (found, reason) = parse(text).unwrap_err();
            assert_eq!(found, line, "{text:?}: {reason}");
            assert!(reason.contains(part), "{text:?}: {reason}");
        }
    }

    #[test]
    fn what_is_written_reads_back() {
        let mesh = BaseMesh {
            vertices: vec![[0.1, -2.5e-7, 3.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0 / 3.0, 0.0]],
            faces: vec![vec![0, 1, 2, 3]],
            ..BaseMesh::default()
        };
        let obj = parse(&write("square", &mesh)).unwrap();
        assert_eq!(obj.vertices, mesh.vertices);
        assert_eq!(obj.faces, mesh.faces);
    }
}
