//! The `[topology]` table of the config.

use crate::domain::Symmetry;
use crate::domain::params::{LengthUnit, Pinched};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// The `[topology]` table: where strings start and by which rules they grow.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TopologyParams {
    /// `"skeleton"`, or `{ file = "…" }`, `{ grid = [m, n] }`, or `{ vertices = […], faces = […] }`.
    pub initial: InitialMesh,
    /// Marker of the initial mesh as two vertices of an edge; default the first dart of face 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub marker: Option<[usize; 2]>,
    /// Symmetries that all patterns are to have: `mirror-x`, `mirror-y`, or both. Strings are then decoded on a half or a quarter of the
    /// initial mesh. Boundary, surface and initial mesh must have them; supports and loads need not, the whole structure is analysed.
    pub symmetry: Vec<MirrorParam>,
    /// `"domain"` or `"plain"` (docs/reference/grammar.md §2.6).
    pub rules: RulesParam,
    /// What to do with pinched boundary vertices (docs/reference/geometry.md §1.4).
    pub pinched: Pinched,
}

impl TopologyParams {
    /// The files that it names.
    pub fn files(&self) -> Vec<PathBuf> {
        match &self.initial {
            InitialMesh::File { file, .. } => vec![file.clone()],
            _ => Vec::new(),
        }
    }
}

impl Default for TopologyParams {
    fn default() -> Self {
        Self {
            initial: InitialMesh::Word(Skeleton::Skeleton),
            marker: None,
            symmetry: Vec::new(),
            rules: RulesParam::Domain,
            pinched: Pinched::Reject,
        }
    }
}

/// A reflection that patterns are to have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MirrorParam {
    /// x → −x about the middle of the domain.
    MirrorX,
    /// y → −y about the middle of the domain.
    MirrorY,
}

impl MirrorParam {
    /// The same as a symmetry of the domain.
    pub fn kind(self) -> Symmetry {
        match self {
            Self::MirrorX => Symmetry::MirrorX,
            Self::MirrorY => Symmetry::MirrorY,
        }
    }
}

/// The initial coarse quad mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum InitialMesh {
    /// The word `"skeleton"`.
    Word(Skeleton),
    /// An OBJ, COMPAS JSON or base-mesh JSON file. Boundary vertices within 1e-4 of the domain's size from its corners take them.
    File {
        /// The file, relative to the config.
        file: PathBuf,
        /// Unit of the file's coordinates: `m` (the default), `cm`, `mm`, `ft` or `in`.
        #[serde(default, skip_serializing_if = "LengthUnit::is_metre")]
        unit: LengthUnit,
    },
    /// A rectangular grid of m × n faces, for a domain with four corners and no hole.
    Grid {
        /// m and n.
        #[schemars(extend("minimum" = 1))]
        grid: [usize; 2],
    },
    /// Written out.
    Inline {
        /// Vertices `[x, y, z]`, in metres.
        vertices: Vec<[f64; 3]>,
        /// Faces, counter-clockwise.
        #[schemars(extend("minItems" = 1))]
        faces: Vec<Vec<usize>>,
        /// For pseudo-quads, face → pole vertex.
        #[serde(default)]
        poles: std::collections::BTreeMap<String, usize>,
    },
}

/// The word `"skeleton"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Skeleton {
    /// Decomposition along the medial axis.
    Skeleton,
}

/// The set of rules (docs/reference/grammar.md §2.6).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RulesParam {
    /// The grammar as it stands.
    Plain,
    /// No flat faces, no vanished sides.
    Domain,
}
