//! The initial mesh as a plan picture: boundary curves, coarse edges, singular vertices with their valence, corners, marker.

use crate::domain::Domain;
use crate::mesh::{BaseMesh, BaseMeshError, InitialMesh};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// Longest side of the drawing, in SVG units.
const SIZE: f64 = 800.0;
const MARGIN: f64 = 30.0;

/// The plan, y up. Orange: fewer edges than regular; blue: more; white: corners; green: the marker. Dashed: `seams`, each as the places of
/// its two ends, m.
///
/// # Errors
/// A mesh that is not valid.
pub fn svg(
    base: &BaseMesh,
    domain: &Domain,
    title: &str,
    seams: &[[[f64; 3]; 2]],
) -> Result<String, BaseMeshError> {
    let mesh = InitialMesh::from_base(base)?;
    let [low, high] = domain.bounds();
    let scale = SIZE / (high[0] - low[0]).max(high[1] - low[1]);
    let at = |p: &[f64; 3]| [MARGIN + scale * (p[0] - low[0]), MARGIN + scale * (high[1] - p[1])];
    let (width, height) =
        (2.0 * MARGIN + scale * (high[0] - low[0]), 2.0 * MARGIN + scale * (high[1] - low[1]));
    let title = title.replace('&', "&amp;").replace('<', "&lt;");
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.1} {height:.1}\">\n<title>{title}</title>\n\
         <style>.edge{{stroke:#7a7266;stroke-width:1.6;fill:none}}.boundary{{stroke:#111;stroke-width:3;fill:none}}\
         .marker{{stroke:#009e73;stroke-width:5}}text{{font:bold 13px sans-serif;fill:#fff;text-anchor:middle}}\
         .number{{font:10px sans-serif;fill:#777;text-anchor:start}}</style>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    for [a, b] in inner_edges(base) {
        let points = around(domain, base.vertices[a as usize], base.vertices[b as usize]);
        let _ = writeln!(text, "<path class=\"edge\" d=\"{}\"/>", path(points.iter().map(at)));
    }
    for boundary in &domain.loops {
        let points = boundary.sample(domain.size() / 300.0);
        let outline = path(points.iter().map(|&s| at(&boundary.point(s))));
        let _ = writeln!(text, "<path class=\"boundary\" d=\"{outline}Z\"/>");
    }
    for seam in seams {
        let line = path(seam.iter().map(at));
        let _ = writeln!(
            text,
            "<path fill=\"none\" stroke=\"#c2185b\" stroke-width=\"3\" stroke-dasharray=\"9 6\" d=\"{line}\"/>"
        );
    }
    let (from, to) = (mesh.mesh.origin(mesh.marker).index(), mesh.mesh.end(mesh.marker).index());
    let ([x, y], [u, v]) = (at(&base.vertices[from]), at(&base.vertices[to]));
    let (u, v) = (x + 0.4 * (u - x), y + 0.4 * (v - y));
    let _ = writeln!(text, "<path class=\"marker\" d=\"M{x:.1} {y:.1}L{u:.1} {v:.1}\"/>");
    vertices(&mut text, base, at);
    text.push_str("</svg>\n");
    Ok(text)
}

/// The data of an SVG path through points.
fn path(points: impl Iterator<Item = [f64; 2]>) -> String {
    points.fold(String::new(), |mut path, [x, y]| {
        let _ = write!(path, "{}{x:.1} {y:.1}", if path.is_empty() { "M" } else { "L" });
        path
    })
}

/// Points of an edge: straight, or where that would leave the domain bent around what is in its way. A coarse edge has ends but no
/// way of its own.
fn around(domain: &Domain, a: [f64; 3], b: [f64; 3]) -> Vec<[f64; 3]> {
    const PARTS: usize = 24;
    let clear = 0.012 * domain.size();
    let mut points: Vec<[f64; 3]> =
        (0..=PARTS).map(|k| [0, 1, 2].map(|i| a[i] + k as f64 / PARTS as f64 * (b[i] - a[i]))).collect();
    if points.iter().all(|p| domain.contains([p[0], p[1]])) {
        return vec![a, b];
    }
    for _ in 0..60 {
        for k in 1..PARTS {
            let (p, q) = (points[k - 1], points[k + 1]);
            let middle = [0, 1, 2].map(|i| 0.5 * (p[i] + q[i]));
            points[k] = inward(domain, middle, clear);
        }
    }
    points
}

/// A point, or if it is outside the domain one that is so far inside, off the nearest point of the boundary.
fn inward(domain: &Domain, p: [f64; 3], clear: f64) -> [f64; 3] {
    if domain.contains([p[0], p[1]]) {
        return p;
    }
    let gap = |q: &[f64; 3]| (q[0] - p[0]).hypot(q[1] - p[1]);
    let nearest = domain.loops.iter().map(|l| l.closest_point(p)).min_by(|q, r| gap(q).total_cmp(&gap(r)));
    let Some(q) = nearest else { return p };
    let share = -clear / gap(&q);
    [q[0] + share * (p[0] - q[0]), q[1] + share * (p[1] - q[1]), p[2]]
}

/// Every edge with faces on both sides, once.
fn inner_edges(base: &BaseMesh) -> Vec<[u32; 2]> {
    let darts: BTreeSet<[u32; 2]> = darts(base).collect();
    darts.iter().copied().filter(|&[a, b]| a < b && darts.contains(&[b, a])).collect()
}

fn darts(base: &BaseMesh) -> impl Iterator<Item = [u32; 2]> + '_ {
    base.faces.iter().flat_map(|f| (0..f.len()).map(move |k| [f[k], f[(k + 1) % f.len()]]))
}

/// Singular vertices with their valence, corners, and all vertex numbers.
fn vertices(text: &mut String, base: &BaseMesh, at: impl Fn(&[f64; 3]) -> [f64; 2]) {
    let mut neighbours: BTreeMap<u32, BTreeSet<u32>> = BTreeMap::new();
    let directed: BTreeSet<[u32; 2]> = darts(base).collect();
    let mut boundary = BTreeSet::new();
    for &[a, b] in &directed {
        neighbours.entry(a).or_default().insert(b);
        neighbours.entry(b).or_default().insert(a);
        if !directed.contains(&[b, a]) {
            boundary.extend([a, b]);
        }
    }
    let corners: BTreeSet<u32> = base.corners.iter().flatten().copied().collect();
    for (&v, around) in &neighbours {
        let [x, y] = at(&base.vertices[v as usize]);
        let _ = writeln!(text, "<text class=\"number\" x=\"{:.1}\" y=\"{:.1}\">{v}</text>", x + 6.0, y - 6.0);
        let regular = if boundary.contains(&v) { 3 } else { 4 };
        if corners.contains(&v) {
            let _ = writeln!(
                text,
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"6\" fill=\"#fff\" stroke=\"#111\" stroke-width=\"2\"/>"
            );
        } else if around.len() != regular {
            let fill = if around.len() < regular { "#d55e00" } else { "#0072b2" };
            let _ = writeln!(text, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"10\" fill=\"{fill}\"/>");
            let _ = writeln!(text, "<text x=\"{x:.1}\" y=\"{:.1}\">{}</text>", y + 4.5, around.len());
        }
    }
}
