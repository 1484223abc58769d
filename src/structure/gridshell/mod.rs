//! A pattern as a grid shell: the only part of the solver that knows both a [`Pattern`] and a frame model.
//!
//! `deflection`, `utilisation`, `buckling_factor` and their kin are, as metrics, the worst over all combinations that a
//! requirement of that quantity names (or, failing that, one of the same family: the deflections with the slide of supports, the
//! utilisations); else of the one called `sls` (deflections) or `uls` (utilisations, buckling); else of all, as the uplift. The order in which requirements are
//! written does not matter, and which combination governs is told with the value ([`Governing`]).

mod evaluate;
mod loads;
mod metrics;
mod model;
mod panels;
mod sizing;
mod supports;

pub use evaluate::CombinationResult;
pub use metrics::Metrics;
pub use model::GridshellModel;
pub use supports::FoundNode;

use super::mechanism::FreeMotion;
use super::model::ModelError;
use super::params::{HeightParams, Quantity, StructureParams};
use super::section::SectionError;
use super::solver::Unsound;
use super::system::TooLarge;
use crate::geometry::pattern::Pattern;
use evaluate::Evaluator;
use std::fmt;

/// Where a value is taken: a name a person can look up in the exported tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A node; those from the number of the pattern's vertices on are inside split members.
    Node(u32),
    /// An edge of the pattern.
    Edge(u32),
    /// The structure as a whole.
    Whole,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Node(n) => write!(f, "node {n}"),
            Self::Edge(e) => write!(f, "member {e}"),
            Self::Whole => write!(f, "the structure"),
        }
    }
}

/// How a requirement fares.
#[derive(Clone, Debug, PartialEq)]
pub struct RequirementResult {
    /// What is limited.
    pub quantity: Quantity,
    /// In which combination.
    pub combination: String,
    /// Where the value is taken.
    pub place: Place,
    /// The value.
    pub value: f64,
    /// The limit.
    pub limit: f64,
    /// Whether the limit is an upper one.
    pub upper: bool,
}

impl RequirementResult {
    /// max(0, value/limit − 1) for an upper limit, max(0, 1 − value/limit) for a lower one (docs/reference/search.md §1.2).
    /// Beyond a limit of 0, the value.
    pub fn excess(&self) -> f64 {
        if self.limit == 0.0 {
            return if self.upper { self.value.max(0.0) } else { 0.0 };
        }
        let ratio = self.value / self.limit;
        if self.upper { (ratio - 1.0).max(0.0) } else { (1.0 - ratio).max(0.0) }
    }

    /// How much of the limit is used: value/limit for an upper one, limit/value for a lower one.
    pub fn used(&self) -> f64 {
        if self.value <= 0.0 && self.upper {
            return 0.0;
        }
        if self.upper { self.value / self.limit } else { self.limit / self.value }
    }
}

/// The combination in which each quantity is the worst.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Governing {
    /// Of `deflection_m`.
    pub deflection: String,
    /// Of `deflection_vertical_m`.
    pub deflection_vertical: String,
    /// Of `utilisation`.
    pub utilisation: String,
    /// Of `utilisation_all`.
    pub utilisation_all: String,
    /// Of `utilisation_von_mises`.
    pub utilisation_von_mises: String,
    /// Of `buckling_factor`; none where nothing buckles.
    pub buckling: Option<String>,
    /// Of `uplift_kn`.
    pub uplift: String,
    /// Of `support_slide_m`.
    pub support_slide: String,
}

