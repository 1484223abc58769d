//! A whole analysis of one model under one combination: what `quadrille frame` prints.

use super::action::Action;
use super::buckling;
use super::forces::{BetweenAll, MemberForces, Utilisation};
use super::mechanism::{self, FreeMotion};
use super::model::{FrameModel, MemberId, NodeId};
use super::second_order::{LeastStep, Lost, Reason};
use super::solver::{Combination, Refined, Rounding, Solver, Unsound};
use super::system::{DOFS, System, TooLarge};
use nalgebra::Vector3;

/// Whether equilibrium is that of the undeformed or of the deformed structure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// K u = f.
    First = 1,
    /// (K + Kg(N)) u = f.
    Second = 2,
}

/// What to analyse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameAnalysis {
    /// First or second order.
    pub order: Order,
    /// How many buckling factors.
    pub buckling_modes: usize,
}

/// Change of the axial forces, relative to the largest, at which second order has converged.
const SECOND_ORDER_TOLERANCE: f64 = 1e-11;

/// How closely a critical load is told: a critical load this near above is taken for one below.
const LEAST_STEP: LeastStep = LeastStep(1.0 / 4096.0);

/// Residual of a mode that is only to name what gives way.
pub const NAMING: f64 = 1e-4;

/// Displacements are known no better than this, in the norm of strain energy beside the whole, an answer is none.
const EXACT: f64 = 1e-6;

/// Rounding that changes solutions by more than this share leaves nothing for second order to settle on.
const CORRECTABLE: f64 = 1e-3;

/// Out of balance by more than this share of the largest force, an answer is none.
const BALANCE: f64 = 1e-6;

/// The answer. Lists follow the model's order.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameResult {
    /// ux, uy, uz (m), rx, ry, rz (rad) of each node.
    pub displacements: Vec<[f64; 6]>,
    /// For each supported node: what the support does to the structure (N, Nm); `None` where it holds nothing.
    pub reactions: Vec<(NodeId, [Option<f64>; 6])>,
    /// Forces of each member.
    pub member_forces: Vec<MemberForces>,
    /// Utilisation of each member; none where its section's moduli are not known.
    pub member_utilisation: Vec<Option<Utilisation>>,
    /// Largest displacement of a node, m, and that node.
    pub max_displacement: (f64, NodeId),
    /// Sum of the reaction forces, N.
    pub total_reaction: [f64; 3],
    /// Positive buckling factors, ascending; at most as many as asked for.
    pub buckling_factors: Vec<f64>,
    /// By how much the ends of each member with joints are turned against their nodes, about its x, y and z (rad).
    pub joint_rotations: Vec<(MemberId, [[f64; 3]; 2])>,
    /// Decides which utilisation counts.
    pub order: Order,
    /// How many buckling factors were asked for.
    pub modes_asked: usize,
    /// Whether more strain energy is in bending than in tension and compression.
    pub bending_dominates: bool,
}

/// Said where no factor was found although bending dominates.
const NO_LATERAL: &str = "bending dominates and no buckling factor of the axial forces was found: lateral-torsional \
    buckling, that of bending moments, is outside the model";

