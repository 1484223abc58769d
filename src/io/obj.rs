//! Wavefront OBJ: vertices, faces and polylines. Every fault is told with its line.
//!
//! What exporters really do (ECOSYSTEM §3b): `a/b/c` corners, negative indices, `\`-continued lines, CRLF, comments in other
//! encodings, and curves in pieces of two vertices. All of that is read; free-form geometry, groups and materials are left out.

use super::{Input, LengthUnit, ReadError};
use crate::mesh::BaseMesh;
use std::collections::BTreeMap;
use std::fmt::Write as _;

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
    /// Polylines; pieces that meet end to end are joined. A closed one repeats its first vertex at the end.
    pub polylines: Vec<Vec<u32>>,
    /// For each polyline, the line of its first piece.
    pub polyline_lines: Vec<usize>,
}

/// Reads a file whose coordinates have the given unit.
///
/// # Errors
/// The first line that is wrong.
pub fn read(input: Input<'_>, unit: LengthUnit) -> Result<ObjFile, ReadError> {
    let mut obj = parse(&String::from_utf8_lossy(input.bytes)).map_err(|(line, reason)| ReadError::Line {
        file: input.file.to_owned(),
        line,
        reason,
    })?;
    obj.vertices.iter_mut().for_each(|position| *position = position.map(|c| unit.metres(c)));
    Ok(obj)
}

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
    let mut piece_lines = Vec::new();
    for (line, content) in logical_lines(text) {
        let content = content.split('#').next().unwrap_or("");
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
                pieces.push(corners(words, obj.vertices.len(), 2, "polyline").map_err(fault)?);
                piece_lines.push(line);
            }
            _ if IGNORED.contains(&keyword) => {}
            _ => return Err((line, format!("`{keyword}` is not a keyword of OBJ"))),
        }
    }
    let count = obj.vertices.len();
    let faults = [in_range(&obj.faces, &obj.face_lines, count), in_range(&pieces, &piece_lines, count)];
    if let Some(first) = faults.into_iter().filter_map(Result::err).min_by_key(|(line, _)| *line) {
        return Err(first);
    }
    (obj.polylines, obj.polyline_lines) = join(pieces, piece_lines);
    Ok(obj)
}

/// Lines with their numbers; one that ends in `\` goes on in the next.
fn logical_lines(text: &str) -> Vec<(usize, String)> {
    let mut lines: Vec<(usize, String)> = Vec::new();
    let mut continued = false;
    for (i, raw) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let (content, goes_on) = match raw.trim_end().strip_suffix('\\') {
            Some(rest) => (rest, true),
            None => (raw, false),
        };
        match lines.last_mut().filter(|_| continued) {
            Some((_, before)) => {
                before.push(' ');
                before.push_str(content);
            }
            None => lines.push((i + 1, content.to_owned())),
        }
        continued = goes_on;
    }
    lines
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

fn in_range(items: &[Vec<u32>], lines: &[usize], count: usize) -> Result<(), (usize, String)> {
    for (item, &line) in items.iter().zip(lines) {
        if let Some(&v) = item.iter().find(|&&v| v as usize >= count) {
            return Err((line, format!("vertex {} does not exist: the file has {count}", u64::from(v) + 1)));
        }
    }
    Ok(())
}

/// Joins pieces that meet where no third one does; the result is in the order of the first pieces.
fn join(pieces: Vec<Vec<u32>>, lines: Vec<usize>) -> (Vec<Vec<u32>>, Vec<usize>) {
    let mut ends: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (i, piece) in pieces.iter().enumerate() {
        let (first, last) = (piece[0], piece[piece.len() - 1]);
        if first != last {
            ends.entry(first).or_default().push(i);
            ends.entry(last).or_default().push(i);
        }
    }
    let mut used = vec![false; pieces.len()];
    let (mut chains, mut chain_lines) = (Vec::new(), Vec::new());
    for (i, piece) in pieces.iter().enumerate() {
        if used[i] {
            continue;
        }
        used[i] = true;
        let mut chain = piece.clone();
        extend(&mut chain, &pieces, &ends, &mut used);
        if chain[0] != chain[chain.len() - 1] {
            chain.reverse();
            extend(&mut chain, &pieces, &ends, &mut used);
            chain.reverse();
        }
        chains.push(chain);
        chain_lines.push(lines[i]);
    }
    (chains, chain_lines)
}

/// Goes on at the end of the chain as long as exactly one other unused piece starts or ends there.
fn extend(chain: &mut Vec<u32>, pieces: &[Vec<u32>], ends: &BTreeMap<u32, Vec<usize>>, used: &mut [bool]) {
    loop {
        let last = chain[chain.len() - 1];
        let Some(meeting) = ends.get(&last).filter(|m| m.len() == 2 && chain[0] != last) else { return };
        let Some(&next) = meeting.iter().find(|&&i| !used[i]) else { return };
        used[next] = true;
        let piece = &pieces[next];
        if piece[0] == last {
            chain.extend(&piece[1..]);
        } else {
            chain.extend(piece.iter().rev().skip(1));
        }
    }
}

/// A mesh as OBJ text: z up, metres, positive indices from 1, shortest numbers that read back the same.
pub fn write(name: &str, mesh: &BaseMesh) -> String {
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
            ("v 0 0 0\nquad 1 2 3\n", 2, "not a keyword"),
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
