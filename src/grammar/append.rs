//! Rules appended to a string: a strip along a polyedge, or a deletion, each reached by the shortest walk.
//!
//! A token changed early makes all that follows mean something else; a rule appended to an *expressed* string changes
//! only its strip (RUN "Operators").

use std::collections::VecDeque;

use crate::mesh::{DartId, InitialMesh, QuadMesh, StripId};
use crate::random::{Rng, below, chance};

use super::rules::Rules;
use super::tokens::{Token, Tokens};
use super::walker::{Effect, Walker};

/// How often another place is tried before giving up.
const TRIES: usize = 8;

/// Chance that a polyedge leaves the straight line at a vertex.
const BEND: f64 = 0.2;

/// Chance that a strip begins with a pole, and that it ends with one where it could also go on.
const POLE: f64 = 0.08;

/// Appends the deletion of a random strip, at the dart of it that the marker reaches first.
///
/// `None` if nothing that fits into `room` tokens and applies was found in a few tries.
pub fn append_deletion(
    initial: &InitialMesh,
    rules: Rules,
    expressed: &Tokens,
    room: usize,
    rng: &mut Rng,
) -> Option<Tokens> {
    let walker = walked(initial, rules, expressed);
    let walks = Walks::from(walker.mesh(), walker.marker());
    let mut strips: Vec<StripId> = walker.mesh().darts().map(|d| walker.mesh().strip(d)).collect();
    strips.sort_unstable();
    strips.dedup();
    (0..TRIES).find_map(|_| {
        let strip = strips[below(rng, strips.len())];
        let nearest = walks.order.iter().copied().find(|&d| walker.mesh().strip(d) == strip)?;
        let mut tokens = walks.to(nearest);
        tokens.push(Token::Delete);
        let applies = tokens.len() <= room && {
            let mut ahead = walker.clone();
            tokens.iter().map(|&token| ahead.apply(token)).last().is_some_and(|effect| effect.is_applied())
        };
        applies.then(|| joined(expressed, tokens))
    })
}

/// Appends a strip along a polyedge that starts at a random vertex and mostly runs straight.
///
/// `None` if nothing that fits into `room` tokens and applies was found in a few tries.
pub fn append_strip(
    initial: &InitialMesh,
    rules: Rules,
    expressed: &Tokens,
    room: usize,
    rng: &mut Rng,
) -> Option<Tokens> {
    let walker = walked(initial, rules, expressed);
    let mesh = walker.mesh();
    let walks = Walks::from(mesh, walker.marker());
    let on_boundary: Vec<DartId> = mesh.darts().filter(|&d| mesh.gap(d).is_some()).collect();
    let inside: Vec<DartId> = mesh.darts().filter(|&d| mesh.gap(d).is_none()).collect();
    (0..TRIES).find_map(|_| {
        // Inside, a strip can only begin with a pole or be closed.
        let from_inside = on_boundary.is_empty() || (!inside.is_empty() && chance(rng, 0.2));
        let starts = if from_inside { &inside } else { &on_boundary };
        let start = starts[below(rng, starts.len())];
        let opening = match from_inside {
            true if chance(rng, 0.5) => Token::AddClosed,
            true => Token::AddPole,
            false if chance(rng, POLE) => Token::AddPole,
            false => Token::Add,
        };
        // The position is what counts: any dart of the vertex will do.
        let nearest = walks.order.iter().copied().find(|&d| mesh.origin(d) == mesh.origin(start))?;
        let mut tokens = walks.to(nearest);
        let mut ahead = walker.clone();
        tokens.push(opening);
        tokens.iter().for_each(|&token| {
            ahead.apply(token);
        });
        let path = polyedge(ahead, opening, room.checked_sub(tokens.len())?, rng)?;
        tokens.extend(path);
        Some(joined(expressed, tokens))
    })
}

/// The tokens of a polyedge from the marker on, closed by an `A…` that applies.
fn polyedge(mut walker: Walker, opening: Token, room: usize, rng: &mut Rng) -> Option<Vec<Token>> {
    let mut tokens = Vec::new();
    pivot(&mut walker, &mut tokens, rng);
    while tokens.len() + 2 <= room {
        walker.apply(Token::Turn);
        tokens.push(Token::Turn);
        let closing = if opening == Token::AddClosed {
            Token::AddClosed
        } else if chance(rng, POLE) {
            Token::AddPole
        } else {
            Token::Add
        };
        if matches!(walker.preview_addition(closing), Some(Ok(_))) {
            tokens.push(closing);
            return Some(tokens);
        }
        if valence(&walker) == 4 && !chance(rng, BEND) {
            // After a turn the marker points left; one pivot points it straight on.
            walker.apply(Token::Pivot);
            tokens.push(Token::Pivot);
        } else {
            pivot(&mut walker, &mut tokens, rng);
        }
    }
    None
}

