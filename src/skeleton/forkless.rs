//! Domains whose medial axis has no fork: discs, lenses and drops, rings.

use super::forked::{once_each, spread};
use super::graph::{Branch, End, along, stretch};
use super::layout::Layout;
use super::triangulation::Site;
use crate::domain::Domain;
use std::f64::consts::{FRAC_PI_4, PI, TAU};

/// 4πA/L² of a loop in plan from which on it counts as a disc.
const ROUND: f64 = 0.95;

/// Outer loops longer than this many lengths of the hole's have more rows than it.
const WIDE: f64 = 4.0;

/// Whether the domain is one smooth loop, nearly round.
pub(super) fn is_disc(domain: &Domain) -> bool {
    let outer = &domain.loops[0];
    let points: Vec<_> = outer.sample(domain.size() / 200.0).iter().map(|&s| outer.point(s)).collect();
    let perimeter: f64 = (0..points.len())
        .map(|i| {
            let (a, b) = (points[i], points[(i + 1) % points.len()]);
            (a[0] - b[0]).hypot(a[1] - b[1])
        })
        .sum();
    domain.loops.len() == 1
        && domain.corner_count() == 0
        && 4.0 * PI * domain.area() > ROUND * perimeter * perimeter
}

/// One quad with its corners a quarter of the boundary apart, starting at the mark.
pub(super) fn disc(domain: &Domain) -> Layout {
    let length = domain.loops[0].length();
    let start = domain.mark().unwrap_or(0.0);
    let sites = [0.0, 0.25, 0.5, 0.75].map(|share| smooth((start + share * length) % length));
    one_quad(domain, sites)
}

fn smooth(s: f64) -> Site {
    Site { loop_number: 0, s, corner: None }
}

fn one_quad(domain: &Domain, sites: [Site; 4]) -> Layout {
    let mut layout = Layout::default();
    let quad = sites.map(|site| layout.on_boundary(domain, site));
    layout.faces.push(quad);
    layout
}

/// One quad from end to end: a corner is one of its corners, a smooth end two, where the boundary has turned by 45°.
pub(super) fn path(domain: &Domain, branch: &Branch, [start, end]: [Site; 2]) -> Layout {
    let middle = branch.pairs[branch.pairs.len() / 2];
    let sites = match (start.corner, end.corner) {
        (Some(_), Some(_)) => [start, middle[0], end, middle[1]],
        (Some(_), None) => {
            let [before, after] = shoulders(domain, end);
            [start, before, end, after]
        }
        (None, Some(_)) => {
            let [before, after] = shoulders(domain, start);
            [start, after, end, before]
        }
        (None, None) => {
            let ([l1, r1], [r2, l2]) = (shoulders(domain, start), shoulders(domain, end));
            [l1, r1, r2, l2]
        }
    };
    one_quad(domain, sites)
}

/// The points of a loop before and after a smooth end, with the domain on the left, at which the boundary has turned by 45°.
pub(super) fn shoulders(domain: &Domain, tip: Site) -> [Site; 2] {
    const STEPS: usize = 2000;
    let outer = &domain.loops[tip.loop_number];
    let length = outer.length();
    let heading = |s: f64| {
        let t = outer.tangent(s);
        libm::atan2(t[1], t[0])
    };
    let there = heading(tip.s);
    let onward = if tip.loop_number == 0 { 1.0 } else { -1.0 };
    [-1.0, 1.0].map(|sign| {
        let at = |i: usize| tip.s + onward * sign * i as f64 / STEPS as f64 * length;
        let turned = |&i: &usize| {
            let turn = sign * (heading(at(i)) - there);
            turn.rem_euclid(TAU) >= FRAC_PI_4 && turn.rem_euclid(TAU) < PI
        };
        let steps = (1..STEPS / 4).find(turned).unwrap_or(STEPS / 8);
        Site { s: at(steps).rem_euclid(length) % length, corner: None, ..tip }
    })
}

