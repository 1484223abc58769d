//! `quadrille frame`: the frame solver alone, on any model.

use super::stdout::print_result;
use super::{CliError, Console, exit};
use clap::ValueEnum;
use quadrille::io::text;
use quadrille::structure::file;
use quadrille::structure::{FrameModel, FrameResult, frame};
use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

/// Analyse any 3D frame: displacements, reactions, member forces, buckling factors, utilisation.
///
/// The model is JSON in SI units (m, N, Pa, kg); docs/frame.md tells what each key means, and what
/// is printed:
///
/// { "material": {"E", "G", "density", "fy", "thermal_expansion"},
///   "section": {"kind": "box", "width", "height", "thickness"} or {"kind": "round", "diameter"}
///     or {"kind": "tube", "diameter", "thickness"}
///     or {"kind": "properties", "A", "Iy", "Iz", "J", and where known "Wy", "Wz", "Asy", "Asz"},
///     of all members; or "sections": [ … ], of which each member names one,
///   "nodes": [[x, y, z] …],
///   "members": [{"start", "end", "up": [x, y, z], "section", "kind": "beam" or "truss",
///     "start_release", "end_release": {"bending_y", "bending_z", "torsion"}} …],
///     a release being "rigid", "hinge", {"ei_per_l"}, {"gj_per_l"} (torsion) or {"nm_per_rad"},
///   "supports": [{"node", "fixed": [ux, uy, uz, rx, ry, rz], "stiffness": [N/m, Nm/rad],
///     "displacement": [m, rad]} …],
///   "loads": {"nodal": [{"node", "force", "moment"} …],
///     "member_uniform": [{"member", "force_per_length"} …],
///     "pressure": [{"member", "force_per_length"} …], "temperature": [{"member", "kelvin"} …],
///     "gravity": g},
///   "shear_deformation": true or false, "analysis": {"order": 1 or 2, "buckling_modes": n} }
///
/// Nodes and members are counted from 0. `name`, `description`, `source`, `expected`, `tolerance`
/// and `verification` are for people; any other key is an error. A mechanism or a structure past its
/// critical load is named, by node and direction, with exit code 1; a wrong model ends with 2. The
/// geometric stiffness is that of axial force: lateral-torsional buckling is not found.
#[derive(clap::Args)]
#[command(verbatim_doc_comment)]
pub struct Args {
    /// The model; `-` is stdin.
    #[arg(value_name = "MODEL.json")]
    model: PathBuf,
    /// What to print.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A summary to read.
    Text,
    /// One line of JSON with all nodes and members.
    Json,
}

/// Runs the command.
pub fn run(args: Args, console: &Console) -> Result<ExitCode, CliError> {
    let name = args.model.display();
    let refused = |error: &dyn std::fmt::Display| match args.format {
        Format::Json => print_result(format!("{}\n", file::refusal(&error)).as_bytes()),
        Format::Text => Ok(()),
    };
    let text = match text::read(&args.model) {
        Ok(text) => text,
        Err(error) => {
            refused(&error)?;
            return Err(CliError::read(&args.model)(error));
        }
    };
    let (model, analysis) = match file::read(&text) {
        Ok(read) => read,
        Err(error) => {
            refused(&error)?;
            return Err(CliError::Input(format!("{name}: {error}")));
        }
    };
    let answer = frame(&model, &analysis);
    let printed = match (&answer, args.format) {
        (Ok(result), Format::Json) => {
            file::answer(result).map_err(|e| CliError::Failed(format!("{name}: {e}")))?
        }
        (Ok(result), Format::Text) => summary(&model, result).into_bytes(),
        (Err(error), Format::Json) => format!("{}\n", file::failure(error)).into_bytes(),
        (Err(_), Format::Text) => Vec::new(),
    };
    print_result(&printed)?;
    match answer {
        Ok(_) => Ok(ExitCode::SUCCESS),
        Err(error) => {
            console.error(&format!("{name}: {error}"));
            Ok(ExitCode::from(exit::FAILED))
        }
    }
}

fn summary(model: &FrameModel, result: &FrameResult) -> String {
    let mut text = String::new();
    let mut line = |label: &str, value: String| {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{label:<26}{value}");
    };
    line("nodes", model.nodes().len().to_string());
    line("members", model.members().len().to_string());
    line("order", (result.order as u8).to_string());
    let (largest, node) = result.max_displacement;
    line("largest displacement", format!("{:.4} mm at {node}", 1e3 * largest));
    let [x, y, z] = result.total_reaction.map(|r| r / 1e3);
    line("sum of reactions", format!("({x:.3}, {y:.3}, {z:.3}) kN"));
    if let (Some((used, member)), Some(ends), Some(inner), Some(mises)) = (
        result.utilisation(),
        result.worst(|u| u.ends),
        result.worst(|u| u.inner),
        result.worst(|u| u.von_mises),
    ) {
        line("utilisation", format!("{used:.4} in {member}"));
        line("  at member ends", format!("{:.4} in {}", ends.0, ends.1));
        line("  ends and between", format!("{:.4} in {}", inner.0, inner.1));
        line("  von Mises", format!("{:.4} in {}", mises.0, mises.1));
    } else {
        line("utilisation", "not known: the section gives no Wy, Wz".into());
    }
    if result.modes_asked == 0 {
        line("buckling factors", "not asked for (analysis.buckling_modes)".into());
    } else if result.buckling_factors.is_empty() {
        line("buckling factors", "none".into());
    } else {
        let factors: Vec<String> = result.buckling_factors.iter().map(|f| format!("{f:.4}")).collect();
        line("buckling factors", factors.join(", "));
    }
    for remark in result.remarks() {
        line("remark", remark.into());
    }
    text
}
