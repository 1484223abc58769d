//! What is minimised and reported: every number of a design, in one visible list.
//!
//! A metric knows its name in the config, its CSV column (with unit), its meaning, and how to read it off an
//! analysed design. A new one is one constant in a file of this folder and its line in [`METRICS`].

mod fabrication;
mod limit;
mod making;
mod objective;
pub mod params;
mod structural;
mod topological;

pub use limit::limit;
pub use objective::Objective;

use crate::geometry::distinct::Distinct;
use crate::geometry::metrics::Fabrication;
use crate::mesh::CanonicalMesh;
use crate::structure::gridshell::{Governing, Response};
use params::FabricationParams;

/// A design after all stages: what metrics are read from.
#[derive(Clone, Copy, Debug)]
pub struct AnalysedDesign<'a> {
    /// The canonical coarse mesh.
    pub topology: &'a CanonicalMesh,
    /// The measures of the dense pattern.
    pub fabrication: &'a Fabrication,
    /// How many different pieces it has.
    pub distinct: &'a Distinct,
    /// What pieces cost.
    pub figures: &'a FabricationParams,
    /// The answer of the structure; absent where none is configured.
    pub response: Option<&'a Response>,
}

/// One number of a design.
#[derive(Clone, Copy, Debug)]
pub struct Metric {
    /// Its name in `[objectives]`.
    pub name: &'static str,
    /// Its column in the CSV files, with the unit.
    pub column: &'static str,
    /// Its unit as people write it; empty for a pure number.
    pub unit: &'static str,
    /// What it is, in one line.
    pub about: &'static str,
    /// Whether it needs a structural analysis.
    pub structural: bool,
    /// Its value; `None` where it does not exist (an infinite buckling factor, skewness without quads).
    pub value: fn(&AnalysedDesign) -> Option<f64>,
}

/// Every metric, in the order of the CSV columns.
pub const METRICS: &[&Metric] = &[
    &structural::MASS,
    &structural::DEFLECTION,
    &structural::UTILISATION,
    &structural::BUCKLING,
    &fabrication::CURVATURE,
    &fabrication::SKEWNESS,
    &fabrication::EDGE_SPREAD,
    &structural::HEIGHT,
    &structural::BUCKLING_FACTOR,
    &structural::UTILISATION_VON_MISES,
    &structural::UTILISATION_ALL,
    &structural::DEFLECTION_VERTICAL,
    &structural::MASS_PER_AREA,
    &structural::UPLIFT,
    &structural::SUPPORT_SLIDE,
    &topological::FACES,
    &topological::TRIANGLES,
    &topological::NODES,
    &topological::MEMBERS,
    &topological::VALENCE_MAX,
    &fabrication::MEMBER_LENGTH,
    &topological::STRIPS,
    &topological::SINGULARITIES,
    &topological::SINGULARITIES_INNER,
    &topological::SINGULARITIES_BOUNDARY,
    &topological::POLES,
    &fabrication::EDGE_MEAN,
    &fabrication::EDGE_MIN,
    &fabrication::EDGE_MAX,
    &fabrication::PANEL_AREA_MEAN,
    &fabrication::PANEL_AREA_SPREAD,
    &fabrication::PANEL_AREA_MAX,
    &fabrication::ASPECT_RATIO,
    &fabrication::ASPECT_RATIO_MAX,
    &fabrication::PLANARITY,
    &fabrication::PLANARITY_MAX,
    &fabrication::CURVATURE_BY_AREA,
    &fabrication::CURVATURE_MAX,
    &fabrication::SKEWNESS_BY_AREA,
    &fabrication::SKEWNESS_MAX,
    &fabrication::ANGLE_MIN,
    &fabrication::REFLEX_CORNERS,
    &fabrication::BOUNDARY_GAP,
    &fabrication::AREA_COVERED,
    &fabrication::PANEL_WARP_MAX,
    &making::DISTINCT_MEMBERS,
    &making::DISTINCT_PANELS,
    &making::DISTINCT_NODES,
    &making::COST,
    &making::CARBON,
];

/// Whether a metric has a value only of designs that were analysed, with these figures.
pub fn needs_analysis(metric: &Metric, figures: &FabricationParams) -> bool {
    let steel = match metric.name {
        "cost" => figures.steel_per_kg,
        "carbon" => figures.carbon.steel_per_kg,
        _ => 0.0,
    };
    metric.structural || steel > 0.0
}

