//! A strip appended along a polyedge drawn from those that are natural or short.

use super::paths::{Polyedge, natural, simple};
use super::walk::Walks;
use crate::grammar::{Token, Tokens, Walker};
use crate::mesh::DartId;
use crate::random::{Rng, below};

/// How many polyedges are looked at before giving up.
const TRIES: usize = 24;

/// Most edges of a short one.
const SHORT: usize = 4;

/// Appends to an expressed string, whose decoding `walker` has followed to the end, a strip along a natural polyedge.
/// `None` if none that is drawn is applicable within `max` tokens.
pub(super) fn append_natural(
    walker: &Walker,
    expressed: &Tokens,
    max: usize,
    rng: &mut Rng,
) -> Option<Tokens> {
    let walks = Walks::from(walker.mesh(), walker.marker());
    let paths = natural(walker.mesh(), &walks);
    draw(walker, &walks, expressed, max, rng, |rng| one_of(&paths, rng).cloned())
}

/// The same along any simple polyedge of at most four edges from boundary to boundary.
pub(super) fn append_short(walker: &Walker, expressed: &Tokens, max: usize, rng: &mut Rng) -> Option<Tokens> {
    let mesh = walker.mesh();
    let walks = Walks::from(mesh, walker.marker());
    let starts: Vec<DartId> =
        walks.within(usize::MAX).iter().copied().filter(|&d| mesh.is_outside(d)).collect();
    draw(walker, &walks, expressed, max, rng, |rng| {
        let start = one_of(&starts, rng)?;
        one_of(&simple(mesh, *start, SHORT, false), rng).cloned()
    })
}

/// The first polyedge drawn that is applicable and leaves the string short enough.
fn draw(
    walker: &Walker,
    walks: &Walks,
    expressed: &Tokens,
    max: usize,
    rng: &mut Rng,
    mut path: impl FnMut(&mut Rng) -> Option<Polyedge>,
) -> Option<Tokens> {
    (0..TRIES).find_map(|_| {
        let mut rules: Vec<Vec<Token>> = path(rng)?.rules(walker, walks, false);
        rules.retain(|rule| expressed.len() + rule.len() <= max);
        Some(expressed.iter().chain(one_of(&rules, rng)?).copied().collect())
    })
}

/// One of them, each as likely as the others; `None` of none.
fn one_of<'a, T>(all: &'a [T], rng: &mut Rng) -> Option<&'a T> {
    (!all.is_empty()).then(|| &all[below(rng, all.len())])
}
