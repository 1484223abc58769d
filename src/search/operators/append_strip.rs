//! A strip appended along a valid polyedge reached by the shortest walk.

use super::walk::Walks;
use crate::grammar::{Token, Tokens, Walker};
use crate::mesh::{DartId, QuadMesh};
use crate::random::{Rng, below};

/// How many polyedges are looked at before giving up.
const TRIES: usize = 24;

/// Fewest turns along the polyedge, as for random strings.
const FEWEST_TURNS: usize = 2;

/// Appends to an expressed string, whose decoding `walker` has followed to the end: a walk to a random dart, an
/// opening, the shortest walk to another random dart (for a closed strip: on and back to where it began), and a
/// closing that is applicable there. `None` if no such polyedge is found within `max` tokens.
pub(super) fn append_strip(walker: Walker, expressed: &Tokens, max: usize, rng: &mut Rng) -> Option<Tokens> {
    // An opening, a closing and the turns between.
    let room = max.checked_sub(expressed.len() + 2 + FEWEST_TURNS)?;
    let walks = Walks::from(walker.mesh(), walker.marker());
    let starts = walks.within(room);
    (0..TRIES).find_map(|_| {
        let start = starts[below(rng, starts.len())];
        let mut tokens = walks.to(start);
        let room = room + FEWEST_TURNS - tokens.len();
        let opening = opening(walker.mesh(), start, rng);
        tokens.push(opening);
        let along = if opening == Token::AddClosed {
            around(walker.mesh(), start, room, rng)?
        } else {
            across(walker.mesh(), start, room, rng)
        };
        if along.iter().filter(|t| **t == Token::Turn).count() < FEWEST_TURNS || along.len() > room {
            return None;
        }
        tokens.extend(along);
        tokens.push(closing(&walker, &tokens, opening, rng)?);
        Some(expressed.iter().chain(&tokens).copied().collect())
    })
}

/// `A` on the boundary, else a pole; sometimes closed.
fn opening(mesh: &QuadMesh, start: DartId, rng: &mut Rng) -> Token {
    match below(rng, 5) {
        0 => Token::AddClosed,
        1 => Token::AddPole,
        _ if mesh.gap(start).is_some() => Token::Add,
        _ => Token::AddPole,
    }
}

/// The shortest walk to a random dart within reach.
fn across(mesh: &QuadMesh, start: DartId, room: usize, rng: &mut Rng) -> Vec<Token> {
    let walks = Walks::from(mesh, start);
    let goals = walks.within(room);
    walks.to(goals[below(rng, goals.len())])
}

/// The shortest walk to a random dart about halfway within reach, and from there back to the first vertex.
fn around(mesh: &QuadMesh, start: DartId, room: usize, rng: &mut Rng) -> Option<Vec<Token>> {
    let out = Walks::from(mesh, start);
    let halfway = out.within(room / 2 + 1);
    let turning = halfway[below(rng, halfway.len())];
    let back = Walks::from(mesh, turning);
    let home = *back.within(room).iter().find(|d| mesh.origin(**d) == mesh.origin(start))?;
    let mut tokens = out.to(turning);
    tokens.extend(back.to(home));
    Some(tokens)
}

/// A closing that can be applied after `tokens`, drawn at random.
fn closing(walker: &Walker, tokens: &[Token], opening: Token, rng: &mut Rng) -> Option<Token> {
    let mut walker = walker.clone();
    tokens.iter().for_each(|&token| {
        walker.apply(token);
    });
    let mut closings = match opening {
        Token::AddClosed => vec![Token::AddClosed],
        // A regular end is the commoner; a pole where that is not possible, and sometimes anyway.
        _ if below(rng, 4) > 0 => vec![Token::Add, Token::AddPole],
        _ => vec![Token::AddPole, Token::Add],
    };
    closings.retain(|&closing| matches!(walker.preview_addition(closing), Some(Ok(_))));
    closings.first().copied()
}
