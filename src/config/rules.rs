//! What several keys, or a key and the file system, say together.

use super::error::Problem;
use super::path::KeyPath;
use super::schema::suggestion;
use super::{Config, VERSION};
use crate::domain::params::{Corners, LoopParams};
use crate::geometry::params::{Density, RelaxKind};
use crate::io::{Inputs, ReadError};
use crate::objectives::params::FabricationParams;
use crate::objectives::{self, METRICS, Metric};
use crate::skeleton::params::InitialMesh;
use crate::structure::params::{
    HeightParams, Quantity, RequirementParams, SectionParams, StructureParams, SupportNodes, SupportParams,
};
use crate::surface::params::SurfaceParams;
use std::collections::BTreeMap;
use std::path::Path;

/// All that is wrong with a config of which each key alone is right. `inputs` are the files that it names.
pub fn check(config: &Config, inputs: &Inputs) -> Vec<Problem> {
    let mut rules = Rules { inputs, problems: Vec::new() };
    rules.run(config);
    rules.domain(config);
    rules.surface(&config.surface);
    rules.topology(&config.topology.initial);
    rules.pattern(config);
    if let Some(structure) = &config.structure {
        rules.structure(structure, config.domain.loops.len(), &config.fabrication);
    }
    rules.objectives(config);
    rules.search(config);
    rules.problems
}

/// Whether a character can stand in the name of a folder, on any system.
pub(super) fn fits_in_a_name(c: char) -> bool {
    !c.is_control() && !"/\\:*?\"<>|".contains(c)
}

/// Whether a folder can be called so, on any system.
pub(super) fn is_name_of_a_folder(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default().trim_end().to_ascii_uppercase();
    let numbered = ["COM", "LPT"].iter().filter_map(|device| stem.strip_prefix(device));
    let is_device = ["CON", "PRN", "AUX", "NUL"].contains(&stem.as_str())
        || numbered
            .into_iter()
            .any(|number| number.len() == 1 && number.starts_with(|c: char| ('1'..='9').contains(&c)));
    !name.is_empty() && !name.ends_with(['.', ' ']) && !is_device && name.chars().all(fits_in_a_name)
}

struct Rules<'a> {
    inputs: &'a Inputs,
    problems: Vec<Problem>,
}

