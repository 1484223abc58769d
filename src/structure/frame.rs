//! A whole analysis of one model under one combination: what `quadrille frame` prints.

use super::buckling;
use super::forces::{MemberForces, Utilisation};
use super::mechanism::{self, FreeMotion};
use super::model::{FrameModel, MemberId, NodeId};
use super::second_order::Unstable;
use super::solver::{Combination, Solver};
use super::system::{DOFS, System, TooLarge};
use nalgebra::Vector3;

/// What to analyse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameAnalysis {
    /// 1 = first order, 2 = second order.
    pub order: u8,
    /// How many buckling factors.
    pub buckling_modes: usize,
}

/// Change of the axial forces, relative to the largest, at which second order has converged.
const SECOND_ORDER_TOLERANCE: f64 = 1e-11;

/// Residual of a mode that is only to name what gives way.
pub const NAMING: f64 = 1e-4;

/// Out of balance by more than this share of the largest force, an answer is none.
const BALANCE: f64 = 1e-7;

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
    /// 1 or 2: decides which utilisation counts.
    pub order: u8,
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FrameError {
    /// Something moves freely: supports or members are missing.
    #[error("mechanism: {} moves freely in {:?}", .0.node, .0.direction)]
    Singular(FreeMotion),
    /// Past its critical load in second order.
    #[error("unstable: past its critical load; {} gives way in {:?}", .0.node, .0.direction)]
    Unstable(FreeMotion),
    /// The numbers overflow.
    #[error("the result is not finite: stiffness or loads are too large or too small to compute with")]
    NotFinite,
    /// Rounding has used up the digits: stiffness or lengths differ by too many orders of magnitude.
    #[error(
        "ill-conditioned: the free nodes are out of balance by {0:e} of the largest force; stiffness or lengths differ too much"
    )]
    IllConditioned(f64),
    /// No buckling factor was found within the limit of iterations.
    #[error("the buckling iteration did not converge")]
    NoConvergence,
    /// Does not fit.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
}

impl From<FreeMotion> for FrameError {
    fn from(motion: FreeMotion) -> Self {
        Self::Singular(motion)
    }
}

impl From<buckling::NoConvergence> for FrameError {
    fn from(_: buckling::NoConvergence) -> Self {
        Self::NoConvergence
    }
}

/// Analyses a model under all its load cases together, each × 1.
///
/// # Errors
/// See [`FrameError`].
pub fn frame(model: &FrameModel, analysis: &FrameAnalysis) -> Result<FrameResult, FrameError> {
    let combination: Combination = (0..model.load_cases().len()).map(|c| (c, 1.0)).collect();
    let mut solver = Solver::new(model)?;
    solver.set_sections(model.sections())?;
    let mut loads = Vec::new();
    solver.member_loads(&combination, &mut loads);
    let mut f = vec![0.0; solver.system().unknowns()];
    solver.load_vector(&combination, &loads, &mut f);
    let first = solver.first_order(&f);
    finite(&first)?;
    balanced(solver.imbalance(&first, None, &f))?;
    let mut axial = Vec::new();
    solver.axial_forces(&first, &mut axial);
    silence(&solver, &first, &mut axial);
    let buckling_factors = buckling::factors(&mut solver, &axial, analysis.buckling_modes)?;
    let result = if analysis.order == 2 {
        let u = solver
            .second_order(&f, &axial, SECOND_ORDER_TOLERANCE)
            .map_err(|reason| unstable(&mut solver, &axial, reason))?;
        finite(&u)?;
        solver.axial_forces(&u, &mut axial);
        balanced(solver.imbalance(&u, Some(&axial), &f))?;
        collect(&solver, &u, Some(&axial), &loads, &f)
    } else {
        collect(&solver, &first, None, &loads, &f)
    };
    Ok(FrameResult {
        buckling_factors,
        order: analysis.order,
        ..result
    })
}

fn finite(u: &[f64]) -> Result<(), FrameError> {
    if u.iter().all(|v| v.is_finite()) { Ok(()) } else { Err(FrameError::NotFinite) }
}

fn balanced(imbalance: f64) -> Result<(), FrameError> {
    if imbalance <= BALANCE { Ok(()) } else { Err(FrameError::IllConditioned(imbalance)) }
}

/// Sets axial forces to zero if all of them are rounding noise of the displacements: no load, no buckling.
pub fn silence(solver: &Solver<'_>, u: &[f64], axial: &mut [f64]) {
    let noise = solver.system().slots().iter().zip(solver.stiffness()).zip(axial.iter());
    let mut moved = noise.map(|((slot, k), n)| {
        let size = |at: usize| u[at..at + 3].iter().fold(0.0f64, |a, v| a.max(v.abs()));
        n.abs() <= 256.0 * f64::EPSILON * k.axial * (size(slot.start) + size(slot.end))
    });
    if moved.all(|quiet| quiet) {
        axial.fill(0.0);
    }
}

/// Names what gives way: the first buckling mode under the first-order axial forces.
fn unstable(solver: &mut Solver<'_>, axial: &[f64], _: Unstable) -> FrameError {
    match buckling::first(solver, axial, NAMING).ok().flatten() {
        Some(mode) => FrameError::Unstable(mechanism::largest(solver.model(), solver.system(), &mode.shape)),
        None => FrameError::NoConvergence,
    }
}

fn collect(
    solver: &Solver<'_>,
    u: &[f64],
    axial: Option<&[f64]>,
    loads: &[Vector3<f64>],
    f: &[f64],
) -> FrameResult {
    let model = solver.model();
    let displacements = by_node(solver.system(), u, model.nodes().len());
    let size = |d: &[f64; 6]| Vector3::new(d[0], d[1], d[2]).norm();
    let mut largest = (0.0, NodeId(0));
    for (n, d) in displacements.iter().enumerate() {
        if size(d) > largest.0 {
            largest = (size(d), NodeId(n as u32));
        }
    }
    let pushes = by_node(solver.system(), &solver.reactions(u, axial, f), model.nodes().len());
    let reactions: Vec<(NodeId, [Option<f64>; 6])> = model
        .supported()
        .map(|node| {
            let (push, fixed) = (&pushes[node.0 as usize], &model.fixed()[node.0 as usize]);
            (node, std::array::from_fn(|d| fixed[d].then_some(push[d])))
        })
        .collect();
    let mut total_reaction = [0.0; 3];
    for (_, reaction) in &reactions {
        for (total, push) in total_reaction.iter_mut().zip(reaction) {
            *total += push.unwrap_or(0.0);
        }
    }
    let member_forces = solver.member_forces(u, axial, loads);
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
        order: 1,
    }
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
    /// The largest of a per-member utilisation, and the member it is of; none if no member has one.
    pub fn worst(&self, of: impl Fn(&Utilisation) -> f64) -> Option<(f64, MemberId)> {
        let known = self.member_utilisation.iter().enumerate();
        known
            .filter_map(|(m, used)| used.as_ref().map(|used| (of(used), MemberId(m as u32))))
            .reduce(|worst, next| if next.0 > worst.0 { next } else { worst })
    }

    /// The elastic utilisation: inner extremes count in first order, the ends in second order.
    pub fn utilisation(&self) -> Option<(f64, MemberId)> {
        self.worst(|u| if self.order == 2 { u.ends } else { u.inner })
    }
}
