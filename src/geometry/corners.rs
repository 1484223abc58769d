//! Which boundary vertex takes which corner of the domain (docs/reference/geometry.md §0.2).

use super::coarse::Coarse;
use crate::domain::Domain;
use std::cmp::Ordering;
use std::ops::Range;

/// After this many steps of the search the best assignment so far stands; only meshes with dozens of vertices that
/// carry several corners each come near it.
const MAX_STEPS: usize = 200_000;

/// The corners of one boundary loop and who takes them.
#[derive(Clone, PartialEq, Debug)]
pub struct LoopCorners {
    /// Their numbers in the domain.
    pub numbers: Range<usize>,
    /// Arc length of each along the loop, ascending, m.
    pub at: Vec<f64>,
    /// For each, the coarse vertex that takes it.
    pub taken: Vec<Option<u32>>,
    /// Whether they are kinks; false for the one mark of a domain without corners (docs/reference/geometry.md §0.4).
    pub sharp: bool,
}

impl LoopCorners {
    /// The most corners one after another that no coarse vertex takes; 0 if none is taken.
    pub fn longest_untaken(&self) -> usize {
        let taken: Vec<usize> = (0..self.taken.len()).filter(|&k| self.taken[k].is_some()).collect();
        let next = taken.iter().skip(1).copied().chain(taken.first().map(|k| k + self.taken.len()));
        taken.iter().zip(next).map(|(k, next)| next - k - 1).max().unwrap_or(0)
    }
}

/// Assigns the domain's corners to coarse boundary vertices, loop by loop.
///
/// Where a domain has no corner at all, its outer loop has one that is not sharp: the mark, number 0.
pub fn assign(coarse: &Coarse<'_>, domain: &Domain) -> Vec<LoopCorners> {
    let cornerless = domain.loops.iter().all(|l| l.corners().is_empty());
    let mut next = 0;
    let mut assigned = Vec::with_capacity(domain.loops.len());
    for (label, boundary) in domain.loops.iter().enumerate() {
        let marked = cornerless && label == 0;
        let at = if marked { vec![domain.mark().unwrap_or(0.0)] } else { boundary.corners().to_vec() };
        let numbers = next..next + at.len();
        next = numbers.end;
        let mut taken = assign_on_loop(coarse, label, &numbers);
        if !numbers.is_empty() && taken.iter().all(Option::is_none) {
            // No vertex carries a mark (only a base mesh from a file can do that): the pattern has to be held somewhere.
            taken[0] =
                coarse.loops[label].iter().copied().min_by_key(|&v| (coarse.vertex_faces[v as usize], v));
        }
        assigned.push(LoopCorners { numbers, at, taken, sharp: !marked });
    }
    assigned
}

/// How good an assignment is, best first: most taken, fewest faces, most even, smallest numbers.
#[derive(Clone)]
struct Choice {
    taken: usize,
    faces: u32,
    unevenness: i64,
    vertices: Vec<Option<u32>>,
}

impl Choice {
    fn is_better_than(&self, other: &Self) -> bool {
        let numbers = |c: &Self| c.vertices.iter().map(|v| v.unwrap_or(u32::MAX)).collect::<Vec<_>>();
        let order = other
            .taken
            .cmp(&self.taken)
            .then(self.faces.cmp(&other.faces))
            .then(self.unevenness.cmp(&other.unevenness))
            .then_with(|| numbers(self).cmp(&numbers(other)));
        order == Ordering::Less
    }
}

fn assign_on_loop(coarse: &Coarse<'_>, label: usize, numbers: &Range<usize>) -> Vec<Option<u32>> {
    let length = coarse.loops[label].len();
    let carriers: Vec<Vec<(usize, u32)>> = numbers
        .clone()
        .map(|k| {
            let marked = coarse.mesh.corners.get(k).map_or(&[][..], Vec::as_slice);
            let place = |&v: &u32| {
                coarse.on_loop[v as usize].filter(|on| on.label == label).map(|on| (on.position, v))
            };
            marked.iter().filter_map(place).collect()
        })
        .collect();
    let mut search = Search { coarse, length, carriers, chosen: Vec::new(), best: None, steps: 0 };
    search.run();
    search.best.map_or_else(|| vec![None; numbers.len()], |best| best.vertices)
}

struct Search<'a> {
    coarse: &'a Coarse<'a>,
    length: usize,
    /// For each corner of the loop, `(position, vertex)` of those that carry it.
    carriers: Vec<Vec<(usize, u32)>>,
    chosen: Vec<Option<(usize, u32)>>,
    best: Option<Choice>,
    steps: usize,
}

impl Search<'_> {
    fn run(&mut self) {
        self.steps += 1;
        let k = self.chosen.len();
        let taken = self.chosen.iter().flatten().count();
        let possible = taken + self.carriers[k..].iter().filter(|c| !c.is_empty()).count();
        let hopeless = self.best.as_ref().is_some_and(|best| possible < best.taken);
        if hopeless || self.steps > MAX_STEPS {
            return;
        }
        if k == self.carriers.len() {
            let choice = self.judge();
            if self.best.as_ref().is_none_or(|best| choice.is_better_than(best)) {
                self.best = Some(choice);
            }
            return;
        }
        for i in 0..self.carriers[k].len() {
            let candidate = self.carriers[k][i];
            if self.keeps_order(candidate.0) {
                self.chosen.push(Some(candidate));
                self.run();
                self.chosen.pop();
            }
        }
        self.chosen.push(None);
        self.run();
        self.chosen.pop();
    }

    /// Whether a vertex at `position` comes after all those chosen, counter-clockwise from the first.
    fn keeps_order(&self, position: usize) -> bool {
        let mut taken = self.chosen.iter().flatten();
        let Some(&(first, _)) = taken.next() else { return true };
        let last = taken.last().map_or(first, |&(p, _)| p);
        let offset = |p: usize| (p + self.length - first) % self.length;
        offset(position) > offset(last)
    }

    fn judge(&self) -> Choice {
        let taken: Vec<(usize, u32)> = self.chosen.iter().flatten().copied().collect();
        let n = taken.len();
        // n² Σ (gap − mean)² = n (n Σ gap² − L²): whole numbers, so that ties are exact.
        let squares: i64 = (0..n)
            .map(|i| {
                let gap = (taken[(i + 1) % n].0 + self.length - taken[i].0) % self.length;
                let gap = if gap == 0 { self.length as i64 } else { gap as i64 };
                gap * gap
            })
            .sum();
        Choice {
            taken: n,
            faces: taken.iter().map(|&(_, v)| self.coarse.vertex_faces[v as usize]).sum(),
            unevenness: n as i64 * squares,
            vertices: self.chosen.iter().map(|c| c.map(|(_, v)| v)).collect(),
        }
    }
}