/// A ring of quads between two loops: at the corners of both, and at least four.
pub(super) fn ring(domain: &Domain, branch: &Branch) -> Option<Layout> {
    let mut pairs: Vec<[Site; 2]> = branch.pairs.clone();
    // Outer site first, in the order of the outer loop.
    if pairs.first()?[0].loop_number != 0 {
        pairs = pairs.iter().rev().map(|&[right, left]| [left, right]).collect();
    }
    if pairs.iter().any(|[o, h]| o.loop_number != 0 || h.loop_number == 0) {
        return None;
    }
    let mut chosen = corner_sections(&pairs);
    if chosen.is_empty() {
        let mark = smooth(domain.mark().unwrap_or(0.0));
        let near = |p: &[Site; 2]| {
            let way = stretch(domain, mark, p[0]);
            way.min(domain.loops[0].length() - way)
        };
        let start = (0..pairs.len()).min_by(|&i, &j| near(&pairs[i]).total_cmp(&near(&pairs[j])))?;
        pairs[start][0] = mark;
        chosen.push(start);
    }
    while chosen.len() < 4 {
        let widest = widest_gap(domain, &pairs, &chosen)?;
        chosen.push(widest);
        chosen.sort_unstable();
    }
    // Once around from the first section, so that both sides can be spread.
    let mut sections: Vec<[Site; 2]> = chosen.iter().map(|&k| pairs[k]).collect();
    once_each(&mut sections, std::iter::empty());
    let mut outer: Vec<Site> = sections.iter().map(|p| p[0]).collect();
    let mut inner: Vec<Site> = sections.iter().map(|p| p[1]).collect();
    outer.push(outer[0]);
    inner.push(inner[0]);
    inner.reverse();
    spread(domain, &mut outer);
    spread(domain, &mut inner);
    inner.reverse();
    let n = chosen.len();
    let wide = domain.loops[0].length() > WIDE * domain.loops[inner[0].loop_number].length();
    if wide && domain.loops[0].corners().is_empty() {
        return Some(wide_ring(domain, &outer[..n], &inner[..n]));
    }
    let mut layout = Layout::default();
    let rings = [outer, inner]
        .map(|sites| sites[..n].iter().map(|&s| layout.on_boundary(domain, s)).collect::<Vec<_>>());
    for i in 0..n {
        let j = (i + 1) % n;
        layout.faces.push([rings[0][i], rings[0][j], rings[1][j], rings[1][i]]);
    }
    Some(layout)
}

/// A ring of quads about a small hole within a block with a corner at every section: the outer loop may have more rows than the
/// hole has room for.
fn wide_ring(domain: &Domain, outer: &[Site], inner: &[Site]) -> Layout {
    let mut layout = Layout::default();
    let n = outer.len();
    let sections: Vec<[usize; 5]> = (0..n)
        .map(|i| {
            let (before, after) = (outer[(i + n - 1) % n], outer[(i + 1) % n]);
            let sides =
                [along(domain, before, outer[i], 2.0 / 3.0), along(domain, outer[i], after, 1.0 / 3.0)];
            let [before, tip, after, hole] =
                [sides[0], outer[i], sides[1], inner[i]].map(|site| layout.on_boundary(domain, site));
            let (p, q) = (layout.vertices[tip].xy, layout.vertices[hole].xy);
            [layout.inside([0, 1].map(|k| 0.5 * (p[k] + q[k]))), before, tip, after, hole]
        })
        .collect();
    for i in 0..n {
        let ([fork, before, tip, after, hole], next) = (sections[i], sections[(i + 1) % n]);
        layout.faces.push([fork, before, tip, after]);
        layout.faces.push([after, next[1], next[0], fork]);
        layout.faces.push([fork, next[0], next[4], hole]);
    }
    layout
}

/// For every corner of either loop, the cross section in the middle of those that touch it.
fn corner_sections(pairs: &[[Site; 2]]) -> Vec<usize> {
    let n = pairs.len();
    let mut chosen = Vec::new();
    for sites in [0, 1].map(|side| pairs.iter().map(|p| p[side]).collect::<Vec<_>>()) {
        // Begin where a new site begins, so that no run is cut.
        let Some(start) = (0..n).find(|&i| sites[i] != sites[(i + n - 1) % n]) else { continue };
        let at = |k: usize| sites[(start + k) % n];
        let mut i = 0;
        while i < n {
            let run = (i..n).take_while(|&k| at(k) == at(i)).count();
            if at(i).corner.is_some() {
                chosen.push((start + i + run / 2) % n);
            }
            i += run;
        }
    }
    chosen.sort_unstable();
    chosen.dedup();
    chosen
}

/// The cross section nearest to the middle of the widest gap on the outer loop.
fn widest_gap(domain: &Domain, pairs: &[[Site; 2]], chosen: &[usize]) -> Option<usize> {
    let n = chosen.len();
    let length = domain.loops[0].length();
    let gap = |i: usize| match stretch(domain, pairs[chosen[i]][0], pairs[chosen[(i + 1) % n]][0]) {
        0.0 => length,
        way => way,
    };
    let widest = (0..n).fold(0, |best, i| if gap(i) > gap(best) * (1.0 + 1e-9) { i } else { best });
    let from = pairs[chosen[widest]][0];
    let middle = if n == 1 {
        smooth((from.s + 0.5 * length) % length)
    } else {
        along(domain, from, pairs[chosen[(widest + 1) % n]][0], 0.5)
    };
    let near = |k: usize| {
        let way = stretch(domain, middle, pairs[k][0]);
        way.min(length - way)
    };
    (0..pairs.len()).filter(|k| !chosen.contains(k)).min_by(|&i, &j| near(i).total_cmp(&near(j)))
}

/// The ends of a branch that is a path.
pub(super) fn path_ends(branch: &Branch) -> Option<[Site; 2]> {
    match branch.ends {
        [End::Leaf(a), End::Leaf(b)] if !branch.pairs.is_empty() => Some([a, b]),
        _ => None,
    }
}
