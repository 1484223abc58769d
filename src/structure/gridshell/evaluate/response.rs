//! What is told of a grid shell at one height: the worst over combinations, requirements, and all results for export.

use super::super::metrics::{self, Metrics};
use super::super::{
    AnalysisError, BucklingMode, Certificate, Governing, Place, Proof, RequirementResult, Response,
};
use super::{Evaluator, State};
use crate::structure::buckling::Mode;
use crate::structure::forces::{MemberForces, Utilisation};
use crate::structure::frame::by_node;
use crate::structure::mechanism;
use crate::structure::model::NodeId;
use crate::structure::params::{Family, HeightParams, Quantity, RequirementParams};
use nalgebra::Vector3;

/// All results of one combination, for export.
#[derive(Clone, Debug, PartialEq)]
pub struct CombinationResult {
    /// Its name.
    pub name: String,
    /// Its largest values.
    pub metrics: Metrics,
    /// ux … rz of each node (m, rad).
    pub displacements: Vec<[f64; 6]>,
    /// Forces of each member.
    pub member_forces: Vec<MemberForces>,
    /// Utilisation of each member.
    pub member_utilisation: Vec<Utilisation>,
    /// Reactions at supported nodes (N, Nm); `None` where nothing is held.
    pub reactions: Vec<(NodeId, [Option<f64>; 6])>,
}

/// The worst of a quantity over combinations.
#[derive(Clone, Copy, Debug)]
struct Worst {
    value: f64,
    place: Place,
    combination: usize,
}

