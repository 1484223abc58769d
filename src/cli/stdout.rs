//! Results on stdout.

use super::{CliError, exit};
use std::fmt::Arguments;
use std::io::{self, ErrorKind, Write};

/// As `print!`, but a reader that went away (`| head`) is no panic, and a full disk is an error.
macro_rules! out {
    ($($text:tt)*) => { $crate::cli::stdout::put(format_args!($($text)*)) };
}

/// As `println!`, likewise.
macro_rules! outln {
    () => { $crate::cli::stdout::put(format_args!("\n")) };
    ($($text:tt)*) => { $crate::cli::stdout::put(format_args!("{}\n", format_args!($($text)*))) };
}

/// What the macros do: results that cannot be written end the program with exit code 1.
pub fn put(text: Arguments<'_>) {
    if let Err(error) = print_result(text.to_string()) {
        let _ = writeln!(io::stderr().lock(), "error: {error}");
        std::process::exit(exit::FAILED.into());
    }
}

/// Prints a result as it is. A reader that went away (`| head`) is no failure.
pub fn print_result(text: impl AsRef<[u8]>) -> Result<(), CliError> {
    written(io::stdout().lock().write_all(text.as_ref()))
}

/// What became of something written to stdout.
pub fn written(result: io::Result<()>) -> Result<(), CliError> {
    match result.and_then(|()| io::stdout().flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(CliError::write("stdout")(error)),
        _ => Ok(()),
    }
}
