//! Writes a whole results folder (RUN "Results folder").

use super::analysed::{Analysed, PanelShapes};
use super::compas::compas;
use super::designs::{Columns, id, pareto, write_history};
use super::explorer::{Column, design_explorer};
use super::folder::{self, Folder, FolderError, excel_name};
use super::generations::{generations, operators};
use super::manifest::{self, Counts, Host, Manifest, Status, timestamp};
use super::obj::obj;
use super::obstacles::nearest_misses;
use super::polygons::Polygons;
use super::svg::{Plan, Shade, svg};
use super::table::{Dialect, Table};
use crate::config::{self, Config};
use crate::mesh::CanonicalMesh;
use crate::objectives::METRICS;
use crate::search::{Ended, EvaluatedRow, Evaluation, Outcome, ThreadsError, thread_pool};
use crate::structure::gridshell::{Detailed, Proof};
use crate::study::{Design, Failure, Reached, Study};
use rayon::prelude::*;
use serde_json::Value as Json;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;
use std::time::SystemTime;

/// When and with what this part of the run was done.
#[derive(Clone, Copy, Debug)]
pub struct Sitting {
    /// Its start.
    pub started: SystemTime,
    /// Seconds of searching.
    pub seconds: f64,
    /// Threads that evaluated.
    pub threads: usize,
}

/// Why results could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ResultsError {
    /// The system refused.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A file named in the config cannot be read.
    #[error("{file}: {source}")]
    Input {
        /// The file.
        file: String,
        /// What the system says.
        source: std::io::Error,
    },
    /// The system does not give the threads.
    #[error(transparent)]
    Threads(#[from] ThreadsError),
    /// A design of the front can no longer be made: the program contradicts itself.
    #[error("design {id}: {reason}")]
    Design {
        /// Its id.
        id: String,
        /// Why not.
        reason: String,
    },
}

/// A finished search and what it was made from.
#[derive(Clone, Copy)]
pub struct Run<'a> {
    /// What the search was served by.
    pub study: &'a Study,
    /// The config as resolved, seed included.
    pub config: &'a Config,
    /// The folder that paths in it are relative to.
    pub config_folder: &'a Path,
    /// What was found.
    pub outcome: &'a Outcome,
}

/// What a resumed run must have in common with the one it goes on with: the config and the files it names.
///
/// # Errors
/// If one of these files cannot be read.
pub fn record(config: &Config, config_folder: &Path) -> Result<Json, ResultsError> {
    let mut record = serde_json::to_value(config).unwrap_or_default();
    record["input_files"] = serde_json::to_value(input_hashes(config, config_folder)?).unwrap_or_default();
    Ok(record)
}

fn input_hashes(config: &Config, config_folder: &Path) -> Result<BTreeMap<String, String>, ResultsError> {
    let hash = |file: &Path| {
        let name = file.display().to_string();
        match std::fs::read(config_folder.join(file)) {
            Ok(bytes) => Ok((name, config::hex(&Sha256::digest(bytes)))),
            Err(source) => Err(ResultsError::Input { file: name, source }),
        }
    };
    config::input_files(config).iter().map(|file| hash(file)).collect()
}

