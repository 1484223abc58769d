//! From a pattern to a frame model: members, supports, panel loads, excluded zones.

use super::AnalysisError;
use super::loads::load_case;
use super::panels::Panels;
use super::supports::{FoundNode, outer_corners, supports};
use crate::geometry::pattern::Pattern;
use crate::structure::model::{EndJoint, FrameModel, FrameParts, Material, Member, MemberKind};
use crate::structure::params::{ElementsPerMember, StructureParams};
use crate::structure::section::Section;
use nalgebra::Vector3;

/// A pattern as a frame: nodes `0 .. vertices` are the pattern's, those inside split members follow, edge by edge.
#[derive(Debug)]
pub struct GridshellModel {
    /// The frame, one load case for each of the config's, in the order of their names.
    pub frame: FrameModel,
    /// For each member, the pattern's edge it is (part of).
    pub edge: Vec<u32>,
    /// For each member, whether it counts for `utilisation`.
    pub counts: Vec<bool>,
    /// Which nodes columns and forces at points have found.
    pub found: Vec<FoundNode>,
    /// Sum of member lengths, m.
    pub total_length: f64,
    /// Sum of the panels' true areas, m².
    pub panel_area: f64,
}

impl GridshellModel {
    /// Builds the model with sections of the given height.
    ///
    /// # Errors
    /// Members, supports or loads that cannot be.
    pub fn new(pattern: &Pattern, params: &StructureParams, height: f64) -> Result<Self, AnalysisError> {
        check_references(pattern)?;
        let panels = Panels::new(pattern);
        let mut nodes = pattern.positions.clone();
        let mut members = Vec::new();
        let mut edge = Vec::new();
        let joint = |pieces: u32| params.joints.joint(pieces);
        for (e, &[a, b]) in pattern.edges.iter().enumerate() {
            let up = panels.up(a) + panels.up(b);
            let (from, to) = (at(pattern, a), at(pattern, b));
            let pieces = pieces(params.elements_per_member, (to - from).norm(), pattern.target_length)?;
            let mut start = a;
            for piece in 1..=pieces {
                let end = if piece == pieces {
                    b
                } else {
                    let p = from + (to - from) * (f64::from(piece) / f64::from(pieces));
                    nodes.push([p.x, p.y, p.z]);
                    (nodes.len() - 1) as u32
                };
                let ends = [
                    if piece == 1 { joint(pieces) } else { EndJoint::RIGID },
                    if piece == pieces { joint(pieces) } else { EndJoint::RIGID },
                ];
                let kind = MemberKind::Beam(ends);
                members.push(Member { start, end, up: [up.x, up.y, up.z], section: 0, kind });
                edge.push(e as u32);
                start = end;
            }
        }
        let (supports, mut found) = supports(pattern, &params.supports)?;
        let mut load_cases = Vec::new();
        for (name, load) in &params.loads {
            load_cases.push(load_case(name, load, pattern, &panels, members.len() as u32, &mut found)?);
        }
        let material = &params.material;
        let e = material.youngs_modulus_pa;
        let parts = FrameParts {
            nodes,
            members,
            sections: vec![Section::of_params(&params.section, height)?],
            material: Material {
                youngs_modulus: e,
                shear_modulus: e / (2.0 * (1.0 + material.poisson)),
                density: material.density_kg_m3,
                strength: material.yield_pa / material.gamma_m0,
                thermal_expansion: material.thermal_expansion_per_k,
            },
            shear_deformation: params.shear_deformation,
            supports,
            load_cases,
        };
        let frame = FrameModel::new(parts)?;
        Ok(Self {
            counts: counting(pattern, params, &edge),
            total_length: frame.axes().iter().map(|a| a.length).sum(),
            panel_area: panels.total_area(),
            frame,
            edge,
            found,
        })
    }
}

fn at(pattern: &Pattern, vertex: u32) -> Vector3<f64> {
    Vector3::from(pattern.positions[vertex as usize])
}

/// A pattern comes from our own geometry; still, no index of it is trusted.
fn check_references(pattern: &Pattern) -> Result<(), AnalysisError> {
    let count = pattern.positions.len();
    let corners = pattern.panels.iter().flat_map(|p| p.corners());
    let edges = pattern.edges.iter().flatten();
    let loops = pattern.loops.iter().flatten();
    match corners.chain(edges).chain(loops).chain(&pattern.corners).find(|v| **v as usize >= count) {
        None => Ok(()),
        Some(vertex) => Err(AnalysisError::Pattern(format!("vertex {vertex} of {count} does not exist"))),
    }
}

/// Into how many elements an edge is split.
fn pieces(rule: ElementsPerMember, length: f64, target: f64) -> Result<u32, AnalysisError> {
    const MOST: f64 = 1000.0;
    let count = match rule {
        ElementsPerMember::Number(n) => f64::from(n.max(1)),
        // The small deduction keeps a length that is a whole multiple but for rounding from being split once more.
        ElementsPerMember::Word(_) => (length / (1.5 * target) - 1e-9).ceil().max(1.0),
    };
    if count <= MOST {
        Ok(count as u32)
    } else {
        Err(AnalysisError::Pattern(format!("a member of {length} m would be split into {count} elements")))
    }
}

/// Which members are outside every excluded zone: those of edges with no end within a zone's radius.
fn counting(pattern: &Pattern, params: &StructureParams, edge: &[u32]) -> Vec<bool> {
    let zones: Vec<(Vector3<f64>, f64)> = params
        .utilisation
        .exclude
        .iter()
        .filter(|zone| zone.corners)
        .flat_map(|zone| outer_corners(pattern).iter().map(|&c| (at(pattern, c), zone.radius_m)))
        .collect();
    let counts = |&e: &u32| {
        let ends = pattern.edges[e as usize];
        !ends
            .iter()
            .any(|&v| zones.iter().any(|(center, radius)| (at(pattern, v) - center).norm() <= *radius))
    };
    edge.iter().map(counts).collect()
}
