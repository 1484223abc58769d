//! A config with its defaults: written back, hashed, compared.

use super::{Config, KeyPath, names, seeds};
use crate::geometry::params::{FREE_SWEEPS, RelaxKind};
use crate::io::{Inputs, sha256};
use crate::search::params::Initialiser;
use crate::structure::params::{HeightParams, SectionParams, StructureParams};
use crate::surface::params::SurfaceParams;
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// Fills in defaults that depend on other keys; `given` is the config as written.
pub(super) fn fill_in(config: &mut Config, given: &Table) {
    if config.surface == (SurfaceParams::Free {}) {
        // docs/reference/geometry.md §2.4: the paper's cable net, not its gridshell.
        let relax = given.get("pattern").and_then(|pattern| pattern.get("relax"));
        let is_given = |key: &str| relax.is_some_and(|relax| relax.get(key).is_some());
        if !is_given("kind") {
            config.pattern.relax.kind = RelaxKind::Uniform;
        }
        if !is_given("sweeps") {
            config.pattern.relax.sweeps = FREE_SWEEPS;
        }
    }
    if let Some(structure) = &config.structure {
        let width = section_width(structure);
        config.pattern.limits.min_edge_m.get_or_insert(2.0 * width);
    }
    if config.objectives.count() == 0 {
        let names = if config.structure.is_some() {
            names::WITH_STRUCTURE.as_slice()
        } else {
            names::WITHOUT_STRUCTURE.as_slice()
        };
        config.objectives.minimise = names.iter().map(|&name| name.to_owned()).collect();
    }
    let initial = given.get("search").and_then(|search| search.get("initial"));
    if initial.and_then(|initial| initial.get("kind")).is_none() {
        config.search.initial.kind = Initialiser::of(config.objectives.count());
    }
}

/// Width of the section in plan, m: of a round one its largest height.
fn section_width(structure: &StructureParams) -> f64 {
    let height = match structure.height {
        HeightParams::Fixed { fixed_m } => fixed_m,
        HeightParams::Sized { max_m, .. } => max_m,
    };
    match structure.section {
        SectionParams::Box { width_m, .. } | SectionParams::Properties { width_m, .. } => width_m,
        SectionParams::Round {} | SectionParams::Tube { .. } => height,
    }
}

/// The config as TOML, all defaults written out; [`ResolvedConfig`](super::ResolvedConfig) reads it as the same config.
pub fn to_toml(config: &Config) -> String {
    // Only types that TOML cannot hold could fail here, and a config that came from TOML has none.
    toml::to_string(config).unwrap_or_default()
}

/// SHA-256 of [`to_toml`], in hex.
pub fn hash(config: &Config) -> String {
    sha256(to_toml(config).as_bytes())
}

/// The files that a config names, relative to its folder.
pub fn input_files(config: &Config) -> Vec<PathBuf> {
    let mut files = [config.domain.files(), config.surface.files(), config.topology.files()].concat();
    files.extend(seeds::file(&config.search.seeds));
    files
}

/// Reads the files that a config names; `folder` is where relative paths start.
pub(super) fn read_inputs(config: &Config, folder: &Path) -> Inputs {
    Inputs::read(folder, input_files(config))
}

/// The keys in which two configs differ, in the order of the file.
pub fn differences(a: &Config, b: &Config) -> Vec<String> {
    let mut keys = Vec::new();
    if let (Ok(a), Ok(b)) = (Value::try_from(a), Value::try_from(b)) {
        collect_differences(Some(&a), Some(&b), &KeyPath::default(), &mut keys);
    }
    keys
}

fn collect_differences(a: Option<&Value>, b: Option<&Value>, path: &KeyPath, keys: &mut Vec<String>) {
    match (a, b) {
        (a, b) if a == b => {}
        (Some(Value::Table(a)), Some(Value::Table(b))) => {
            let added = b.keys().filter(|key| !a.contains_key(*key));
            for key in a.keys().chain(added) {
                collect_differences(a.get(key), b.get(key), &path.key(key), keys);
            }
        }
        _ => keys.push(path.to_string()),
    }
}