/// The table of the config without which a metric has no value, where there is one and it says nothing.
pub fn lacks_figures(metric: &Metric, figures: &FabricationParams) -> Option<&'static str> {
    match metric.name {
        "cost" if figures.cost().is_empty() => Some("[fabrication]"),
        "carbon" if figures.carbon.is_empty() => Some("[fabrication.carbon]"),
        _ => None,
    }
}

/// What to minimise instead of a metric that is better large; `None` for all others.
pub fn better_large(name: &str) -> Option<&'static str> {
    match name {
        "buckling_factor" => Some("buckling"),
        "angle_min" => Some("skewness_max"),
        "edge_min" => Some("edge_spread"),
        "area_covered" => Some("boundary_gap"),
        _ => None,
    }
}

/// The columns that say in which combination of loads a metric is taken, and which combination that is.
pub const GOVERNING: [(&str, GoverningOf); 8] = [
    ("deflection_combination", |governing| Some(&governing.deflection)),
    ("utilisation_combination", |governing| Some(&governing.utilisation)),
    ("buckling_combination", |governing| governing.buckling.as_deref()),
    ("deflection_vertical_combination", |governing| Some(&governing.deflection_vertical)),
    ("utilisation_all_combination", |governing| Some(&governing.utilisation_all)),
    ("utilisation_von_mises_combination", |governing| Some(&governing.utilisation_von_mises)),
    ("uplift_combination", |governing| Some(&governing.uplift)),
    ("support_slide_combination", |governing| Some(&governing.support_slide)),
];

/// Reads one combination off those that govern.
pub type GoverningOf = fn(&Governing) -> Option<&str>;

/// The combinations of [`GOVERNING`], in that order; none without an analysis, an empty one where nothing governs.
pub fn governing(design: &AnalysedDesign) -> Vec<String> {
    let Some(response) = design.response else { return Vec::new() };
    GOVERNING.iter().map(|(_, of)| of(&response.governing).unwrap_or_default().to_owned()).collect()
}

/// The metric of a name.
pub fn find(name: &str) -> Option<&'static Metric> {
    METRICS.iter().copied().find(|metric| metric.name == name)
}

/// The metric that is called so: by its name, or by its column with the unit.
pub fn called(name: &str) -> Option<&'static Metric> {
    METRICS.iter().copied().find(|metric| metric.name == name || metric.column == name)
}

/// The metric of a name among values in the order of [`METRICS`], as an evaluation has them; `None` for one that does not exist.
pub fn named(values: &[Option<f64>], name: &str) -> Option<f64> {
    let place = METRICS.iter().position(|metric| metric.name == name)?;
    values.get(place).copied().flatten()
}

/// All metrics of a design, in the order of [`METRICS`]; what is not finite does not exist.
pub fn measure(design: &AnalysedDesign) -> Vec<Option<f64>> {
    METRICS.iter().map(|metric| (metric.value)(design).filter(|value| value.is_finite())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn what_is_better_large_has_a_counterpart_that_is_better_small() {
        let instead: Vec<&str> = METRICS.iter().filter_map(|metric| better_large(metric.name)).collect();
        assert_eq!(instead.len(), 4, "a name of these is no longer that of a metric");
        assert!(instead.iter().all(|name| find(name).is_some() && better_large(name).is_none()));
    }

    #[test]
    fn names_and_columns_are_unique_and_carry_the_unit() {
        let names: BTreeSet<_> = METRICS.iter().map(|metric| metric.name).collect();
        let columns: BTreeSet<_> = METRICS.iter().map(|metric| metric.column).collect();
        assert_eq!((names.len(), columns.len()), (METRICS.len(), METRICS.len()));
        for metric in METRICS {
            let suffix = match metric.unit {
                "" => "",
                "m" => "_m",
                "m²" => "_m2",
                "kg" => "_kg",
                "kg/m²" => "_kg_m2",
                "kN" => "_kn",
                "°" => "_deg",
                other => panic!("{}: no suffix known for {other}", metric.name),
            };
            assert!(metric.column.ends_with(suffix), "{} [{}]", metric.column, metric.unit);
            assert!(metric.column.starts_with(metric.name), "{}", metric.column);
        }
    }
}
