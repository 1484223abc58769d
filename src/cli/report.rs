//! `quadrille report`: (re)make `report.html` from a results folder.

use super::folder_args::{FolderArgs, unfinished};
use super::{CliError, Console};
use quadrille::files::atomic;
use quadrille::files::names::REPORT;
use quadrille::output::load::look;
use quadrille::output::{inputs, report};
use std::process::ExitCode;

/// (Re)make report.html from a results folder.
///
/// The page shows what pareto.csv, history.csv, generations.csv, manifest.json and the files in designs/ say; of a run
/// that goes on or was interrupted, what it had found after its last finished generation. It is one file that needs no
/// network: send it to whom you like.
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    run: FolderArgs,
}

/// Runs the command.
pub fn run(args: Args, console: &Console) -> Result<ExitCode, CliError> {
    let folder = &args.run.folder;
    let wrong = |error: &dyn std::fmt::Display| CliError::Input(error.to_string());
    let loaded = look(folder).map_err(|error| wrong(&error))?;
    if loaded.is_unfinished {
        console.note(&unfinished(folder, &loaded));
    }
    // The page says what the run found, and needs these only to group designs; other commands need them.
    let inputs = inputs::again(&loaded.manifest, &loaded.config, args.run.inputs()?);
    for error in inputs.as_ref().err().into_iter().flatten() {
        console.warn(&error.to_string());
    }
    let data = report::of(folder, loaded, inputs.ok()).map_err(|error| wrong(&error))?;
    let page = report::render(&data).map_err(|error| CliError::Failed(error.to_string()))?;
    let path = folder.join(REPORT);
    atomic::write(&path, page.as_bytes()).map_err(CliError::write(&path))?;
    let pictures = data.front.iter().filter(|design| design.mesh.is_some()).count();
    if pictures < data.front.len() {
        console.warn(&format!("{pictures} of {} designs have a picture on the page", data.front.len()));
    }
    outln!("{}", path.display());
    Ok(ExitCode::SUCCESS)
}
