//! Forks that are one, or touch one boundary point, are joined while their vertex has not too many edges.

use super::graph::{Branch, End, Fork, Graph, NEAR, between, plan, slot_of};
use super::triangulation::distance;
use crate::domain::Domain;

/// Lengths, by the radius, that differ by less are alike but for the places of the samples.
const ALIKE: f64 = 1e-3;

/// A branch between two forks that may become one.
#[derive(Clone, Copy, Debug)]
struct Short {
    branch: usize,
    /// Distance of the forks by the smaller radius.
    length: f64,
    /// Each fork and its slot with the branch.
    ends: [[usize; 2]; 2],
}

impl Graph {
    /// Contracts the shortest branch between two forks that are nearer than a share of their radius or share a boundary point, and
    /// together have not too many edges.
    pub(super) fn contract_where(&mut self, domain: &Domain, share: f64, most: usize) -> bool {
        let found = |b| self.contractible(domain, b, share, most);
        let mut candidates: Vec<Short> = (0..self.branches.len()).filter_map(found).collect();
        candidates.sort_by(|a, b| a.length.total_cmp(&b.length));
        // Of two that exclude each other and are as short, as in a symmetric domain, to choose either would be chance.
        let rivals = |a: &Short, b: &Short| {
            let mut forks = vec![a.ends[0][0], a.ends[1][0], b.ends[0][0], b.ends[1][0]];
            forks.sort_unstable();
            forks.dedup();
            let edges = || forks.iter().map(|&f| self.valence(domain, f)).sum::<usize>();
            forks.len() == 3 && (a.length - b.length).abs() < ALIKE && edges() - 8 > most
        };
        let Some(&Short { branch, ends: [first, second], .. }) =
            candidates.iter().find(|c| !candidates.iter().any(|other| rivals(c, other)))
        else {
            return false;
        };
        self.contract(domain, branch, first, second);
        true
    }

    /// A branch that may be contracted.
    fn contractible(&self, domain: &Domain, b: usize, share: f64, most: usize) -> Option<Short> {
        let Some(Branch { ends: [End::Fork(f), End::Fork(g)], .. }) = self.branches[b] else { return None };
        let (first, second) = (self.forks[f].as_ref()?, self.forks[g].as_ref()?);
        if f == g {
            return None;
        }
        let radius = |fork: &Fork| distance(fork.position, plan(domain, fork.ring[0].site));
        let length = distance(first.position, second.position) / radius(first).min(radius(second));
        let (i, j) = (slot_of(first, b, 0)?, slot_of(second, b, 1)?);
        let same = |p: usize, q: usize| first.ring[p].site == second.ring[q].site;
        let (n, m) = (first.ring.len(), second.ring.len());
        let joined = length <= share || share >= NEAR && (same(i, (j + 1) % m) || same((i + 1) % n, j));
        // Two boundary points become one on either side of the branch, which goes with both its ends.
        let edges = || self.valence(domain, f) + self.valence(domain, g) - 4;
        // A corner that is joined to another would be lost.
        let loses = |p: usize, q: usize| {
            let [a, b] = [first.ring[p].site, second.ring[q].site];
            a != b && a.corner.is_some() && b.corner.is_some()
        };
        let lost = loses(i, (j + 1) % m) || loses((i + 1) % n, j);
        (joined && !lost && edges() <= most).then_some(Short { branch: b, length, ends: [[f, i], [g, j]] })
    }

    /// Makes one fork of the two at the ends of a branch, which is in slot `i` of fork `f` and in slot `j` of fork `g`.
    fn contract(&mut self, domain: &Domain, branch: usize, [f, i]: [usize; 2], [g, j]: [usize; 2]) {
        let (Some(first), Some(second)) = (self.forks[f].take(), self.forks[g].take()) else { return };
        let (n, m) = (first.ring.len(), second.ring.len());
        // The two points on the right of the branch become one, and the two on its left.
        let right = between(domain, first.ring[i].site, second.ring[(j + 1) % m].site);
        let left = between(domain, second.ring[j].site, first.ring[(i + 1) % n].site);
        let mut ring = Vec::with_capacity(n + m - 2);
        ring.extend((1..n).map(|k| first.ring[(i + k) % n]));
        ring.extend((1..m).map(|k| second.ring[(j + k) % m]));
        // The slots start after the branch on the one side and on the other.
        if let Some(slot) = ring.first_mut() {
            slot.site = left;
        }
        if let Some(slot) = ring.get_mut(n - 1) {
            slot.site = right;
        }
        // By how many forks of three points each is made of, so that the order does not matter.
        let weights = [n, m].map(|k| k.saturating_sub(2).max(1) as f64);
        let position = [0, 1].map(|k| {
            (weights[0] * first.position[k] + weights[1] * second.position[k]) / (weights[0] + weights[1])
        });
        self.branches[branch] = None;
        for slot in &ring {
            self.attach(slot.branch, slot.end, End::Fork(f));
        }
        self.forks[f] = Some(Fork { position, ring });
    }
}
