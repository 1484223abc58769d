//! A design with its structural results: tables of nodes and members, and two VTU files.

use super::table::{Cell, Table};
use super::vtu::{Field, Grid, vtu};
use crate::geometry::Pattern;
use crate::geometry::metrics::{edge_lengths, panel_area, panel_curvature, panel_skewness};
use crate::search::round_significant;
use crate::structure::forces::{Resultants, Utilisation};
use crate::structure::gridshell::{CombinationResult, Detailed};

/// A pattern and, where one was made, its analysis.
#[derive(Clone, Copy, Debug)]
pub struct Analysed<'a> {
    /// The pattern.
    pub pattern: &'a Pattern,
    /// Its analysis.
    pub results: Option<&'a Detailed>,
    /// Whether it is of first order: then extremes between the ends of members count for `utilisation`.
    pub first_order: bool,
}

const DIRECTIONS: [&str; 6] = ["ux_m", "uy_m", "uz_m", "rx_rad", "ry_rad", "rz_rad"];
const REACTIONS: [&str; 6] = ["fx_n", "fy_n", "fz_n", "mx_nm", "my_nm", "mz_nm"];
const RESULTANTS: [&str; 6] = ["n_n", "vy_n", "vz_n", "mt_nm", "my_nm", "mz_nm"];

