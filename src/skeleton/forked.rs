//! From a medial axis with forks to a layout: two quads a branch between forks, one a leaf.

use super::forkless::shoulders;
use super::graph::{Branch, End, Fork, Graph, Slot, along, is_long, plan, stretch};
use super::layout::Layout;
use super::triangulation::{Site, distance};
use crate::domain::Domain;
use std::collections::{BTreeMap, BTreeSet};

/// The vertices of the forks and of their boundary points.
struct Vertices {
    forks: BTreeMap<usize, usize>,
    sites: BTreeMap<(usize, usize), usize>,
}

/// The layout of a graph with at least one fork.
pub(super) fn layout(graph: &Graph, domain: &Domain) -> Layout {
    let mut layout = Layout::default();
    let mut vertices = Vertices { forks: BTreeMap::new(), sites: BTreeMap::new() };
    for f in graph.fork_numbers() {
        let Some(fork) = &graph.forks[f] else { continue };
        vertices.forks.insert(f, layout.inside(fork.position));
        for (i, slot) in fork.ring.iter().enumerate() {
            vertices.sites.insert((f, i), layout.on_boundary(domain, slot.site));
        }
    }
    for (b, branch) in graph.branches.iter().enumerate() {
        let Some(branch) = branch else { continue };
        match branch.ends {
            [End::Fork(f), End::Fork(g)] => corridor(&mut layout, &vertices, graph, domain, b, [f, g]),
            [End::Fork(f), End::Leaf(tip)] | [End::Leaf(tip), End::Fork(f)] => {
                leaf(&mut layout, &vertices, graph, domain, b, f, tip);
            }
            _ => {}
        }
    }
    layout
}

/// Fork, slot number and number of slots at an end of a branch.
fn slot(graph: &Graph, fork: usize, wanted: impl Fn(&Slot) -> bool) -> Option<(&Fork, usize, usize)> {
    let found = graph.forks[fork].as_ref()?;
    Some((found, found.ring.iter().position(wanted)?, found.ring.len()))
}

/// The quad of a leaf: fork, boundary point, tip, boundary point; of a long one with a smooth end two quads beside the axis, whose
/// end is the boundary between the points where it has turned by 45°.
fn leaf(
    layout: &mut Layout,
    vertices: &Vertices,
    graph: &Graph,
    domain: &Domain,
    b: usize,
    f: usize,
    tip: Site,
) {
    let Some((fork, i, n)) = slot(graph, f, |s| s.branch == b) else { return };
    let before = [vertices.forks[&f], vertices.sites[&(f, i)], vertices.sites[&(f, (i + 1) % n)]];
    let end = layout.on_boundary(domain, tip);
    if is_long(domain, fork, i, tip) {
        let [right, left] = ends_of_sides(domain, [fork.ring[i].site, fork.ring[(i + 1) % n].site], tip);
        let after = [end, layout.on_boundary(domain, right), layout.on_boundary(domain, left)];
        add_pair(layout, before, after);
    } else {
        layout.faces.push([before[0], before[1], end, before[2]]);
    }
}

/// Where the right and the left side of a long leaf end: where the boundary has turned by 45°, or not far from the tip.
fn ends_of_sides(domain: &Domain, [right, left]: [Site; 2], tip: Site) -> [Site; 2] {
    let [before, after] = shoulders(domain, tip);
    let fits = stretch(domain, before, tip) < 0.8 * stretch(domain, right, tip)
        && stretch(domain, tip, after) < 0.8 * stretch(domain, tip, left);
    if fits { [before, after] } else { [along(domain, right, tip, 0.7), along(domain, tip, left, 0.3)] }
}

/// The quads on both sides of a branch between forks, with as many stations in between as corners and simplicity ask for.
fn corridor(
    layout: &mut Layout,
    vertices: &Vertices,
    graph: &Graph,
    domain: &Domain,
    b: usize,
    [f, g]: [usize; 2],
) {
    let Some(branch) = &graph.branches[b] else { return };
    let Some((first, i, n)) = slot(graph, f, |s| s.branch == b && s.end == 0) else { return };
    let Some((second, j, m)) = slot(graph, g, |s| s.branch == b && s.end == 1) else { return };
    let ends = [
        [first.ring[i].site, first.ring[(i + 1) % n].site],
        [second.ring[(j + 1) % m].site, second.ring[j].site],
    ];
    let pairs = stations(domain, branch, ends, needed(graph, b, [f, g]));
    let mut right: Vec<Site> = std::iter::once(ends[0][0]).chain(pairs.iter().map(|p| p[0])).collect();
    right.push(ends[1][0]);
    // The left side runs backwards.
    let mut left: Vec<Site> = std::iter::once(ends[1][1]).chain(pairs.iter().rev().map(|p| p[1])).collect();
    left.push(ends[0][1]);
    spread(domain, &mut right);
    spread(domain, &mut left);
    left.reverse();
    let mut before = [vertices.forks[&f], vertices.sites[&(f, i)], vertices.sites[&(f, (i + 1) % n)]];
    for k in 1..=pairs.len() {
        let (r, l) = (layout.on_boundary(domain, right[k]), layout.on_boundary(domain, left[k]));
        let (p, q) = (layout.vertices[r].xy, layout.vertices[l].xy);
        let axis = layout.inside([0, 1].map(|k| 0.5 * (p[k] + q[k])));
        add_pair(layout, before, [axis, r, l]);
        before = [axis, r, l];
    }
    let after = [vertices.forks[&g], vertices.sites[&(g, (j + 1) % m)], vertices.sites[&(g, j)]];
    add_pair(layout, before, after);
}

