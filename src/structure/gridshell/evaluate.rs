//! A grid shell at one height after another: statics of every combination, buckling, requirements.

use super::metrics::{self, Answer, Metrics};
use super::model::GridshellModel;
use super::{AnalysisError, BucklingMode, Certificate, Place, RequirementResult, Response};
use crate::structure::buckling::{self, Mode, Search};
use crate::structure::forces::{MemberForces, Utilisation};
use crate::structure::frame::{by_node, silence};
use crate::structure::mechanism;
use crate::structure::model::NodeId;
use crate::structure::params::{HeightParams, Quantity, RequirementParams, StructureParams};
use crate::structure::second_order::Room;
use crate::structure::section::Section;
use crate::structure::solver::{Combination, Solver};
use nalgebra::Vector3;

/// Residual of the buckling mode at which λ is good to about its square.
const MODE_TOLERANCE: f64 = 3e-5;

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

/// One combination at the current height.
struct State {
    name: String,
    cases: Combination,
    member_loads: Vec<Vector3<f64>>,
    first_axial: Vec<f64>,
    axial: Vec<f64>,
    metrics: Option<Metrics>,
    mode: Option<Option<Mode>>,
    /// Proved: K + Kg of its second order is positive definite.
    stable: bool,
}

/// The model with everything that is kept between heights.
pub struct Evaluator<'a> {
    model: &'a GridshellModel,
    params: &'a StructureParams,
    solver: Solver<'a>,
    states: Vec<State>,
    /// Loads and displacements of all combinations, one column after the other.
    f: Vec<f64>,
    u: Vec<f64>,
    first_order: Vec<f64>,
    room: Room,
    reactions: Vec<f64>,
    section: Option<Section>,
}

impl<'a> Evaluator<'a> {
    /// Prepares the analysis of every combination.
    pub fn new(model: &'a GridshellModel, params: &'a StructureParams) -> Result<Self, AnalysisError> {
        let case = |name: &String| params.loads.keys().position(|known| known == name);
        let states: Vec<State> = params
            .combinations
            .iter()
            .map(|(name, cases)| State {
                name: name.clone(),
                cases: cases.iter().filter_map(|(name, &factor)| Some((case(name)?, factor))).collect(),
                member_loads: Vec::new(),
                first_axial: Vec::new(),
                axial: Vec::new(),
                metrics: None,
                mode: None,
                stable: false,
            })
            .collect();
        let solver = Solver::new(&model.frame)?;
        Ok(Self {
            f: vec![0.0; solver.system().unknowns() * states.len()],
            u: Vec::new(),
            first_order: Vec::new(),
            room: Room::default(),
            reactions: Vec::new(),
            section: None,
            solver,
            model,
            params,
            states,
        })
    }

    /// Statics of all combinations with sections of this height.
    ///
    /// In second order what does not settle is unstable; what settles is stable only after [`Evaluator::prove_stable`].
    pub fn statics(&mut self, height: f64) -> Result<(), AnalysisError> {
        let section = Section::of_params(&self.params.section, height)?;
        if self.section == Some(section) {
            return Ok(());
        }
        self.section = None;
        self.solver.set_sections(&[section])?;
        let n = self.solver.system().unknowns();
        for (state, f) in self.states.iter_mut().zip(self.f.chunks_mut(n)) {
            self.solver.member_loads(&state.cases, &mut state.member_loads);
            self.solver.load_vector(&state.cases, &state.member_loads, f);
            (state.metrics, state.mode, state.stable) = (None, None, self.params.order != 2);
        }
        self.u.clone_from(&self.f);
        self.solver.solve(&mut self.u);
        if self.u.iter().any(|v| !v.is_finite()) {
            return Err(AnalysisError::NotFinite("a displacement"));
        }
        for (state, u) in self.states.iter_mut().zip(self.u.chunks(n)) {
            self.solver.axial_forces(u, &mut state.first_axial);
            silence(&self.solver, u, &mut state.first_axial);
        }
        if self.params.order == 2 {
            self.second_order()?;
        }
        for (state, u) in self.states.iter_mut().zip(self.u.chunks(n)) {
            self.solver.axial_forces(u, &mut state.axial);
        }
        self.section = Some(section);
        Ok(())
    }

