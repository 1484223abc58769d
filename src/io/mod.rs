//! Files that a config names, and mesh files as plain arrays: OBJ and COMPAS JSON.

pub mod compas;
mod inputs;
pub mod obj;
mod unit;

pub use inputs::{Input, Inputs, found, hex, sha256};
pub use unit::LengthUnit;

use std::path::PathBuf;

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
