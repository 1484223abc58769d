//! The model that `quadrille frame` reads (docs/frame.md), of a design under one combination.

use super::handed::Handed;
use crate::structure::model::{Joint, LoadCase, Member, MemberKind};
use crate::structure::params::{EndJointParams, JointParams, JointWord};
use crate::structure::section::{Section, Shape};
use serde::Serialize;
use serde_json::{Value, json};

/// The file, in the order in which people read it. What a model has not got is left out.
#[derive(Serialize)]
struct File<'a> {
    name: String,
    source: &'static str,
    material: Value,
    #[serde(skip_serializing_if = "Value::is_null")]
    section: Value,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    sections: Vec<Value>,
    shear_deformation: bool,
    nodes: &'a [[f64; 3]],
    members: Vec<FileMember>,
    supports: Vec<FileSupport>,
    loads: Value,
    analysis: Value,
}

#[derive(Serialize)]
struct FileMember {
    start: u32,
    end: u32,
    up: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    section: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    kind: Option<&'static str>,
    #[serde(skip_serializing_if = "EndJointParams::is_rigid")]
    start_release: EndJointParams,
    #[serde(skip_serializing_if = "EndJointParams::is_rigid")]
    end_release: EndJointParams,
}

#[derive(Serialize)]
struct FileSupport {
    node: u32,
    fixed: [bool; 6],
    #[serde(skip_serializing_if = "Option::is_none")]
    stiffness: Option<[f64; 6]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    displacement: Option<[f64; 6]>,
}

/// A design under one of its combinations, with one buckling factor asked for. All digits are written, so that the analysis gives what the
/// design's did.
pub fn frame_model(design: &Handed<'_>, combination: (&str, &[(usize, f64)])) -> serde_json::Result<Vec<u8>> {
    let (name, factors) = combination;
    let model = design.model;
    let loads = design.combined(factors);
    let supports = model.supported().map(|node| {
        let springs = design.springs(node.0);
        let moved = loads.settlements.iter().find(|moved| moved.node == node.0);
        FileSupport {
            node: node.0,
            fixed: model.fixed()[node.0 as usize],
            stiffness: (springs != [0.0; 6]).then_some(springs),
            displacement: moved.map(|moved| moved.displacement),
        }
    });
    let material = model.material();
    let several = model.sections().len() > 1;
    let mut sections: Vec<Value> = model.sections().iter().map(section).collect();
    let file = File {
        name: format!("design {}, combination {name}", design.id),
        source: concat!("quadrille ", env!("CARGO_PKG_VERSION")),
        material: json!({
            "E": material.youngs_modulus,
            "G": material.shear_modulus,
            "density": material.density,
            "fy": material.strength,
            "thermal_expansion": material.thermal_expansion,
        }),
        section: if several { Value::Null } else { sections.pop().unwrap_or_default() },
        sections,
        shear_deformation: model.shear_deformation(),
        nodes: model.nodes(),
        members: model.members().iter().map(|m| member(m, several)).collect(),
        supports: supports.collect(),
        loads: written(&loads),
        analysis: json!({ "order": design.order, "buckling_modes": 1 }),
    };
    let mut bytes = serde_json::to_vec(&file)?;
    bytes.push(b'\n');
    Ok(bytes)
}

fn member(member: &Member, several: bool) -> FileMember {
    let [start_release, end_release] = match member.kind {
        MemberKind::Beam(ends) => ends.map(|end| EndJointParams {
            torsion: joint(end.torsion, |gj_per_l| JointParams::Torsion { gj_per_l }),
            bending_y: joint(end.bending_y, |ei_per_l| JointParams::Bending { ei_per_l }),
            bending_z: joint(end.bending_z, |ei_per_l| JointParams::Bending { ei_per_l }),
        }),
        MemberKind::Truss => [EndJointParams::default(); 2],
    };
    FileMember {
        start: member.start,
        end: member.end,
        up: member.up,
        section: several.then_some(member.section),
        kind: (member.kind == MemberKind::Truss).then_some("truss"),
        start_release,
        end_release,
    }
}

fn joint(joint: Joint, relative: impl Fn(f64) -> JointParams) -> JointParams {
    match joint {
        _ if joint.is_rigid() => JointParams::default(),
        _ if joint.is_hinge() => JointParams::Word(JointWord::Hinge),
        Joint::Relative(times) => relative(times),
        other => JointParams::Absolute { nm_per_rad: other.stiffness(0.0) },
    }
}

/// The loads, those lists alone that hold something.
fn written(loads: &LoadCase) -> Value {
    let nodal = loads.nodal.iter().map(|l| {
        let [fx, fy, fz, mx, my, mz] = l.load;
        json!({ "node": l.node, "force": [fx, fy, fz], "moment": [mx, my, mz] })
    });
    let uniform =
        loads.uniform.iter().map(|l| json!({ "member": l.member, "force_per_length": l.force_per_length }));
    let pressure =
        loads.pressure.iter().map(|l| json!({ "member": l.member, "force_per_length": l.force_per_length }));
    let temperature = loads.temperature.iter().map(|l| json!({ "member": l.member, "kelvin": l.kelvin }));
    let lists = [
        ("nodal", nodal.collect::<Vec<_>>()),
        ("member_uniform", uniform.collect()),
        ("pressure", pressure.collect()),
        ("temperature", temperature.collect()),
    ];
    let mut written = json!({ "gravity": loads.gravity });
    for (name, list) in lists.into_iter().filter(|(_, list)| !list.is_empty()) {
        written[name] = list.into();
    }
    written
}

/// A section by its shape, or else by its properties.
fn section(section: &Section) -> Value {
    match section.shape {
        Some(Shape::Box { width, height, thickness }) => {
            json!({ "kind": "box", "width": width, "height": height, "thickness": thickness })
        }
        Some(Shape::Round { diameter }) => json!({ "kind": "round", "diameter": diameter }),
        Some(Shape::Tube { diameter, thickness }) => {
            json!({ "kind": "tube", "diameter": diameter, "thickness": thickness })
        }
        None => json!({
            "kind": "properties", "A": section.area, "Iy": section.iy, "Iz": section.iz, "J": section.j,
            "Wy": section.wy, "Wz": section.wz, "Asy": section.asy, "Asz": section.asz,
        }),
    }
}
