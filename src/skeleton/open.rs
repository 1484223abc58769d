//! Forks with too many edges are opened: two forks with a short corridor between them, so that strings have room for strips.
//!
//! The corridor lies across two boundary points of the old fork; it is a strip of quads between them, so quads stay quads. Forks
//! that share a boundary point, which touch one re-entrant corner, then each get one of their own beside it.

use super::graph::{Branch, End, Fork, Graph, Slot, plan, sector, stretch};
use super::triangulation::{Site, distance};
use crate::domain::Domain;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Forks with more edges are opened, and none with more is made by joining forks.
pub(super) const MOST: usize = 6;
/// Forks nearer to each other than this share of their radius are moved apart,
const NEAR: f64 = 0.15;
/// this share of the way to the middle of their boundary points.
const APART: f64 = 0.3;
/// Forks whose directions from a corner are off its middle by as much but for this angle in degrees are alike.
const ALIKE: f64 = 10.0;

/// Opens forks until none has more than [`MOST`] edges.
pub(super) fn forks(graph: &mut Graph, domain: &Domain) {
    let mut f = 0;
    while f < graph.forks.len() {
        let crowded = graph.forks[f].is_some() && graph.valence(domain, f) > MOST;
        match crowded.then(|| best_cut(graph, domain, f)).flatten() {
            Some(cut) => split(graph, f, cut),
            None => f += 1,
        }
    }
}

/// The two boundary points across which a fork is best opened: the most even valences, then the straightest cut, then the one
/// nearest to the start of its loops, which a mirrored domain keeps.
fn best_cut(graph: &Graph, domain: &Domain, f: usize) -> Option<[usize; 2]> {
    let fork = graph.forks[f].as_ref()?;
    let n = fork.ring.len();
    let edges =
        |from: usize, to: usize| 2 + (from..to).map(|k| graph.edges(domain, fork, k % n)).sum::<usize>();
    let rank = |&[i, j]: &[usize; 2]| {
        let most = edges(i, j).max(edges(j, i + n));
        let point = |k: usize| plan(domain, fork.ring[k].site);
        let bend = (sector(fork.position, point(i), point(j)) - PI).abs();
        let start = [i, j].map(|k| to_start(domain, fork.ring[k].site));
        (most, (50.0 * bend).round() as i64, (1e4 * start[0].min(start[1])).round() as i64)
    };
    let cuts = (0..n).flat_map(|i| (i + 2..n).map(move |j| [i, j])).filter(|&[i, j]| i + n >= j + 2);
    cuts.min_by_key(rank)
}

/// Share of its loop between a site and the loop's start, the shorter way.
fn to_start(domain: &Domain, site: Site) -> f64 {
    let length = domain.loops[site.loop_number].length();
    site.s.min(length - site.s) / length
}

/// Makes two forks of one: the slots from `i` on to before `j`, and the others.
fn split(graph: &mut Graph, f: usize, [i, j]: [usize; 2]) {
    let Some(fork) = graph.forks[f].take() else { return };
    let (n, branch, g) = (fork.ring.len(), graph.branches.len(), graph.forks.len());
    let part = |from: usize, to: usize, end: usize| {
        let mut ring: Vec<Slot> = (from..to).map(|k| fork.ring[k % n]).collect();
        ring.push(Slot { site: fork.ring[to % n].site, branch, end });
        Fork { position: fork.position, ring }
    };
    let (first, second) = (part(i, j, 0), part(j, i + n, 1));
    let pairs = vec![[fork.ring[j].site, fork.ring[i].site]];
    graph.branches.push(Some(Branch { ends: [End::Fork(f), End::Fork(g)], pairs }));
    for slot in &second.ring {
        graph.attach(slot.branch, slot.end, End::Fork(g));
    }
    graph.forks[f] = Some(first);
    graph.forks.push(Some(second));
}

/// Moves forks that lie on each other, opened ones and those whose discs are one, towards their own boundary points.
pub(super) fn apart(graph: &mut Graph, domain: &Domain) {
    let radius = |fork: &Fork| distance(fork.position, plan(domain, fork.ring[0].site));
    let is_near = |a: &Fork, b: &Fork| distance(a.position, b.position) < NEAR * radius(a).min(radius(b));
    let near: Vec<usize> = graph
        .branches
        .iter()
        .flatten()
        .filter_map(|branch| match branch.ends {
            [End::Fork(f), End::Fork(g)] if f != g => {
                let (first, second) = (graph.forks[f].as_ref()?, graph.forks[g].as_ref()?);
                is_near(first, second).then_some([f, g])
            }
            _ => None,
        })
        .flatten()
        .collect();
    for f in graph.fork_numbers().into_iter().filter(|f| near.contains(f)) {
        let Some(fork) = &mut graph.forks[f] else { continue };
        let mean = |k: usize| {
            fork.ring.iter().map(|slot| plan(domain, slot.site)[k]).sum::<f64>() / fork.ring.len() as f64
        };
        let mean = [mean(0), mean(1)];
        fork.position = [0, 1].map(|k| fork.position[k] + APART * (mean[k] - fork.position[k]));
    }
}