/// The two quads between two cross sections, each given by its axis, right and left vertex.
fn add_pair(layout: &mut Layout, [a, r, l]: [usize; 3], [b, s, m]: [usize; 3]) {
    layout.faces.push([a, r, s, b]);
    layout.faces.push([a, b, m, l]);
}

/// Stations that keep the mesh simple: one where another branch joins the same forks, two where the forks are the same.
fn needed(graph: &Graph, b: usize, [f, g]: [usize; 2]) -> usize {
    if f == g {
        return 2;
    }
    let joins = |other: &Option<Branch>| {
        other
            .as_ref()
            .is_some_and(|o| o.ends == [End::Fork(f), End::Fork(g)] || o.ends == [End::Fork(g), End::Fork(f)])
    };
    let parallel = graph.branches.iter().enumerate().any(|(k, other)| k != b && joins(other));
    usize::from(parallel)
}

/// Cross sections where a corner lies on a side, and evenly chosen ones up to the number needed.
fn stations(domain: &Domain, branch: &Branch, ends: [[Site; 2]; 2], needed: usize) -> Vec<[Site; 2]> {
    let pairs = &branch.pairs;
    let mut chosen: Vec<usize> = Vec::new();
    for side in 0..2 {
        let mut i = 0;
        while i < pairs.len() {
            let site = pairs[i][side];
            let run = pairs[i..].iter().take_while(|p| p[side] == site).count();
            if site.corner.is_some() && site != ends[0][side] && site != ends[1][side] {
                let other = 1 - side;
                // Rather where the other side has a corner too, or else in the middle.
                let facing = (i..i + run).find(|&k| {
                    pairs[k][other].corner.is_some()
                        && pairs[k][other] != ends[0][other]
                        && pairs[k][other] != ends[1][other]
                });
                chosen.push(facing.unwrap_or(i + run / 2));
            }
            i += run;
        }
    }
    chosen.sort_unstable();
    chosen.dedup();
    let mut sections: Vec<[Site; 2]> = chosen.into_iter().map(|k| pairs[k]).collect();
    once_each(&mut sections, ends.into_iter().flatten());
    sections.retain(|p| corner_count(p) > 0);
    join_facing(domain, &mut sections);
    if sections.len() < needed && !pairs.is_empty() {
        // Corners left out here are given their strips later.
        sections = (1..=needed).map(|k| pairs[k * pairs.len() / (needed + 1)]).collect();
        once_each(&mut sections, ends.into_iter().flatten());
    }
    sections
}

/// Lets every corner end one cross section only, rather one that has corners at both ends; at its other ends the boundary point
/// is free to move.
pub(super) fn once_each(pairs: &mut [[Site; 2]], taken: impl Iterator<Item = Site>) {
    let mut seen: BTreeSet<usize> = taken.filter_map(|s| s.corner).collect();
    let mut order: Vec<usize> = (0..pairs.len()).collect();
    order.sort_by_key(|&k| std::cmp::Reverse(corner_count(&pairs[k])));
    for k in order {
        for site in &mut pairs[k] {
            if site.corner.is_some_and(|c| !seen.insert(c)) {
                site.corner = None;
            }
        }
    }
}

fn corner_count(pair: &[Site; 2]) -> usize {
    pair.iter().filter(|s| s.corner.is_some()).count()
}

/// Makes one oblique cross section of two neighbours, of which one ends in a corner on the right and the other in a corner on the
/// left, where they are nearer to each other than half their width.
fn join_facing(domain: &Domain, pairs: &mut Vec<[Site; 2]>) {
    let width = |[r, l]: [Site; 2]| distance(plan(domain, r), plan(domain, l));
    let gap = |a: Site, b: Site| distance(plan(domain, a), plan(domain, b));
    let mut k = 0;
    while k + 1 < pairs.len() {
        let (first, second) = (pairs[k], pairs[k + 1]);
        let corners = |p: [Site; 2]| p.map(|s| s.corner.is_some());
        let near = 0.5 * width(first).min(width(second));
        let close = gap(first[0], second[0]) < near && gap(first[1], second[1]) < near;
        let joined = match (corners(first), corners(second)) {
            ([true, false], [false, true]) if close => Some([first[0], second[1]]),
            ([false, true], [true, false]) if close => Some([second[0], first[1]]),
            _ => None,
        };
        if let Some(pair) = joined {
            pairs[k] = pair;
            pairs.remove(k + 1);
        }
        k += 1;
    }
}

/// Puts the sites between the first and the last, in the order of the boundary, clear of each other: corners stay, others are
/// spaced evenly where two are too close or in the wrong order.
pub(super) fn spread(domain: &Domain, sites: &mut [Site]) {
    let (Some(&first), Some(&last), n) = (sites.first(), sites.last(), sites.len()) else { return };
    let whole = domain.loops[first.loop_number].length();
    let total = match stretch(domain, first, last) {
        0.0 => whole,
        way => way,
    };
    let mut ways: Vec<f64> = sites.iter().map(|&s| stretch(domain, first, s)).collect();
    ways[n - 1] = total;
    let least = 0.15 * total / n as f64;
    if ways.windows(2).all(|w| w[1] - w[0] >= least) {
        return;
    }
    let fixed: Vec<usize> = (0..n).filter(|&i| i == 0 || i == n - 1 || sites[i].corner.is_some()).collect();
    for w in fixed.windows(2) {
        let (before, count) = (w[0], w[1] - w[0]);
        for (k, site) in sites[before + 1..w[1]].iter_mut().enumerate() {
            let way = ways[before] + (k + 1) as f64 / count as f64 * (ways[w[1]] - ways[before]);
            let s = if first.loop_number == 0 { first.s + way } else { first.s - way };
            site.s = s.rem_euclid(whole) % whole;
        }
    }
}