impl Rules<'_> {
    fn refuse(&mut self, key: impl Into<KeyPath>, message: impl Into<String>) {
        self.problems.push(Problem::new(key.into(), message));
    }

    fn file_is_read(&mut self, key: impl Into<KeyPath>, file: &Path) {
        let Err(error) = self.inputs.get(file) else { return };
        let name = file.display();
        self.refuse(
            key,
            match error {
                ReadError::Open { file, .. } if !file.is_file() => {
                    format!("found \"{name}\", but there is no file {}", file.display())
                }
                error => format!("found \"{name}\", which cannot be read: {error}"),
            },
        );
    }

    fn run(&mut self, config: &Config) {
        if config.version != VERSION {
            self.refuse("version", format!("found {}; allowed: {VERSION}", config.version));
        }
        let name = config.run.name.as_deref().unwrap_or_default();
        if !is_name_of_a_folder(name) {
            let message = format!(
                "found {name:?}; allowed: a name of a folder on any system, with any characters but / \\ : * ? \" < > | and control \
                 characters, without a dot or space at its end, and none of Windows' devices (CON, NUL, COM1, …)"
            );
            self.refuse("run.name", message);
        }
    }

    fn domain(&mut self, config: &Config) {
        for (k, boundary_loop) in config.domain.loops.iter().enumerate() {
            let key = KeyPath::of("domain.loop").index(k);
            match boundary_loop {
                LoopParams::Polyline { points_m, corners, .. } => {
                    self.points(points_m, &key.key("points_m"));
                    self.corners(corners, points_m.len(), &key.key("corners"));
                }
                LoopParams::Obj { file, .. } => self.file_is_read(key.key("file"), file),
                LoopParams::Circle { .. } | LoopParams::Ellipse { .. } => {}
            }
        }
    }

    fn points(&mut self, points: &[Vec<f64>], key: &KeyPath) {
        for (i, point) in points.iter().enumerate() {
            if !(2..=3).contains(&point.len()) {
                let message = format!("found {} coordinates; allowed: [x, y] or [x, y, z]", point.len());
                self.refuse(key.index(i), message);
            }
            let next = &points[(i + 1) % points.len()];
            if point.get(..2) == next.get(..2) {
                let cure = match i + 1 == points.len() {
                    true => "leave the last point out: a loop closes by itself",
                    false => "allowed: distinct points",
                };
                let message = format!("found the same point again right after ({point:?}); {cure}");
                self.refuse(key.index(i), message);
            }
        }
    }

    fn corners(&mut self, corners: &Corners, count: usize, key: &KeyPath) {
        let Corners::Indices(indices) = corners else { return };
        for (i, &index) in indices.iter().enumerate() {
            if index >= count {
                self.refuse(
                    key.index(i),
                    format!("found {index}; allowed: 0 to {}", count.saturating_sub(1)),
                );
            }
            if indices[..i].contains(&index) {
                self.refuse(key.index(i), format!("found {index} a second time; allowed: each point once"));
            }
        }
    }

    fn surface(&mut self, surface: &SurfaceParams) {
        if let SurfaceParams::Mesh { file, .. } = surface {
            self.file_is_read("surface.file", file);
        }
    }

    fn topology(&mut self, initial: &InitialMesh) {
        match initial {
            InitialMesh::File { file, .. } => self.file_is_read("topology.initial.file", file),
            InitialMesh::Inline { vertices, faces, .. } => {
                let key = KeyPath::of("topology.initial.faces");
                for (f, face) in faces.iter().enumerate() {
                    for (i, &vertex) in
                        face.iter().enumerate().filter(|(_, vertex)| **vertex >= vertices.len())
                    {
                        let most = vertices.len().saturating_sub(1);
                        let message = format!("found vertex {vertex}; allowed: 0 to {most}");
                        self.refuse(key.index(f).index(i), message);
                    }
                }
            }
            InitialMesh::Word(_) | InitialMesh::Grid { .. } => {}
        }
    }

    fn pattern(&mut self, config: &Config) {
        let pattern = &config.pattern;
        if config.surface == (SurfaceParams::Free {}) && pattern.relax.kind == RelaxKind::Optimise {
            let message = "found \"optimise\", which needs a surface, and surface.kind is \"free\"; allowed there: \"uniform\", \
                           \"area\", \"cotangent\", \"force-density\"";
            self.refuse("pattern.relax.kind", message);
        }
        for (i, limit) in pattern.metric_limits.iter().enumerate() {
            let key = KeyPath::of("pattern.limit").index(i);
            let figures = &config.fabrication;
            let of_geometry = |metric: &Metric| !objectives::needs_analysis(metric, figures);
            self.metric(&key.key("quantity"), &limit.quantity, figures, of_geometry);
            match (limit.max, limit.min) {
                (Some(_), Some(_)) => {
                    self.refuse(key.key("min"), "found beside `max`; allowed: one limit a table")
                }
                (None, None) => self.refuse(key.key("max"), "missing; allowed: a number ≥ 0, or `min`"),
                _ => {}
            }
        }
        if pattern.density == Density::TargetLength && pattern.target_length_m.is_none() {
            let message = "missing, but density = \"target_length\" needs it; allowed: a number > 0";
            self.refuse("pattern.target_length_m", message);
        }
        if pattern.density == Density::Panels && pattern.panels > pattern.max_faces {
            let message =
                format!("found {}; allowed: at most max_faces, {}", pattern.panels, pattern.max_faces);
            self.refuse("pattern.panels", message);
        }
    }

    fn structure(&mut self, structure: &StructureParams, loops: usize, figures: &FabricationParams) {
        self.structure_keys(structure, loops, figures);
        // What the solver itself would refuse, where nothing was said about the key yet.
        for (key, message) in structure.validate() {
            let key = KeyPath::of(&format!("structure.{key}"));
            if !self.problems.iter().any(|problem| problem.key.holds(&key) || key.holds(&problem.key)) {
                self.refuse(key, message);
            }
        }
    }

    fn structure_keys(&mut self, structure: &StructureParams, loops: usize, figures: &FabricationParams) {
        self.height(structure);
        for (i, support) in structure.supports.iter().enumerate() {
            self.support(support, loops, &KeyPath::of("structure.support").index(i));
        }
        let key = KeyPath::of("structure.combinations");
        let cases: Vec<&str> = structure.loads.keys().map(String::as_str).collect();
        for (name, combination) in &structure.combinations {
            for case in combination.keys() {
                self.known(&key.key(name).key(case), "load case", case, &cases);
            }
        }
        for (i, requirement) in structure.requirements.iter().enumerate() {
            let key = KeyPath::of("structure.requirement").index(i);
            if requirement.analysed().is_none() {
                let quantity = requirement.quantity.to_string();
                self.metric(&key.key("quantity"), &quantity, figures, |_| true);
            }
            let sized = matches!(structure.height, HeightParams::Sized { .. });
            self.requirement(requirement, &structure.combinations, sized, &key);
        }
    }

    /// A name that must be one of those given elsewhere.
    fn known(&mut self, key: &KeyPath, what: &str, name: &str, known: &[&str]) {
        if !known.contains(&name) {
            let hint = suggestion(name, known);
            self.refuse(
                key.clone(),
                format!("found no {what} \"{name}\"{hint}; allowed: {}", known.join(", ")),
            );
        }
    }

    fn height(&mut self, structure: &StructureParams) {
        let (least, key) = match structure.height {
            HeightParams::Fixed { fixed_m } => (fixed_m, "structure.height.fixed_m"),
            HeightParams::Sized { min_m, max_m, step_m } => {
                if min_m >= max_m {
                    let message = format!("found {min_m} with max_m = {max_m}; allowed: less than max_m");
                    self.refuse("structure.height.min_m", message);
                }
                if step_m > max_m {
                    let message = format!("found {step_m} with max_m = {max_m}; allowed: at most max_m");
                    self.refuse("structure.height.step_m", message);
                }
                if let SectionParams::Properties { .. } = structure.section {
                    let message =
                        "found a height to be sized with a section of given properties; allowed: fixed_m";
                    self.refuse("structure.height", message.to_owned());
                }
                (min_m, "structure.height.min_m")
            }
        };
        let (SectionParams::Box { thickness_m, .. } | SectionParams::Tube { thickness_m }) =
            structure.section
        else {
            return;
        };
        if !thickness_m.is_finite() {
            let message = format!("found {thickness_m}; allowed: a finite number of metres");
            return self.refuse("structure.section.thickness_m", message);
        }
        let allowed = format!("allowed: more than twice the wall, {}", 2.0 * thickness_m);
        if least <= 2.0 * thickness_m {
            self.refuse(key, format!("found {least}; {allowed}"));
        }
        if let SectionParams::Box { width_m, .. } = structure.section
            && width_m <= 2.0 * thickness_m
        {
            self.refuse("structure.section.width_m", format!("found {width_m}; {allowed}"));
        }
    }

    fn support(&mut self, support: &SupportParams, loops: usize, key: &KeyPath) {
        match support.nodes().as_slice() {
            [] => {
                let message = "missing; allowed: \"boundary\", \"corners\", \"all\", or instead loop = 0, 1, …, \
                               nodes_near_m, sides_near_m or inside_near_m = [[x, y], …]";
                self.refuse(key.key("at"), message);
            }
            [(first, _), (second, _), ..] => {
                let message = format!("found beside `{first}`; allowed: either `{first}` or `{second}`");
                self.refuse(key.key(*second), message);
            }
            [(_, SupportNodes::Loop(k))] if *k >= loops => {
                let message = format!("found {k}; allowed: 0 to {}", loops.saturating_sub(1));
                self.refuse(key.key("loop"), message);
            }
            _ => {}
        }
    }

    fn requirement(
        &mut self,
        requirement: &RequirementParams,
        combinations: &BTreeMap<String, BTreeMap<String, f64>>,
        sized: bool,
        key: &KeyPath,
    ) {
        let known: Vec<&str> = combinations.keys().map(String::as_str).collect();
        let quantity = requirement.analysed();
        match (&requirement.combination, quantity) {
            (Some(name), Some(_)) => self.known(&key.key("combination"), "combination", name, &known),
            (None, Some(quantity)) if quantity.needs_combination() => {
                let message = format!("missing; allowed: {}", known.join(", "));
                self.refuse(key.key("combination"), message);
            }
            (Some(name), None) => {
                let message = format!(
                    "found \"{name}\", but {} is no matter of loads; leave it out",
                    requirement.quantity
                );
                self.refuse(key.key("combination"), message);
            }
            (None, _) => {}
        }
        // What a greater height does not bring nearer cannot be sized for.
        let sized = sized && quantity.is_some_and(Quantity::is_sized_for);
        let lower = quantity.is_some_and(Quantity::better_large);
        let wanted = if lower { "min" } else { "max" };
        match (requirement.max, requirement.min) {
            (Some(_), Some(_)) => {
                self.refuse(key.key("min"), "found beside `max`; allowed: one limit a requirement")
            }
            (Some(_), None) if sized && lower => self
                .refuse(key.key("max"), "found an upper limit beside a height to be sized; allowed: `min`"),
            (None, Some(_)) if sized && !lower => {
                self.refuse(key.key("min"), "found a lower limit beside a height to be sized; allowed: `max`")
            }
            (None, None) => self.refuse(key.key(wanted), "missing; allowed: a number > 0"),
            _ => {}
        }
    }

    /// A metric to be limited, by its name or column; of those that may be limited here.
    fn metric(
        &mut self,
        key: &KeyPath,
        name: &str,
        figures: &FabricationParams,
        may: impl Fn(&Metric) -> bool,
    ) {
        let Some(metric) = objectives::called(name) else {
            let allowed = METRICS.iter().filter(|metric| may(metric));
            let known: Vec<&str> = allowed.map(|metric| metric.name).collect();
            return self.known(key, "metric", name, &known);
        };
        if !may(metric) {
            let message = format!(
                "found \"{name}\", which needs a frame analysis; allowed as a [[structure.requirement]] only"
            );
            self.refuse(key.clone(), message);
        } else if let Some(table) = objectives::lacks_figures(metric, figures) {
            self.refuse(key.clone(), format!("found \"{name}\", which needs unit figures in {table}"));
        }
    }

    /// A name of what is minimised or maximised.
    fn objective(&mut self, key: &KeyPath, name: &str, maximised: bool, config: &Config) {
        let better_large = objectives::better_large(name);
        let names = METRICS.iter().map(|metric| metric.name);
        let known: Vec<&str> =
            names.filter(|name| maximised || objectives::better_large(name).is_none()).collect();
        match (maximised, better_large) {
            (false, Some(instead)) => {
                let message = format!(
                    "found \"{name}\", which is better the larger it is, and objectives are minimised; did you mean \
                     \"{instead}\"? (or maximise = [\"{name}\"])"
                );
                self.refuse(key.clone(), message);
            }
            (true, _) if name == "buckling" => {
                let message = "found \"buckling\", the inverse of the factor, which is better the smaller it is; did you \
                               mean \"buckling_factor\"?";
                self.refuse(key.clone(), message);
            }
            _ => match objectives::find(name) {
                Some(metric) => self.has_a_value(key, metric, config),
                None => match objectives::called(name) {
                    // A column is what tables have; the name is that without the unit.
                    Some(metric) => self.refuse(
                        key.clone(),
                        format!("found no objective \"{name}\"; did you mean \"{}\"?", metric.name),
                    ),
                    None => self.known(key, "objective", name, &known),
                },
            },
        }
    }

    /// Whether the designs of a config have this metric at all.
    fn has_a_value(&mut self, key: &KeyPath, metric: &Metric, config: &Config) {
        let (name, figures) = (metric.name, &config.fabrication);
        if let Some(table) = objectives::lacks_figures(metric, figures) {
            self.refuse(key.clone(), format!("found \"{name}\", which needs unit figures in {table}"));
        } else if config.structure.is_none() && objectives::needs_analysis(metric, figures) {
            let message =
                format!("found \"{name}\", which needs a frame analysis; allowed with [structure] only");
            self.refuse(key.clone(), message);
        }
    }

    fn objectives(&mut self, config: &Config) {
        let objectives = &config.objectives;
        let all: Vec<&String> = objectives.names().collect();
        for (place, name) in all.iter().enumerate() {
            let maximised = objectives.is_maximised(place);
            let key = match maximised {
                true => KeyPath::of("objectives.maximise").index(place - objectives.minimise.len()),
                false => KeyPath::of("objectives.minimise").index(place),
            };
            self.objective(&key, name, maximised, config);
            if all[..place].contains(name) {
                self.refuse(key, format!("found \"{name}\" a second time; allowed: each objective once"));
            }
        }
        let count = objectives.count();
        for (name, values) in [("ideal", &objectives.ideal), ("reference", &objectives.reference)] {
            if !values.is_empty() && values.len() != count {
                let found = values.len();
                let message =
                    format!("found {found} numbers for {count} objectives; allowed: one for each, or []");
                self.refuse(KeyPath::of("objectives").key(name), message);
            }
        }
        if objectives.ideal.is_empty() != objectives.reference.is_empty() {
            let message = "found only one of `ideal` and `reference`; allowed: both, or neither";
            let key = if objectives.ideal.is_empty() { "objectives.reference" } else { "objectives.ideal" };
            self.refuse(key, message);
        }
        for (key, given) in [("weights", &objectives.weights), ("aspiration", &objectives.aspiration)] {
            if !given.is_empty() && given.len() != count {
                let found = given.len();
                let message =
                    format!("found {found} numbers; allowed: one for each of the {count} objectives");
                self.refuse(KeyPath::of("objectives").key(key), message);
            }
        }
        for (i, weight) in objectives.weights.iter().enumerate().filter(|(_, weight)| **weight <= 0.0) {
            let message = format!("found {weight}; allowed: more than 0");
            self.refuse(KeyPath::of("objectives.weights").index(i), message);
        }
        for (i, (ideal, reference)) in objectives.ideal.iter().zip(&objectives.reference).enumerate() {
            let (worse, is_worse) = match objectives.is_maximised(i) {
                true => ("less", reference < ideal),
                false => ("more", reference > ideal),
            };
            if !is_worse {
                let message = format!("found {reference}; allowed: {worse} than the ideal, {ideal}");
                self.refuse(KeyPath::of("objectives.reference").index(i), message);
            }
        }
    }

    fn search(&mut self, config: &Config) {
        let tokens = config.search.tokens;
        if tokens.min > tokens.max {
            let message = format!("found min = {} and max = {}; allowed: min ≤ max", tokens.min, tokens.max);
            self.refuse("search.tokens", message);
        }
        for (i, region) in config.search.frozen.regions_m.iter().enumerate().filter(|(_, r)| r.len() < 3) {
            let message = format!("found {} points; allowed: a polygon of 3 or more", region.len());
            self.refuse(KeyPath::of("search.frozen.regions_m").index(i), message);
        }
    }
}
