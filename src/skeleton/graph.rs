//! The medial axis as a graph: forks, where a disc touches the boundary in three places or more, and branches between them.

use super::open::MOST;
use super::triangulation::{Site, Triangulation, circumcenter, distance};
use crate::domain::Domain;

/// A fork. Around it, counter-clockwise, boundary points and branches take turns.
#[derive(Clone, Debug)]
pub(super) struct Fork {
    /// Centre of the disc.
    pub(super) position: [f64; 2],
    /// Each boundary point with the branch that follows it counter-clockwise.
    pub(super) ring: Vec<Slot>,
}

/// A place in the ring of a fork.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Slot {
    /// Where the disc touches the boundary.
    pub(super) site: Site,
    /// The branch after it.
    pub(super) branch: usize,
    /// Which end of the branch is here.
    pub(super) end: usize,
}

/// A branch of the axis, from its end 0 to its end 1.
#[derive(Clone, Debug)]
pub(super) struct Branch {
    /// Its two ends.
    pub(super) ends: [End; 2],
    /// Boundary points on the right and on the left along the way.
    pub(super) pairs: Vec<[Site; 2]>,
}

/// An end of a branch.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum End {
    /// At a fork.
    Fork(usize),
    /// In a corner, or where a smooth boundary bends most.
    Leaf(Site),
    /// None: the branch is a cycle without forks.
    Cycle,
}

/// Forks and branches; those that were taken out are `None`.
#[derive(Clone, Debug, Default)]
pub(super) struct Graph {
    pub(super) forks: Vec<Option<Fork>>,
    pub(super) branches: Vec<Option<Branch>>,
}

/// Leaves without a corner whose discs touch at less than this angle are no more than roughness of the boundary.
const ROUGH: f64 = 65.0;
/// Forks nearer to each other than this share of their radius are one.
pub(super) const NEAR: f64 = 0.05;
/// Smooth ends further along the boundary than this many radii of their fork are corridors.
const LONG: f64 = 2.5;

impl Graph {
    /// The graph of a triangulation's triangles with three neighbours, and the chains between them.
    pub(super) fn of(triangulation: &Triangulation) -> Self {
        let triangles = &triangulation.triangles;
        let neighbours = |t: usize| triangles[t].neighbours.iter().flatten().count();
        let mut graph = Self::default();
        let mut number = vec![usize::MAX; triangles.len()];
        for t in (0..triangles.len()).filter(|&t| neighbours(t) == 3) {
            number[t] = graph.forks.len();
            let slot = |i: usize| Slot {
                site: triangulation.sites[triangles[t].corners[i]],
                branch: usize::MAX,
                end: 0,
            };
            graph
                .forks
                .push(Some(Fork { position: triangulation.center(t), ring: (0..3).map(slot).collect() }));
        }
        let starts: Vec<usize> = if graph.forks.is_empty() {
            // One chain: from ear to ear, or round and round.
            (0..triangles.len())
                .find(|&t| neighbours(t) == 1)
                .or((!triangles.is_empty()).then_some(0))
                .into_iter()
                .collect()
        } else {
            (0..triangles.len()).filter(|&t| number[t] != usize::MAX).collect()
        };
        for t in starts {
            for i in (0..3).filter(|&i| triangles[t].neighbours[i].is_some()) {
                let fork = number[t];
                let known = fork != usize::MAX && graph.ring_branch(fork, i) != usize::MAX;
                if !known {
                    graph.walk(triangulation, &number, t, i);
                }
                if fork == usize::MAX {
                    break;
                }
            }
        }
        graph
    }

    fn ring_branch(&self, fork: usize, slot: usize) -> usize {
        self.forks[fork].as_ref().map_or(usize::MAX, |f| f.ring[slot].branch)
    }

    /// Follows a chain of triangles from edge `i` of triangle `start`, and adds it as a branch.
    fn walk(&mut self, triangulation: &Triangulation, number: &[usize], start: usize, i: usize) {
        let triangles = &triangulation.triangles;
        let site = |v: usize| triangulation.sites[v];
        let branch = self.branches.len();
        let first = if number[start] == usize::MAX {
            End::Leaf(site(triangles[start].corners[(i + 2) % 3]))
        } else {
            self.set(number[start], i, branch, 0);
            End::Fork(number[start])
        };
        let (mut t, mut edge) = (start, i);
        let mut pairs = Vec::new();
        let last = loop {
            let (right, left) = (triangles[t].corners[edge], triangles[t].corners[(edge + 1) % 3]);
            let Some(next) = triangles[t].neighbours[edge] else { break End::Leaf(site(right)) };
            pairs.push([site(right), site(left)]);
            let entry = (0..3).find(|&k| triangles[next].corners[k] == left).unwrap_or(0);
            if number[next] != usize::MAX {
                self.set(number[next], entry, branch, 1);
                break End::Fork(number[next]);
            }
            let onward = [(entry + 1) % 3, (entry + 2) % 3]
                .into_iter()
                .find(|&k| triangles[next].neighbours[k].is_some());
            match onward {
                None => break End::Leaf(site(triangles[next].corners[(entry + 2) % 3])),
                Some(_) if next == start => break End::Cycle,
                Some(k) => (t, edge) = (next, k),
            }
        };
        let first = if last == End::Cycle { last } else { first };
        self.branches.push(Some(Branch { ends: [first, last], pairs }));
    }

