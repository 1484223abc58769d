//! The results folder: where each file is, who may write, and whether a run is finished.

use super::atomic;
use super::manifest::{Manifest, ManifestError, Status};
use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Files of the front as a table.
pub const PARETO: &str = "pareto.csv";
/// Every evaluated design.
pub const HISTORY: &str = "history.csv";
/// One row per generation.
pub const GENERATIONS: &str = "generations.csv";
/// One row per generation and operator.
pub const OPERATORS: &str = "operators.csv";
/// What was run, with what, where and when.
pub const MANIFEST: &str = "manifest.json";
/// The designs that `evaluate` compares.
pub const EVALUATION: &str = "evaluation.csv";
/// State of an unfinished run.
pub const CHECKPOINT: &str = "checkpoint.json";
/// The one before.
pub const CHECKPOINT_PREVIOUS: &str = "checkpoint.previous.json";
/// The page to look at.
pub const REPORT: &str = "report.html";
/// Folder of the front's designs.
pub const DESIGNS: &str = "designs";
/// Folder for Design Explorer.
pub const DESIGN_EXPLORER: &str = "design_explorer";
/// Folder of the pictures that `explain` draws.
pub const EXPLAINED: &str = "explained";
/// Every evaluation of a run, as they come.
pub const JOURNAL: &str = "evaluations.journal";
/// Its name in runs of quadrille 0.1, which go on with it.
pub const JOURNAL_BEFORE: &str = "evaluations.jsonl";
const LOCK: &str = ".lock";

/// Why a results folder cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// Another run writes into it.
    #[error("{} is in use by another run", .0.display())]
    InUse(PathBuf),
    /// It holds a finished run.
    #[error("{} holds a finished run; give another --out, or --force to overwrite it", .0.display())]
    Finished(PathBuf),
    /// It holds an interrupted run.
    #[error("{} holds an interrupted run; --resume goes on with it, --force starts anew", .0.display())]
    Interrupted(PathBuf),
    /// It holds something else that a run would replace.
    #[error("{} holds {name}, which no run there wrote and this one would replace; give another --out, or --force to overwrite it", path.display())]
    Occupied {
        /// The folder.
        path: PathBuf,
        /// The file or folder in it.
        name: &'static str,
    },
    /// A later program wrote it: what is whose cannot be told.
    #[error("{}: {reason}; or give another --out", path.display())]
    Newer {
        /// The manifest.
        path: PathBuf,
        /// Whose it is.
        reason: ManifestError,
    },
    /// There is nothing to go on with.
    #[error("{} holds no checkpoint to resume", .0.display())]
    NoCheckpoint(PathBuf),
    /// The system refuses.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

/// What a run does with what is there.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Opening {
    /// Only a folder in which nothing would be replaced.
    New,
    /// Whatever is there is removed.
    Overwrite,
    /// Go on with an interrupted run.
    Resume,
}

/// A results folder that this process alone may write to, as long as the value lives.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    _lock: File,
}

