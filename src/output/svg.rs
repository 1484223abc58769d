//! The plan of a pattern as SVG: panels shaded by a value, coarse edges, boundary, singularities.

use super::number::{push_tenths, rounded};
use super::polygons::Polygons;
use crate::geometry::Pattern;
use crate::geometry::metrics::valences;
use std::collections::BTreeMap;
use std::fmt::Write;

/// What a plan shows beside its pattern.
#[derive(Default)]
pub struct Plan<'a> {
    /// What the panels are shaded by.
    pub shade: Option<Shade<'a>>,
    /// Nodes that are supported, and whether also against sliding.
    pub supports: Vec<([f64; 3], bool)>,
}

/// What the panels are shaded by.
pub struct Shade<'a> {
    /// What the legend says, with the unit.
    pub label: &'a str,
    /// One value a panel.
    pub values: &'a [f64],
    /// The value at which the darkest shade is reached; 0 is the lightest.
    pub darkest: f64,
}

/// Longest side of the drawing, in SVG units.
const SIZE: f64 = 800.0;
pub(super) const MARGIN: f64 = 24.0;
/// Room above a drawing for its title, and for a line of its key.
const HEAD: f64 = 30.0;
pub(super) const LINE: f64 = 20.0;
/// Number of shades: panels of one shade share a path, which keeps files small.
const SHADES: usize = 12;

const STYLE: &str = "\
.panels path{stroke:#6b6459;stroke-width:.4;stroke-linejoin:round}\
.coarse{fill:none;stroke:#2a2622;stroke-width:1.6;stroke-linecap:round}\
.boundary{fill:none;stroke:#111;stroke-width:3;stroke-linejoin:miter}\
.less{fill:#d55e00}.more{fill:#0072b2}.pole{fill:#000}.corner{fill:#fff;stroke:#111;stroke-width:1.5}\
.less,.more,.pole{stroke:#fff;stroke-width:1.5}\
text{font:12px sans-serif;fill:#111}";
/// Of what pictures have in common.
const COMMON: &str = ".title{font:bold 14px sans-serif;fill:#111}.scale{fill:none;stroke:#111;stroke-width:1.5}.support{fill:#fff;stroke:#2f6b3a;stroke-width:1.4}.support.held{fill:#2f6b3a}";

/// The plan, y up, with a title and a scale, with singular vertices marked: a vermilion triangle for fewer than regular members, a blue square
/// for more, a black diamond for a pole, a white square for a corner of the domain, and a green ring, filled where it holds
/// horizontally too, for a support.
pub fn svg(pattern: &Pattern, title: &str, plan: &Plan<'_>) -> Vec<u8> {
    let frame = Frame::of(&pattern.positions);
    let lines =
        1.0 + f64::from(u8::from(plan.shade.is_some())) + f64::from(u8::from(!plan.supports.is_empty()));
    let (width, foot) = (frame.width + 2.0 * MARGIN, frame.height + 2.0 * MARGIN);
    let mut text = begin(width, foot + LINE * lines, title, STYLE);
    panels(&mut text, pattern, &frame, plan.shade.as_ref());
    let _ = writeln!(text, "<path class=\"coarse\" d=\"{}\"/>", coarse_edges(pattern, &frame));
    for boundary_loop in &pattern.loops {
        let _ = writeln!(
            text,
            "<path class=\"boundary\" d=\"{}\"/>",
            outline(&frame, &pattern.positions, boundary_loop)
        );
    }
    supports(&mut text, &frame, &plan.supports);
    marks(&mut text, pattern, &frame);
    text.push_str(&frame.scale_bar([MARGIN, foot]));
    let mut y = foot;
    if let Some(shade) = &plan.shade {
        y += LINE;
        draw_legend(&mut text, shade, y);
    }
    if !plan.supports.is_empty() {
        text.push_str(&support_key([MARGIN, y + LINE]));
    }
    text.push_str("</svg>\n");
    text.into_bytes()
}

/// A ring at each support.
pub(super) fn supports(text: &mut String, frame: &Frame, supports: &[([f64; 3], bool)]) {
    for &(position, held) in supports {
        text.push_str(&support(frame.place(position), held));
    }
}

