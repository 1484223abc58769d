//! `quadrille man`: the manual pages.

use super::folder_args::refuse_file;
use super::stdout::print_result;
use super::{CliError, help};
use clap::CommandFactory;
use quadrille::files::atomic;
use std::path::PathBuf;
use std::process::ExitCode;

/// Print the manual page, or write one page for each command.
///
/// They say what --help says. `quadrille man | man -l -` shows the page; `quadrille man --out
/// ~/.local/share/man/man1` makes `man quadrille` and `man quadrille-run` work.
#[derive(clap::Args)]
pub struct Args {
    /// Write quadrille.1, quadrille-run.1 and so on into this folder.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Prints or writes.
pub fn run<C: CommandFactory>(args: Args) -> Result<ExitCode, CliError> {
    let mut command = help::command::<C>();
    // Names of subcommands with that of the program, as in `quadrille-run`.
    command.build();
    let Some(folder) = args.out else {
        print_result(page(command)?)?;
        return Ok(ExitCode::SUCCESS);
    };
    refuse_file(&folder)?;
    std::fs::create_dir_all(&folder).map_err(CliError::write(&folder))?;
    let subcommands: Vec<_> = command.get_subcommands().filter(|c| c.get_name() != "help").cloned().collect();
    for command in [command].into_iter().chain(subcommands) {
        let name = command.get_display_name().unwrap_or_else(|| command.get_name()).to_owned();
        let path = folder.join(format!("{name}.1"));
        atomic::write_named(&path, &page(command)?).map_err(CliError::write(&path))?;
        outln!("{}", path.display());
    }
    Ok(ExitCode::SUCCESS)
}

fn page(command: clap::Command) -> Result<Vec<u8>, CliError> {
    let mut page = Vec::new();
    clap_mangen::Man::new(command).render(&mut page).map_err(CliError::write("manual page"))?;
    Ok(page)
}
