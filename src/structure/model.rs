//! The model: nodes, members, sections, supports, load cases. Checked once, then only read.

use super::section::{Section, SectionError};
use nalgebra::Vector3;
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
}

/// One prismatic beam between two nodes.
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
    /// Its name in the config.
    pub fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }
}

/// A support: which of ux, uy, uz, rx, ry, rz are held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Support {
    /// The node.
    pub node: u32,
    /// ux, uy, uz, rx, ry, rz.
    pub fixed: [bool; 6],
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

/// Loads that act together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoadCase {
    /// Loads on nodes.
    pub nodal: Vec<NodalLoad>,
    /// Loads on members.
    pub uniform: Vec<UniformLoad>,
    /// Acceleration along −z that weighs the members, m/s².
    pub gravity: f64,
}

/// What a model is built from; see [`FrameModel::new`].
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

/// What is wrong with a model, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// No node.
    #[error("nodes: the model has none")]
    NoNodes,
    /// No member.
    #[error("members: the model has none")]
    NoMembers,
    /// More nodes or members than a `u32` counts.
    #[error("the model is too large: {0}")]
    TooLarge(&'static str),
    /// A number that is NaN or infinite.
    #[error("{place}: {value} is not a finite number")]
    NotFinite {
        /// Path of the value.
        place: String,
        /// The value.
        value: f64,
    },
    /// A reference past the end of a list.
    #[error("{place} = {index}, but there are only {len} {what} (counted from 0)")]
    OutOfRange {
        /// Path of the reference.
        place: String,
        /// What it says.
        index: u32,
        /// What it refers to.
        what: &'static str,
        /// How many there are.
        len: usize,
    },
    /// A member between a node and itself, or between nodes at one place.
    #[error("members[{member}]: its length is {length} m (nodes {start} and {end})")]
    ZeroLength {
        /// The member.
        member: usize,
        /// Its start node.
        start: u32,
        /// Its end node.
        end: u32,
        /// Its length, m.
        length: f64,
    },
    /// An `up` that is zero or along the member.
    #[error("members[{member}].up = {up:?} is zero or along the member, so it gives no height direction")]
    UpAlongMember {
        /// The member.
        member: usize,
        /// Its up vector.
        up: [f64; 3],
    },
    /// Two members between the same two nodes.
    #[error("members[{second}] joins the same nodes ({start} and {end}) as members[{first}]")]
    DuplicateMember {
        /// The earlier member.
        first: usize,
        /// The later member.
        second: usize,
        /// One node.
        start: u32,
        /// The other node.
        end: u32,
    },
    /// A node no member reaches.
    #[error("nodes[{node}] belongs to no member")]
    LooseNode {
        /// The node.
        node: usize,
    },
    /// A material property that is not positive.
    #[error("material.{name} = {value} must be {allowed}")]
    Material {
        /// Which.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A section that cannot be.
    #[error("section {index}: {source}")]
    Section {
        /// Which section.
        index: usize,
        /// Why not.
        source: SectionError,
    },
}

/// Position and axes of a member: x along it, z its height direction, y = z × x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame3 {
    /// Unit vector from start to end.
    pub x: Vector3<f64>,
    /// Unit vector across.
    pub y: Vector3<f64>,
    /// Unit vector of the section's height.
    pub z: Vector3<f64>,
    /// Length L, m.
    pub length: f64,
}

/// A checked model. It cannot be changed; see [`FrameParts`] for what its parts mean.
#[derive(Clone, Debug)]
pub struct FrameModel {
    parts: FrameParts,
    axes: Vec<Frame3>,
    fixed: Vec<[bool; 6]>,
}

