//! The pipeline in one place: string → topology → geometry → structure → numbers.
//!
//! A [`Study`] is made once from a config and only read afterwards. It serves the search as its [`Problem`], and the
//! designer's commands with whole [`Design`]s.

mod frozen;
mod loads;
mod remarks;
mod supports;
mod symmetry;

use crate::config::{Config, ResolvedConfig};
use crate::domain::params::Pinched;
use crate::domain::{self, Domain, DomainError};
use crate::evolve::{FAILED, Violation};
use crate::geometry::distinct::Distinct;
use crate::geometry::limits::{self, LimitExcess, Limits};
use crate::geometry::metrics::{self, Fabrication};
use crate::geometry::{self, Pattern, PatternParams, Rejection, Shaped};
use crate::grammar::{self, Decoded, Rules, Tokens};
use crate::io::Inputs;
use crate::mesh::distance::deletions;
use crate::mesh::fold::{FoldError, Folded};
use crate::mesh::isomorphism::{Equivalence, Symmetry, canonical_mesh_under};
use crate::mesh::{BaseMesh, BaseMeshError, CanonicalMesh, Code, InitialMesh, QuadMesh};
use crate::objectives::params::FabricationParams;
use crate::objectives::{self, AnalysedDesign, METRICS, Objective};
use crate::random::Rng;
use crate::search::operators::{Growth, Reach};
use crate::search::params::EquivalenceParams;
use crate::search::{Evaluation, Identity, Problem, RuleOperator, SearchParams, Steps, round_significant};
use crate::skeleton::params::RulesParam;
use crate::skeleton::{self, InitialError};
use crate::structure::StructureParams;
use crate::structure::gridshell::{self, AnalysisError, Detailed, Proof, Response};
use crate::surface::{self, Surface, SurfaceError, SurfaceParams};
use std::sync::Arc;

/// A config made ready: domain, surface, initial mesh, and the parameters of every stage.
pub struct Study {
    /// Boundary loops and corners.
    pub domain: Domain,
    /// What vertices are held on.
    pub surface: Arc<dyn Surface>,
    /// The initial mesh and the marker's start.
    pub initial: InitialMesh,
    /// The same folded along the mirrors of the config: where strings are decoded. Without mirrors the mesh itself.
    pub start: Folded,
    /// What is minimised, then what is maximised, in the order of the config.
    pub objectives: Vec<Objective>,
    /// By which rules strings grow.
    pub rules: Rules,
    symmetries: Vec<Symmetry>,
    /// The reflections that every pattern is to have.
    mirrors: Vec<domain::Symmetry>,
    /// Code of the initial mesh.
    baseline: Code,
    pinched: Pinched,
    pattern: PatternParams,
    fabrication: FabricationParams,
    limits: Limits,
    structure: Option<StructureParams>,
    search: SearchParams,
    /// The designs that the search goes on from.
    seeds: Vec<Tokens>,
}

