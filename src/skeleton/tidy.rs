//! Boundary vertices into the order in which the quads have them.
//!
//! Where a boundary is nearly an arc about a fork, the points that its disc touches are ill defined, and two forks may put theirs in
//! the wrong order or on each other. The quads know the order: it is that of the triangulation.

use super::graph::{plan, stretch};
use super::layout::{Layout, Vertex};
use super::triangulation::Site;
use crate::domain::Domain;
use std::collections::BTreeMap;

/// Moves as few boundary vertices as possible, and no corner, so that they follow one another along every loop.
pub(super) fn boundary(layout: &mut Layout, domain: &Domain) {
    for chain in chains(layout) {
        let sites: Vec<Site> = chain.iter().filter_map(|&v| layout.vertices[v].site).collect();
        if sites.len() < chain.len()
            || sites.len() < 2
            || sites.iter().any(|s| s.loop_number != sites[0].loop_number)
        {
            // Not a loop of the domain: the final check will say so.
            continue;
        }
        let kept = (0..sites.len())
            .map(|start| longest_in_order(&ways(domain, &sites, start), &sites, start))
            .max_by_key(|kept| kept.iter().map(|&i| weight(&sites[i])).sum::<usize>())
            .unwrap_or_default();
        if kept.len() < sites.len() {
            fill_between(layout, domain, &chain, &sites, &kept);
        }
    }
}

/// The boundary loops of the quads, with the domain on the left.
fn chains(layout: &Layout) -> Vec<Vec<usize>> {
    let darts = || layout.faces.iter().flat_map(|f| (0..4).map(move |k| (f[k], f[(k + 1) % 4])));
    let all: BTreeMap<(usize, usize), ()> = darts().map(|d| (d, ())).collect();
    let mut after: BTreeMap<usize, usize> = darts().filter(|&(a, b)| !all.contains_key(&(b, a))).collect();
    let mut chains = Vec::new();
    while let Some((start, mut v)) = after.pop_first() {
        let mut chain = vec![start];
        while let Some(next) = after.remove(&v) {
            chain.push(v);
            v = next;
        }
        chains.push(chain);
    }
    chains
}

/// Corners count more than all others together.
fn weight(site: &Site) -> usize {
    if site.corner.is_some() { 1000 } else { 1 }
}

/// Lengths along the boundary from one site to all, in the order of the chain from there.
fn ways(domain: &Domain, sites: &[Site], start: usize) -> Vec<f64> {
    let n = sites.len();
    let length = domain.loops[sites[0].loop_number].length();
    (0..n).map(|k| stretch(domain, sites[start], sites[(start + k) % n]) / length).collect()
}

/// The heaviest set of sites in strictly increasing order that begins with the first: numbers in the chain, ascending from it.
fn longest_in_order(ways: &[f64], sites: &[Site], start: usize) -> Vec<usize> {
    let n = ways.len();
    let apart = 1e-3 / n as f64;
    let mut best: Vec<(usize, usize)> = vec![(0, usize::MAX); n];
    best[0] = (weight(&sites[start]), usize::MAX);
    for k in 1..n {
        for j in 0..k {
            if best[j].0 > 0 && ways[k] > ways[j] + apart && ways[k] < 1.0 - apart {
                let sum = best[j].0 + weight(&sites[(start + k) % n]);
                if sum > best[k].0 {
                    best[k] = (sum, j);
                }
            }
        }
    }
    let mut k = (0..n).fold(0, |top, k| if best[k].0 > best[top].0 { k } else { top });
    let mut kept = Vec::new();
    while k != usize::MAX {
        kept.push((start + k) % n);
        k = best[k].1;
    }
    kept.reverse();
    kept
}

/// Spaces the vertices between kept ones evenly.
fn fill_between(layout: &mut Layout, domain: &Domain, chain: &[usize], sites: &[Site], kept: &[usize]) {
    let n = chain.len();
    let whole = domain.loops[sites[0].loop_number].length();
    for (i, &from) in kept.iter().enumerate() {
        let to = kept[(i + 1) % kept.len()];
        let count = if to == from { n } else { (to + n - from) % n };
        let way = match stretch(domain, sites[from], sites[to]) {
            0.0 => whole,
            way => way,
        };
        for k in 1..count {
            let ahead = way * k as f64 / count as f64;
            let loop_number = sites[from].loop_number;
            let s = if loop_number == 0 { sites[from].s + ahead } else { sites[from].s - ahead };
            let v = (from + k) % n;
            // A corner that does not fit its order is left: the mesh is refused.
            if sites[v].corner.is_none() {
                let site = Site { s: s.rem_euclid(whole) % whole, ..sites[v] };
                layout.vertices[chain[v]] = Vertex { xy: plan(domain, site), site: Some(site) };
            }
        }
    }
}
