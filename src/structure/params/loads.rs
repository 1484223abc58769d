//! Load cases of the config.

use crate::expression::{Expression, ExpressionError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// One load case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum LoadParams {
    /// Self weight of the members, as member loads.
    Gravity {
        /// Acceleration, in m/s².
        #[serde(default = "gravity")]
        #[schemars(extend("minimum" = 0))]
        g_m_s2: f64,
    },
    /// A load on the true area of the panels.
    Area {
        /// Downwards, in Pa.
        down_pa: f64,
        /// By what it is multiplied, panel by panel: `"x > 0"`, or a table with constants and names. Default: 1.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        factor: Option<FactorParams>,
    },
    /// A load on the plan projection of the panels.
    Projected {
        /// Downwards, in Pa.
        down_pa: f64,
        /// By what it is multiplied, panel by panel: `"x > 0"`, or a table with constants and names. Default: 1.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        factor: Option<FactorParams>,
    },
    /// A load normal to the panels: wind.
    Pressure {
        /// Against the normal, which points up where the surface is flat, in Pa; suction is negative.
        pressure_pa: f64,
        /// By what it is multiplied, panel by panel: `"x > 0"`, or a table with constants and names. Default: 1.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        factor: Option<FactorParams>,
    },
    /// All members warmer than when they were built in, evenly.
    Temperature {
        /// By how much, in K; colder is negative.
        kelvin: f64,
    },
    /// Forces on the nodes nearest to points of the plan.
    Point {
        /// The points `[x, y]`, in metres.
        #[schemars(extend("minItems" = 1))]
        points_m: Vec<[f64; 2]>,
        /// The force at each of them, `[x, y, z]`, in N; z is up.
        force_n: [f64; 3],
    },
}

/// By what a load is multiplied: an expression of the middle of a panel, `x`, `y`, `z` (in metres), and of its upward unit normal,
/// `nx`, `ny`, `nz`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum FactorParams {
    /// An expression, with `< > <= >=`, which are 1 where they hold, else 0, and all that an expression of a surface may have.
    Text(String),
    /// The same with constants and names.
    Table(FactorTable),
}

/// An expression with constants and names.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FactorTable {
    /// The expression.
    pub expression: String,
    /// Named constants.
    #[serde(default)]
    pub constants: BTreeMap<String, f64>,
    /// Named intermediate values, `[name, expression]`, each of which may use those before.
    #[serde(default, rename = "let")]
    pub lets: Vec<[String; 2]>,
}

/// What an expression of a factor may use, in order.
const VARIABLES: [&str; 6] = ["x", "y", "z", "nx", "ny", "nz"];

/// A factor that was read.
#[derive(Clone, Debug)]
pub struct Factor(Expression);

impl Factor {
    /// Its value for a panel with this middle, m, and unit normal.
    pub fn at(&self, [x, y, z]: [f64; 3], [nx, ny, nz]: [f64; 3]) -> f64 {
        self.0.value(&[x, y, z, nx, ny, nz])
    }

    /// The text it was read from.
    pub fn text(&self) -> &str {
        self.0.text()
    }
}

impl FactorParams {
    /// Reads the expression.
    ///
    /// # Errors
    /// What cannot be understood, and where.
    pub fn read(&self) -> Result<Factor, ExpressionError> {
        let (none, no_names) = (BTreeMap::new(), Vec::new());
        let (text, constants, lets) = match self {
            Self::Text(text) => (text, &none, &no_names),
            Self::Table(table) => (&table.expression, &table.constants, &table.lets),
        };
        Expression::parse_of(&VARIABLES, text, constants, lets).map(Factor)
    }
}

impl LoadParams {
    /// The factor of a load on panels, if it has one.
    pub fn factor(&self) -> Option<&FactorParams> {
        match self {
            Self::Area { factor, .. } | Self::Projected { factor, .. } | Self::Pressure { factor, .. } => {
                factor.as_ref()
            }
            Self::Gravity { .. } | Self::Temperature { .. } | Self::Point { .. } => None,
        }
    }

    /// Its numbers, each by its key.
    pub(crate) fn numbers(&self) -> Vec<(&'static str, f64)> {
        match self {
            Self::Gravity { g_m_s2 } => vec![("g_m_s2", *g_m_s2)],
            Self::Area { down_pa, .. } | Self::Projected { down_pa, .. } => vec![("down_pa", *down_pa)],
            Self::Pressure { pressure_pa, .. } => vec![("pressure_pa", *pressure_pa)],
            Self::Temperature { kelvin } => vec![("kelvin", *kelvin)],
            Self::Point { points_m, force_n } => {
                let points = points_m.iter().flatten().map(|v| ("points_m", *v));
                points.chain(force_n.iter().map(|v| ("force_n", *v))).collect()
            }
        }
    }
}

/// g, m/s².
pub(super) fn gravity() -> f64 {
    9.81
}
