//! The search over strings: breeding, duplicates, cache, archive, checkpoint (RUN "The search").

pub mod operators;
pub mod params;
mod problem;
mod record;
mod server;

pub use params::{ObjectivesParams, SearchParams};
pub use problem::{Evaluation, Identity, Problem, RuleOperator, round_significant};
pub use record::{Breeding, EvaluatedRow, GenerationRow, Metrics, OperatorCount};
pub use server::{Server, ThreadServer, evaluate};