    fn set(&mut self, fork: usize, slot: usize, branch: usize, end: usize) {
        if let Some(fork) = &mut self.forks[fork] {
            fork.ring[slot].branch = branch;
            fork.ring[slot].end = end;
        }
    }

    /// Numbers of the forks that are there.
    pub(super) fn fork_numbers(&self) -> Vec<usize> {
        (0..self.forks.len()).filter(|&f| self.forks[f].is_some()).collect()
    }

    /// Takes out what is only roughness, joins forks that are one, until nothing changes.
    pub(super) fn simplify(&mut self, domain: &Domain) {
        // Points on one circle first: how they were triangulated is chance.
        while self.contract_where(domain, 1e-6, usize::MAX) {}
        loop {
            let changed = self.prune_rough(domain) || self.dissolve_passing();
            if !changed && !self.contract_where(domain, NEAR, MOST) {
                return;
            }
        }
    }

    /// Edges at the vertex of a fork: to its boundary points, and along its branches except those that end in one quad.
    pub(super) fn valence(&self, domain: &Domain, f: usize) -> usize {
        let Some(fork) = &self.forks[f] else { return 0 };
        (0..fork.ring.len()).map(|i| self.edges(domain, fork, i)).sum()
    }

    /// Edges that a slot brings to the vertex of its fork: one or two.
    pub(super) fn edges(&self, domain: &Domain, fork: &Fork, slot: usize) -> usize {
        let Slot { branch, end, .. } = fork.ring[slot];
        let along = match self.branches[branch].as_ref().map(|b| b.ends[1 - end]) {
            Some(End::Leaf(tip)) => is_long(domain, fork, slot, tip),
            _ => true,
        };
        1 + usize::from(along)
    }

    /// The slot at the other end of the branch in a slot.
    pub(super) fn beyond(&self, f: usize, i: usize) -> Option<[usize; 2]> {
        let slot = self.forks[f].as_ref()?.ring[i];
        let End::Fork(g) = self.branches[slot.branch].as_ref()?.ends[1 - slot.end] else { return None };
        Some([g, slot_of(self.forks[g].as_ref()?, slot.branch, 1 - slot.end)?])
    }

    /// A slot by its fork and its place in the ring.
    pub(super) fn slot(&self, [f, i]: [usize; 2]) -> Option<Slot> {
        self.forks[f].as_ref()?.ring.get(i).copied()
    }

    /// Gives a fork another boundary point in a slot.
    pub(super) fn move_site(&mut self, [f, i]: [usize; 2], site: Site) {
        if let Some(fork) = &mut self.forks[f] {
            fork.ring[i].site = site;
        }
    }

    /// The boundary points of all forks, the ends of all branches and the corners of the domain.
    pub(super) fn sites(&self, domain: &Domain) -> Vec<Site> {
        let rings = self.forks.iter().flatten().flat_map(|fork| fork.ring.iter().map(|slot| slot.site));
        let tips = self.branches.iter().flatten().flat_map(|b| b.ends).filter_map(|end| match end {
            End::Leaf(tip) => Some(tip),
            _ => None,
        });
        let corner = |c| domain.corner(c).map(|(loop_number, s)| Site { loop_number, s, corner: Some(c) });
        rings.chain(tips).chain((0..domain.corner_count()).filter_map(corner)).collect()
    }

    pub(super) fn attach(&mut self, branch: usize, end: usize, to: End) {
        if let Some(branch) = &mut self.branches[branch] {
            branch.ends[end] = to;
        }
    }

    /// Takes out the first leaf branch that is only roughness.
    fn prune_rough(&mut self, domain: &Domain) -> bool {
        for f in self.fork_numbers() {
            let Some(fork) = &self.forks[f] else { continue };
            let n = fork.ring.len();
            let Some(i) = (0..n).find(|&i| n > 1 && self.is_rough(domain, fork, i)) else { continue };
            let merged = between(domain, fork.ring[i].site, fork.ring[(i + 1) % n].site);
            self.branches[fork.ring[i].branch] = None;
            if let Some(fork) = &mut self.forks[f] {
                fork.ring[(i + 1) % n].site = merged;
                fork.ring.remove(i);
            }
            return true;
        }
        false
    }

    /// Whether the branch in a slot is a leaf without a corner that turns little or is very short.
    fn is_rough(&self, domain: &Domain, fork: &Fork, slot: usize) -> bool {
        let slot = fork.ring[slot];
        let Some(branch) = &self.branches[slot.branch] else { return false };
        let End::Leaf(tip) = branch.ends[1 - slot.end] else { return false };
        // The points where the branch sets out, which do not move when its neighbours are pruned.
        let pairs = branch.directed(slot.end);
        let (Some(&[right, left]), Some(&[a, b])) = (pairs.first(), pairs.last()) else { return false };
        let point = |site| plan(domain, site);
        let turn = sector(fork.position, point(right), point(left));
        let end = circumcenter(point(a), point(tip), point(b));
        let radius = distance(fork.position, point(slot.site));
        tip.corner.is_none() && (turn < ROUGH.to_radians() || distance(end, fork.position) < NEAR * radius)
    }

