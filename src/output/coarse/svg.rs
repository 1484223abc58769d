//! The coarse mesh drawn: strips coloured, singular vertices with their valence, the marker as an arrow.

use super::Reading;
use super::layout::layout;
use crate::grammar::Decoded;
use crate::mesh::strips::{self, StripChain};
use crate::mesh::{DartId, QuadMesh};
use crate::output::number::rounded;
use std::fmt::Write as _;

/// Longest side of the drawing, px.
const SIZE: f64 = 720.0;
const MARGIN: f64 = 36.0;

const STYLE: &str = "\
.edges{fill:none;stroke:#8a8378;stroke-width:1.2}.boundary{fill:none;stroke:#111;stroke-width:2.6}\
.seam{fill:none;stroke:#111;stroke-width:2.6;stroke-dasharray:7 5}\
.strip{fill:none;stroke-width:7;stroke-linecap:round;stroke-linejoin:round;opacity:.55}\
.less{fill:#d55e00}.more{fill:#0072b2}.pole{fill:#111}.less,.more,.pole{stroke:#fff;stroke-width:1.5}\
.marker{fill:none;stroke:#c2185b;stroke-width:4}.head{fill:#c2185b}\
.valence{font:bold 12px sans-serif;fill:#fff;text-anchor:middle}\
.corner{font:12px sans-serif;fill:#111;text-anchor:middle}\
.label{font:11px sans-serif;fill:#111;text-anchor:middle}";

/// Where the vertices are drawn, px, y down.
struct Drawing {
    points: Vec<[f64; 2]>,
    width: f64,
    height: f64,
}

impl Drawing {
    fn of(mesh: &QuadMesh) -> Self {
        let points = layout(mesh);
        let bound =
            |i: usize, pick: fn(f64, f64) -> f64, start: f64| points.iter().map(|p| p[i]).fold(start, pick);
        let low = [0, 1].map(|i: usize| bound(i, f64::min, f64::INFINITY));
        let high = [0, 1].map(|i: usize| bound(i, f64::max, f64::NEG_INFINITY));
        let scale = SIZE / (high[0] - low[0]).max(high[1] - low[1]).max(f64::MIN_POSITIVE);
        let place = |p: &[f64; 2]| [MARGIN + (p[0] - low[0]) * scale, MARGIN + (high[1] - p[1]) * scale];
        Self {
            points: points.iter().map(place).collect(),
            width: (high[0] - low[0]) * scale + 2.0 * MARGIN,
            height: (high[1] - low[1]) * scale + 2.0 * MARGIN,
        }
    }

    fn origin(&self, mesh: &QuadMesh, d: DartId) -> [f64; 2] {
        self.points[mesh.origin(d).index()]
    }

    fn middle(&self, mesh: &QuadMesh, d: DartId) -> [f64; 2] {
        between(self.origin(mesh, d), self.origin(mesh, mesh.twin(d)), 0.5)
    }
}

/// A picture of the coarse mesh; of a symmetric one the part that was decoded and, beside it, the whole. A singular vertex is orange with fewer edges than a regular one, blue with more,
/// black if it is a pole; small numbers beside the boundary are the corners of the domain.
pub fn svg(reading: Reading<'_>) -> String {
    let whole = Drawing::of(&reading.decoded.mesh);
    let part = reading.part.map(|part| (part, Drawing::of(&part.mesh)));
    let aside = part.as_ref().map_or(0.0, |(_, drawing)| drawing.width);
    let height = part.as_ref().map_or(0.0, |(_, drawing)| drawing.height).max(whole.height);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" role=\"img\">\n\
         <title>{}</title>\n<style>{STYLE}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        rounded(aside + whole.width, 1),
        rounded(height, 1),
        reading.string
    );
    match &part {
        None => draw(&mut text, reading.decoded, &whole),
        Some((part, drawing)) => {
            draw(&mut text, part, drawing);
            let _ = writeln!(text, "<g transform=\"translate({} 0)\">", rounded(aside, 1));
            draw(&mut text, reading.decoded, &whole);
            text.push_str("</g>\n");
        }
    }
    text.push_str("</svg>\n");
    text
}

fn draw(text: &mut String, decoded: &Decoded, drawing: &Drawing) {
    let mesh = &decoded.mesh;
    let chains = strips::all(mesh);
    for (k, chain) in chains.iter().enumerate() {
        draw_strip(text, mesh, drawing, chain, k);
    }
    draw_edges(text, mesh, drawing);
    for chain in &chains {
        label_strip(text, mesh, drawing, chain);
    }
    draw_marker(text, mesh, drawing, decoded.marker);
    draw_singularities(text, mesh, drawing);
    name_corners(text, mesh, drawing);
}

/// A line along the middle of the strip, to its poles.
fn draw_strip(text: &mut String, mesh: &QuadMesh, drawing: &Drawing, chain: &StripChain, k: usize) {
    let mut line: Vec<[f64; 2]> = Vec::new();
    let pole = |d: DartId| drawing.origin(mesh, mesh.prev(d));
    if let (true, Some(&first)) = (chain.poles[0], chain.darts.first()) {
        line.push(pole(mesh.twin(first)));
    }
    line.extend(chain.darts.iter().map(|&d| drawing.middle(mesh, d)));
    if let (true, Some(&last)) = (chain.poles[1], chain.darts.last()) {
        line.push(pole(last));
    }
    // Golden-angle hues stay apart however many strips there are.
    let colour = colour((k as f64 * 137.508) % 360.0);
    let close = if chain.closed { " Z" } else { "" };
    let _ = writeln!(
        text,
        "<path class=\"strip\" stroke=\"{colour}\" d=\"{}{close}\"><title>strip {}</title></path>",
        path(&line),
        chain.label.0
    );
}

