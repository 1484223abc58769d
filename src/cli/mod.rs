//! The command line: one subcommand a file.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "the binary is what talks to people")]

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Finds good topologies for structured surface structures: gridshells, shells, cable nets.
#[derive(Parser)]
#[command(version, about, max_term_width = 120)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {}

/// Runs the program and gives its exit code.
pub fn main() -> ExitCode {
    match Cli::parse().command {}
}
