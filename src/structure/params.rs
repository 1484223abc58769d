//! The `[structure]` table of the config. Defaults are the paper's gridshell.

mod joints;
mod loads;
mod springs;

pub use joints::{EndJointParams, JointParams, JointWord};
pub use loads::{Factor, FactorParams, FactorTable, LoadParams};
pub use springs::StiffnessParams;

use super::model::Direction;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// How the pattern is built, supported, loaded and judged.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StructureParams {
    /// 1 = first order, 2 = second order.
    #[serde(default = "defaults::order")]
    #[schemars(extend("minimum" = 1, "maximum" = 2))]
    pub order: u8,
    /// Relative change of the axial forces at which the second-order iteration of a search stops.
    #[serde(default = "defaults::second_order_tolerance")]
    #[schemars(extend("minimum" = 1e-12, "maximum" = 1e-2))]
    pub second_order_tolerance: f64,
    /// The height of the section: fixed, or sized to the requirements.
    #[serde(default)]
    pub height: HeightParams,
    /// Elements per member: a number, or `"auto"` = ceil(L / (1.5 target length)). Supports stay at the nodes of the pattern.
    #[serde(default)]
    pub elements_per_member: ElementsPerMember,
    /// Timoshenko shear deformation.
    #[serde(default)]
    pub shear_deformation: bool,
    /// The material.
    #[serde(default)]
    pub material: MaterialParams,
    /// How both ends of all members are joined to their nodes; what is left out is rigid.
    #[serde(default, skip_serializing_if = "EndJointParams::is_rigid")]
    pub joints: EndJointParams,
    /// The section, all but its height.
    #[serde(default)]
    pub section: SectionParams,
    /// Which members count for `utilisation`.
    #[serde(default)]
    pub utilisation: UtilisationParams,
    /// Supports; what several entries fix at a node is fixed together.
    #[serde(default = "defaults::supports", rename = "support")]
    #[schemars(extend("minItems" = 1))]
    pub supports: Vec<SupportParams>,
    /// Named load cases.
    #[serde(default = "defaults::loads")]
    pub loads: BTreeMap<String, LoadParams>,
    /// Combinations: for each, the factor of each load case.
    #[serde(default = "defaults::combinations")]
    pub combinations: BTreeMap<String, BTreeMap<String, f64>>,
    /// Requirements, as constraints.
    #[serde(default = "defaults::requirements", rename = "requirement")]
    pub requirements: Vec<RequirementParams>,
}

/// The section's height: fixed or sized.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum HeightParams {
    /// The same given height for all designs.
    Fixed {
        /// Height, in metres.
        #[schemars(extend("exclusiveMinimum" = 0))]
        fixed_m: f64,
    },
    /// The least height that meets all requirements.
    Sized {
        /// Smallest height tried, in metres.
        #[schemars(extend("exclusiveMinimum" = 0))]
        min_m: f64,
        /// Largest height tried, in metres.
        #[schemars(extend("exclusiveMinimum" = 0))]
        max_m: f64,
        /// Step of the rounded height shown to people, in metres.
        #[schemars(extend("exclusiveMinimum" = 0))]
        step_m: f64,
    },
}

impl Default for HeightParams {
    fn default() -> Self {
        Self::Fixed { fixed_m: 0.45 }
    }
}

/// Into how many elements a member is split.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ElementsPerMember {
    /// This many.
    Number(#[schemars(range(min = 1, max = 100))] u32),
    /// The word `"auto"`.
    Word(Auto),
}

/// The word `"auto"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Auto {
    /// Chosen by the program.
    Auto,
}

impl Default for ElementsPerMember {
    fn default() -> Self {
        Self::Number(1)
    }
}

/// A linear-elastic material. Default: steel S355.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MaterialParams {
    /// Young's modulus E, in Pa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub youngs_modulus_pa: f64,
    /// Poisson's ratio ν; 0.5 is a material that keeps its volume.
    #[schemars(extend("exclusiveMinimum" = -1, "maximum" = 0.5))]
    pub poisson: f64,
    /// Density, in kg/m³.
    #[schemars(extend("minimum" = 0))]
    pub density_kg_m3: f64,
    /// Yield strength fy, in Pa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub yield_pa: f64,
    /// Partial factor γM0.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub gamma_m0: f64,
    /// Linear thermal expansion α, in 1/K, for loads of temperature.
    #[serde(skip_serializing_if = "is_of_steel")]
    pub thermal_expansion_per_k: f64,
}

/// α of steel, 1/K (EN 1993-1-1, 3.2.6).
const STEEL: f64 = 1.2e-5;

fn is_of_steel(thermal_expansion: &f64) -> bool {
    *thermal_expansion == STEEL
}

