//! `manifest.json`: what was run, with what, where and when. The one file that holds times.

use crate::files::names::MANIFEST;
use crate::search::{Breeding, GenerationRow};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

/// Version of the manifest's own layout.
pub const VERSION: u32 = 1;
/// The program that writes it.
pub const PROGRAM: &str = env!("CARGO_PKG_NAME");

/// SHA-256 of what was written, by name relative to the folder, with `/`; none of a file that goes on changing (journal,
/// checkpoints, report) or was just being written.
pub type Files = BTreeMap<String, Option<String>>;

/// Why a manifest cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum ManifestError {
    /// A later program wrote it.
    #[error(
        "written by quadrille {program} with manifest_version {found}; this is quadrille {}, which reads up to \
         {VERSION}: take that version of the program, or a later one",
        env!("CARGO_PKG_VERSION")
    )]
    Newer {
        /// The version of the layout.
        found: u64,
        /// The version of the program, as it says.
        program: String,
    },
    /// Other programs have a `manifest.json` too.
    #[error("it is not the manifest of a run")]
    Foreign,
    /// It is not what the program writes.
    #[error(
        "not as the program writes it ({0}): `quadrille run CONFIG --resume` makes it anew where the journal is left"
    )]
    Format(#[from] serde_json::Error),
}

/// The manifest of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Version of this layout.
    pub manifest_version: u32,
    /// `quadrille`.
    pub program: String,
    /// Version of the program that wrote the results.
    pub program_version: String,
    /// Name of the run.
    pub name: String,
    /// Names of the objectives as in the header of the CSV files.
    pub objectives: Vec<String>,
    /// The seed of all chance.
    pub seed: u64,
    /// Threads that evaluated, in the last sitting.
    pub threads: usize,
    /// How the run ended.
    pub status: Status,
    /// Why it ended, in words.
    pub ended_by: String,
    /// Start of the first sitting, UTC.
    pub started: String,
    /// End of the last sitting, UTC.
    pub ended: String,
    /// Counts of the whole run.
    pub counts: Counts,
    /// Seconds of searching, added up over all sittings; of one that was killed, up to its last finished generation.
    pub seconds: f64,
    /// The machine.
    pub host: Host,
    /// The config as resolved, as TOML.
    pub config: String,
    /// Folder to which the paths in it are relative, from the root and without `..`.
    pub config_folder: String,
    /// SHA-256 of `config`.
    pub config_sha256: String,
    /// SHA-256 of every file that the config names, as it was when the run began.
    pub input_files: BTreeMap<String, String>,
    /// Every file that the run has written here: the only ones that it replaces or removes.
    #[serde(default)]
    pub files: Files,
}

/// How a run ended, if it did.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// Not at all so far: it goes on, or it was killed.
    Running,
    /// By its own limits.
    Finished,
    /// By a signal; it can be resumed.
    Interrupted,
}

/// Counts of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// Generations finished, the first population being generation 0.
    pub generations: u32,
    /// Designs evaluated.
    pub evaluations: u64,
    /// Of these, those whose structure was analysed.
    pub structural_evaluations: u64,
    /// Of these, the feasible ones.
    pub feasible: u64,
    /// Size of the front.
    pub front_size: u64,
    /// Strings bred, refused ones included.
    pub bred: u64,
    /// Children refused because an equal design was known.
    pub duplicates_refused: u64,
    /// Children refused because a near design was known.
    pub neighbours_refused: u64,
}

impl Counts {
    /// Counts after these generations.
    pub fn of(generations: &[GenerationRow], breeding: &Breeding, evaluated: usize, front: usize) -> Self {
        let last = generations.last();
        Self {
            generations: last.map_or(0, |row| row.generation),
            evaluations: evaluated as u64,
            structural_evaluations: last.map_or(0, |row| row.structural),
            feasible: last.map_or(0, |row| row.feasible),
            front_size: front as u64,
            bred: breeding.bred,
            duplicates_refused: breeding.duplicates,
            neighbours_refused: breeding.neighbours,
        }
    }
}

/// The machine.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Host {
    /// Operating system.
    pub os: String,
    /// Processor architecture.
    pub architecture: String,
    /// Number of processors.
    pub processors: usize,
}

impl Host {
    /// This machine.
    pub fn here() -> Self {
        Self {
            os: std::env::consts::OS.into(),
            architecture: std::env::consts::ARCH.into(),
            processors: std::thread::available_parallelism().map_or(1, usize::from),
        }
    }
}

