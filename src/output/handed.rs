//! A design's structure as it is handed on to other programs: the frame that was analysed, with the names of its load cases and
//! combinations. What the exporters `frame_model`, `opensees` and `saf` are written from.

use super::results::Developed;
use crate::structure::FrameModel;
use crate::structure::model::{LoadCase, NodalLoad, UniformLoad};
use crate::structure::params::{LoadParams, StructureParams};
use std::collections::BTreeMap;

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
    pub combinations: Vec<(&'a str, Vec<(usize, f64)>)>,
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
        let mut nodal: BTreeMap<u32, [f64; 6]> = BTreeMap::new();
        let mut uniform: BTreeMap<u32, [f64; 3]> = BTreeMap::new();
        let mut gravity = 0.0;
        for &(case, factor) in combination {
            let case = &self.model.load_cases()[case];
            for NodalLoad { node, load } in &case.nodal {
                add(nodal.entry(*node).or_default(), load, factor);
            }
            for UniformLoad { member, force_per_length } in &case.uniform {
                add(uniform.entry(*member).or_default(), force_per_length, factor);
            }
            gravity += factor * case.gravity;
        }
        LoadCase {
            nodal: nodal.into_iter().map(|(node, load)| NodalLoad { node, load }).collect(),
            uniform: uniform
                .into_iter()
                .map(|(member, force_per_length)| UniformLoad { member, force_per_length })
                .collect(),
            gravity,
            ..LoadCase::default()
        }
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

fn add<const N: usize>(sum: &mut [f64; N], load: &[f64; N], factor: f64) {
    sum.iter_mut().zip(load).for_each(|(sum, value)| *sum += factor * value);
}
