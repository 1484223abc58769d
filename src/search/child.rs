//! A string that breeding accepted, before it is a row.

use super::problem::Identity;
use crate::grammar::Tokens;

/// A string accepted for the generation under way.
#[derive(Clone, Debug)]
pub(crate) struct Child {
    pub(crate) tokens: Tokens,
    pub(crate) identity: Identity,
    /// Bit k: operator k of [`OPERATORS`](super::operators::OPERATORS) had a part in it.
    pub(crate) operators: u16,
    /// The population it belongs to.
    pub(crate) island: usize,
    /// The row that holds its values already, if one does; it may belong to a child before this one.
    pub(crate) cached: Option<u32>,
}
