//! One run a folder: a lock that goes with the process, however it ends.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

/// The file that is locked. Its name is the program's own: a `.lock` belongs to somebody else.
pub const LOCK: &str = ".quadrille.lock";

/// A folder that this process alone may write to, as long as the value lives.
#[derive(Debug)]
pub struct Lock {
    _file: File,
    /// Why the file system cannot lock, where it cannot.
    unlocked: Option<io::Error>,
    /// What was made for it, the last thing last; removed again unless the lock is kept.
    made: Vec<PathBuf>,
}

/// What may come of trying.
#[derive(Debug)]
pub enum Try {
    /// The lock is held now.
    Held(Lock),
    /// Another process holds it.
    InUse,
    /// There is no lock file.
    Absent,
}

impl Lock {
    /// Locks a folder that has a lock file already; makes none.
    ///
    /// # Errors
    /// What the system says of a file that is there and cannot be opened.
    pub fn existing(folder: &Path) -> io::Result<Try> {
        match OpenOptions::new().read(true).write(true).open(folder.join(LOCK)) {
            Ok(file) => Ok(Self::take(file, Vec::new())),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Try::Absent),
            Err(error) => Err(error),
        }
    }

    /// Locks a folder, made if need be.
    ///
    /// # Errors
    /// What the system says, and of which file or folder.
    pub fn make(folder: &Path) -> Result<Try, (PathBuf, io::Error)> {
        let missing = folder.ancestors().take_while(|path| !path.as_os_str().is_empty() && !path.exists());
        let mut made: Vec<PathBuf> = missing.map(Path::to_path_buf).collect();
        made.reverse();
        let path = folder.join(LOCK);
        let undone = |made: &[PathBuf], path: PathBuf, error: io::Error| {
            undo(made);
            (path, error)
        };
        fs::create_dir_all(folder).map_err(|error| undone(&made, folder.to_path_buf(), error))?;
        let is_new = !path.exists();
        let opened = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path);
        let file = opened.map_err(|error| undone(&made, path.clone(), error))?;
        if is_new {
            made.push(path);
        }
        Ok(Self::take(file, made))
    }

    fn take(file: File, made: Vec<PathBuf>) -> Try {
        match file.try_lock() {
            Ok(()) => Try::Held(Self { _file: file, unlocked: None, made }),
            Err(TryLockError::WouldBlock) => Try::InUse,
            // Some network file systems know no locks. That is no reason not to run.
            Err(TryLockError::Error(error)) => Try::Held(Self { _file: file, unlocked: Some(error), made }),
        }
    }

    /// Whether a process holds the lock of a folder.
    pub fn is_held(folder: &Path) -> bool {
        matches!(Self::existing(folder), Ok(Try::InUse))
    }

    /// Why the file system cannot lock, where it cannot.
    pub fn unlocked(&self) -> Option<&io::Error> {
        self.unlocked.as_ref()
    }

    /// From now on the lock file stays, and the folder with it.
    pub fn keep(&mut self) {
        self.made.clear();
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        undo(&self.made);
    }
}

/// Removes a lock file that nobody used and folders that nothing came into.
fn undo(made: &[PathBuf]) {
    for path in made.iter().rev() {
        // What somebody else has put there meanwhile keeps its folder.
        let _ = if path.is_dir() { fs::remove_dir(path) } else { fs::remove_file(path) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn held(tried: Try) -> Lock {
        match tried {
            Try::Held(lock) => lock,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn one_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        assert!(matches!(Lock::existing(folder.path()).unwrap(), Try::Absent));
        let mut first = held(Lock::make(folder.path()).unwrap());
        first.keep();
        assert!(Lock::is_held(folder.path()));
        assert!(matches!(Lock::make(folder.path()).unwrap(), Try::InUse));
        drop(first);
        assert!(!Lock::is_held(folder.path()));
        held(Lock::existing(folder.path()).unwrap());
    }

    #[test]
    fn what_is_not_kept_leaves_no_trace() {
        let folder = tempfile::tempdir().unwrap();
        drop(held(Lock::make(&folder.path().join("a/b")).unwrap()));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
