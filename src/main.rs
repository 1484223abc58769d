//! The `quadrille` program: reads the arguments, calls the library, prints the error.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main()
}
