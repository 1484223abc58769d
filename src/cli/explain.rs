//! `quadrille explain`: what governs a design, where and by how much.

use super::folder_args::{FolderArgs, find, refuse_other_kind};
use super::{CliError, Console};
use quadrille::files::atomic;
use quadrille::files::names::EXPLAINED;
use quadrille::geometry::limits::LimitExcess;
use quadrille::objectives::METRICS;
use quadrille::output::designs::id;
use quadrille::output::explanation::explanation;
use quadrille::output::folder;
use quadrille::output::load::Loaded;
use quadrille::output::number::significant;
use quadrille::output::results::Developed;
use quadrille::search::EvaluatedRow;
use quadrille::structure::gridshell::{Detailed, Metrics, Place, Proof};
use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;

/// Tell what governs a design, in words and a picture: limits and requirements, where they are reached, its standing.
///
/// Nodes and members are numbered as in ID_nodes.csv and ID_members.csv (`quadrille export --format csv`). The picture,
/// DIR/explained/ID.svg or --svg, is the plan: members coloured by utilisation, the member that governs, the node of
/// the largest deflection, and the nodes that move in the first buckling mode. Where no structure is configured there is
/// no picture.
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    run: FolderArgs,
    /// The design: its id, or the beginning of it; any of history.csv.
    #[arg(value_name = "ID")]
    design: String,
    /// Write the picture here [default: DIR/explained/ID.svg].
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

/// Tells.
pub fn run(args: Args, console: &Console) -> Result<ExitCode, CliError> {
    if let Some(path) = &args.svg {
        refuse_other_kind("--svg", path, "svg")?;
    }
    let (loaded, study) = args.run.look(console)?;
    let row = find(&loaded, &args.design)?;
    outln!("design {}: \"{}\"", id(row.code), row.tokens);
    outln!("expressed \"{}\", generation {}", row.expressed, row.generation);
    match row.is_feasible() {
        true => outln!("feasible"),
        false => outln!("not feasible (stage {}): {}", row.violation.stage, row.reason),
    }
    standing(&loaded, row);
    let developed = match Developed::of(&study, study.topology(&row.tokens), Proof::None) {
        Ok(developed) => developed,
        Err(failure) => {
            outln!("\nno pattern: {}", failure.reason);
            return Ok(ExitCode::SUCCESS);
        }
    };
    outln!("\nlimits of the pattern");
    for limit in &developed.design.limits {
        kept(limit, "limit");
    }
    if let Some(results) = &developed.results {
        requirements(results, &developed.design.pattern.positions);
        for required in &developed.design.required {
            kept(required, if required.upper { "≤" } else { "≥" });
        }
        also(results, &developed.design.pattern.positions);
        near_points(results);
    }
    if let Some(picture) = explanation(&developed, &id(row.code)) {
        let name = format!("{EXPLAINED}/{}.svg", id(row.code));
        let path = args.svg.clone().unwrap_or_else(|| args.run.folder.join(&name));
        let made = path.parent().map_or(Ok(()), fs::create_dir_all);
        made.and_then(|()| atomic::write_named(&path, &picture)).map_err(CliError::write(&path))?;
        if args.svg.is_none() {
            folder::list(&args.run.folder, &name, &picture)
                .map_err(|error| CliError::Failed(error.to_string()))?;
        }
        outln!("\npicture: {}", path.display());
    }
    Ok(ExitCode::SUCCESS)
}

/// One limit: what there is, what may be, and whether it is kept.
fn kept(limit: &LimitExcess, sign: &str) {
    let state = if limit.excess > 0.0 { "EXCEEDED" } else { "kept" };
    let [value, bound] = [limit.value, limit.limit].map(significant);
    outln!("  {:<22} {value:>12}  {sign} {bound:>10}  {state}", limit.name);
}

/// The name of a metric with its unit; each quantity that can be required is one.
fn column(name: &str) -> &str {
    METRICS.iter().find(|metric| metric.name == name).map_or(name, |metric| metric.column)
}

