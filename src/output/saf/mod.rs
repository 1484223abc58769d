//! Structural Analysis Format: a workbook that RFEM, SCIA and others read (docs/reference/files.md §7).
//!
//! Sheets, headers and words are those of SAF 2.2.0 (<https://www.saf.guide/en/stable>); units are metric: m, kN, MPa, mm for sections. One
//! sheet is one kind of object, one row one object, and names refer from one sheet to another. Nothing in the file tells when it was made.

mod loads;
mod structure;

use super::handed::Handed;
use loads::*;
use rust_xlsxwriter::{DocProperties, ExcelDateTime, Workbook, XlsxError};
use structure::*;

/// The version of the format.
const VERSION: &str = "2.2.0";
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
use row;

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
    sheet("RelConnectsStructuralMember", HINGE, hinges(design))?;
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
    sheet("StructuralPointMoment", POINT_MOMENT, point_moments(design))?;
    sheet("StructuralCurveAction", CURVE_ACTION, curve_actions(design))?;
    sheet("StructuralCurveActionThermal", THERMAL, thermal(design))?;
    sheet("StructuralPointSupportDef", DEFORMATION, deformations(design))?;
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
