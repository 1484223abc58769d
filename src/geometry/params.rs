//! The `[pattern]` table of the config.

use crate::domain::{Domain, Grain};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the canonical mesh becomes a dense pattern (docs/reference/geometry.md §2).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PatternParams {
    /// Which rule sets the density of strips.
    pub density: Density,
    /// With `density = "panels"`: the number of panels every design comes as near as it can to.
    #[schemars(extend("minimum" = 1, "maximum" = 10_000_000))]
    pub panels: usize,
    /// With `density = "target_length"`: the edge length, in metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub target_length_m: Option<f64>,
    /// Designs with more panels are refused before any geometry.
    #[schemars(extend("minimum" = 1, "maximum" = 10_000_000))]
    pub max_faces: usize,
    /// How the dense pattern is relaxed.
    pub relax: RelaxParams,
    /// Limits of a pattern that can be built, as constraints.
    pub limits: LimitParams,
    /// Limits on any metric of geometry, as further constraints.
    #[serde(rename = "limit", skip_serializing_if = "Vec::is_empty")]
    pub metric_limits: Vec<MetricLimitParams>,
}

impl Default for PatternParams {
    fn default() -> Self {
        Self {
            density: Density::Panels,
            panels: 2000,
            target_length_m: None,
            max_faces: 20_000,
            relax: RelaxParams::default(),
            limits: LimitParams::default(),
            metric_limits: Vec::new(),
        }
    }
}

impl PatternParams {
    /// How fine the patterns are, as the domain takes it.
    pub fn grain(&self) -> Grain {
        match (self.density, self.target_length_m) {
            (Density::TargetLength, Some(length)) => Grain::Length(length),
            _ => Grain::Panels(self.panels),
        }
    }

    /// Target edge length t of all designs on a domain, m: the given one, or with `density = "panels"` √(A/N) for N panels on the
    /// area A of the surface (docs/reference/geometry.md §2.2).
    pub fn target_length(&self, domain: &Domain) -> f64 {
        self.grain().length(domain.surface_area())
    }
}

/// The rule that sets the density of strips.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Density {
    /// As near as possible to a number of panels.
    Panels,
    /// A given target length.
    TargetLength,
}

/// Sweeps on a free surface where the config does not say.
pub const FREE_SWEEPS: usize = 500;

/// Relaxation of the dense pattern.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RelaxParams {
    /// How vertices are moved; default `optimise`, on a free surface `uniform`.
    pub kind: RelaxKind,
    /// Number of Jacobi sweeps of the smoothing kinds; default 100, on a free surface 500.
    pub sweeps: usize,
    /// Share of the way to the target that each sweep goes, in 0..1.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1))]
    pub damping: f64,
}

impl Default for RelaxParams {
    fn default() -> Self {
        Self { kind: RelaxKind::Optimise, sweeps: 100, damping: 0.5 }
    }
}

/// How a pattern is relaxed: optimised, smoothed with one of three weights (the paper's), or solved for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RelaxKind {
    /// An energy with barriers at the limits, densities and geometry together (docs/reference/geometry.md §6); needs a surface.
    Optimise,
    /// Mean of the neighbours.
    Uniform,
    /// Mean of the centroids of the adjacent panels, weighted by their areas.
    Area,
    /// Cotangent weights (Pinkall, Polthier 1993).
    Cotangent,
    /// Equal force densities, solved directly (Schek 1974).
    ForceDensity,
}

/// One limit on a metric; either `max` or `min`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MetricLimitParams {
    /// A metric that needs no analysis, by its name or its column (`panel_warp_max`, `panel_warp_max_m`).
    pub quantity: String,
    /// Upper limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub max: Option<f64>,
    /// Lower limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub min: Option<f64>,
}

/// Limits of a pattern that can be built.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LimitParams {
    /// Shortest member, in metres; default 2 × section width, without a structure a quarter of the target length.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub min_edge_m: Option<f64>,
    /// Longest member as a multiple of the target length.
    #[schemars(extend("minimum" = 1))]
    pub max_edge_factor: f64,
    /// Smallest panel angle, in degrees.
    #[schemars(extend("minimum" = 0, "exclusiveMaximum" = 90))]
    pub min_angle_deg: f64,
    /// Most members at a node.
    #[schemars(extend("minimum" = 4))]
    pub max_valence: usize,
    /// Fewest members at an inner node: 3 refuses nodes with two members; default 2, off.
    #[schemars(extend("minimum" = 2, "maximum" = 4))]
    pub min_valence: usize,
    /// Largest panel, in m²; no limit if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub max_panel_area_m2: Option<f64>,
    /// Farthest that the boundary may lie from the pattern's, in metres; default a quarter of the target length.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub max_boundary_gap_m: Option<f64>,
}

impl Default for LimitParams {
    fn default() -> Self {
        Self {
            min_edge_m: None,
            max_edge_factor: 2.0,
            min_angle_deg: 20.0,
            max_valence: 8,
            min_valence: 2,
            max_panel_area_m2: None,
            max_boundary_gap_m: None,
        }
    }
}
