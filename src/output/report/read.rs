//! From a results folder to [`ReportData`]: what the files say is what the page shows.

use super::choose::worth_a_mesh;
use super::data::{Design, Generation, Mesh, Metric, ReportData, Run, Sample, Spread};
use super::rows::{Line, ReadError, Sheet};
use super::{measure, rows};
use crate::objectives::METRICS;
use crate::output::designs::{FIRST, LAST};
use crate::output::folder;
use crate::output::manifest::Manifest;
use std::path::Path;

/// Bytes of the page that meshes may take; the rest of 15 MB is for libraries and numbers.
const MESH_BUDGET: usize = 13_000_000;
/// Bytes that a packed mesh takes per panel, generously (measured: 26).
const BYTES_PER_PANEL: usize = 28;

/// Reads a results folder: `manifest.json`, the CSV files and, for pictures, `designs/ID.json` and `ID_members.csv`.
///
/// Of a front too large for one page some designs come without a mesh ([`worth_a_mesh`]); the baseline keeps its own.
/// A design whose mesh file is missing has no picture, and one whose member file is missing no utilisation.
///
/// # Errors
/// [`ReadError`]: a file that is missing or cannot be read, by name and line.
pub fn read(folder: &Path) -> Result<ReportData, ReadError> {
    let manifest: Manifest = rows::json(&folder.join(folder::MANIFEST))?;
    let pareto = Sheet::read(&folder.join(folder::PARETO))?;
    let history = Sheet::read(&folder.join(folder::HISTORY))?;
    let columns: Vec<&str> = metric_columns(&pareto).collect();
    let objectives = objective_places(&manifest, &columns, &pareto)?;
    let mut front = designs(&pareto, &columns)?;
    let mut baseline = baseline(&history, &columns)?;
    let meshes = folder.join(folder::DESIGNS);
    for design in front.iter_mut().chain(&mut baseline) {
        add_mesh(design, &meshes)?;
    }
    keep_within_budget(&mut front, &objectives);
    Ok(ReportData {
        run: run(&manifest),
        metrics: columns.iter().map(|column| metric(column)).collect(),
        spread: spread(&history, &manifest.objectives)?,
        generations: generations(&Sheet::read(&folder.join(folder::GENERATIONS))?)?,
        objectives,
        front,
        baseline,
        config_toml: manifest.config,
        design_files: [".obj", ".json", ".svg", ".vtu", "_nodes.csv", "_members.csv"]
            .map(str::to_owned)
            .to_vec(),
    })
}

fn run(manifest: &Manifest) -> Run {
    let counts = &manifest.counts;
    Run {
        name: manifest.name.clone(),
        program_version: manifest.program_version.clone(),
        seed: manifest.seed.to_string(),
        evaluations: counts.evaluations,
        feasible: counts.feasible,
        duplicates_refused: counts.duplicates_refused + counts.neighbours_refused,
    }
}

/// All columns with numbers: what is left of the header without its words.
fn metric_columns(sheet: &Sheet) -> impl Iterator<Item = &str> {
    sheet.columns().filter(|column| !FIRST.contains(column) && !LAST.contains(column))
}

fn objective_places(manifest: &Manifest, columns: &[&str], sheet: &Sheet) -> Result<Vec<usize>, ReadError> {
    let place =
        |name: &String| columns.iter().position(|column| column == name).ok_or_else(|| sheet.lacks(name));
    manifest.objectives.iter().map(place).collect()
}

fn metric(column: &str) -> Metric {
    let known = METRICS.iter().find(|metric| metric.column == column);
    let name = known.map_or(column, |metric| metric.name).replace('_', " ");
    let mut letters = name.chars();
    let label = letters.next().map(|first| first.to_uppercase().chain(letters).collect());
    Metric {
        label: label.unwrap_or_default(),
        column: column.to_owned(),
        unit: known.map_or_else(String::new, |metric| metric.unit.to_owned()),
        meaning: known.map_or_else(String::new, |metric| metric.about.to_owned()),
    }
}