fn support([x, y]: [f64; 2], held: bool) -> String {
    let (class, x, y) = (if held { "support held" } else { "support" }, rounded(x, 1), rounded(y, 1));
    format!("<circle class=\"{class}\" cx=\"{x}\" cy=\"{y}\" r=\"3.5\"/>\n")
}

/// A line that says what the rings are.
pub(super) fn support_key([x, y]: [f64; 2]) -> String {
    let word = |dx: f64, words: &str| {
        format!("<text x=\"{}\" y=\"{}\">{words}</text>\n", rounded(x + dx, 1), rounded(y, 1))
    };
    let rings = support([x + 4.0, y - 4.0], false) + &support([x + 164.0, y - 4.0], true);
    rings + &word(14.0, "supported, free to slide") + &word(174.0, "supported, held against sliding")
}

/// The plan of any mesh: its faces, without marks.
pub fn outlines(mesh: &Polygons<'_>, title: &str) -> Vec<u8> {
    let frame = Frame::of(mesh.positions);
    let paths: String = mesh.faces.iter().map(|face| outline(&frame, mesh.positions, face)).collect();
    let foot = frame.height + 2.0 * MARGIN;
    let mut text = begin(frame.width + 2.0 * MARGIN, foot + LINE, title, STYLE);
    let _ = writeln!(text, "<g class=\"panels\"><path fill=\"{}\" d=\"{paths}\"/></g>", sand(0.25));
    text.push_str(&frame.scale_bar([MARGIN, foot]));
    text.push_str("</svg>\n");
    text.into_bytes()
}

/// The beginning of a picture on white, since a viewer may have any background; its title above the drawing, which
/// begins at y = 0.
pub(super) fn begin(width: f64, height: f64, title: &str, style: &str) -> String {
    let [width, height] = [width, height + HEAD].map(|length| rounded(length, 1));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 -{HEAD} {width} {height}\" width=\"{width}\" \
         height=\"{height}\" role=\"img\">\n<title>{title}</title>\n<style>{COMMON}{style}</style>\n\
         <rect y=\"-{HEAD}\" width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <text class=\"title\" x=\"{MARGIN}\" y=\"-6\">{title}</text>\n",
        title = escape(title)
    )
}

/// Plan coordinates to drawing coordinates.
pub(super) struct Frame {
    left: f64,
    top: f64,
    scale: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Frame {
    pub(super) fn of(positions: &[[f64; 3]]) -> Self {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for position in positions {
            for axis in 0..2 {
                low[axis] = low[axis].min(position[axis]);
                high[axis] = high[axis].max(position[axis]);
            }
        }
        let extent = [0, 1].map(|axis| (high[axis] - low[axis]).max(0.0));
        let longest = extent[0].max(extent[1]);
        let scale = if longest > 0.0 { SIZE / longest } else { 1.0 };
        Self { left: low[0], top: high[1], scale, width: extent[0] * scale, height: extent[1] * scale }
    }

    pub(super) fn place(&self, [x, y, _]: [f64; 3]) -> [f64; 2] {
        [MARGIN + (x - self.left) * self.scale, MARGIN + (self.top - y) * self.scale]
    }

    pub(super) fn write(&self, position: [f64; 3]) -> String {
        let mut text = String::new();
        self.push(&mut text, position);
        text
    }

    /// A bar of a round length of at most a quarter of the drawing, its left end at `(x, y − 4)`, and that length.
    pub(super) fn scale_bar(&self, [x, y]: [f64; 2]) -> String {
        let most = 0.25 * SIZE / self.scale;
        let power = 10f64.powi(most.log10().floor() as i32);
        let length =
            [5.0, 2.0, 1.0].map(|step| step * power).into_iter().find(|&step| step <= most).unwrap_or(power);
        let (end, y) = (x + length * self.scale, y - 4.0);
        let [x0, x1, top, low, label, base] =
            [x, end, y - 4.0, y, end + 8.0, y + 4.0].map(|coordinate| rounded(coordinate, 1));
        format!(
            "<path class=\"scale\" d=\"M{x0} {top}V{low}H{x1}V{top}\"/><text x=\"{label}\" y=\"{base}\">{} m</text>\n",
            rounded(length, 6)
        )
    }

    /// Appends the place of a position.
    fn push(&self, text: &mut String, position: [f64; 3]) {
        let [x, y] = self.place(position);
        push_tenths(text, x);
        text.push(' ');
        push_tenths(text, y);
    }
}

pub(super) fn outline(frame: &Frame, positions: &[[f64; 3]], vertices: &[u32]) -> String {
    let mut text = String::new();
    push_outline(&mut text, frame, positions, vertices);
    text
}

/// Appends a closed path through vertices.
fn push_outline(text: &mut String, frame: &Frame, positions: &[[f64; 3]], vertices: &[u32]) {
    for (place, &vertex) in vertices.iter().enumerate() {
        text.push(if place == 0 { 'M' } else { 'L' });
        frame.push(text, positions[vertex as usize]);
    }
    text.push('Z');
}

fn panels(text: &mut String, pattern: &Pattern, frame: &Frame, shade: Option<&Shade<'_>>) {
    let mut paths = vec![String::new(); SHADES + 1];
    for (index, panel) in pattern.panels.iter().enumerate() {
        let share = shade.map_or(0.25, |shade| shade.share(index));
        let class = (share * SHADES as f64).round() as usize;
        push_outline(&mut paths[class], frame, &pattern.positions, panel.corners());
    }
    text.push_str("<g class=\"panels\">\n");
    for (class, path) in paths.iter().enumerate().filter(|(_, path)| !path.is_empty()) {
        let _ = writeln!(text, "<path fill=\"{}\" d=\"{path}\"/>", sand(class as f64 / SHADES as f64));
    }
    text.push_str("</g>\n");
}

impl Shade<'_> {
    /// The shade of a panel, from 0 to 1.
    fn share(&self, panel: usize) -> f64 {
        let value = self.values.get(panel).copied().unwrap_or(0.0);
        let share = if self.darkest > 0.0 { value / self.darkest } else { 0.0 };
        if share.is_finite() { share.clamp(0.0, 1.0) } else { 1.0 }
    }
}