impl Evaluator<'_> {
    /// The combinations over which a quantity is the worst as a metric, by name; see the module's description.
    fn combinations_of(&self, quantity: Quantity) -> Vec<usize> {
        let requirements = &self.params.requirements;
        let named = |wanted: &dyn Fn(Quantity) -> bool| -> Vec<usize> {
            let names = |state: &State| {
                requirements.iter().any(|r| {
                    r.analysed().is_some_and(wanted) && r.combination.as_deref() == Some(&*state.name)
                })
            };
            (0..self.states.len()).filter(|&s| names(&self.states[s])).collect()
        };
        let family = quantity.family();
        let own = named(&|q| q == quantity);
        let related = named(&|q| q.family() == family);
        let usual = family.usual().and_then(|name| self.index_of(name)).into_iter().collect();
        let all = (0..self.states.len()).collect();
        [own, related, usual, all].into_iter().find(|list: &Vec<usize>| !list.is_empty()).unwrap_or_default()
    }

    /// The worst over combinations: the value, where it is, and the combination. Of equal ones the first by name.
    fn worst(
        &mut self,
        combinations: &[usize],
        of: impl Fn(&Metrics) -> (f64, Place),
    ) -> Result<Worst, AnalysisError> {
        let mut worst: Option<Worst> = None;
        for &combination in combinations {
            let (value, place) = of(&self.metrics(combination));
            if worst.is_none_or(|worst| value > worst.value || value.is_nan()) {
                worst = Some(Worst { value, place, combination });
            }
        }
        worst.ok_or_else(no_combination)
    }

    /// The least buckling factor over combinations, and the combination; of equal ones the first by name.
    fn least_factor(&mut self, combinations: &[usize]) -> Result<(f64, usize), AnalysisError> {
        let mut least: Option<(f64, usize)> = None;
        for &s in combinations {
            let factor = self.mode(s)?.map_or(f64::INFINITY, |mode| mode.factor);
            if least.is_none_or(|(known, _)| factor < known || factor.is_nan()) {
                least = Some((factor, s));
            }
        }
        least.ok_or_else(no_combination)
    }

    /// How a requirement of a quantity of the analysis fares at the current height; none of another metric.
    pub fn requirement(
        &mut self,
        required: &RequirementParams,
    ) -> Result<Option<RequirementResult>, AnalysisError> {
        let Some(quantity) = required.analysed() else { return Ok(None) };
        let combinations = match &required.combination {
            Some(name) => vec![self.index_of(name).ok_or_else(|| AnalysisError::Params {
                key: "requirement.combination".into(),
                message: format!("there is no combination {name:?}"),
            })?],
            None => self.combinations_of(quantity),
        };
        let worst = match quantity.family() {
            Family::Buckling => self.worst_buckling(quantity, &combinations)?,
            _ => self.worst(&combinations, |metrics| metrics.of(quantity))?,
        };
        let (limit, upper) = match (required.max, required.min) {
            (Some(max), _) => (max, true),
            (None, min) => (min.unwrap_or(0.0), false),
        };
        let combination = self.states[worst.combination].name.clone();
        Ok(Some(RequirementResult {
            quantity,
            combination,
            place: worst.place,
            value: worst.value,
            limit,
            upper,
        }))
    }

    /// The least factor over combinations, or its inverse, and where that mode moves most.
    fn worst_buckling(&mut self, quantity: Quantity, combinations: &[usize]) -> Result<Worst, AnalysisError> {
        let (factor, combination) = self.least_factor(combinations)?;
        let place = match self.mode(combination)? {
            None => Place::Whole,
            Some(mode) => self.place_of(&mode),
        };
        let value = if quantity == Quantity::Buckling { 1.0 / factor } else { factor };
        Ok(Worst { value, place, combination })
    }

    fn place_of(&self, mode: &Mode) -> Place {
        Place::Node(mechanism::largest(&self.model.frame, self.solver.system(), &mode.shape).node.0)
    }

    /// All metrics and requirements at this height.
    pub fn response(&mut self, height: f64) -> Result<Response, AnalysisError> {
        self.statics(height)?;
        let buckled = self.combinations_of(Quantity::BucklingFactor);
        let (buckling_factor, buckling) = self.least_factor(&buckled)?;
        let requirements = self.params.requirements.iter().map(|r| self.requirement(r));
        let requirements: Result<Vec<_>, _> = requirements.filter_map(Result::transpose).collect();
        // Last of what needs a factor: it takes the room of that of K.
        self.prove_stable()?;
        let mut envelope = |quantity| {
            let combinations = self.combinations_of(quantity);
            self.worst(&combinations, |metrics| metrics.of(quantity))
        };
        let deflection = envelope(Quantity::Deflection)?;
        let vertical = envelope(Quantity::DeflectionVertical)?;
        let utilisation = envelope(Quantity::Utilisation)?;
        let utilisation_all = envelope(Quantity::UtilisationAll)?;
        let von_mises = envelope(Quantity::UtilisationVonMises)?;
        let uplift = envelope(Quantity::Uplift)?;
        let slide = envelope(Quantity::SupportSlide)?;
        let utilisations = self.combinations_of(Quantity::Utilisation);
        let all = self.combinations_of(Quantity::UtilisationAll);
        let area = self.solver.sections()[0].area;
        let mass = area * self.params.material.density_kg_m3 * self.model.total_length;
        let name = |combination: usize| self.states[combination].name.clone();
        let governing = Governing {
            deflection: name(deflection.combination),
            deflection_vertical: name(vertical.combination),
            utilisation: name(utilisation.combination),
            utilisation_all: name(utilisation_all.combination),
            utilisation_von_mises: name(von_mises.combination),
            buckling: (buckling_factor != f64::INFINITY).then(|| name(buckling)),
            uplift: name(uplift.combination),
            support_slide: name(slide.combination),
        };
        let response = Response {
            height_m: height,
            height_rounded_m: rounded(height, self.params.height),
            mass_kg: mass,
            mass_per_area_kg_m2: if self.model.panel_area > 0.0 { mass / self.model.panel_area } else { 0.0 },
            member_length_m: self.model.total_length,
            deflection_m: deflection.value,
            deflection_place: deflection.place,
            deflection_vertical_m: vertical.value,
            utilisation: utilisation.value,
            utilisation_place: utilisation.place,
            utilisation_all: utilisation_all.value,
            utilisation_von_mises: von_mises.value,
            utilisation_inner: self.worst(&utilisations, |m| m.inner)?.value,
            utilisation_all_inner: self.worst(&all, |m| m.inner_all)?.value,
            buckling_factor,
            uplift_kn: uplift.value,
            support_slide_m: slide.value,
            governing,
            requirements: requirements?,
        };
        check_finite(&response)?;
        Ok(response)
    }

    /// The names of the combinations over which `utilisation` is the worst.
    pub fn enveloped(&self) -> Vec<String> {
        let combinations = self.combinations_of(Quantity::Utilisation).into_iter();
        combinations.map(|s| self.states[s].name.clone()).collect()
    }

    /// Everything about each combination at the current height, and the buckling mode.
    pub fn details(
        &mut self,
        proof: Proof,
    ) -> Result<(Vec<CombinationResult>, Option<BucklingMode>), AnalysisError> {
        let results = (0..self.states.len())
            .map(|s| {
                let metrics = self.metrics(s);
                self.detail(s, metrics)
            })
            .collect();
        let buckled = self.combinations_of(Quantity::BucklingFactor);
        let (_, index) = self.least_factor(&buckled)?;
        let Some(mode) = self.mode(index)? else { return Ok((results, None)) };
        let certificate = (proof == Proof::Certificate).then(|| self.certificate(index, mode.factor));
        let mut shape = by_node(self.solver.system(), &mode.shape, self.model.frame.nodes().len());
        let size = shape.iter().map(|d| Vector3::new(d[0], d[1], d[2]).norm()).fold(0.0, f64::max);
        if size > 0.0 {
            shape.iter_mut().flatten().for_each(|d| *d /= size);
        }
        let combination = self.states[index].name.clone();
        Ok((results, Some(BucklingMode { combination, factor: mode.factor, shape, certificate })))
    }

    /// Whether λ is the first buckling factor of a combination.
    fn certificate(&mut self, index: usize, factor: f64) -> Certificate {
        let axial = &self.states[index].first_axial;
        Certificate {
            none_below: self.solver.factorise_shifted(axial, 0.999 * factor).is_ok(),
            one_here: self.solver.factorise_shifted(axial, 1.001 * factor).is_err(),
        }
    }

    fn detail(&self, index: usize, metrics: Metrics) -> CombinationResult {
        let (state, answer) = (&self.states[index], self.answer(index));
        let nodes = self.model.frame.nodes().len();
        let pushes = self.solver.reactions(answer.u, answer.between.axial, answer.f);
        let held = |node| (node, self.solver.support_reaction(node, answer.u, &pushes));
        CombinationResult {
            name: state.name.clone(),
            metrics,
            displacements: by_node(self.solver.system(), answer.u, nodes),
            member_forces: self.solver.member_forces(answer.u, answer.between),
            member_utilisation: metrics::utilisations(self.model, &self.solver, answer).collect(),
            reactions: self.model.frame.supported().map(held).collect(),
        }
    }
}

fn no_combination() -> AnalysisError {
    AnalysisError::Params { key: "combinations".into(), message: "at least one combination is needed".into() }
}

fn rounded(height: f64, params: HeightParams) -> f64 {
    match params {
        HeightParams::Fixed { .. } => height,
        // The small deduction keeps a height that is a whole number of steps but for rounding.
        HeightParams::Sized { step_m, .. } => (height / step_m - 1e-9).ceil() * step_m,
    }
}

fn check_finite(r: &Response) -> Result<(), AnalysisError> {
    let values = [
        (r.mass_kg, "the mass"),
        (r.deflection_m, "the deflection"),
        (r.deflection_vertical_m, "the vertical deflection"),
        (r.utilisation_all, "the utilisation"),
        (r.utilisation_all_inner, "the utilisation"),
        (r.utilisation_von_mises, "the von Mises utilisation"),
        (r.uplift_kn, "the uplift"),
        (r.support_slide_m, "the support slide"),
    ];
    match values.into_iter().find(|(value, _)| !value.is_finite()) {
        None if !r.buckling_factor.is_nan() => Ok(()),
        None => Err(AnalysisError::NotFinite("the buckling factor")),
        Some((_, name)) => Err(AnalysisError::NotFinite(name)),
    }
}
