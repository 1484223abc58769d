//! `quadrille init`: a commented config to start from.

use super::folder_args::folder_exists;
use super::quote::quote;
use super::{CliError, Console};
use std::fs::File;
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

/// The starter, kept true by a test that loads it.
const STARTER: &str = include_str!("starter.toml");

/// Write a commented starter config, NAME.toml, into the current folder.
///
/// It describes a small dome on a square plan and runs in seconds; change the domain and the surface to your own.
/// An existing file is never overwritten.
#[derive(clap::Args)]
pub struct Args {
    /// Name of the config, without `.toml`.
    #[arg(default_value = "design")]
    name: String,
}

/// Writes the starter.
pub fn run(args: Args, console: &Console) -> Result<ExitCode, CliError> {
    let name = args.name.strip_suffix(".toml").unwrap_or(&args.name);
    if name.is_empty() || name.starts_with('-') || name.ends_with(['/', '\\']) {
        return Err(CliError::Input(format!(
            "found the name \"{}\"; allowed: the name of a file",
            args.name
        )));
    }
    let path = PathBuf::from(format!("{name}.toml"));
    folder_exists(&path).map_err(CliError::Input)?;
    if path.exists() {
        return Err(CliError::Input(format!("{} exists; choose another name", path.display())));
    }
    let write = |path: &PathBuf| File::create_new(path)?.write_all(STARTER.as_bytes());
    write(&path).map_err(CliError::write(&path))?;
    outln!("{}", path.display());
    console
        .note(&format!("next: quadrille check {0}, then quadrille run {0}", quote(&path.to_string_lossy())));
    Ok(ExitCode::SUCCESS)
}