/// What the analysis gives: plain numbers at the height chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// Height of the sections, m.
    pub height_m: f64,
    /// A sized height rounded up to the step, for people, m.
    pub height_rounded_m: f64,
    /// Mass of all members, kg.
    pub mass_kg: f64,
    /// Mass over the true panel area, kg/m².
    pub mass_per_area_kg_m2: f64,
    /// Sum of the lengths of all members, m.
    pub member_length_m: f64,
    /// Largest resultant displacement of a node, m.
    pub deflection_m: f64,
    /// Where that is.
    pub deflection_place: Place,
    /// Largest vertical displacement of a node, m.
    pub deflection_vertical_m: f64,
    /// Elastic utilisation outside the excluded zones; in second order of the member ends.
    pub utilisation: f64,
    /// Where that is.
    pub utilisation_place: Place,
    /// Elastic utilisation of all members; in second order of the member ends.
    pub utilisation_all: f64,
    /// Von Mises utilisation outside the excluded zones, between the ends too.
    pub utilisation_von_mises: f64,
    /// `utilisation` with the extremes between the ends, whatever the order.
    pub utilisation_inner: f64,
    /// `utilisation_all` with the extremes between the ends, whatever the order.
    pub utilisation_all_inner: f64,
    /// First positive linear buckling factor; infinite if there is none.
    pub buckling_factor: f64,
    /// Largest pull on a support, the worst over the combinations required of it, or all, kN.
    pub uplift_kn: f64,
    /// Largest horizontal movement of a supported node, the worst over the combinations required of it, or those of `deflection`, m.
    pub support_slide_m: f64,
    /// Which combination each of these is taken from.
    pub governing: Governing,
    /// Each requirement, in the config's order.
    pub requirements: Vec<RequirementResult>,
}

impl Response {
    /// Σ of the excesses; 0 if every requirement is met.
    pub fn violation(&self) -> f64 {
        self.requirements.iter().map(RequirementResult::excess).sum()
    }

    /// The requirement that uses most of its limit.
    pub fn governing(&self) -> Option<&RequirementResult> {
        self.requirements.iter().reduce(|worst, next| if next.used() > worst.used() { next } else { worst })
    }
}

/// Why a pattern could not be analysed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AnalysisError {
    /// Something moves freely: supports are missing.
    #[error("mechanism: {} moves freely in {:?}", .0.node, .0.direction)]
    Mechanism(FreeMotion),
    /// Past its critical load.
    #[error("unstable in combination {combination}: {} gives way in {:?}", .motion.node, .motion.direction)]
    Unstable {
        /// The combination.
        combination: String,
        /// What gives way.
        motion: FreeMotion,
    },
    /// Members, nodes or loads that cannot be.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A section that cannot be.
    #[error(transparent)]
    Section(#[from] SectionError),
    /// A pattern that cannot be built.
    #[error("pattern: {0}")]
    Pattern(String),
    /// A support on a loop that the domain has not.
    #[error("structure.support.loop = {index}, but the domain has {loops} boundary loops (counted from 0)")]
    NoSuchLoop {
        /// The loop asked for.
        index: usize,
        /// How many there are.
        loops: usize,
    },
    /// No node for a column.
    #[error(
        "structure.{key}: no node inside the pattern within {limit:.3} m (half a target length) of ({}, {}); the nearest is \
         {distance:.3} m away",
        .point[0], .point[1]
    )]
    NoColumn {
        /// Key of the point.
        key: String,
        /// The point, m.
        point: [f64; 2],
        /// How far the nearest node is, m.
        distance: f64,
        /// How far it may be, m.
        limit: f64,
    },
    /// Parameters that contradict themselves; [`StructureParams::validate`] says so before.
    #[error("structure.{key}: {message}")]
    Params {
        /// Path of the key.
        key: String,
        /// What is wrong.
        message: String,
    },
    /// Rounding makes the stiffness singular, though nothing moves freely.
    #[error("ill-conditioned: stiffness or lengths differ by too many orders of magnitude")]
    IllConditioned,
    /// A number that is NaN or infinite.
    #[error("{0} is not finite")]
    NotFinite(&'static str),
    /// An iteration that did not settle.
    #[error("the {0} iteration did not converge")]
    NoConvergence(&'static str),
    /// Does not fit.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
}

impl From<Unsound> for AnalysisError {
    fn from(reason: Unsound) -> Self {
        match reason {
            Unsound::Mechanism(motion) => Self::Mechanism(motion),
            Unsound::IllConditioned => Self::IllConditioned,
            Unsound::NotFinite => Self::NotFinite("the stiffness"),
        }
    }
}

/// A proof of the buckling factor λ by two Cholesky factorisations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Certificate {
    /// K + 0.999 λ Kg is positive definite: no factor below.
    pub none_below: bool,
    /// K + 1.001 λ Kg is not: a factor no more than a thousandth above.
    pub one_here: bool,
}

