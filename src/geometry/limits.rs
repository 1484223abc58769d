//! Limits of a pattern that can be built (GEOMETRY §2.6).

use super::metrics::{edge_lengths, panel_area, valences};
use super::params::LimitParams;
use super::pattern::Pattern;
use super::vector::{angle, sub};

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

/// All limits of the config on one pattern, kept or not, in the order of the keys. Without `min_edge_m` there is no
/// shortest member.
pub fn excesses(pattern: &Pattern, params: &LimitParams) -> Vec<LimitExcess> {
    let lengths = edge_lengths(pattern);
    let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    let most = valences(pattern).into_iter().max().unwrap_or(0);
    let mut rows = vec![
        at_least("min_edge_m", shortest, params.min_edge_m.unwrap_or(0.0)),
        at_most("max_edge_factor", longest / pattern.target_length, params.max_edge_factor),
        at_least("min_angle_deg", smallest_angle(pattern).to_degrees(), params.min_angle_deg),
        at_most("max_valence", most as f64, params.max_valence as f64),
    ];
    if let Some(limit) = params.max_panel_area_m2 {
        let largest = pattern.panels.iter().map(|p| panel_area(&pattern.positions, p)).fold(0.0, f64::max);
        rows.push(at_most("max_panel_area_m2", largest, limit));
    }
    rows
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
