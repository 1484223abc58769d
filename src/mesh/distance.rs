//! Topological distance: how many strips apart two meshes are (docs/reference/grammar.md §6.3).

use std::collections::BTreeMap;

use super::canonical::Code;
use super::contract::contract;
use super::isomorphism::{Equivalence, Representative};
use super::quad_mesh::QuadMesh;
use super::strips;

/// How far apart two meshes are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Distance {
    /// The smallest `i + j` such that deleting `i` strips from the one and `j` from the other gives isomorphic meshes.
    Exactly(usize),
    /// More than the bound of the search; there may be no common mesh at all.
    MoreThan(usize),
    /// Other Euler characteristic or another number of loops: at no distance.
    Incomparable,
}

/// The topological distance, exact up to `max` (Oval et al. 2019, *Feature-based topology finding*).
///
/// Breadth-first over canonical codes from both sides. The triangle inequality is not used: deletions can be
/// unavailable, so it need not hold.
pub fn distance(a: &QuadMesh, b: &QuadMesh, equivalence: Equivalence, max: usize) -> Distance {
    if a.euler_characteristic() != b.euler_characteristic() || a.loop_count() != b.loop_count() {
        return Distance::Incomparable;
    }
    let mut a = Descent::new(a, equivalence);
    let mut b = Descent::new(b, equivalence);
    // Every deletion takes a strip away at least, so beyond this nothing is left to delete.
    let most = a.levels[0].strips.1 + b.levels[0].strips.1;
    for total in 0..=max.min(most) {
        for i in balanced_first(total) {
            if Descent::meet(&mut a, i, &mut b, total - i) {
                return Distance::Exactly(total);
            }
        }
    }
    Distance::MoreThan(max)
}

/// `0..=total` from the middle outwards: the deep levels are the costly ones.
fn balanced_first(total: usize) -> impl Iterator<Item = usize> {
    let mut splits: Vec<usize> = (0..=total).collect();
    splits.sort_by_key(|&i| i.abs_diff(total - i));
    splits.into_iter()
}

/// Codes of a mesh and of all that is left of it after deleting up to `depth` strips, each with the fewest
/// deletions that lead there (docs/reference/search.md §4: two designs are at most i + j apart if their sets meet so).
pub fn deletions(mesh: &QuadMesh, depth: usize, equivalence: Equivalence) -> BTreeMap<Code, u32> {
    let mut descent = Descent::new(mesh, equivalence);
    descent.reach(depth);
    descent.depth_of
}

/// The meshes reached from one by deleting strips, level by level.
struct Descent {
    equivalence: Equivalence,
    /// Fewest deletions by code.
    depth_of: BTreeMap<Code, u32>,
    levels: Vec<Level>,
}

/// What a number of deletions leads to, and no fewer.
struct Level {
    codes: Vec<Code>,
    meshes: Vec<QuadMesh>,
    /// Smallest and largest number of strips.
    strips: (usize, usize),
}

impl Descent {
    fn new(mesh: &QuadMesh, equivalence: Equivalence) -> Self {
        let mut descent = Self { equivalence, depth_of: BTreeMap::new(), levels: Vec::new() };
        descent.push_level(vec![equivalence.representative(mesh)]);
        descent
    }

    fn push_level(&mut self, reached: Vec<Representative>) {
        let depth = self.levels.len() as u32;
        let mut level = Level { codes: Vec::new(), meshes: Vec::new(), strips: (usize::MAX, 0) };
        for representative in reached {
            let (code, mesh) = (representative.code(), representative.mesh);
            if let std::collections::btree_map::Entry::Vacant(entry) = self.depth_of.entry(code) {
                entry.insert(depth);
                let count = strips::labels(&mesh).len();
                level.strips = (level.strips.0.min(count), level.strips.1.max(count));
                level.codes.push(code);
                level.meshes.push(mesh);
            }
        }
        self.levels.push(level);
    }

    /// Deletes strips until level `depth` is known.
    fn reach(&mut self, depth: usize) {
        while self.levels.len() <= depth {
            let mut reached = Vec::new();
            if let Some(level) = self.levels.last() {
                for mesh in &level.meshes {
                    let deleted =
                        strips::labels(mesh).into_iter().filter_map(|strip| contract(mesh, strip).ok());
                    reached.extend(deleted.map(|c| self.equivalence.representative(&c.mesh)));
                }
            }
            self.push_level(reached);
        }
    }

    /// Bounds of the number of strips on a level, without computing it: each deletion takes at least one away.
    fn strip_bounds(&self, depth: usize) -> (usize, usize) {
        match self.levels.get(depth) {
            Some(level) => level.strips,
            None => {
                let last = self.levels.len() - 1;
                (0, self.levels[last].strips.1.saturating_sub(depth - last))
            }
        }
    }

    /// Whether level `i` of the one and level `j` of the other have a mesh in common.
    fn meet(a: &mut Self, i: usize, b: &mut Self, j: usize) -> bool {
        let ((least_a, most_a), (least_b, most_b)) = (a.strip_bounds(i), b.strip_bounds(j));
        if most_a < least_b || most_b < least_a {
            return false;
        }
        a.reach(i);
        b.reach(j);
        a.levels[i].codes.iter().any(|code| b.depth_of.get(code) == Some(&(j as u32)))
    }
}
