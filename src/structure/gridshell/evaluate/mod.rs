//! A grid shell at one height after another: statics of every combination, buckling, requirements.

mod response;

pub use response::CombinationResult;

use super::AnalysisError;
use super::metrics::{self, Answer, Metrics};
use super::model::GridshellModel;
use crate::structure::action::Action;
use crate::structure::buckling::{self, Mode};
use crate::structure::forces::BetweenAll;
use crate::structure::frame::{NAMING, silence};
use crate::structure::mechanism;
use crate::structure::params::{Family, Quantity, StructureParams};
use crate::structure::second_order::{Aim, LeastStep, Reason, Room};
use crate::structure::section::Section;
use crate::structure::solver::{Combination, Solver};
use nalgebra::Vector3;

/// Residual of the buckling mode at which λ is good to about its square, where no other factor lies near; ten times as
/// much saves a solve or two, and costs digits where factors lie close together, as those of shells do.
const MODE_TOLERANCE: f64 = 3e-5;
/// The same share of the largest displacement and axial force, in first order with a factor that is not K's own.
const FIRST_ORDER_TOLERANCE: f64 = 1e-9;
/// Difference of the logarithms of two heights up to which one's factor serves the other: there the iteration takes
/// as long as a factorisation.
const NEAR: f64 = 0.08;
/// In how small steps the load is followed where it is not carried at once: a search asks whether a design stands, not
/// how nearly.
const LEAST_STEP: LeastStep = LeastStep(1.0 / 16.0);
/// How many times the distance of two known heights their line is followed for a first guess.
const FURTHEST: f64 = 2.0;

/// One combination at the current height.
struct State {
    name: String,
    cases: Combination,
    member_loads: Vec<Vector3<f64>>,
    /// N if all ends were held: of temperature.
    initial: Vec<f64>,
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
    room: Room,
    reactions: Vec<f64>,
    /// What `u` is of, if of anything.
    current: Option<Current>,
    /// Height of the sections in the factor.
    factored_at: f64,
    /// Whether the first-order axial forces of this height are known.
    first_known: bool,
    /// The last heights before this one and their displacements.
    former: [(f64, Vec<f64>); 2],
}

/// A combination without an equilibrium in second order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fallen {
    combination: usize,
    reason: Reason,
}

