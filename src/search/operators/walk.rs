//! Shortest walks of the marker.

use std::collections::VecDeque;

use crate::grammar::Token;
use crate::mesh::{DartId, QuadMesh};

/// Shortest walks from one dart to all others, by turns and pivots.
pub(super) struct Walks {
    /// Tokens needed to reach each dart.
    length: Vec<Option<u32>>,
    /// The last step to each dart, and where it came from.
    step: Vec<Option<(DartId, Token)>>,
    /// All darts that can be reached, nearest first.
    order: Vec<DartId>,
}

impl Walks {
    /// Breadth first; of equally short walks, turns are preferred to pivots.
    pub(super) fn from(mesh: &QuadMesh, start: DartId) -> Self {
        let count = mesh.darts().len();
        let mut walks = Self { length: vec![None; count], step: vec![None; count], order: Vec::new() };
        walks.length[start.index()] = Some(0);
        let mut queue = VecDeque::from([(start, 0)]);
        while let Some((dart, length)) = queue.pop_front() {
            walks.order.push(dart);
            for (to, token) in [(mesh.next(dart), Token::Turn), (mesh.clockwise(dart), Token::Pivot)] {
                if walks.length[to.index()].is_none() {
                    walks.length[to.index()] = Some(length + 1);
                    walks.step[to.index()] = Some((dart, token));
                    queue.push_back((to, length + 1));
                }
            }
        }
        walks
    }

    /// The darts that at most `tokens` tokens lead to, nearest first.
    pub(super) fn within(&self, tokens: usize) -> &[DartId] {
        let near = |d: &DartId| self.length[d.index()].is_some_and(|length| length as usize <= tokens);
        &self.order[..self.order.partition_point(near)]
    }

    /// The tokens that lead to `goal`; empty if nothing does.
    pub(super) fn to(&self, goal: DartId) -> Vec<Token> {
        let mut tokens = Vec::new();
        let mut at = goal;
        while let Some((before, token)) = self.step[at.index()] {
            tokens.push(token);
            at = before;
        }
        tokens.reverse();
        tokens
    }
}