fn designs(sheet: &Sheet, columns: &[&str]) -> Result<Vec<Design>, ReadError> {
    sheet.lines().map(|line| design(&line, columns)).collect()
}

fn design(line: &Line<'_>, columns: &[&str]) -> Result<Design, ReadError> {
    let values: Result<_, ReadError> = columns.iter().map(|column| line.number(column)).collect();
    Ok(Design {
        id: line.text("id")?.to_owned(),
        string: line.text("string")?.to_owned(),
        expressed: line.text("expressed")?.to_owned(),
        generation: line.count("generation")? as u32,
        feasible: line.text("feasible")? == "true",
        reason: line.text("reason").ok().filter(|reason| !reason.is_empty()).map(str::to_owned),
        values: values?,
        singularities: None,
        mesh: None,
    })
}

/// The design of the empty string; any other string of which nothing is expressed gives the same one.
fn baseline(history: &Sheet, columns: &[&str]) -> Result<Option<Design>, ReadError> {
    for line in history.lines() {
        if line.text("expressed")?.is_empty() {
            return design(&line, columns).map(Some);
        }
    }
    Ok(None)
}

/// Adds what the design's files say of its shape.
fn add_mesh(design: &mut Design, folder: &Path) -> Result<(), ReadError> {
    let Some((positions, panels)) = rows::compas(&folder.join(format!("{}.json", design.id)))? else {
        return Ok(());
    };
    let mut mesh = measure::mesh(positions, panels);
    mesh.utilisation = rows::utilisation(&folder.join(format!("{}_members.csv", design.id)), &mesh.edges)?;
    design.singularities = Some(measure::singularities(&mesh));
    design.mesh = Some(mesh);
    Ok(())
}

fn keep_within_budget(front: &mut [Design], objectives: &[usize]) {
    let panels: usize = front.iter().filter_map(|d| d.mesh.as_ref()).map(|mesh| mesh.panels.len()).sum();
    let each = (panels / front.len().max(1)).max(1) * BYTES_PER_PANEL;
    let table: Vec<Vec<Option<f64>>> =
        front.iter().map(|design| objectives.iter().map(|&o| design.values[o]).collect()).collect();
    let kept = worth_a_mesh(&table, MESH_BUDGET / each);
    for (place, design) in front.iter_mut().enumerate() {
        design.mesh = design.mesh.take().filter(|_: &Mesh| kept.binary_search(&place).is_ok());
    }
}

fn generations(sheet: &Sheet) -> Result<Vec<Generation>, ReadError> {
    let row = |line: Line<'_>| {
        Ok(Generation {
            generation: line.count("generation")? as u32,
            evaluations: line.count("evaluations")?,
            feasible: line.count("feasible")?,
            front: line.count("front_size")?,
            hypervolume: line.number("hypervolume")?,
            duplicates_refused: line.count("duplicates_refused")? + line.count("neighbours_refused")?,
        })
    };
    sheet.lines().map(row).collect()
}

/// Objectives of the feasible designs evaluated in the first and in the last generation that has any.
fn spread(history: &Sheet, objectives: &[String]) -> Result<Spread, ReadError> {
    let mut feasible: Vec<(u64, Vec<Option<f64>>)> = Vec::new();
    for line in history.lines() {
        if line.text("feasible")? == "true" {
            let values: Result<_, ReadError> = objectives.iter().map(|column| line.number(column)).collect();
            feasible.push((line.count("generation")?, values?));
        }
    }
    let sample = |generation: Option<u64>| {
        generation.map_or_else(Sample::default, |generation| Sample {
            label: format!("generation {generation}"),
            rows: feasible
                .iter()
                .filter(|(g, _)| *g == generation)
                .map(|(_, values)| values.clone())
                .collect(),
        })
    };
    let all = || feasible.iter().map(|&(generation, _)| generation);
    Ok(Spread { first: sample(all().min()), last: sample(all().max()) })
}
