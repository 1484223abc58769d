//! The reference cases and base meshes, read from `tests/data/grammar`.
#![allow(
    dead_code,
    clippy::unwrap_used,
    reason = "each test file uses what it needs; a broken case file is a failure"
)]

use quadrille::mesh::{BaseMeshError, InitialMesh, base_json};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// Text of a file under `tests/data/grammar`, also for the fuzz targets, whose crate lies in a folder of this one.
pub fn text(name: &str) -> String {
    let folders =
        Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().map(|folder| folder.join("tests/data/grammar"));
    let path = folders.map(|folder| folder.join(name)).find(|path| path.exists()).expect(name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// `vectors.json`.
pub fn vectors() -> Value {
    serde_json::from_str(&text("vectors.json")).unwrap()
}

/// The twelve base meshes by name.
pub fn bases() -> BTreeMap<String, InitialMesh> {
    let names = [
        "annulus3x2",
        "cube",
        "fan",
        "frei_otto",
        "great_court",
        "grid2x2",
        "grid3x3",
        "grid4x3",
        "pole_disc",
        "single",
        "torus_hole",
        "tripole",
    ];
    names.into_iter().map(|name| (name.to_string(), named(name))).collect()
}

/// One base mesh by name.
pub fn named(name: &str) -> InitialMesh {
    let base = base_json::read(&text(&format!("bases/{name}.json"))).unwrap();
    InitialMesh::from_base(&base).unwrap()
}

/// The mesh written in a case, with positions that do not matter.
pub fn base(case: &Value) -> Result<InitialMesh, BaseMeshError> {
    let mut mesh = case.clone();
    let count = case["summary"]["V"].as_u64().unwrap();
    mesh["vertices"] = Value::from(vec![vec![0.0; 3]; count as usize]);
    InitialMesh::from_base(&base_json::read(&mesh.to_string()).unwrap())
}
