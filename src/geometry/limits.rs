//! Limits of a pattern that can be built (docs/reference/geometry.md §2.6).

use super::metrics::{Fabrication, edge_lengths, least_inner, panel_area, smallest_angle, valences};
use super::outline;
use super::params::LimitParams;
use super::pattern::Pattern;
use crate::domain::Domain;

/// Share of the target length that a member has at least, and that the boundary may lie off the pattern's at most, where
/// the config does not say (docs/reference/geometry.md §2.6).
const QUARTER: f64 = 0.25;

/// Longest edge that a pattern is drawn to keep where its limit is looser, in target lengths: with one of 5 t the tips of an ellipse were
/// left to edges of 4 t. The gap is drawn to its default.
const LONGEST_AIM: f64 = 2.4;

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

    /// What the optimiser is to aim at: these limits, but for a longest edge and a gap that are much looser than a good pattern needs.
    pub fn aims(&self) -> Self {
        let t = self.target_length;
        Self { max_edge: self.max_edge.min(LONGEST_AIM * t), max_gap: self.max_gap.min(QUARTER * t), ..*self }
    }
}

/// One limit, what the pattern has, and by how much it exceeds.
#[derive(Clone, PartialEq, Debug)]
pub struct LimitExcess {
    /// The limit's key in the config, or the column of the metric that is limited.
    pub name: &'static str,
    /// What the pattern has, in the unit of the key.
    pub value: f64,
    /// What it may have.
    pub limit: f64,
    /// Whether at most; else at least.
    pub upper: bool,
    /// Relative excess: max(0, value/limit − 1) of an upper limit, max(0, 1 − value/limit) of a lower one; 0 if it is kept.
    pub excess: f64,
}

/// What limits are asked of: the extremes of one pattern.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Extremes {
    /// Shortest edge, m.
    pub edge_min: f64,
    /// Longest edge, m.
    pub edge_max: f64,
    /// Smallest panel angle, rad.
    pub angle_min: f64,
    /// Most edges at a vertex.
    pub valence_max: usize,
    /// Fewest edges at an inner vertex; `None` where there is none.
    pub valence_min: Option<usize>,
    /// Largest panel, m².
    pub panel_area_max: f64,
    /// Farthest that the domain's boundary lies from the pattern's, m.
    pub boundary_gap: f64,
}

impl Extremes {
    /// Measures a pattern for its limits alone.
    pub fn of(pattern: &Pattern, domain: &Domain) -> Self {
        let lengths = edge_lengths(pattern);
        let valences = valences(pattern);
        Self {
            edge_min: lengths.iter().copied().fold(f64::INFINITY, f64::min),
            edge_max: lengths.iter().copied().fold(0.0, f64::max),
            angle_min: smallest_angle(pattern),
            valence_max: valences.iter().copied().max().unwrap_or(0),
            valence_min: least_inner(&valences, pattern),
            panel_area_max: pattern
                .panels
                .iter()
                .map(|p| panel_area(&pattern.positions, p))
                .fold(0.0, f64::max),
            boundary_gap: outline::gap(pattern, domain),
        }
    }
}

impl From<&Fabrication> for Extremes {
    fn from(measured: &Fabrication) -> Self {
        Self {
            edge_min: measured.edge_min,
            edge_max: measured.edge_max,
            angle_min: measured.angle_min,
            valence_max: measured.valence_max,
            valence_min: measured.valence_min,
            panel_area_max: measured.panel_area_max,
            boundary_gap: measured.boundary_gap,
        }
    }
}

/// All limits on a pattern with these extremes, kept or not.
pub fn excesses(found: &Extremes, limits: &Limits) -> Vec<LimitExcess> {
    let t = limits.target_length;
    let mut rows = vec![
        at_least("min_edge_m", found.edge_min, limits.min_edge),
        at_most("max_edge_factor", found.edge_max / t, limits.max_edge / t),
        at_least("min_angle_deg", found.angle_min.to_degrees(), limits.min_angle.to_degrees()),
        at_most("max_valence", found.valence_max as f64, limits.max_valence as f64),
    ];
    if let (3.., Some(least)) = (limits.min_valence, found.valence_min) {
        rows.push(at_least("min_valence", least as f64, limits.min_valence as f64));
    }
    if let Some(limit) = limits.max_panel_area {
        rows.push(at_most("max_panel_area_m2", found.panel_area_max, limit));
    }
    rows.push(at_most("max_boundary_gap_m", found.boundary_gap, limits.max_gap));
    rows
}

/// An upper limit on a value, kept or not.
pub fn at_most(name: &'static str, value: f64, limit: f64) -> LimitExcess {
    let excess = if limit > 0.0 { (value / limit - 1.0).max(0.0) } else { value.max(0.0) };
    LimitExcess { name, value, limit, upper: true, excess }
}

/// A lower limit on a value, kept or not.
pub fn at_least(name: &'static str, value: f64, limit: f64) -> LimitExcess {
    let excess = if limit > 0.0 { (1.0 - value / limit).max(0.0) } else { 0.0 };
    LimitExcess { name, value, limit, upper: false, excess }
}
