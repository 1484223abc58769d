//! Arguments that every command with a config has.

use super::CliError;
use quadrille::config::ResolvedConfig;
use quadrille::study::{Study, StudyError};
use std::path::PathBuf;

/// A config, and keys set for this run.
#[derive(clap::Args)]
pub struct ConfigArgs {
    /// The config; `-` is stdin.
    #[arg(value_name = "CONFIG.toml")]
    pub config: PathBuf,
    /// Set a key of the config, as in `search.population=24`; may be given several times.
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

impl ConfigArgs {
    /// Reads the config and the files that it names; `more` are further `key=value` pairs, which win.
    pub fn load(&self, more: &[String]) -> Result<ResolvedConfig, CliError> {
        let sets: Vec<String> = self.set.iter().chain(more).cloned().collect();
        Ok(ResolvedConfig::open(&self.config, &sets)?)
    }

    /// Makes a config that was read ready.
    pub fn study(&self, resolved: &ResolvedConfig) -> Result<Study, CliError> {
        Study::of(resolved).map_err(|error| located(resolved, &error))
    }
}

/// What is wrong, with the place of the key that says it.
pub fn located(resolved: &ResolvedConfig, error: &StudyError) -> CliError {
    let place = resolved.place(&error.key(resolved.config()));
    CliError::Input(format!("{place}: {error}"))
}
