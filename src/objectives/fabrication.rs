//! Measures of the dense pattern (docs/reference/geometry.md §3).

use super::{AnalysedDesign, Metric};

/// A measure of quad panels; a pattern of triangles alone has none.
fn of_quads(design: &AnalysedDesign, value: f64) -> Option<f64> {
    (design.fabrication.panels > design.fabrication.triangles).then_some(value)
}

/// C of the paper.
pub const CURVATURE: Metric = Metric {
    name: "curvature",
    column: "curvature",
    unit: "",
    about: "C: mean over quad panels of the corners' distance from the best-fit plane, relative to the panel's size",
    structural: false,
    value: |design| of_quads(design, design.fabrication.curvature),
};

/// S of the paper.
pub const SKEWNESS: Metric = Metric {
    name: "skewness",
    column: "skewness",
    unit: "",
    about: "S: mean over quad panels of the largest deviation of a corner from 90°, relative to 90°",
    structural: false,
    value: |design| of_quads(design, design.fabrication.skewness),
};

/// L of the paper.
pub const EDGE_SPREAD: Metric = Metric {
    name: "edge_spread",
    column: "edge_spread_m",
    unit: "m",
    about: "L: standard deviation of the edge lengths",
    structural: false,
    value: |design| Some(design.fabrication.edge_spread),
};

/// Total length.
pub const MEMBER_LENGTH: Metric = Metric {
    name: "member_length",
    column: "member_length_m",
    unit: "m",
    about: "total length of the members",
    structural: false,
    value: |design| Some(design.fabrication.member_length),
};

/// Mean edge.
pub const EDGE_MEAN: Metric = Metric {
    name: "edge_mean",
    column: "edge_mean_m",
    unit: "m",
    about: "mean edge length",
    structural: false,
    value: |design| Some(design.fabrication.edge_mean),
};

/// Shortest edge.
pub const EDGE_MIN: Metric = Metric {
    name: "edge_min",
    column: "edge_min_m",
    unit: "m",
    about: "shortest edge",
    structural: false,
    value: |design| Some(design.fabrication.edge_min),
};

/// Longest edge.
pub const EDGE_MAX: Metric = Metric {
    name: "edge_max",
    column: "edge_max_m",
    unit: "m",
    about: "longest edge",
    structural: false,
    value: |design| Some(design.fabrication.edge_max),
};

/// Mean panel.
pub const PANEL_AREA_MEAN: Metric = Metric {
    name: "panel_area_mean",
    column: "panel_area_mean_m2",
    unit: "m²",
    about: "mean panel area",
    structural: false,
    value: |design| Some(design.fabrication.panel_area_mean),
};

/// Spread of the panels.
pub const PANEL_AREA_SPREAD: Metric = Metric {
    name: "panel_area_spread",
    column: "panel_area_spread_m2",
    unit: "m²",
    about: "standard deviation of the panel areas",
    structural: false,
    value: |design| Some(design.fabrication.panel_area_spread),
};

/// Largest panel.
pub const PANEL_AREA_MAX: Metric = Metric {
    name: "panel_area_max",
    column: "panel_area_max_m2",
    unit: "m²",
    about: "largest panel",
    structural: false,
    value: |design| Some(design.fabrication.panel_area_max),
};

/// Mean aspect ratio.
pub const ASPECT_RATIO: Metric = Metric {
    name: "aspect_ratio",
    column: "aspect_ratio",
    unit: "",
    about: "mean over panels of longest ÷ shortest edge",
    structural: false,
    value: |design| Some(design.fabrication.aspect_mean),
};

/// Largest aspect ratio.
pub const ASPECT_RATIO_MAX: Metric = Metric {
    name: "aspect_ratio_max",
    column: "aspect_ratio_max",
    unit: "",
    about: "largest of longest ÷ shortest edge of a panel",
    structural: false,
    value: |design| Some(design.fabrication.aspect_max),
};

/// Planarity by diagonals.
pub const PLANARITY: Metric = Metric {
    name: "planarity",
    column: "planarity",
    unit: "",
    about: "mean over quad panels of the distance between the diagonals ÷ their mean length",
    structural: false,
    value: |design| of_quads(design, design.fabrication.planarity),
};

/// Largest planarity.
pub const PLANARITY_MAX: Metric = Metric {
    name: "planarity_max",
    column: "planarity_max",
    unit: "",
    about: "largest planarity of a panel",
    structural: false,
    value: |design| of_quads(design, design.fabrication.planarity_max),
};

/// Largest warp.
pub const PANEL_WARP_MAX: Metric = Metric {
    name: "panel_warp_max",
    column: "panel_warp_max_m",
    unit: "m",
    about: "largest distance of a quad panel's corner from the plane of its other three",
    structural: false,
    value: |design| of_quads(design, design.fabrication.warp_max),
};

/// C weighted by area.
pub const CURVATURE_BY_AREA: Metric = Metric {
    name: "curvature_by_area",
    column: "curvature_by_area",
    unit: "",
    about: "C weighted by panel area",
    structural: false,
    value: |design| of_quads(design, design.fabrication.curvature_by_area),
};

/// Largest C.
pub const CURVATURE_MAX: Metric = Metric {
    name: "curvature_max",
    column: "curvature_max",
    unit: "",
    about: "largest C of a panel",
    structural: false,
    value: |design| of_quads(design, design.fabrication.curvature_max),
};

/// S weighted by area.
pub const SKEWNESS_BY_AREA: Metric = Metric {
    name: "skewness_by_area",
    column: "skewness_by_area",
    unit: "",
    about: "S weighted by panel area",
    structural: false,
    value: |design| of_quads(design, design.fabrication.skewness_by_area),
};

/// Largest S.
pub const SKEWNESS_MAX: Metric = Metric {
    name: "skewness_max",
    column: "skewness_max",
    unit: "",
    about: "largest S of a panel",
    structural: false,
    value: |design| of_quads(design, design.fabrication.skewness_max),
};

/// Smallest angle.
pub const ANGLE_MIN: Metric = Metric {
    name: "angle_min",
    column: "angle_min_deg",
    unit: "°",
    about: "smallest panel angle",
    structural: false,
    value: |design| Some(design.fabrication.angle_min.to_degrees()),
};

/// Reflex corners.
pub const REFLEX_CORNERS: Metric = Metric {
    name: "reflex_corners",
    column: "reflex_corners",
    unit: "",
    about: "panel corners over 180°",
    structural: false,
    value: |design| Some(design.fabrication.reflex_corners as f64),
};

/// How far the boundary is off.
pub const BOUNDARY_GAP: Metric = Metric {
    name: "boundary_gap",
    column: "boundary_gap_m",
    unit: "m",
    about: "farthest that the domain's boundary lies from the pattern's in plan",
    structural: false,
    value: |design| Some(design.fabrication.boundary_gap),
};

/// How much of the plan is covered.
pub const AREA_COVERED: Metric = Metric {
    name: "area_covered",
    column: "area_covered",
    unit: "",
    about: "plan area of the pattern ÷ that of the domain",
    structural: false,
    value: |design| Some(design.fabrication.area_covered),
};