    /// Takes out the first fork that is none any more: with two branches, which become one, or with one, which ends there.
    fn dissolve_passing(&mut self) -> bool {
        for f in self.fork_numbers() {
            let Some(fork) = self.forks[f].clone() else { continue };
            match fork.ring[..] {
                [only] => self.attach(only.branch, only.end, End::Leaf(only.site)),
                [a, b] if a.branch == b.branch => self.close(a),
                [a, b] => self.join(a, b),
                _ => continue,
            }
            self.forks[f] = None;
            return true;
        }
        false
    }

    /// Two branches at a passing fork become one: from the far end of `a` to the far end of `b`.
    fn join(&mut self, a: Slot, b: Slot) {
        let (Some(first), Some(second)) = (self.branches[a.branch].take(), self.branches[b.branch].take())
        else {
            return;
        };
        // Towards the fork on the first, away from it on the second. Leaving along `a`, the site of `a` is on the right.
        let mut pairs = first.directed(1 - a.end);
        pairs.push([b.site, a.site]);
        pairs.extend(second.directed(b.end));
        let ends = [first.ends[1 - a.end], second.ends[1 - b.end]];
        for (k, end) in ends.into_iter().enumerate() {
            let old = if k == 0 { (a.branch, 1 - a.end) } else { (b.branch, 1 - b.end) };
            if let End::Fork(fork) = end
                && let Some(fork) = &mut self.forks[fork]
                && let Some(slot) = fork.ring.iter_mut().find(|s| (s.branch, s.end) == old)
            {
                (slot.branch, slot.end) = (a.branch, k);
            }
        }
        self.branches[a.branch] = Some(Branch { ends, pairs });
    }

    /// A branch from a passing fork to itself is a cycle; its ends are no forks.
    fn close(&mut self, slot: Slot) {
        if let Some(branch) = &mut self.branches[slot.branch] {
            branch.ends = [End::Cycle; 2];
        }
    }
}

impl Branch {
    /// The pairs of boundary points, on the right and on the left, going away from end `from`.
    pub(super) fn directed(&self, from: usize) -> Vec<[Site; 2]> {
        if from == 0 {
            self.pairs.clone()
        } else {
            self.pairs.iter().rev().map(|&[right, left]| [left, right]).collect()
        }
    }
}

/// Whether the smooth end that a slot leads to is so far off that one quad would be several times as long as wide.
pub(super) fn is_long(domain: &Domain, fork: &Fork, slot: usize, tip: Site) -> bool {
    let (right, left) = (fork.ring[slot].site, fork.ring[(slot + 1) % fork.ring.len()].site);
    if tip.corner.is_some() || [right, left].iter().any(|s| s.loop_number != tip.loop_number) {
        return false;
    }
    let way = stretch(domain, right, tip).min(stretch(domain, tip, left));
    way > LONG * distance(fork.position, plan(domain, right))
}

/// The slot of a fork that holds one end of a branch.
pub(super) fn slot_of(fork: &Fork, branch: usize, end: usize) -> Option<usize> {
    fork.ring.iter().position(|s| s.branch == branch && s.end == end)
}

/// The point in the middle of the boundary from `a` on to `b` (the domain on the left); a corner at one end stays.
pub(super) fn between(domain: &Domain, a: Site, b: Site) -> Site {
    if a.corner.is_some() || a == b {
        return a;
    }
    if b.corner.is_some() {
        return b;
    }
    along(domain, a, b, 0.5)
}

/// The point at a share of the boundary from `a` on to `b`, the domain on the left: backwards along a hole.
pub(super) fn along(domain: &Domain, a: Site, b: Site, share: f64) -> Site {
    let length = domain.loops[a.loop_number].length();
    let way = stretch(domain, a, b);
    let s = if a.loop_number == 0 { a.s + share * way } else { a.s - share * way };
    Site { loop_number: a.loop_number, s: s.rem_euclid(length) % length, corner: None }
}

/// Length of the boundary from `a` on to `b`, the domain on the left.
pub(super) fn stretch(domain: &Domain, a: Site, b: Site) -> f64 {
    let length = domain.loops[a.loop_number].length();
    let way = if a.loop_number == 0 { b.s - a.s } else { a.s - b.s };
    way.rem_euclid(length)
}

/// Angle at a point from one point counter-clockwise to another, in 0..2π.
pub(super) fn sector(center: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let direction = |p: [f64; 2]| libm::atan2(p[1] - center[1], p[0] - center[0]);
    (direction(to) - direction(from)).rem_euclid(std::f64::consts::TAU)
}

/// A boundary point in plan.
pub(super) fn plan(domain: &Domain, site: Site) -> [f64; 2] {
    let [x, y, _] = domain.loops[site.loop_number].point(site.s);
    [x, y]
}
