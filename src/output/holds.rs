//! What a folder holds before a run begins there, and whether the run may.

use super::manifest::{Files, Manifest, ManifestError, Status};
use super::refusal::{FolderError, Opening};
use crate::files::names::{
    CHANGING, CHECKPOINT, CHECKPOINT_PREVIOUS, DESIGN_EXPLORER, DESIGNS, FOLDERS, JOURNAL_BEFORE, MANIFEST,
    TABLES, begins_with, excel_name, is_journal, journal,
};
use std::fs;
use std::path::Path;

/// What a folder is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Holds {
    /// No run.
    Nothing,
    /// A run that can be gone on with.
    Interrupted,
    /// One that ended by its limits.
    Finished,
}

impl Holds {
    /// What a folder holds, by the files that only this program writes: others have their own `manifest.json`.
    fn of(folder: &Path) -> Self {
        match Manifest::read(folder) {
            Some(manifest) if manifest.status == Status::Finished => Self::Finished,
            Some(_) => Self::Interrupted,
            None if has_state(folder) => Self::Interrupted,
            None => Self::Nothing,
        }
    }
}

/// Refuses a folder that `opening` does not allow for.
pub(super) fn check(folder: &Path, opening: Opening, has_lock: bool) -> Result<(), FolderError> {
    refuse_newer(folder)?;
    let holds = Holds::of(folder);
    let path = || folder.to_path_buf();
    match (opening, holds) {
        (Opening::New, Holds::Finished) => return Err(FolderError::Finished(path())),
        (Opening::New, Holds::Interrupted) => return Err(FolderError::Interrupted(path())),
        (Opening::New, Holds::Nothing) => refuse_occupied(folder)?,
        // Killed before it wrote anything, a run has left its lock; to resume it is to start it.
        (Opening::Resume, Holds::Nothing) if !has_lock => return Err(FolderError::NoCheckpoint(path())),
        (Opening::Resume, Holds::Nothing) => refuse_occupied(folder)?,
        (Opening::Resume, Holds::Finished) if !has_state(folder) => {
            return Err(FolderError::NoCheckpoint(path()));
        }
        (Opening::Resume | Opening::Overwrite, _) => {}
    }
    match FOLDERS.iter().map(|name| folder.join(name)).find(|path| path.exists() && !path.is_dir()) {
        Some(path) => Err(FolderError::NoFolder(path)),
        None => Ok(()),
    }
}

/// Refuses a folder with something of others under the names of a run's.
fn refuse_occupied(folder: &Path) -> Result<(), FolderError> {
    let names = CHANGING.into_iter().chain(TABLES).chain([DESIGNS, DESIGN_EXPLORER]).map(str::to_owned);
    let mut names = names.chain(TABLES.map(excel_name));
    match names.find(|name| folder.join(name).exists()) {
        None => Ok(()),
        Some(name) => Err(FolderError::Occupied { path: folder.to_path_buf(), name }),
    }
}

/// The files that runs have written into a folder, by its manifest; of a run that was not listed, those of its names.
pub(super) fn listed(folder: &Path) -> Files {
    let files = Manifest::read(folder).map(|manifest| manifest.files).unwrap_or_default();
    if !files.is_empty() || Holds::of(folder) == Holds::Nothing {
        return files;
    }
    let names = CHANGING.into_iter().chain(TABLES).map(str::to_owned).chain(TABLES.map(excel_name));
    let before = Some(JOURNAL_BEFORE).filter(|name| is_journal(&folder.join(name))).map(str::to_owned);
    names.chain(before).filter(|name| folder.join(name).exists()).map(|name| (name, None)).collect()
}

/// Whether there is a journal or a checkpoint, and of this program's: other programs have files of these names too.
fn has_state(folder: &Path) -> bool {
    let is_checkpoint = |name| begins_with(&folder.join(name), "\"checksum\":");
    is_journal(&journal(folder)) || [CHECKPOINT, CHECKPOINT_PREVIOUS].into_iter().any(is_checkpoint)
}

/// Refuses the folder of a later program, also to be overwritten.
fn refuse_newer(folder: &Path) -> Result<(), FolderError> {
    let path = folder.join(MANIFEST);
    match fs::read(&path).map(|bytes| Manifest::parse(&bytes)) {
        Ok(Err(reason @ ManifestError::Newer { .. })) => Err(FolderError::Newer { path, reason }),
        _ => Ok(()),
    }
}
