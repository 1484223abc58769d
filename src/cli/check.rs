//! `quadrille check`: is a config right, and what does it mean?

use super::{CliError, Console};
use quadrille::config;
use std::path::PathBuf;
use std::process::ExitCode;

/// Validate a config and print what it means, with defaults filled in; run nothing.
///
/// Prints what the config means, as comments, and then the config with every default written out: the whole is a
/// config again. Warnings go to stderr. A wrong config ends with exit code 2 and a line for each problem: file, line,
/// key, what was found, what is allowed.
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
pub fn run(args: Args, console: &Console) -> Result<ExitCode, CliError> {
    let config = config::load(&args.config, &args.set)?;
    for warning in config::warnings(&config) {
        console.warn(&warning);
    }
    println!("# {}: what this config means", args.config.display());
    for line in config::describe(&config) {
        println!("# * {line}");
    }
    println!();
    print!("{}", config::to_toml(&config));
    Ok(ExitCode::SUCCESS)
}
