//! The search over strings: breeding, duplicates, cache, archive, checkpoint (docs/reference/search.md).
//!
//! [`run`] knows strings, codes and numbers. What a string means and what it is worth it asks of a [`Problem`],
//! through a [`Server`] that evaluates batches.

mod breeding;
mod child;
mod driver;
mod known;
mod local;
mod near;
mod normalise;
mod observer;
pub mod operators;
mod outcome;
pub mod params;
mod problem;
mod record;
mod screening;
mod server;
mod state;
mod stop;
mod store;
mod threads;

pub use driver::run;
pub use normalise::{ENOUGH, Normalisation, quantile};
pub use observer::{Observer, Progress, Silent};
pub use outcome::{Ended, Outcome};
pub use params::{ObjectivesParams, SearchParams};
pub use problem::{Evaluation, Identity, Preview, Problem, RuleOperator, Steps, round_significant};
pub use record::{Breeding, EvaluatedRow, GenerationRow, Metrics, OperatorCount};
pub use server::{Server, ThreadServer, evaluate};
pub use state::Settings;
pub use stop::StopFlag;
pub use store::{Snapshot, Store, StoreError, differing_keys};
pub use threads::{ThreadsError, thread_pool};
