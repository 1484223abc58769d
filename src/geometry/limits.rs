//! Limits of a pattern that can be built (PATTERN §5).

use super::metrics::{edge_lengths, panel_area, valences};
use super::params::LimitParams;
use super::pattern::Pattern;
use super::vector::{angle, sub};

/// Share of the target length that a member has at least, and that the boundary may lie off the pattern's at most, where
/// the config does not say (PATTERN §5).
const QUARTER: f64 = 0.25;

/// The limits of a config in numbers, on one domain: all that depends on the target length is filled in.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Limits {
    /// The target length t that they are relative to, m.
    pub target_length: f64,
    /// Shortest edge, m.
    pub min_edge: f64,
    /// Longest edge, m.
    pub max_edge: f64,
    /// Smallest panel angle, rad.
    pub min_angle: f64,
    /// Most edges at a vertex.
    pub max_valence: usize,
    /// Fewest edges at an inner vertex; 2 is none too few.
    pub min_valence: usize,
    /// Largest panel, m², if there is a limit.
    pub max_panel_area: Option<f64>,
    /// Farthest that the boundary curve may lie from the pattern's boundary, m.
    pub max_gap: f64,
}

impl Limits {
    /// The limits of a config for target length t, m. (The config itself fills in `min_edge_m` where it has a structure.)
    pub fn of(params: &LimitParams, target_length: f64) -> Self {
        Self {
            target_length,
            min_edge: params.min_edge_m.unwrap_or(QUARTER * target_length),
            max_edge: params.max_edge_factor * target_length,
            min_angle: params.min_angle_deg.to_radians(),
            max_valence: params.max_valence,
            min_valence: params.min_valence,
            max_panel_area: params.max_panel_area_m2,
            max_gap: params.max_boundary_gap_m.unwrap_or(QUARTER * target_length),
        }
    }
}

/// One limit, what the pattern has, and by how much it exceeds.
#[derive(Clone, PartialEq, Debug)]
pub struct LimitExcess {
    /// The limit's key in the config.
    pub name: &'static str,
    /// What the pattern has, in the unit of the key.
    pub value: f64,
    /// What it may have.
    pub limit: f64,
    /// Relative excess: max(0, value/limit − 1) of an upper limit, max(0, 1 − value/limit) of a lower one; 0 if it is kept.
    pub excess: f64,
}

/// All limits on one pattern, kept or not, in the order of the keys.
pub fn excesses(pattern: &Pattern, limits: &Limits) -> Vec<LimitExcess> {
    let t = limits.target_length;
    let lengths = edge_lengths(pattern);
    let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    let most = valences(pattern).into_iter().max().unwrap_or(0);
    let mut rows = vec![
        at_least("min_edge_m", shortest, limits.min_edge),
        at_most("max_edge_factor", longest / t, limits.max_edge / t),
        at_least("min_angle_deg", smallest_angle(pattern).to_degrees(), limits.min_angle.to_degrees()),
        at_most("max_valence", most as f64, limits.max_valence as f64),
    ];
    if limits.min_valence > 2 {
        rows.push(at_least("min_valence", least_inner_valence(pattern) as f64, limits.min_valence as f64));
    }
    if let Some(limit) = limits.max_panel_area {
        let largest = pattern.panels.iter().map(|p| panel_area(&pattern.positions, p)).fold(0.0, f64::max);
        rows.push(at_most("max_panel_area_m2", largest, limit));
    }
    rows
}

/// Fewest edges at a vertex that is not on the boundary; without such a vertex as many as one can have.
fn least_inner_valence(pattern: &Pattern) -> usize {
    let mut valences = valences(pattern);
    for &v in pattern.loops.iter().flatten() {
        valences[v as usize] = usize::MAX;
    }
    valences.into_iter().min().unwrap_or(usize::MAX)
}

fn at_most(name: &'static str, value: f64, limit: f64) -> LimitExcess {
    let excess = if limit > 0.0 { (value / limit - 1.0).max(0.0) } else { value.max(0.0) };
    LimitExcess { name, value, limit, excess }
}

fn at_least(name: &'static str, value: f64, limit: f64) -> LimitExcess {
    let excess = if limit > 0.0 { (1.0 - value / limit).max(0.0) } else { 0.0 };
    LimitExcess { name, value, limit, excess }
}

/// Smallest angle of all panels, triangles included, rad.
fn smallest_angle(pattern: &Pattern) -> f64 {
    let mut least = f64::INFINITY;
    for panel in &pattern.panels {
        let corners = panel.corners();
        let n = corners.len();
        for i in 0..n {
            let at = |k: usize| pattern.positions[corners[k % n] as usize];
            least = least.min(angle(sub(at(i + 1), at(i)), sub(at(i + n - 1), at(i))));
        }
    }
    least
}
