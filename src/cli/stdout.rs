//! Results on stdout.

use super::CliError;
use std::io::{self, ErrorKind, Write};

/// Prints a result as it is. A reader that went away (`| head`) is no failure.
pub fn print_result(text: &str) -> Result<(), CliError> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(CliError::write("stdout")(error)),
        _ => Ok(()),
    }
}
