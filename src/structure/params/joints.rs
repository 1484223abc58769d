//! How members are joined to their nodes: keys of the config and of `frame` models alike.

use crate::structure::model::{EndJoint, Joint};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How an end of a member is joined to its node against rotation about one of its axes: `"rigid"`, `"hinge"`, or a spring.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    untagged,
    deny_unknown_fields,
    expecting = "expected \"rigid\", \"hinge\", { ei_per_l = … } (bending), { gj_per_l = … } (torsion) or { nm_per_rad = … }"
)]
pub enum JointParams {
    /// `"rigid"` or `"hinge"`.
    Word(JointWord),
    /// A spring measured by the bending stiffness of the member.
    Bending {
        /// Stiffness in EI/L of the member, L being its length between nodes of the pattern.
        #[schemars(extend("minimum" = 0))]
        ei_per_l: f64,
    },
    /// A spring measured by the torsional stiffness of the member.
    Torsion {
        /// Stiffness in GJ/L of the member.
        #[schemars(extend("minimum" = 0))]
        gj_per_l: f64,
    },
    /// A spring of given stiffness.
    Absolute {
        /// Stiffness, in Nm/rad.
        #[schemars(extend("minimum" = 0))]
        nm_per_rad: f64,
    },
}

/// A joint that needs no number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum JointWord {
    /// The end turns with the node.
    Rigid,
    /// The end turns freely.
    Hinge,
}

impl Default for JointParams {
    fn default() -> Self {
        Self::Word(JointWord::Rigid)
    }
}

impl JointParams {
    /// Whether the end turns with its node.
    pub fn is_rigid(&self) -> bool {
        *self == Self::default()
    }

    fn joint(self) -> Joint {
        match self {
            Self::Word(JointWord::Rigid) => Joint::Rigid,
            Self::Word(JointWord::Hinge) => Joint::HINGE,
            Self::Bending { ei_per_l: times } | Self::Torsion { gj_per_l: times } => Joint::Relative(times),
            Self::Absolute { nm_per_rad } => Joint::Absolute(nm_per_rad),
        }
    }
}

/// The joint of a member's end to its node, about the member's own axes; what is left out is rigid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    default,
    deny_unknown_fields,
    expecting = "an object with the keys bending_y, bending_z and torsion, or some of them"
)]
pub struct EndJointParams {
    /// About the axis across the member in the surface: bending out of the surface.
    #[serde(skip_serializing_if = "JointParams::is_rigid")]
    pub bending_y: JointParams,
    /// About the axis along the section's height: bending in the surface.
    #[serde(skip_serializing_if = "JointParams::is_rigid")]
    pub bending_z: JointParams,
    /// About the member itself.
    #[serde(skip_serializing_if = "JointParams::is_rigid")]
    pub torsion: JointParams,
}

impl EndJointParams {
    /// Whether it is rigid about all axes.
    pub fn is_rigid(&self) -> bool {
        *self == Self::default()
    }

    /// What is wrong with it, by key.
    pub fn problem(&self) -> Option<(&'static str, String)> {
        let about = [("bending_y", self.bending_y), ("bending_z", self.bending_z), ("torsion", self.torsion)];
        about.into_iter().find_map(|(key, joint)| {
            let (name, value) = match joint {
                JointParams::Word(_) => return None,
                JointParams::Bending { ei_per_l } if key != "torsion" => ("ei_per_l", ei_per_l),
                JointParams::Bending { .. } => {
                    return Some((key, "of torsion it is gj_per_l, not ei_per_l".into()));
                }
                JointParams::Torsion { gj_per_l } if key == "torsion" => ("gj_per_l", gj_per_l),
                JointParams::Torsion { .. } => {
                    return Some((key, "of bending it is ei_per_l, not gj_per_l".into()));
                }
                JointParams::Absolute { nm_per_rad } => ("nm_per_rad", nm_per_rad),
            };
            let allowed = value >= 0.0 && value.is_finite();
            (!allowed).then(|| (key, format!("{name} = {value} must be 0 or more; a rigid one is \"rigid\"")))
        })
    }

    /// The joint of an element that is one of `pieces` of the member: EI/L is that of the member.
    pub fn joint(&self, pieces: u32) -> EndJoint {
        let of = |joint: JointParams| match joint.joint() {
            Joint::Relative(times) => Joint::Relative(times / f64::from(pieces)),
            other => other,
        };
        EndJoint { torsion: of(self.torsion), bending_y: of(self.bending_y), bending_z: of(self.bending_z) }
    }
}