impl<'a> Analysed<'a> {
    fn combinations(&self) -> &'a [CombinationResult] {
        self.results.map_or(&[], |results| &results.combinations)
    }

    /// Positions of all nodes, those inside split members included, m.
    fn nodes(&self) -> &[[f64; 3]] {
        self.results.map_or(&self.pattern.positions, |results| results.model.frame.nodes())
    }

    /// Start and end of every member.
    fn members(&self) -> Vec<[u32; 2]> {
        match self.results {
            Some(results) => results.model.frame.members().iter().map(|m| [m.start, m.end]).collect(),
            None => self.pattern.edges.clone(),
        }
    }

    /// `ID_nodes.csv`: positions, displacements and reactions by combination, first buckling mode.
    pub fn nodes_table(&self) -> Table {
        let mut columns: Vec<String> = ["node", "x_m", "y_m", "z_m"].map(str::to_owned).into();
        for combination in self.combinations() {
            let named = |name: &&str| format!("{}_{name}", combination.name);
            columns.extend(DIRECTIONS.iter().map(named));
            columns.extend(REACTIONS.iter().map(|name| format!("{}_reaction_{name}", combination.name)));
        }
        let mode = self.results.and_then(|results| results.mode.as_ref());
        if mode.is_some() {
            columns.extend(["ux", "uy", "uz", "rx", "ry", "rz"].map(|name| format!("buckling_mode_{name}")));
        }
        let mut table = Table::new(columns);
        table.rows = self
            .nodes()
            .iter()
            .enumerate()
            .map(|(n, position)| {
                let mut cells = vec![Cell::from(n as u64)];
                cells.extend(position.map(Cell::from));
                cells
            })
            .collect();
        for combination in self.combinations() {
            let reactions = reactions_by_node(combination, table.rows.len());
            for ((row, moved), held) in table.rows.iter_mut().zip(&combination.displacements).zip(reactions) {
                row.extend(moved.map(result));
                row.extend(held.map(|force| force.map_or(Cell::Empty, result)));
            }
        }
        if let Some(mode) = mode {
            for (row, shape) in table.rows.iter_mut().zip(&mode.shape) {
                row.extend(shape.map(result));
            }
        }
        table
    }

    /// The combination that the metric `utilisation` is taken from: the one with its value.
    pub fn governing(&self) -> Option<&'a CombinationResult> {
        let value = self.results?.response.utilisation;
        let combinations = self.combinations();
        combinations.iter().find(|c| c.metrics.utilisation.0 == value).or(combinations.last())
    }

    /// What a member uses of its strength, as the metric `utilisation` counts it.
    pub fn utilisation(&self, used: &Utilisation) -> f64 {
        if self.first_order { used.inner } else { used.ends }
    }

    /// `ID_members.csv`: the edge (`from` and `to` are nodes), the nodes of this piece of it, length, utilisation, and
    /// forces at both ends by combination.
    ///
    /// Forces are those on the cut face whose outward normal is local +x, in local axes; tension is positive.
    pub fn members_table(&self) -> Table {
        let first =
            ["member", "from", "to", "start_node", "end_node", "length_m", "in_utilisation", "utilisation"];
        let mut columns: Vec<String> = first.map(str::to_owned).into();
        for CombinationResult { name, .. } in self.combinations() {
            for end in ["start", "end"] {
                columns.extend(RESULTANTS.iter().map(|quantity| format!("{name}_{end}_{quantity}")));
            }
            columns.extend(
                ["utilisation", "utilisation_inner", "utilisation_von_mises"].map(|u| format!("{name}_{u}")),
            );
        }
        let mut table = Table::new(columns);
        let lengths = self.member_lengths();
        let governing = self.governing();
        for (m, [start, end]) in self.members().into_iter().enumerate() {
            let edge = self.results.map_or(m, |results| results.model.edge[m] as usize);
            let [from, to] = self.pattern.edges[edge];
            let nodes = [from, to, start, end].map(|node| Cell::from(u64::from(node)));
            let mut cells = vec![Cell::from(m as u64)];
            cells.extend(nodes);
            cells.push(lengths[m].into());
            cells.push(self.results.map_or(Cell::Empty, |results| results.model.counts[m].into()));
            cells.push(governing.map_or(Cell::Empty, |c| result(self.utilisation(&c.member_utilisation[m]))));
            for combination in self.combinations() {
                let forces = &combination.member_forces[m];
                cells.extend([forces.start, forces.end].into_iter().flat_map(resultants).map(result));
                let used = &combination.member_utilisation[m];
                cells.extend([self.utilisation(used), used.inner, used.von_mises].map(result));
            }
            table.rows.push(cells);
        }
        table
    }

    fn member_lengths(&self) -> Vec<f64> {
        match (self.results, self.combinations().first()) {
            (Some(_), Some(combination)) => {
                combination.member_forces.iter().map(|forces| forces.length).collect()
            }
            _ => edge_lengths(self.pattern),
        }
    }

    /// `ID.vtu`: panels with their measures, nodes with their displacements.
    pub fn panels_vtu(&self) -> Vec<u8> {
        let pattern = self.pattern;
        let cells: Vec<&[u32]> = pattern.panels.iter().map(|panel| panel.corners()).collect();
        let coarse_face: Vec<f64> = pattern.coarse_face.iter().map(|&face| f64::from(face)).collect();
        let shapes = PanelShapes::of(pattern);
        let area: Vec<f64> =
            pattern.panels.iter().map(|panel| panel_area(&pattern.positions, panel)).collect();
        let fields = [
            scalar("coarse_face", &coarse_face),
            scalar("curvature", &shapes.curvature),
            scalar("skewness", &shapes.skewness),
            scalar("area_m2", &area),
        ];
        let displacements = self.displacements(pattern.positions.len());
        vtu(&Grid {
            points: &pattern.positions,
            cells: &cells,
            point_fields: &displacements.iter().map(NamedField::field).collect::<Vec<_>>(),
            cell_fields: &fields,
        })
    }

    /// `ID_members.vtu`: members with their forces and utilisation, nodes with their displacements.
    pub fn members_vtu(&self) -> Vec<u8> {
        let members = self.members();
        let cells: Vec<&[u32]> = members.iter().map(<[u32; 2]>::as_slice).collect();
        let mut fields =
            vec![NamedField { name: "length_m".into(), components: 1, values: self.member_lengths() }];
        if let Some(governing) = self.governing() {
            let values = governing.member_utilisation.iter().map(|used| self.utilisation(used)).collect();
            fields.push(NamedField { name: "utilisation".into(), components: 1, values }.rounded());
        }
        for combination in self.combinations() {
            fields.extend(self.member_fields(combination).map(NamedField::rounded));
        }
        let displacements = self.displacements(self.nodes().len());
        vtu(&Grid {
            points: self.nodes(),
            cells: &cells,
            point_fields: &displacements.iter().map(NamedField::field).collect::<Vec<_>>(),
            cell_fields: &fields.iter().map(NamedField::field).collect::<Vec<_>>(),
        })
    }

    /// Displacements of the first `count` nodes by combination, and the first buckling mode.
    fn displacements(&self, count: usize) -> Vec<NamedField> {
        let translations =
            |all: &[[f64; 6]]| all.iter().take(count).flat_map(|u| [u[0], u[1], u[2]]).collect();
        let by_combination = self.combinations().iter().map(|combination| NamedField {
            name: format!("{}_displacement_m", combination.name),
            components: 3,
            values: translations(&combination.displacements),
        });
        let mode = self.results.and_then(|results| results.mode.as_ref()).map(|mode| NamedField {
            name: "buckling_mode".into(),
            components: 3,
            values: translations(&mode.shape),
        });
        by_combination.chain(mode).map(NamedField::rounded).collect()
    }

    /// Mean axial force, largest bending moment of the two ends, utilisation as the metric counts it.
    fn member_fields(&self, combination: &CombinationResult) -> [NamedField; 4] {
        let forces = &combination.member_forces;
        let scalar = |name: &str, values: Vec<f64>| NamedField {
            name: format!("{}_{name}", combination.name),
            components: 1,
            values,
        };
        let worse = |a: f64, b: f64| if a.abs() >= b.abs() { a } else { b };
        [
            scalar("axial_force_n", forces.iter().map(|f| 0.5 * (f.start.n + f.end.n)).collect()),
            scalar("moment_y_nm", forces.iter().map(|f| worse(f.start.my, f.end.my)).collect()),
            scalar("moment_z_nm", forces.iter().map(|f| worse(f.start.mz, f.end.mz)).collect()),
            scalar(
                "utilisation",
                combination.member_utilisation.iter().map(|used| self.utilisation(used)).collect(),
            ),
        ]
    }
}

