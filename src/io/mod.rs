//! Mesh files as plain arrays: OBJ and COMPAS JSON.

pub mod compas;
mod join;
pub mod obj;
pub mod text;
mod unit;

pub use join::MEET;

pub use unit::LengthUnit;

use std::path::{Path, PathBuf};

/// Why a file cannot be read: names the file and, where there is one, the line (from 1).
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum ReadError {
    /// The operating system refuses.
    #[error("{}: {reason}", file.display())]
    Open {
        /// The file.
        file: PathBuf,
        /// What the operating system says.
        reason: String,
    },
    /// A line is wrong.
    #[error("{}:{line}: {reason}", file.display())]
    Line {
        /// The file.
        file: PathBuf,
        /// The line, from 1.
        line: usize,
        /// What is wrong.
        reason: String,
    },
    /// The file as a whole is wrong.
    #[error("{}: {reason}", file.display())]
    Content {
        /// The file.
        file: PathBuf,
        /// What is wrong.
        reason: String,
    },
}

/// The bytes of a file.
///
/// # Errors
/// [`ReadError::Open`].
pub(crate) fn read_bytes(file: &Path) -> Result<Vec<u8>, ReadError> {
    std::fs::read(file).map_err(|e| ReadError::Open { file: file.to_owned(), reason: e.to_string() })
}
