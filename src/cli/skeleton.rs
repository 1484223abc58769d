//! `quadrille skeleton`: the initial mesh of a config.

use super::config_args::{ConfigArgs, located};
use super::{CliError, Console};
use quadrille::config::ResolvedConfig;
use quadrille::domain::Domain;
use quadrille::io::obj;
use quadrille::mesh::BaseMesh;
use quadrille::study::{self, StudyError};
use quadrille::{skeleton, surface};
use serde_json::json;
use std::process::ExitCode;

/// Print the initial mesh of a config: from the medial axis of its domain, or as the config gives it.
///
/// It is what the empty string stands for, and what every string rewrites. In the picture vertices have their numbers,
/// singular ones their valence (orange: fewer edges than regular, blue: more), corners are white, the marker is green. Where
/// the config asks for symmetric patterns, dashed lines are the seams of the part that strings rewrite.
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    config: ConfigArgs,
    /// What to print.
    #[arg(long, value_enum, default_value_t = Format::Svg)]
    format: Format,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum Format {
    /// A picture of the plan.
    Svg,
    /// A base mesh file: edit it and give it as `topology.initial.file`, or to `decode --base`.
    Json,
    /// Wavefront OBJ.
    Obj,
}

/// Prints the mesh.
pub fn run(args: Args, _console: &Console) -> Result<ExitCode, CliError> {
    let resolved = args.config.load(&[])?;
    let (domain, base) = initial_mesh(&resolved).map_err(|error| located(&resolved, &error))?;
    let file = &args.config.config;
    let name = file.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
    match args.format {
        Format::Svg => {
            let start = study::start(resolved.config(), &domain, &base);
            let start = start.map_err(|error| located(&resolved, &error))?;
            match skeleton::picture::svg(&base, &domain, &name, &start.seams()) {
                Ok(picture) => out!("{picture}"),
                Err(error) => return Err(CliError::Input(format!("{}: {error}", file.display()))),
            }
        }
        Format::Json => outln!("{}", to_json(&base)),
        Format::Obj => out!("{}", obj::write(&name, &base)),
    }
    Ok(ExitCode::SUCCESS)
}

/// The domain and its mesh, which need nothing of the structure and the search.
fn initial_mesh(resolved: &ResolvedConfig) -> Result<(Domain, BaseMesh), StudyError> {
    let (config, inputs) = (resolved.config(), resolved.inputs());
    let surface = surface::build(&config.surface, inputs)?;
    let domain = Domain::resolve_for(&config.domain, &surface, inputs, config.pattern.grain())?;
    let base = skeleton::initial(&config.topology, &domain, inputs)?;
    Ok((domain, base))
}

/// A base mesh file, as docs/reference/files.md §3.1 describes it.
fn to_json(base: &BaseMesh) -> serde_json::Value {
    json!({
        "vertices": base.vertices,
        "faces": base.faces,
        "poles": base.poles.iter().map(|(f, v)| (f.to_string(), *v)).collect::<std::collections::BTreeMap<_, _>>(),
        "marker": base.marker.or_else(|| base.faces.first().map(|f| [f[0], f[1]])),
        "corners": base.corners,
    })
}
