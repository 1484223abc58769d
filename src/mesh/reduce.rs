//! Merging of topologically parallel strips (docs/reference/grammar.md §6.2, `reduce`): they change only density.

use std::collections::BTreeSet;

use super::contract::contract;
use super::ids::{DartId, StripId};
use super::quad_mesh::QuadMesh;
use super::strips::{self, StripChain};

/// All ways to keep as few parallel strips as validity allows, that is those with the fewest strips in all.
/// Never empty; one mesh unless some merge was refused.
///
/// Strips with a flank in common are exchangeable: without the one or the other, and without the flank, the mesh is
/// the same. So one strip of a class stands for all, and if no merge is ever refused the order does not matter.
/// Only when validity refuses a merge is there a choice to search.
pub fn fewest_parallel(mesh: &QuadMesh, placed: bool) -> Vec<QuadMesh> {
    let Some(class) = parallel_classes(mesh, placed).into_iter().next() else {
        return vec![mesh.clone()];
    };
    let mut reduced = mesh.clone();
    let mut following = Some(class);
    while let Some(class) = following {
        match contract(&reduced, class[0]) {
            Ok(contraction) => reduced = contraction.mesh,
            Err(_) => return search(mesh, placed),
        }
        following = parallel_classes(&reduced, placed).into_iter().next();
    }
    vec![reduced]
}

/// Tries every order of merges. A state is known by the labels of its strips: strips keep them.
fn search(mesh: &QuadMesh, placed: bool) -> Vec<QuadMesh> {
    let mut seen: BTreeSet<Vec<StripId>> = BTreeSet::new();
    let mut pending = vec![mesh.clone()];
    let mut fewest = usize::MAX;
    let mut best = Vec::new();
    while let Some(state) = pending.pop() {
        let labels = strips::labels(&state);
        let count = labels.len();
        if !seen.insert(labels) {
            continue;
        }
        let classes = parallel_classes(&state, placed);
        let merged: Vec<QuadMesh> =
            classes.iter().filter_map(|class| contract(&state, class[0]).ok()).map(|c| c.mesh).collect();
        if merged.is_empty() && count <= fewest {
            if count < fewest {
                best.clear();
                fewest = count;
            }
            best.push(state);
        }
        pending.extend(merged);
    }
    best
}

/// The classes of at least two parallel strips, each ascending by label.
pub fn parallel_classes(mesh: &QuadMesh, placed: bool) -> Vec<Vec<StripId>> {
    let flanks = Flanks::of(mesh, placed);
    let mut order: Vec<usize> = (0..flanks.list.len()).collect();
    order.sort_unstable_by(|&a, &b| flanks.key(a).cmp(&flanks.key(b)));
    let mut classes: Vec<Vec<StripId>> = Vec::new();
    for pair in order.windows(2) {
        let (a, b) = (flanks.list[pair[0]].strip, flanks.list[pair[1]].strip);
        if a != b && flanks.key(pair[0]) == flanks.key(pair[1]) && flanks.may_merge(pair[0], pair[1]) {
            join(&mut classes, a, b);
        }
    }
    classes.iter_mut().for_each(|class| class.sort_unstable());
    classes
}

fn join(classes: &mut Vec<Vec<StripId>>, a: StripId, b: StripId) {
    let with = |classes: &[Vec<StripId>], label| classes.iter().position(|class| class.contains(&label));
    match (with(classes, a), with(classes, b)) {
        (None, None) => classes.push(vec![a, b]),
        (Some(i), None) => classes[i].push(b),
        (None, Some(i)) => classes[i].push(a),
        (Some(i), Some(j)) if i != j => {
            let other = classes.swap_remove(i.max(j));
            classes[i.min(j)].extend(other);
        }
        _ => {}
    }
}

/// One side of a strip, with its end poles, in a form that does not depend on where one starts to read it.
struct Flank {
    strip: StripId,
    closed: bool,
    /// Range in `Flanks::vertices`.
    start: usize,
    end: usize,
    /// The poles the strip ends in.
    poles: [Option<u32>; 2],
}