/// Said where fewer factors were found than asked for.
const NO_MORE: &str =
    "fewer buckling factors than asked for: there are no others below 1e8 times the least, of either sign";

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FrameError {
    /// Something moves freely: supports or members are missing.
    #[error("mechanism: {} moves freely in {:?}", .0.node, .0.direction)]
    Singular(FreeMotion),
    /// Past its critical load in second order.
    #[error("unstable: the path of equilibrium from no load ends before the whole load is on; {} gives way in {:?}", .0.node, .0.direction)]
    Unstable(FreeMotion),
    /// Neither an equilibrium in second order nor a reason to call it unstable was found.
    #[error(
        "the second-order iteration did not converge: no equilibrium was found beyond {:.3} of the load, and nothing \
         shows that there is none; the structure may be past its critical load or near it",
        .share
    )]
    NotSettled {
        /// The share of the load up to which there is an answer.
        share: f64,
    },
    /// The numbers overflow.
    #[error("the result is not finite: stiffness or loads are too large or too small to compute with")]
    NotFinite,
    /// Rounding has used up the digits: stiffness or lengths differ by too many orders of magnitude.
    #[error(
        "ill-conditioned: the free nodes are out of balance by {0:e} of the largest force; stiffness or lengths differ too much"
    )]
    IllConditioned(f64),
    /// The nodes are in balance, but the displacements are not known.
    #[error(
        "ill-conditioned: rounding leaves an error of about {0:.0e} of the displacements (1e-6 is allowed); stiffness or \
         lengths differ too much, or members are split too finely: an element is exact for a straight member under \
         uniform load, so that fewer elements give the better answer"
    )]
    Inexact(f64),
    /// The same, so much that there is no factor of the stiffness.
    #[error("ill-conditioned: rounding makes the stiffness singular; stiffness or lengths differ too much")]
    NoDigits,
    /// Buckling factors that rounding may have changed.
    #[error(
        "ill-conditioned: rounding changes solutions by {0:.0e}, so that the buckling factors cannot be certified; \
         stiffness or lengths differ too much, or members are split too finely: take fewer elements"
    )]
    InexactFactors(f64),
    /// No buckling factor could be told.
    #[error("the buckling factors cannot be told: the pivots of K + λ Kg are not numbers")]
    NoConvergence,
    /// A combination of a load case that the model does not have.
    #[error("there is no load case {case}; the model has {cases}, counted from 0")]
    NoSuchCase {
        /// Its number.
        case: usize,
        /// How many there are.
        cases: usize,
    },
    /// Does not fit.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
}

impl From<Unsound> for FrameError {
    fn from(reason: Unsound) -> Self {
        match reason {
            Unsound::Mechanism(motion) => Self::Singular(motion),
            Unsound::IllConditioned => Self::NoDigits,
            Unsound::NotFinite => Self::NotFinite,
        }
    }
}

impl From<buckling::NoFactors> for FrameError {
    fn from(reason: buckling::NoFactors) -> Self {
        match reason {
            buckling::NoFactors::NoConvergence => Self::NoConvergence,
            buckling::NoFactors::IllConditioned(error) => Self::InexactFactors(error),
        }
    }
}

/// Analyses a model under all its load cases together, each × 1.
///
/// # Errors
/// See [`FrameError`].
pub fn frame(model: &FrameModel, analysis: &FrameAnalysis) -> Result<FrameResult, FrameError> {
    let combination: Combination = (0..model.load_cases().len()).map(|c| (c, 1.0)).collect();
    combined(model, &combination, analysis)
}

/// Analyses a model under a combination: load cases by number, from 0, each with its factor.
///
/// # Errors
/// See [`FrameError`].
pub fn combined(
    model: &FrameModel,
    combination: &[(usize, f64)],
    analysis: &FrameAnalysis,
) -> Result<FrameResult, FrameError> {
    let cases = model.load_cases().len();
    if let Some(&(case, _)) = combination.iter().find(|(case, _)| *case >= cases) {
        return Err(FrameError::NoSuchCase { case, cases });
    }
    let mut solver = Solver::new(model)?;
    solver.set_sections(model.sections())?;
    let mut loads = Vec::new();
    solver.member_loads(combination, &mut loads);
    let action = solver.action(combination, &loads);
    let (first, rounding) = solver.first_order(&action);
    finite(&first.u)?;
    exact(rounding.error)?;
    balanced(solver.imbalance(&first, None, &action))?;
    let mut axial = Vec::new();
    solver.axial_forces_of(&first, &action.initial, &mut axial);
    silence_refined(&solver, &first.u, rounding, &action.initial, &mut axial);
    let buckling_factors = buckling::factors(&mut solver, &axial, analysis.buckling_modes)?;
    let result = if analysis.order == Order::Second {
        if rounding.uncorrected > CORRECTABLE {
            return Err(FrameError::Inexact(rounding.uncorrected));
        }
        let u = solver
            .second_order(&action, &axial, SECOND_ORDER_TOLERANCE, LEAST_STEP)
            .map_err(|lost| unstable(&mut solver, &first.u, &axial, lost))?;
        finite(&u.u)?;
        solver.axial_forces_of(&u, &action.initial, &mut axial);
        // The factor is that of K + Kg at the answer, which has proved it stable.
        exact(solver.error_of(&u, Some(&axial), &action))?;
        balanced(solver.imbalance(&u, Some(&axial), &action))?;
        collect(&solver, &u, Some(&axial), &loads, &action)
    } else {
        collect(&solver, &first, None, &loads, &action)
    };
    Ok(FrameResult {
        buckling_factors,
        order: analysis.order,
        modes_asked: analysis.buckling_modes,
        ..result
    })
}

