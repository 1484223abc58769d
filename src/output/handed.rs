//! A design's structure as it is handed on to other programs: the frame that was analysed, with the names of its load cases and
//! combinations. What the exporters `frame_model`, `opensees` and `saf` are written from.

use super::results::Developed;
use crate::structure::FrameModel;
use crate::structure::model::{
    LoadCase, Material, NodalLoad, PressureLoad, Settlement, TemperatureLoad, UniformLoad,
};
use crate::structure::params::{LoadParams, StructureParams};
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// A combination: its name, and load cases by number, each with its factor.
pub type Combination<'a> = (&'a str, Vec<(usize, f64)>);

/// A structure with its loads.
#[derive(Clone, Debug)]
pub struct Handed<'a> {
    /// What it is called: the design's id.
    pub id: &'a str,
    /// Nodes, members, sections, supports and load cases.
    pub model: &'a FrameModel,
    /// The load cases, in the model's order.
    pub cases: Vec<(&'a str, &'a LoadParams)>,
    /// The combinations by name: load cases by number, each with its factor.
    pub combinations: Vec<Combination<'a>>,
    /// 1 or 2: whether the deformed structure is in equilibrium.
    pub order: u8,
}

impl<'a> Handed<'a> {
    /// Of a design that was analysed with these parameters; none of one that has no results.
    pub fn of(developed: &'a Developed, params: &'a StructureParams, id: &'a str) -> Option<Self> {
        let model = &developed.results.as_ref()?.model.frame;
        let place = |case: &String| params.loads.keys().position(|known| known == case);
        let factors = |cases: &BTreeMap<String, f64>| {
            cases.iter().filter_map(|(case, &factor)| Some((place(case)?, factor))).collect()
        };
        Some(Self {
            id,
            model,
            cases: params.loads.iter().map(|(name, load)| (name.as_str(), load)).collect(),
            combinations: params.combinations.iter().map(|(name, c)| (name.as_str(), factors(c))).collect(),
            order: params.order,
        })
    }

    /// The loads of a combination as one load case, those of a node or member together.
    pub fn combined(&self, combination: &[(usize, f64)]) -> LoadCase {
        let mut nodal = BTreeMap::new();
        let mut uniform = BTreeMap::new();
        let mut pressure = BTreeMap::new();
        let mut temperature = BTreeMap::new();
        let mut settlements = BTreeMap::new();
        let mut gravity = 0.0;
        for &(case, factor) in combination {
            let case = &self.model.load_cases()[case];
            case.nodal.iter().for_each(|l| add(&mut nodal, l.node, l.load, factor));
            case.uniform.iter().for_each(|l| add(&mut uniform, l.member, l.force_per_length, factor));
            case.pressure.iter().for_each(|l| add(&mut pressure, l.member, [l.force_per_length], factor));
            case.temperature.iter().for_each(|l| add(&mut temperature, l.member, [l.kelvin], factor));
            case.settlements.iter().for_each(|l| add(&mut settlements, l.node, l.displacement, factor));
            gravity += factor * case.gravity;
        }
        let nodal = nodal.into_iter().map(|(node, load)| NodalLoad { node, load });
        let uniform =
            uniform.into_iter().map(|(member, force_per_length)| UniformLoad { member, force_per_length });
        let pressure = pressure
            .into_iter()
            .map(|(member, [force_per_length])| PressureLoad { member, force_per_length });
        let temperature =
            temperature.into_iter().map(|(member, [kelvin])| TemperatureLoad { member, kelvin });
        let settlements =
            settlements.into_iter().map(|(node, displacement)| Settlement { node, displacement });
        LoadCase {
            nodal: nodal.collect(),
            uniform: uniform.collect(),
            gravity,
            pressure: pressure.collect(),
            temperature: temperature.collect(),
            settlements: settlements.collect(),
        }
    }

    /// The uniform load on each member in global axes, N/m: loads of members, pressure and self weight.
    pub fn on_members(&self, case: &LoadCase) -> Vec<Vector3<f64>> {
        let model = self.model;
        let mut loads = vec![Vector3::zeros(); model.members().len()];
        for load in &case.uniform {
            loads[load.member as usize] += Vector3::from(load.force_per_length);
        }
        for load in &case.pressure {
            loads[load.member as usize] -= model.axes()[load.member as usize].z * load.force_per_length;
        }
        if case.gravity != 0.0 {
            let weight = case.gravity * model.material().density;
            for (load, member) in loads.iter_mut().zip(model.members()) {
                load.z -= weight * model.sections()[member.section as usize].area;
            }
        }
        loads
    }

    /// The springs of a support, N/m and Nm/rad; 0 where there is none.
    pub fn springs(&self, node: u32) -> [f64; 6] {
        let mut springs = [0.0; 6];
        for spring in self.model.springs().iter().filter(|spring| spring.node == node) {
            springs[spring.direction] = spring.stiffness;
        }
        springs
    }

    /// EI/L about y and z of a member, and GJ/L about x before them, Nm/rad: what joints are measured by.
    pub fn stiffness(&self, member: usize) -> [f64; 3] {
        let model = self.model;
        let section = &model.sections()[model.members()[member].section as usize];
        let Material { youngs_modulus: e, shear_modulus: g, .. } = *model.material();
        [g * section.j, e * section.iy, e * section.iz]
            .map(|stiffness| stiffness / model.axes()[member].length)
    }

    /// A name for the files of each combination, without what file systems and other languages trip over; each once.
    pub fn file_names(&self) -> Vec<String> {
        let plain = |c: char| if c.is_ascii_alphanumeric() || "-.".contains(c) { c } else { '_' };
        let mut names: Vec<String> = Vec::new();
        for (k, (combination, _)) in self.combinations.iter().enumerate() {
            let name: String = combination.chars().map(plain).collect();
            let name = if names.contains(&name) { format!("{name}_{k}") } else { name };
            names.push(name);
        }
        names
    }
}

/// Adds a share of a load to what there is of its node or member.
fn add<const N: usize>(sums: &mut BTreeMap<u32, [f64; N]>, place: u32, load: [f64; N], factor: f64) {
    let sum = sums.entry(place).or_insert([0.0; N]);
    sum.iter_mut().zip(load).for_each(|(sum, value)| *sum += factor * value);
}