/// Curvature and skewness of each panel; 0 for triangles, which have neither.
pub struct PanelShapes {
    /// C of each panel.
    pub curvature: Vec<f64>,
    /// S of each panel.
    pub skewness: Vec<f64>,
}

impl PanelShapes {
    /// Measures every panel.
    pub fn of(pattern: &Pattern) -> Self {
        let measured = |measure: fn(&[[f64; 3]]) -> f64| {
            let of_panel = |corners: &[u32]| match corners.len() {
                4 => measure(&corners.iter().map(|&v| pattern.positions[v as usize]).collect::<Vec<_>>()),
                _ => 0.0,
            };
            pattern.panels.iter().map(|panel| of_panel(panel.corners())).collect()
        };
        Self { curvature: measured(panel_curvature), skewness: measured(panel_skewness) }
    }
}

/// A result in 10 significant digits: more are noise, and twice the size.
fn result(value: f64) -> Cell {
    Cell::Number(round_significant(value))
}

struct NamedField {
    name: String,
    components: usize,
    values: Vec<f64>,
}

impl NamedField {
    fn rounded(mut self) -> Self {
        self.values.iter_mut().for_each(|value| *value = round_significant(*value));
        self
    }

    fn field(&self) -> Field<'_> {
        Field { name: &self.name, components: self.components, values: &self.values }
    }
}

fn scalar<'a>(name: &'a str, values: &'a [f64]) -> Field<'a> {
    Field { name, components: 1, values }
}

fn resultants(r: Resultants) -> [f64; 6] {
    [r.n, r.vy, r.vz, r.mt, r.my, r.mz]
}

fn reactions_by_node(combination: &CombinationResult, nodes: usize) -> Vec<[Option<f64>; 6]> {
    let mut reactions = vec![[None; 6]; nodes];
    for (node, reaction) in &combination.reactions {
        if let Some(place) = reactions.get_mut(node.0 as usize) {
            *place = *reaction;
        }
    }
    reactions
}