#[derive(Clone, Copy, Debug)]
struct Current {
    height: f64,
    tolerance: f64,
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
                initial: Vec::new(),
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
            room: Room::default(),
            reactions: Vec::new(),
            current: None,
            factored_at: 0.0,
            first_known: false,
            former: Default::default(),
            solver,
            model,
            params,
            states,
        })
    }

    /// Statics of all combinations with sections of this height, as exact as the parameters ask.
    ///
    /// In second order what does not settle is unstable; what settles is stable only after [`Evaluator::prove_stable`].
    pub fn statics(&mut self, height: f64) -> Result<(), AnalysisError> {
        match self.statics_within(height, self.tolerance())? {
            None => Ok(()),
            Some(fallen) => Err(self.unstable(fallen)),
        }
    }

    /// How exact the parameters ask the displacements to be.
    pub fn tolerance(&self) -> f64 {
        if self.params.order == 2 { self.params.second_order_tolerance } else { FIRST_ORDER_TOLERANCE }
    }

    /// The same up to `tolerance` of the largest displacement and axial force. Gives the combination that has no
    /// equilibrium, if one has none.
    pub fn statics_within(&mut self, height: f64, tolerance: f64) -> Result<Option<Fallen>, AnalysisError> {
        match self.current {
            Some(current) if current.height == height => {
                if current.tolerance <= tolerance {
                    return Ok(None);
                }
                let stable = self.params.order != 2;
                self.states.iter_mut().for_each(|state| (state.metrics, state.stable) = (None, stable));
            }
            _ => self.turn_to(height)?,
        }
        self.current = None;
        let fallen = self.settle(height, tolerance)?;
        if self.u.iter().any(|v| !v.is_finite()) {
            return Err(AnalysisError::NotFinite("a displacement"));
        }
        if fallen.is_none() {
            let n = self.solver.system().unknowns();
            for (state, u) in self.states.iter_mut().zip(self.u.chunks(n)) {
                self.solver.axial_forces(u, &state.initial, &mut state.axial);
            }
            self.current = Some(Current { height, tolerance });
        }
        Ok(fallen)
    }

    /// Sections, loads and first displacements of another height: followed from the heights before if it is near the
    /// one of the factor, else those of first order.
    fn turn_to(&mut self, height: f64) -> Result<(), AnalysisError> {
        let section = Section::of_params(&self.params.section, height)?;
        if let Some(current) = self.current.take() {
            let [last, before] = &mut self.former;
            std::mem::swap(last, before);
            (last.0, last.1) = (current.height, std::mem::replace(&mut self.u, std::mem::take(&mut last.1)));
        }
        let near = self.solver.has_factor()
            && self.former[0].0 > 0.0
            && (height / self.factored_at).ln().abs() <= NEAR;
        if near {
            self.solver.use_sections(&[section]);
        } else {
            self.solver.set_sections(&[section])?;
            self.factored_at = height;
        }
        let n = self.solver.system().unknowns();
        for (state, f) in self.states.iter_mut().zip(self.f.chunks_mut(n)) {
            self.solver.member_loads(&state.cases, &mut state.member_loads);
            self.solver.initial_forces(&state.cases, &mut state.initial);
            self.solver.load_vector(&state.cases, &state.member_loads, &state.initial, f);
            (state.metrics, state.mode, state.stable) = (None, None, self.params.order != 2);
        }
        self.first_known = false;
        if near {
            self.follow(height);
        } else {
            let room = std::mem::take(&mut self.u);
            self.u = self.first_order(room);
        }
        Ok(())
    }

    /// First guess of the displacements: along the line through the last two heights, over their logarithm.
    fn follow(&mut self, height: f64) {
        let [(last, u), (before, v)] = &self.former;
        self.u.clone_from(u);
        let share = (height / last).ln() / (last / before).ln();
        if *before > 0.0 && share.is_finite() {
            let share = share.clamp(-FURTHEST, FURTHEST);
            self.u.iter_mut().zip(v).for_each(|(u, v)| *u += share * (*u - v));
        }
    }

    /// Displacements (in `u`, whatever it held) and axial forces of first order, with K's own factor.
    fn first_order(&mut self, mut u: Vec<f64>) -> Vec<f64> {
        u.clone_from(&self.f);
        self.solver.solve(&mut u);
        let n = self.solver.system().unknowns();
        for (state, u) in self.states.iter_mut().zip(u.chunks(n)) {
            self.solver.axial_forces(u, &state.initial, &mut state.first_axial);
            silence(&self.solver, u, &state.initial, &mut state.first_axial);
        }
        self.first_known = true;
        u
    }

    /// All combinations together with the factor at hand; if that does not settle, with that of K; then, in second
    /// order, one by one with factors of K + Kg, which always tells.
    fn settle(&mut self, height: f64, tolerance: f64) -> Result<Option<Fallen>, AnalysisError> {
        let second_order = self.params.order == 2;
        if !second_order && self.first_known {
            return Ok(None);
        }
        let aim = Aim { second_order, tolerance };
        if self.solver.has_factor() && self.iterate(aim) {
            return Ok(None);
        }
        if !self.first_known {
            self.factored_at = height;
            let room = std::mem::take(&mut self.u);
            self.u = self.first_order(room);
            if !second_order || self.iterate(aim) {
                return Ok(None);
            }
        }
        let n = self.solver.system().unknowns();
        for (s, state) in self.states.iter_mut().enumerate() {
            let columns = s * n..(s + 1) * n;
            let action = Action {
                f: self.f[columns.clone()].to_vec(),
                initial: state.initial.clone(),
                ..Action::default()
            };
            match self.solver.second_order(&action, &state.first_axial, tolerance, LEAST_STEP) {
                Ok(found) => self.u[columns].copy_from_slice(&found.u),
                Err(lost) => return Ok(Some(Fallen { combination: s, reason: lost.reason })),
            }
            state.stable = true;
        }
        Ok(None)
    }

    fn iterate(&mut self, aim: Aim) -> bool {
        let initial: Vec<&[f64]> = self.states.iter().map(|state| state.initial.as_slice()).collect();
        self.solver.iterate(&self.f, &initial, &mut self.u, aim, &mut self.room)
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
        match self.not_stable() {
            None => Ok(()),
            Some(combination) => Err(self.unstable(Fallen { combination, reason: Reason::PastCritical })),
        }
    }

    /// The first combination that cannot be proved stable.
    fn not_stable(&mut self) -> Option<usize> {
        let doubtful: Vec<usize> = (0..self.states.len()).filter(|&s| !self.states[s].stable).collect();
        let (&first, others) = doubtful.split_first()?;
        self.factored_at = self.current.map_or(0.0, |current| current.height);
        let mut least = self.states[first].axial.clone();
        for &s in others {
            least.iter_mut().zip(&self.states[s].axial).for_each(|(least, n)| *least = least.min(*n));
        }
        let together = self.solver.factorise_shifted(&least, 1.0).is_ok();
        for &s in &doubtful {
            let alone = |solver: &mut Solver<'_>, axial: &[f64]| solver.factorise_shifted(axial, 1.0).is_ok();
            if !together && (others.is_empty() || !alone(&mut self.solver, &self.states[s].axial)) {
                return Some(s);
            }
            self.states[s].stable = true;
        }
        None
    }

    /// The first-order axial forces, if the displacements were not found by way of them.
    fn find_first_axial_forces(&mut self) {
        if !self.first_known {
            self.first_order(Vec::new());
        }
    }

    /// Names what gives way in a combination: the first buckling mode under its first-order axial forces.
    fn unstable(&mut self, Fallen { combination: index, reason }: Fallen) -> AnalysisError {
        if reason == Reason::NoConvergence {
            return AnalysisError::NoConvergence("second-order");
        }
        self.find_first_axial_forces();
        let state = &self.states[index];
        match buckling::first(&mut self.solver, &state.first_axial, NAMING).ok().flatten() {
            Some(mode) => AnalysisError::Unstable {
                combination: state.name.clone(),
                motion: mechanism::largest(self.solver.model(), self.solver.system(), &mode.shape),
            },
            None => AnalysisError::NoConvergence("second-order"),
        }
    }

    /// The shares of the limits that are used, of the requirements that statics decide.
    pub fn used(&mut self) -> Result<Vec<f64>, AnalysisError> {
        self.shares(false)
    }

    /// The same of the requirements on buckling factors; none if a combination is not stable.
    pub fn used_by_buckling(&mut self) -> Result<Option<Vec<f64>>, AnalysisError> {
        let used = self.shares(true)?;
        Ok(self.not_stable().is_none().then_some(used))
    }

    fn shares(&mut self, by_buckling: bool) -> Result<Vec<f64>, AnalysisError> {
        let params = self.params;
        let is_wanted = |q: Quantity| q.is_sized_for() && (q.family() == Family::Buckling) == by_buckling;
        let wanted = params.requirements.iter().filter(|r| r.analysed().is_some_and(is_wanted));
        let results = wanted.map(|required| self.requirement(required));
        results.filter_map(Result::transpose).map(|result| Ok(result?.used())).collect()
    }

    fn answer(&self, index: usize) -> Answer<'_> {
        let n = self.solver.system().unknowns();
        let state = &self.states[index];
        Answer {
            u: &self.u[index * n..(index + 1) * n],
            f: &self.f[index * n..(index + 1) * n],
            between: BetweenAll {
                axial: (self.params.order == 2).then_some(state.axial.as_slice()),
                initial: &state.initial,
                loads: &state.member_loads,
            },
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
        if let Some(known) = &self.states[index].mode {
            return Ok(known.clone());
        }
        self.factored_at = self.current.map_or(0.0, |current| current.height);
        self.find_first_axial_forces();
        let state = &self.states[index];
        let mode = buckling::first(&mut self.solver, &state.first_axial, MODE_TOLERANCE)
            .map_err(|_| AnalysisError::NoConvergence("buckling"))?;
        if self.states.iter().all(|state| state.stable) {
            // Nobody else is going to: the next height may want the factor of this one.
            self.solver.refactorise().map_err(|_| AnalysisError::NoConvergence("buckling"))?;
        }
        self.states[index].mode = Some(mode.clone());
        Ok(mode)
    }

    fn index_of(&self, name: &str) -> Option<usize> {
        self.states.iter().position(|state| state.name == name)
    }
}
