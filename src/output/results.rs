//! Writes a whole results folder (docs/reference/files.md §1).

use super::analysed::{Analysed, PanelShapes};
use super::compas::compas;
use super::designs::{Columns, id, write_history};
use super::explorer::{Column, design_explorer};
use super::folder::{Folder, FolderError};
use super::front::{Standing, pareto};
use super::generations::{generations, operators};
use super::obj::obj;
use super::obstacles::nearest_misses;
use super::polygons::Polygons;
use super::svg::{Plan, Shade, svg};
use super::table::{Dialect, Table};
use crate::config::ResolvedConfig;
use crate::files::names::{self, TABLES, excel_name};
use crate::mesh::{CanonicalMesh, Code};
use crate::objectives::METRICS;
use crate::search::{EvaluatedRow, Evaluation, Outcome, ThreadsError, thread_pool};
use crate::structure::gridshell::{Detailed, Proof};
use crate::study::{Design, Failure, Reached, Study};
use serde_json::Value as Json;
use std::collections::BTreeSet;
use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;

/// Why results could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ResultsError {
    /// The system refused.
    #[error(transparent)]
    Folder(#[from] FolderError),
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

/// What a resumed run must have in common with the one it goes on with: the config and the files it names.
pub fn record(resolved: &ResolvedConfig) -> Json {
    let mut record = serde_json::to_value(resolved.config()).unwrap_or_default();
    record["input_files"] = serde_json::to_value(resolved.inputs().hashes()).unwrap_or_default();
    record
}

/// How the writing of designs goes, and whether it is to go on.
pub trait Writing {
    /// So many of all designs are written.
    fn written(&mut self, done: usize, all: usize);

    /// Whether to stop with the designs in hand.
    fn stop(&self) -> bool;
}

/// A finished search and what it was made from.
#[derive(Clone, Copy)]
pub struct Run<'a> {
    /// What the search was served by.
    pub study: &'a Study,
    /// The config, seed included, and its files.
    pub resolved: &'a ResolvedConfig,
    /// What was found.
    pub outcome: &'a Outcome,
    /// Which copies of the tables are wanted beside the canonical ones.
    pub dialect: Dialect,
}

impl Run<'_> {
    /// The names of the files that [`Run::write`] may write, but for the manifest.
    pub fn names(&self) -> Vec<String> {
        let rows = self.rows().into_iter();
        let designs = rows.flat_map(|(row, _)| ENDINGS.map(|ending| design_name(&id(row.code), ending)));
        let pictures = self.front().into_iter().chain(self.baseline()).map(|row| picture_name(&id(row.code)));
        let tables = self.table_names().into_iter();
        tables.chain(designs).chain(pictures).chain([explorer_name("data.csv")]).collect()
    }

    /// Those that [`Run::write_tables`] writes.
    pub fn table_names(&self) -> Vec<String> {
        TABLES.iter().flat_map(|name| self.dialects().map(|dialect| named(name, dialect))).collect()
    }

    /// Writes the tables: all that there is of an interrupted run.
    ///
    /// # Errors
    /// [`ResultsError`].
    pub fn write_tables(&self, folder: &mut Folder) -> Result<(), ResultsError> {
        let columns = Columns::of(&self.resolved.config().objectives);
        let Outcome { evaluated, generations: rows, .. } = self.outcome;
        let objectives = &self.resolved.config().objectives;
        let standing = Standing::of(evaluated, &self.outcome.front, objectives);
        let tables: [(&str, Table); 3] = [
            (names::PARETO, pareto(&self.front(), &standing, &columns)),
            (names::GENERATIONS, generations(rows, &columns)),
            (names::OPERATORS, operators(rows)),
        ];
        for dialect in self.dialects() {
            for (name, table) in &tables {
                folder.write(&named(name, dialect), &table.to_bytes(dialect))?;
            }
            let history = |out: &mut dyn Write| write_history(out, dialect, evaluated, &columns);
            folder.write_with(&named(names::HISTORY, dialect), history)?;
        }
        Ok(())
    }

    /// Writes the tables and all designs, and removes what earlier sittings wrote that is no longer found; false if it
    /// was stopped before its end. Report and manifest are left to the caller: they say that a run is finished.
    ///
    /// # Errors
    /// [`ResultsError`].
    pub fn write(
        &self,
        folder: &mut Folder,
        threads: usize,
        writing: &mut dyn Writing,
    ) -> Result<bool, ResultsError> {
        self.write_tables(folder)?;
        if !self.write_designs(folder, threads, writing)? {
            return Ok(false);
        }
        let table = design_explorer(&self.front(), &explorer_columns(false), &explorer_columns(true));
        folder.write(&explorer_name("data.csv"), &table.to_csv())?;
        folder.retire()?;
        Ok(true)
    }

    fn front(&self) -> Vec<&EvaluatedRow> {
        self.outcome.front.iter().map(|&row| &self.outcome.evaluated[row]).collect()
    }

    /// The initial mesh, for comparison.
    fn baseline(&self) -> Option<&EvaluatedRow> {
        self.outcome.evaluated.iter().find(|row| row.tokens.is_empty())
    }

    fn dialects(&self) -> impl Iterator<Item = Dialect> + use<> {
        [Dialect::Canonical].into_iter().chain(Some(self.dialect).filter(|&d| d != Dialect::Canonical))
    }

    /// The designs that get files, each once, and whether each is sure to have a pattern: the front; the initial mesh;
    /// without a front those that came nearest.
    fn rows(&self) -> Vec<(&EvaluatedRow, bool)> {
        let mut rows: Vec<(&EvaluatedRow, bool)> = self.front().into_iter().map(|row| (row, true)).collect();
        let misses = nearest_misses(&self.outcome.evaluated);
        let misses = misses.iter().map(|&row| &self.outcome.evaluated[row]);
        for row in self.baseline().into_iter().chain(misses) {
            if rows.iter().all(|(other, _)| other.code != row.code) {
                rows.push((row, false));
            }
        }
        rows
    }

    /// Every design in every format, each written as soon as it is made, and pictures for Design Explorer.
    fn write_designs(
        &self,
        folder: &mut Folder,
        threads: usize,
        writing: &mut dyn Writing,
    ) -> Result<bool, ResultsError> {
        let rows = self.rows();
        let explored: BTreeSet<Code> =
            self.front().into_iter().chain(self.baseline()).map(|row| row.code).collect();
        let pool = thread_pool(threads)?;
        let over = AtomicBool::new(false);
        let (sender, made) = mpsc::channel();
        let mut done = 0;
        let mut result = Ok(());
        pool.in_place_scope_fifo(|scope| {
            for &(row, is_sure) in &rows {
                let (sender, over) = (sender.clone(), &over);
                scope.spawn_fifo(move |_| {
                    if !over.load(Ordering::Relaxed) {
                        // The receiver outlives the scope, so a send cannot fail.
                        let _ = sender.send((row, is_sure, self.design_files(row)));
                    }
                });
            }
            drop(sender);
            writing.written(done, rows.len());
            for (row, is_sure, files) in made {
                let written = match files {
                    Ok(files) => write_design(folder, files, explored.contains(&row.code)),
                    Err(error) if is_sure => Err(error),
                    Err(_) => Ok(()),
                };
                done += 1;
                if result.is_ok() {
                    result = written;
                }
                writing.written(done, rows.len());
                if result.is_err() || writing.stop() {
                    over.store(true, Ordering::Relaxed);
                }
            }
        });
        result.map(|()| done == rows.len())
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
}