/// One hue from light to dark: by lightness alone, so that it holds for the colour-blind and in print.
pub fn sand(share: f64) -> String {
    let (light, dark) = ([252.0, 249.0, 240.0], [163.0, 112.0, 36.0]);
    let [r, g, b] = [0, 1, 2].map(|c: usize| (light[c] + share * (dark[c] - light[c])).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The panels on each side of every edge, and so its neighbours in the coarse mesh.
fn panels_of_edges(pattern: &Pattern) -> BTreeMap<[u32; 2], Vec<usize>> {
    let mut sides: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
    for (index, panel) in pattern.panels.iter().enumerate() {
        let corners = panel.corners();
        for (i, &a) in corners.iter().enumerate() {
            let b = corners[(i + 1) % corners.len()];
            sides.entry([a.min(b), a.max(b)]).or_default().push(index);
        }
    }
    sides
}

fn coarse_edges(pattern: &Pattern, frame: &Frame) -> String {
    let between = |panels: &Vec<usize>| match panels[..] {
        [a, b] => pattern.coarse_face.get(a) != pattern.coarse_face.get(b),
        _ => false,
    };
    let mut path = String::new();
    for ([a, b], _) in panels_of_edges(pattern).iter().filter(|(_, panels)| between(panels)) {
        let ends = [a, b].map(|&v| frame.write(pattern.positions[v as usize]));
        let _ = write!(path, "M{}L{}", ends[0], ends[1]);
    }
    path
}

/// What a vertex is, as far as it is marked.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Mark {
    /// Fewer members than regular.
    Less,
    /// More members than regular.
    More,
    /// A pole, where a strip ends in a fan of triangles.
    Pole,
    /// A corner of the domain with one panel.
    Corner,
}

/// The marked vertices, in order: singular ones (inner valence not 4, boundary valence not 3), poles, corners.
pub fn singular_vertices(pattern: &Pattern) -> Vec<(u32, Mark)> {
    let count = pattern.positions.len();
    let valence = valences(pattern);
    let mut regular = vec![4usize; count];
    for &vertex in pattern.loops.iter().flatten() {
        regular[vertex as usize] = 3;
    }
    let mut pole = vec![false; count];
    for panel in pattern.panels.iter().filter(|panel| panel.is_triangle()) {
        pole[panel.corners()[0] as usize] = true;
    }
    let mark = |vertex: u32| {
        let v = vertex as usize;
        match valence[v].cmp(&regular[v]) {
            _ if pole[v] => Some(Mark::Pole),
            _ if valence[v] == 2 && pattern.corners.contains(&vertex) => Some(Mark::Corner),
            std::cmp::Ordering::Less => Some(Mark::Less),
            std::cmp::Ordering::Greater => Some(Mark::More),
            std::cmp::Ordering::Equal => None,
        }
    };
    (0..count as u32).filter_map(|vertex| Some((vertex, mark(vertex)?))).collect()
}

fn marks(text: &mut String, pattern: &Pattern, frame: &Frame) {
    for (vertex, mark) in singular_vertices(pattern) {
        let [x, y] = frame.place(pattern.positions[vertex as usize]);
        let at = |dx: f64, dy: f64| format!("{} {}", rounded(x + dx, 1), rounded(y + dy, 1));
        let (class, points) = match mark {
            Mark::Less => ("less", vec![at(0.0, -8.0), at(7.0, 5.0), at(-7.0, 5.0)]),
            Mark::More => ("more", vec![at(-6.0, -6.0), at(6.0, -6.0), at(6.0, 6.0), at(-6.0, 6.0)]),
            Mark::Pole => ("pole", vec![at(0.0, -8.0), at(8.0, 0.0), at(0.0, 8.0), at(-8.0, 0.0)]),
            Mark::Corner => ("corner", vec![at(-4.0, -4.0), at(4.0, -4.0), at(4.0, 4.0), at(-4.0, 4.0)]),
        };
        let _ = writeln!(text, "<path class=\"{class}\" d=\"M{}Z\"/>", points.join("L"));
    }
}

fn draw_legend(text: &mut String, shade: &Shade<'_>, y: f64) {
    for step in 0..=SHADES {
        let x = MARGIN + 12.0 * step as f64;
        let colour = sand(step as f64 / SHADES as f64);
        let _ = write!(
            text,
            "<rect x=\"{x}\" y=\"{}\" width=\"12\" height=\"10\" fill=\"{colour}\"/>",
            rounded(y - 9.0, 1)
        );
    }
    let label = format!("{}: 0 to {}", shade.label, rounded(shade.darkest, 4));
    let x = MARGIN + 12.0 * (SHADES + 2) as f64;
    let _ = writeln!(text, "<text x=\"{x}\" y=\"{}\">{}</text>", rounded(y, 1), escape(&label));
}

pub(super) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::sample::square_with_pole;

    #[test]
    fn marks_what_is_singular() {
        let marks = singular_vertices(&square_with_pole());
        assert_eq!(marks, [(0, Mark::Corner), (2, Mark::Pole), (3, Mark::Corner)]);
    }

    #[test]
    fn draws_within_its_frame_and_escapes() {
        let shade = Some(Shade { label: "curvature", values: &[0.0, 0.5], darkest: 0.5 });
        let plan = Plan { shade, supports: vec![([0.0, 0.0, 0.0], true)] };
        let text = String::from_utf8(svg(&square_with_pole(), "a < b", &plan)).unwrap();
        assert!(text.contains("<title>a &lt; b</title>"), "{text}");
        assert!(text.contains(&format!("fill=\"{}\" d=\"M824 290.7L424 24L424 424Z\"", sand(1.0))), "{text}");
        assert!(text.contains("curvature: 0 to 0.5"), "{text}");
        assert!(text.contains(">a &lt; b</text>") && text.contains("class=\"support held\""), "{text}");
        assert!(text.ends_with("</svg>\n"));
    }

    #[test]
    fn the_scale_is_a_round_length_drawn_to_scale() {
        for (side, length) in [(4.0, "1 m"), (36.0, "5 m"), (100.0, "20 m"), (0.3, "0.05 m")] {
            let frame = Frame::of(&[[0.0, 0.0, 0.0], [side, 0.5 * side, 3.0]]);
            let bar = frame.scale_bar([24.0, 100.0]);
            assert!(bar.contains(&format!(">{length}</text>")), "{bar}");
            let metres: f64 = length.trim_end_matches(" m").parse().unwrap();
            assert!(bar.contains(&format!("H{}V", rounded(24.0 + 800.0 * metres / side, 1))), "{bar}");
        }
    }
}