struct Flanks {
    list: Vec<Flank>,
    vertices: Vec<u32>,
    /// By vertex: a pole, or marked where that counts.
    kept_apart: Vec<bool>,
}

impl Flanks {
    fn of(mesh: &QuadMesh, placed: bool) -> Self {
        let mut kept_apart = mesh.pole_vertices();
        if placed {
            mesh.marks().iter().for_each(|mark| kept_apart[mark.vertex.index()] = true);
        }
        let mut flanks = Self { list: Vec::new(), vertices: Vec::new(), kept_apart };
        for chain in strips::all(mesh) {
            let poles = end_poles(mesh, &chain);
            flanks.push(&chain, poles, |d| mesh.origin(d).0);
            flanks.push(&chain, poles, |d| mesh.origin(mesh.twin(d)).0);
        }
        flanks
    }

    fn push(&mut self, chain: &StripChain, poles: [Option<u32>; 2], vertex: impl Fn(DartId) -> u32) {
        let ends_in = |v: u32| poles.contains(&Some(v));
        if chain.darts.iter().any(|&d| self.kept_apart[vertex(d) as usize] && !ends_in(vertex(d))) {
            return;
        }
        let start = self.vertices.len();
        self.vertices.extend(poles[0]);
        self.vertices.extend(chain.darts.iter().map(|&d| vertex(d)));
        self.vertices.extend(poles[1]);
        let flank = &mut self.vertices[start..];
        if chain.closed {
            normalise_cycle(flank)
        } else {
            normalise_path(flank)
        }
        let end = self.vertices.len();
        self.list.push(Flank { strip: chain.label, closed: chain.closed, start, end, poles });
    }

    fn key(&self, i: usize) -> (bool, &[u32]) {
        let flank = &self.list[i];
        (flank.closed, &self.vertices[flank.start..flank.end])
    }

    /// No vertex of the common flank is a pole or marked, save poles in which both strips end.
    fn may_merge(&self, a: usize, b: usize) -> bool {
        let (a, b) = (&self.list[a], &self.list[b]);
        self.vertices[a.start..a.end]
            .iter()
            .filter(|&&v| self.kept_apart[v as usize])
            .all(|&v| a.poles.contains(&Some(v)) && b.poles.contains(&Some(v)))
    }
}

/// The pole vertices behind the first and beyond the last edge of a strip.
fn end_poles(mesh: &QuadMesh, chain: &StripChain) -> [Option<u32>; 2] {
    let (Some(&first), Some(&last)) = (chain.darts.first(), chain.darts.last()) else {
        return [None; 2];
    };
    let pole = |d: DartId| mesh.origin(mesh.prev(d)).0;
    [chain.poles[0].then(|| pole(mesh.twin(first))), chain.poles[1].then(|| pole(last))]
}

/// The smaller of a path and its reverse.
fn normalise_path(path: &mut [u32]) {
    if path.iter().rev().lt(path.iter()) {
        path.reverse();
    }
}

/// The smallest among all rotations of a cycle and of its reverse.
fn normalise_cycle(cycle: &mut [u32]) {
    let n = cycle.len();
    let read = |start: usize, forward: bool| {
        let cycle = &*cycle;
        (0..n).map(move |k| cycle[if forward { (start + k) % n } else { (start + n - k) % n }])
    };
    let lowest = cycle.iter().min().copied();
    let starts = (0..n).filter(|&start| Some(cycle[start]) == lowest);
    let best = starts
        .flat_map(|start| [(start, true), (start, false)])
        .min_by(|&(a, forward_a), &(b, forward_b)| read(a, forward_a).cmp(read(b, forward_b)));
    if let Some((start, forward)) = best {
        let smallest: Vec<u32> = read(start, forward).collect();
        cycle.copy_from_slice(&smallest);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flanks_read_alike_from_either_end() {
        let mut cycle = [4, 1, 7, 1, 2];
        normalise_cycle(&mut cycle);
        assert_eq!(cycle, [1, 2, 4, 1, 7]);
        let mut path = [9, 3, 5];
        normalise_path(&mut path);
        assert_eq!(path, [5, 3, 9]);
    }
}
