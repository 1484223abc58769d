//! Arguments that every command with a config has.

use super::CliError;
use quadrille::config::{self, Config};
use quadrille::study::{Study, StudyError};
use std::path::{Path, PathBuf};

/// A config, and keys set for this run.
#[derive(clap::Args)]
pub struct ConfigArgs {
    /// The config.
    #[arg(value_name = "CONFIG.toml")]
    pub config: PathBuf,
    /// Set a key of the config, as in `search.population=24`; may be given several times.
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

impl ConfigArgs {
    /// Loads the config; `more` are further `key=value` pairs, which win.
    pub fn load(&self, more: &[String]) -> Result<Config, CliError> {
        let sets: Vec<String> = self.set.iter().chain(more).cloned().collect();
        Ok(config::load(&self.config, &sets)?)
    }

    /// The folder that paths in the config are relative to.
    pub fn folder(&self) -> &Path {
        config::folder_of(&self.config)
    }

    /// Makes a loaded config ready.
    pub fn study(&self, config: &Config) -> Result<Study, CliError> {
        Study::new(config, self.folder()).map_err(|error| self.located(config, &error))
    }

    /// What is wrong, with the place of the key that says it.
    pub fn located(&self, config: &Config, error: &StudyError) -> CliError {
        let place = config::place_of(&self.config, &self.set, &error.key(config));
        let place = place.map_or_else(|| self.config.display().to_string(), |place| place.to_string());
        CliError::Input(format!("{place}: {error}"))
    }
}