impl Manifest {
    /// The manifest of a results folder, if it has one that can be read.
    pub fn read(folder: &Path) -> Option<Self> {
        Self::parse(&std::fs::read(folder.join(MANIFEST)).ok()?).ok()
    }

    /// The manifest in a file.
    ///
    /// # Errors
    /// [`ManifestError`]; the version is looked at first, since nothing else need be there in a later one.
    pub fn parse(bytes: &[u8]) -> Result<Self, ManifestError> {
        let manifest: serde_json::Value = serde_json::from_slice(bytes)?;
        if manifest["program"] != PROGRAM {
            return Err(ManifestError::Foreign);
        }
        match manifest["manifest_version"].as_u64() {
            Some(found) if found > u64::from(VERSION) => {
                let program = manifest["program_version"].as_str().unwrap_or("of a later version").to_owned();
                Err(ManifestError::Newer { found, program })
            }
            // Read from the bytes once more: errors then tell line and column.
            _ => Ok(serde_json::from_slice(bytes)?),
        }
    }

    /// The file.
    pub fn to_json(&self) -> Vec<u8> {
        // Plain strings and numbers: nothing here can fail to be written.
        let mut bytes = serde_json::to_vec_pretty(self).unwrap_or_default();
        bytes.push(b'\n');
        bytes
    }
}

/// A time as RFC 3339 in UTC, to the second.
pub fn timestamp(time: SystemTime) -> String {
    let seconds = time.duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    let (year, month, day) = civil(seconds / 86_400);
    let of_day = seconds % 86_400;
    format!("{year:04}-{month:02}-{day:02}T{:02}:{:02}:{:02}Z", of_day / 3600, of_day / 60 % 60, of_day % 60)
}

/// Days since 1970-01-01 as year, month, day of the Gregorian calendar (Hinnant, *chrono-compatible low-level date
/// algorithms*, `civil_from_days`; here for days ≥ 0).
fn civil(days: u64) -> (u64, u64, u64) {
    let z = days + 719_468;
    let (era, day_of_era) = (z / 146_097, z % 146_097);
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let shifted = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * shifted + 2) / 5 + 1;
    let month = if shifted < 10 { shifted + 3 } else { shifted - 9 };
    (era * 400 + year_of_era + u64::from(month <= 2), month, day)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    impl Manifest {
        pub(crate) fn sample(status: Status) -> Self {
            Self {
                manifest_version: VERSION,
                program: "quadrille".into(),
                program_version: "0.1.0".into(),
                name: "sample".into(),
                objectives: vec!["mass_kg".into()],
                seed: 1,
                threads: 2,
                status,
                ended_by: "25 generations".into(),
                started: timestamp(UNIX_EPOCH),
                ended: timestamp(UNIX_EPOCH),
                counts: Counts::default(),
                seconds: 1.5,
                host: Host::here(),
                config: String::new(),
                config_folder: ".".into(),
                config_sha256: String::new(),
                input_files: BTreeMap::new(),
                files: Files::new(),
            }
        }
    }

    #[test]
    fn reads_what_it_writes() {
        let manifest = Manifest::sample(Status::Finished);
        assert_eq!(serde_json::from_slice::<Manifest>(&manifest.to_json()).unwrap(), manifest);
    }

    #[test]
    fn a_later_version_is_told_whatever_else_it_holds() {
        let later = br#"{"program": "quadrille", "manifest_version": 7, "program_version": "3.1.0"}"#;
        let told = Manifest::parse(later).unwrap_err().to_string();
        assert!(told.contains("quadrille 3.1.0 with manifest_version 7"), "{told}");
        let broken = Manifest::parse(br#"{"program": "quadrille", "manifest_version": 1}"#).unwrap_err();
        assert!(matches!(broken, ManifestError::Format(_)), "{broken}");
        // As browser extensions have it.
        let foreign = Manifest::parse(br#"{"manifest_version": 3, "name": "mine"}"#).unwrap_err();
        assert!(matches!(foreign, ManifestError::Foreign), "{foreign}");
    }

    #[test]
    fn timestamps() {
        for (seconds, text) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (1_795_357_245, "2026-11-22T14:20:45Z"),
        ] {
            assert_eq!(timestamp(UNIX_EPOCH + Duration::from_secs(seconds)), text);
        }
    }
}
