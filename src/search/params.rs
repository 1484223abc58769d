//! The `[objectives]` and `[search]` tables of the config.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What is minimised, and maximised.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ObjectivesParams {
    /// Names of the objectives. Empty, and nothing maximised: the six of the paper, or, without `[structure]`, the three of fabrication.
    #[serde(default)]
    pub minimise: Vec<String>,
    /// Names of objectives that are better the larger they are; in the lists below they come after those that are minimised.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub maximise: Vec<String>,
    /// Ideal value of each, for normalising and hypervolume; empty = from the first feasible evaluations.
    #[serde(default)]
    pub ideal: Vec<f64>,
    /// Reference value of each; empty = 1.1 × the worst of the first feasible evaluations.
    #[serde(default)]
    pub reference: Vec<f64>,
    /// How much each objective matters: orders the front in its column `preferred`; changes nothing of the search. Empty with an
    /// `aspiration`: all alike.
    #[serde(default)]
    pub weights: Vec<f64>,
    /// A value of each objective that would do, from which designs are measured for the column `preferred`. Empty with `weights`: the
    /// ideal.
    #[serde(default)]
    pub aspiration: Vec<f64>,
}

impl ObjectivesParams {
    /// The names of all objectives: those minimised, then those maximised.
    pub fn names(&self) -> impl Iterator<Item = &String> {
        self.minimise.iter().chain(&self.maximise)
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.minimise.len() + self.maximise.len()
    }

    /// Whether the objective in this place is maximised.
    pub fn is_maximised(&self, place: usize) -> bool {
        place >= self.minimise.len()
    }

    /// From values as files and people have them, in the order of the objectives, to those that the search makes small, and back: what is
    /// maximised changes its sign.
    pub fn turned(&self, values: &[f64]) -> Vec<f64> {
        let turn = |(place, &value): (usize, &f64)| if self.is_maximised(place) { -value } else { value };
        values.iter().enumerate().map(turn).collect()
    }

    /// What is minimised and maximised, in words.
    pub fn in_words(&self) -> String {
        let all = [("minimising", &self.minimise), ("maximising", &self.maximise)];
        let told = all.iter().filter(|(_, names)| !names.is_empty());
        told.map(|(what, names)| format!("{what} {}", names.join(", "))).collect::<Vec<_>>().join("; ")
    }
}

/// How strings are bred (docs/reference/search.md).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SearchParams {
    /// Population size μ.
    #[schemars(extend("minimum" = 2, "maximum" = 1_000_000))]
    pub population: usize,
    /// Number of generations.
    pub generations: u32,
    /// Stop after this many structural evaluations.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 1))]
    pub evaluations: Option<u64>,
    /// Stop after this many minutes.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub minutes: Option<f64>,
    /// Stop when the hypervolume has not grown for this many generations. Those before it is more than 0, in which no
    /// feasible design better than the reference was known, do not count.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 1))]
    pub stall_generations: Option<u32>,
    /// How many populations live side by side, each of `population` designs.
    #[schemars(extend("minimum" = 1, "maximum" = 1000))]
    pub islands: usize,
    /// After how many generations each island hands copies of its best to the next.
    #[schemars(extend("minimum" = 1))]
    pub migrate: u32,
    /// Bounds of a string's length.
    pub tokens: TokenBounds,
    /// The first population.
    pub initial: InitialParams,
    /// Designs to go on from, always evaluated first: a list of strings, or a results folder of a run with the same initial mesh, of which
    /// the front is taken. The initial mesh, which the empty string stands for, is evaluated in any case.
    pub seeds: Seeds,
    /// What no rule may touch.
    pub frozen: FrozenParams,
    /// Whether strips may be added that end in poles.
    pub poles: bool,
    /// Share of children that are one or two steps away from a good design found so far: a strip added, deleted, or with other ends. The
    /// rest are bred token-wise.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub local: f64,
    /// Probability that a child bred token-wise has two parents.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub crossover: f64,
    /// Token-wise mutation, rates per token.
    pub mutation: MutationParams,
    /// How the last front that survives is cut.
    pub survival: Survival,
    /// Share of children that are random strings, without parents; 1 = random search.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub immigrants: f64,
    /// How often a generation is filled up again when designs failed before their structure was analysed, so that
    /// cheap failures do not use it up.
    pub refills: u32,
    /// Breed a child anew when topology alone rules it out, instead of recording it as a failure.
    pub rebreed_rejected: bool,
    /// Which phenotypes count as the same.
    pub duplicates: DuplicateParams,
}