/// Why a config cannot be made ready.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The surface is faulty.
    #[error("{0}")]
    Surface(#[from] SurfaceError),
    /// The domain is faulty.
    #[error("{0}")]
    Domain(#[from] DomainError),
    /// Supports that the symmetries of the config do not carry into each other.
    #[error(
        "domain.symmetries: structure.support fixes [{fixed}] on loop {label} and [{image_fixed}] on loop {image}, its image"
    )]
    Supports {
        /// A loop.
        label: usize,
        /// What is fixed there.
        fixed: String,
        /// Its image.
        image: usize,
        /// What is fixed there.
        image_fixed: String,
    },
    /// A point of a support that the symmetries of the config do not carry into another.
    #[error(
        "domain.symmetries: the supports do not have `{symmetry}`: nothing is fixed as near ({x}, {y}) near its image, ({u}, {v})"
    )]
    SupportImage {
        /// The symmetry.
        symmetry: &'static str,
        /// The point.
        x: f64,
        /// The point.
        y: f64,
        /// Its image.
        u: f64,
        /// Its image.
        v: f64,
    },
    /// A load that the symmetries of the config do not carry into itself.
    #[error(
        "domain.symmetries: `{symmetry}` makes two designs the same that are images of each other, but {key} does not have it: \
         {reason}; leave it out of domain.symmetries (topology.symmetry needs no symmetric loads), or make the load symmetric"
    )]
    LoadImage {
        /// Key of the load.
        key: String,
        /// The symmetry.
        symmetry: &'static str,
        /// Where it fails.
        reason: String,
    },
    /// A point of a support or a load that names nothing.
    #[error("{key}: {reason}")]
    SupportPoint {
        /// Its key.
        key: String,
        /// What is wrong with it.
        reason: String,
    },
    /// There is no initial mesh.
    #[error("{0}")]
    Initial(#[from] InitialError),
    /// Boundary or surface do not have a symmetry that patterns are to have.
    #[error("topology.symmetry: the domain does not have `{symmetry}`: {reason}")]
    NoMirror {
        /// The symmetry.
        symmetry: &'static str,
        /// What has no image.
        reason: String,
    },
    /// A symmetry that patterns are to have is listed twice.
    #[error("topology.symmetry: `{symmetry}` is listed twice")]
    MirrorTwice {
        /// The symmetry.
        symmetry: &'static str,
    },
    /// The initial mesh does not have a symmetry that patterns are to have.
    #[error("topology.symmetry: the initial mesh is not symmetric: {0}")]
    Fold(#[from] FoldError),
    /// A strip that is to be frozen is not there.
    #[error(
        "search.frozen.strips[{place}]: found {number}; allowed: numbers of strips of the initial mesh, at most {largest}"
    )]
    FrozenStrip {
        /// Its place in the list.
        place: usize,
        /// Its number.
        number: u32,
        /// The largest there is.
        largest: u32,
    },
    /// A region that is to be frozen holds nothing.
    #[error("search.frozen.regions_m[{place}]: no face of the initial mesh has its middle in this polygon")]
    FrozenRegion {
        /// Its place in the list.
        place: usize,
    },
    /// The initial mesh is not a valid quad mesh.
    #[error("topology.initial: {0}")]
    Mesh(#[from] BaseMeshError),
}

impl StudyError {
    /// The key of the config that says what is wrong.
    pub fn key(&self, config: &Config) -> String {
        match self {
            Self::Surface(error) => error.key(),
            Self::Domain(DomainError::NotCovered { .. }) => match &config.surface {
                SurfaceParams::Height { .. } => "surface.expression".to_owned(),
                SurfaceParams::Mesh { .. } => "surface.file".to_owned(),
                _ => "surface.kind".to_owned(),
            },
            Self::Domain(error) => error.key(&config.domain),
            Self::Supports { .. } | Self::SupportImage { .. } | Self::LoadImage { .. } => {
                "domain.symmetries".to_owned()
            }
            Self::SupportPoint { key, .. } => key.clone(),
            Self::Initial(error) => error.key(&config.topology),
            Self::Mesh(_) => "topology.initial".to_owned(),
            Self::FrozenStrip { place, .. } => format!("search.frozen.strips[{place}]"),
            Self::FrozenRegion { place } => format!("search.frozen.regions_m[{place}]"),
            Self::NoMirror { .. } | Self::MirrorTwice { .. } | Self::Fold(_) => {
                "topology.symmetry".to_owned()
            }
        }
    }
}

/// A design after all stages that it passed.
#[derive(Clone, Debug)]
pub struct Design {
    /// The canonical coarse mesh.
    pub topology: CanonicalMesh,
    /// The dense pattern on the surface.
    pub pattern: Pattern,
    /// Its measures.
    pub fabrication: Fabrication,
    /// How many different pieces it has.
    pub distinct: Distinct,
    /// What pieces cost.
    pub figures: FabricationParams,
    /// The limits of the pattern in the config, kept or not.
    pub limits: Vec<LimitExcess>,
    /// Requirements of metrics that the analysis alone does not tell, kept or not.
    pub required: Vec<LimitExcess>,
    /// The answer of the structure, where one is configured and was asked for.
    pub response: Option<Response>,
}

/// Why a design is not whole: data, ranked by the stage it reached (docs/reference/search.md §1.2).
#[derive(Clone, Debug)]
pub struct Failure {
    /// Stage and measure.
    pub violation: Violation,
    /// In words.
    pub reason: String,
    /// Whether the structure was analysed.
    pub structural: bool,
    /// What there is of it: nothing without a pattern.
    pub reached: Reached,
}

