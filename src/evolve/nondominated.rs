//! The set of all non-dominated points seen so far, unbounded.

use super::domination::{Domination, compare_objectives};

/// A set of mutually non-dominated points, each with the caller's number. Points that are equal are all kept.
#[derive(Clone, Debug, Default)]
pub struct NonDominated {
    members: Vec<(usize, Vec<f64>)>,
}

impl NonDominated {
    /// Offers a point; returns whether it was taken. Members it dominates leave. What is not finite is refused.
    pub fn offer(&mut self, id: usize, objectives: &[f64]) -> bool {
        if objectives.iter().any(|f| !f.is_finite()) {
            return false;
        }
        if self.members.iter().any(|(_, m)| compare_objectives(m, objectives) == Domination::First) {
            return false;
        }
        self.members.retain(|(_, m)| compare_objectives(objectives, m) != Domination::First);
        self.members.push((id, objectives.to_vec()));
        true
    }

    /// Number of members.
    pub fn len(&self) -> usize {
        self.members.len()
    }

    /// True when nothing was taken yet.
    pub fn is_empty(&self) -> bool {
        self.members.is_empty()
    }

    /// The numbers of the members, in the order in which they came.
    pub fn ids(&self) -> impl Iterator<Item = usize> + '_ {
        self.members.iter().map(|(id, _)| *id)
    }

    /// The members' objectives, in the order in which they came.
    pub fn points(&self) -> impl Iterator<Item = &[f64]> + '_ {
        self.members.iter().map(|(_, objectives)| objectives.as_slice())
    }
}