/// Each objective against the best of the front.
fn standing(loaded: &Loaded, row: &EvaluatedRow) {
    outln!("\nobjectives, and the range of the front");
    let objectives = &loaded.config.objectives;
    for (index, name) in objectives.names().enumerate() {
        let column = column(name);
        let value = |row: &EvaluatedRow| objectives.turned(&row.objectives).get(index).copied();
        let front = loaded.front.iter().filter_map(|&f| value(&loaded.evaluated[f]));
        let (low, high) = front.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        let own = value(row).map_or("–".into(), significant);
        if low.is_finite() {
            outln!("  {column:<22} {own:>12}  {} to {}", significant(low), significant(high));
        } else {
            outln!("  {column:<22} {own:>12}");
        }
    }
}

fn requirements(results: &Detailed, positions: &[[f64; 3]]) {
    outln!("\nrequirements");
    for requirement in &results.response.requirements {
        let sign = if requirement.upper { "≤" } else { "≥" };
        outln!(
            "  {:<22} {:>12}  {sign} {:<8} {:>4.0} % used, in {}, at {}",
            column(&requirement.quantity.to_string()),
            significant(requirement.value),
            significant(requirement.limit),
            100.0 * requirement.used(),
            requirement.combination,
            describe(requirement.place, results, positions)
        );
    }
    match results.response.governing() {
        Some(governing) if governing.excess() > 0.0 => {
            outln!(
                "{} governs: its limit is exceeded by {:.0} %",
                governing.quantity,
                100.0 * governing.excess()
            );
        }
        Some(governing) => {
            outln!("{} governs: {:.0} % of its limit is used", governing.quantity, 100.0 * governing.used());
        }
        None => outln!("none is configured"),
    }
}

/// Which nodes columns and forces at points have found, and how far from where they were wanted.
fn near_points(results: &Detailed) {
    let found = &results.model.found;
    if found.is_empty() {
        return;
    }
    outln!("\nnodes found for points of the config");
    for near in found {
        let [x, y] = near.point;
        outln!("  structure.{}: node {}, {:.3} m from ({x}, {y})", near.key, near.node, near.distance);
    }
}

/// What a structure must be told of, whether it is limited or not, where it is worst.
fn also(results: &Detailed, positions: &[[f64; 3]]) {
    type Of = fn(&Metrics) -> (f64, Place);
    let quantities: [(&str, f64, Of); 3] = [
        ("utilisation_von_mises", 1.0, |metrics| metrics.von_mises),
        ("uplift", 1e-3, |metrics| metrics.uplift),
        ("support_slide", 1.0, |metrics| metrics.slide),
    ];
    outln!("\nthe worst of all combinations");
    for (name, unit, of) in quantities {
        let all =
            results.combinations.iter().map(|combination| (&combination.name, of(&combination.metrics)));
        let Some((combination, (value, place))) = all.max_by(|a, b| a.1.0.total_cmp(&b.1.0)) else { return };
        let place = match value > 0.0 {
            true => format!("in {combination}, at {}", describe(place, results, positions)),
            false => "none".into(),
        };
        outln!("  {:<22} {:>12}  {place}", column(name), significant(unit * value));
    }
}

/// A place with its coordinates.
fn describe(place: Place, results: &Detailed, positions: &[[f64; 3]]) -> String {
    let at = |node: u32| {
        let nodes = results.model.frame.nodes();
        let [x, y, z] =
            nodes.get(node as usize).or_else(|| positions.get(node as usize)).copied().unwrap_or_default();
        format!("({x:.2}, {y:.2}, {z:.2}) m")
    };
    match place {
        Place::Node(node) => format!("node {node} {}", at(node)),
        Place::Edge(edge) => {
            let member = results.model.edge.iter().position(|&e| e == edge);
            let start = member.map(|m| results.model.frame.members()[m].start);
            format!("member {edge}{}", start.map_or(String::new(), |node| format!(" from {}", at(node))))
        }
        Place::Whole => "the structure as a whole".into(),
    }
}
