//! `quadrille distance`: how far apart two strings are.

use super::CliError;
use super::stdout::print_result;
use super::topology::{TopologyArgs, parse_string};
use clap::ValueEnum;
use quadrille::grammar::{self, Tokens};
use quadrille::mesh::{self, Distance, Equivalence};
use std::process::ExitCode;

/// Topological distance of the phenotypes, Levenshtein and Hamming distance of the strings.
///
/// The topological distance is the smallest number of strips to delete, from either mesh, until both are the same.
/// Meshes are compared with their place on the domain (boundary loops, corners) and without parallel strips.
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    topology: TopologyArgs,
    /// One string.
    #[arg(long, value_name = "STRING", allow_hyphen_values = true)]
    a: String,
    /// The other string.
    #[arg(long, value_name = "STRING", allow_hyphen_values = true)]
    b: String,
    /// Look no further than this: the answer is then "more than N". The work grows fast with it.
    #[arg(long, value_name = "N", default_value_t = 3, allow_negative_numbers = true)]
    max: usize,
    /// Ignore boundary loops and corners: designs that sit differently on the domain are the same.
    #[arg(long)]
    not_placed: bool,
    /// Count parallel strips too.
    #[arg(long)]
    no_reduce: bool,
    /// A mirrored mesh is the same.
    #[arg(long)]
    mirror: bool,
    /// What is printed.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(Clone, Copy, Default, ValueEnum)]
enum Format {
    /// For people.
    #[default]
    Text,
    /// For programs.
    Json,
}

/// The answer, with the keys that other programs rely on.
#[derive(serde::Serialize)]
struct Answer {
    topological: Option<usize>,
    more_than: Option<usize>,
    comparable: bool,
    levenshtein: usize,
    hamming: Option<usize>,
}

/// Prints the distances.
pub fn run(args: &Args) -> Result<ExitCode, CliError> {
    let a = parse_string("--a", &args.a)?;
    let b = parse_string("--b", &args.b)?;
    let (start, rules) = args.topology.load()?;
    let equivalence = Equivalence { placed: !args.not_placed, reduce: !args.no_reduce, mirror: args.mirror };
    let mesh = |tokens: &Tokens| {
        let part = grammar::decode(&start.part, tokens, rules);
        start.unfold(&part.mesh, part.marker).0
    };
    let topological = mesh::distance(&mesh(&a), &mesh(&b), equivalence, args.max);
    let answer = Answer {
        topological: if let Distance::Exactly(d) = topological { Some(d) } else { None },
        more_than: if let Distance::MoreThan(max) = topological { Some(max) } else { None },
        comparable: topological != Distance::Incomparable,
        levenshtein: a.levenshtein(&b),
        hamming: a.hamming(&b),
    };
    let text = match args.format {
        Format::Text => told(&answer),
        Format::Json => {
            serde_json::to_string(&answer).map_err(|error| CliError::Failed(error.to_string()))? + "\n"
        }
    };
    print_result(&text)?;
    Ok(ExitCode::SUCCESS)
}

fn told(answer: &Answer) -> String {
    let topological = match (answer.topological, answer.more_than) {
        (Some(0), _) => "0 (the same design)".into(),
        (Some(d), _) => format!("{d} (strips to delete until both are the same)"),
        (None, Some(max)) => format!("more than {max}"),
        (None, None) => "not comparable (other topology of the surface)".into(),
    };
    let hamming = answer.hamming.map_or("none (the strings differ in length)".into(), |d| d.to_string());
    format!("topological  {topological}\nLevenshtein  {}\nHamming      {hamming}\n", answer.levenshtein)
}
