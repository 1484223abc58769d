//! A grid shell at one height after another: statics of every combination, buckling, requirements.

use super::model::GridshellModel;
use super::{AnalysisError, BucklingMode, Certificate, Place, RequirementResult, Response};
use crate::structure::buckling::{self, Mode, Search};
use crate::structure::forces::{MemberForces, Utilisation};
use crate::structure::frame::{by_node, silence};
use crate::structure::mechanism;
use crate::structure::model::NodeId;
use crate::structure::params::{HeightParams, Quantity, RequirementParams, StructureParams};
use crate::structure::section::Section;
use crate::structure::solver::{Combination, Solver};
use nalgebra::Vector3;

/// Residual of the buckling mode at which λ is good to about its square.
const MODE_TOLERANCE: f64 = 3e-5;

/// The largest values of one combination, and where they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metrics {
    /// Resultant displacement, m.
    pub deflection: (f64, Place),
    /// Vertical displacement, m.
    pub deflection_vertical: (f64, Place),
    /// Elastic utilisation outside the excluded zones (member ends only in second order).
    pub utilisation: (f64, Place),
    /// The same of all members.
    pub utilisation_all: (f64, Place),
    /// Von Mises utilisation outside the excluded zones.
    pub von_mises: (f64, Place),
    /// Elastic utilisation outside the excluded zones, extremes between the ends included.
    pub inner: (f64, Place),
    /// The same of all members.
    pub inner_all: (f64, Place),
    /// Pull on a support, N.
    pub uplift: (f64, Place),
    /// Horizontal movement of a supported node, m.
    pub slide: (f64, Place),
}

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
    f: Vec<f64>,
    u: Vec<f64>,
    first_axial: Vec<f64>,
    axial: Vec<f64>,
    metrics: Option<Metrics>,
    mode: Option<Option<Mode>>,
    /// Proved: the first buckling factor is greater than this.
    stable_to: f64,
}

/// The model with everything that is kept between heights.
pub struct Evaluator<'a> {
    model: &'a GridshellModel,
    params: &'a StructureParams,
    solver: Solver<'a>,
    states: Vec<State>,
    section: Option<Section>,
}

impl<'a> Evaluator<'a> {
    /// Prepares the analysis of every combination.
    pub fn new(model: &'a GridshellModel, params: &'a StructureParams) -> Result<Self, AnalysisError> {
        let case = |name: &String| params.loads.keys().position(|known| known == name);
        let states = params
            .combinations
            .iter()
            .map(|(name, cases)| State {
                name: name.clone(),
                cases: cases.iter().filter_map(|(name, &factor)| Some((case(name)?, factor))).collect(),
                member_loads: Vec::new(),
                f: Vec::new(),
                u: Vec::new(),
                first_axial: Vec::new(),
                axial: Vec::new(),
                metrics: None,
                mode: None,
                stable_to: 0.0,
            })
            .collect();
        Ok(Self { solver: Solver::new(&model.frame)?, model, params, states, section: None })
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
        let mut f = Vec::with_capacity(n * self.states.len());
        for state in &mut self.states {
            self.solver.member_loads(&state.cases, &mut state.member_loads);
            state.f.resize(n, 0.0);
            self.solver.load_vector(&state.cases, &state.member_loads, &mut state.f);
            f.extend_from_slice(&state.f);
            (state.metrics, state.mode, state.stable_to) = (None, None, 0.0);
        }
        let mut u = f.clone();
        self.solver.solve(&mut u);
        if u.iter().any(|v| !v.is_finite()) {
            return Err(AnalysisError::NotFinite("a displacement"));
        }
        for (state, u) in self.states.iter_mut().zip(u.chunks(n)) {
            self.solver.axial_forces(u, &mut state.first_axial);
            silence(&self.solver, u, &mut state.first_axial);
        }
        if self.params.order == 2 {
            self.second_order(&f, &mut u)?;
        }
        for (state, u) in self.states.iter_mut().zip(u.chunks(n)) {
            state.u.clear();
            state.u.extend_from_slice(u);
            self.solver.axial_forces(u, &mut state.axial);
        }
        self.section = Some(section);
        Ok(())
    }

