//! `quadrille completions`: a completion script for a shell.

use super::CliError;
use super::stdout::print_result;
use clap::CommandFactory;
use clap_complete::Shell;
use std::process::ExitCode;

/// Print a completion script for a shell.
///
/// bash: `quadrille completions bash > ~/.local/share/bash-completion/completions/quadrille`;
/// zsh: put it as `_quadrille` into a folder of `$fpath`; fish: `~/.config/fish/completions/quadrille.fish`.
#[derive(clap::Args)]
#[command(verbatim_doc_comment)]
pub struct Args {
    /// The shell.
    shell: Shell,
}

/// Writes the script to stdout.
pub fn run<C: CommandFactory>(args: Args) -> Result<ExitCode, CliError> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut C::command(), "quadrille", &mut script);
    print_result(script)?;
    Ok(ExitCode::SUCCESS)
}
