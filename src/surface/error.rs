//! What can be wrong with a surface.

use crate::io::ReadError;
use std::path::PathBuf;

/// Why a surface cannot be made.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum SurfaceError {
    /// A length that must be positive and finite is not.
    #[error("surface.{key} must be a positive finite length, found {value}")]
    NotPositive {
        /// The key of the config.
        key: &'static str,
        /// Its value.
        value: f64,
    },
    /// A number that must be finite is not.
    #[error("surface.{key} must be finite, found {value}")]
    NotFinite {
        /// The key of the config.
        key: &'static str,
        /// Its value.
        value: f64,
    },
    /// An expression cannot be understood.
    #[error("surface.{0}")]
    Expression(#[from] crate::expression::ExpressionError),
    /// The mesh file cannot be read.
    #[error("surface.file: {0}")]
    File(#[from] ReadError),
    /// The mesh has no face with an area.
    #[error("surface.file: {}: the mesh has no face that could carry a pattern{hint}", file.display())]
    NoFaces {
        /// The file.
        file: PathBuf,
        /// What the file has instead.
        hint: String,
    },
}

impl SurfaceError {
    /// The key of the config that says what is wrong.
    pub fn key(&self) -> String {
        match self {
            Self::NotPositive { key, .. } | Self::NotFinite { key, .. } => format!("surface.{key}"),
            Self::Expression(error) => format!("surface.{}", error.key),
            Self::File(_) | Self::NoFaces { .. } => "surface.file".to_owned(),
        }
    }
}

/// `value` if it is positive and finite.
pub(super) fn positive(key: &'static str, value: f64) -> Result<f64, SurfaceError> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(SurfaceError::NotPositive { key, value }) }
}

/// `value` if it is finite.
pub(super) fn finite(key: &'static str, value: f64) -> Result<f64, SurfaceError> {
    if value.is_finite() { Ok(value) } else { Err(SurfaceError::NotFinite { key, value }) }
}
