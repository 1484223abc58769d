//! What making a design takes: repetition, cost and carbon (docs/reference/geometry.md §3).

use super::params::UnitFigures;
use super::{AnalysedDesign, Metric};

/// Kinds of members.
pub const DISTINCT_MEMBERS: Metric = Metric {
    name: "distinct_members",
    column: "distinct_members",
    unit: "",
    about: "members of different length, within fabrication.tolerance_m",
    structural: false,
    value: |design| Some(design.distinct.members as f64),
};

/// Kinds of panels.
pub const DISTINCT_PANELS: Metric = Metric {
    name: "distinct_panels",
    column: "distinct_panels",
    unit: "",
    about: "panels of different shape, mirror images being the same, within fabrication.tolerance_m",
    structural: false,
    value: |design| Some(design.distinct.panels as f64),
};

/// Kinds of nodes.
pub const DISTINCT_NODES: Metric = Metric {
    name: "distinct_nodes",
    column: "distinct_nodes",
    unit: "",
    about: "nodes at which members meet under different angles, mirror images being the same, within fabrication.tolerance_m at 1 m",
    structural: false,
    value: |design| Some(design.distinct.nodes as f64),
};

/// Cost by unit figures.
pub const COST: Metric = Metric {
    name: "cost",
    column: "cost",
    unit: "",
    about: "cost by the unit figures of [fabrication], in their currency; none without them",
    structural: false,
    value: |design| sum(design, &design.figures.cost()),
};

/// Carbon by unit figures.
pub const CARBON: Metric = Metric {
    name: "carbon",
    column: "carbon_kg",
    unit: "kg",
    about: "CO₂ equivalent by the unit figures of [fabrication.carbon]; none without them",
    structural: false,
    value: |design| sum(design, &design.figures.carbon),
};

/// The sum over all that has a figure; none where nothing has, or the mass is not known that is asked for.
fn sum(design: &AnalysedDesign, figures: &UnitFigures) -> Option<f64> {
    if figures.is_empty() {
        return None;
    }
    let steel = match figures.steel_per_kg > 0.0 {
        true => figures.steel_per_kg * design.response?.mass_kg,
        false => 0.0,
    };
    let (made, distinct) = (design.fabrication, design.distinct);
    let each = [
        (figures.member_each, made.members),
        (figures.panel_each, made.panels),
        (figures.node_each, made.nodes),
        (figures.distinct_member_each, distinct.members),
        (figures.distinct_panel_each, distinct.panels),
        (figures.distinct_node_each, distinct.nodes),
    ];
    let pieces: f64 = each.into_iter().map(|(figure, count)| figure * count as f64).sum();
    let glass = figures.glass_per_m2 * made.panel_area_mean * made.panels as f64;
    Some(steel + glass + pieces)
}
