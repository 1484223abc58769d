//! What a report shows, as plain data: whoever has a results folder or a finished run fills this in.

use crate::output::coarse::Singularities;
use serde::{Deserialize, Serialize};

/// Everything on the page. Numbers in SI; a value that does not exist is `None`, never `NaN`.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct ReportData {
    /// Name, seed and counts of the run.
    pub run: Run,
    /// Every metric, in the order of [`Design::values`].
    pub metrics: Vec<Metric>,
    /// Which entries of `metrics` are the objectives, in the order of the config.
    pub objectives: Vec<usize>,
    /// The front, in the order of `pareto.csv`.
    pub front: Vec<Design>,
    /// The design of the empty string: the initial mesh.
    pub baseline: Option<Design>,
    /// What kept designs from being feasible, the most frequent first.
    pub obstacles: Vec<Obstacle>,
    /// Where there is no front: the designs that came nearest to being feasible, the nearest first.
    pub misses: Vec<Design>,
    /// One row per generation, in order.
    pub generations: Vec<Generation>,
    /// Objective values of the population at both ends of the run.
    pub spread: Spread,
    /// The config as resolved, TOML.
    pub config_toml: String,
    /// Endings of the files that every design of the front, or every nearest miss, has in `designs/`, such as `.obj`; linked from the page.
    pub design_files: Vec<String>,
}

/// What the head of the page says about the run.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Run {
    /// `run.name` of the config.
    pub name: String,
    /// Version of the program that wrote the results.
    pub program_version: String,
    /// The seed, as text: JavaScript's numbers cannot hold all 64 bits.
    pub seed: String,
    /// Evaluated designs.
    pub evaluations: u64,
    /// Feasible ones among them.
    pub feasible: u64,
    /// Children refused because they are as good as known.
    pub duplicates_refused: u64,
}

/// A limit, a requirement or another failure, and what it cost.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct Obstacle {
    /// Key of the config or metric, such as `min_edge_m`; words for a failure, such as `folds`.
    pub name: String,
    /// Designs that it kept from being feasible; a design may count under several.
    pub designs: u64,
}

/// One column of numbers: what it is called, its unit and what it means.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Metric {
    /// Short name for people, such as `Deflection`.
    pub label: String,
    /// Column in the CSV files, such as `deflection_m`.
    pub column: String,
    /// Unit of the values, such as `m`; empty for a plain number.
    pub unit: String,
    /// What it measures, in one sentence.
    pub meaning: String,
    /// Whether it is an objective that is better the larger it is.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub maximised: bool,
}

/// One design: its string, its numbers, its mesh.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Design {
    /// Its id, as its files are named.
    pub id: String,
    /// The string as bred.
    pub string: String,
    /// The part of the string that has an effect.
    pub expressed: String,
    /// Generation in which it was first evaluated.
    pub generation: u32,
    /// Whether it meets all limits and requirements.
    pub feasible: bool,
    /// Why not, if it does not.
    pub reason: Option<String>,
    /// One value per entry of [`ReportData::metrics`].
    pub values: Vec<Option<f64>>,
    /// Irregular vertices of its topology, by which designs are grouped into families; `None` if not known.
    pub singularities: Option<Singularities>,
    /// Reflections and rotations of the domain that map it onto itself, as in the column `symmetry`; empty if there are none.
    pub symmetry: String,
    /// How many evaluated designs have the same objectives to six digits, itself included.
    pub equal: u64,
    /// Its place on the front by weights and aspiration of the config; `None` without these.
    pub preferred: Option<u64>,
    /// Number of its family where singularities alone make too many: designs a few strips apart.
    pub family: Option<usize>,
    /// Its dense mesh with results; without one the design has no picture.
    pub mesh: Option<Mesh>,
}

/// A dense mesh and what is drawn on it.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Mesh {
    /// Vertex positions, m, z up.
    pub positions: Vec<[f64; 3]>,
    /// Panels of three or four vertices, counter-clockwise seen from above.
    pub panels: Vec<Vec<u32>>,
    /// Every edge once, in any order: the members.
    pub edges: Vec<[u32; 2]>,
    /// Vertices that are singular in the coarse mesh and worth a mark.
    pub singular: Vec<Singular>,
    /// Curvature of each panel (docs/reference/geometry.md §3); `None` for triangles. Empty: not known.
    pub curvature: Vec<Option<f64>>,
    /// Skewness of each panel (docs/reference/geometry.md §3); `None` for triangles. Empty: not known.
    pub skewness: Vec<Option<f64>>,
    /// Utilisation of each member, in the order of `edges`. Empty: not known.
    pub utilisation: Vec<Option<f64>>,
}

/// A marked vertex.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Singular {
    /// The vertex.
    pub vertex: u32,
    /// What is singular about it.
    pub mark: Mark,
}

/// What is singular about a vertex; drawn as in `designs/ID.svg`.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Mark {
    /// Fewer members than regular.
    Fewer,
    /// More members than regular.
    More,
    /// A pole, where a strip ends in a fan of triangles.
    Pole,
}

/// One row of `generations.csv`.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Generation {
    /// Its number; 0 is the first population.
    pub generation: u32,
    /// Evaluations so far.
    pub evaluations: u64,
    /// Feasible evaluations so far.
    pub feasible: u64,
    /// Size of the non-dominated set of all feasible evaluations so far.
    pub front: u64,
    /// Normalised hypervolume of that set; `None` until its reference point is known.
    pub hypervolume: Option<f64>,
    /// Children refused in this generation because they are as good as known.
    pub duplicates_refused: u64,
}

/// Objective values of the feasible designs evaluated in the first and the last generation.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Spread {
    /// The first.
    pub first: Sample,
    /// The last.
    pub last: Sample,
}

/// One population's objective values.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Sample {
    /// Which designs these are, such as `generation 0`.
    pub label: String,
    /// One row per design, one value per objective.
    pub rows: Vec<Vec<Option<f64>>>,
}