fn valence(walker: &Walker) -> usize {
    walker.mesh().around(walker.marker()).count()
}

/// Pivots to a random edge of the position.
fn pivot(walker: &mut Walker, tokens: &mut Vec<Token>, rng: &mut Rng) {
    for _ in 0..below(rng, valence(walker)) {
        walker.apply(Token::Pivot);
        tokens.push(Token::Pivot);
    }
}

fn walked(initial: &InitialMesh, rules: Rules, tokens: &Tokens) -> Walker {
    let mut walker = Walker::new(initial, rules);
    tokens.iter().for_each(|&token| {
        let _: Effect = walker.apply(token);
    });
    walker
}

fn joined(head: &Tokens, tail: Vec<Token>) -> Tokens {
    head.iter().copied().chain(tail).collect()
}

/// The shortest walks (T and P) from the marker to every dart.
struct Walks {
    /// Darts in the order of their distance.
    order: Vec<DartId>,
    came: Vec<Option<(DartId, Token)>>,
}

impl Walks {
    fn from(mesh: &QuadMesh, marker: DartId) -> Self {
        let mut came = vec![None; mesh.darts().len()];
        let mut seen = vec![false; came.len()];
        let mut order = Vec::with_capacity(came.len());
        let mut queue = VecDeque::from([marker]);
        seen[marker.index()] = true;
        while let Some(d) = queue.pop_front() {
            order.push(d);
            for (to, token) in [(mesh.next(d), Token::Turn), (mesh.clockwise(d), Token::Pivot)] {
                if !std::mem::replace(&mut seen[to.index()], true) {
                    came[to.index()] = Some((d, token));
                    queue.push_back(to);
                }
            }
        }
        Self { order, came }
    }

    fn to(&self, dart: DartId) -> Vec<Token> {
        let mut tokens = Vec::new();
        let mut at = dart;
        while let Some((before, token)) = self.came[at.index()] {
            tokens.push(token);
            at = before;
        }
        tokens.reverse();
        tokens
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grammar::decode;
    use crate::mesh::BaseMesh;
    use crate::random::stream;

    fn grid(n: u32) -> InitialMesh {
        let at = |i: u32, j: u32| j * (n + 1) + i;
        let base = BaseMesh {
            vertices: (0..(n + 1) * (n + 1)).map(|k| [f64::from(k % (n + 1)), f64::from(k / (n + 1)), 0.0]).collect(),
            faces: (0..n * n)
                .map(|k| (k % n, k / n))
                .map(|(i, j)| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
                .collect(),
            corners: vec![vec![at(0, 0)], vec![at(n, 0)], vec![at(n, n)], vec![at(0, n)]],
            ..BaseMesh::default()
        };
        InitialMesh::from_base(&base).unwrap()
    }

    #[test]
    fn what_is_appended_applies_and_nothing_before_it_changes() {
        let initial = grid(3);
        let (mut strips, mut deletions) = (0, 0);
        for k in 0..400 {
            let mut rng = stream(k, 0, 0);
            let mut tokens = Tokens::default();
            for _ in 0..3 {
                let room = 40 - tokens.len();
                let longer = if chance(&mut rng, 0.7) {
                    append_strip(&initial, Rules::Domain, &tokens, room, &mut rng)
                } else {
                    append_deletion(&initial, Rules::Domain, &tokens, room, &mut rng)
                };
                let Some(longer) = longer else { continue };
                assert!(longer.len() <= 40 && longer.starts_with(&tokens), "{longer}");
                let decoded = decode(&initial, &longer, Rules::Domain);
                assert_eq!(decoded.expressed, longer, "something was skipped");
                match decoded.trace.last() {
                    Some(Effect::Added(_)) => strips += 1,
                    Some(Effect::Deleted(_)) => deletions += 1,
                    other => panic!("{other:?}"),
                }
                tokens = longer;
            }
        }
        assert!(strips > 300 && deletions > 100, "{strips} strips, {deletions} deletions");
    }
}
