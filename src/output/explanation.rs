//! The picture beside the words of `explain`: members coloured by utilisation, the member that governs, the node that
//! moves most, and the nodes that move in the first buckling mode.

use super::number::{rounded, significant};
use super::results::Developed;
use super::svg::{Frame, LINE, MARGIN, begin, escape, outline, support_key, supports};
use crate::structure::gridshell::{CombinationResult, Detailed, Place};
use std::fmt::Write;

/// Members of one colour share a path.
const SHADES: usize = 8;
/// Nodes that move less than this share of the largest movement are not part of the mode's picture.
const MODE_FROM: f64 = 0.3;
/// Radius of the node that moves most in the mode.
const MODE_RADIUS: f64 = 9.0;
/// Room beside the plan for labels, which would hide members on it.
const SIDE: f64 = 110.0;
/// Least distance of labels above each other.
const APART: f64 = 18.0;

const STYLE: &str = "\
.members path{fill:none;stroke-linecap:round}\
.boundary{fill:none;stroke:#111;stroke-width:1;stroke-dasharray:5 3}\
.mode{fill:#0072b2;fill-opacity:.35;stroke:#0072b2;stroke-width:.8}\
.governing{fill:none;stroke:#111;stroke-width:2}.member{stroke:#111;stroke-width:6;stroke-linecap:round}\
.node{fill:none;stroke:#009e73;stroke-width:4}\
text{font:13px sans-serif;fill:#111}.label{font-weight:bold}.leader{fill:none;stroke:#111;stroke-width:.8}";

/// The plan of a design with what governs it, labelled; none where no structure is configured.
///
/// Members are shaded by the utilisation that the metric counts, from 0 to the largest; circles have the size of a
/// node's movement in the first buckling mode. Numbers of nodes and members are those of the tables.
pub fn explanation(developed: &Developed, id: &str) -> Option<Vec<u8>> {
    let results = developed.results.as_ref()?;
    let frame = Frame::of(results.model.frame.nodes());
    let picture = Picture { developed, results, frame };
    let legend = picture.legend();
    let (width, height) = (picture.frame.width + 2.0 * MARGIN, picture.frame.height + 2.0 * MARGIN);
    let held = developed.supports();
    let lines = legend.len() as f64 + 1.5 + f64::from(u8::from(!held.is_empty()));
    let mut text = begin(width + 2.0 * SIDE, height + LINE * lines, &developed.title(id), STYLE);
    let _ = writeln!(text, "<g transform=\"translate({SIDE})\">");
    picture.members(&mut text);
    for boundary in &developed.design.pattern.loops {
        let path = outline(&picture.frame, &developed.design.pattern.positions, boundary);
        let _ = writeln!(text, "<path class=\"boundary\" d=\"{path}\"/>");
    }
    supports(&mut text, &picture.frame, &held);
    picture.mode(&mut text);
    let marked = [picture.governing_member(&mut text), picture.largest_deflection(&mut text)];
    picture.labels(&mut text, marked.into_iter().flatten().collect());
    text.push_str("</g>\n");
    text.push_str(&picture.frame.scale_bar([MARGIN, height + LINE * legend.len() as f64]));
    if !held.is_empty() {
        text.push_str(&support_key([MARGIN, height + LINE * (legend.len() + 1) as f64]));
    }
    for (index, Key { sample, words }) in legend.iter().enumerate() {
        let y = height + LINE * index as f64;
        let _ = writeln!(
            text,
            "<g transform=\"translate({MARGIN} {})\">{sample}<text x=\"114\" y=\"4\">{}</text></g>",
            rounded(y, 1),
            escape(words)
        );
    }
    text.push_str("</svg>\n");
    Some(text.into_bytes())
}

/// One line of the legend: a sample, centred on y = 0 within 100 units, and what it means.
struct Key {
    sample: String,
    words: String,
}

/// What is said of a mark, and where the mark is.
struct Label {
    mark: [f64; 2],
    radius: f64,
    words: String,
}

struct Picture<'a> {
    developed: &'a Developed,
    results: &'a Detailed,
    frame: Frame,
}

