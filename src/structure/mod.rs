//! The in-house linear-elastic frame solver (docs/reference/structure.md). It knows nodes and members, not strips.
//!
//! ```text
//! FrameModel → System (numbering, symbolic factor) → Solver (assembled, factorised) → first / second order, buckling
//! ```

pub mod action;
pub mod buckling;
mod columns;
pub mod element;
pub mod factor;
pub mod file;
pub mod forces;
mod frame;
pub mod gridshell;
pub mod joint;
mod loading;
pub mod mechanism;
mod members;
pub mod model;
pub mod params;
pub mod second_order;
pub mod section;
pub mod solver;
pub mod system;
mod triangular;
mod validate;

pub use frame::{FrameAnalysis, FrameError, FrameResult, Order, combined, frame};
pub use gridshell::{AnalysisError, Response, analyse, analyse_detailed};
pub use model::{FrameModel, FrameParts, ModelError};
pub use params::StructureParams;