impl Default for MaterialParams {
    fn default() -> Self {
        Self {
            youngs_modulus_pa: 210e9,
            poisson: 0.3,
            density_kg_m3: 7850.0,
            yield_pa: 355e6,
            gamma_m0: 1.0,
            thermal_expansion_per_k: STEEL,
        }
    }
}

/// A section but for its height. All lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum SectionParams {
    /// A rectangular hollow section.
    Box {
        /// Width, in metres.
        #[schemars(extend("exclusiveMinimum" = 0))]
        width_m: f64,
        /// Wall thickness, in metres.
        #[schemars(extend("exclusiveMinimum" = 0))]
        thickness_m: f64,
    },
    /// A solid round bar; its diameter is the height.
    Round {},
    /// A round tube; its outer diameter is the height.
    Tube {
        /// Wall thickness, in metres.
        #[schemars(extend("exclusiveMinimum" = 0))]
        thickness_m: f64,
    },
    /// Any section, by its properties about its own axes: y across, z along the surface normal. Its height is fixed.
    Properties {
        /// Width in plan, in metres: what the shortest buildable member is judged by.
        #[schemars(extend("exclusiveMinimum" = 0))]
        width_m: f64,
        /// Area A, in m².
        #[schemars(extend("exclusiveMinimum" = 0))]
        area_m2: f64,
        /// Second moment of area about y (bending out of the surface), in m⁴.
        #[schemars(extend("exclusiveMinimum" = 0))]
        iy_m4: f64,
        /// Second moment of area about z (bending in the surface), in m⁴.
        #[schemars(extend("exclusiveMinimum" = 0))]
        iz_m4: f64,
        /// Torsion constant J, in m⁴.
        #[schemars(extend("exclusiveMinimum" = 0))]
        j_m4: f64,
        /// Elastic modulus about y, in m³.
        #[schemars(extend("exclusiveMinimum" = 0))]
        wy_m3: f64,
        /// Elastic modulus about z, in m³.
        #[schemars(extend("exclusiveMinimum" = 0))]
        wz_m3: f64,
        /// Shear area along y, in m², for `shear_deformation`; 0 = rigid in shear.
        #[serde(default)]
        #[schemars(extend("minimum" = 0))]
        asy_m2: f64,
        /// Shear area along z, in m²; 0 = rigid in shear.
        #[serde(default)]
        #[schemars(extend("minimum" = 0))]
        asz_m2: f64,
    },
}

impl SectionParams {
    /// The number that was given and is not greater than 0, if any, by its key.
    pub(crate) fn not_positive(&self) -> Option<(&'static str, f64)> {
        let given: Vec<(&'static str, f64)> = match *self {
            Self::Box { width_m, thickness_m } => vec![("width_m", width_m), ("thickness_m", thickness_m)],
            Self::Tube { thickness_m } => vec![("thickness_m", thickness_m)],
            Self::Round {} => vec![],
            Self::Properties { width_m, area_m2, iy_m4, iz_m4, j_m4, wy_m3, wz_m3, .. } => vec![
                ("width_m", width_m),
                ("area_m2", area_m2),
                ("iy_m4", iy_m4),
                ("iz_m4", iz_m4),
                ("j_m4", j_m4),
                ("wy_m3", wy_m3),
                ("wz_m3", wz_m3),
            ],
        };
        given.into_iter().find(|(_, value)| !(*value > 0.0 && value.is_finite()))
    }
}

impl Default for SectionParams {
    fn default() -> Self {
        Self::Box { width_m: 0.25, thickness_m: 0.02 }
    }
}

/// Which members count for `utilisation` (`utilisation_all` always counts all).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UtilisationParams {
    /// Zones left to the detail of the support.
    #[serde(default)]
    pub exclude: Vec<ExcludeParams>,
}

/// One excluded zone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ExcludeParams {
    /// Around every corner of loop 0.
    pub corners: bool,
    /// Radius about the corner, in metres; a member with either end within it is left out.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius_m: f64,
}

/// One support rule.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SupportParams {
    /// `"boundary"`: all boundary nodes; `"corners"`: the corners of loop 0; `"all"`: every node. Or give `loop`, `nodes_near_m`,
    /// `sides_near_m` or `inside_near_m`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-instead" = "loop = 0, 1, … instead of at, or nodes_near_m, sides_near_m or inside_near_m"))]
    pub at: Option<SupportPlace>,
    /// All nodes of this boundary loop, from 0.
    #[serde(default, rename = "loop", skip_serializing_if = "Option::is_none")]
    pub boundary_loop: Option<usize>,
    /// For each of these points `[x, y]`, in metres, the boundary node closest to it in plan: at a corner the corner itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minItems" = 1))]
    pub nodes_near_m: Option<Vec<[f64; 2]>>,
    /// For each of these points `[x, y]`, in metres, all nodes of the side closest to it in plan; a side is the stretch of a loop from
    /// one corner to the next, both included, or the whole of a loop with fewer than two corners.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minItems" = 1))]
    pub sides_near_m: Option<Vec<[f64; 2]>>,
    /// For each of these points `[x, y]`, in metres, the node inside the roof closest to it in plan: a column. A design without one
    /// within half a target length fails.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minItems" = 1))]
    pub inside_near_m: Option<Vec<[f64; 2]>>,
    /// What is fixed: of `ux`, `uy`, `uz`, `rx`, `ry`, `rz`. May be left out beside `stiffness`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fixed: Vec<Direction>,
    /// Springs in directions that are not fixed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<StiffnessParams>,
}

