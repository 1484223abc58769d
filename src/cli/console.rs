//! What goes to stderr, and how much of it.

use clap::{ArgAction, Args, ValueEnum};
use std::ffi::OsStr;
use std::io::{self, IsTerminal, Write};

/// Options that every subcommand has.
#[derive(Args)]
#[command(next_help_heading = "Messages")]
pub struct ConsoleArgs {
    /// Say nothing on stderr but errors.
    #[arg(long, short, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Say more on stderr; twice: also what came of every design, as it comes.
    #[arg(short, long, global = true, action = ArgAction::Count)]
    verbose: u8,
    /// How progress is shown on stderr.
    #[arg(long, global = true, value_enum, default_value_t, value_name = "HOW")]
    progress: Progress,
}

/// How progress is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Progress {
    /// A bar where stderr is a terminal that can redraw (TERM is not `dumb`, NO_COLOR not set), else plain.
    #[default]
    Auto,
    /// A bar that redraws itself; plain where stderr cannot.
    Bar,
    /// One line a generation.
    Plain,
    /// Nothing.
    None,
}

/// Stderr, with the user's wishes resolved.
#[derive(Clone, Copy, Debug)]
pub struct Console {
    verbosity: u8,
    quiet: bool,
    progress: Progress,
}

impl Console {
    /// Resolves `auto` and `--quiet`.
    pub fn new(args: &ConsoleArgs) -> Self {
        let progress = match args.progress {
            Progress::Auto if args.quiet => Progress::None,
            Progress::Auto | Progress::Bar if can_redraw() => Progress::Bar,
            Progress::Auto | Progress::Bar => Progress::Plain,
            chosen => chosen,
        };
        Self { verbosity: args.verbose, quiet: args.quiet, progress }
    }

    /// A message, unless `--quiet`.
    pub fn note(&self, message: &str) {
        if !self.quiet {
            line(message);
        }
    }

    /// A message, even with `--quiet`: what the user must know to go on.
    pub fn always(&self, message: &str) {
        line(message);
    }

    /// A message for `-v`.
    pub fn detail(&self, message: &str) {
        if self.verbosity > 0 {
            line(message);
        }
    }

    /// Whether every design is worth a message: `-vv`.
    pub fn tells_designs(&self) -> bool {
        self.verbosity > 1
    }

    /// A warning, unless `--quiet`.
    pub fn warn(&self, message: &str) {
        self.note(&format!("warning: {message}"));
    }

    /// An error, always; one line for each thing that is wrong.
    pub fn error(&self, message: &str) {
        for part in message.lines() {
            line(&format!("error: {part}"));
        }
    }

    /// How progress is to be shown; never `Auto`.
    pub fn progress(&self) -> Progress {
        self.progress
    }
}

/// Whether stderr is a terminal that understands escape codes, and may be sent some.
fn can_redraw() -> bool {
    let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
    io::stderr().is_terminal() && understands(set("TERM").as_deref()) && set("NO_COLOR").is_none()
}

/// Whether the terminal that TERM names understands escape codes; on Windows it has no name.
fn understands(term: Option<&OsStr>) -> bool {
    term.map_or(cfg!(windows), |term| term != "dumb")
}

/// One line on stderr. A reader that went away is no reason to fail.
fn line(message: &str) {
    let _ = writeln!(io::stderr().lock(), "{message}");
}