impl Certificate {
    /// Whether both held.
    pub fn holds(&self) -> bool {
        self.none_below && self.one_here
    }
}

/// The first buckling mode.
#[derive(Clone, Debug, PartialEq)]
pub struct BucklingMode {
    /// The combination whose first-order axial forces buckle the structure.
    pub combination: String,
    /// Load factor λ.
    pub factor: f64,
    /// ux … rz of each node, scaled to a largest displacement of 1.
    pub shape: Vec<[f64; 6]>,
    /// Proof of λ, where it was asked for.
    pub certificate: Option<Certificate>,
}

/// Whether the buckling factor is proved, at the price of two factorisations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Proof {
    /// For what a search ends with.
    Certificate,
    /// For tables and pictures of designs to look at.
    None,
}

/// All that the exporters need beside the [`Response`].
#[derive(Debug)]
pub struct Detailed {
    /// The numbers.
    pub response: Response,
    /// The frame, with which of its members is which edge.
    pub model: GridshellModel,
    /// Results of each combination, by name.
    pub combinations: Vec<CombinationResult>,
    /// The first buckling mode, if there is a positive factor.
    pub mode: Option<BucklingMode>,
    /// The combinations over which `utilisation` is the worst, by name.
    pub enveloped: Vec<String>,
}

/// Analyses a pattern: statics of every combination, first buckling factor, height fixed or sized.
///
/// A pattern that no height makes meet the requirements gives the response at the largest height; see
/// [`Response::violation`].
///
/// # Errors
/// See [`AnalysisError`].
pub fn analyse(pattern: &Pattern, params: &StructureParams) -> Result<Response, AnalysisError> {
    refuse_invalid(params)?;
    let model = GridshellModel::new(pattern, params, largest_height(params))?;
    let mut evaluator = Evaluator::new(&model, params)?;
    let height = sizing::height(&mut evaluator, params)?;
    evaluator.response(height)
}

/// Analyses a pattern like [`analyse`] and gives displacements, forces, reactions, and the buckling mode, proved or
/// not, as well.
///
/// # Errors
/// See [`AnalysisError`].
pub fn analyse_detailed(
    pattern: &Pattern,
    params: &StructureParams,
    proof: Proof,
) -> Result<Detailed, AnalysisError> {
    refuse_invalid(params)?;
    let model = GridshellModel::new(pattern, params, largest_height(params))?;
    let mut evaluator = Evaluator::new(&model, params)?;
    let height = sizing::height(&mut evaluator, params)?;
    let response = evaluator.response(height)?;
    let (combinations, mode) = evaluator.details(proof)?;
    let enveloped = evaluator.enveloped();
    drop(evaluator);
    let model =
        if height == largest_height(params) { model } else { GridshellModel::new(pattern, params, height)? };
    Ok(Detailed { response, combinations, mode, enveloped, model })
}

fn largest_height(params: &StructureParams) -> f64 {
    match params.height {
        HeightParams::Fixed { fixed_m } => fixed_m,
        HeightParams::Sized { max_m, .. } => max_m,
    }
}

fn refuse_invalid(params: &StructureParams) -> Result<(), AnalysisError> {
    match params.validate().into_iter().next() {
        None => Ok(()),
        Some((key, message)) => Err(AnalysisError::Params { key, message }),
    }
}
