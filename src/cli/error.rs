//! What can end a command early, and with which exit code.

use super::exit;
use quadrille::config::ConfigError;
use quadrille::search::ThreadsError;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Why a command gave up.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// The config is wrong.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// Another input (argument, string, file) is wrong.
    #[error("{0}")]
    Input(String),
    /// A file could not be read as input.
    #[error("{}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A file could not be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The system does not give the threads.
    #[error(transparent)]
    Threads(#[from] ThreadsError),
    /// The work itself failed.
    #[error("{0}")]
    Failed(String),
}

impl CliError {
    /// A file that could not be read; for `map_err`.
    pub fn read(path: impl AsRef<Path>) -> impl FnOnce(io::Error) -> Self {
        let path = path.as_ref().to_path_buf();
        move |source| Self::Read { path, source }
    }

    /// A file that could not be written; for `map_err`.
    pub fn write(path: impl AsRef<Path>) -> impl FnOnce(io::Error) -> Self {
        let path = path.as_ref().to_path_buf();
        move |source| Self::Write { path, source }
    }

    /// 2 when the input is at fault, 1 otherwise.
    pub fn exit_code(&self) -> ExitCode {
        ExitCode::from(match self {
            Self::Config(_) | Self::Input(_) | Self::Read { .. } => exit::WRONG_INPUT,
            Self::Write { .. } | Self::Threads(_) | Self::Failed(_) => exit::FAILED,
        })
    }
}