    /// All combinations together with the factor of K; if that does not settle, one by one with factors of K + Kg,
    /// which always tells.
    fn second_order(&mut self, f: &[f64], u: &mut [f64]) -> Result<(), AnalysisError> {
        // Enough for λ > 1.5 at the default tolerance.
        const MOST: usize = 40;
        let n = self.solver.system().unknowns();
        let tolerance = self.params.second_order_tolerance;
        let first = u.to_vec();
        if self.solver.iterate_second_order(f, u, tolerance, MOST) {
            return Ok(());
        }
        for (s, state) in self.states.iter().enumerate() {
            let columns = s * n..(s + 1) * n;
            match self.solver.second_order(&state.f, &first[columns.clone()], tolerance) {
                Ok(found) => u[columns].copy_from_slice(&found),
                Err(_) => return Err(unstable(&mut self.solver, &state.first_axial, state.name.clone())),
            }
        }
        Ok(())
    }

    /// Makes sure that K + Kg of every combination's second order is positive definite.
    ///
    /// Free of charge where the axial forces in question are nearly t times the first-order ones of a combination whose
    /// first buckling factor is known to be well above t; else a Cholesky factorisation.
    fn prove_stable(&mut self) -> Result<(), AnalysisError> {
        if self.params.order != 2 {
            return Ok(());
        }
        for state in &self.states {
            let known =
                self.states.iter().any(|other| far_below(&state.axial, &other.first_axial, other.stable_to));
            if !known && self.solver.factorise_shifted(&state.axial, 1.0).is_err() {
                return Err(unstable(&mut self.solver, &state.first_axial, state.name.clone()));
            }
        }
        Ok(())
    }

    /// Whether every requirement on a buckling factor is met, and every combination is stable: K + limit × Kg is
    /// positive definite if and only if λ > limit. No eigenvalue is computed.
    pub fn meets_buckling(&mut self) -> Result<bool, AnalysisError> {
        for required in &self.params.requirements {
            if required.quantity != Quantity::BucklingFactor {
                continue;
            }
            let met = match (required.min, self.index_of(&required.combination)) {
                (Some(least), Some(index)) => {
                    let state = &mut self.states[index];
                    let met = self.solver.factorise_shifted(&state.first_axial, least).is_ok();
                    if met {
                        state.stable_to = state.stable_to.max(least);
                    }
                    met
                }
                _ => self.requirement(required)?.excess() <= 0.0,
            };
            if !met {
                return Ok(false);
            }
        }
        Ok(self.prove_stable().is_ok())
    }

    /// The largest share of a limit that is used, of the requirements that statics decide or of all.
    pub fn used(&mut self, all: bool) -> Result<f64, AnalysisError> {
        let mut used = 0.0f64;
        for required in &self.params.requirements {
            if all || required.quantity != Quantity::BucklingFactor {
                used = used.max(self.requirement(required)?.used());
            }
        }
        Ok(used)
    }

    /// The largest values of a combination.
    fn metrics(&mut self, index: usize) -> Metrics {
        if let Some(metrics) = self.states[index].metrics {
            return metrics;
        }
        let metrics = self.measure(&self.states[index]);
        self.states[index].metrics = Some(metrics);
        metrics
    }

