//! The results folder: where each file is, who may write, and whether a run is finished.

use super::holds::{check, listed};
use super::ledger::Ledger;
use super::manifest::{Files, Manifest, Status};
pub use super::refusal::{FolderError, Opening};
use crate::files::atomic;
use crate::files::lock::{Lock, Try};
use crate::files::names::{CHANGING, EXPLAINED, FOLDERS, MANIFEST, TABLES};
use crate::io::{hex, sha256};
use sha2::{Digest, Sha256};
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A results folder that this process alone may write to, as long as the value lives.
///
/// Nothing in it is changed before [`Folder::begin`]; a value that is dropped before leaves no trace.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    opening: Opening,
    ledger: Ledger,
    lock: Lock,
}

impl Folder {
    /// Locks the folder, made if need be.
    ///
    /// # Errors
    /// [`FolderError`]: in use, holding something that `opening` does not allow for, or not writable.
    pub fn open(path: &Path, opening: Opening) -> Result<Self, FolderError> {
        let in_use = || FolderError::InUse(path.to_path_buf());
        // A lock that cannot be opened is told below, when the folder is to be written to.
        let held = Lock::existing(path).unwrap_or(Try::Absent);
        let has_lock = !matches!(held, Try::Absent);
        if matches!(held, Try::InUse) {
            return Err(in_use());
        }
        check(path, opening, has_lock)?;
        let lock = match held {
            Try::Held(lock) => lock,
            _ => match Lock::make(path).map_err(|(path, source)| FolderError::Io { path, source })? {
                Try::Held(lock) => lock,
                _ => return Err(in_use()),
            },
        };
        // Another run may have come and gone in between.
        check(path, opening, has_lock)?;
        Ok(Self { path: path.to_path_buf(), opening, ledger: Ledger::new(path, listed(path)), lock })
    }

    /// Makes the folder this run's: removes what a killed one was just writing, and when it overwrites all that an earlier
    /// one wrote.
    ///
    /// # Errors
    /// [`FolderError::Io`].
    pub fn begin(&mut self) -> Result<(), FolderError> {
        self.lock.keep();
        self.clear_temporary()?;
        if self.opening == Opening::Overwrite {
            // The manifest last: as long as something listed is left it says whose that is.
            self.ledger.retire(|name| name == MANIFEST)?;
            for name in CHANGING {
                self.ledger.make_way(name, None)?;
            }
            self.ledger.retire(|_| false)?;
            self.remove_empty_folders();
        }
        self.ledger.announce(CHANGING.into_iter().chain(TABLES).map(str::to_owned));
        Ok(())
    }

    /// Removes what a killed run was just writing under a temporary name.
    fn clear_temporary(&self) -> Result<(), FolderError> {
        for folder in FOLDERS.map(|name| self.join(name)).into_iter().chain([self.path.clone()]) {
            for path in fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()) {
                if atomic::is_temporary(&path) {
                    fs::remove_file(&path).map_err(|source| FolderError::Io { path, source })?;
                }
            }
        }
        Ok(())
    }

    /// Lists names that are about to be written ([`Ledger::announce`], [`Ledger::replace`]).
    ///
    /// # Errors
    /// [`FolderError::Io`].
    pub fn announce(&mut self, names: impl IntoIterator<Item = String>) -> Result<(), FolderError> {
        let names: Vec<String> = names.into_iter().collect();
        self.ledger.announce(names.iter().cloned());
        self.ledger.replace(names)
    }

    /// Removes what earlier sittings wrote and this one did not: designs that are no longer of the front. Pictures of
    /// `explain` stay, their designs are the same.
    ///
    /// # Errors
    /// [`FolderError::Io`].
    pub fn retire(&mut self) -> Result<(), FolderError> {
        let pictures = format!("{EXPLAINED}/");
        self.ledger.retire(|name| CHANGING.contains(&name) || name.starts_with(&pictures))?;
        self.remove_empty_folders();
        Ok(())
    }

    fn remove_empty_folders(&self) {
        for name in FOLDERS {
            // Refused where something is left in it, as it should be.
            let _ = fs::remove_dir(self.join(name));
        }
    }

    /// All files of the run, for its manifest.
    pub fn files(&self) -> Files {
        self.ledger.files()
    }

    /// Whether a run has written a file of this name here.
    pub fn lists(&self, name: &str) -> bool {
        self.ledger.lists(name)
    }

    /// What the user should know: the file system has no locks; files of theirs that were in the way.
    pub fn take_warnings(&mut self) -> Vec<String> {
        self.ledger.take_told()
    }

    /// What to warn of where the file system has no locks.
    pub fn unlocked(&self) -> Option<String> {
        let reason = self.lock.unlocked()?;
        Some(format!(
            "{} cannot be locked ({reason}): see to it that no other run writes there",
            self.path.display()
        ))
    }

    /// The folder's path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The path of a file in it.
    pub fn join(&self, name: impl AsRef<Path>) -> PathBuf {
        self.path.join(name)
    }

    /// Writes a file whole ([`atomic::write`]) and lists it; a folder in `name` is made. What is there and not the run's
    /// is kept under another name.
    ///
    /// # Errors
    /// [`FolderError::Io`].
    pub fn write(&mut self, name: &str, bytes: &[u8]) -> Result<(), FolderError> {
        self.ledger.make_way(name, Some(bytes))?;
        self.put(name, |out| out.write_all(bytes))
    }

    /// As [`Folder::write`], for what is made while it is written.
    ///
    /// # Errors
    /// [`FolderError::Io`].
    pub fn write_with(
        &mut self,
        name: &str,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), FolderError> {
        self.ledger.make_way(name, None)?;
        self.put(name, fill)
    }

    fn put(
        &mut self,
        name: &str,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), FolderError> {
        let path = self.join(name);
        let mut sum = Sha256::new();
        // Only the folder in `name`: a folder that was moved away under a run is not made anew.
        let made = name.split_once('/').map_or(Ok(()), |(folder, _)| make_folder(&self.join(folder)));
        let written =
            made.and_then(|()| atomic::write_with(&path, |out| fill(&mut Summed { out, sum: &mut sum })));
        written.map_err(|source| FolderError::Io { path, source })?;
        let changes = CHANGING.contains(&name);
        self.ledger.written(name, (!changes).then(|| hex(&sum.finalize())));
        Ok(())
    }
}