/// Where one support rule holds: what its keys say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SupportNodes<'a> {
    /// A place that every pattern has.
    Place(SupportPlace),
    /// All nodes of a boundary loop.
    Loop(usize),
    /// The boundary nodes closest to points in plan, m.
    NodesNear(&'a [[f64; 2]]),
    /// The sides closest to points in plan, m.
    SidesNear(&'a [[f64; 2]]),
    /// The nodes inside closest to points in plan, m.
    InsideNear(&'a [[f64; 2]]),
}

impl SupportParams {
    /// What it does in each direction: fixed, and the spring where not, N/m and Nm/rad.
    pub fn holds(&self) -> ([bool; 6], [f64; 6]) {
        let fixed = Direction::ALL.map(|direction| self.fixed.contains(&direction));
        let springs = self.stiffness.unwrap_or_default().values();
        (fixed, std::array::from_fn(|d| if fixed[d] { 0.0 } else { springs[d] }))
    }

    /// What the rule's keys name, each by its key: just one in a config that was checked.
    pub fn nodes(&self) -> Vec<(&'static str, SupportNodes<'_>)> {
        let at = self.at.map(|place| ("at", SupportNodes::Place(place)));
        let label = self.boundary_loop.map(|k| ("loop", SupportNodes::Loop(k)));
        let nodes = self.nodes_near_m.as_ref().map(|p| ("nodes_near_m", SupportNodes::NodesNear(p)));
        let sides = self.sides_near_m.as_ref().map(|p| ("sides_near_m", SupportNodes::SidesNear(p)));
        let inside = self.inside_near_m.as_ref().map(|p| ("inside_near_m", SupportNodes::InsideNear(p)));
        [at, label, nodes, sides, inside].into_iter().flatten().collect()
    }
}

/// Where a support is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SupportPlace {
    /// All boundary nodes.
    Boundary,
    /// The corners of loop 0.
    Corners,
    /// Every node.
    All,
}

/// One requirement; either `max` or `min`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RequirementParams {
    /// What is limited: a metric, by its name or its column (`uplift`, `uplift_kn`).
    pub quantity: Limited,
    /// The combination it is taken from, where loads make the metric: needed, but for uplift and support_slide, which without it are
    /// taken as in the tables. Other metrics have none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub combination: Option<String>,
    /// Upper limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub max: Option<f64>,
    /// Lower limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub min: Option<f64>,
}

impl RequirementParams {
    /// The quantity of the analysis that is limited; none where it is another metric.
    pub fn analysed(&self) -> Option<Quantity> {
        match self.quantity {
            Limited::Quantity(quantity) => Some(quantity),
            Limited::Metric(_) => None,
        }
    }
}

/// What a requirement limits. Written and read as the name.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(from = "String", into = "String")]
#[schemars(with = "String")]
pub enum Limited {
    /// What loads make, and the analysis tells of each combination.
    Quantity(Quantity),
    /// Any other metric, by its name or its column; which there are this module does not know.
    Metric(String),
}

impl From<Quantity> for Limited {
    fn from(quantity: Quantity) -> Self {
        Self::Quantity(quantity)
    }
}

impl From<String> for Limited {
    fn from(name: String) -> Self {
        let named = Quantity::ALL.into_iter().find(|q| q.name() == name || q.column() == name);
        named.map_or(Self::Metric(name), Self::Quantity)
    }
}

impl From<Limited> for String {
    fn from(limited: Limited) -> Self {
        limited.to_string()
    }
}

impl std::fmt::Display for Limited {
    /// The name in the config.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Quantity(quantity) => f.write_str(quantity.name()),
            Self::Metric(name) => f.write_str(name),
        }
    }
}

/// What the analysis tells of each combination, and a requirement can limit there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Largest resultant displacement of a node, m.
    Deflection,
    /// Largest vertical displacement of a node, m.
    DeflectionVertical,
    /// Elastic utilisation outside the excluded zones.
    Utilisation,
    /// Elastic utilisation of all members.
    UtilisationAll,
    /// Von Mises utilisation outside the excluded zones.
    UtilisationVonMises,
    /// First positive linear buckling factor.
    BucklingFactor,
    /// Its inverse; 0 where nothing buckles.
    Buckling,
    /// Largest pull on a support, kN.
    Uplift,
    /// Largest horizontal movement of a supported node, m.
    SupportSlide,
}

