//! `quadrille decode`: what a string means.

use super::CliError;
use super::stdout::print_result;
use super::topology::{TopologyArgs, parse_string};
use clap::ValueEnum;
use quadrille::grammar::{self, Decoded};
use quadrille::output::coarse::{self, Reading};
use std::process::ExitCode;

/// Decode a string to its coarse mesh: trace, strips, singularities, mesh.
///
/// Every string has a meaning: a rule that cannot be applied is skipped, and the trace says why. What the JSON says
/// of the mesh loads again with --base. Where the config asks for symmetric patterns, strings are decoded on a part of
/// the initial mesh: trace and marker are told of the part, and part and whole mesh are shown.
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    topology: TopologyArgs,
    /// The string: tokens T, P, D, A, A*, Ao; may be empty.
    #[arg(long, value_name = "STRING", allow_hyphen_values = true)]
    string: String,
    /// What is printed.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(Clone, Copy, Default, ValueEnum)]
enum Format {
    /// For people: the trace, singular vertices, strips.
    #[default]
    Text,
    /// For programs: everything.
    Json,
    /// The coarse mesh.
    Obj,
    /// A picture: strips coloured, singular vertices with their valence, the marker as an arrow.
    Svg,
}

/// Prints the decoded string.
pub fn run(args: &Args) -> Result<ExitCode, CliError> {
    let string = parse_string("--string", &args.string)?;
    let (start, rules) = args.topology.load()?;
    let part = grammar::decode(&start.part, &string, rules);
    let (mesh, marker) = start.unfold(&part.mesh, part.marker);
    let decoded = Decoded { mesh, marker, ..part.clone() };
    let reading = Reading { string: &string, decoded: &decoded, part: start.is_folded().then_some(&part) };
    let text = match args.format {
        Format::Text => coarse::text(reading),
        Format::Json => coarse::json(reading).map_err(|error| CliError::Failed(error.to_string()))? + "\n",
        Format::Obj => coarse::obj(reading),
        Format::Svg => coarse::svg(reading),
    };
    print_result(&text)?;
    Ok(ExitCode::SUCCESS)
}
