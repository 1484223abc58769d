//! Sheets of the structure: model, material, sections, nodes, members, supports, hinges.

use super::{Cell, VERSION, row};
use crate::output::handed::Handed;
use crate::output::number::shortest;
use crate::structure::model::{Frame3, Joint, Member, MemberKind};
use crate::structure::section::{Section, Shape};

/// The one sheet whose headers stand below each other.
pub(super) fn model(design: &Handed<'_>) -> Vec<Vec<Cell>> {
    vec![
        row!["Name", format!("design {}", design.id)],
        row!["Discipline", "Load-bearing structure"],
        row!["Source type", "Structural analysis model"],
        row!["Source application", concat!("quadrille ", env!("CARGO_PKG_VERSION"))],
        row!["SAF Version", VERSION],
        row!["Global coordinate system", "Z vertical"],
        row!["LCS of cross-section", "ZYX"],
        row!["System of units", "Metric"],
        row!["National code", "EC-Standard-EN"],
    ]
}

pub(super) const MATERIAL: &[&str] = &[
    "Name",
    "Type",
    "Quality",
    "Unit mass [kg/m3]",
    "E modulus [MPa]",
    "G modulus [MPa]",
    "Poisson Coefficient",
    "Thermal expansion [1/K]",
];

pub(super) const MATERIAL_NAME: &str = "MAT1";

pub(super) fn material(design: &Handed<'_>) -> Vec<Cell> {
    let material = design.model.material();
    let [e, g, strength] =
        [material.youngs_modulus, material.shear_modulus, material.strength].map(|pascal| pascal / 1e6);
    let name = format!("S{}", strength.round());
    row![
        MATERIAL_NAME,
        "Steel",
        name,
        material.density,
        e,
        g,
        e / (2.0 * g) - 1.0,
        material.thermal_expansion
    ]
}

pub(super) const SECTION: &[&str] = &[
    "Name",
    "Material",
    "Cross-section type",
    "Shape",
    "Parameters [mm]",
    "A [m2]",
    "Iy [m4]",
    "Iz [m4]",
    "It [m4]",
];

/// What is known by its properties alone is drawn as the rectangle of the same A and Iy; the properties tell.
pub(super) fn cross_section(k: usize, section: &Section) -> Vec<Cell> {
    let millimetres = |lengths: &[f64]| {
        let texts = lengths.iter().map(|metres| shortest((metres * 1e9).round() / 1e6).unwrap_or_default());
        texts.collect::<Vec<_>>().join("; ")
    };
    let (shape, parameters) = match section.shape {
        Some(Shape::Box { width, height, thickness }) => {
            ("Tube", millimetres(&[height, width, thickness, 0.0, 0.0]))
        }
        Some(Shape::Round { diameter }) => ("Circle", millimetres(&[diameter])),
        Some(Shape::Tube { diameter, thickness }) => ("Pipe", millimetres(&[diameter, thickness])),
        None => {
            let height = (12.0 * section.iy / section.area).sqrt();
            ("Rectangle", millimetres(&[height, section.area / height]))
        }
    };
    let Section { area, iy, iz, j, .. } = *section;
    row![section_name(k), MATERIAL_NAME, "Parametric", shape, parameters, area, iy, iz, j]
}

pub(super) fn section_name(section: usize) -> String {
    format!("CS{}", section + 1)
}

pub(super) const NODE: &[&str] = &["Name", "Coordinate X [m]", "Coordinate Y [m]", "Coordinate Z [m]"];

/// Numbers are those of `ID_nodes.csv` and `ID_members.csv`.
pub(super) fn node(number: usize) -> String {
    format!("N{number}")
}

pub(super) fn member(number: usize) -> String {
    format!("B{number}")
}

pub(super) const MEMBER: &[&str] = &[
    "Name",
    "Type",
    "Cross section",
    "Nodes",
    "Segments",
    "Length [m]",
    "Geometrical shape",
    "LCS",
    "LCS Rotation [deg]",
    "Coordinate X [m]",
    "Coordinate Y [m]",
    "Coordinate Z [m]",
    "System line",
    "Analysis Y Eccentricity of Beg Node [mm]",
    "Analysis Z Eccentricity of Beg Node [mm]",
    "Analysis Y Eccentricity of End Node [mm]",
    "Analysis Z Eccentricity of End Node [mm]",
    "Behaviour in analysis",
];

