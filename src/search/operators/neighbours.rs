//! Strings that lead one strip further: every deletion, and additions along natural or short simple polyedges.

use super::paths::{Polyedge, natural, simple};
use super::walk::Walks;
use crate::grammar::{Token, Walker};
use crate::mesh::{DartId, StripId, VertexId};
use std::collections::BTreeSet;

/// How many darts of a strip are tried for its deletion: where the marker stands decides whether it survives.
const TRIES: usize = 4;

/// Which additions count as one strip away.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reach {
    /// Most edges of the polyedge.
    pub edges: usize,
    /// Whether strips may end in poles.
    pub poles: bool,
}

/// What is appended to a string, whose decoding `walker` has followed to the end, to delete each strip that can be.
pub(super) fn deletions(walker: &Walker) -> Vec<Vec<Token>> {
    let walks = Walks::from(walker.mesh(), walker.marker());
    let darts = walks.within(usize::MAX);
    let strips: BTreeSet<StripId> = darts.iter().map(|&dart| walker.mesh().strip(dart)).collect();
    let deletion = |strip: StripId| {
        let nearest = darts.iter().filter(|dart| walker.mesh().strip(**dart) == strip).take(TRIES);
        let mut rules = nearest.map(|&dart| [walks.to(dart), vec![Token::Delete]].concat());
        rules.find(|tokens| applies(walker, tokens))
    };
    strips.into_iter().filter_map(deletion).collect()
}

fn applies(walker: &Walker, tokens: &[Token]) -> bool {
    let mut ahead = walker.clone();
    tokens.iter().map(|&token| ahead.apply(token)).last().is_some_and(|effect| effect.is_applied())
}

/// The same to add a strip along each simple polyedge within `reach`.
pub(super) fn additions(walker: &Walker, reach: Reach) -> Vec<Vec<Token>> {
    let (mesh, walks) = (walker.mesh(), Walks::from(walker.mesh(), walker.marker()));
    let mut started: BTreeSet<VertexId> = BTreeSet::new();
    let starts = walks.within(usize::MAX).iter().filter(|&&d| started.insert(mesh.origin(d)));
    let open = |d: &DartId| reach.poles || mesh.gap(*d).is_some();
    let starts: Vec<DartId> = starts.copied().filter(open).collect();
    let paths = starts.into_iter().flat_map(|start| simple(mesh, start, reach.edges, reach.poles));
    paths.flat_map(|path: Polyedge| path.rules(walker, &walks, reach.poles)).collect()
}

/// The same to add a strip along each natural polyedge.
pub(super) fn natural_additions(walker: &Walker) -> Vec<Vec<Token>> {
    let walks = Walks::from(walker.mesh(), walker.marker());
    let paths = natural(walker.mesh(), &walks);
    paths.into_iter().flat_map(|path| path.rules(walker, &walks, false)).collect()
}