/// How far a design came that is not whole.
#[derive(Clone, Debug, Default)]
pub enum Reached {
    /// It has no pattern.
    #[default]
    Nothing,
    /// Its pattern is folded or leaves the domain: to be looked at, not to be measured.
    Folded(Box<Design>),
    /// Its pattern is sound, its structure gives no answer.
    Pattern(Box<Design>),
}

/// Which designs are worth a structural analysis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// None: geometry alone.
    Pattern,
    /// Only those that keep the pattern's limits, as in a search.
    Promising,
    /// All that have a pattern, for a designer who wants every number.
    Everything,
}

impl Study {
    /// Makes a config ready.
    ///
    /// # Errors
    /// See [`StudyError`]; nothing has been evaluated then.
    pub fn of(resolved: &ResolvedConfig) -> Result<Self, StudyError> {
        let (config, inputs) = (resolved.config(), resolved.inputs());
        let surface = surface::build(&config.surface, inputs)?;
        let domain = Domain::resolve_for(&config.domain, &surface, inputs, config.pattern.grain())?;
        let initial = initial_mesh(config, &domain, inputs)?;
        let symmetries = domain.symmetries(&config.domain.symmetries)?;
        if let Some(structure) = &config.structure {
            supports::check_points(&domain, structure)?;
            supports::check_symmetries(&domain, &symmetries, structure)?;
        }
        let symmetries: Vec<Symmetry> = symmetries.into_iter().map(|(_, symmetry)| symmetry).collect();
        let limits = Limits::of(&config.pattern.limits, config.pattern.target_length(&domain));
        let named = config.objectives.names().enumerate();
        let objectives = named.filter_map(|(place, name)| {
            let maximised = config.objectives.is_maximised(place);
            objectives::find(name).map(|metric| Objective { metric, maximised })
        });
        let mirrors: Vec<domain::Symmetry> = config.topology.symmetry.iter().map(|m| m.kind()).collect();
        let start = start_of(config, &domain, &initial)?;
        let whole = start.unfold(&start.part.mesh, start.part.marker).0;
        Ok(Self {
            rules: match config.topology.rules {
                RulesParam::Plain => Rules::Plain,
                RulesParam::Domain => Rules::Domain,
            },
            domain,
            surface,
            baseline: canonical_mesh_under(&whole, &symmetries).code,
            symmetries,
            mirrors,
            initial,
            start,
            objectives: objectives.collect(),
            fabrication: config.fabrication,
            pinched: config.topology.pinched,
            limits,
            pattern: config.pattern.clone(),
            structure: config.structure.clone(),
            search: config.search.clone(),
            seeds: resolved.seeds().to_vec(),
        })
    }

