//! The command line: one subcommand a file, each with `Args` and `run`.
//!
//! stdout is for results, stderr for progress and messages. Exit codes are those of [`CliError`] and [`exit`].
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "the binary is what talks to people")]

#[macro_use]
mod stdout;

mod axes;
mod check;
mod compare;
mod completions;
mod config_args;
mod console;
mod decode;
mod deviations;
mod distance;
mod error;
mod evaluate;
mod exit;
mod explain;
mod export;
mod folder_args;
mod frame;
mod help;
mod init;
mod man;
mod neighbours;
mod outlook;
mod progress;
mod quote;
mod report;
mod run;
mod signals;
mod skeleton;
mod topology;
mod verify;
mod watch;
mod writing;

pub use console::{Console, ConsoleArgs};
pub use error::CliError;

use clap::{FromArgMatches, Parser, Subcommand};
use std::process::ExitCode;

/// Finds good topologies for structured surface structures: gridshells, shells, cable nets.
///
/// A design is a short string over a small grammar (tokens T, P, D, A, A*, Ao). The program evolves such strings:
/// each is decoded to a coarse quad mesh, made a dense pattern on a surface, analysed as a frame, measured, and
/// selected by NSGA-II. The result is a Pareto front of designs, as tables, meshes and pictures.
#[derive(Parser)]
#[command(version, about, long_about, max_term_width = 120, propagate_version = true, after_help = exit::HELP)]
struct Cli {
    #[command(flatten)]
    console: ConsoleArgs,
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Run(run::Args),
    Evaluate(evaluate::Args),
    Check(check::Args),
    Axes(axes::Args),
    Init(init::Args),
    Report(report::Args),
    Export(export::Args),
    Explain(explain::Args),
    Verify(verify::Args),
    Neighbours(neighbours::Args),
    Decode(decode::Args),
    Distance(distance::Args),
    Skeleton(skeleton::Args),
    Frame(frame::Args),
    Completions(completions::Args),
    Man(man::Args),
}

/// Runs the program and gives its exit code.
pub fn main() -> ExitCode {
    let parsed = help::command::<Cli>().try_get_matches().and_then(|matches| Cli::from_arg_matches(&matches));
    let Cli { console, command } = match parsed {
        Ok(cli) => cli,
        // Help and version are results too, and not to be lost on a full disk.
        Err(asked) if !asked.use_stderr() => {
            let Err(error) = stdout::written(asked.print()) else { return ExitCode::SUCCESS };
            eprintln!("error: {error}");
            return error.exit_code();
        }
        Err(error) => error.exit(),
    };
    let console = Console::new(&console);
    let result = match command {
        Command::Decode(args) => decode::run(&args),
        Command::Distance(args) => distance::run(&args),
        Command::Run(args) => run::run(args, &console),
        Command::Evaluate(args) => evaluate::run(args, &console),
        Command::Export(args) => export::run(args, &console),
        Command::Explain(args) => explain::run(args, &console),
        Command::Verify(args) => verify::run(args, &console),
        Command::Neighbours(args) => neighbours::run(args, &console),
        Command::Check(args) => check::run(args, &console),
        Command::Axes(args) => axes::run(args, &console),
        Command::Init(args) => init::run(args, &console),
        Command::Frame(args) => frame::run(args, &console),
        Command::Report(args) => report::run(args, &console),
        Command::Skeleton(args) => skeleton::run(args, &console),
        Command::Completions(args) => completions::run::<Cli>(args),
        Command::Man(args) => man::run::<Cli>(args),
    };
    result.unwrap_or_else(|error| {
        console.error(&error.to_string());
        error.exit_code()
    })
}