impl FrameModel {
    /// Checks the parts and freezes them.
    ///
    /// # Errors
    /// The first thing found wrong, by place: see [`ModelError`]. A missing support is not an input error; the
    /// analysis finds the mechanism.
    pub fn new(parts: FrameParts) -> Result<Self, ModelError> {
        check_sizes(&parts)?;
        check_material(&parts.material)?;
        for (index, section) in parts.sections.iter().enumerate() {
            section.check().map_err(|source| ModelError::Section { index, source })?;
        }
        for (i, node) in parts.nodes.iter().enumerate() {
            finite(node, || format!("nodes[{i}]"))?;
        }
        let axes = check_members(&parts)?;
        check_connected(&parts)?;
        let fixed = check_supports(&parts)?;
        for (c, case) in parts.load_cases.iter().enumerate() {
            check_loads(&parts, c, case)?;
        }
        Ok(Self { parts, axes, fixed })
    }

    /// Node positions, m.
    pub fn nodes(&self) -> &[[f64; 3]] {
        &self.parts.nodes
    }

    /// Members.
    pub fn members(&self) -> &[Member] {
        &self.parts.members
    }

    /// Local axes and length of each member.
    pub fn axes(&self) -> &[Frame3] {
        &self.axes
    }

    /// Sections.
    pub fn sections(&self) -> &[Section] {
        &self.parts.sections
    }

    /// The material.
    pub fn material(&self) -> &Material {
        &self.parts.material
    }

    /// Whether elements deform in shear.
    pub fn shear_deformation(&self) -> bool {
        self.parts.shear_deformation
    }

    /// Held directions of each node.
    pub fn fixed(&self) -> &[[bool; 6]] {
        &self.fixed
    }

    /// Load cases.
    pub fn load_cases(&self) -> &[LoadCase] {
        &self.parts.load_cases
    }

    /// Nodes with a support, in order.
    pub fn supported(&self) -> impl Iterator<Item = NodeId> + '_ {
        self.fixed.iter().enumerate().filter(|(_, f)| f.contains(&true)).map(|(n, _)| NodeId(n as u32))
    }
}

fn finite(values: &[f64], place: impl Fn() -> String) -> Result<(), ModelError> {
    match values.iter().position(|v| !v.is_finite()) {
        None => Ok(()),
        Some(i) => Err(ModelError::NotFinite { place: format!("{}[{i}]", place()), value: values[i] }),
    }
}

fn in_range(
    index: u32,
    len: usize,
    what: &'static str,
    place: impl Fn() -> String,
) -> Result<(), ModelError> {
    if (index as usize) < len {
        Ok(())
    } else {
        Err(ModelError::OutOfRange { place: place(), index, what, len })
    }
}

fn check_sizes(parts: &FrameParts) -> Result<(), ModelError> {
    // Six unknowns a node, 36 values a block, all counted in u32.
    const MOST: usize = 20_000_000;
    match (parts.nodes.len(), parts.members.len()) {
        (0, _) => Err(ModelError::NoNodes),
        (_, 0) => Err(ModelError::NoMembers),
        (n, _) if n > MOST => Err(ModelError::TooLarge("more than 20 million nodes")),
        (_, m) if m > MOST => Err(ModelError::TooLarge("more than 20 million members")),
        _ => Ok(()),
    }
}

fn check_material(material: &Material) -> Result<(), ModelError> {
    let positive = [("E", material.youngs_modulus), ("G", material.shear_modulus), ("fy", material.strength)];
    for (name, value) in positive {
        if !(value > 0.0 && value.is_finite()) {
            return Err(ModelError::Material { name, value, allowed: "greater than 0" });
        }
    }
    if !(material.density >= 0.0 && material.density.is_finite()) {
        return Err(ModelError::Material { name: "density", value: material.density, allowed: "0 or more" });
    }
    Ok(())
}

