//! Where `decode` and `distance` take their initial mesh and rules from.

use super::CliError;
use super::config_args::ConfigArgs;
use clap::ValueEnum;
use quadrille::grammar::{Rules, Tokens};
use quadrille::io::text;
use quadrille::mesh::fold::Folded;
use quadrille::mesh::{InitialMesh, base_json};
use std::path::{Path, PathBuf};

/// A config, or a bare mesh.
#[derive(clap::Args)]
#[group(required = true, multiple = false)]
struct Source {
    /// The config whose initial mesh and rules are used.
    #[arg(value_name = "CONFIG.toml")]
    config: Option<PathBuf>,
    /// A bare initial mesh: {"vertices", "faces", "poles", "marker", "corners"}; by plain rules.
    #[arg(long, value_name = "MESH.json")]
    base: Option<PathBuf>,
}

/// Initial mesh and rules.
#[derive(clap::Args)]
pub struct TopologyArgs {
    #[command(flatten)]
    source: Source,
    /// Rules of the grammar; default: those of the config, or plain with --base.
    #[arg(long, value_enum)]
    rules: Option<RulesArg>,
}

#[derive(Clone, Copy, ValueEnum)]
enum RulesArg {
    /// The grammar as it stands.
    Plain,
    /// No rule may add a flat face or put two corners on one vertex.
    Domain,
}

impl TopologyArgs {
    /// Reads the initial mesh, folded where the config asks for symmetric patterns.
    pub fn load(&self) -> Result<(Folded, Rules), CliError> {
        let (initial, default) = match (&self.source.base, &self.source.config) {
            (Some(base), _) => (Folded::whole(read_base(base)?), Rules::Plain),
            (None, Some(config)) => from_config(config)?,
            (None, None) => return Err(CliError::Input("a config or --base is needed".into())),
        };
        let rules = match self.rules {
            None => default,
            Some(RulesArg::Plain) => Rules::Plain,
            Some(RulesArg::Domain) => Rules::Domain,
        };
        Ok((initial, rules))
    }
}

fn read_base(file: &Path) -> Result<InitialMesh, CliError> {
    let wrong = |message: String| CliError::Input(format!("{}: {message}", file.display()));
    let text = text::read(file).map_err(CliError::read(file))?;
    let base = base_json::read(&text).map_err(|error| wrong(error.to_string()))?;
    InitialMesh::from_base(&base).map_err(|error| wrong(error.to_string()))
}

/// A string, or what is wrong with it and where it was given: by which option, or in which line of a file.
pub fn parse_string(place: &str, text: &str) -> Result<Tokens, CliError> {
    text.parse().map_err(|error| CliError::Input(format!("{place} {text:?}: {error}")))
}

/// The initial mesh, folded where it is to be, and the rules of a config.
fn from_config(file: &Path) -> Result<(Folded, Rules), CliError> {
    let args = ConfigArgs { config: file.to_path_buf(), set: Vec::new() };
    let study = args.study(&args.load(&[])?)?;
    Ok((study.start, study.rules))
}
