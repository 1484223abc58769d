//! `quadrille report`: (re)make `report.html` from a results folder.

use super::{CliError, Console};
use quadrille::output::folder::REPORT;
use quadrille::output::{atomic, report};
use std::path::PathBuf;
use std::process::ExitCode;

/// (Re)make report.html from a results folder.
///
/// The page shows what pareto.csv, history.csv, generations.csv, manifest.json and the files in designs/ say. It is one
/// file that needs no network: send it to whom you like.
#[derive(clap::Args)]
pub struct Args {
    /// The results folder of a run.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

/// Runs the command.
pub fn run(args: Args, console: &Console) -> Result<ExitCode, CliError> {
    let data = report::read(&args.folder).map_err(|error| CliError::Input(error.to_string()))?;
    let page = report::render(&data).map_err(|error| CliError::Failed(error.to_string()))?;
    let path = args.folder.join(REPORT);
    atomic::write(&path, page.as_bytes()).map_err(CliError::write(&path))?;
    let pictures = data.front.iter().filter(|design| design.mesh.is_some()).count();
    if pictures < data.front.len() {
        console.warn(&format!("{pictures} of {} designs have a picture on the page", data.front.len()));
    }
    outln!("{}", path.display());
    Ok(ExitCode::SUCCESS)
}