fn write_design(folder: &mut Folder, files: DesignFiles, is_explored: bool) -> Result<(), ResultsError> {
    for (name, bytes) in &files {
        folder.write(&format!("{}/{name}", names::DESIGNS), bytes)?;
        if is_explored && name.ends_with(".svg") {
            folder.write(&explorer_name(name), bytes)?;
        }
    }
    Ok(())
}

/// Endings of the files of a design.
const ENDINGS: [&str; 7] = [".obj", ".json", ".svg", ".vtu", "_members.vtu", "_nodes.csv", "_members.csv"];

fn design_name(id: &str, ending: &str) -> String {
    format!("{}/{id}{ending}", names::DESIGNS)
}

fn picture_name(id: &str) -> String {
    explorer_name(&format!("{id}.svg"))
}

fn explorer_name(name: &str) -> String {
    format!("{}/{name}", names::DESIGN_EXPLORER)
}

/// The name of a table in a dialect.
fn named(name: &str, dialect: Dialect) -> String {
    match dialect {
        Dialect::Canonical => name.to_owned(),
        Dialect::ExcelEu => excel_name(name),
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
    pub fn supports(&self) -> Vec<([f64; 3], bool)> {
        let Some(frame) = self.results.as_ref().map(|results| &results.model.frame) else {
            return Vec::new();
        };
        let nodes = frame.supported().map(|node| node.0 as usize);
        let has_spring = |n: usize| frame.springs().iter().any(|s| s.node as usize == n && s.direction < 2);
        let is_held = |n: usize| frame.fixed()[n][0] || frame.fixed()[n][1] || has_spring(n);
        nodes.map(|n| (frame.nodes()[n], is_held(n))).collect()
    }

    /// The files of `designs/`.
    pub fn files(&self, id: &str) -> DesignFiles {
        let mesh = Polygons::from(&self.design.pattern);
        let analysed = self.analysed();
        let bytes = [
            obj(&mesh, id),
            compas(&mesh, id),
            self.plan(id),
            analysed.panels_vtu(),
            analysed.members_vtu(),
            analysed.nodes_table().to_csv(),
            analysed.members_table().to_csv(),
        ];
        ENDINGS.iter().zip(bytes).map(|(ending, bytes)| (format!("{id}{ending}"), bytes)).collect()
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
