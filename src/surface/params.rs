//! The `[surface]` table of the config.

use crate::io::LengthUnit;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The surface that carries the pattern. All lengths in metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum SurfaceParams {
    /// The British Museum's Great Court roof (Williams 2001; docs/reference/geometry.md §4).
    GreatCourt {},
    /// The horizontal plane z = `z_m`.
    Plane {
        /// Height, in metres.
        #[serde(default)]
        z_m: f64,
    },
    /// A height surface z = f(x, y).
    Height {
        /// The expression in x and y, and the names below.
        expression: String,
        /// Named constants.
        #[serde(default)]
        constants: BTreeMap<String, f64>,
        /// Intermediate names `[name, expression]`, each may use those before it.
        #[serde(default, rename = "let")]
        lets: Vec<[String; 2]>,
    },
    /// z = rise · (1 − ((x − cx)/a)² − ((y − cy)/b)²) + base.
    Paraboloid {
        /// Centre, in metres.
        #[serde(default)]
        center_m: [f64; 2],
        /// The two half spans at which the height has fallen by `rise_m`, in metres.
        #[schemars(extend("exclusiveMinimum" = 0))]
        half_spans_m: [f64; 2],
        /// Height of the top over the base, in metres.
        rise_m: f64,
        /// Height of the base, in metres.
        #[serde(default)]
        base_m: f64,
    },
    /// z = rise · ((x − cx)/a) · ((y − cy)/b) + base.
    Hypar {
        /// Centre, in metres.
        #[serde(default)]
        center_m: [f64; 2],
        /// The two half spans, in metres.
        #[schemars(extend("exclusiveMinimum" = 0))]
        half_spans_m: [f64; 2],
        /// Height at (a, b) over the base, in metres.
        rise_m: f64,
        /// Height of the base, in metres.
        #[serde(default)]
        base_m: f64,
    },
    /// The upper part of a sphere.
    Sphere {
        /// Centre, in metres.
        center_m: [f64; 3],
        /// Radius, in metres.
        #[schemars(extend("exclusiveMinimum" = 0))]
        radius_m: f64,
    },
    /// The upper part of a horizontal cylinder.
    Cylinder {
        /// A point of the axis, in metres.
        center_m: [f64; 3],
        /// Angle of the axis from x, in degrees.
        #[serde(default)]
        axis_deg: f64,
        /// Radius, in metres.
        #[schemars(extend("exclusiveMinimum" = 0))]
        radius_m: f64,
    },
    /// A triangle or quad mesh from an OBJ file with z up: the closest point of what is seen of it from above counts, however faces
    /// are wound; what lies below other faces and walls carry nothing.
    Mesh {
        /// The file, relative to the config.
        file: PathBuf,
        /// Unit of the file's coordinates: `m` (the default), `cm`, `mm`, `ft` or `in`.
        #[serde(default, skip_serializing_if = "LengthUnit::is_metre")]
        unit: LengthUnit,
    },
    /// No surface: the relaxation finds the form (cable net).
    Free {},
}

impl SurfaceParams {
    /// The files that it names.
    pub fn files(&self) -> Vec<PathBuf> {
        match self {
            Self::Mesh { file, .. } => vec![file.clone()],
            _ => Vec::new(),
        }
    }
}
