//! Exit codes, the same for every subcommand.

/// The run failed.
pub const FAILED: u8 = 1;
/// Config, arguments or input files are wrong.
pub const WRONG_INPUT: u8 = 2;

/// What every help page says about them.
pub const HELP: &str = "Exit codes: 0 done; 1 the run failed; 2 the config, arguments or input files are wrong; 3 finished, but no \
feasible design was found; 129 / 130 / 143 interrupted (checkpoint written, resume command printed).\n\n\
Results go to stdout, progress and messages to stderr.";

/// All went well.
pub const DONE: u8 = 0;
/// The run finished, but no feasible design was found.
pub const NOTHING_FEASIBLE: u8 = 3;

/// Ended by a signal, as shells count: 129 for SIGHUP, 130 for SIGINT, 143 for SIGTERM.
pub fn interrupted(signal: i32) -> u8 {
    u8::try_from(128 + signal).unwrap_or(FAILED)
}
