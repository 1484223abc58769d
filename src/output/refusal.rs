//! Why a results folder cannot be used, and what a run may do with one.

use super::manifest::ManifestError;
use std::io;
use std::path::PathBuf;

/// What a run does with what is there.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Opening {
    /// Only a folder in which nothing would be replaced.
    New,
    /// What an earlier run wrote is removed.
    Overwrite,
    /// Go on with an interrupted run.
    Resume,
}

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
    /// It holds something else under a name that a run writes.
    #[error("{} holds {name}, which no run there wrote; give another --out, or --force to write there all the same: what no run wrote is kept, as {name}.bak where its name is needed", path.display())]
    Occupied {
        /// The folder.
        path: PathBuf,
        /// The file or folder in it.
        name: String,
    },
    /// A file is where a folder has to be.
    #[error("{} is no folder, and a run needs one of that name; give another --out", .0.display())]
    NoFolder(PathBuf),
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
