//! The set of all non-dominated points seen so far, unbounded.

use super::domination::{Domination, compare_objectives};

/// A set of mutually non-dominated points, each with the caller's number. Points are compared with six significant digits
/// ([`visible`]), and of those that are equal the first that came stands for all.
#[derive(Clone, Debug, Default)]
pub struct NonDominated {
    members: Vec<Member>,
}

#[derive(Clone, Debug)]
struct Member {
    id: usize,
    objectives: Vec<f64>,
    visible: Vec<f64>,
}

impl NonDominated {
    /// Offers a point; returns whether it was taken. Members it dominates leave. What is not finite is refused.
    pub fn offer(&mut self, id: usize, objectives: &[f64]) -> bool {
        if objectives.iter().any(|f| !f.is_finite()) {
            return false;
        }
        let visible = visible(objectives);
        let stands_back = |m: &Member| {
            m.visible == visible || compare_objectives(&m.visible, &visible) == Domination::First
        };
        if self.members.iter().any(stands_back) {
            return false;
        }
        self.members.retain(|m| compare_objectives(&visible, &m.visible) != Domination::First);
        self.members.push(Member { id, objectives: objectives.to_vec(), visible });
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
        self.members.iter().map(|member| member.id)
    }

    /// The members' objectives, in the order in which they came.
    pub fn points(&self) -> impl Iterator<Item = &[f64]> + '_ {
        self.members.iter().map(|member| member.objectives.as_slice())
    }
}

/// Objectives to six significant digits: where these agree in all of them, nobody would choose between two designs. They
/// are images of each other, or differ by a detour that geometry does not see.
pub fn visible(objectives: &[f64]) -> Vec<f64> {
    // Parsed back from the decimal representation, which is exact and the same everywhere; + 0 for −0.
    objectives.iter().map(|f| format!("{f:.5e}").parse().unwrap_or(*f) + 0.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_equal_points_stands_for_all() {
        let mut front = NonDominated::default();
        assert!(front.offer(0, &[1.000_000_1, -0.0]));
        assert!(!front.offer(1, &[1.0, 0.0]), "better only in the eighth digit");
        assert!(front.offer(2, &[1.000_01, -1.0]), "the sixth digit counts");
        assert!(!front.offer(3, &[1.000_02, -1.0]));
        assert_eq!(front.ids().collect::<Vec<_>>(), [0, 2]);
        assert!(front.offer(4, &[0.999_999, -1.0]), "dominates both, those equal to them too");
        assert_eq!(front.ids().collect::<Vec<_>>(), [4]);
    }
}