impl Default for SearchParams {
    fn default() -> Self {
        Self {
            population: 16,
            generations: 60,
            evaluations: None,
            minutes: None,
            stall_generations: None,
            islands: 1,
            migrate: 5,
            tokens: TokenBounds::default(),
            initial: InitialParams::default(),
            seeds: Seeds::default(),
            frozen: FrozenParams::default(),
            poles: true,
            local: 0.8,
            crossover: 0.9,
            mutation: MutationParams::default(),
            survival: Survival::Auto,
            immigrants: 0.0,
            refills: 3,
            rebreed_rejected: true,
            duplicates: DuplicateParams::default(),
        }
    }
}

impl SearchParams {
    /// How many designs are bred in generation 0: those of all islands, or the near ones, if these are more.
    pub fn first(&self) -> usize {
        let all = self.population.saturating_mul(self.islands);
        match self.initial.kind {
            Initialiser::Near => all.max(self.initial.near),
            Initialiser::Aware => all,
        }
    }
}

/// Bounds of a string's length, in tokens.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TokenBounds {
    /// Fewest tokens of a bred string.
    pub min: usize,
    /// Most tokens.
    #[schemars(extend("minimum" = 1, "maximum" = 10_000))]
    pub max: usize,
}

impl Default for TokenBounds {
    fn default() -> Self {
        Self { min: 4, max: 40 }
    }
}

/// The first population.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct InitialParams {
    /// Where they come from. With more than four objectives the default is `aware` (docs/search.md).
    pub kind: Initialiser,
    /// How many designs near the initial mesh are looked at first, where `kind` is `near` and there are so many: a good part of the whole
    /// budget.
    pub near: usize,
}

impl Default for InitialParams {
    fn default() -> Self {
        Self { kind: Initialiser::Near, near: 160 }
    }
}

/// Designs to go on from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Seeds {
    /// Their strings; they may be shorter than `tokens.min`.
    Strings(Vec<String>),
    /// A results folder: the strings of its `pareto.csv`.
    Folder(PathBuf),
}

impl Default for Seeds {
    fn default() -> Self {
        Self::Strings(Vec::new())
    }
}

/// What no rule may touch of the initial mesh: a rule that would is not applicable.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FrozenParams {
    /// All faces of these strips, by their numbers as `decode --string ""` prints them.
    pub strips: Vec<u32>,
    /// All faces whose middle lies in one of these polygons, m.
    pub regions_m: Vec<Vec<[f64; 2]>>,
}

/// Where the first designs come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Initialiser {
    /// The neighbourhood of the initial mesh, in a fixed order; then, where there is need of them, as `aware`.
    Near,
    /// Random strings that follow the decoding, and close a pair only where that is applicable.
    Aware,
}

impl Initialiser {
    /// What is taken with this number of objectives where a config does not say.
    pub fn of(objectives: usize) -> Self {
        if objectives > MANY { Self::Aware } else { Self::Near }
    }
}

/// Which designs of the last front that survives stay: whole fronts before it always do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Survival {
    /// `crowding` for up to four objectives, `hypervolume` for more.
    Auto,
    /// Those of the largest crowding distance (Deb et al. 2002).
    Crowding,
    /// Those that add most to the hypervolume before the reference, once there is one; until then as `crowding`.
    Hypervolume,
}

/// With more objectives than this most designs are non-dominated, and crowding distance, which does not tell good from bad, decides
/// alone (docs/search.md).
const MANY: usize = 4;

impl Survival {
    /// Whether the hypervolume decides, with this number of objectives.
    pub fn by_hypervolume(self, objectives: usize) -> bool {
        match self {
            Self::Auto => objectives > MANY,
            Self::Crowding => false,
            Self::Hypervolume => true,
        }
    }
}

/// Token-wise mutation, rates per token.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MutationParams {
    /// Rate of insertion.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub insert: f64,
    /// Rate of removal.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub remove: f64,
    /// Rate of substitution.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub substitute: f64,
}

impl Default for MutationParams {
    fn default() -> Self {
        Self { insert: 0.02, remove: 0.02, substitute: 0.02 }
    }
}

/// Which phenotypes count as the same, and what happens to them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DuplicateParams {
    /// A child nearer than this topological distance to a known design is bred anew; 0 = rule off, at most 3.
    #[schemars(extend("maximum" = 3))]
    pub min_distance: u32,
    /// What "the same" means.
    pub equivalence: EquivalenceParams,
    /// How often a child is bred anew before a random string takes its place.
    #[schemars(extend("maximum" = 1_000_000))]
    pub tries: u32,
}

impl Default for DuplicateParams {
    fn default() -> Self {
        Self { min_distance: 1, equivalence: EquivalenceParams::default(), tries: 20 }
    }
}

/// Options of isomorphism (docs/reference/grammar.md §6).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct EquivalenceParams {
    /// Boundary loops and corners count.
    pub placed: bool,
    /// Parallel strips do not count.
    pub reduce: bool,
    /// A mirrored mesh is the same.
    pub mirror: bool,
}

impl Default for EquivalenceParams {
    fn default() -> Self {
        Self { placed: true, reduce: true, mirror: false }
    }
}
