//! Sheets of the loads: groups, cases, combinations, and what acts.

use super::structure::{member, node, support};
use super::{Cell, row};
use crate::output::handed::Handed;
use crate::output::number::shortest;
use crate::structure::model::LoadCase;
use crate::structure::params::LoadParams;
use nalgebra::Vector3;

/// What receiving programs make of a load case of self weight, m/s²; nearer than the tolerance it is left to them.
const GRAVITY: (f64, f64) = (9.81, 0.005);

pub(super) const GROUP: &[&str] = &["Name", "Load group type", "Relation", "Load type"];
pub(super) const PERMANENT: &str = "LG1";
pub(super) const VARIABLE: &str = "LG2";

pub(super) fn groups() -> Vec<Vec<Cell>> {
    vec![
        row![PERMANENT, "Permanent", "Together", Cell::Empty],
        row![VARIABLE, "Variable", "Standard", "Snow"],
    ]
}

pub(super) const CASE: &[&str] =
    &["Name", "Description", "Action type", "Load group", "Load type", "Duration"];

/// Whether the receiving program makes the loads of a case itself.
pub(super) fn is_left_to_it(case: &LoadCase) -> bool {
    (case.gravity - GRAVITY.0).abs() <= GRAVITY.1
        && *case == LoadCase { gravity: case.gravity, ..LoadCase::default() }
}

/// What of a case lasts and what comes and goes the config does not say: self weight and loads on the panels count as permanent, what falls
/// on their plan projection as snow, anything else as variable.
pub(super) fn cases(design: &Handed<'_>) -> Vec<Vec<Cell>> {
    let of = |(k, (name, load)): (usize, &(&str, &LoadParams))| {
        let permanent = |what: &str, kind: &str| row![*name, what, "Permanent", PERMANENT, kind, Cell::Empty];
        let variable = |what: &str, kind: &str| row![*name, what, "Variable", VARIABLE, kind, "Short"];
        let case = &design.model.load_cases()[k];
        match load {
            LoadParams::Gravity { .. } if is_left_to_it(case) => {
                permanent("self weight of the members", "Self weight")
            }
            LoadParams::Gravity { .. } => permanent("self weight of the members, as line forces", "Others"),
            LoadParams::Area { .. } => permanent("on the panels, at their corners", "Others"),
            LoadParams::Projected { .. } => {
                variable("on the plan projection of the panels, at their corners", "Snow")
            }
            LoadParams::Pressure { .. } => variable("normal to the panels, at their corners", "Wind"),
            LoadParams::Temperature { .. } => variable("members warmer or colder", "Temperature"),
            LoadParams::Point { .. } => variable("forces at points", "Static"),
        }
    };
    design.cases.iter().enumerate().map(of).collect()
}

/// The category is left open: factors and names tell what is meant.
pub(super) fn combinations(design: &Handed<'_>) -> Vec<Vec<Cell>> {
    let of = |(name, factors): &(&str, Vec<(usize, f64)>)| {
        let mut cells = row![*name, format!("combination {name}"), "Not defined", "Linear"];
        for &(case, factor) in factors {
            cells.extend(row![factor, 1.0, design.cases[case].0]);
        }
        cells
    };
    design.combinations.iter().map(of).collect()
}

