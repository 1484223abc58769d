//! What a run writes down while it runs, so that a kill at any moment loses at most the evaluations in flight.
//!
//! Three files in the results folder, which the caller has locked:
//!
//! * `checkpoint.json`: the state after the last finished generation: population, rows of `generations.csv`, the
//!   number of evaluated designs, and the resolved config. Versioned, with a checksum, replaced atomically.
//! * `checkpoint.previous.json`: the one before, in case the newest is damaged.
//! * `evaluations.journal`: a journal of every evaluation, appended to as each is finished. It holds the evaluations
//!   since the checkpoint, and also all those before: to write these into every checkpoint anew would cost O(n²) over
//!   a run. One line is a checksum and a JSON object, so a torn or damaged line is noticed and left out.
//!
//! Evaluations are pure, so anything missing in the journal can be had again: a run resumes from the newest
//! checkpoint whose evaluations are all there, else from the one before, else from the beginning, and takes from
//! the journal whatever it holds, by code. Only time is lost, never a byte of the result.
//!
//! A line is handed to the operating system at once, which survives a killed process; it is forced to the disk at
//! least four times a second and at the end of a generation, so a power failure may cost a quarter of a second.

mod checkpoint;
mod compare;
mod entry;
mod error;
mod journal;
mod snapshot;

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use self::checkpoint::{Checkpoint, Unusable};
use self::entry::Entry;
use self::journal::Journal;
use super::child::Child;
use super::observer::Observer;
use super::problem::Evaluation;
use super::state::{Indexed, Settings, State};
use crate::files::atomic;
use crate::files::names::{self, CHECKPOINT, CHECKPOINT_PREVIOUS, JOURNAL};
use crate::mesh::canonical::Code;

pub use compare::differing_keys;
pub use error::StoreError;
pub use snapshot::Snapshot;

/// The files of one run.
#[derive(Debug)]
pub struct Store {
    folder: PathBuf,
    config: Value,
    journal: Journal,
    found: Found,
    worked: bool,
}

/// What an earlier sitting left.
#[derive(Debug, Default)]
struct Found {
    checkpoints: Vec<Checkpoint>,
    entries: Vec<Entry>,
    /// Evaluations that no row holds yet. Only looked up.
    spare: HashMap<Code, Evaluation>,
    notices: Vec<String>,
    /// Checkpoints that are there, the damaged ones included.
    checkpoint_files: usize,
}