pub(super) fn members(design: &Handed<'_>) -> Vec<Vec<Cell>> {
    let of = |(m, (piece, axes)): (usize, (&Member, &Frame3))| {
        let ends = format!("{}; {}", node(piece.start as usize), node(piece.end as usize));
        let mut cells = row![
            member(m),
            "General",
            section_name(piece.section as usize),
            ends,
            "Line",
            axes.length,
            "Line",
            "z by vector",
            0.0,
        ];
        cells.extend(axes.z.iter().map(|&z| Cell::from(z)));
        let behaviour = if piece.kind == MemberKind::Truss { "Axial force only" } else { "Standard" };
        cells.extend(row!["Centre", 0.0, 0.0, 0.0, 0.0, behaviour]);
        cells
    };
    design.model.members().iter().zip(design.model.axes()).enumerate().map(of).collect()
}

pub(super) const SUPPORT: &[&str] = &[
    "Name",
    "Type",
    "Boundary condition",
    "Node",
    "ux",
    "uy",
    "uz",
    "fix",
    "fiy",
    "fiz",
    "Stiffness X [MN/m]",
    "Stiffness Y [MN/m]",
    "Stiffness Z [MN/m]",
    "Stiffness Fix [MNm/rad]",
    "Stiffness Fiy [MNm/rad]",
    "Stiffness Fiz [MNm/rad]",
];

/// Six words and six stiffnesses; `None` is rigid, 0 free.
pub(super) fn conditions(stiffness: [Option<f64>; 6]) -> impl Iterator<Item = Cell> {
    let words = stiffness.map(|stiffness| match stiffness {
        None => "Rigid",
        Some(0.0) => "Free",
        Some(_) => "Flexible",
    });
    let numbers = stiffness.map(|stiffness| match stiffness {
        None | Some(0.0) => Cell::Empty,
        Some(stiffness) => Cell::from(stiffness / 1e6),
    });
    words.map(Cell::from).into_iter().chain(numbers)
}

pub(super) fn support(node: u32) -> String {
    format!("S{node}")
}

pub(super) fn supports(design: &Handed<'_>) -> Vec<Vec<Cell>> {
    let of = |n: u32| {
        let (fixed, springs) = (design.model.fixed()[n as usize], design.springs(n));
        let mut cells = row![support(n), "Custom", "In node", node(n as usize)];
        cells.extend(conditions(std::array::from_fn(|d| (!fixed[d]).then_some(springs[d]))));
        cells
    };
    design.model.supported().map(|n| of(n.0)).collect()
}

pub(super) const HINGE: &[&str] = &[
    "Name",
    "Member",
    "Position",
    "ux",
    "uy",
    "uz",
    "fix",
    "fiy",
    "fiz",
    "Stiffness X [MN/m]",
    "Stiffness Y [MN/m]",
    "Stiffness Z [MN/m]",
    "Stiffness Fix [MNm/rad]",
    "Stiffness Fiy [MNm/rad]",
    "Stiffness Fiz [MNm/rad]",
];

/// Joints that are not rigid.
pub(super) fn hinges(design: &Handed<'_>) -> Vec<Vec<Cell>> {
    let mut rows = Vec::new();
    for (m, piece) in design.model.members().iter().enumerate() {
        for (position, joint) in ["Begin", "End"].into_iter().zip(piece.kind.joints().into_iter().flatten()) {
            if joint.about().into_iter().all(Joint::is_rigid) {
                continue;
            }
            let beside = design.stiffness(m);
            let about = joint.about();
            let stiffness = |d: usize| (!about[d].is_rigid()).then(|| about[d].stiffness(beside[d]));
            let mut cells = row![format!("H{}", rows.len() + 1), member(m), position];
            cells.extend(conditions(std::array::from_fn(|d| if d < 3 { None } else { stiffness(d - 3) })));
            rows.push(cells);
        }
    }
    rows
}