fn label_strip(text: &mut String, mesh: &QuadMesh, drawing: &Drawing, chain: &StripChain) {
    if let Some(&d) = chain.darts.first() {
        let [x, y] = drawing.middle(mesh, d);
        let _ = writeln!(
            text,
            "<text class=\"label\" x=\"{}\" y=\"{}\">{}</text>",
            rounded(x, 1),
            rounded(y + 4.0, 1),
            chain.label.0
        );
    }
}

fn draw_edges(text: &mut String, mesh: &QuadMesh, drawing: &Drawing) {
    let class_of = |d: DartId| {
        let outside = [d, mesh.twin(d)].map(|d| mesh.left(d)).into_iter().find(|left| left.is_outside());
        match outside {
            Some(left) if left.as_seam().is_some() => "seam",
            Some(_) => "boundary",
            None => "edges",
        }
    };
    let classes = ["edges", "boundary", "seam"].into_iter();
    for class in classes.filter(|&class| class != "seam" || mesh.is_folded()) {
        let darts = mesh.darts().filter(|&d| d < mesh.twin(d) && class_of(d) == class);
        let lines: Vec<String> =
            darts.map(|d| path(&[drawing.origin(mesh, d), drawing.origin(mesh, mesh.twin(d))])).collect();
        let _ = writeln!(text, "<path class=\"{class}\" d=\"{}\"/>", lines.join(" "));
    }
}

/// An arrow beside the marker's edge, on the side of the face on its left.
fn draw_marker(text: &mut String, mesh: &QuadMesh, drawing: &Drawing, marker: DartId) {
    let (a, b) = (drawing.origin(mesh, marker), drawing.origin(mesh, mesh.twin(marker)));
    let length = libm::hypot(b[0] - a[0], b[1] - a[1]).max(1e-9);
    let along = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
    // y points down on the screen, so left of the direction is (y, −x).
    let left = [along[1], -along[0]];
    let head = length.min(14.0);
    let at = |t: f64, aside: f64| [0, 1].map(|i: usize| a[i] + along[i] * t + left[i] * (aside + 5.0));
    let (start, neck, tip) = (at(0.12 * length, 0.0), at(0.88 * length - head, 0.0), at(0.88 * length, 0.0));
    let _ = writeln!(text, "<path class=\"marker\" d=\"{}\"/>", path(&[start, neck]));
    let corners = [at(0.88 * length - head, head / 2.0), tip, at(0.88 * length - head, -head / 2.0)];
    let _ = writeln!(text, "<path class=\"head\" d=\"{} Z\"><title>marker</title></path>", path(&corners));
}

fn draw_singularities(text: &mut String, mesh: &QuadMesh, drawing: &Drawing) {
    let (poles, boundary) = (mesh.pole_vertices(), mesh.boundary_vertices());
    for (v, valence) in mesh.valences().into_iter().enumerate() {
        let regular = if boundary[v] { 3 } else { 4 };
        let class = if poles[v] {
            "pole"
        } else if valence < regular {
            "less"
        } else if valence > regular {
            "more"
        } else {
            continue;
        };
        let [x, y] = drawing.points[v];
        let _ = writeln!(
            text,
            "<circle class=\"{class}\" cx=\"{}\" cy=\"{}\" r=\"9\"/>\
             <text class=\"valence\" x=\"{0}\" y=\"{}\">{valence}</text>",
            rounded(x, 1),
            rounded(y, 1),
            rounded(y + 4.2, 1)
        );
    }
}

/// A clear colour of this hue (degrees), as `#rrggbb`: not every viewer knows `hsl()`.
fn colour(hue: f64) -> String {
    let channel = |n: f64| {
        let k = (n + hue / 30.0) % 12.0;
        (255.0 * (0.52 - 0.36 * (k - 3.0).min(9.0 - k).clamp(-1.0, 1.0))) as u8
    };
    format!("#{:02x}{:02x}{:02x}", channel(0.0), channel(8.0), channel(4.0))
}

/// The numbers of the corners, outside the drawing as seen from its middle.
fn name_corners(text: &mut String, mesh: &QuadMesh, drawing: &Drawing) {
    let centre = [drawing.width / 2.0, drawing.height / 2.0];
    for (vertex, names) in corner_names(mesh) {
        let p = drawing.points[vertex];
        let away = libm::hypot(p[0] - centre[0], p[1] - centre[1]).max(1e-9);
        let [x, y] = [0, 1].map(|i: usize| p[i] + (p[i] - centre[i]) / away * 22.0);
        let _ = writeln!(
            text,
            "<text class=\"corner\" x=\"{}\" y=\"{}\">{names}</text>",
            rounded(x, 1),
            rounded(y + 4.0, 1)
        );
    }
}

fn corner_names(mesh: &QuadMesh) -> Vec<(usize, String)> {
    let mut names: std::collections::BTreeMap<usize, Vec<String>> = std::collections::BTreeMap::new();
    for mark in mesh.marks() {
        names.entry(mark.vertex.index()).or_default().push(mark.corner.to_string());
    }
    names.into_iter().map(|(vertex, names)| (vertex, names.join(" "))).collect()
}

fn path(points: &[[f64; 2]]) -> String {
    let points: Vec<String> =
        points.iter().map(|p| format!("{} {}", rounded(p[0], 1), rounded(p[1], 1))).collect();
    format!("M{}", points.join(" L"))
}

fn between(a: [f64; 2], b: [f64; 2], t: f64) -> [f64; 2] {
    [0, 1].map(|i: usize| a[i] * (1.0 - t) + b[i] * t)
}