fn finite(u: &[f64]) -> Result<(), FrameError> {
    if u.iter().all(|v| v.is_finite()) { Ok(()) } else { Err(FrameError::NotFinite) }
}

fn exact(error: f64) -> Result<(), FrameError> {
    if error <= EXACT { Ok(()) } else { Err(FrameError::Inexact(error)) }
}

fn balanced(imbalance: f64) -> Result<(), FrameError> {
    if imbalance <= BALANCE { Ok(()) } else { Err(FrameError::IllConditioned(imbalance)) }
}

/// Sets to zero the axial forces that are rounding noise of the displacements and rotations, and of the `initial` forces
/// (empty: none): no force, no buckling.
pub fn silence(solver: &Solver<'_>, u: &[f64], initial: &[f64], axial: &mut [f64]) {
    let members = solver.system().slots().iter().zip(solver.stiffness()).zip(solver.model().axes());
    let initial = initial.iter().copied().chain(std::iter::repeat(0.0));
    for ((((slot, k), axes), n), initial) in members.zip(axial).zip(initial) {
        let largest = |from: usize| u[from..from + 3].iter().fold(0.0f64, |a, v| a.max(v.abs()));
        let moved = largest(slot.start) + largest(slot.end);
        let turned = largest(slot.start + 3) + largest(slot.end + 3);
        // What cancels in the equilibrium of its ends.
        let by_turning = k.xy.couple + k.xz.couple + k.torsion / axes.length;
        if n.abs() <= 256.0 * f64::EPSILON * (k.axial * moved + by_turning * turned + initial.abs()) {
            *n = 0.0;
        }
    }
}

/// The same where displacements are refined and what rounding leaves of them is known: in a floppy frame an N that does
/// not count beside the displacements may be known all the same, and buckle it.
fn silence_refined(solver: &Solver<'_>, u: &[f64], rounding: Rounding, initial: &[f64], axial: &mut [f64]) {
    let found = axial.to_vec();
    silence(solver, u, initial, axial);
    let energy = rounding.error.max(256.0 * f64::EPSILON).powi(2) * solver.twice_energy(u);
    for ((n, found), k) in axial.iter_mut().zip(found).zip(solver.stiffness()) {
        // No more of N can be wrong than has the energy of what is left.
        if found * found > energy * k.axial {
            *n = found;
        }
    }
}

/// Names what gives way: the first buckling mode under the axial forces where the path of equilibrium ends, or, where
/// there is none, under those of first order; else where the displacements `u` of first order are largest.
fn unstable(solver: &mut Solver<'_>, u: &[f64], axial: &[f64], lost: Lost) -> FrameError {
    let Lost { reason: Reason::PastCritical, axial: last, .. } = lost else {
        return FrameError::NotSettled { share: lost.share };
    };
    let mode = [last.as_slice(), axial]
        .into_iter()
        .find_map(|axial| buckling::first(solver, axial, NAMING).ok().flatten());
    let motion = mode.as_ref().map_or(u, |mode| &mode.shape);
    FrameError::Unstable(mechanism::largest(solver.model(), solver.system(), motion))
}

