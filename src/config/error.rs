//! What is wrong with a config: where, what was found, what is allowed.

use super::path::KeyPath;
use std::fmt;
use std::path::PathBuf;

/// Why a config was refused.
#[derive(Debug, thiserror::Error)]
pub enum ConfigError {
    /// The file could not be read.
    #[error("{}: {source}; expected: a config in TOML, as `quadrille init` writes one", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The file is not TOML.
    #[error("{}:{line}: {message}", file.display())]
    Syntax {
        /// The file.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What the TOML parser says, with what it expected.
        message: String,
    },
    /// Keys or values are wrong; all that were found, in order of place.
    #[error("{}", lines(.0))]
    Invalid(Vec<Located>),
}

fn lines(problems: &[Located]) -> String {
    problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// One thing that is wrong, before it is known where the key was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The key.
    pub key: KeyPath,
    /// What was found and what is allowed.
    pub message: String,
}

impl Problem {
    /// A problem of a key.
    pub fn new(key: KeyPath, message: impl Into<String>) -> Self {
        Self { key, message: message.into() }
    }
}

/// Where a value came from.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    /// A file as a whole (the key is not in it).
    File(PathBuf),
    /// A line of a file, from 1.
    Line(PathBuf, usize),
    /// An argument `--set key=value`.
    Argument(String),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(file) => write!(f, "{}", file.display()),
            Self::Line(file, line) => write!(f, "{}:{line}", file.display()),
            Self::Argument(text) => write!(f, "--set {text}"),
        }
    }
}

/// A [`Problem`] with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Located {
    /// Where the value came from.
    pub place: Place,
    /// What is wrong.
    pub problem: Problem,
}

impl fmt::Display for Located {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}: {}", self.place, self.problem.key, self.problem.message)
    }
}