impl Run<'_> {
    /// Writes tables and manifest of an interrupted run, so that what is known so far can be looked at.
    ///
    /// # Errors
    /// [`ResultsError`].
    pub fn write_interrupted(&self, folder: &Folder, sitting: &Sitting) -> Result<(), ResultsError> {
        self.write_tables(folder, Dialect::Canonical)?;
        self.write_manifest(folder, sitting, Status::Interrupted)
    }

    /// Writes everything but the report; the manifest last, since it says that the run is finished.
    ///
    /// # Errors
    /// [`ResultsError`].
    pub fn write(&self, folder: &Folder, sitting: &Sitting, dialect: Dialect) -> Result<(), ResultsError> {
        self.write_tables(folder, dialect)?;
        self.write_designs(folder, sitting.threads)?;
        self.write_manifest(folder, sitting, Status::Finished)
    }

    fn front(&self) -> Vec<&EvaluatedRow> {
        self.outcome.front.iter().map(|&row| &self.outcome.evaluated[row]).collect()
    }

    fn write_tables(&self, folder: &Folder, dialect: Dialect) -> Result<(), ResultsError> {
        let columns = Columns::of(&self.config.objectives.minimise);
        let Outcome { evaluated, generations: rows, .. } = self.outcome;
        let tables: [(&str, Table); 3] = [
            (folder::PARETO, pareto(&self.front(), &columns)),
            (folder::GENERATIONS, generations(rows, &columns.objectives)),
            (folder::OPERATORS, operators(rows)),
        ];
        let excel = (dialect == Dialect::ExcelEu).then_some(Dialect::ExcelEu);
        for dialect in [Dialect::Canonical].into_iter().chain(excel) {
            let named = |name: &str| match dialect {
                Dialect::Canonical => name.to_owned(),
                Dialect::ExcelEu => excel_name(name),
            };
            for (name, table) in &tables {
                folder.write(named(name), &table.to_bytes(dialect))?;
            }
            let history = |out: &mut dyn Write| write_history(out, dialect, evaluated, &columns);
            folder.write_with(named(folder::HISTORY), history)?;
        }
        Ok(())
    }

    /// Every design of the front in every format, and the copies for Design Explorer; without a front the designs that came
    /// nearest; for comparison also the initial mesh, where it has a pattern.
    fn write_designs(&self, folder: &Folder, threads: usize) -> Result<(), ResultsError> {
        let front = self.front();
        let pool = thread_pool(threads)?;
        let baseline = self.outcome.evaluated.iter().find(|row| row.tokens.is_empty());
        let files: Vec<DesignFiles> =
            pool.install(|| front.par_iter().map(|row| self.design_files(row)).collect::<Result<_, _>>())?;
        folder.clear_designs()?;
        let initial = baseline.and_then(|row| self.design_files(row).ok());
        let misses = nearest_misses(&self.outcome.evaluated);
        let of_miss = |&row: &usize| self.design_files(&self.outcome.evaluated[row]).ok();
        let misses: Vec<DesignFiles> = pool.install(|| misses.par_iter().filter_map(of_miss).collect());
        for (name, bytes) in misses.iter().flatten() {
            folder.write(Path::new(folder::DESIGNS).join(name), bytes)?;
        }
        for (name, bytes) in files.iter().chain(&initial).flatten() {
            folder.write(Path::new(folder::DESIGNS).join(name), bytes)?;
            if name.ends_with(".svg") {
                folder.write(Path::new(folder::DESIGN_EXPLORER).join(name), bytes)?;
            }
        }
        let table = design_explorer(&front, &explorer_columns(false), &explorer_columns(true));
        Ok(folder.write(Path::new(folder::DESIGN_EXPLORER).join("data.csv"), &table.to_csv())?)
    }

    fn design_files(&self, row: &EvaluatedRow) -> Result<DesignFiles, ResultsError> {
        let id = id(row.code);
        match Developed::of(self.study, self.study.topology(&row.tokens), Proof::Certificate) {
            Ok(Developed { failure: Some(failure), .. }) if row.is_feasible() => {
                Err(ResultsError::Design { id, reason: failure.reason })
            }
            Ok(developed) => Ok(developed.files(&id)),
            Err(failure) => Err(ResultsError::Design { id, reason: failure.reason }),
        }
    }

    fn write_manifest(&self, folder: &Folder, sitting: &Sitting, status: Status) -> Result<(), ResultsError> {
        let counts = self.counts();
        let earlier = Manifest::read(folder.path());
        let same = earlier.as_ref().filter(|earlier| earlier.counts == counts);
        if same.is_some_and(|earlier| earlier.status == Status::Finished) {
            // Nothing was done in this sitting: what is there tells of those in which something was.
            return Ok(());
        }
        let threads = same.map_or(sitting.threads, |earlier| earlier.threads);
        let (started, before) = match earlier {
            Some(earlier) => (earlier.started, earlier.seconds),
            None => (timestamp(sitting.started), 0.0),
        };
        let config = config::to_toml(self.config);
        let manifest = Manifest {
            manifest_version: manifest::VERSION,
            program: env!("CARGO_PKG_NAME").into(),
            program_version: env!("CARGO_PKG_VERSION").into(),
            name: self.config.run.name.clone().unwrap_or_default(),
            objectives: Columns::of(&self.config.objectives.minimise).objectives,
            seed: self.config.run.seed.unwrap_or_default(),
            threads,
            status,
            ended_by: words(self.outcome.ended),
            started,
            ended: timestamp(SystemTime::now()),
            counts,
            seconds: before + sitting.seconds,
            host: Host::here(),
            config_folder: absolute(self.config_folder),
            config_sha256: config::hash(self.config),
            input_files: input_hashes(self.config, self.config_folder)?,
            config,
        };
        Ok(folder.write(folder::MANIFEST, &manifest.to_json())?)
    }

    fn counts(&self) -> Counts {
        let Outcome { generations, breeding, .. } = self.outcome;
        let last = generations.last();
        Counts {
            generations: last.map_or(0, |row| row.generation),
            evaluations: self.outcome.evaluated.len() as u64,
            structural_evaluations: last.map_or(0, |row| row.structural),
            feasible: last.map_or(0, |row| row.feasible),
            front_size: self.outcome.front.len() as u64,
            bred: breeding.bred,
            duplicates_refused: breeding.duplicates,
            neighbours_refused: breeding.neighbours,
        }
    }
}

/// Names of files and what is in them.
pub type DesignFiles = Vec<(String, Vec<u8>)>;

