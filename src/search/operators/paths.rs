//! Polyedges that a strip may be added along: natural ones, and all simple ones that are short.

use std::collections::BTreeSet;

use super::walk::Walks;
use crate::grammar::{Token, Walker};
use crate::mesh::{DartId, QuadMesh};

/// Most edges of a natural polyedge.
const LONGEST: usize = 20;

/// A self-avoiding polyedge, as darts that meet.
#[derive(Clone, Debug)]
pub(super) struct Polyedge {
    darts: Vec<DartId>,
    /// Whether it ends where it begins.
    closed: bool,
}

impl Polyedge {
    /// What is appended to a string whose decoding `walker` has followed to the end, so that a strip is added along this: the
    /// shortest walk to its first edge, and a pair around the way along it. One for each kind of ends that is
    /// applicable here, those in poles only where `poles` says so.
    pub(super) fn rules(&self, walker: &Walker, walks: &Walks, poles: bool) -> Vec<Vec<Token>> {
        let Some(&first) = self.darts.first() else { return Vec::new() };
        let mesh = walker.mesh();
        let mut rules = Vec::new();
        for opening in self.openings(mesh, poles) {
            let mut tokens = walks.to(first);
            tokens.push(opening);
            tokens.extend(self.way(mesh));
            let mut ahead = walker.clone();
            tokens.iter().for_each(|&token| {
                ahead.apply(token);
            });
            for closing in self.closings(mesh, poles) {
                if matches!(ahead.preview_addition(closing), Some(Ok(_))) {
                    rules.push(tokens.iter().copied().chain([closing]).collect());
                }
            }
        }
        rules
    }

    /// Along all its edges: a turn each, and pivots to the next.
    fn way(&self, mesh: &QuadMesh) -> Vec<Token> {
        let mut tokens = vec![Token::Turn];
        for pair in self.darts.windows(2) {
            let pivots = mesh.around(mesh.next(pair[0])).take_while(|&d| d != pair[1]).count();
            tokens.extend(std::iter::repeat_n(Token::Pivot, pivots));
            tokens.push(Token::Turn);
        }
        tokens
    }

    fn openings(&self, mesh: &QuadMesh, poles: bool) -> Vec<Token> {
        match self.darts.first() {
            Some(_) if self.closed => vec![Token::AddClosed],
            Some(&first) => match end(mesh, first).as_slice() {
                [] if poles => vec![Token::AddPole],
                regular => regular.to_vec(),
            },
            None => Vec::new(),
        }
    }

    fn closings(&self, mesh: &QuadMesh, poles: bool) -> Vec<Token> {
        if self.closed {
            return vec![Token::AddClosed];
        }
        let last = self.darts.last().map(|&last| mesh.next(last));
        let mut closings = last.map(|d| end(mesh, d)).unwrap_or_default();
        closings.extend(poles.then_some(Token::AddPole));
        closings
    }
}

/// What a regular end at the origin of `d` is written as: `A` on the boundary, at the end of a seam also `A°`.
fn end(mesh: &QuadMesh, d: DartId) -> Vec<Token> {
    match mesh.gap(d) {
        None => Vec::new(),
        Some(gap) if mesh.is_folded() && mesh.is_seam_end(gap) => vec![Token::Add, Token::AddClosed],
        Some(_) => vec![Token::Add],
    }
}