    /// All combinations together with the factor of K; if that does not settle, one by one with factors of K + Kg,
    /// which always tells.
    fn second_order(&mut self) -> Result<(), AnalysisError> {
        let n = self.solver.system().unknowns();
        let tolerance = self.params.second_order_tolerance;
        self.first_order.clone_from(&self.u);
        if self.solver.iterate_second_order(&self.f, &mut self.u, tolerance, &mut self.room) {
            return Ok(());
        }
        for s in 0..self.states.len() {
            let columns = s * n..(s + 1) * n;
            match self.solver.second_order(
                &self.f[columns.clone()],
                &self.first_order[columns.clone()],
                tolerance,
            ) {
                Ok(found) => self.u[columns].copy_from_slice(&found),
                Err(_) => return Err(self.unstable(s)),
            }
            self.states[s].stable = true;
        }
        Ok(())
    }

    /// Makes sure that K + Kg(N) of every combination's second order is positive definite: that the answer is a stable
    /// equilibrium. The factor of K gives way.
    ///
    /// Kg grows with N in the sense of quadratic forms (a member's is N times a positive semidefinite matrix), so one
    /// Cholesky factorisation with the least N that a member has in any combination does for all of them. Only if it
    /// fails are they told apart.
    ///
    /// # Errors
    /// [`AnalysisError::Unstable`].
    pub fn prove_stable(&mut self) -> Result<(), AnalysisError> {
        let doubtful: Vec<usize> = (0..self.states.len()).filter(|&s| !self.states[s].stable).collect();
        let Some((&first, others)) = doubtful.split_first() else { return Ok(()) };
        let mut least = self.states[first].axial.clone();
        for &s in others {
            least.iter_mut().zip(&self.states[s].axial).for_each(|(least, n)| *least = least.min(*n));
        }
        let together = self.solver.factorise_shifted(&least, 1.0).is_ok();
        for &s in &doubtful {
            let stable = together
                || (!others.is_empty() && self.solver.factorise_shifted(&self.states[s].axial, 1.0).is_ok());
            if !stable {
                return Err(self.unstable(s));
            }
            self.states[s].stable = true;
        }
        Ok(())
    }

    /// Names what gives way in a combination: the first buckling mode under its first-order axial forces.
    fn unstable(&mut self, index: usize) -> AnalysisError {
        let search = Search { modes: 1, tolerance: 1e-4 };
        let state = &self.states[index];
        match buckling::modes(&mut self.solver, &state.first_axial, search)
            .ok()
            .and_then(|mut modes| modes.pop())
        {
            Some(mode) => AnalysisError::Unstable {
                combination: state.name.clone(),
                motion: mechanism::largest(self.solver.model(), self.solver.system(), &mode.shape),
            },
            None => AnalysisError::NoConvergence("second-order"),
        }
    }

    /// The largest share of a limit that is used, of the requirements that statics decide.
    pub fn used(&mut self) -> Result<f64, AnalysisError> {
        self.most_used(false)
    }

    /// The same of the requirements on buckling factors; infinite if a combination is not stable.
    pub fn used_by_buckling(&mut self) -> Result<f64, AnalysisError> {
        let used = self.most_used(true)?;
        match self.prove_stable() {
            Ok(()) => Ok(used),
            Err(AnalysisError::Unstable { .. } | AnalysisError::NoConvergence(_)) => Ok(f64::INFINITY),
            Err(other) => Err(other),
        }
    }

    fn most_used(&mut self, by_buckling: bool) -> Result<f64, AnalysisError> {
        let mut used = 0.0f64;
        for required in &self.params.requirements {
            if (required.quantity == Quantity::BucklingFactor) == by_buckling {
                used = used.max(self.requirement(required)?.used());
            }
        }
        Ok(used)
    }