/// Quantities that are told of the same combinations where only one of them is limited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Displacements.
    Deflections,
    /// Stresses beside the strength.
    Utilisations,
    /// Buckling factors.
    Buckling,
    /// Reactions.
    Reactions,
}

impl Family {
    /// The combination that is usual for it, where no requirement names one; all where none is.
    pub fn usual(self) -> Option<&'static str> {
        match self {
            Self::Deflections => Some("sls"),
            Self::Utilisations | Self::Buckling => Some("uls"),
            Self::Reactions => None,
        }
    }
}

impl Quantity {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Deflection,
        Self::DeflectionVertical,
        Self::Utilisation,
        Self::UtilisationAll,
        Self::UtilisationVonMises,
        Self::BucklingFactor,
        Self::Buckling,
        Self::Uplift,
        Self::SupportSlide,
    ];

    /// What it is a kind of.
    pub fn family(self) -> Family {
        match self {
            Self::Deflection | Self::DeflectionVertical | Self::SupportSlide => Family::Deflections,
            Self::Utilisation | Self::UtilisationAll | Self::UtilisationVonMises => Family::Utilisations,
            Self::BucklingFactor | Self::Buckling => Family::Buckling,
            Self::Uplift => Family::Reactions,
        }
    }

    /// The name of its metric.
    pub fn name(self) -> &'static str {
        match self {
            Self::Deflection => "deflection",
            Self::DeflectionVertical => "deflection_vertical",
            Self::Utilisation => "utilisation",
            Self::UtilisationAll => "utilisation_all",
            Self::UtilisationVonMises => "utilisation_von_mises",
            Self::BucklingFactor => "buckling_factor",
            Self::Buckling => "buckling",
            Self::Uplift => "uplift",
            Self::SupportSlide => "support_slide",
        }
    }

    /// The column of its metric, with the unit.
    pub fn column(self) -> &'static str {
        match self {
            Self::Deflection => "deflection_m",
            Self::DeflectionVertical => "deflection_vertical_m",
            Self::Uplift => "uplift_kn",
            Self::SupportSlide => "support_slide_m",
            other => other.name(),
        }
    }

    /// Whether a requirement must name its combination.
    pub fn needs_combination(self) -> bool {
        !matches!(self, Self::Uplift | Self::SupportSlide)
    }

    /// Whether it is better the larger it is.
    pub fn better_large(self) -> bool {
        self == Self::BucklingFactor
    }

    /// Whether a larger section brings it nearer to its limit, so that one can be sized for it. A pull on a support is the loads' doing:
    /// it is asked of the section found.
    pub fn is_sized_for(self) -> bool {
        self != Self::Uplift
    }
}

impl std::fmt::Display for Quantity {
    /// The name in the config.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

mod defaults {
    use super::*;

    pub fn order() -> u8 {
        2
    }

    pub fn second_order_tolerance() -> f64 {
        1e-6
    }

    pub fn supports() -> Vec<SupportParams> {
        let support = |at, fixed: &[Direction]| SupportParams {
            at: Some(at),
            fixed: fixed.to_vec(),
            ..SupportParams::default()
        };
        vec![
            support(SupportPlace::Boundary, &[Direction::Uz]),
            support(SupportPlace::Corners, &[Direction::Ux, Direction::Uy]),
        ]
    }

    pub fn loads() -> BTreeMap<String, LoadParams> {
        BTreeMap::from([
            ("self_weight".into(), LoadParams::Gravity { g_m_s2: loads::gravity() }),
            ("glass".into(), LoadParams::Area { down_pa: 600.0, factor: None }),
            ("snow".into(), LoadParams::Projected { down_pa: 500.0, factor: None }),
        ])
    }

    pub fn combinations() -> BTreeMap<String, BTreeMap<String, f64>> {
        let combination = |dead: f64, snow: f64| {
            BTreeMap::from([("self_weight".into(), dead), ("glass".into(), dead), ("snow".into(), snow)])
        };
        BTreeMap::from([("sls".into(), combination(1.0, 1.0)), ("uls".into(), combination(1.35, 1.5))])
    }

    pub fn requirements() -> Vec<RequirementParams> {
        let requirement = |quantity: Quantity, combination: &str, max, min| RequirementParams {
            quantity: quantity.into(),
            combination: Some(combination.into()),
            max,
            min,
        };
        vec![
            requirement(Quantity::Deflection, "sls", Some(0.140), None),
            requirement(Quantity::Utilisation, "uls", Some(1.0), None),
            requirement(Quantity::BucklingFactor, "uls", None, Some(4.0)),
        ]
    }
}