/// Gives forks that share a boundary point one each, in their order along the boundary. A corner goes to the fork that lies most
/// nearly in its middle; if two do alike to neither, but to a cross section of the corridor between them.
pub(super) fn shared_points(graph: &mut Graph, domain: &Domain) {
    let mut holders: BTreeMap<(usize, u64), Vec<[usize; 2]>> = BTreeMap::new();
    for f in graph.fork_numbers() {
        for (i, slot) in graph.forks[f].iter().flat_map(|fork| fork.ring.iter().enumerate()) {
            holders.entry((slot.site.loop_number, slot.site.s.to_bits())).or_default().push([f, i]);
        }
    }
    // What was there before: the room of one point does not depend on which came first.
    let taken = graph.sites(domain);
    for shared in holders.into_values().filter(|h| h.len() > 1) {
        let chain = in_order(graph, &shared);
        let Some(site) = graph.slot(chain[0]).map(|slot| slot.site) else { continue };
        let [back, ahead] = room(domain, &taken, site);
        let twice = middle(graph, domain, &chain, site);
        let (before, after) = (twice.div_ceil(2), chain.len() - 1 - twice / 2);
        for (k, &place) in chain.iter().enumerate().filter(|(k, _)| 2 * k != twice) {
            let way = if 2 * k < twice {
                -back * (before - k) as f64 / (before + 1) as f64
            } else {
                ahead * (k - twice / 2) as f64 / (after + 1) as f64
            };
            graph.move_site(place, shifted(domain, site, way));
        }
        // No other corridor is to have a cross section there.
        let kept = graph.slot(chain[twice / 2]).filter(|_| twice % 2 == 1).map(|slot| slot.branch);
        let others = graph.branches.iter_mut().enumerate().filter(|&(b, _)| Some(b) != kept);
        let sites =
            others.filter_map(|(_, branch)| branch.as_mut()).flat_map(|b| b.pairs.iter_mut().flatten());
        sites.filter(|other| **other == site).for_each(|other| other.corner = None);
    }
}

/// Twice the place in a chain that a shared point belongs to; odd between two forks.
fn middle(graph: &Graph, domain: &Domain, chain: &[[usize; 2]], site: Site) -> usize {
    let last = chain.len() - 1;
    if site.corner.is_none() {
        return last;
    }
    let (inward, place) = (inward(domain, site), plan(domain, site));
    let off: Vec<f64> = chain
        .iter()
        .filter_map(|&[f, _]| graph.forks[f].as_ref())
        .map(|fork| {
            let [x, y] = [0, 1].map(|k| fork.position[k] - place[k]);
            libm::atan2(inward[0] * y - inward[1] * x, inward[0] * x + inward[1] * y).abs()
        })
        .collect();
    let best = (0..off.len()).fold(0, |best, k| if off[k] < off[best] { k } else { best });
    let alike = |k: &usize| *k != best && off.get(*k).is_some_and(|o| o - off[best] < ALIKE.to_radians());
    match [best.wrapping_sub(1), best + 1].into_iter().find(alike) {
        Some(other) => best + other,
        None => 2 * best,
    }
}

/// The direction from a corner into the domain, along the middle of its angle.
fn inward(domain: &Domain, site: Site) -> [f64; 2] {
    let boundary = &domain.loops[site.loop_number];
    let (after, before) = (boundary.tangent(site.s), boundary.tangent(site.s - 1e-7 * boundary.length()));
    let along = [0, 1].map(|k| before[k] + after[k]);
    if site.loop_number == 0 { [-along[1], along[0]] } else { [along[1], -along[0]] }
}

/// Forks, by their slots with the shared point, as they follow each other along the boundary with the domain on the left.
fn in_order(graph: &Graph, shared: &[[usize; 2]]) -> Vec<[usize; 2]> {
    let next = |&[f, i]: &[usize; 2]| {
        let [g, j] = graph.beyond(f, i)?;
        let count = graph.forks[g].as_ref()?.ring.len();
        Some([g, (j + 1) % count]).filter(|place| shared.contains(place))
    };
    let followed: Vec<[usize; 2]> = shared.iter().filter_map(next).collect();
    let mut chain: Vec<[usize; 2]> = Vec::with_capacity(shared.len());
    // One chain as a rule; what is not joined to it comes after.
    let starts = shared.iter().filter(|place| !followed.contains(place)).chain(shared);
    for &start in starts {
        let mut place = Some(start);
        while let Some(found) = place.filter(|found| !chain.contains(found)) {
            chain.push(found);
            place = next(&found);
        }
    }
    chain
}

/// Ways from a site back and ahead along its loop to the next other ones; at most a quarter of the loop.
fn room(domain: &Domain, taken: &[Site], site: Site) -> [f64; 2] {
    let length = domain.loops[site.loop_number].length();
    let others = || taken.iter().filter(|t| t.loop_number == site.loop_number && t.s != site.s);
    let least = |ways: &mut dyn Iterator<Item = f64>| ways.fold(0.25 * length, f64::min);
    [
        least(&mut others().map(|&t| stretch(domain, t, site))),
        least(&mut others().map(|&t| stretch(domain, site, t))),
    ]
}

/// The point so far along the boundary, with the domain on the left, from a site.
fn shifted(domain: &Domain, site: Site, way: f64) -> Site {
    let length = domain.loops[site.loop_number].length();
    let s = if site.loop_number == 0 { site.s + way } else { site.s - way };
    Site { s: s.rem_euclid(length) % length, corner: None, ..site }
}