    /// Symmetries that boundary, surface and supports of `config`, of which this study was made, have and that it does not use.
    pub fn unused_symmetries(&self, config: &Config) -> Vec<&'static str> {
        let holds = |kind: &domain::Symmetry| {
            let symmetry = self.domain.symmetry(*kind).ok();
            symmetry.filter(|symmetry| !self.symmetries.contains(symmetry)).is_some_and(|symmetry| {
                config.structure.as_ref().is_none_or(|params| {
                    supports::check_symmetries(&self.domain, &[(*kind, symmetry)], params).is_ok()
                })
            })
        };
        domain::Symmetry::ALL.iter().filter(|kind| holds(kind)).map(|kind| kind.name()).collect()
    }

    /// Code of the initial mesh, of which nothing is changed by a string that expresses nothing.
    pub fn baseline(&self) -> Code {
        self.baseline
    }

    /// Reads a string. Trace and expressed string are those of the part that it is decoded on, mesh and marker those of the whole.
    pub fn decode(&self, tokens: &Tokens) -> Decoded {
        let part = self.decode_part(tokens);
        let (mesh, marker) = self.start.unfold(&part.mesh, part.marker);
        Decoded { mesh, marker, ..part }
    }

    /// Reads a string as far as the part of the mesh that it is decoded on; without mirrors that is all of it.
    pub fn decode_part(&self, tokens: &Tokens) -> Decoded {
        grammar::decode(&self.start.part, tokens, self.rules)
    }

    /// The canonical mesh of a string: all that geometry may know of it.
    pub fn topology(&self, tokens: &Tokens) -> CanonicalMesh {
        canonical_mesh_under(&self.decode(tokens).mesh, &self.symmetries)
    }

    /// Develops a topology through all stages.
    ///
    /// # Errors
    /// The [`Failure`] of the first stage that refuses the design.
    pub fn develop(&self, topology: CanonicalMesh, effort: Effort) -> Result<Design, Failure> {
        // Who wants every number gets them of designs too that break a limit in every pattern.
        let mut design = self.pattern(topology, (effort != Effort::Everything).then_some(&self.limits))?;
        let worthwhile = match effort {
            Effort::Pattern => false,
            Effort::Promising => design.limits.iter().all(|limit| limit.excess <= 0.0),
            Effort::Everything => true,
        };
        if let (true, Some(params)) = (worthwhile, &self.structure) {
            match gridshell::analyse(&design.pattern, params) {
                Ok(response) => design.answer(response, params),
                Err(error) => return Err(Failure::of_structure(error, design)),
            }
        }
        Ok(design)
    }

    /// As [`Study::develop`] with [`Effort::Everything`], and with all results of the structure: for files.
    ///
    /// # Errors
    /// As [`Study::develop`].
    pub fn develop_in_detail(
        &self,
        topology: CanonicalMesh,
        proof: Proof,
    ) -> Result<(Design, Option<Detailed>), Failure> {
        let mut design = self.draw(topology)?;
        let Some(params) = &self.structure else { return Ok((design, None)) };
        match gridshell::analyse_detailed(&design.pattern, params, proof) {
            Ok(detailed) => {
                design.answer(detailed.response.clone(), params);
                Ok((design, Some(detailed)))
            }
            Err(error) => Err(Failure::of_structure(error, design)),
        }
    }

    /// A topology with its pattern and its measures, whatever limit it breaks, the structure not asked: to look at.
    ///
    /// # Errors
    /// The [`Failure`] of one without a sound pattern.
    pub fn draw(&self, topology: CanonicalMesh) -> Result<Design, Failure> {
        self.pattern(topology, None)
    }

    /// The same, but refused at once where it would break `limits` in every pattern.
    fn pattern(&self, topology: CanonicalMesh, limits: Option<&Limits>) -> Result<Design, Failure> {
        if let Some(rejection) = self.rejection(&topology, limits) {
            return Err(rejection.into());
        }
        let surface = self.surface.as_ref();
        let Shaped { pattern, refused } = geometry::shape(&topology, &self.domain, surface, &self.pattern)?;
        let fabrication = metrics::measure(&pattern, &topology, &self.domain);
        let mut design = Design {
            distinct: Distinct::of(&pattern, self.fabrication.tolerance_m),
            figures: self.fabrication,
            limits: limits::excesses(&(&fabrication).into(), &self.limits),
            required: Vec::new(),
            response: None,
            topology,
            pattern,
            fabrication,
        };
        let limited = self.pattern.metric_limits.iter();
        let more = limited.filter_map(|l| objectives::limit(&design.analysed(), &l.quantity, l.max, l.min));
        let more: Vec<LimitExcess> = more.collect();
        design.limits.extend(more);
        match refused {
            None => Ok(design),
            Some(rejection @ Rejection::NotFinite { .. }) => Err(rejection.into()),
            Some(rejection) => {
                Err(Failure { reached: Reached::Folded(Box::new(design)), ..rejection.into() })
            }
        }
    }

    /// Whether the structure is analysed in first order.
    pub fn is_first_order(&self) -> bool {
        self.structure.as_ref().is_some_and(|structure| structure.order == 1)
    }

    /// Everything that is known of a developed design, as the search and the files take it.
    pub fn evaluation(&self, design: &Design) -> Evaluation {
        let analysed = design.analysed();
        let values: Vec<Option<f64>> = self.objectives.iter().map(|o| o.value(&analysed)).collect();
        let turned = self.objectives.iter().zip(&values).filter_map(|(o, value)| Some(o.turned((*value)?)));
        let objectives: Vec<f64> = turned.collect();
        let mut metrics = design.metrics();
        for (objective, value) in self.objectives.iter().zip(values).filter(|(o, _)| o.maximised) {
            // As it is compared, so it is told.
            let place = METRICS.iter().position(|metric| metric.name == objective.metric.name);
            if let Some(metric) = place.and_then(|place| metrics.get_mut(place)) {
                *metric = value.map(round_significant);
            }
        }
        let (measure, reason) = design.excess();
        Evaluation {
            violation: stage_1(measure),
            reason,
            objectives: if objectives.len() == self.objectives.len() { objectives } else { Vec::new() },
            metrics,
            governing: objectives::governing(&analysed),
            structural: design.response.is_some(),
        }
        .sanitised(self.objectives.len())
    }

    /// How strings grow here.
    fn growth(&self) -> Growth<'_> {
        Growth { initial: &self.start.part, rules: self.rules, bounds: self.search.tokens }
    }

    /// All strings that lead from an expressed string one strip further; several may have the same topology.
    pub fn neighbours(&self, expressed: &Tokens, reach: Reach) -> Vec<Tokens> {
        self.growth().neighbours(expressed, reach)
    }

    /// The codes by which the search tells duplicates (docs/reference/search.md §4): the design's own, then those of its
    /// deletions of up to `min_distance` − 1 strips.
    fn neighbourhood(&self, mesh: &QuadMesh, topology: &CanonicalMesh) -> Vec<(Code, u8)> {
        let EquivalenceParams { placed, reduce, mirror } = self.search.duplicates.equivalence;
        let equivalence = Equivalence { placed, reduce, mirror };
        let depth = self.search.duplicates.min_distance.saturating_sub(1) as usize;
        if depth > 0 {
            let reached = deletions(mesh, depth, equivalence).into_iter();
            let mut codes: Vec<(Code, u8)> = reached.map(|(code, deleted)| (code, deleted as u8)).collect();
            codes.sort_by_key(|&(code, deleted)| (deleted, code));
            codes
        } else if equivalence == Equivalence::default() {
            // The same code, and the only one that knows the symmetries of the domain.
            vec![(topology.code, 0)]
        } else {
            vec![(equivalence.code(mesh), 0)]
        }
    }

    /// Evaluates a topology with the given effort; failures become data.
    pub fn evaluate_topology(&self, topology: CanonicalMesh, effort: Effort) -> Evaluation {
        match self.develop(topology, effort) {
            Ok(design) => self.evaluation(&design),
            Err(failure) => (&failure).into(),
        }
    }
}

