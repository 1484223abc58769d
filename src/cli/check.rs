//! `quadrille check`: is a config right, and what does it mean?

use super::config_args::ConfigArgs;
use super::outlook::outlook;
use super::{CliError, Console};
use quadrille::config;
use std::process::ExitCode;

/// Validate a config and print what it means, with defaults filled in; search nothing.
///
/// Prints what the config means, as comments, and then the config with every default written out: the whole is a
/// config again. Warnings go to stderr. A wrong config ends with exit code 2 and a line for each problem: file, line,
/// key, what was found, what is allowed. Domain, surface and initial mesh are made, so that they are known to be right, and told
/// in figures: extents, areas, target length, corners, and which limits the pattern of the initial mesh keeps.
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    config: ConfigArgs,
}

/// Prints the resolved config.
pub fn run(args: Args, console: &Console) -> Result<ExitCode, CliError> {
    let resolved = args.config.load(&[])?;
    let study = args.config.study(&resolved)?;
    let config = resolved.config();
    for warning in config::warnings(config).into_iter().chain(study.warnings()) {
        console.warn(&warning);
    }
    outln!("# {}: what this config means", args.config.config.display());
    for line in config::describe(config) {
        outln!("# * {line}");
    }
    for line in outlook(&study, config) {
        outln!("# * {line}");
    }
    if study.start.is_folded() {
        let (part, whole) = (&study.start.part.mesh, &study.initial.mesh);
        outln!(
            "# * every pattern is symmetric: strings are decoded on a part of the initial mesh with {} faces and {} edges on seams \
             (the whole has {} faces); supports and loads need no symmetry, the whole structure is analysed",
            part.face_count(),
            study.start.seams().len(),
            whole.face_count()
        );
    }
    let unused = study.unused_symmetries(config);
    if !unused.is_empty() {
        outln!(
            "# * boundary, surface and supports have symmetries that are not used, {}: with them in domain.symmetries, \
             designs that are images of each other are evaluated once",
            unused.join(", ")
        );
    }
    outln!();
    out!("{}", config::to_toml(config));
    Ok(ExitCode::SUCCESS)
}