    fn answer(&self, index: usize) -> Answer<'_> {
        let n = self.solver.system().unknowns();
        let state = &self.states[index];
        Answer {
            u: &self.u[index * n..(index + 1) * n],
            f: &self.f[index * n..(index + 1) * n],
            axial: (self.params.order == 2).then_some(state.axial.as_slice()),
            member_loads: &state.member_loads,
        }
    }

    /// The largest values of a combination.
    fn metrics(&mut self, index: usize) -> Metrics {
        if let Some(metrics) = self.states[index].metrics {
            return metrics;
        }
        let mut reactions = std::mem::take(&mut self.reactions);
        let metrics = metrics::measure(self.model, &self.solver, self.answer(index), &mut reactions);
        self.reactions = reactions;
        self.states[index].metrics = Some(metrics);
        metrics
    }

    /// The first buckling mode of a combination.
    fn mode(&mut self, index: usize) -> Result<Option<Mode>, AnalysisError> {
        let state = &self.states[index];
        if let Some(known) = &state.mode {
            return Ok(known.clone());
        }
        let search = Search { modes: 1, tolerance: MODE_TOLERANCE };
        let mode = buckling::modes(&mut self.solver, &state.first_axial, search)
            .map_err(|_| AnalysisError::NoConvergence("buckling"))?
            .pop();
        self.states[index].mode = Some(mode.clone());
        Ok(mode)
    }

    fn index_of(&self, name: &str) -> Option<usize> {
        self.states.iter().position(|state| state.name == name)
    }

    /// The combination that gives a quantity as a metric; see the module's description.
    fn combination_of(&self, quantity: Quantity) -> usize {
        let deflections = [Quantity::Deflection, Quantity::DeflectionVertical];
        let utilisations = [Quantity::Utilisation, Quantity::UtilisationAll, Quantity::UtilisationVonMises];
        let family = [deflections.as_slice(), utilisations.as_slice(), &[Quantity::BucklingFactor]]
            .into_iter()
            .find(|family| family.contains(&quantity))
            .unwrap_or(&[]);
        let requirements = &self.params.requirements;
        let named = requirements
            .iter()
            .find(|r| r.quantity == quantity)
            .or_else(|| requirements.iter().find(|r| family.contains(&r.quantity)))
            .map(|r| r.combination.as_str());
        let usual = if deflections.contains(&quantity) { "sls" } else { "uls" };
        named
            .and_then(|name| self.index_of(name))
            .or_else(|| self.index_of(usual))
            .unwrap_or(self.states.len() - 1)
    }

    /// How a requirement fares at the current height.
    pub fn requirement(&mut self, required: &RequirementParams) -> Result<RequirementResult, AnalysisError> {
        let index = self.index_of(&required.combination).ok_or_else(|| AnalysisError::Params {
            key: "requirement.combination".into(),
            message: format!("there is no combination {:?}", required.combination),
        })?;
        let (value, place) = self.value(required.quantity, index)?;
        let (limit, upper) = match (required.max, required.min) {
            (Some(max), _) => (max, true),
            (None, min) => (min.unwrap_or(0.0), false),
        };
        let combination = required.combination.clone();
        Ok(RequirementResult { quantity: required.quantity, combination, place, value, limit, upper })
    }

    fn value(&mut self, quantity: Quantity, index: usize) -> Result<(f64, Place), AnalysisError> {
        if quantity == Quantity::BucklingFactor {
            return Ok(match self.mode(index)? {
                None => (f64::INFINITY, Place::Whole),
                Some(mode) => (mode.factor, self.place_of(&mode)),
            });
        }
        let metrics = self.metrics(index);
        Ok(match quantity {
            Quantity::Deflection => metrics.deflection,
            Quantity::DeflectionVertical => metrics.deflection_vertical,
            Quantity::Utilisation => metrics.utilisation,
            Quantity::UtilisationAll => metrics.utilisation_all,
            Quantity::UtilisationVonMises | Quantity::BucklingFactor => metrics.von_mises,
        })
    }

    fn place_of(&self, mode: &Mode) -> Place {
        Place::Node(mechanism::largest(&self.model.frame, self.solver.system(), &mode.shape).node.0)
    }

    /// All metrics and requirements at this height.
    pub fn response(&mut self, height: f64) -> Result<Response, AnalysisError> {
        self.statics(height)?;
        let buckling = self.combination_of(Quantity::BucklingFactor);
        self.mode(buckling)?;
        let requirements: Result<Vec<_>, _> =
            self.params.requirements.iter().map(|r| self.requirement(r)).collect();
        // Last of what needs a factor: it takes the room of that of K.
        self.prove_stable()?;
        let deflection = self.combination_of(Quantity::Deflection);
        let uplift = (0..self.states.len()).map(|s| self.metrics(s).uplift.0).fold(0.0, f64::max);
        let metric = |this: &mut Self, quantity| {
            let index = this.combination_of(quantity);
            Ok::<_, AnalysisError>(this.value(quantity, index)?.0)
        };
        let utilisation = self.combination_of(Quantity::Utilisation);
        let all = self.combination_of(Quantity::UtilisationAll);
        let area = self.solver.sections()[0].area;
        let mass = area * self.params.material.density_kg_m3 * self.model.total_length;
        let response = Response {
            height_m: height,
            height_rounded_m: rounded(height, self.params.height),
            mass_kg: mass,
            mass_per_area_kg_m2: if self.model.panel_area > 0.0 { mass / self.model.panel_area } else { 0.0 },
            member_length_m: self.model.total_length,
            deflection_m: metric(self, Quantity::Deflection)?,
            deflection_vertical_m: metric(self, Quantity::DeflectionVertical)?,
            utilisation: metric(self, Quantity::Utilisation)?,
            utilisation_all: metric(self, Quantity::UtilisationAll)?,
            utilisation_von_mises: metric(self, Quantity::UtilisationVonMises)?,
            utilisation_inner: self.metrics(utilisation).inner.0,
            utilisation_all_inner: self.metrics(all).inner_all.0,
            buckling_factor: metric(self, Quantity::BucklingFactor)?,
            uplift_kn: uplift / 1e3,
            support_slide_m: self.metrics(deflection).slide.0,
            requirements: requirements?,
        };
        check_finite(&response)?;
        Ok(response)
    }

    /// Everything about each combination at the current height, and the proved buckling mode.
    pub fn details(&mut self) -> Result<(Vec<CombinationResult>, Option<BucklingMode>), AnalysisError> {
        let results = (0..self.states.len())
            .map(|s| {
                let metrics = self.metrics(s);
                self.detail(s, metrics)
            })
            .collect();
        let index = self.combination_of(Quantity::BucklingFactor);
        let Some(mode) = self.mode(index)? else { return Ok((results, None)) };
        let axial = &self.states[index].first_axial;
        let certificate = Certificate {
            none_below: self.solver.factorise_shifted(axial, 0.999 * mode.factor).is_ok(),
            one_here: self.solver.factorise_shifted(axial, 1.001 * mode.factor).is_err(),
        };
        let mut shape = by_node(self.solver.system(), &mode.shape, self.model.frame.nodes().len());
        let size = shape.iter().map(|d| Vector3::new(d[0], d[1], d[2]).norm()).fold(0.0, f64::max);
        if size > 0.0 {
            shape.iter_mut().flatten().for_each(|d| *d /= size);
        }
        let combination = self.states[index].name.clone();
        Ok((results, Some(BucklingMode { combination, factor: mode.factor, shape, certificate })))
    }

    fn detail(&self, index: usize, metrics: Metrics) -> CombinationResult {
        let (state, answer) = (&self.states[index], self.answer(index));
        let nodes = self.model.frame.nodes().len();
        let pushes =
            by_node(self.solver.system(), &self.solver.reactions(answer.u, answer.axial, answer.f), nodes);
        let fixed = self.model.frame.fixed();
        let held = |n: usize| std::array::from_fn(|d| fixed[n][d].then_some(pushes[n][d]));
        CombinationResult {
            name: state.name.clone(),
            metrics,
            displacements: by_node(self.solver.system(), answer.u, nodes),
            member_forces: self.solver.member_forces(answer.u, answer.axial, answer.member_loads),
            member_utilisation: metrics::utilisations(self.model, &self.solver, answer).collect(),
            reactions: self.model.frame.supported().map(|node| (node, held(node.0 as usize))).collect(),
        }
    }
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