fn make_folder(path: &Path) -> io::Result<()> {
    match fs::create_dir(path) {
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => Err(error),
        _ => Ok(()),
    }
}

/// Adds up what goes through it.
struct Summed<'a> {
    out: &'a mut dyn Write,
    sum: &'a mut Sha256,
}

impl Write for Summed<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.out.write(bytes)?;
        self.sum.update(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// Lists a file that another command wrote into the folder of a run, so that an overwriting run removes it with the rest.
/// Not while a run is on: its manifest is its own.
///
/// # Errors
/// [`FolderError::Io`].
pub fn list(folder: &Path, name: &str, bytes: &[u8]) -> Result<(), FolderError> {
    let Ok(Try::Held(_lock)) = Lock::make(folder) else { return Ok(()) };
    let listing = Manifest::read(folder).filter(|m| m.status != Status::Running && !m.files.is_empty());
    let Some(mut manifest) = listing else { return Ok(()) };
    manifest.files.insert(name.to_owned(), Some(sha256(bytes)));
    let path = folder.join(MANIFEST);
    atomic::write(&path, &manifest.to_json()).map_err(|source| FolderError::Io { path, source })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::names::{CHECKPOINT, HISTORY, PARETO};
    use std::collections::BTreeMap;

    const STATE: &[u8] = b"{\"version\":1,\"checksum\":\"0\"}";

    /// Every file below a folder, with what it holds.
    fn everything(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
        let mut found = BTreeMap::new();
        for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            match path.is_dir() {
                true => found.extend(everything(&path)),
                false => _ = found.insert(path.clone(), fs::read(&path).unwrap()),
            }
        }
        found
    }

    fn put(folder: &Path, name: &str, bytes: &[u8]) {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }

    #[test]
    fn two_runs_are_kept_out_of_one_folder() {
        let folder = tempfile::tempdir().unwrap();
        let mut first = Folder::open(folder.path(), Opening::New).unwrap();
        first.begin().unwrap();
        assert!(matches!(Folder::open(folder.path(), Opening::New), Err(FolderError::InUse(_))));
        drop(first);
        Folder::open(folder.path(), Opening::New).unwrap();
    }

    #[test]
    fn finished_and_interrupted_runs_are_kept() {
        let temporary = tempfile::tempdir().unwrap();
        let open = |opening| Folder::open(temporary.path(), opening);
        let begun = |opening| -> Folder {
            let mut folder = open(opening).unwrap();
            folder.begin().unwrap();
            folder
        };
        assert!(matches!(open(Opening::Resume), Err(FolderError::NoCheckpoint(_))));
        begun(Opening::New).write(CHECKPOINT, STATE).unwrap();
        assert!(matches!(open(Opening::New), Err(FolderError::Interrupted(_))));
        let manifest = |status| Manifest::sample(status).to_json();
        begun(Opening::Resume).write(MANIFEST, &manifest(Status::Running)).unwrap();
        assert!(matches!(open(Opening::New), Err(FolderError::Interrupted(_))));
        begun(Opening::Resume).write(MANIFEST, &manifest(Status::Finished)).unwrap();
        assert!(matches!(open(Opening::New), Err(FolderError::Finished(_))));
        fs::remove_file(temporary.path().join(CHECKPOINT)).unwrap();
        assert!(matches!(open(Opening::Resume), Err(FolderError::NoCheckpoint(_))));
    }

    #[test]
    fn files_of_others_are_refused_and_forced_kept() {
        for name in
            ["designs/mine.txt", "history.csv", "manifest.json", "checkpoint.json", "pareto.excel-eu.csv"]
        {
            let temporary = tempfile::tempdir().unwrap();
            put(temporary.path(), name, b"{\"mine\": 1}");
            let before = everything(temporary.path());
            for opening in [Opening::New, Opening::Resume] {
                Folder::open(temporary.path(), opening).unwrap_err();
                assert_eq!(everything(temporary.path()), before, "{name}");
            }
            let mut folder = Folder::open(temporary.path(), Opening::Overwrite).unwrap();
            folder.begin().unwrap();
            for table in [MANIFEST, HISTORY, CHECKPOINT, "pareto.excel-eu.csv"] {
                folder.write(table, b"ours").unwrap();
            }
            drop(folder);
            let kept = everything(temporary.path());
            assert!(kept.values().any(|bytes| bytes == b"{\"mine\": 1}"), "{name}: {:?}", kept.keys());
        }
    }

    #[test]
    fn a_lock_of_another_program_makes_no_run() {
        let temporary = tempfile::tempdir().unwrap();
        put(temporary.path(), ".lock", b"pid 7");
        let refused = Folder::open(temporary.path(), Opening::Resume).unwrap_err();
        assert!(matches!(refused, FolderError::NoCheckpoint(_)), "{refused}");
        let mut folder = Folder::open(temporary.path(), Opening::New).unwrap();
        folder.begin().unwrap();
        assert_eq!(fs::read(temporary.path().join(".lock")).unwrap(), b"pid 7");
    }

    #[test]
    fn a_refused_run_leaves_no_trace() {
        let temporary = tempfile::tempdir().unwrap();
        let deep = temporary.path().join("a/b");
        // Dropped before it began, as when its config is refused.
        drop(Folder::open(&deep, Opening::New).unwrap());
        assert!(!temporary.path().join("a").exists());
        let designs = temporary.path().join("designs");
        fs::write(&designs, b"a file").unwrap();
        let refused = Folder::open(temporary.path(), Opening::Overwrite).unwrap_err();
        assert!(matches!(refused, FolderError::NoFolder(_)), "{refused}");
        assert_eq!(everything(temporary.path()).len(), 1);
    }

    #[test]
    fn what_a_killed_run_was_writing_is_removed() {
        let temporary = tempfile::tempdir().unwrap();
        for name in [".quadrille-a1b2.tmp", "designs/.quadrille-c3d4.tmp", ".theirs.tmp"] {
            put(temporary.path(), name, b"x");
        }
        put(temporary.path(), CHECKPOINT, STATE);
        let mut folder = Folder::open(temporary.path(), Opening::Resume).unwrap();
        folder.begin().unwrap();
        assert!(folder.join(CHECKPOINT).exists() && folder.join(".theirs.tmp").exists());
        assert!(!folder.join(".quadrille-a1b2.tmp").exists());
        assert!(!folder.join("designs/.quadrille-c3d4.tmp").exists());
    }

    #[test]
    fn overwriting_removes_results_only() {
        let temporary = tempfile::tempdir().unwrap();
        let mut folder = Folder::open(temporary.path(), Opening::New).unwrap();
        folder.begin().unwrap();
        for name in [PARETO, "designs/a.obj", "designs/b.obj", CHECKPOINT] {
            folder.write(name, STATE).unwrap();
        }
        let manifest = Manifest { files: folder.files(), ..Manifest::sample(Status::Finished) };
        folder.write(MANIFEST, &manifest.to_json()).unwrap();
        drop(folder);
        put(temporary.path(), "notes.txt", b"mine");
        put(temporary.path(), "designs/mine.3dm", b"mine");
        put(temporary.path(), "designs/b.obj", b"edited");
        let mut folder = Folder::open(temporary.path(), Opening::Overwrite).unwrap();
        folder.begin().unwrap();
        assert_eq!(folder.take_warnings().len(), 1);
        drop(folder);
        let left = everything(temporary.path());
        let left: Vec<_> = left.keys().map(|path| path.strip_prefix(temporary.path()).unwrap()).collect();
        let expected = [".quadrille.lock", "designs/b.obj", "designs/mine.3dm", "notes.txt"];
        assert_eq!(left, expected.map(Path::new));
    }
}