fn collect(
    solver: &Solver<'_>,
    found: &Refined,
    axial: Option<&[f64]>,
    loads: &[Vector3<f64>],
    action: &Action,
) -> FrameResult {
    let model = solver.model();
    let displacements = by_node(solver.system(), &found.u, model.nodes().len());
    let size = |d: &[f64; 6]| Vector3::new(d[0], d[1], d[2]).norm();
    let mut largest = (0.0, NodeId(0));
    for (n, d) in displacements.iter().enumerate() {
        if size(d) > largest.0 {
            largest = (size(d), NodeId(n as u32));
        }
    }
    let pushes: Vec<f64> = solver.residual(found, axial, &action.f).into_iter().map(|left| -left).collect();
    let reactions: Vec<(NodeId, [Option<f64>; 6])> =
        model.supported().map(|node| (node, solver.support_reaction(node, &found.u, &pushes))).collect();
    let mut total_reaction = [0.0; 3];
    for (_, reaction) in &reactions {
        for (total, push) in total_reaction.iter_mut().zip(reaction) {
            *total += push.unwrap_or(0.0);
        }
    }
    let between = BetweenAll { axial, initial: &action.initial, loads };
    let member_forces = solver.member_forces_of(found, between);
    let [bending, axial_energy] = energies(solver, &member_forces);
    let bending_dominates = bending > axial_energy;
    let strength = model.material().strength;
    let member_utilisation = member_forces
        .iter()
        .zip(model.members())
        .map(|(forces, member)| {
            let section = &solver.sections()[member.section as usize];
            section.has_moduli().then(|| forces.utilisation(section, strength))
        })
        .collect();
    FrameResult {
        displacements,
        reactions,
        member_forces,
        member_utilisation,
        max_displacement: largest,
        total_reaction,
        buckling_factors: Vec::new(),
        joint_rotations: solver
            .system()
            .turned()
            .iter()
            .map(|turned| {
                let slips = solver.refined_ends(turned.member, found).slips;
                (MemberId(turned.member as u32), slips.map(|slip| [slip.x, slip.y, slip.z]))
            })
            .collect(),
        order: Order::First,
        modes_asked: 0,
        bending_dominates,
    }
}

/// Twice the strain energy in bending, of the ends' rotations and of the loads between them, and in tension and
/// compression; that of torsion is neither.
fn energies(solver: &Solver<'_>, forces: &[MemberForces]) -> [f64; 2] {
    let model = solver.model();
    let e = model.material().youngs_modulus;
    let mut sum = [0.0; 2];
    for (forces, member) in forces.iter().zip(model.members()) {
        let section = &solver.sections()[member.section as usize];
        // Simpson's rule, exact for the linear N and M² of a member without load between its ends.
        for (x, weight) in [(0.0, 1.0), (0.5, 4.0), (1.0, 1.0)] {
            let at = forces.at(x * forces.length);
            let share = weight * forces.length / (6.0 * e);
            let bent =
                |moment: f64, inertia: f64| if inertia > 0.0 { moment * moment / inertia } else { 0.0 };
            sum[0] += share * (bent(at.my, section.iy) + bent(at.mz, section.iz));
            sum[1] += share * at.n * at.n / section.area;
        }
    }
    sum
}

/// A vector in elimination order, node by node.
pub fn by_node(system: &System, u: &[f64], nodes: usize) -> Vec<[f64; 6]> {
    (0..nodes as u32)
        .map(|n| {
            let first = system.first(n);
            std::array::from_fn(|d| u[first..first + DOFS][d])
        })
        .collect()
}

impl FrameResult {
    /// What the numbers do not say by themselves.
    pub fn remarks(&self) -> Vec<&'static str> {
        let found = self.buckling_factors.len();
        let silent = self.modes_asked > 0 && found == 0 && self.bending_dominates;
        let remarks = [(NO_LATERAL, silent), (NO_MORE, found > 0 && found < self.modes_asked)];
        remarks.into_iter().filter_map(|(remark, applies)| applies.then_some(remark)).collect()
    }

    /// The largest of a per-member utilisation, and the member it is of; none if no member has one.
    pub fn worst(&self, of: impl Fn(&Utilisation) -> f64) -> Option<(f64, MemberId)> {
        let known = self.member_utilisation.iter().enumerate();
        known
            .filter_map(|(m, used)| used.as_ref().map(|used| (of(used), MemberId(m as u32))))
            .reduce(|worst, next| if next.0 > worst.0 { next } else { worst })
    }

    /// The elastic utilisation: inner extremes count in first order, the ends in second order.
    pub fn utilisation(&self) -> Option<(f64, MemberId)> {
        self.worst(|u| if self.order == Order::Second { u.ends } else { u.inner })
    }
}
