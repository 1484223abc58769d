//! The shape of a design, from its files in `designs/`.

use crate::output::load::{self, LoadError, Sheet};
use serde::Deserialize;
use std::collections::{BTreeMap, HashMap};
use std::path::Path;

#[derive(Deserialize)]
struct CompasFile {
    data: CompasMesh,
}

#[derive(Deserialize)]
struct CompasMesh {
    vertex: BTreeMap<u32, CompasVertex>,
    face: BTreeMap<u32, Vec<u32>>,
}

#[derive(Deserialize)]
struct CompasVertex {
    x: f64,
    y: f64,
    z: f64,
}

type Shape = (Vec<[f64; 3]>, Vec<Vec<u32>>);

/// Positions and panels of a COMPAS mesh as this program writes it; `None` if there is no such file.
pub(super) fn compas(path: &Path) -> Result<Option<Shape>, LoadError> {
    if !path.exists() {
        return Ok(None);
    }
    let wrong = |message: String| LoadError::Format { path: path.to_owned(), message };
    let file: CompasFile =
        serde_json::from_slice(&load::read(path)?).map_err(|error| wrong(error.to_string()))?;
    let number: HashMap<u32, u32> = file.data.vertex.keys().zip(0..).map(|(&key, i)| (key, i)).collect();
    let panel = |(key, corners): (u32, Vec<u32>)| {
        let corners: Option<Vec<u32>> = corners.iter().map(|v| number.get(v).copied()).collect();
        corners
            .filter(|corners| (3..=4).contains(&corners.len()))
            .ok_or_else(|| wrong(format!("face {key} is no triangle or quad of its vertices")))
    };
    let panels = file.data.face.into_iter().map(panel).collect::<Result<_, _>>()?;
    Ok(Some((file.data.vertex.into_values().map(|v| [v.x, v.y, v.z]).collect(), panels)))
}

/// Utilisation of each edge from the table of members `name`, `from` and `to` being vertices; of an edge of several
/// members the largest. Empty if there is no such table or no such value in it.
pub(super) fn utilisation(
    folder: &Path,
    name: &str,
    edges: &[[u32; 2]],
) -> Result<Vec<Option<f64>>, LoadError> {
    if !folder.join(name).exists() {
        return Ok(Vec::new());
    }
    let members: Vec<(u32, u32, Option<f64>)> = Sheet::each(folder, name, |record| {
        Ok((record.parse("from")?, record.parse("to")?, record.number("utilisation")?))
    })?;
    let mut of_edge: HashMap<[u32; 2], f64> = HashMap::new();
    for (a, b, value) in members {
        if let Some(value) = value {
            let largest = of_edge.entry([a.min(b), a.max(b)]).or_insert(value);
            *largest = largest.max(value);
        }
    }
    if of_edge.is_empty() {
        return Ok(Vec::new());
    }
    Ok(edges.iter().map(|edge| of_edge.get(edge).copied()).collect())
}

/// Endings of the files of a design: `.obj`, `_nodes.csv`, …
pub(super) fn endings(folder: &Path, id: &str) -> Vec<String> {
    let names = std::fs::read_dir(folder)
        .into_iter()
        .flatten()
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let mut endings: Vec<String> = names.filter_map(|name| Some(name.strip_prefix(id)?.to_owned())).collect();
    endings.sort_unstable();
    endings
}