impl Folder {
    /// Makes the folder if need be and locks it.
    ///
    /// # Errors
    /// [`FolderError`]: in use, holding a run that `opening` does not allow for, or not writable.
    pub fn open(path: &Path, opening: Opening) -> Result<Self, FolderError> {
        let io = |path: &Path| {
            let path = path.to_path_buf();
            |source| FolderError::Io { path, source }
        };
        let lock_path = path.join(LOCK);
        // A run killed before it wrote anything has left its lock file; resuming it is starting it again.
        if opening == Opening::Resume && !lock_path.exists() && !has_checkpoint(path) {
            return Err(FolderError::NoCheckpoint(path.to_path_buf()));
        }
        refuse_newer(path)?;
        fs::create_dir_all(path).map_err(io(path))?;
        let lock = File::create(&lock_path).map_err(io(&lock_path))?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(FolderError::InUse(path.to_path_buf())),
            Err(TryLockError::Error(source)) => return Err(io(&lock_path)(source)),
        }
        let folder = Self { path: path.to_path_buf(), _lock: lock };
        folder.clear_temporary()?;
        let checkpoint = has_checkpoint(path);
        // An interrupted run has tables too; the manifest, written last, tells them apart.
        let finished = match Manifest::read(path) {
            Some(manifest) => manifest.status == Status::Finished,
            None => !checkpoint && folder.join(PARETO).exists(),
        };
        match opening {
            // A run that was stopped by its limits keeps its checkpoint: raised limits let it go on.
            Opening::Resume => {}
            Opening::New if finished => return Err(FolderError::Finished(folder.path)),
            Opening::New if checkpoint => return Err(FolderError::Interrupted(folder.path)),
            Opening::New => folder.refuse_occupied()?,
            Opening::Overwrite => folder.clear()?,
        }
        Ok(folder)
    }

    /// Refuses a folder with files of others under the names of a run's: they would be replaced, or removed with all of
    /// `designs/`.
    fn refuse_occupied(&self) -> Result<(), FolderError> {
        let names = [HISTORY, GENERATIONS, OPERATORS, REPORT, DESIGNS, DESIGN_EXPLORER];
        match names.into_iter().find(|name| self.join(name).exists()) {
            None => Ok(()),
            Some(name) => Err(FolderError::Occupied { path: self.path.clone(), name }),
        }
    }

    /// Removes what a run writes, and nothing else.
    fn clear(&self) -> Result<(), FolderError> {
        let files = [
            PARETO,
            HISTORY,
            GENERATIONS,
            OPERATORS,
            MANIFEST,
            CHECKPOINT,
            CHECKPOINT_PREVIOUS,
            JOURNAL,
            JOURNAL_BEFORE,
            REPORT,
        ];
        let excel = [PARETO, HISTORY, GENERATIONS, OPERATORS].map(excel_name);
        for name in files.into_iter().chain(excel.iter().map(String::as_str)) {
            self.remove(name, |path| fs::remove_file(path))?;
        }
        self.remove(EXPLAINED, |path| fs::remove_dir_all(path))?;
        self.clear_designs()
    }

    /// Removes what a killed run was just writing under a temporary name.
    fn clear_temporary(&self) -> Result<(), FolderError> {
        for folder in [self.path.clone(), self.join(DESIGNS), self.join(DESIGN_EXPLORER)] {
            for path in fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()) {
                if atomic::is_temporary(&path) {
                    fs::remove_file(&path).map_err(|source| FolderError::Io { path, source })?;
                }
            }
        }
        Ok(())
    }

    /// Removes the files of all designs: the front of a run that goes on may lose some.
    ///
    /// # Errors
    /// [`FolderError::Io`].
    pub fn clear_designs(&self) -> Result<(), FolderError> {
        for name in [DESIGNS, DESIGN_EXPLORER] {
            self.remove(name, |path| fs::remove_dir_all(path))?;
        }
        Ok(())
    }

    fn remove(&self, name: &str, remove: impl Fn(&Path) -> io::Result<()>) -> Result<(), FolderError> {
        let path = self.join(name);
        match remove(&path) {
            Err(source) if source.kind() != io::ErrorKind::NotFound => Err(FolderError::Io { path, source }),
            _ => Ok(()),
        }
    }

    /// The folder's path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The path of a file in it.
    pub fn join(&self, name: impl AsRef<Path>) -> PathBuf {
        self.path.join(name)
    }

    /// Writes a file whole ([`atomic::write`]); a folder in `name` is made.
    ///
    /// # Errors
    /// [`FolderError::Io`].
    pub fn write(&self, name: impl AsRef<Path>, bytes: &[u8]) -> Result<(), FolderError> {
        self.write_with(name, |out| out.write_all(bytes))
    }

    /// As [`Folder::write`], for what is made while it is written.
    ///
    /// # Errors
    /// [`FolderError::Io`].
    pub fn write_with(
        &self,
        name: impl AsRef<Path>,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), FolderError> {
        let path = self.join(name);
        let made = path.parent().map_or(Ok(()), fs::create_dir_all);
        made.and_then(|()| atomic::write_with(&path, fill)).map_err(|source| FolderError::Io { path, source })
    }
}