/// The initial mesh of the config.
fn initial_mesh(config: &Config, domain: &Domain, inputs: &Inputs) -> Result<InitialMesh, StudyError> {
    marked(&skeleton::initial(&config.topology, domain, inputs)?, domain)
}

/// A base mesh with its marks: not sharp where the domain has no corners (docs/reference/geometry.md §0.4).
fn marked(base: &BaseMesh, domain: &Domain) -> Result<InitialMesh, StudyError> {
    let mut initial = InitialMesh::from_base(base)?;
    if domain.mark().is_some() {
        initial.mesh.blunt(0);
    }
    Ok(initial)
}

/// The initial mesh of a config as it is folded along the mirrors that patterns are to have: where strings start.
///
/// # Errors
/// A symmetry that domain or mesh do not have; something to freeze that is not there.
pub fn start(config: &Config, domain: &Domain, base: &BaseMesh) -> Result<Folded, StudyError> {
    start_of(config, domain, &marked(base, domain)?)
}

fn start_of(config: &Config, domain: &Domain, initial: &InitialMesh) -> Result<Folded, StudyError> {
    let kinds: Vec<domain::Symmetry> = config.topology.symmetry.iter().map(|mirror| mirror.kind()).collect();
    let mirrors = symmetry::mirrors(domain, &kinds)?;
    let mut start = Folded::new(initial, &mirrors)?;
    frozen::freeze(&mut start, initial, &mirrors, &config.search)?;
    Ok(start)
}

