//! `quadrille skeleton`: the initial mesh of a config.

use super::{CliError, Console};
use quadrille::config;
use quadrille::domain::Domain;
use quadrille::io::obj;
use quadrille::mesh::BaseMesh;
use quadrille::{skeleton, surface};
use serde_json::json;
use std::path::PathBuf;
use std::process::ExitCode;

/// Print the initial mesh of a config: from the medial axis of its domain, or as the config gives it.
///
/// It is what the empty string stands for, and what every string rewrites. In the picture vertices have their numbers,
/// singular ones their valence (orange: fewer edges than regular, blue: more), corners are white, the marker is green.
#[derive(clap::Args)]
pub struct Args {
    /// The config.
    #[arg(value_name = "CONFIG.toml")]
    config: PathBuf,
    /// Set a key of the config, as in `surface.kind="plane"`; may be given several times.
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
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
    let config = config::load(&args.config, &args.set)?;
    let folder = config::folder_of(&args.config);
    let wrong =
        |error: &dyn std::error::Error| CliError::Input(format!("{}: {error}", args.config.display()));
    let surface = surface::build(&config.surface, folder).map_err(|e| wrong(&e))?;
    let domain = Domain::resolve(&config.domain, &surface, folder).map_err(|e| wrong(&e))?;
    let base = skeleton::initial(&config.topology, &domain, folder).map_err(|e| wrong(&e))?;
    let name = args.config.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
    match args.format {
        Format::Svg => out!("{}", skeleton::picture::svg(&base, &domain, &name).map_err(|e| wrong(&e))?),
        Format::Json => outln!("{}", to_json(&base)),
        Format::Obj => out!("{}", obj::write(&name, &base)),
    }
    Ok(ExitCode::SUCCESS)
}

/// A base mesh file, as RUN describes it.
fn to_json(base: &BaseMesh) -> serde_json::Value {
    json!({
        "vertices": base.vertices,
        "faces": base.faces,
        "poles": base.poles.iter().map(|(f, v)| (f.to_string(), *v)).collect::<std::collections::BTreeMap<_, _>>(),
        "marker": base.marker.or_else(|| base.faces.first().map(|f| [f[0], f[1]])),
        "corners": base.corners,
    })
}
