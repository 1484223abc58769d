//! The bounded ε-grid archive (Laumanns et al. 2002, doi:10.1162/106365602760234108).

use super::domination::{Domination, compare_objectives};

/// A bounded, well spread selection of the non-dominated points.
///
/// Normalised objective space is cut into boxes of side ε. A box holds at most one member, and no member's box
/// dominates another's. Within a box the dominating point wins, else the one nearer to the box's lower corner, else
/// the earlier. When there would be more than `max` members, ε is doubled and the members are sorted in anew.
/// The content depends on the order of the offers alone.
#[derive(Clone, Debug)]
pub struct EpsilonArchive {
    epsilon: f64,
    max: usize,
    members: Vec<Member>,
}

#[derive(Clone, Debug)]
struct Member {
    id: usize,
    point: Vec<f64>,
    cell: Vec<f64>,
}

impl EpsilonArchive {
    /// An empty archive with boxes of side `epsilon` and at most `max` members.
    pub fn new(epsilon: f64, max: usize) -> Self {
        Self { epsilon, max: max.max(1), members: Vec::new() }
    }

    /// Offers a point in normalised coordinates; returns whether it is in the archive afterwards.
    pub fn offer(&mut self, id: usize, point: &[f64]) -> bool {
        if point.iter().any(|x| !x.is_finite()) {
            return false;
        }
        let member = Member { id, point: point.to_vec(), cell: self.cell(point) };
        let mut taken = self.insert(member);
        while self.members.len() > self.max {
            self.coarsen();
            taken = self.members.iter().any(|m| m.id == id);
        }
        taken
    }

    /// The numbers of the members, in the order in which they came.
    pub fn ids(&self) -> impl ExactSizeIterator<Item = usize> + '_ {
        self.members.iter().map(|m| m.id)
    }

    /// The side of a box now.
    pub fn epsilon(&self) -> f64 {
        self.epsilon
    }

    fn cell(&self, point: &[f64]) -> Vec<f64> {
        point.iter().map(|x| (x / self.epsilon).floor()).collect()
    }

    fn insert(&mut self, new: Member) -> bool {
        let refused = |old: &Member| {
            compare_objectives(&old.cell, &new.cell) == Domination::First
                || (old.cell == new.cell && !self.replaces(&new, old))
        };
        if self.members.iter().any(refused) {
            return false;
        }
        self.members.retain(|old| {
            old.cell != new.cell && compare_objectives(&new.cell, &old.cell) != Domination::First
        });
        self.members.push(new);
        true
    }

    /// Of two points in one box, whether the new one takes the place.
    fn replaces(&self, new: &Member, old: &Member) -> bool {
        match compare_objectives(&new.point, &old.point) {
            Domination::First => true,
            Domination::Second => false,
            Domination::Neither => self.to_corner(new) < self.to_corner(old),
        }
    }

    /// Squared distance to the lower corner of the member's box, in boxes.
    fn to_corner(&self, member: &Member) -> f64 {
        member.point.iter().zip(&member.cell).map(|(x, c)| (x / self.epsilon - c).powi(2)).sum()
    }

    fn coarsen(&mut self) {
        self.epsilon *= 2.0;
        for mut member in std::mem::take(&mut self.members) {
            member.cell = self.cell(&member.point);
            self.insert(member);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{stream, unit};

    #[test]
    fn one_member_a_box_and_no_dominated_box() {
        let mut archive = EpsilonArchive::new(0.1, 100);
        assert!(archive.offer(0, &[0.55, 0.55]));
        assert!(!archive.offer(1, &[0.59, 0.51]), "same box, farther from its corner");
        assert!(archive.offer(2, &[0.51, 0.52]), "same box, dominates");
        assert!(!archive.offer(3, &[0.75, 0.55]), "dominated box");
        assert!(archive.offer(4, &[0.15, 0.95]));
        assert!(!archive.offer(5, &[f64::NAN, 0.0]));
        assert_eq!(archive.ids().collect::<Vec<_>>(), [2, 4]);
    }

    #[test]
    fn stays_bounded_by_coarser_boxes() {
        let mut archive = EpsilonArchive::new(0.001, 20);
        let mut rng = stream(1, 0, 0);
        for id in 0..2000 {
            let x = unit(&mut rng);
            archive.offer(id, &[x, 1.0 - x]);
            assert!(archive.ids().len() <= 20);
        }
        assert!(archive.ids().len() >= 8 && archive.epsilon() > 0.03, "{}", archive.epsilon());
    }
}