impl Store {
    /// Starts anew in `folder`: what an earlier run left of these files is removed.
    ///
    /// `config` is the config as resolved, seed included.
    ///
    /// # Errors
    /// If files cannot be written.
    pub fn create(folder: &Path, config: Value) -> Result<Self, StoreError> {
        for name in [CHECKPOINT, CHECKPOINT_PREVIOUS] {
            let path = folder.join(name);
            match fs::remove_file(&path) {
                Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                    return Err(StoreError::io(&path, error));
                }
                _ => {}
            }
        }
        let journal = Journal::create(&folder.join(JOURNAL), &config)?;
        Ok(Self { folder: folder.to_path_buf(), config, journal, found: Found::default(), worked: false })
    }

    /// Goes on in `folder`; starts anew where there is nothing to go on from.
    ///
    /// # Errors
    /// If files cannot be read or written, a later program wrote them, or `config` differs from the recorded one in
    /// anything but threads and the stopping limits.
    pub fn resume(folder: &Path, config: Value) -> Result<Self, StoreError> {
        let Checkpoints { used, files, notices } = checkpoints(folder)?;
        let mut found = Found { checkpoints: used, notices, checkpoint_files: files, ..Found::default() };
        let recorded = found.checkpoints.first().map(|checkpoint| checkpoint.config.clone());
        // Compared before the journal is opened for writing: a refused resume leaves everything as it was.
        let (path, left) = journalled(folder)?;
        refuse_other(folder, recorded.as_ref().or(left.config.as_ref()), &config)?;
        let journal = Journal::resume(&path, &config, &left)?;
        if left.damaged > 0 {
            found.notices.push(format!("{JOURNAL}: damaged lines left out: {}", left.damaged));
        }
        found.entries = left.entries;
        Ok(Self { folder: folder.to_path_buf(), config, journal, found, worked: false })
    }

    /// Whether a run in `folder` can be gone on with; nothing is opened for writing.
    ///
    /// # Errors
    /// As [`Store::resume`].
    pub fn check(folder: &Path, config: &Value) -> Result<(), StoreError> {
        refuse_other(folder, Self::recorded_config(folder)?.as_ref(), config)
    }

    /// The config recorded in `folder`, if a run was begun there: the seed that was drawn is in it.
    ///
    /// # Errors
    /// If a file exists and cannot be read, or a later program wrote it.
    pub fn recorded_config(folder: &Path) -> Result<Option<Value>, StoreError> {
        if let Some(checkpoint) = checkpoints(folder)?.used.into_iter().next() {
            return Ok(Some(checkpoint.config));
        }
        Ok(journalled(folder)?.1.config)
    }

    /// Whether anything was evaluated, or a generation finished, since the files were opened.
    pub fn worked(&self) -> bool {
        self.worked
    }

    /// The state to go on from.
    pub(crate) fn recover(&mut self, settings: &Settings, observer: &mut dyn Observer) -> State {
        let mut found = std::mem::take(&mut self.found);
        found.notices.iter().for_each(|notice| observer.notice(notice));
        // A line may be there twice if it was written again after damage before it; both say the same.
        found.entries.sort_by_key(|e| (e.generation, e.slot));
        found.entries.dedup_by_key(|e| (e.generation, e.slot));
        for checkpoint in found.checkpoints {
            let finished = found.entries.partition_point(|e| e.generation < checkpoint.finished());
            if finished as u64 == checkpoint.evaluations {
                let spare = found.entries.split_off(finished);
                self.found.spare = spare.into_iter().map(Entry::into_evaluation).collect();
                let rows: Vec<Indexed> = found.entries.into_iter().map(Entry::into_indexed).collect();
                return State::restore(settings, rows, checkpoint.islands, checkpoint.generations);
            }
            observer.notice(&format!(
                "the checkpoint after generation {} is not used: {finished} of its {} evaluations are there",
                checkpoint.finished().saturating_sub(1),
                checkpoint.evaluations
            ));
        }
        // Nothing is lost where no generation was finished.
        if found.checkpoint_files > 0 || found.entries.iter().any(|entry| entry.generation > 0) {
            observer.warning(&anew(found.checkpoint_files, found.entries.len()));
        }
        self.found.spare = found.entries.into_iter().map(Entry::into_evaluation).collect();
        State::new(&settings.search)
    }

    /// An evaluation from an earlier sitting, handed out once.
    pub(crate) fn recovered(&mut self, code: Code) -> Option<Evaluation> {
        self.found.spare.remove(&code)
    }

    /// Writes one evaluation down.
    pub(crate) fn append(
        &mut self,
        generation: u32,
        slot: u32,
        child: &Child,
        evaluation: &Evaluation,
    ) -> Result<(), StoreError> {
        self.worked = true;
        self.journal.append(&Entry::of(generation, slot, child, evaluation))
    }

    /// Writes the state after a finished generation; the checkpoint before becomes the previous one.
    pub(crate) fn checkpoint(&mut self, state: &State) -> Result<(), StoreError> {
        self.worked = true;
        self.journal.sync()?;
        let (newest, previous) = (self.folder.join(CHECKPOINT), self.folder.join(CHECKPOINT_PREVIOUS));
        let bytes = Checkpoint::of(state, &self.config).to_bytes();
        let bytes = bytes.map_err(|error| StoreError::io(&newest, error.into()))?;
        if newest.exists() {
            fs::rename(&newest, &previous).map_err(|error| StoreError::io(&previous, error))?;
        }
        atomic::write(&newest, &bytes).map_err(|error| StoreError::io(&newest, error))
    }
}

/// Refuses a config that differs from the recorded one in what may not differ.
fn refuse_other(folder: &Path, recorded: Option<&Value>, config: &Value) -> Result<(), StoreError> {
    let keys = recorded.map(|recorded| differing_keys(recorded, config)).unwrap_or_default();
    match keys.is_empty() {
        true => Ok(()),
        false => Err(StoreError::OtherConfig { folder: folder.to_path_buf(), keys }),
    }
}

/// The checkpoints of a folder, the newest first.
struct Checkpoints {
    used: Vec<Checkpoint>,
    /// How many are there, the damaged ones included.
    files: usize,
    notices: Vec<String>,
}

fn checkpoints(folder: &Path) -> Result<Checkpoints, StoreError> {
    let mut found = Checkpoints { used: Vec::new(), files: 0, notices: Vec::new() };
    for name in [CHECKPOINT, CHECKPOINT_PREVIOUS] {
        let path = folder.join(name);
        found.files += usize::from(path.exists());
        match checkpoint::read(&path) {
            Ok(Some(checkpoint)) => found.used.push(checkpoint),
            Ok(None) => {}
            Err(Unusable::Damaged(how)) => found.notices.push(format!("{name} is not used: {how}")),
            Err(Unusable::Newer(found)) => return Err(StoreError::Newer { path, found }),
        }
    }
    Ok(found)
}

/// The journal of a folder, and what is in it.
fn journalled(folder: &Path) -> Result<(PathBuf, journal::Left), StoreError> {
    let path = names::journal(folder);
    let left = journal::read(&path)?;
    match left.newer {
        Some(found) => Err(StoreError::Newer { path, found }),
        None => Ok((path, left)),
    }
}

/// What a run without a checkpoint to go on from does.
fn anew(checkpoints: usize, evaluations: usize) -> String {
    let found = match checkpoints {
        0 => "there is no checkpoint",
        1 => "the checkpoint cannot be used",
        _ => "neither checkpoint can be used",
    };
    format!(
        "{found}: the run begins again from generation 0; the {evaluations} evaluations in {JOURNAL} are used again"
    )
}
