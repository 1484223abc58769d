//! From a results folder to [`ReportData`]: what the files say is what the page shows.

use super::choose::worth_a_mesh;
use super::data::{Design, Generation, Metric, Obstacle, ReportData, Run, Sample, Spread};
use super::families::{HANDFUL, families};
use super::{measure, shape};
use crate::config::ResolvedConfig;
use crate::files::names::DESIGNS;
use crate::io::Inputs;
use crate::mesh::QuadMesh;
use crate::objectives::{self, METRICS};
use crate::output::coarse::singularities;
use crate::output::designs::{Naming, id};
use crate::output::front::Standing;
use crate::output::inputs;
use crate::output::load::{LoadError, Loaded, look};
use crate::output::manifest::Manifest;
use crate::output::obstacles::{Obstacles, nearest_misses};
use crate::search::{EvaluatedRow, GenerationRow};
use crate::study::Study;
use std::collections::BTreeSet;
use std::path::Path;

/// Bytes of the page that meshes may take; the rest of 15 MB is for libraries and numbers.
const MESH_BUDGET: usize = 13_000_000;
/// Bytes that a packed mesh takes per panel, generously (measured: 26).
const BYTES_PER_PANEL: usize = 28;

/// Reads a results folder, also of a run that is not finished ([`look`]): tables, manifest and, for pictures, `designs/ID.json` and `ID_members.csv`.
///
/// Of a front too large for one page some designs come without a mesh ([`worth_a_mesh`]); the baseline keeps its own.
/// A design whose mesh file is missing has no picture, and one whose member file is missing no utilisation.
///
/// # Errors
/// [`LoadError`]: a file that is missing or cannot be read, by name and line.
pub fn read(folder: &Path) -> Result<ReportData, LoadError> {
    let loaded = look(folder)?;
    let inputs = inputs::again(&loaded.manifest, &loaded.config, None).ok();
    of(folder, loaded, inputs)
}

/// As [`read`], from a folder that was read already; designs are grouped where its inputs are there as they were.
///
/// # Errors
/// As [`read`].
pub fn of(folder: &Path, loaded: Loaded, inputs: Option<Inputs>) -> Result<ReportData, LoadError> {
    let shown = Shown::of(folder, &loaded, inputs);
    let Loaded { manifest, evaluated, front, generations, is_unfinished, .. } = loaded;
    let shapes = folder.join(DESIGNS);
    let mut rows: Vec<Design> =
        front.iter().map(|&row| shown.design(&evaluated[row], &shapes)).collect::<Result<_, _>>()?;
    // Any string of which nothing is expressed gives the initial mesh.
    let initial = evaluated.iter().find(|row| row.expressed.is_empty());
    let mut baseline = initial.map(|row| shown.design(row, &shapes)).transpose()?;
    shown.group(baseline.iter_mut().chain(&mut rows).collect());
    let misses = nearest_misses(&evaluated);
    let misses: Vec<Design> =
        misses.iter().map(|&row| shown.design(&evaluated[row], &shapes)).collect::<Result<_, _>>()?;
    keep_within_budget(&mut rows, &shown);
    Ok(ReportData {
        run: run(&manifest, is_unfinished),
        metrics: shown.metrics(),
        objectives: (0..shown.objectives).collect(),
        design_files: rows
            .first()
            .or(misses.first())
            .map(|design| shape::endings(&shapes, &design.id))
            .unwrap_or_default(),
        obstacles: Obstacles::of(&evaluated)
            .counted()
            .into_iter()
            .map(|(name, designs)| Obstacle { name, designs })
            .collect(),
        misses,
        front: rows,
        baseline,
        generations: generations.iter().map(generation).collect(),
        spread: shown.spread(&evaluated),
        config_toml: manifest.config,
    })
}

fn run(manifest: &Manifest, is_unfinished: bool) -> Run {
    let counts = &manifest.counts;
    let name = manifest.name.clone();
    Run {
        name: match is_unfinished {
            true => format!("{name} (unfinished, after generation {})", counts.generations),
            false => name,
        },
        program_version: manifest.program_version.clone(),
        seed: manifest.seed.to_string(),
        evaluations: counts.evaluations,
        feasible: counts.feasible,
        duplicates_refused: counts.duplicates_refused + counts.neighbours_refused,
    }
}

fn generation(row: &GenerationRow) -> Generation {
    Generation {
        generation: row.generation,
        evaluations: row.evaluations,
        feasible: row.feasible,
        front: row.front,
        hypervolume: row.hypervolume,
        duplicates_refused: row.breeding.duplicates + row.breeding.neighbours,
    }
}

fn metric(metric: &objectives::Metric) -> Metric {
    let name = metric.name.replace('_', " ");
    let mut letters = name.chars();
    let label = letters.next().map(|first| first.to_uppercase().chain(letters).collect());
    Metric {
        label: label.unwrap_or_default(),
        column: metric.column.to_owned(),
        unit: metric.unit.to_owned(),
        meaning: metric.about.to_owned(),
        maximised: false,
    }
}

