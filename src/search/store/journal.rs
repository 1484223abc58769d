//! The journal of evaluations: only ever appended to, every line with its own checksum.

use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest, Sha256};

use super::entry::Entry;
use super::error::StoreError;

/// Version of the format; the lines of another one are not read.
const VERSION: u32 = 1;

/// The longest an evaluation stays off the disk.
const SYNC_EVERY: Duration = Duration::from_millis(250);

/// The first line.
#[derive(Serialize, Deserialize)]
struct Header {
    journal: u32,
    config: Value,
}

/// The version alone: a later format need not have anything else in common.
#[derive(Deserialize)]
struct Version {
    journal: u32,
}

/// The open journal.
#[derive(Debug)]
pub(super) struct Journal {
    path: PathBuf,
    file: File,
    synced: Instant,
}

/// What an earlier sitting left in a journal.
#[derive(Debug, Default)]
pub(super) struct Left {
    pub(super) config: Option<Value>,
    pub(super) entries: Vec<Entry>,
    /// The version of the format, where a later program wrote it.
    pub(super) newer: Option<u32>,
    /// Lines that cannot be read.
    pub(super) damaged: usize,
    /// Bytes up to the end of the last whole line.
    whole: u64,
}

impl Journal {
    pub(super) fn create(path: &Path, config: &Value) -> Result<Self, StoreError> {
        let file = File::create(path).map_err(|error| StoreError::io(path, error))?;
        let mut journal = Self { path: path.to_path_buf(), file, synced: Instant::now() };
        journal.write(&Header { journal: VERSION, config: config.clone() })?;
        Ok(journal)
    }

    /// Opens a journal to go on after what was `left`; what stands after its last whole line is cut off.
    pub(super) fn resume(path: &Path, config: &Value, left: &Left) -> Result<Self, StoreError> {
        if left.config.is_none() && left.entries.is_empty() {
            return Self::create(path, config);
        }
        let open = || {
            let mut file = OpenOptions::new().write(true).open(path)?;
            file.set_len(left.whole)?;
            file.seek(SeekFrom::End(0))?;
            Ok(file)
        };
        let file = open().map_err(|error| StoreError::io(path, error))?;
        Ok(Self { path: path.to_path_buf(), file, synced: Instant::now() })
    }

    pub(super) fn append(&mut self, entry: &Entry) -> Result<(), StoreError> {
        self.write(entry)?;
        if self.synced.elapsed() >= SYNC_EVERY { self.sync() } else { Ok(()) }
    }

    pub(super) fn sync(&mut self) -> Result<(), StoreError> {
        self.synced = Instant::now();
        self.file.sync_data().map_err(|error| StoreError::io(&self.path, error))
    }

    /// One line in one call, so that a kill tears at most this one.
    fn write(&mut self, line: &impl Serialize) -> Result<(), StoreError> {
        let write = || -> io::Result<()> {
            let json = serde_json::to_string(line)?;
            let line = format!("{} {json}\n", checksum(json.as_bytes()));
            (&self.file).write_all(line.as_bytes())
        };
        write().map_err(|error| StoreError::io(&self.path, error))
    }
}

/// Reads what can be read of a journal; nothing if there is none.
pub(super) fn read(path: &Path) -> Result<Left, StoreError> {
    let mut left = Left::default();
    let file = match File::open(path) {
        Ok(file) => file,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(left),
        Err(error) => return Err(StoreError::io(path, error)),
    };
    let mut reader = BufReader::new(file);
    let mut line = Vec::new();
    while reader.read_until(b'\n', &mut line).map_err(|error| StoreError::io(path, error))? > 0 {
        left.take(&line);
        line.clear();
    }
    Ok(left)
}

impl Left {
    fn take(&mut self, line: &[u8]) {
        let Some(whole) = line.strip_suffix(b"\n") else {
            // The last line, torn by a kill or a full disk: not worth a word.
            return;
        };
        let first = self.whole == 0;
        self.whole += line.len() as u64;
        let Some(json) = verified(whole) else {
            self.damaged += 1;
            return;
        };
        if first {
            let version = serde_json::from_str(json).map(|Version { journal }| journal);
            self.newer = version.ok().filter(|&version| version > VERSION);
            let header = serde_json::from_str::<Header>(json).ok().filter(|h| h.journal == VERSION);
            self.config = header.map(|header| header.config);
        } else if let Ok(entry) = serde_json::from_str(json) {
            self.entries.push(entry);
        } else {
            self.damaged += 1;
        }
    }
}

/// The JSON of a line whose checksum is right.
fn verified(line: &[u8]) -> Option<&str> {
    let (sum, json) = std::str::from_utf8(line).ok()?.split_once(' ')?;
    (sum == checksum(json.as_bytes())).then_some(json)
}

/// The first 64 bits of the SHA-256, in hex.
pub(super) fn checksum(bytes: &[u8]) -> String {
    let digest = Sha256::digest(bytes);
    digest.iter().take(8).map(|byte| format!("{byte:02x}")).collect()
}