    fn second_order_axial(&self, state: &'a State) -> Option<&'a [f64]> {
        (self.params.order == 2).then_some(state.axial.as_slice())
    }

    fn measure(&self, state: &State) -> Metrics {
        let axial = (self.params.order == 2).then_some(state.axial.as_slice());
        let mut metrics = Metrics::NONE;
        for n in 0..self.model.frame.nodes().len() as u32 {
            let first = self.solver.system().first(n);
            let [x, y, z] = [state.u[first], state.u[first + 1], state.u[first + 2]];
            raise(&mut metrics.deflection, Vector3::new(x, y, z).norm(), Place::Node(n));
            raise(&mut metrics.deflection_vertical, z.abs(), Place::Node(n));
        }
        let reactions = self.solver.reactions(&state.u, axial, &state.f);
        for NodeId(n) in self.model.frame.supported() {
            let first = self.solver.system().first(n);
            if self.model.frame.fixed()[n as usize][2] {
                raise(&mut metrics.uplift, -reactions[first + 2], Place::Node(n));
            }
            let slide = Vector3::new(state.u[first], state.u[first + 1], 0.0).norm();
            raise(&mut metrics.slide, slide, Place::Node(n));
        }
        for (m, used) in self.utilisations(state).enumerate() {
            let place = Place::Edge(self.model.edge[m]);
            let elastic = if self.params.order == 2 { used.ends } else { used.inner };
            raise(&mut metrics.utilisation_all, elastic, place);
            raise(&mut metrics.inner_all, used.inner, place);
            if self.model.counts[m] {
                raise(&mut metrics.utilisation, elastic, place);
                raise(&mut metrics.inner, used.inner, place);
                raise(&mut metrics.von_mises, used.von_mises, place);
            }
        }
        metrics
    }

    fn utilisations(&self, state: &'a State) -> impl Iterator<Item = Utilisation> {
        let axial = self.second_order_axial(state);
        let strength = self.model.frame.material().strength;
        let section = self.solver.sections()[0];
        self.solver
            .member_forces(&state.u, axial, &state.member_loads)
            .into_iter()
            .map(move |forces| forces.utilisation(&section, strength))
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
        let state = &mut self.states[index];
        state.stable_to = mode.as_ref().map_or(f64::INFINITY, |mode| mode.factor);
        state.mode = Some(mode.clone());
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
        self.prove_stable()?;
        let requirements: Result<Vec<_>, _> =
            self.params.requirements.iter().map(|r| self.requirement(r)).collect();
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
                self.detail(&self.states[s], metrics)
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

    fn detail(&self, state: &State, metrics: Metrics) -> CombinationResult {
        let axial = (self.params.order == 2).then_some(state.axial.as_slice());
        let nodes = self.model.frame.nodes().len();
        let pushes = by_node(self.solver.system(), &self.solver.reactions(&state.u, axial, &state.f), nodes);
        let fixed = self.model.frame.fixed();
        let held = |n: usize| std::array::from_fn(|d| fixed[n][d].then_some(pushes[n][d]));
        CombinationResult {
            name: state.name.clone(),
            metrics,
            displacements: by_node(self.solver.system(), &state.u, nodes),
            member_forces: self.solver.member_forces(&state.u, axial, &state.member_loads),
            member_utilisation: self.utilisations(state).collect(),
            reactions: self.model.frame.supported().map(|node| (node, held(node.0 as usize))).collect(),
        }
    }
}

impl Metrics {
    const NONE: Self = {
        let none = (0.0, Place::Whole);
        Self {
            deflection: none,
            deflection_vertical: none,
            utilisation: none,
            utilisation_all: none,
            von_mises: none,
            inner: none,
            inner_all: none,
            uplift: none,
            slide: none,
        }
    };
}

/// Keeps the larger; a NaN stays, to be found by [`check_finite`].
fn raise(worst: &mut (f64, Place), value: f64, place: Place) {
    if value > worst.0 || value.is_nan() {
        *worst = (value, place);
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

/// Whether axial forces are within a quarter of t times `first`, where 2 t ≤ `stable_to`.
fn far_below(axial: &[f64], first: &[f64], stable_to: f64) -> bool {
    let square: f64 = first.iter().map(|n| n * n).sum();
    let product: f64 = first.iter().zip(axial).map(|(a, b)| a * b).sum();
    if stable_to <= 0.0 || square <= 0.0 {
        return axial.iter().all(|&n| n == 0.0);
    }
    let t = product / square;
    let largest = axial.iter().fold(0.0f64, |a, n| a.max(n.abs()));
    let off = axial.iter().zip(first).fold(0.0f64, |a, (n, first)| a.max((n - t * first).abs()));
    t >= 0.0 && off <= 0.25 * largest && 2.0 * t <= stable_to
}

/// Names what gives way: the first buckling mode under the first-order axial forces.
fn unstable(solver: &mut Solver<'_>, axial: &[f64], combination: String) -> AnalysisError {
    let search = Search { modes: 1, tolerance: 1e-4 };
    match buckling::modes(solver, axial, search).ok().and_then(|mut modes| modes.pop()) {
        Some(mode) => AnalysisError::Unstable {
            combination,
            motion: mechanism::largest(solver.model(), solver.system(), &mode.shape),
        },
        None => AnalysisError::NoConvergence("second-order"),
    }
}
