//! `quadrille check`: is a config right, and what does it mean?

use super::{CliError, Console};
use quadrille::config;
use std::path::PathBuf;
use std::process::ExitCode;

/// Validate a config and print what it means, with defaults filled in; run nothing.
///
/// Prints the resolved config as TOML, every default written out. Wrong configs end with exit code 2 and a line for
/// each problem: file, line, key, what was found, what is allowed.
#[derive(clap::Args)]
pub struct Args {
    /// The config.
    #[arg(value_name = "CONFIG.toml")]
    config: PathBuf,
    /// Set a key of the config, as in `search.population=24`; may be given several times.
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
}

/// Prints the resolved config.
pub fn run(args: Args, _console: &Console) -> Result<ExitCode, CliError> {
    let config = config::load(&args.config, &args.set)?;
    print!("{}", config::to_toml(&config));
    Ok(ExitCode::SUCCESS)
}
