//! Structural Analysis Format: a workbook that RFEM, SCIA and others read (docs/reference/files.md §7).
//!
//! Sheets, headers and words are those of SAF 2.2.0 (<https://www.saf.guide/en/stable>); units are metric: m, kN, MPa, mm for sections. One
//! sheet is one kind of object, one row one object, and names refer from one sheet to another. Nothing in the file tells when it was made.

use super::handed::Handed;
use super::number::shortest;
use crate::structure::model::{Frame3, LoadCase, Member};
use crate::structure::params::LoadParams;
use crate::structure::section::{Section, Shape};
use nalgebra::Vector3;
use rust_xlsxwriter::{DocProperties, ExcelDateTime, Workbook, XlsxError};

/// The version of the format.
const VERSION: &str = "2.2.0";
/// What receiving programs make of a load case of self weight, m/s²; nearer than the tolerance it is left to them.
const GRAVITY: (f64, f64) = (9.81, 0.005);

/// A cell.
enum Cell {
    Text(String),
    Number(f64),
    /// What does not apply.
    Empty,
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<f64> for Cell {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

/// Cells of different kinds in one row.
macro_rules! row {
    ($($cell:expr),* $(,)?) => { vec![$(Cell::from($cell)),*] };
}

/// A design with all its load cases and combinations.
///
/// # Errors
/// The workbook cannot be written: more than a million nodes, members or loads.
pub fn saf(design: &Handed<'_>) -> Result<Vec<u8>, XlsxError> {
    let mut workbook = Workbook::new();
    // Else the clock's.
    workbook
        .set_properties(&DocProperties::new().set_creation_datetime(&ExcelDateTime::from_ymd(2000, 1, 1)?));
    let mut sheet =
        |name: &str, header: &[&str], rows: Vec<Vec<Cell>>| write(&mut workbook, name, header, rows);
    sheet("Model", &[], model(design))?;
    sheet("StructuralMaterial", MATERIAL, vec![material(design)])?;
    let sections = design.model.sections().iter().enumerate();
    sheet("StructuralCrossSection", SECTION, sections.map(|(k, s)| cross_section(k, s)).collect())?;
    let nodes = design.model.nodes().iter().enumerate();
    sheet(
        "StructuralPointConnection",
        NODE,
        nodes.map(|(n, [x, y, z])| row![node(n), *x, *y, *z]).collect(),
    )?;
    sheet("StructuralCurveMember", MEMBER, members(design))?;
    sheet("StructuralPointSupport", SUPPORT, supports(design))?;
    sheet("StructuralLoadGroup", GROUP, groups())?;
    sheet("StructuralLoadCase", CASE, cases(design))?;
    let most = design.combinations.iter().map(|(_, cases)| cases.len()).max().unwrap_or(0);
    let numbered =
        (1..=most).flat_map(|k| ["Load factor", "Multiplier", "Load case name"].map(|n| format!("{n} {k}")));
    let header: Vec<String> =
        ["Name", "Description", "Category", "Type"].map(str::to_owned).into_iter().chain(numbered).collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    sheet("StructuralLoadCombination", &header, combinations(design))?;
    sheet("StructuralPointAction", POINT_ACTION, point_actions(design))?;
    sheet("StructuralCurveAction", CURVE_ACTION, curve_actions(design))?;
    workbook.save_to_buffer()
}

/// A sheet: the header, if it has one, and the rows below. One of loads without any is left out.
fn write(
    workbook: &mut Workbook,
    name: &str,
    header: &[&str],
    rows: Vec<Vec<Cell>>,
) -> Result<(), XlsxError> {
    if rows.is_empty() {
        return Ok(());
    }
    let sheet = workbook.add_worksheet();
    sheet.set_name(name)?;
    for (column, heading) in (0..).zip(header) {
        sheet.write_string(0, column, *heading)?;
    }
    for (line, cells) in (u32::from(!header.is_empty())..).zip(rows) {
        for (column, cell) in (0..).zip(cells) {
            match cell {
                Cell::Text(text) => sheet.write_string(line, column, text)?,
                Cell::Number(number) => sheet.write_number(line, column, number)?,
                Cell::Empty => continue,
            };
        }
    }
    Ok(())
}

/// The one sheet whose headers stand below each other.
fn model(design: &Handed<'_>) -> Vec<Vec<Cell>> {
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

const MATERIAL: &[&str] = &[
    "Name",
    "Type",
    "Quality",
    "Unit mass [kg/m3]",
    "E modulus [MPa]",
    "G modulus [MPa]",
    "Poisson Coefficient",
];

const MATERIAL_NAME: &str = "MAT1";

fn material(design: &Handed<'_>) -> Vec<Cell> {
    let material = design.model.material();
    let [e, g, strength] =
        [material.youngs_modulus, material.shear_modulus, material.strength].map(|pascal| pascal / 1e6);
    let name = format!("S{}", strength.round());
    row![MATERIAL_NAME, "Steel", name, material.density, e, g, e / (2.0 * g) - 1.0]
}

const SECTION: &[&str] = &[
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
fn cross_section(k: usize, section: &Section) -> Vec<Cell> {
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

fn section_name(section: usize) -> String {
    format!("CS{}", section + 1)
}

const NODE: &[&str] = &["Name", "Coordinate X [m]", "Coordinate Y [m]", "Coordinate Z [m]"];

/// Numbers are those of `ID_nodes.csv` and `ID_members.csv`.
fn node(number: usize) -> String {
    format!("N{number}")
}

fn member(number: usize) -> String {
    format!("B{number}")
}

const MEMBER: &[&str] = &[
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

fn members(design: &Handed<'_>) -> Vec<Vec<Cell>> {
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
        cells.extend(row!["Centre", 0.0, 0.0, 0.0, 0.0, "Standard"]);
        cells
    };
    design.model.members().iter().zip(design.model.axes()).enumerate().map(of).collect()
}

const SUPPORT: &[&str] =
    &["Name", "Type", "Boundary condition", "Node", "ux", "uy", "uz", "fix", "fiy", "fiz"];

fn supports(design: &Handed<'_>) -> Vec<Vec<Cell>> {
    let of = |n: usize| {
        let held = design.model.fixed()[n].map(|held| Cell::from(if held { "Rigid" } else { "Free" }));
        let mut cells = row![format!("S{n}"), "Custom", "In node", node(n)];
        cells.extend(held);
        cells
    };
    design.model.supported().map(|n| of(n.0 as usize)).collect()
}

const GROUP: &[&str] = &["Name", "Load group type", "Relation", "Load type"];
const PERMANENT: &str = "LG1";
const VARIABLE: &str = "LG2";

fn groups() -> Vec<Vec<Cell>> {
    vec![
        row![PERMANENT, "Permanent", "Together", Cell::Empty],
        row![VARIABLE, "Variable", "Standard", "Snow"],
    ]
}

const CASE: &[&str] = &["Name", "Description", "Action type", "Load group", "Load type", "Duration"];

/// Whether the receiving program makes the loads of a case itself.
fn is_left_to_it(case: &LoadCase) -> bool {
    (case.gravity - GRAVITY.0).abs() <= GRAVITY.1 && case.nodal.is_empty() && case.uniform.is_empty()
}

fn cases(design: &Handed<'_>) -> Vec<Vec<Cell>> {
    let of = |(k, (name, load)): (usize, &(&str, &LoadParams))| {
        let permanent = |what: &str, kind: &str| row![*name, what, "Permanent", PERMANENT, kind, Cell::Empty];
        let variable = |what: &str, kind: &str| row![*name, what, "Variable", VARIABLE, kind, "Short"];
        match load {
            LoadParams::Gravity { .. } if is_left_to_it(&design.model.load_cases()[k]) => {
                permanent("self weight of the members", "Self weight")
            }
            LoadParams::Gravity { .. } => permanent("self weight of the members, as line forces", "Others"),
            LoadParams::Area { .. } => permanent("on the panels, at their corners", "Others"),
            LoadParams::Projected { .. } => {
                variable("on the plan projection of the panels, at their corners", "Snow")
            }
            LoadParams::Pressure { .. } => variable("normal to the panels, at their corners", "Wind"),
            LoadParams::Temperature { .. } => variable("members warmer or colder", "Temperature"),
            LoadParams::Point { .. } => variable("forces at points", "Others"),
        }
    };
    design.cases.iter().enumerate().map(of).collect()
}

/// The category is left open: factors and names tell what is meant.
fn combinations(design: &Handed<'_>) -> Vec<Vec<Cell>> {
    let of = |(name, factors): &(&str, Vec<(usize, f64)>)| {
        let mut cells = row![*name, format!("combination {name}"), "Not defined", "Linear"];
        for &(case, factor) in factors {
            cells.extend(row![factor, 1.0, design.cases[case].0]);
        }
        cells
    };
    design.combinations.iter().map(of).collect()
}

const POINT_ACTION: &[&str] = &[
    "Name",
    "Type",
    "Direction",
    "Force action",
    "Reference node",
    "Value [kN]",
    "Vector (X;Y;Z) [kN]",
    "Load case",
    "Coordinate system",
];

fn point_actions(design: &Handed<'_>) -> Vec<Vec<Cell>> {
    let mut rows = Vec::new();
    for ((name, _), case) in design.cases.iter().zip(design.model.load_cases()) {
        for load in &case.nodal {
            let force = Vector3::new(load.load[0], load.load[1], load.load[2]) / 1e3;
            let mut cells = row![format!("F{}", rows.len() + 1), "Standard"];
            let [direction, value, vector] = directed(&force);
            cells.push(direction);
            cells.extend(row!["In node", node(load.node as usize), value, vector, *name, "Global"]);
            rows.push(cells);
        }
    }
    rows
}

/// Direction, value and vector of a load: along z alone, or as a vector.
fn directed(load: &Vector3<f64>) -> [Cell; 3] {
    if load.x == 0.0 && load.y == 0.0 {
        return [Cell::from("Z"), Cell::from(load.z), Cell::Empty];
    }
    let texts: Vec<String> = load.iter().map(|&value| shortest(value).unwrap_or_default()).collect();
    [Cell::from("Vector"), Cell::Empty, Cell::from(format!("({})", texts.join(";")))]
}

const CURVE_ACTION: &[&str] = &[
    "Name",
    "Type",
    "Force action",
    "Distribution",
    "Direction",
    "Value 1 [kN/m]",
    "Vector 1(X;Y;Z) [kN/m]",
    "Member",
    "Load case",
    "Coordinate system",
    "Location",
    "Coordinate definition",
    "Origin",
    "Extent",
    "Start point [m]",
    "End point [m]",
    "Eccentricity ey [mm]",
    "Eccentricity ez [mm]",
];

/// Loads of members, and self weight that is not left to the receiving program.
fn curve_actions(design: &Handed<'_>) -> Vec<Vec<Cell>> {
    let model = design.model;
    let mut rows = Vec::new();
    for ((name, _), case) in design.cases.iter().zip(model.load_cases()) {
        let mut loads = vec![Vector3::zeros(); model.members().len()];
        for load in &case.uniform {
            loads[load.member as usize] += Vector3::from(load.force_per_length);
        }
        if !is_left_to_it(case) {
            for (load, member) in loads.iter_mut().zip(model.members()) {
                let area = model.sections()[member.section as usize].area;
                load.z -= case.gravity * model.material().density * area;
            }
        }
        for (m, load) in loads.iter().enumerate().filter(|(_, load)| **load != Vector3::zeros()) {
            let [direction, value, vector] = directed(&(load / 1e3));
            let mut cells = row![format!("L{}", rows.len() + 1), "Standard", "On beam", "Uniform"];
            cells.extend([direction, value, vector]);
            cells.extend(row![member(m), *name, "Global", "Length", "Relative", "From start", "Full"]);
            cells.extend(row![0.0, 1.0, 0.0, 0.0]);
            rows.push(cells);
        }
    }
    rows
}
