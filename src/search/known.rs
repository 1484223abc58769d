//! Which designs are known, and how near a new one is to them (docs/reference/search.md §4).

use std::collections::HashMap;

use super::problem::Identity;
use crate::mesh::canonical::Code;

/// What is known of a newly bred design.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Verdict {
    /// To be evaluated.
    New,
    /// Has the placed + reduced code of this row, and the rule is off: it shares its values.
    Cached(u32),
    /// Refused: an equal design is known.
    Duplicate,
    /// Refused: a design nearer than `min_distance` is known.
    Neighbour,
}

/// An index of all evaluated designs. The maps are only looked up, never walked through.
#[derive(Clone, Debug, Default)]
pub(crate) struct Known {
    min_distance: u32,
    /// Row of each placed + reduced code.
    rows: HashMap<Code, u32>,
    /// Equivalence codes of designs and of their deletions, each with the fewest strips deleted to get there.
    nearby: HashMap<Code, u8>,
}

impl Known {
    pub(crate) fn new(min_distance: u32) -> Self {
        Self { min_distance, ..Self::default() }
    }

    /// Two designs are less than `min_distance` apart exactly when a common code is reached with i + j deletions
    /// below it; each list holds all codes with up to `min_distance` − 1 deletions, so none is missed.
    pub(crate) fn judge(&self, identity: &Identity) -> Verdict {
        match self.rows.get(&identity.code) {
            Some(&row) if self.min_distance == 0 => return Verdict::Cached(row),
            Some(_) => return Verdict::Duplicate,
            None if self.min_distance == 0 => return Verdict::New,
            None => {}
        }
        let sums = identity.neighbourhood.iter().filter_map(|(code, i)| self.nearby.get(code).map(|j| i + j));
        match sums.min() {
            Some(0) => Verdict::Duplicate,
            Some(distance) if u32::from(distance) < self.min_distance => Verdict::Neighbour,
            _ => Verdict::New,
        }
    }

    /// Registers a design under its row.
    pub(crate) fn insert(&mut self, code: Code, neighbourhood: &[(Code, u8)], row: u32) {
        self.rows.insert(code, row);
        // At distance 1 and with the same code for both uses, `rows` says it all.
        if self.min_distance == 0 || (self.min_distance == 1 && neighbourhood == [(code, 0)]) {
            return;
        }
        for &(code, deleted) in neighbourhood {
            let nearest = self.nearby.entry(code).or_insert(deleted);
            *nearest = deleted.min(*nearest);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grammar::Tokens;

    fn design(codes: &[(u128, u8)]) -> Identity {
        Identity {
            code: Code(codes[0].0),
            neighbourhood: codes.iter().map(|&(code, i)| (Code(code), i)).collect(),
            expressed: Tokens::default(),
            symmetries: crate::mesh::Symmetries::default(),
            rejected: None,
        }
    }

    fn known(min_distance: u32, designs: &[Identity]) -> Known {
        let mut known = Known::new(min_distance);
        for (row, d) in designs.iter().enumerate() {
            known.insert(d.code, &d.neighbourhood, row as u32);
        }
        known
    }

    #[test]
    fn the_rule_compares_sums_of_deletions() {
        // 10 and 20 have the common deletion 5: they are two strips apart.
        let (a, b) = (design(&[(10, 0), (5, 1), (6, 1)]), design(&[(20, 0), (5, 1)]));
        let base = design(&[(5, 0), (1, 1)]);
        assert_eq!(known(1, std::slice::from_ref(&a)).judge(&b), Verdict::New);
        assert_eq!(known(2, std::slice::from_ref(&a)).judge(&b), Verdict::New);
        assert_eq!(known(3, std::slice::from_ref(&a)).judge(&b), Verdict::Neighbour);
        assert_eq!(known(2, std::slice::from_ref(&a)).judge(&base), Verdict::Neighbour, "one strip apart");
        assert_eq!(known(2, std::slice::from_ref(&base)).judge(&a), Verdict::Neighbour, "and the other way");
        assert_eq!(known(1, std::slice::from_ref(&a)).judge(&a), Verdict::Duplicate);
    }

    #[test]
    fn without_the_rule_equal_codes_share_their_values() {
        let a = design(&[(10, 0)]);
        let known = known(0, &[design(&[(7, 0)]), a.clone()]);
        assert_eq!(known.judge(&a), Verdict::Cached(1));
        assert_eq!(known.judge(&design(&[(8, 0)])), Verdict::New);
    }
}
