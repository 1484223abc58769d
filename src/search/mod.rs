//! The search over strings: breeding, duplicates, cache, archive, checkpoint (RUN "The search").

pub mod params;

pub use params::{ObjectivesParams, SearchParams};
