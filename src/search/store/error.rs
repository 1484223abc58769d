//! What can go wrong with the files of a run.

use std::io;
use std::path::{Path, PathBuf};

/// Why the files of a run cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The system refused: no space, no rights.
    #[error("{path}: {source}")]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A later program wrote it.
    #[error(
        "{}: a later version of quadrille wrote it (its format is {found}): go on with that version, or give another \
         --out",
        path.display()
    )]
    Newer {
        /// The file.
        path: PathBuf,
        /// The version of its format.
        found: u32,
    },
    /// The run was begun with another config.
    #[error("{folder}: the run was begun with another config; these keys differ: {}", keys.join(", "))]
    OtherConfig {
        /// The folder.
        folder: PathBuf,
        /// Dotted keys, sorted.
        keys: Vec<String>,
    },
}

impl StoreError {
    pub(crate) fn io(path: &Path, source: io::Error) -> Self {
        Self::Io { path: path.to_path_buf(), source }
    }
}
