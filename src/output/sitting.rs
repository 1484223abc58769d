//! One sitting of a run, from its start to its end, as its manifest tells it all the while.

use super::designs::Columns;
use super::folder::{Folder, FolderError};
use super::manifest::{self, Counts, Host, Manifest, Status, timestamp};
use crate::config::{self, ResolvedConfig};
use crate::files::names::MANIFEST;
use crate::search::{Ended, GenerationRow, Outcome};
use std::time::{Duration, Instant, SystemTime};

/// How often the manifest of a running search is brought up to date at most.
const TELL_EVERY: Duration = Duration::from_secs(1);

/// A sitting: when it began, and what was there before.
#[derive(Debug)]
pub struct Sitting {
    manifest: Manifest,
    /// What the sitting before left.
    earlier: Option<Manifest>,
    clock: Instant,
    told: Instant,
    /// Seconds of searching in this sitting, once that is over.
    searched: Option<f64>,
    /// Whether nothing was done in it.
    idle: bool,
}

impl Sitting {
    /// Begins: from now on the folder says that a run is on, of which config, and what is its own.
    ///
    /// # Errors
    /// [`FolderError::Io`].
    pub fn begin(
        folder: &mut Folder,
        resolved: &ResolvedConfig,
        threads: usize,
    ) -> Result<Self, FolderError> {
        let earlier = Manifest::read(folder.path());
        let (config, now) = (resolved.config(), timestamp(SystemTime::now()));
        let manifest = Manifest {
            manifest_version: manifest::VERSION,
            program: manifest::PROGRAM.into(),
            program_version: env!("CARGO_PKG_VERSION").into(),
            name: config.run.name.clone().unwrap_or_default(),
            objectives: Columns::of(&config.objectives).objectives,
            seed: config.run.seed.unwrap_or_default(),
            threads,
            status: Status::Running,
            ended_by: String::new(),
            started: earlier.as_ref().map_or_else(|| now.clone(), |earlier| earlier.started.clone()),
            ended: now,
            counts: earlier.as_ref().map(|earlier| earlier.counts).unwrap_or_default(),
            seconds: earlier.as_ref().map_or(0.0, |earlier| earlier.seconds),
            host: Host::here(),
            config_folder: resolved.folder().display().to_string(),
            config_sha256: config::hash(config),
            input_files: resolved.inputs().hashes(),
            config: config::to_toml(config),
            files: folder.files(),
        };
        let clock = Instant::now();
        let mut sitting = Self { manifest, earlier, clock, told: clock, searched: None, idle: false };
        sitting.save(folder)?;
        Ok(sitting)
    }

    /// Threads that evaluate.
    pub fn threads(&self) -> usize {
        self.manifest.threads
    }

    /// Tells of a finished generation, unless it has just told of another.
    ///
    /// # Errors
    /// [`FolderError::Io`].
    pub fn generation(&mut self, folder: &mut Folder, row: &GenerationRow) -> Result<(), FolderError> {
        self.manifest.counts = Counts {
            generations: row.generation,
            evaluations: row.evaluations,
            structural_evaluations: row.structural,
            feasible: row.feasible,
            front_size: row.front,
            ..self.manifest.counts
        };
        if self.told.elapsed() < TELL_EVERY {
            return Ok(());
        }
        self.told = Instant::now();
        self.save(folder)
    }

    /// The search is over; `worked` tells whether anything was done in this sitting. What is written now is listed before
    /// it is: `names`.
    ///
    /// # Errors
    /// [`FolderError::Io`].
    pub fn searched(
        &mut self,
        folder: &mut Folder,
        outcome: &Outcome,
        worked: bool,
        names: impl IntoIterator<Item = String>,
    ) -> Result<(), FolderError> {
        self.searched = Some(self.clock.elapsed().as_secs_f64());
        let Outcome { generations, breeding, evaluated, front, .. } = outcome;
        self.manifest.counts = Counts::of(generations, breeding, evaluated.len(), front.len());
        self.manifest.ended_by = words(outcome.ended);
        match self.earlier.take() {
            // What is there tells of the sittings in which something was done.
            Some(earlier) if !worked && earlier.status == Status::Finished => {
                self.idle = true;
                self.manifest = Manifest { status: Status::Running, ..earlier };
            }
            Some(earlier) if !worked => self.manifest.threads = earlier.threads,
            _ => {}
        }
        folder.announce(names)?;
        self.save(folder)
    }

    /// The sitting is over, and all its files are written.
    ///
    /// # Errors
    /// [`FolderError::Io`].
    pub fn end(mut self, folder: &mut Folder, status: Status) -> Result<(), FolderError> {
        self.manifest.status = status;
        self.save(folder)
    }

    fn save(&mut self, folder: &mut Folder) -> Result<(), FolderError> {
        let mut manifest = self.manifest.clone();
        if !self.idle {
            manifest.seconds += self.searched.unwrap_or_else(|| self.clock.elapsed().as_secs_f64());
            manifest.ended = timestamp(SystemTime::now());
        }
        manifest.files = folder.files();
        folder.write(MANIFEST, &manifest.to_json())
    }
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
