//! The reference cases and base meshes, read from `tests/data/grammar` and `tests/data/grammar_independent`.
#![allow(
    dead_code,
    clippy::unwrap_used,
    reason = "each test file uses what it needs; a broken case file is a failure"
)]

use quadrille::mesh::{BaseMeshError, InitialMesh, base_json};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The given cases, and those of an implementation that shares nothing with this one: folders of `tests/data`.
pub const GIVEN: &str = "grammar";
/// See [`GIVEN`].
pub const INDEPENDENT: &str = "grammar_independent";

/// A file or folder of a set, also for the fuzz targets, whose crate lies in a folder of this one.
fn path(set: &str, name: &str) -> PathBuf {
    let folders = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors();
    let mut paths = folders.map(|folder| folder.join("tests/data").join(set).join(name));
    paths.find(|path| path.exists()).expect(name)
}

/// Text of a file of a set.
fn text_in(set: &str, name: &str) -> String {
    let path = path(set, name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Text of a file under `tests/data/grammar`.
pub fn text(name: &str) -> String {
    text_in(GIVEN, name)
}

/// `vectors.json` of a set.
pub fn vectors_in(set: &str) -> Value {
    serde_json::from_str(&text_in(set, "vectors.json")).unwrap()
}

/// `vectors.json` of the given cases.
pub fn vectors() -> Value {
    vectors_in(GIVEN)
}

/// The base meshes of both sets by name.
pub fn all_bases() -> BTreeMap<String, InitialMesh> {
    let mut bases = bases();
    for entry in std::fs::read_dir(path(INDEPENDENT, "bases")).unwrap() {
        let path = entry.unwrap().path();
        let base = base_json::read(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let twin = bases.insert(name, InitialMesh::from_base(&base).unwrap());
        assert!(twin.is_none(), "{}: both sets have a base of this name", path.display());
    }
    bases
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
