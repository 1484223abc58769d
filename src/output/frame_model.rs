//! The model that `quadrille frame` reads (docs/frame.md), of a design under one combination.

use super::handed::Handed;
use crate::structure::model::Member;
use crate::structure::section::{Section, Shape};
use serde::Serialize;
use serde_json::{Value, json};

/// The file, in the order in which people read it.
#[derive(Serialize)]
struct File<'a> {
    name: String,
    source: &'static str,
    material: Value,
    section: Value,
    shear_deformation: bool,
    nodes: &'a [[f64; 3]],
    members: Vec<FileMember>,
    supports: Vec<Value>,
    loads: Value,
    analysis: Value,
}

#[derive(Serialize)]
struct FileMember {
    start: u32,
    end: u32,
    up: [f64; 3],
}

/// A design under one of its combinations, with one buckling factor asked for. All digits are written, so that the analysis gives what the
/// design's did.
pub fn frame_model(design: &Handed<'_>, combination: (&str, &[(usize, f64)])) -> serde_json::Result<Vec<u8>> {
    let (name, factors) = combination;
    let model = design.model;
    let loads = design.combined(factors);
    let nodal = loads.nodal.iter().map(|l| {
        let [fx, fy, fz, mx, my, mz] = l.load;
        json!({ "node": l.node, "force": [fx, fy, fz], "moment": [mx, my, mz] })
    });
    let uniform =
        loads.uniform.iter().map(|l| json!({ "member": l.member, "force_per_length": l.force_per_length }));
    let supports = model.supported().map(|node| {
        let fixed = model.fixed()[node.0 as usize];
        json!({ "node": node.0, "fixed": fixed })
    });
    let material = model.material();
    let file = File {
        name: format!("design {}, combination {name}", design.id),
        source: concat!("quadrille ", env!("CARGO_PKG_VERSION")),
        material: json!({
            "E": material.youngs_modulus,
            "G": material.shear_modulus,
            "density": material.density,
            "fy": material.strength,
        }),
        section: section(&model.sections()[0]),
        shear_deformation: model.shear_deformation(),
        nodes: model.nodes(),
        members: model
            .members()
            .iter()
            .map(|&Member { start, end, up, .. }| FileMember { start, end, up })
            .collect(),
        supports: supports.collect(),
        loads: json!({
            "nodal": nodal.collect::<Vec<_>>(),
            "member_uniform": uniform.collect::<Vec<_>>(),
            "gravity": loads.gravity,
        }),
        analysis: json!({ "order": design.order, "buckling_modes": 1 }),
    };
    let mut bytes = serde_json::to_vec(&file)?;
    bytes.push(b'\n');
    Ok(bytes)
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
