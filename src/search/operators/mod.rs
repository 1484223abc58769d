//! How new strings are made from old ones (RUN "Operators").

use std::fmt;

/// Everything that can have a part in making a string. A string may owe itself to several of them.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Operator {
    /// A new random string.
    Random,
    /// One cut at the same place in both parents.
    OnePoint,
    /// A middle piece exchanged, cut at the same places in both parents.
    TwoPoint,
    /// One cut, at a place of its own in each parent.
    CutAndSplice,
    /// One cut at the end of a rule in each parent.
    RuleEnds,
    /// Tokens inserted.
    Insert,
    /// Tokens removed.
    Remove,
    /// Tokens substituted.
    Substitute,
    /// A strip appended along a valid polyedge.
    AppendStrip,
    /// A deletion appended.
    AppendDeletion,
    /// The last rule dropped.
    DropLast,
    /// `A`, `A*` and `A°` of a pair swapped.
    SwapPair,
}

/// All operators, in the order in which they are counted and listed.
pub const OPERATORS: [Operator; 12] = [
    Operator::Random,
    Operator::OnePoint,
    Operator::TwoPoint,
    Operator::CutAndSplice,
    Operator::RuleEnds,
    Operator::Insert,
    Operator::Remove,
    Operator::Substitute,
    Operator::AppendStrip,
    Operator::AppendDeletion,
    Operator::DropLast,
    Operator::SwapPair,
];

impl Operator {
    /// The name in files, in the words of the config.
    pub fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::OnePoint => "one_point",
            Self::TwoPoint => "two_point",
            Self::CutAndSplice => "cut_and_splice",
            Self::RuleEnds => "rule_ends",
            Self::Insert => "insert",
            Self::Remove => "remove",
            Self::Substitute => "substitute",
            Self::AppendStrip => "append_strip",
            Self::AppendDeletion => "append_deletion",
            Self::DropLast => "drop_last",
            Self::SwapPair => "swap_pair",
        }
    }
}

impl fmt::Display for Operator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