/// A design with all that can be had of it, for files and tables.
pub struct Developed {
    /// Its mesh, pattern and measures.
    pub design: Design,
    /// Its analysis; none where no structure is configured or it gives no answer.
    pub results: Option<Detailed>,
    /// What refused it, if anything did.
    pub failure: Option<Evaluation>,
    /// Whether the pattern is folded or leaves the domain: then it has no measures worth a table.
    pub folded: bool,
    first_order: bool,
}

impl Developed {
    /// Develops a topology as far as it goes.
    ///
    /// # Errors
    /// The failure of one that has no pattern.
    pub fn of(study: &Study, topology: CanonicalMesh, proof: Proof) -> Result<Self, Failure> {
        let first_order = study.is_first_order();
        let failure = match study.develop_in_detail(topology, proof) {
            Ok((design, results)) => {
                return Ok(Self { design, results, failure: None, folded: false, first_order });
            }
            Err(failure) => failure,
        };
        let evaluation = Some(Evaluation::from(&failure));
        let (design, folded) = match failure.reached {
            Reached::Nothing => return Err(failure),
            Reached::Folded(design) => (*design, true),
            Reached::Pattern(design) => (*design, false),
        };
        Ok(Self { design, results: None, failure: evaluation, folded, first_order })
    }

    /// As the search and the tables take it.
    pub fn evaluation(&self, study: &Study) -> Evaluation {
        self.failure.clone().unwrap_or_else(|| study.evaluation(&self.design))
    }

    /// How far it came, as [`Failure::reached`] tells it.
    pub fn reached(self) -> Reached {
        let design = Box::new(self.design);
        if self.folded { Reached::Folded(design) } else { Reached::Pattern(design) }
    }

    /// Its pattern with the analysis, for the exporters.
    pub fn analysed(&self) -> Analysed<'_> {
        Analysed {
            pattern: &self.design.pattern,
            results: self.results.as_ref(),
            first_order: self.first_order,
        }
    }

    /// Its plan, panels shaded by curvature.
    pub fn plan(&self, id: &str) -> Vec<u8> {
        let curvature = PanelShapes::of(&self.design.pattern).curvature;
        // A fixed scale, so that designs can be compared by eye.
        let shade = Some(Shade { label: "panel curvature", values: &curvature, darkest: 0.05 });
        svg(&self.design.pattern, &self.title(id), &Plan { shade, supports: self.supports() })
    }

    /// What pictures of it are called.
    pub(super) fn title(&self, id: &str) -> String {
        let pattern = &self.design.pattern;
        format!("design {id}: {} panels, {} members", pattern.panels.len(), pattern.edges.len())
    }

    /// Its supported nodes, and whether they are held horizontally; none where nothing was analysed.
    pub(super) fn supports(&self) -> Vec<([f64; 3], bool)> {
        let Some(frame) = self.results.as_ref().map(|results| &results.model.frame) else {
            return Vec::new();
        };
        let nodes = frame.supported().map(|node| node.0 as usize);
        nodes.map(|n| (frame.nodes()[n], frame.fixed()[n][0] || frame.fixed()[n][1])).collect()
    }

    /// The files of `designs/`.
    pub fn files(&self, id: &str) -> DesignFiles {
        let mesh = Polygons::from(&self.design.pattern);
        let analysed = self.analysed();
        let named = |ending: &str, bytes: Vec<u8>| (format!("{id}{ending}"), bytes);
        vec![
            named(".obj", obj(&mesh, id)),
            named(".json", compas(&mesh, id)),
            named(".svg", self.plan(id)),
            named(".vtu", analysed.panels_vtu()),
            named("_members.vtu", analysed.members_vtu()),
            named("_nodes.csv", analysed.nodes_table().to_csv()),
            named("_members.csv", analysed.members_table().to_csv()),
        ]
    }
}

/// What tells topologies apart is an input of Design Explorer, everything else an output.
fn explorer_columns(outputs: bool) -> Vec<Column> {
    const INPUTS: [&str; 3] = ["strips", "singularities", "poles"];
    let wanted = METRICS.iter().enumerate().filter(|(_, metric)| INPUTS.contains(&metric.name) != outputs);
    wanted
        .map(|(place, metric)| Column {
            metric: place,
            name: if metric.unit.is_empty() {
                metric.name.into()
            } else {
                format!("{}[{}]", metric.name, metric.unit)
            },
        })
        .collect()
}

fn absolute(folder: &Path) -> String {
    std::path::absolute(folder).unwrap_or_else(|_| folder.to_path_buf()).display().to_string()
}

/// Why a run ended, in words.
fn words(ended: Ended) -> String {
    match ended {
        Ended::Generations => "all generations are done".into(),
        Ended::Evaluations => "the structural evaluations are used up".into(),
        Ended::Minutes => "the time is used up".into(),
        Ended::Stall => "the hypervolume no longer grew".into(),
        Ended::Exhausted => "nothing new could be bred".into(),
        Ended::Interrupted(signal) => format!("signal {signal}"),
    }
}
