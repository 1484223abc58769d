//! `quadrille frame`: the frame solver alone, on any model.

use clap::{Args, ValueEnum};
use quadrille::structure::file;
use quadrille::structure::{FrameModel, FrameResult, frame};
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

/// Analyses a 3D frame: displacements, reactions, member forces, buckling factors, utilisation.
#[derive(Args)]
pub struct FrameArgs {
    /// The model: nodes, members, section, supports, loads, what to analyse (JSON, SI units).
    model: PathBuf,
    /// What to print.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// All nodes and members, one line of JSON.
    Json,
    /// A summary to read.
    Text,
}

/// Runs the command.
pub fn run(args: &FrameArgs) -> ExitCode {
    let name = args.model.display();
    let read = std::fs::read_to_string(&args.model).map_err(|e| e.to_string());
    let (model, analysis) = match read.and_then(|text| file::read(&text).map_err(|e| e.to_string())) {
        Ok(read) => read,
        Err(message) => {
            eprintln!("error: {name}: {message}");
            return ExitCode::from(2);
        }
    };
    let answer = frame(&model, &analysis);
    let text = match (&answer, args.format) {
        (Ok(result), Format::Json) => file::answer(result).map_err(|e| e.to_string()),
        (Ok(result), Format::Text) => Ok(summary(&model, result).into_bytes()),
        (Err(error), Format::Json) => Ok(format!("{}\n", file::failure(error)).into_bytes()),
        (Err(_), Format::Text) => Ok(Vec::new()),
    };
    if let Err(error) = &answer {
        eprintln!("error: {name}: {error}");
    }
    let written = text.and_then(|bytes| std::io::stdout().lock().write_all(&bytes).map_err(|e| e.to_string()));
    match (written, answer) {
        (Ok(()), Ok(_)) => ExitCode::SUCCESS,
        (Ok(()), Err(_)) => ExitCode::from(1),
        (Err(message), _) => {
            eprintln!("error: {message}");
            ExitCode::from(1)
        }
    }
}

fn summary(model: &FrameModel, result: &FrameResult) -> String {
    use std::fmt::Write;
    let mut text = String::new();
    let mut line = |label: &str, value: String| {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{label:<26}{value}");
    };
    line("nodes", model.nodes().len().to_string());
    line("members", model.members().len().to_string());
    line("order", result.order.to_string());
    let (largest, node) = result.max_displacement;
    line("largest displacement", format!("{:.4} mm at {node}", 1e3 * largest));
    let [x, y, z] = result.total_reaction.map(|r| r / 1e3);
    line("sum of reactions", format!("({x:.3}, {y:.3}, {z:.3}) kN"));
    let (used, member) = result.utilisation();
    line("utilisation", format!("{used:.4} in {member}"));
    line("  at member ends", format!("{:.4}", result.worst(|u| u.ends).0));
    line("  ends and between", format!("{:.4}", result.worst(|u| u.inner).0));
    line("  von Mises", format!("{:.4}", result.worst(|u| u.von_mises).0));
    if result.buckling_factors.is_empty() {
        line("buckling factors", "none".into());
    } else {
        let factors: Vec<String> = result.buckling_factors.iter().map(|f| format!("{f:.4}")).collect();
        line("buckling factors", factors.join(", "));
    }
    text
}