/// Refuses the folder of a later program, also to be overwritten.
fn refuse_newer(folder: &Path) -> Result<(), FolderError> {
    let path = folder.join(MANIFEST);
    match fs::read(&path).map(|bytes| Manifest::parse(&bytes)) {
        Ok(Err(reason @ ManifestError::Newer { .. })) => Err(FolderError::Newer { path, reason }),
        _ => Ok(()),
    }
}

fn has_checkpoint(folder: &Path) -> bool {
    [CHECKPOINT, CHECKPOINT_PREVIOUS].iter().any(|name| folder.join(name).exists())
        || journal(folder).exists()
}

/// The journal of a folder: a run that was begun under its old name keeps it.
pub fn journal(folder: &Path) -> PathBuf {
    let [path, before] = [JOURNAL, JOURNAL_BEFORE].map(|name| folder.join(name));
    if before.exists() && !path.exists() { before } else { path }
}

/// The name of a table's copy for a spreadsheet with decimal commas: `pareto.csv` → `pareto.excel-eu.csv`.
pub fn excel_name(name: &str) -> String {
    format!("{}.excel-eu.csv", name.trim_end_matches(".csv"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_runs_are_kept_out_of_one_folder() {
        let folder = tempfile::tempdir().unwrap();
        let first = Folder::open(folder.path(), Opening::New).unwrap();
        assert!(matches!(Folder::open(folder.path(), Opening::New), Err(FolderError::InUse(_))));
        drop(first);
        Folder::open(folder.path(), Opening::New).unwrap();
    }

    #[test]
    fn finished_and_interrupted_runs_are_kept() {
        let temporary = tempfile::tempdir().unwrap();
        let open = |opening| Folder::open(temporary.path(), opening);
        assert!(matches!(open(Opening::Resume), Err(FolderError::NoCheckpoint(_))));
        open(Opening::New).unwrap().write(CHECKPOINT, b"{}").unwrap();
        assert!(matches!(open(Opening::New), Err(FolderError::Interrupted(_))));
        // Killed while it wrote its tables: the manifest is missing.
        open(Opening::Resume).unwrap().write(PARETO, b"id\n").unwrap();
        assert!(matches!(open(Opening::New), Err(FolderError::Interrupted(_))));
        fs::remove_file(temporary.path().join(CHECKPOINT)).unwrap();
        assert!(matches!(open(Opening::New), Err(FolderError::Finished(_))));
    }

    #[test]
    fn files_of_others_are_not_replaced() {
        for name in ["designs/mine.txt", "history.csv"] {
            let temporary = tempfile::tempdir().unwrap();
            let path = temporary.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(&path, b"mine").unwrap();
            let refused = Folder::open(temporary.path(), Opening::New).unwrap_err();
            assert!(matches!(refused, FolderError::Occupied { .. }), "{refused}");
            assert!(path.exists());
            Folder::open(temporary.path(), Opening::Overwrite).unwrap();
            assert!(!path.exists());
        }
    }

    #[test]
    fn what_a_killed_run_was_writing_is_removed() {
        let temporary = tempfile::tempdir().unwrap();
        let folder = Folder::open(temporary.path(), Opening::New).unwrap();
        for name in [CHECKPOINT, ".quadrille-a1b2.tmp", "designs/.quadrille-c3d4.tmp", ".theirs.tmp"] {
            folder.write(name, b"x").unwrap();
        }
        drop(folder);
        let folder = Folder::open(temporary.path(), Opening::Resume).unwrap();
        assert!(folder.join(CHECKPOINT).exists() && folder.join(".theirs.tmp").exists());
        assert!(!folder.join(".quadrille-a1b2.tmp").exists());
        assert!(!folder.join("designs/.quadrille-c3d4.tmp").exists());
    }

    #[test]
    fn overwriting_removes_results_only() {
        let temporary = tempfile::tempdir().unwrap();
        let folder = Folder::open(temporary.path(), Opening::New).unwrap();
        for name in [PARETO, "designs/a.obj", "notes.txt"] {
            folder.write(name, b"x").unwrap();
        }
        drop(folder);
        let folder = Folder::open(temporary.path(), Opening::Overwrite).unwrap();
        assert!(!folder.join(PARETO).exists() && !folder.join(DESIGNS).exists());
        assert!(folder.join("notes.txt").exists());
    }
}
