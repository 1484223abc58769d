//! All strings that lead one strip further: every deletion, and every addition along a short simple polyedge.

use super::walk::Walks;
use crate::grammar::{Token, Tokens, Walker};
use crate::mesh::{StripId, VertexId};
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

/// The neighbours of an expressed string, whose decoding `walker` has followed to the end, deletions first. Several
/// may have the same topology.
pub(super) fn neighbours(walker: &Walker, expressed: &Tokens, reach: Reach) -> Vec<Tokens> {
    let walks = Walks::from(walker.mesh(), walker.marker());
    let mut found = deletions(walker, &walks);
    found.extend(additions(walker, &walks, reach));
    found.into_iter().map(|tokens| expressed.iter().chain(&tokens).copied().collect()).collect()
}

fn deletions(walker: &Walker, walks: &Walks) -> Vec<Vec<Token>> {
    let darts = walks.within(usize::MAX);
    let strips: BTreeSet<StripId> = darts.iter().map(|&dart| walker.mesh().strip(dart)).collect();
    let deletion = |strip: StripId| {
        let nearest = darts.iter().filter(|dart| walker.mesh().strip(**dart) == strip).take(TRIES);
        nearest.map(|&dart| followed(walks.to(dart), Token::Delete)).find(|tokens| applies(walker, tokens))
    };
    strips.into_iter().filter_map(deletion).collect()
}

fn applies(walker: &Walker, tokens: &[Token]) -> bool {
    let mut ahead = walker.clone();
    tokens.iter().map(|&token| ahead.apply(token)).last().is_some_and(|effect| effect.is_applied())
}

fn followed(mut tokens: Vec<Token>, token: Token) -> Vec<Token> {
    tokens.push(token);
    tokens
}

fn additions(walker: &Walker, walks: &Walks, reach: Reach) -> Vec<Vec<Token>> {
    let mut found = Vec::new();
    let mut started: BTreeSet<VertexId> = BTreeSet::new();
    for &dart in walks.within(usize::MAX) {
        let mesh = walker.mesh();
        if !started.insert(mesh.origin(dart)) {
            continue;
        }
        let opening = match mesh.gap(dart) {
            Some(_) => Token::Add,
            None if reach.poles => Token::AddPole,
            None => continue,
        };
        let tokens = followed(walks.to(dart), opening);
        let mut at = walker.clone();
        tokens.iter().for_each(|&token| {
            at.apply(token);
        });
        extend(at, tokens, &mut vec![mesh.origin(dart)], reach, &mut found);
    }
    found
}

/// Follows every simple path from where the walker stands, and notes each place where it can be closed.
fn extend(
    walker: Walker,
    tokens: Vec<Token>,
    passed: &mut Vec<VertexId>,
    reach: Reach,
    found: &mut Vec<Vec<Token>>,
) {
    let closings: &[Token] = if reach.poles { &[Token::Add, Token::AddPole] } else { &[Token::Add] };
    for &closing in closings.iter().filter(|_| passed.len() > 1) {
        if matches!(walker.clone().preview_addition(closing), Some(Ok(_))) {
            found.push(followed(tokens.clone(), closing));
        }
    }
    if passed.len() > reach.edges {
        return;
    }
    let (mut here, mut so_far) = (walker, tokens);
    let first = here.marker();
    loop {
        let mut ahead = here.clone();
        ahead.apply(Token::Turn);
        let position = ahead.position();
        if !passed.contains(&position) {
            passed.push(position);
            extend(ahead, followed(so_far.clone(), Token::Turn), passed, reach, found);
            passed.pop();
        }
        here.apply(Token::Pivot);
        so_far.push(Token::Pivot);
        if here.marker() == first {
            return;
        }
    }
}