/// Light to dark in one hue: by lightness, so that it holds for the colour-blind and in print.
fn shade(share: f64) -> String {
    let (light, dark) = ([222.0, 214.0, 205.0], [150.0, 20.0, 10.0]);
    let [r, g, b] = [0, 1, 2].map(|c: usize| (light[c] + share * (dark[c] - light[c])).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn stroke(share: f64) -> String {
    format!("stroke=\"{}\" stroke-width=\"{}\"", shade(share), rounded(1.2 + 2.3 * share, 2))
}

impl Picture<'_> {
    /// The largest deflection: the combination it is taken in, the value and the node.
    fn deflection(&self) -> Option<(&CombinationResult, f64, u32)> {
        let value = self.results.response.deflection_m;
        let found = self.results.combinations.iter().find(|c| c.metrics.deflection.0 == value)?;
        match found.metrics.deflection.1 {
            Place::Node(node) => Some((found, value, node)),
            _ => None,
        }
    }

    /// The edge whose utilisation is the metric's, where it is one.
    fn governing(&self) -> Option<(&CombinationResult, u32)> {
        let combination = self.developed.analysed().governing()?;
        match combination.metrics.utilisation.1 {
            Place::Edge(edge) => Some((combination, edge)),
            _ => None,
        }
    }

    /// What each member uses, as the metric counts it.
    fn used(&self) -> Vec<f64> {
        let analysed = self.developed.analysed();
        let members = analysed.governing().map_or(&[][..], |c| &c.member_utilisation);
        members.iter().map(|used| analysed.utilisation(used)).collect()
    }

    fn at(&self, node: u32) -> [f64; 2] {
        let nodes = self.results.model.frame.nodes();
        nodes.get(node as usize).map_or([MARGIN; 2], |&position| self.frame.place(position))
    }

    fn members(&self, text: &mut String) {
        let used = self.used();
        let largest = used.iter().copied().fold(0.0, f64::max);
        let mut paths = vec![String::new(); SHADES + 1];
        for (member, value) in self.results.model.frame.members().iter().zip(&used) {
            let share = if largest > 0.0 { value / largest } else { 0.0 };
            let class = (share.clamp(0.0, 1.0) * SHADES as f64).round() as usize;
            let [a, b] = [member.start, member.end]
                .map(|node| self.frame.write(self.results.model.frame.nodes()[node as usize]));
            let _ = write!(paths[class], "M{a}L{b}");
        }
        text.push_str("<g class=\"members\">\n");
        for (class, path) in paths.iter().enumerate().filter(|(_, path)| !path.is_empty()) {
            let _ = writeln!(text, "<path {} d=\"{path}\"/>", stroke(class as f64 / SHADES as f64));
        }
        text.push_str("</g>\n");
    }

    /// A circle at each node that moves in the first buckling mode, of the size of its movement.
    fn mode(&self, text: &mut String) {
        let Some(mode) = &self.results.mode else { return };
        let moved: Vec<f64> =
            mode.shape.iter().map(|u| (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]).sqrt()).collect();
        let largest = moved.iter().copied().fold(0.0, f64::max);
        for (node, &movement) in moved.iter().enumerate().filter(|(_, m)| **m > MODE_FROM * largest) {
            let [x, y] = self.at(node as u32);
            let _ = writeln!(
                text,
                "<circle class=\"mode\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>",
                rounded(x, 1),
                rounded(y, 1),
                rounded(MODE_RADIUS * movement / largest, 1)
            );
        }
    }

    /// Marks the member that governs; its place and name.
    fn governing_member(&self, text: &mut String) -> Option<Label> {
        let (_, edge) = self.governing()?;
        let [a, b] = self.developed.design.pattern.edges[edge as usize].map(|node| self.at(node));
        let [x, y] = [0, 1].map(|axis| 0.5 * (a[axis] + b[axis]));
        let ends = [a, b].map(|[x, y]| format!("{} {}", rounded(x, 1), rounded(y, 1)));
        let _ = writeln!(text, "<path class=\"member\" d=\"M{}L{}\"/>", ends[0], ends[1]);
        let (cx, cy) = (rounded(x, 1), rounded(y, 1));
        let _ = writeln!(text, "<circle class=\"governing\" cx=\"{cx}\" cy=\"{cy}\" r=\"16\"/>");
        Some(Label { mark: [x, y], radius: 16.0, words: format!("member {edge}") })
    }

    /// Marks the node that moves most; its place and name.
    fn largest_deflection(&self, text: &mut String) -> Option<Label> {
        let (_, _, node) = self.deflection()?;
        let [x, y] = self.at(node);
        let (cx, cy) = (rounded(x, 1), rounded(y, 1));
        let _ = writeln!(text, "<circle class=\"node\" cx=\"{cx}\" cy=\"{cy}\" r=\"12\"/>");
        Some(Label { mark: [x, y], radius: 12.0, words: format!("node {node}") })
    }

    /// Names marks beside the plan, on the nearer side, with a line to each.
    fn labels(&self, text: &mut String, mut labels: Vec<Label>) {
        labels.sort_by(|a, b| a.mark[1].total_cmp(&b.mark[1]));
        let mut lowest = [f64::NEG_INFINITY; 2];
        for Label { mark: [x, y], radius, words } in labels {
            let right = x > MARGIN + 0.5 * self.frame.width;
            let at = y.max(lowest[usize::from(right)] + APART);
            lowest[usize::from(right)] = at;
            let (end, anchor, sign) = match right {
                true => (self.frame.width + 2.0 * MARGIN, "start", 1.0),
                false => (0.0, "end", -1.0),
            };
            let place = |[x, y]: [f64; 2]| format!("{} {}", rounded(x, 1), rounded(y, 1));
            let (from, to) = (place([x + sign * radius, y]), place([end, at]));
            let [x, y] = [end + 5.0 * sign, at + 4.5].map(|coordinate| rounded(coordinate, 1));
            let _ = writeln!(
                text,
                "<path class=\"leader\" d=\"M{from}L{to}\"/><text class=\"label\" x=\"{x}\" y=\"{y}\" \
                 text-anchor=\"{anchor}\">{}</text>",
                escape(&words)
            );
        }
    }

    fn legend(&self) -> Vec<Key> {
        let mut keys = Vec::new();
        if let Some(combination) = self.developed.analysed().governing() {
            let largest = self.used().into_iter().fold(0.0, f64::max);
            let sample = (0..=SHADES).fold(String::new(), |mut sample, class| {
                let x = 11 * class;
                let stroke = stroke(class as f64 / SHADES as f64);
                let _ = write!(sample, "<path {stroke} d=\"M{x} 0H{}\"/>", x + 11);
                sample
            });
            let words =
                format!("utilisation of members, {}: 0 to {}", combination.name, significant(largest));
            keys.push(Key { sample, words });
        }
        if let Some((combination, edge)) = self.governing() {
            let value = significant(self.results.response.utilisation);
            keys.push(Key {
                sample:
                    "<path class=\"member\" d=\"M38 0H62\"/><circle class=\"governing\" cx=\"50\" r=\"8\"/>"
                        .into(),
                words: format!("largest utilisation {value}, {}: member {edge}", combination.name),
            });
        }
        if let Some((combination, value, node)) = self.deflection() {
            keys.push(Key {
                sample: "<circle class=\"node\" cx=\"50\" r=\"6\"/>".into(),
                words: format!(
                    "largest deflection {} m, {}: node {node}",
                    significant(value),
                    combination.name
                ),
            });
        }
        if let Some(mode) = &self.results.mode {
            keys.push(Key {
                sample:
                    "<circle class=\"mode\" cx=\"40\" r=\"4\"/><circle class=\"mode\" cx=\"58\" r=\"8\"/>"
                        .into(),
                words: format!(
                    "nodes that move in the first buckling mode, {}: factor {}",
                    mode.combination,
                    significant(mode.factor)
                ),
            });
        }
        keys
    }
}
