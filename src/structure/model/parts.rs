//! What a model is built from: plain data, checked by [`super::FrameModel::new`].

use crate::structure::section::Section;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// A node of a frame model.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct NodeId(pub u32);

/// A member of a frame model.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct MemberId(pub u32);

impl fmt::Display for NodeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "node {}", self.0)
    }
}

impl fmt::Display for MemberId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "member {}", self.0)
    }
}

/// A linear-elastic material (Pa, kg/m³).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Young's modulus E, Pa.
    pub youngs_modulus: f64,
    /// Shear modulus G, Pa.
    pub shear_modulus: f64,
    /// Density, kg/m³.
    pub density: f64,
    /// Design strength fy / γM0, Pa.
    pub strength: f64,
    /// Linear thermal expansion α, 1/K.
    pub thermal_expansion: f64,
}

/// How stiffly one end of a member is joined to its node against rotation about one axis of the member.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Joint {
    /// The end turns with the node.
    Rigid,
    /// A spring of this many times EI/L of the member (GJ/L in torsion), L being that of the member.
    Relative(f64),
    /// A spring, Nm/rad; 0 is a hinge.
    Absolute(f64),
}

impl Joint {
    /// A hinge.
    pub const HINGE: Self = Self::Absolute(0.0);

    /// Its stiffness beside a member's EI/L (or GJ/L), Nm/rad; infinite where it is rigid.
    pub fn stiffness(self, member: f64) -> f64 {
        match self {
            Self::Rigid => f64::INFINITY,
            Self::Relative(times) => times * member,
            Self::Absolute(stiffness) => stiffness,
        }
    }

    /// Whether it gives way in no way at all.
    pub fn is_rigid(self) -> bool {
        match self {
            Self::Rigid => true,
            Self::Relative(stiffness) | Self::Absolute(stiffness) => stiffness == f64::INFINITY,
        }
    }

    /// Whether it resists nothing.
    pub fn is_hinge(self) -> bool {
        matches!(self, Self::Relative(0.0) | Self::Absolute(0.0))
    }
}

/// The joint of one end of a member to its node, about the member's own axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndJoint {
    /// About x, the member itself.
    pub torsion: Joint,
    /// About y: bending in the x–z plane.
    pub bending_y: Joint,
    /// About z: bending in the x–y plane.
    pub bending_z: Joint,
}

impl EndJoint {
    /// Rigid about all three.
    pub const RIGID: Self = Self { torsion: Joint::Rigid, bending_y: Joint::Rigid, bending_z: Joint::Rigid };

    /// About x, y and z.
    pub fn about(&self) -> [Joint; 3] {
        [self.torsion, self.bending_y, self.bending_z]
    }
}

/// What a member resists, and how it is joined to its nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MemberKind {
    /// Tension, compression, bending and torsion; joined so at its start and its end.
    Beam([EndJoint; 2]),
    /// Tension and compression alone. Loads on it go to its ends as from a simple beam; it does not buckle by itself.
    Truss,
}

impl MemberKind {
    /// A beam joined rigidly at both ends.
    pub const RIGID: Self = Self::Beam([EndJoint::RIGID; 2]);

    /// Whether a motion of its two nodes that it does not resist moves it as a whole: no truss, and no hinge.
    pub fn is_firm(&self) -> bool {
        match self {
            Self::Beam(ends) => !ends.iter().flat_map(EndJoint::about).any(Joint::is_hinge),
            Self::Truss => false,
        }
    }

    /// The joints of a beam that has others than rigid ones.
    pub fn joints(&self) -> Option<&[EndJoint; 2]> {
        match self {
            Self::Beam(ends) if !ends.iter().flat_map(EndJoint::about).all(Joint::is_rigid) => Some(ends),
            Self::Beam(_) | Self::Truss => None,
        }
    }
}

/// One prismatic member between two nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// Node at local x = 0.
    pub start: u32,
    /// Node at local x = L.
    pub end: u32,
    /// Direction of the section's height; need be neither unit nor perpendicular to the member.
    pub up: [f64; 3],
    /// Which of the model's sections.
    pub section: u32,
    /// What it resists, and how it is joined.
    pub kind: MemberKind,
}

/// A degree of freedom of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// Displacement along x.
    Ux,
    /// Displacement along y.
    Uy,
    /// Displacement along z.
    Uz,
    /// Rotation about x.
    Rx,
    /// Rotation about y.
    Ry,
    /// Rotation about z.
    Rz,
}

impl Direction {
    /// All of them, in order.
    pub const ALL: [Self; 6] = [Self::Ux, Self::Uy, Self::Uz, Self::Rx, Self::Ry, Self::Rz];

    /// Its name in the config.
    pub fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }
}

/// A support: which of ux, uy, uz, rx, ry, rz are held, and which by springs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    /// The node.
    pub node: u32,
    /// ux, uy, uz, rx, ry, rz.
    pub fixed: [bool; 6],
    /// Stiffness of springs along and about the global axes, N/m and Nm/rad; 0 is none. Of no account where fixed.
    pub stiffness: [f64; 6],
}

impl Support {
    /// A support without springs.
    pub const fn fixed(node: u32, fixed: [bool; 6]) -> Self {
        Self { node, fixed, stiffness: [0.0; 6] }
    }
}

/// Force (N) and moment (Nm) on a node, global axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodalLoad {
    /// The node.
    pub node: u32,
    /// Fx, Fy, Fz, Mx, My, Mz.
    pub load: [f64; 6],
}

/// A uniform load on a member, N per metre of member, global axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UniformLoad {
    /// The member.
    pub member: u32,
    /// Force per length, N/m.
    pub force_per_length: [f64; 3],
}

/// A uniform load on a member against its own z, the direction of its height, N per metre of member.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressureLoad {
    /// The member.
    pub member: u32,
    /// Force per length, N/m.
    pub force_per_length: f64,
}

/// A member warmer (or colder) than when it was built in, evenly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TemperatureLoad {
    /// The member.
    pub member: u32,
    /// By how much, K.
    pub kelvin: f64,
}

/// How a fixed support moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settlement {
    /// The node.
    pub node: u32,
    /// ux, uy, uz (m), rx, ry, rz (rad); 0 where it is not fixed.
    pub displacement: [f64; 6],
}

/// Loads that act together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoadCase {
    /// Loads on nodes.
    pub nodal: Vec<NodalLoad>,
    /// Loads on members.
    pub uniform: Vec<UniformLoad>,
    /// Acceleration along −z that weighs the members, m/s².
    pub gravity: f64,
    /// Loads against the members' z.
    pub pressure: Vec<PressureLoad>,
    /// Changes of temperature.
    pub temperature: Vec<TemperatureLoad>,
    /// Prescribed displacements.
    pub settlements: Vec<Settlement>,
}

/// What a model is built from; see [`FrameModel::new`](super::FrameModel::new).
#[derive(Clone, Debug, PartialEq)]
pub struct FrameParts {
    /// Node positions, m.
    pub nodes: Vec<[f64; 3]>,
    /// Members.
    pub members: Vec<Member>,
    /// Sections, referred to by members.
    pub sections: Vec<Section>,
    /// The material of all members.
    pub material: Material,
    /// Timoshenko shear deformation.
    pub shear_deformation: bool,
    /// Supports; what several entries fix at a node is fixed together.
    pub supports: Vec<Support>,
    /// Load cases.
    pub load_cases: Vec<LoadCase>,
}
