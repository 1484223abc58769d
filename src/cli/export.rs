//! `quadrille export`: a design again, in another format.

use super::folder_args::{FolderArgs, find, refuse_file};
use super::stdout::print_result;
use super::{CliError, Console};
use clap::ValueEnum;
use quadrille::files::atomic;
use quadrille::geometry::Pattern;
use quadrille::geometry::conway::{PolyMesh, ambo, dual, join};
use quadrille::output::compas::compas;
use quadrille::output::designs::id;
use quadrille::output::obj::obj;
use quadrille::output::polygons::Polygons;
use quadrille::output::results::{DesignFiles, Developed};
use quadrille::output::svg;
use quadrille::output::vtu::{Grid, vtu};
use quadrille::structure::gridshell::Proof;
use std::path::PathBuf;
use std::process::ExitCode;

/// Export a design of a results folder: mesh, picture, or structural results.
///
/// The design is made again from its string. One file goes to stdout unless --out is given; vtu (panels, members) and
/// csv (nodes, members) are two files each and need --out.
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    run: FolderArgs,
    /// The design: its id, or the beginning of it.
    #[arg(long, value_name = "ID")]
    design: String,
    /// What to write.
    #[arg(long, value_enum)]
    format: Format,
    /// A Conway operator on the pattern first (meshes and pictures only).
    #[arg(long, value_enum)]
    pattern: Option<Operator>,
    /// Write into this folder, as ID.obj and so on.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Wavefront OBJ, metres, z up.
    Obj,
    /// COMPAS 2 JSON.
    Json,
    /// VTK unstructured grids with results: panels and members.
    Vtu,
    /// The plan as a picture.
    Svg,
    /// Tables of nodes and members with results.
    Csv,
}

#[derive(Clone, Copy, ValueEnum)]
enum Operator {
    /// A vertex for each panel.
    Dual,
    /// Panels and vertices joined: a quad for each edge.
    Join,
    /// A vertex for each edge.
    Ambo,
}

/// Makes the design and writes it.
pub fn run(args: Args, console: &Console) -> Result<ExitCode, CliError> {
    args.out.as_deref().map_or(Ok(()), refuse_file)?;
    let (loaded, study) = args.run.look(console)?;
    let row = find(&loaded, &args.design)?;
    let id = id(row.code);
    let developed = Developed::of(&study, study.topology(&row.tokens), Proof::None)
        .map_err(|failure| CliError::Failed(format!("design {id}: {}", failure.reason)))?;
    if let Some(failure) = &developed.failure {
        console.warn(&format!("design {id} has a pattern, but no structural results: {}", failure.reason));
    }
    let files = match args.pattern {
        Some(operator) => transformed(operator.apply(&developed.design.pattern), &id, operator, args.format)?,
        None => plain(&developed, &id, args.format),
    };
    write(&args, files)
}

/// The files of a design in one format.
fn plain(developed: &Developed, id: &str, format: Format) -> DesignFiles {
    let endings: &[&str] = match format {
        Format::Obj => &[".obj"],
        Format::Json => &[".json"],
        Format::Svg => &[".svg"],
        Format::Vtu => &[".vtu", "_members.vtu"],
        Format::Csv => &["_nodes.csv", "_members.csv"],
    };
    let wanted = |name: &String| endings.iter().any(|ending| *name == format!("{id}{ending}"));
    developed.files(id).into_iter().filter(|(name, _)| wanted(name)).collect()
}

impl Operator {
    fn apply(self, pattern: &Pattern) -> PolyMesh {
        match self {
            Self::Dual => dual(pattern),
            Self::Join => join(pattern),
            Self::Ambo => ambo(pattern),
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Dual => "dual",
            Self::Join => "join",
            Self::Ambo => "ambo",
        }
    }
}

fn transformed(
    mesh: PolyMesh,
    id: &str,
    operator: Operator,
    format: Format,
) -> Result<DesignFiles, CliError> {
    let name = format!("{id}_{}", operator.name());
    let polygons = Polygons::from(&mesh);
    let (ending, bytes) = match format {
        Format::Obj => ("obj", obj(&polygons, &name)),
        Format::Json => ("json", compas(&polygons, &name)),
        Format::Svg => ("svg", svg::outlines(&polygons, &name)),
        Format::Vtu => {
            let grid = Grid {
                points: polygons.positions,
                cells: &polygons.faces,
                point_fields: &[],
                cell_fields: &[],
            };
            ("vtu", vtu(&grid))
        }
        Format::Csv => {
            let message =
                "--format csv lists what was analysed, which is the pattern itself; leave --pattern out";
            return Err(CliError::Input(message.into()));
        }
    };
    Ok(vec![(format!("{name}.{ending}"), bytes)])
}

fn write(args: &Args, files: DesignFiles) -> Result<ExitCode, CliError> {
    match (&args.out, files.as_slice()) {
        (None, [(_, bytes)]) => {
            print_result(bytes)?;
        }
        (None, _) => {
            let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
            return Err(CliError::Input(format!("{} are two files; give --out DIR", names.join(" and "))));
        }
        (Some(folder), _) => {
            std::fs::create_dir_all(folder).map_err(CliError::write(folder))?;
            for (name, bytes) in &files {
                let path = folder.join(name);
                atomic::write(&path, bytes).map_err(CliError::write(&path))?;
                outln!("{}", path.display());
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}
