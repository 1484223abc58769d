//! `report.html`: one self-contained page that shows a front, its designs and how they were found (docs/reference/files.md §1).
//!
//! [`render`] turns plain [`ReportData`] into the page: same data, same bytes. The page's own scripts and style are in
//! `assets/report/`, the libraries in `assets/vendor/`; all are embedded, and its content security policy forbids the network.

mod choose;
mod data;
mod encode;
mod families;
mod measure;
mod page;
mod read;
mod shape;

pub use crate::output::coarse::Singularities;
pub use choose::worth_a_mesh;
pub use data::{Design, Generation, Mark, Mesh, Metric, Obstacle, ReportData, Run, Sample, Singular, Spread};
pub use read::{of, read};

/// Why a report cannot be made. All of these are mistakes of the caller: a run's own data satisfies them.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A design has another number of values than there are metrics.
    #[error("design {id}: {found} values for {expected} metrics")]
    Values {
        /// The design.
        id: String,
        /// How many it has.
        found: usize,
        /// How many it should have.
        expected: usize,
    },
    /// An objective that is no metric.
    #[error("objective {index} is no metric: there are {metrics}")]
    Objective {
        /// The index given.
        index: usize,
        /// Number of metrics.
        metrics: usize,
    },
    /// A mesh whose arrays do not fit each other.
    #[error("design {id}: {what}")]
    Mesh {
        /// The design.
        id: String,
        /// What does not fit.
        what: String,
    },
    /// The data cannot be written as JSON.
    #[error("the report's data cannot be written: {0}")]
    Json(#[from] serde_json::Error),
}

/// The page, UTF-8.
///
/// # Errors
/// When counts do not match or a mesh is broken; see [`ReportError`].
pub fn render(data: &ReportData) -> Result<String, ReportError> {
    check(data)?;
    page::assemble(data)
}

fn check(data: &ReportData) -> Result<(), ReportError> {
    let expected = data.metrics.len();
    if let Some(&index) = data.objectives.iter().find(|&&i| i >= expected) {
        return Err(ReportError::Objective { index, metrics: expected });
    }
    match data.front.iter().chain(&data.misses).chain(&data.baseline).find(|d| d.values.len() != expected) {
        Some(d) => Err(ReportError::Values { id: d.id.clone(), found: d.values.len(), expected }),
        None => Ok(()),
    }
}
