//! Results folder and interchange formats: one exporter a file, each returns bytes.

pub mod analysed;
pub mod coarse;
pub mod compas;
pub mod consistency;
pub mod designs;
pub mod dxf;
pub mod explanation;
pub mod explorer;
pub mod folder;
pub mod frame_model;
pub mod front;
pub mod generations;
pub mod handed;
mod holds;
pub mod inputs;
pub mod ledger;
pub mod load;
pub mod manifest;
pub mod number;
pub mod obj;
pub mod obstacles;
pub mod opensees;
pub mod polygons;
mod refusal;
pub mod report;
pub mod results;
pub mod saf;
#[cfg(test)]
mod sample;
pub mod sitting;
pub mod svg;
pub mod table;
pub mod vtu;
