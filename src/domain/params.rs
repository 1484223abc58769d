//! The `[domain]` table of the config.

pub use crate::io::LengthUnit;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Boundary loops and symmetries of the domain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DomainParams {
    /// Symmetries of boundary, surface, supports and loads that make two designs the same: `mirror-x`, `mirror-y`, `rotate-180`.
    #[serde(default)]
    pub symmetries: Vec<Symmetry>,
    /// Where no loop has a corner: the point of the outer loop, in metres, at which the pattern is held from turning; the closest
    /// point of the loop counts. Default: its point of largest x.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mark_m: Option<[f64; 2]>,
    /// Boundary loops; the first is the outer one.
    #[serde(rename = "loop")]
    #[schemars(extend("minItems" = 1))]
    pub loops: Vec<LoopParams>,
}

impl DomainParams {
    /// The files that it names.
    pub fn files(&self) -> Vec<PathBuf> {
        let file = |boundary_loop: &LoopParams| match boundary_loop {
            LoopParams::Obj { file, .. } => Some(file.clone()),
            _ => None,
        };
        self.loops.iter().filter_map(file).collect()
    }
}

/// A symmetry of the domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Symmetry {
    /// x → −x about the middle of the domain.
    MirrorX,
    /// y → −y about the middle of the domain.
    MirrorY,
    /// Half a turn about the middle of the domain.
    #[serde(rename = "rotate-180")]
    Rotate180,
}

impl Symmetry {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::MirrorX, Self::MirrorY, Self::Rotate180];
}

/// One boundary loop. Points are `[x, y]` or `[x, y, z]`, in metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum LoopParams {
    /// A closed polyline; the last point is joined to the first.
    Polyline {
        /// The points, in metres.
        #[schemars(extend("minItems" = 3))]
        points_m: Vec<Vec<f64>>,
        /// Which points are corners.
        #[serde(default)]
        corners: Corners,
        /// With `corners = "auto"`: a corner is where the curve turns by more than this within a tenth of the target length, in
        /// degrees.
        #[serde(default = "default_corner_angle")]
        #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 180))]
        corner_angle_deg: f64,
    },
    /// A circle.
    Circle {
        /// The centre, in metres.
        #[schemars(extend("minItems" = 2, "maxItems" = 3))]
        center_m: Vec<f64>,
        /// The radius, in metres.
        #[schemars(extend("exclusiveMinimum" = 0))]
        radius_m: f64,
    },
    /// An ellipse.
    Ellipse {
        /// The centre, in metres.
        #[schemars(extend("minItems" = 2, "maxItems" = 3))]
        center_m: Vec<f64>,
        /// The two semi-axes, in metres.
        #[schemars(extend("exclusiveMinimum" = 0))]
        semi_axes_m: [f64; 2],
        /// Angle of the first axis from x, in degrees.
        #[serde(default)]
        rotation_deg: f64,
    },
    /// A closed polyline (`l`) of an OBJ file.
    Obj {
        /// The file, relative to the config.
        file: PathBuf,
        /// Unit of the file's coordinates: `m` (the default), `cm`, `mm`, `ft` or `in`.
        #[serde(default, skip_serializing_if = "LengthUnit::is_metre")]
        unit: LengthUnit,
        /// Which polyline of the file, from 0.
        #[serde(default)]
        polyline: usize,
        /// Which points are corners.
        #[serde(default = "Corners::auto")]
        corners: Corners,
        /// With `corners = "auto"`: a corner is where the curve turns by more than this within a tenth of the target length, in
        /// degrees.
        #[serde(default = "default_corner_angle")]
        #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 180))]
        corner_angle_deg: f64,
    },
}

/// Which points of a polyline are corners: all, those found by angle, or a list of indices.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Corners {
    /// `"all"` or `"auto"`.
    Rule(CornerRule),
    /// Indices of points, from 0.
    Indices(Vec<usize>),
}

/// The words that [`Corners`] knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CornerRule {
    /// Every point is a corner.
    All,
    /// Places where the curve turns by more than `corner_angle_deg` within a tenth of the target length.
    Auto,
}

impl Corners {
    fn auto() -> Self {
        Self::Rule(CornerRule::Auto)
    }
}

impl Default for Corners {
    fn default() -> Self {
        Self::Rule(CornerRule::All)
    }
}

fn default_corner_angle() -> f64 {
    30.0
}

/// What to do with pinched vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Pinched {
    /// Infeasible.
    Reject,
    /// Allowed.
    Allow,
}
