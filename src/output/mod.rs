//! Results folder and interchange formats: one exporter a file, each returns bytes.

pub mod atomic;
pub mod compas;
pub mod number;
pub mod obj;
#[cfg(test)]
mod sample;
pub mod svg;
pub mod table;
pub mod vtu;
