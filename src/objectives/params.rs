//! The `[fabrication]` table of the config: when pieces are the same, and what they cost.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// When two pieces are the same, and what each costs; carbon has its own figures.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FabricationParams {
    /// Members, panels and nodes that differ by no more than this are of one kind, in metres: of a node 1 m from its centre.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub tolerance_m: f64,
    /// Cost of a kilogram of steel, in the currency of all these figures.
    #[schemars(extend("minimum" = 0))]
    pub steel_per_kg: f64,
    /// Cost of a square metre of panel.
    #[schemars(extend("minimum" = 0))]
    pub glass_per_m2: f64,
    /// Cost of each member.
    #[schemars(extend("minimum" = 0))]
    pub member_each: f64,
    /// Cost of each panel.
    #[schemars(extend("minimum" = 0))]
    pub panel_each: f64,
    /// Cost of each node.
    #[schemars(extend("minimum" = 0))]
    pub node_each: f64,
    /// Cost of each kind of member.
    #[schemars(extend("minimum" = 0))]
    pub distinct_member_each: f64,
    /// Cost of each kind of panel.
    #[schemars(extend("minimum" = 0))]
    pub distinct_panel_each: f64,
    /// Cost of each kind of node.
    #[schemars(extend("minimum" = 0))]
    pub distinct_node_each: f64,
    /// The same figures in kilograms of CO₂ equivalent.
    pub carbon: UnitFigures,
}

impl Default for FabricationParams {
    fn default() -> Self {
        let UnitFigures {
            steel_per_kg,
            glass_per_m2,
            member_each,
            panel_each,
            node_each,
            distinct_member_each,
            distinct_panel_each,
            distinct_node_each,
        } = UnitFigures::default();
        Self {
            tolerance_m: 0.005,
            steel_per_kg,
            glass_per_m2,
            member_each,
            panel_each,
            node_each,
            distinct_member_each,
            distinct_panel_each,
            distinct_node_each,
            carbon: UnitFigures::default(),
        }
    }
}

impl FabricationParams {
    /// The figures of the metric `cost`.
    pub fn cost(&self) -> UnitFigures {
        UnitFigures {
            steel_per_kg: self.steel_per_kg,
            glass_per_m2: self.glass_per_m2,
            member_each: self.member_each,
            panel_each: self.panel_each,
            node_each: self.node_each,
            distinct_member_each: self.distinct_member_each,
            distinct_panel_each: self.distinct_panel_each,
            distinct_node_each: self.distinct_node_each,
        }
    }

    /// Whether nothing is said.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// What a kilogram, a square metre and a piece count; 0 where nothing is given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct UnitFigures {
    /// Of a kilogram of steel.
    #[schemars(extend("minimum" = 0))]
    pub steel_per_kg: f64,
    /// Of a square metre of panel.
    #[schemars(extend("minimum" = 0))]
    pub glass_per_m2: f64,
    /// Of each member.
    #[schemars(extend("minimum" = 0))]
    pub member_each: f64,
    /// Of each panel.
    #[schemars(extend("minimum" = 0))]
    pub panel_each: f64,
    /// Of each node.
    #[schemars(extend("minimum" = 0))]
    pub node_each: f64,
    /// Of each kind of member.
    #[schemars(extend("minimum" = 0))]
    pub distinct_member_each: f64,
    /// Of each kind of panel.
    #[schemars(extend("minimum" = 0))]
    pub distinct_panel_each: f64,
    /// Of each kind of node.
    #[schemars(extend("minimum" = 0))]
    pub distinct_node_each: f64,
}

impl UnitFigures {
    /// Whether no figure is given, so that there is nothing to sum.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}
