//! The model: nodes, members, sections, supports, load cases. Checked once, then only read.

mod check;
mod error;
mod parts;

pub use error::ModelError;
pub use parts::*;

use super::section::Section;
use nalgebra::Vector3;

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

impl Frame3 {
    /// The same member in its own axes.
    pub fn local(&self) -> Self {
        Self { x: Vector3::x(), y: Vector3::y(), z: Vector3::z(), length: self.length }
    }
}

/// A checked model. It cannot be changed; see [`FrameParts`] for what its parts mean.
#[derive(Clone, Debug)]
pub struct FrameModel {
    parts: FrameParts,
    axes: Vec<Frame3>,
    fixed: Vec<[bool; 6]>,
    springs: Vec<Spring>,
    unturned: Vec<u32>,
}

/// The spring of a support in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// The node.
    pub node: u32,
    /// 0 … 5: ux, uy, uz, rx, ry, rz.
    pub direction: usize,
    /// N/m or Nm/rad, greater than 0.
    pub stiffness: f64,
}

impl FrameModel {
    /// Checks the parts and freezes them.
    ///
    /// # Errors
    /// The first thing found wrong, by place: see [`ModelError`]. A missing support is not an input error; the
    /// analysis finds the mechanism.
    pub fn new(parts: FrameParts) -> Result<Self, ModelError> {
        check::sizes(&parts)?;
        check::material(&parts.material)?;
        for (index, section) in parts.sections.iter().enumerate() {
            section.check().map_err(|source| ModelError::Section { index, source })?;
        }
        for (i, node) in parts.nodes.iter().enumerate() {
            check::finite(node, || format!("nodes[{i}]"))?;
        }
        let axes = check::members(&parts)?;
        check::connected(&parts)?;
        let (fixed, springs) = check::supports(&parts)?;
        let unturned = check::unturned(&parts);
        for (c, case) in parts.load_cases.iter().enumerate() {
            check::loads(&parts, &fixed, &unturned, c, case)?;
        }
        Ok(Self { parts, axes, fixed, springs, unturned })
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

    /// The springs of the supports where they are not fixed, by node and direction.
    pub fn springs(&self) -> &[Spring] {
        &self.springs
    }

    /// Nodes that join nothing but trusses, in order: they have no rotation.
    pub fn unturned(&self) -> &[u32] {
        &self.unturned
    }

    /// Load cases.
    pub fn load_cases(&self) -> &[LoadCase] {
        &self.parts.load_cases
    }

    /// Nodes with a support, in order.
    pub fn supported(&self) -> impl Iterator<Item = NodeId> + '_ {
        let has_spring = |n: u32| {
            let place = self.springs.partition_point(|spring| spring.node < n);
            self.springs.get(place).is_some_and(|spring| spring.node == n)
        };
        let nodes = (0..self.fixed.len() as u32).zip(&self.fixed);
        nodes.filter(move |(n, f)| f.contains(&true) || has_spring(*n)).map(|(n, _)| NodeId(n))
    }
}