/// All natural polyedges, in the order in which `walks` meet their first edges: from a boundary vertex inwards, straight on
/// (at odd valence to either side of the middle) to where the boundary is met again; from a mark along the boundary, to every
/// mark on the way; and round a boundary loop that has no marks.
pub(super) fn natural(mesh: &QuadMesh, walks: &Walks) -> Vec<Polyedge> {
    let mut is_marked = vec![false; mesh.vertex_count()];
    mesh.marks().iter().filter(|mark| mark.sharp).for_each(|mark| is_marked[mark.vertex.index()] = true);
    let mut finder = Finder { mesh, on_boundary: mesh.boundary_vertices(), is_marked, found: Vec::new() };
    let mut round = BTreeSet::new();
    for &d in walks.within(usize::MAX) {
        let is_wall = mesh.is_outside(d) || mesh.is_outside(mesh.twin(d));
        if !finder.on_boundary[mesh.origin(d).index()] {
            continue;
        }
        if !is_wall {
            finder.inside(&mut vec![d]);
        } else if finder.is_marked[mesh.origin(d).index()] {
            finder.along(d);
        } else if mesh.is_outside(d) && !round.contains(&d) {
            let whole: Vec<DartId> = mesh.along(d).collect();
            round.extend(whole.iter().copied());
            if whole.len() <= LONGEST && whole.iter().all(|&e| !finder.is_marked[mesh.origin(e).index()]) {
                finder.found.push(Polyedge { darts: whole, closed: true });
            }
        }
    }
    finder.found
}

struct Finder<'a> {
    mesh: &'a QuadMesh,
    on_boundary: Vec<bool>,
    is_marked: Vec<bool>,
    found: Vec<Polyedge>,
}

impl Finder<'_> {
    /// Goes straight on from the last dart of a path that came from inside.
    fn inside(&mut self, path: &mut Vec<DartId>) {
        let mesh = self.mesh;
        let Some(&last) = path.last() else { return };
        let here = mesh.end(last);
        if self.on_boundary[here.index()] {
            let closed = here == mesh.origin(path[0]);
            if closed || path.iter().all(|&d| mesh.origin(d) != here) {
                self.found.push(Polyedge { darts: path.clone(), closed });
            }
            return;
        }
        if path.len() >= LONGEST || path.iter().any(|&d| mesh.origin(d) == here) {
            return;
        }
        let around: Vec<DartId> = mesh.around(mesh.twin(last)).collect();
        let middle = [around.len() / 2, around.len().div_ceil(2)];
        let ways = if middle[0] == middle[1] { &middle[..1] } else { &middle[..] };
        for &k in ways.iter().filter(|&&k| k > 0 && k < around.len()) {
            path.push(around[k]);
            self.inside(path);
            path.pop();
        }
    }

    /// Follows the boundary from a mark.
    fn along(&mut self, start: DartId) {
        let mesh = self.mesh;
        let mut path = vec![start];
        while path.len() <= LONGEST {
            let last = path[path.len() - 1];
            let here = mesh.end(last);
            let closed = here == mesh.origin(start);
            if closed || self.is_marked[here.index()] {
                self.found.push(Polyedge { darts: path.clone(), closed });
            }
            let on = match mesh.is_outside(last) {
                true => mesh.next(last),
                false => mesh.twin(mesh.prev(mesh.twin(last))),
            };
            if closed || path.iter().any(|&d| mesh.origin(d) == mesh.end(on) && d != start) {
                return;
            }
            path.push(on);
        }
    }
}

/// All simple polyedges of at most `edges` edges from the origin of `start`, shorter ones before those that go on from them.
/// Without `poles` those that end on the boundary only.
pub(super) fn simple(mesh: &QuadMesh, start: DartId, edges: usize, poles: bool) -> Vec<Polyedge> {
    let mut found = Vec::new();
    extend(mesh, (start, edges, poles), &mut Vec::new(), &mut found);
    found
}

/// Goes on from the end of `path`, from where the darts around `at` leave.
fn extend(
    mesh: &QuadMesh,
    (at, edges, poles): (DartId, usize, bool),
    path: &mut Vec<DartId>,
    found: &mut Vec<Polyedge>,
) {
    if edges == 0 {
        return;
    }
    for d in mesh.around(at) {
        let to = mesh.end(d);
        if to == mesh.origin(d) || path.iter().any(|&e| mesh.origin(e) == to) {
            continue;
        }
        path.push(d);
        if poles || mesh.gap(mesh.next(d)).is_some() {
            found.push(Polyedge { darts: path.clone(), closed: false });
        }
        extend(mesh, (mesh.next(d), edges - 1, poles), path, found);
        path.pop();
    }
}
