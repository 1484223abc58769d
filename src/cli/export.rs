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
use quadrille::output::dxf::dxf;
use quadrille::output::frame_model::frame_model;
use quadrille::output::handed::{Combination, Handed};
use quadrille::output::load::Loaded;
use quadrille::output::obj::obj;
use quadrille::output::opensees::opensees;
use quadrille::output::polygons::Polygons;
use quadrille::output::results::{DesignFiles, Developed};
use quadrille::output::saf::saf;
use quadrille::output::svg;
use quadrille::output::vtu::{Grid, vtu};
use quadrille::structure::gridshell::Proof;
use std::path::PathBuf;
use std::process::ExitCode;

/// Export a design of a results folder: mesh, picture, structural results, or the structure for another program.
///
/// The design is made again from its string. One file goes to stdout unless --out is given; vtu (panels, members) and
/// csv (nodes, members) are two files each and need --out. frame and opensees hold one combination each: all of them
/// with --out, or the one that --combination names.
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
    /// The combination of loads (frame and opensees only) [default: each].
    #[arg(long, value_name = "NAME")]
    combination: Option<String>,
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
    /// DXF (R12): members as lines, panels as 3D faces, on layers; metres, z up.
    Dxf,
    /// The model that `quadrille frame` reads, one file a combination.
    Frame,
    /// A Tcl deck for OpenSees, one file a combination.
    Opensees,
    /// Structural Analysis Format: a workbook (.xlsx) that RFEM, SCIA and others read.
    Saf,
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
    if args.combination.is_some() && !matches!(args.format, Format::Frame | Format::Opensees) {
        let message = "--combination is for --format frame and opensees; all others hold every combination";
        return Err(CliError::Input(message.into()));
    }
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
        None => match args.format {
            Format::Dxf => vec![(format!("{id}.dxf"), drawn(&developed, &id))],
            Format::Frame | Format::Opensees | Format::Saf => {
                handed_on(&developed, &loaded, &id, args.format, args.combination.as_deref())?
            }
            format => plain(&developed, &id, format),
        },
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
        Format::Dxf | Format::Frame | Format::Opensees | Format::Saf => &[],
    };
    let wanted = |name: &String| endings.iter().any(|ending| *name == format!("{id}{ending}"));
    developed.files(id).into_iter().filter(|(name, _)| wanted(name)).collect()
}

/// The pattern with its supports, as DXF.
fn drawn(developed: &Developed, id: &str) -> Vec<u8> {
    let supports: Vec<[f64; 3]> = developed.supports().into_iter().map(|(position, _)| position).collect();
    dxf(&Polygons::from(&developed.design.pattern), &supports, id)
}

/// The structure for another program: one file, or one a combination.
fn handed_on(
    developed: &Developed,
    loaded: &Loaded,
    id: &str,
    format: Format,
    combination: Option<&str>,
) -> Result<DesignFiles, CliError> {
    let design = loaded.config.structure.as_ref().and_then(|params| Handed::of(developed, params, id));
    let Some(design) = design else {
        return Err(CliError::Failed(format!("design {id}: there is no analysed structure to hand on")));
    };
    let failed = |error: &dyn std::fmt::Display| CliError::Failed(format!("design {id}: {error}"));
    if format == Format::Saf {
        return Ok(vec![(format!("{id}.xlsx"), saf(&design).map_err(|error| failed(&error))?)]);
    }
    let named = design.file_names().into_iter().zip(&design.combinations);
    let wanted: Vec<_> = named.filter(|(_, (name, _))| combination.is_none_or(|own| own == *name)).collect();
    if wanted.is_empty() {
        let names: Vec<&str> = design.combinations.iter().map(|(name, _)| *name).collect();
        let (found, all) = (combination.unwrap_or_default(), names.join(", "));
        return Err(CliError::Input(format!(
            "--combination {found}: there is none of that name; allowed: {all}"
        )));
    }
    let file = |(file, (name, factors)): (String, &Combination)| {
        let file = format!("{id}_{file}");
        Ok(match format {
            Format::Frame => {
                let bytes = frame_model(&design, (name, factors)).map_err(|error| failed(&error))?;
                (format!("{file}.json"), bytes)
            }
            _ => (format!("{file}.tcl"), opensees(&design, (name, factors), &file)),
        })
    };
    wanted.into_iter().map(file).collect()
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
        Format::Dxf => ("dxf", dxf(&polygons, &[], &name)),
        Format::Csv | Format::Frame | Format::Opensees | Format::Saf => {
            let message =
                "this --format is of what was analysed, which is the pattern itself; leave --pattern out";
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
            return Err(CliError::Input(format!(
                "{} are several files; give --out DIR",
                names.join(" and ")
            )));
        }
        (Some(folder), _) => {
            std::fs::create_dir_all(folder).map_err(CliError::write(folder))?;
            for (name, bytes) in &files {
                let path = folder.join(name);
                atomic::write_named(&path, bytes).map_err(CliError::write(&path))?;
                outln!("{}", path.display());
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}