/// Which metrics the page shows: the objectives, then every other that some design has; as places in [`METRICS`].
struct Shown {
    places: Vec<usize>,
    objectives: usize,
    /// How many of the objectives are minimised: the first.
    minimised: usize,
    naming: Naming,
    standing: Standing,
    /// What strings mean; none where the files that the config names are no longer there.
    study: Option<Study>,
}

impl Shown {
    fn of(folder: &Path, loaded: &Loaded, inputs: Option<Inputs>) -> Self {
        let Loaded { config, evaluated, front, naming, .. } = loaded;
        let place = |name: &String| METRICS.iter().position(|metric| metric.name == name);
        let mut places: Vec<usize> = config.objectives.names().filter_map(place).collect();
        let objectives = places.len();
        let exists = |place: &usize| evaluated.iter().any(|row| row.metrics.get(*place).is_some());
        let others = (0..METRICS.len()).filter(|place| !places.contains(place)).filter(exists);
        places.extend(others.collect::<Vec<_>>());
        Self {
            places,
            objectives,
            minimised: config.objectives.minimise.len(),
            naming: *naming,
            standing: Standing::of(evaluated, front, &config.objectives),
            study: inputs
                .and_then(|inputs| Study::of(&ResolvedConfig::again(config, inputs, folder).ok()?).ok()),
        }
    }

    fn metrics(&self) -> Vec<Metric> {
        let mut metrics: Vec<Metric> = self.places.iter().map(|&place| metric(METRICS[place])).collect();
        metrics[self.minimised..self.objectives].iter_mut().for_each(|metric| metric.maximised = true);
        metrics
    }

    /// Objectives of a design, all of them better when smaller.
    fn minimised(&self, design: &Design) -> Vec<Option<f64>> {
        let values = design.values[..self.objectives].iter().enumerate();
        values
            .map(|(place, value)| value.map(|value| if place < self.minimised { value } else { -value }))
            .collect()
    }

    fn design(&self, row: &EvaluatedRow, shapes: &Path) -> Result<Design, LoadError> {
        let mut design = Design {
            id: self.naming.apply(id(row.code)),
            string: row.tokens.to_string(),
            expressed: row.expressed.to_string(),
            generation: row.generation,
            feasible: row.is_feasible(),
            reason: (!row.reason.is_empty()).then(|| row.reason.to_string()),
            values: self.places.iter().map(|&place| row.metrics.get(place)).collect(),
            singularities: self.study.as_ref().map(|study| singularities(&study.decode(&row.tokens).mesh)),
            symmetry: row.symmetries.to_string(),
            equal: self.standing.equal_designs(row),
            preferred: self.standing.preferred(row),
            family: None,
            mesh: None,
        };
        if let Some((positions, panels)) = shape::compas(&shapes.join(format!("{}.json", design.id)))? {
            let mut mesh = measure::mesh(positions, panels);
            mesh.utilisation =
                shape::utilisation(shapes, &format!("{}_members.csv", design.id), &mesh.edges)?;
            design.mesh = Some(mesh);
        }
        Ok(design)
    }

    /// Groups designs into families, where their singularities make more than a handful.
    fn group(&self, mut designs: Vec<&mut Design>) {
        let kinds: BTreeSet<_> = designs.iter().map(|design| &design.singularities).collect();
        let Some(study) = self.study.as_ref().filter(|_| kinds.len() > HANDFUL) else { return };
        let mesh = |design: &&mut Design| Some(study.decode(&design.string.parse().ok()?).mesh);
        let Some(meshes) = designs.iter().map(mesh).collect::<Option<Vec<QuadMesh>>>() else { return };
        for (design, family) in designs.iter_mut().zip(families(&meshes)) {
            design.family = Some(family);
        }
    }

    /// Objectives of the feasible designs evaluated in the first and in the last generation that has any.
    fn spread(&self, evaluated: &[EvaluatedRow]) -> Spread {
        let feasible = || evaluated.iter().filter(|row| row.is_feasible());
        let values = |row: &EvaluatedRow| {
            self.places[..self.objectives].iter().map(|&place| row.metrics.get(place)).collect()
        };
        let sample = |generation: Option<u32>| {
            generation.map_or_else(Sample::default, |generation| Sample {
                label: format!("generation {generation}"),
                rows: feasible().filter(|row| row.generation == generation).map(values).collect(),
            })
        };
        let generations = || feasible().map(|row| row.generation);
        Spread { first: sample(generations().min()), last: sample(generations().max()) }
    }
}

fn keep_within_budget(front: &mut [Design], shown: &Shown) {
    let panels: usize = front.iter().filter_map(|d| d.mesh.as_ref()).map(|mesh| mesh.panels.len()).sum();
    let each = (panels / front.len().max(1)).max(1) * BYTES_PER_PANEL;
    let table: Vec<Vec<Option<f64>>> = front.iter().map(|design| shown.minimised(design)).collect();
    let kept = worth_a_mesh(&table, MESH_BUDGET / each);
    for (place, design) in front.iter_mut().enumerate() {
        design.mesh = design.mesh.take().filter(|_| kept.binary_search(&place).is_ok());
    }
}