pub(super) const POINT_ACTION: &[&str] = &[
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

pub(super) fn point_actions(design: &Handed<'_>) -> Vec<Vec<Cell>> {
    let mut rows = Vec::new();
    for ((name, _), case) in design.cases.iter().zip(design.model.load_cases()) {
        for load in &case.nodal {
            let force = Vector3::new(load.load[0], load.load[1], load.load[2]) / 1e3;
            if force == Vector3::zeros() {
                continue;
            }
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
pub(super) fn directed(load: &Vector3<f64>) -> [Cell; 3] {
    if load.x == 0.0 && load.y == 0.0 {
        return [Cell::from("Z"), Cell::from(load.z), Cell::Empty];
    }
    let texts: Vec<String> = load.iter().map(|&value| shortest(value).unwrap_or_default()).collect();
    [Cell::from("Vector"), Cell::Empty, Cell::from(format!("({})", texts.join(";")))]
}

pub(super) const CURVE_ACTION: &[&str] = &[
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
pub(super) fn curve_actions(design: &Handed<'_>) -> Vec<Vec<Cell>> {
    let mut rows = Vec::new();
    for ((name, _), case) in design.cases.iter().zip(design.model.load_cases()) {
        if is_left_to_it(case) {
            continue;
        }
        let loads = design.on_members(case).into_iter().enumerate();
        for (m, load) in loads.filter(|(_, load)| *load != Vector3::zeros()) {
            let mut cells = row![format!("L{}", rows.len() + 1), "Standard", "On beam", "Uniform"];
            cells.extend(directed(&(load / 1e3)));
            cells.extend(row![member(m), *name, "Global", "Length", "Relative", "From start", "Full"]);
            cells.extend(row![0.0, 1.0, 0.0, 0.0]);
            rows.push(cells);
        }
    }
    rows
}

pub(super) const POINT_MOMENT: &[&str] = &[
    "Name",
    "Type",
    "Direction",
    "Force action",
    "Reference node",
    "Value [kNm]",
    "Load case",
    "Coordinate system",
];

pub(super) fn point_moments(design: &Handed<'_>) -> Vec<Vec<Cell>> {
    let mut rows = Vec::new();
    for ((name, _), case) in design.cases.iter().zip(design.model.load_cases()) {
        for load in &case.nodal {
            let about = ["Mx", "My", "Mz"].into_iter().zip(&load.load[3..]);
            for (direction, &moment) in about.filter(|(_, moment)| **moment != 0.0) {
                let called = format!("M{}", rows.len() + 1);
                let at = node(load.node as usize);
                rows.push(row![called, "Standard", direction, "In node", at, moment / 1e3, *name, "Global"]);
            }
        }
    }
    rows
}

pub(super) const THERMAL: &[&str] = &[
    "Name",
    "Force action",
    "Variation",
    "deltaT [°C]",
    "Member",
    "Load case",
    "Coordinate definition",
    "Origin",
    "Start point [m]",
    "End point [m]",
];

pub(super) fn thermal(design: &Handed<'_>) -> Vec<Vec<Cell>> {
    let mut rows = Vec::new();
    for ((name, _), case) in design.cases.iter().zip(design.model.load_cases()) {
        for load in &case.temperature {
            let (called, of) = (format!("T{}", rows.len() + 1), member(load.member as usize));
            let mut cells = row![called, "On beam", "Constant", load.kelvin, of, *name];
            cells.extend(row!["Relative", "From start", 0.0, 1.0]);
            rows.push(cells);
        }
    }
    rows
}

pub(super) const DEFORMATION: &[&str] =
    &["Name", "Point support", "Direction", "Translation value [mm]", "Rotation value [mrad]", "Load case"];

pub(super) fn deformations(design: &Handed<'_>) -> Vec<Vec<Cell>> {
    let mut rows = Vec::new();
    for ((name, _), case) in design.cases.iter().zip(design.model.load_cases()) {
        for moved in &case.settlements {
            let directions = ["X", "Y", "Z", "Rx", "Ry", "Rz"].into_iter().zip(moved.displacement);
            for (d, (direction, by)) in directions.enumerate().filter(|(_, (_, by))| *by != 0.0) {
                let (translation, rotation) = match d < 3 {
                    true => (Cell::from(by * 1e3), Cell::Empty),
                    false => (Cell::Empty, Cell::from(by * 1e3)),
                };
                let called = format!("D{}", rows.len() + 1);
                rows.push(row![called, support(moved.node), direction, translation, rotation, *name]);
            }
        }
    }
    rows
}
