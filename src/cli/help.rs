//! The commands as clap knows them, with what every help page ends with: examples and exit codes.

use super::exit;
use clap::{Command, CommandFactory};

/// Examples of each command.
const EXAMPLES: &[(&str, &[&str])] = &[
    (
        "run",
        &[
            "quadrille run roof.toml",
            "quadrille run roof.toml --out results/second --seed 2 --generations 50",
            "quadrille run roof.toml --resume",
            "quadrille run roof.toml --set pattern.panels=800 --set structure.order=1",
        ],
    ),
    (
        "evaluate",
        &[
            "quadrille evaluate roof.toml --string ATTA --string ATPTA",
            "quadrille evaluate roof.toml --strings mine.csv --out compared",
        ],
    ),
    ("check", &["quadrille check roof.toml", "quadrille check roof.toml --set search.population=96"]),
    ("axes", &["quadrille axes roof.toml --designs 300"]),
    ("init", &["quadrille init roof"]),
    ("report", &["quadrille report results/roof"]),
    (
        "export",
        &[
            "quadrille export results/roof --design q3f2a --format vtu --out exported",
            "quadrille export results/roof --design q3f2a --format obj --pattern dual",
            "quadrille export results/roof --design q3f2a --format json --inputs old/data",
        ],
    ),
    ("explain", &["quadrille explain results/roof q3f2a"]),
    ("verify", &["quadrille verify results/roof", "quadrille verify results/roof --design q3f2a"]),
    ("neighbours", &["quadrille neighbours roof.toml --string ATTA --out neighbours.csv"]),
    (
        "decode",
        &[
            "quadrille decode roof.toml --string ATTPAD",
            "quadrille decode --base mesh.json --string ATTA --format json",
        ],
    ),
    ("distance", &["quadrille distance roof.toml --a ATTA --b ATPTA"]),
    (
        "skeleton",
        &["quadrille skeleton roof.toml --format svg", "quadrille skeleton roof.toml --format json"],
    ),
    ("frame", &["quadrille frame model.json --format json"]),
    ("completions", &["quadrille completions bash"]),
    ("man", &["quadrille man --out /usr/local/share/man/man1"]),
];

/// What a string is, for the commands that take one.
const TOKENS: &str = "Strings move a marker, which lies on an edge: T goes along the edge and turns left, P rotates it clockwise about the \
vertex it starts from. Between two A the path it goes is collected, and a strip is added along it (A*: one that may end in \
poles; Ao: a closed one). D deletes the strip of the marker's edge. What cannot be done is skipped. `quadrille decode` \
tells what a string does, token by token.\n\n";

/// The whole command.
pub fn command<C: CommandFactory>() -> Command {
    C::command().mut_subcommands(|command| {
        let end = ending(command.get_name());
        command.after_long_help(end)
    })
}

fn examples(name: &str) -> &'static [&'static str] {
    EXAMPLES.iter().find(|(of, _)| *of == name).map_or(&[], |(_, lines)| lines)
}

fn ending(name: &str) -> String {
    let lines: String = examples(name).iter().map(|line| format!("  {line}\n")).collect();
    let tokens = if lines.contains("--string") || name == "distance" { TOKENS } else { "" };
    format!("Examples:\n{lines}\n{tokens}{}", exit::HELP)
}

#[cfg(test)]
mod tests {
    use super::super::Cli;
    use super::*;
    use clap::Parser;

    #[test]
    fn every_command_has_examples_that_are_accepted() {
        let command = command::<Cli>();
        command.clone().debug_assert();
        for subcommand in command.get_subcommands() {
            let lines = examples(subcommand.get_name());
            assert!(!lines.is_empty(), "{}", subcommand.get_name());
            for line in lines {
                Cli::try_parse_from(line.split(' ')).map(|_| ()).unwrap();
            }
        }
    }
}
