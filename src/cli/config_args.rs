//! Arguments that every command with a config has.

use super::CliError;
use quadrille::config::{self, Config};
use quadrille::study::Study;
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
        Study::new(config, self.folder()).map_err(|error| CliError::Input(self.locate(&error.to_string())))
    }

    /// A message that begins with `[table]`, with the place of that table.
    fn locate(&self, message: &str) -> String {
        let table = message.strip_prefix('[').and_then(|rest| rest.split_once(']'));
        match table.and_then(|(table, _)| config::place_of(&self.config, &self.set, table)) {
            Some(place) => format!("{place}: {message}"),
            None => format!("{}: {message}", self.config.display()),
        }
    }
}
