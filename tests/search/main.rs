//! NSGA-II and the search over strings.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod evolve_fixtures;
mod evolve_problems;
mod near;
mod resume;
mod runs;
mod support;