fn check_members(parts: &FrameParts) -> Result<Vec<Frame3>, ModelError> {
    let nodes = &parts.nodes;
    let mut axes = Vec::with_capacity(parts.members.len());
    for (m, member) in parts.members.iter().enumerate() {
        in_range(member.start, nodes.len(), "nodes", || format!("members[{m}].start"))?;
        in_range(member.end, nodes.len(), "nodes", || format!("members[{m}].end"))?;
        in_range(member.section, parts.sections.len(), "sections", || format!("members[{m}].section"))?;
        finite(&member.up, || format!("members[{m}].up"))?;
        axes.push(local_axes(m, member, nodes)?);
    }
    let mut pairs: Vec<(u32, u32, usize)> = parts
        .members
        .iter()
        .enumerate()
        .map(|(m, member)| (member.start.min(member.end), member.start.max(member.end), m))
        .collect();
    pairs.sort_unstable();
    match pairs.windows(2).filter(|w| (w[0].0, w[0].1) == (w[1].0, w[1].1)).min_by_key(|w| w[1].2) {
        None => Ok(axes),
        Some(w) => {
            Err(ModelError::DuplicateMember { first: w[0].2, second: w[1].2, start: w[0].0, end: w[0].1 })
        }
    }
}

/// x from start to end, y = up × x normalised, z = x × y.
fn local_axes(m: usize, member: &Member, nodes: &[[f64; 3]]) -> Result<Frame3, ModelError> {
    let (start, end) = (member.start, member.end);
    let a = Vector3::from(nodes[start as usize]);
    let b = Vector3::from(nodes[end as usize]);
    let chord = b - a;
    let length = chord.norm();
    // Below this the direction is rounding noise of the coordinates, and 1/L³ soon overflows.
    let least = 1e-12 * a.amax().max(b.amax()).max(1e-100);
    if !(length > least && length.is_finite()) {
        return Err(ModelError::ZeroLength { member: m, start, end, length });
    }
    let x = chord / length;
    let scale = member.up.iter().fold(0.0f64, |s, v| s.max(v.abs()));
    let up = Vector3::from(member.up) / if scale > 0.0 { scale } else { 1.0 };
    let across = up.cross(&x);
    let sine = across.norm();
    if sine.is_nan() || sine <= 1e-9 {
        return Err(ModelError::UpAlongMember { member: m, up: member.up });
    }
    let y = across / sine;
    Ok(Frame3 { x, y, z: x.cross(&y), length })
}

fn check_connected(parts: &FrameParts) -> Result<(), ModelError> {
    let mut reached = vec![false; parts.nodes.len()];
    for member in &parts.members {
        reached[member.start as usize] = true;
        reached[member.end as usize] = true;
    }
    match reached.iter().position(|r| !r) {
        None => Ok(()),
        Some(node) => Err(ModelError::LooseNode { node }),
    }
}

fn check_supports(parts: &FrameParts) -> Result<Vec<[bool; 6]>, ModelError> {
    let mut fixed = vec![[false; 6]; parts.nodes.len()];
    for (s, support) in parts.supports.iter().enumerate() {
        in_range(support.node, fixed.len(), "nodes", || format!("supports[{s}].node"))?;
        for (held, also) in fixed[support.node as usize].iter_mut().zip(support.fixed) {
            *held |= also;
        }
    }
    Ok(fixed)
}

fn check_loads(parts: &FrameParts, c: usize, case: &LoadCase) -> Result<(), ModelError> {
    let place = |list: &str, i: usize| {
        if parts.load_cases.len() > 1 {
            format!("loads[{c}].{list}[{i}]")
        } else {
            format!("loads.{list}[{i}]")
        }
    };
    for (i, load) in case.nodal.iter().enumerate() {
        in_range(load.node, parts.nodes.len(), "nodes", || format!("{}.node", place("nodal", i)))?;
        finite(&load.load, || place("nodal", i))?;
    }
    for (i, load) in case.uniform.iter().enumerate() {
        let at = || format!("{}.member", place("member_uniform", i));
        in_range(load.member, parts.members.len(), "members", at)?;
        finite(&load.force_per_length, || place("member_uniform", i))?;
    }
    if case.gravity.is_finite() {
        Ok(())
    } else {
        Err(ModelError::NotFinite { place: "loads.gravity".into(), value: case.gravity })
    }
}