impl Design {
    /// What the metrics are taken from.
    fn analysed(&self) -> AnalysedDesign<'_> {
        AnalysedDesign {
            topology: &self.topology,
            fabrication: &self.fabrication,
            distinct: &self.distinct,
            figures: &self.figures,
            response: self.response.as_ref(),
        }
    }

    /// Takes the answer of the structure, and asks what is required of other metrics.
    fn answer(&mut self, response: Response, params: &StructureParams) {
        self.response = Some(response);
        let asked = params.requirements.iter().filter(|required| required.analysed().is_none());
        let required =
            asked.filter_map(|r| objectives::limit(&self.analysed(), &r.quantity.to_string(), r.max, r.min));
        self.required = required.collect();
    }

    /// All metrics that it has, in the order of the registry, rounded as they are compared and written.
    fn metrics(&self) -> Vec<Option<f64>> {
        objectives::measure(&self.analysed()).into_iter().map(|m| m.map(round_significant)).collect()
    }

    /// Σ of the relative excesses over limits and requirements (stage 1), and what is exceeded, in words.
    pub fn excess(&self) -> (f64, String) {
        let limits = self.limits.iter().map(|l| (l.name.to_owned(), l.value, l.limit, l.excess));
        let requirements = self.response.iter().flat_map(|r| &r.requirements);
        let requirements = requirements.map(|r| (r.quantity.to_string(), r.value, r.limit, r.excess()));
        let required = self.required.iter().map(|l| (l.name.to_owned(), l.value, l.limit, l.excess));
        let exceeded: Vec<_> =
            limits.chain(requirements).chain(required).filter(|&(.., excess)| excess > 0.0).collect();
        let words: Vec<String> = exceeded
            .iter()
            .map(|(name, value, limit, _)| format!("{name} {value:.4} (limit {limit})"))
            .collect();
        (exceeded.iter().map(|&(.., excess)| excess).sum(), words.join("; "))
    }
}

/// The violation of limits and requirements that are exceeded by this much together.
fn stage_1(excess: f64) -> Violation {
    if excess > 0.0 { Violation::new(1, excess) } else { Violation::NONE }
}

impl Problem for Study {
    fn identify(&self, tokens: &Tokens) -> Identity {
        let decoded = self.decode(tokens);
        let topology = canonical_mesh_under(&decoded.mesh, &self.symmetries);
        let limits = (topology.code != self.baseline).then_some(&self.limits);
        let rejected = self
            .rejection(&topology, limits)
            .map(Failure::from)
            .map(|failure| (failure.violation, failure.reason));
        Identity {
            code: topology.code,
            neighbourhood: self.neighbourhood(&decoded.mesh, &topology),
            expressed: decoded.expressed,
            symmetries: self.symmetries_of(&topology),
            rejected,
        }
    }

    fn evaluate(&self, tokens: &Tokens) -> Evaluation {
        let topology = self.topology(tokens);
        // What everything is compared with gets every number, whatever limit it exceeds.
        let effort = if topology.code == self.baseline { Effort::Everything } else { Effort::Promising };
        self.evaluate_topology(topology, effort)
    }

    fn seeds(&self) -> Vec<Tokens> {
        self.seeds.clone()
    }

    fn random(&self, rng: &mut Rng) -> Tokens {
        self.growth().random(rng)
    }

    fn steps(&self, steps: Steps, expressed: &Tokens) -> Vec<Tokens> {
        self.growth().steps(steps, expressed)
    }

    fn vary(&self, operator: RuleOperator, expressed: &Tokens, rng: &mut Rng) -> Option<Tokens> {
        self.growth().vary(operator, expressed, rng)
    }
}

impl From<Rejection> for Failure {
    fn from(rejection: Rejection) -> Self {
        let violation = Violation::new(rejection.stage(), rejection.measure());
        Self { violation, reason: rejection.to_string(), structural: false, reached: Reached::Nothing }
    }
}

impl Failure {
    /// Of a design whose structure gives no answer.
    fn of_structure(error: AnalysisError, design: Design) -> Self {
        let stage = match &error {
            AnalysisError::Mechanism(_) | AnalysisError::Unstable { .. } => 2,
            _ => FAILED,
        };
        Self {
            violation: Violation::new(stage, 1.0),
            reason: error.to_string(),
            structural: true,
            reached: Reached::Pattern(Box::new(design)),
        }
    }
}

impl From<&Failure> for Evaluation {
    fn from(failure: &Failure) -> Self {
        let metrics = match &failure.reached {
            Reached::Pattern(design) => design.metrics(),
            Reached::Nothing | Reached::Folded(_) => vec![None; METRICS.len()],
        };
        Self {
            violation: failure.violation,
            reason: failure.reason.clone(),
            objectives: Vec::new(),
            metrics,
            governing: Vec::new(),
            structural: failure.structural,
        }
    }
}
