//! The config: one TOML file that composes the parameters of all stages.
//!
//! [`ResolvedConfig`] reads it, checks keys, types and ranges against the schema derived from the types, then what several
//! keys say together, and fills in defaults. Every refusal names file, line and key, what was found and what is allowed.

mod describe;
mod error;
mod names;
mod path;
mod project;
mod reference;
mod resolved;
mod retired;
mod rules;
mod schema;
mod seeds;
mod source;

pub use describe::{describe, warnings};
pub use error::{ConfigError, Located, Place, Problem};
pub use path::{KeyPath, Segment};
pub use project::{ResolvedConfig, folder_of};
pub use reference::reference;
pub use resolved::{differences, hash, input_files, to_toml};
pub use retired::recorded;
pub use schema::config_schema;

use resolved::read_inputs;

use crate::domain::params::DomainParams;
use crate::geometry::params::PatternParams;
use crate::objectives::params::FabricationParams;
use crate::search::params::{ObjectivesParams, SearchParams};
use crate::skeleton::params::TopologyParams;
use crate::structure::params::StructureParams;
use crate::surface::params::SurfaceParams;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The version of the config format that this program reads.
pub const VERSION: u32 = 1;

/// A whole config.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Config {
    /// Version of the config format; 1.
    #[serde(default = "version")]
    #[schemars(extend("minimum" = 1, "maximum" = 1))]
    pub version: u32,
    /// Name, seed, threads.
    #[serde(default)]
    pub run: RunParams,
    /// Boundary loops and symmetries.
    pub domain: DomainParams,
    /// What carries the pattern.
    #[serde(default = "plane")]
    pub surface: SurfaceParams,
    /// Where strings start and by which rules they grow.
    #[serde(default)]
    pub topology: TopologyParams,
    /// Density, relaxation and limits of the pattern.
    #[serde(default)]
    pub pattern: PatternParams,
    /// The frame analysis; without this table there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub structure: Option<StructureParams>,
    /// When pieces are the same, and what they cost.
    #[serde(default, skip_serializing_if = "FabricationParams::is_default")]
    pub fabrication: FabricationParams,
    /// What is minimised, and maximised.
    #[serde(default)]
    pub objectives: ObjectivesParams,
    /// How strings are bred.
    #[serde(default)]
    pub search: SearchParams,
}

/// The `[run]` table: nothing here changes what a design is worth.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RunParams {
    /// Name of the run; results go to `results/<name>/`. Default: the name of the config file, with `_` for what no folder's name can
    /// have.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Seed of all chance; drawn, printed and recorded if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("maximum" = 9_007_199_254_740_991u64))]
    pub seed: Option<u64>,
    /// Number of threads; 0 = all cores. Results do not depend on it.
    #[schemars(extend("maximum" = 1024))]
    pub threads: usize,
}

fn version() -> u32 {
    VERSION
}

fn plane() -> SurfaceParams {
    SurfaceParams::Plane { z_m: 0.0 }
}
