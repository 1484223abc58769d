//! What the sizes of a config come to, and how its initial mesh fares: what a user wants to know before a run.

use quadrille::config::Config;
use quadrille::domain::Domain;
use quadrille::geometry::params::Density;
use quadrille::output::number::significant;
use quadrille::study::{Design, Failure, Reached, Study};

/// Corners of a loop that are listed by their places; of more only the first.
const LISTED: usize = 12;

/// Extents, areas, target length and corners of the domain, then the initial mesh and its limits, a sentence each.
///
/// Develops the initial mesh; its structure is not analysed.
pub fn outlook(study: &Study, config: &Config) -> Vec<String> {
    let developed = study.draw(study.topology(&Default::default()));
    let drawn = match &developed {
        Ok(design) => Some(design),
        Err(Failure { reached: Reached::Folded(design) | Reached::Pattern(design), .. }) => Some(&**design),
        Err(_) => None,
    };
    let domain = &study.domain;
    let mut lines = vec![extents(domain, drawn), areas(domain), target(domain, config)];
    lines.extend((0..domain.loops.len()).map(|label| corners(domain, label)));
    match developed {
        Ok(design) => lines.extend(initial_mesh(&design)),
        Err(failure) => lines.push(format!("initial mesh: no sound pattern: {}", failure.reason)),
    }
    lines
}

/// Width, depth and, as far as the initial mesh tells it, height.
fn extents(domain: &Domain, design: Option<&Design>) -> String {
    let [low, high] = domain.bounds();
    let mut parts = vec![extent("x", low[0], high[0]), extent("y", low[1], high[1])];
    if let Some(design) = design {
        let heights = design.pattern.positions.iter().map(|p| p[2]);
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), z| (l.min(z), h.max(z)));
        parts.push(extent("z", low, high));
    }
    format!("extents: {}", parts.join(", "))
}

fn areas(domain: &Domain) -> String {
    let [plan, surface] = [domain.area(), domain.surface_area()].map(significant);
    format!("area: {plan} m² in plan, {surface} m² on the surface")
}

fn target(domain: &Domain, config: &Config) -> String {
    let t = significant(config.pattern.target_length(domain));
    match (config.pattern.density, config.pattern.target_length_m) {
        (Density::TargetLength, Some(_)) => format!("target length t: {t} m, as given"),
        _ => format!("target length t: {t} m, the side of a square with the mean panel's area"),
    }
}

/// How many corners were found on a loop, and where.
fn corners(domain: &Domain, label: usize) -> String {
    let boundary = &domain.loops[label];
    let name = if label == 0 { "outer boundary".to_owned() } else { format!("hole {label}") };
    let corners = boundary.corners();
    let place = |&s: &f64| {
        let [x, y, _] = boundary.point(s);
        format!("({}, {})", significant(x), significant(y))
    };
    let places = corners.iter().take(LISTED).map(place).collect::<Vec<_>>().join(", ");
    match corners.len() {
        0 => format!("corners of the {name}: none, it is smooth"),
        count if count > LISTED => format!("corners of the {name}: {count}, the first at {places}"),
        count => format!("corners of the {name}: {count}, at {places}"),
    }
}

fn extent(axis: &str, low: f64, high: f64) -> String {
    // What is nothing beside the extent is rounding.
    let [low, high] = [low, high].map(|end| if end.abs() < 1e-9 * (high - low) { 0.0 } else { end });
    format!("{axis} {} to {} m ({} m)", significant(low), significant(high), significant(high - low))
}

/// The developed initial mesh in figures, and each limit with what it has.
fn initial_mesh(design: &Design) -> Vec<String> {
    let measures = &design.fabrication;
    let mut lines = vec![format!(
        "initial mesh: {} panels, {} members of {} m on average, {} to {} m",
        design.pattern.panels.len(),
        design.pattern.edges.len(),
        significant(measures.edge_mean),
        significant(measures.edge_min),
        significant(measures.edge_max)
    )];
    for limit in &design.limits {
        let state = if limit.excess > 0.0 { "EXCEEDED" } else { "kept" };
        let [value, bound] = [limit.value, limit.limit].map(significant);
        lines.push(format!("initial mesh: {} {value}, limit {bound}: {state}", limit.name));
    }
    let exceeded = design.limits.iter().filter(|limit| limit.excess > 0.0).count();
    lines.push(match exceeded {
        0 => "the initial mesh keeps every limit of the pattern (the structure is analysed by `run` and `evaluate`)".into(),
        count => format!("the initial mesh exceeds {count} of the limits of the pattern"),
    });
    lines
}
