//! How a run tells of itself: the library prints nothing and draws no random number for it.

use super::problem::Evaluation;
use super::record::GenerationRow;
use crate::mesh::canonical::Code;

/// Where a run stands, after every evaluation.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Progress {
    /// Generation under way.
    pub generation: u32,
    /// Designs evaluated so far, this generation included.
    pub evaluations: u64,
    /// Of these, those whose structure was analysed.
    pub structural: u64,
    /// Of these, the feasible ones.
    pub feasible: u64,
    /// Designs of this generation still to be evaluated.
    pub pending: u64,
    /// Of the evaluations, those taken from an earlier sitting.
    pub recovered: u64,
}

/// Receives the progress of a run, on the caller's thread. What it does cannot change the result.
pub trait Observer {
    /// What came of a design.
    fn design(&mut self, _code: Code, _evaluation: &Evaluation) {}

    /// A design was evaluated.
    fn evaluated(&mut self, _progress: &Progress) {}

    /// A generation was finished and its checkpoint written.
    fn generation(&mut self, _row: &GenerationRow) {}

    /// Something worth a line: a damaged checkpoint, a string that could not be decoded.
    fn notice(&mut self, _message: &str) {}

    /// Something that costs time or results: no checkpoint of an earlier sitting can be used.
    fn warning(&mut self, _message: &str) {}
}

/// Tells nobody.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Observer for Silent {}
