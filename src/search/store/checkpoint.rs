//! The state after a finished generation, as a file.

use std::fs;
use std::io;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use serde_json::value::RawValue;

use super::super::record::GenerationRow;
use super::super::state::{Member, State};
use super::journal::checksum;

/// Version of the format; another one is not read.
const VERSION: u32 = 2;

/// Why a checkpoint is not used.
#[derive(Debug)]
pub(super) enum Unusable {
    /// A later program wrote it: the version of its format.
    Newer(u32),
    /// It is damaged: how, in words.
    Damaged(String),
}

impl<E: std::error::Error> From<E> for Unusable {
    fn from(error: E) -> Self {
        Self::Damaged(error.to_string())
    }
}

/// The version alone: a later format need not have anything else in common.
#[derive(Deserialize)]
struct Version {
    version: u32,
}

/// The file: a checksum over the exact text of the state.
#[derive(Serialize, Deserialize)]
struct Envelope<'a> {
    version: u32,
    checksum: String,
    #[serde(borrow)]
    state: &'a RawValue,
}

/// What a checkpoint holds; the evaluations themselves are in the journal.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub(super) struct Checkpoint {
    /// The program that wrote it.
    program: String,
    /// The config as resolved, seed included.
    pub(super) config: Value,
    /// Designs evaluated in all finished generations.
    pub(super) evaluations: u64,
    /// The populations of all islands.
    pub(super) islands: Vec<Vec<Member>>,
    pub(super) generations: Vec<GenerationRow>,
}

impl Checkpoint {
    pub(super) fn of(state: &State, config: &Value) -> Self {
        Self {
            program: env!("CARGO_PKG_VERSION").to_owned(),
            config: config.clone(),
            evaluations: state.rows.len() as u64,
            islands: state.islands.clone(),
            generations: state.generations.clone(),
        }
    }

    /// Number of finished generations.
    pub(super) fn finished(&self) -> u32 {
        self.generations.len() as u32
    }

    pub(super) fn to_bytes(&self) -> serde_json::Result<Vec<u8>> {
        let state = serde_json::value::to_raw_value(self)?;
        let checksum = checksum(state.get().as_bytes());
        let mut bytes = serde_json::to_vec(&Envelope { version: VERSION, checksum, state: &state })?;
        bytes.push(b'\n');
        Ok(bytes)
    }

    fn parse(text: &str) -> Result<Self, Unusable> {
        let damaged = |how: &str| Err(Unusable::Damaged(how.to_owned()));
        match serde_json::from_str(text)? {
            Version { version } if version > VERSION => return Err(Unusable::Newer(version)),
            Version { version } if version < VERSION => return damaged("its format is no longer read"),
            Version { .. } => {}
        }
        let envelope: Envelope<'_> = serde_json::from_str(text)?;
        if envelope.checksum != checksum(envelope.state.get().as_bytes()) {
            return damaged("its checksum is wrong");
        }
        let checkpoint: Self = serde_json::from_str(envelope.state.get())?;
        if checkpoint.islands.iter().flatten().any(|m| u64::from(m.row) >= checkpoint.evaluations) {
            return damaged("its population has no values");
        }
        Ok(checkpoint)
    }
}

/// Reads a checkpoint; `None` if there is no such file, an error if it cannot be used.
pub(super) fn read(path: &Path) -> Result<Option<Checkpoint>, Unusable> {
    match fs::read(path) {
        Ok(bytes) => Checkpoint::parse(std::str::from_utf8(&bytes)?).map(Some),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error.into()),
    }
}
