//! What a run has found so far, read without disturbing it.

use std::path::Path;

use super::super::outcome::{sorted_front, total};
use super::super::record::{Breeding, EvaluatedRow, GenerationRow};
use super::entry::Entry;
use super::{StoreError, checkpoints, journalled};
use crate::evolve::NonDominated;

/// A run as it stood after a finished generation.
#[derive(Clone, PartialEq, Debug)]
pub struct Snapshot {
    /// Every design evaluated up to then, in order of (generation, slot).
    pub evaluated: Vec<EvaluatedRow>,
    /// Every finished generation.
    pub generations: Vec<GenerationRow>,
    /// The non-dominated set of the feasible designs, as in [`Outcome::front`](crate::search::Outcome::front).
    pub front: Vec<usize>,
    /// Breeding, summed over these generations.
    pub breeding: Breeding,
}

impl Snapshot {
    /// The newest finished generation of the run in `folder` of which everything is there; none if there is none yet.
    ///
    /// # Errors
    /// If the journal exists and cannot be read, or a later program wrote the files.
    pub fn read(folder: &Path) -> Result<Option<Self>, StoreError> {
        // The journal last: what a checkpoint counts is in it by then, also when the run goes on meanwhile.
        let checkpoints = checkpoints(folder)?.used;
        let mut entries = journalled(folder)?.1.entries;
        entries.sort_by_key(|e| (e.generation, e.slot));
        entries.dedup_by_key(|e| (e.generation, e.slot));
        let complete = checkpoints.into_iter().find_map(|checkpoint| {
            let finished = entries.partition_point(|e| e.generation < checkpoint.finished());
            (finished as u64 == checkpoint.evaluations && finished > 0).then_some((finished, checkpoint))
        });
        Ok(complete.map(|(finished, checkpoint)| {
            entries.truncate(finished);
            let evaluated: Vec<EvaluatedRow> =
                entries.into_iter().map(Entry::into_indexed).map(|indexed| indexed.row).collect();
            let mut front = NonDominated::default();
            for (place, row) in evaluated.iter().enumerate().filter(|(_, row)| row.is_feasible()) {
                front.offer(place, &row.objectives);
            }
            Self {
                front: sorted_front(&evaluated, &front),
                breeding: total(&checkpoint.generations),
                generations: checkpoint.generations,
                evaluated,
            }
        }))
    }
}
