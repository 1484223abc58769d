//! The `[objectives]` and `[search]` tables of the config.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What is minimised.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ObjectivesParams {
    /// Names of the objectives. Empty: the six of the paper, or, without `[structure]`, the three of fabrication.
    #[serde(default)]
    pub minimise: Vec<String>,
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
    /// Share of children that are one or two steps away from a good design found so far.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub local: f64,
    /// Probability that a child bred token-wise has two parents.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub crossover: f64,
    /// How often which kind of crossover, relative to each other.
    pub crossover_kinds: CrossoverKinds,
    /// Token-wise mutation, rates per token.
    pub mutation: MutationParams,
    /// Rule-wise operators, shares of all children; the rest are bred token-wise.
    pub rules: RuleParams,
    /// How the last front that survives is cut.
    pub survival: Survival,
    /// How many candidates are bred for each place, of which geometry chooses one to be analysed; 1 = no choice. Only
    /// where it tells some of the objectives, and while at least half of the designs come as far as the analysis.
    #[schemars(extend("minimum" = 1, "maximum" = 100))]
    pub screen: usize,
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
    /// The bounded archive that parents may come from.
    pub archive: ArchiveParams,
}

impl Default for SearchParams {
    fn default() -> Self {
        Self {
            population: 16,
            generations: 75,
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
            local: 0.0,
            crossover: 0.9,
            crossover_kinds: CrossoverKinds::default(),
            mutation: MutationParams::default(),
            rules: RuleParams::default(),
            survival: Survival::Auto,
            screen: 1,
            immigrants: 0.0,
            refills: 3,
            rebreed_rejected: true,
            duplicates: DuplicateParams::default(),
            archive: ArchiveParams::default(),
        }
    }
}

impl SearchParams {
    /// How many designs are bred in generation 0: those of all islands, or the near ones, if these are more.
    pub fn first(&self) -> usize {
        let all = self.population.saturating_mul(self.islands);
        match self.initial.kind {
            Initialiser::Near => all.max(self.near(all)),
            _ => all,
        }
    }

    /// The share of the budget that goes to the neighbourhood of the initial mesh, in designs.
    fn near(&self, generation: usize) -> usize {
        let share = self.initial.near_share;
        let designs = match self.evaluations {
            Some(budget) => share * budget as f64,
            // The later generations are the rest of all designs.
            None => share / (1.0 - share) * generation as f64 * f64::from(self.generations),
        };
        designs as usize
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
    /// How random strings are made.
    pub kind: Initialiser,
    /// Which share of all designs the neighbourhood of the initial mesh may take, where `kind` is `near`.
    #[schemars(extend("minimum" = 0, "exclusiveMaximum" = 1))]
    pub near_share: f64,
}

impl Default for InitialParams {
    fn default() -> Self {
        Self { kind: Initialiser::Aware, near_share: 0.4 }
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

/// How random strings are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Initialiser {
    /// All tokens equally likely.
    Uniform,
    /// A's in pairs with two or more T's between.
    Structured,
    /// As structured, but follows the decoding and closes a pair only where that is applicable.
    Aware,
    /// The neighbourhood of the initial mesh, in a fixed order; random strings, where there is need of them, as `aware`.
    Near,
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

/// Weights of the kinds of crossover; only their ratios matter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CrossoverKinds {
    /// One cut at the same place in both parents.
    #[schemars(extend("minimum" = 0))]
    pub one_point: f64,
    /// A middle piece exchanged, cut at the same places in both parents.
    #[schemars(extend("minimum" = 0))]
    pub two_point: f64,
    /// One cut, at a place of its own in each parent.
    #[schemars(extend("minimum" = 0))]
    pub cut_and_splice: f64,
    /// One cut at the end of a rule in each parent.
    #[schemars(extend("minimum" = 0))]
    pub rule_ends: f64,
}

impl Default for CrossoverKinds {
    fn default() -> Self {
        Self { one_point: 1.0, two_point: 1.0, cut_and_splice: 1.0, rule_ends: 1.0 }
    }
}

/// Rule-wise operators: the share of all children each of them makes from one parent. The rest are bred token-wise.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RuleParams {
    /// Append a strip along a valid polyedge reached by the shortest walk.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub append_strip: f64,
    /// Append the deletion of a strip reached by the shortest walk.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub append_deletion: f64,
    /// Drop the last rule.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub drop_last: f64,
    /// Swap `A`, `A*` and `A°` of a pair.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub swap_pair: f64,
}

impl Default for RuleParams {
    fn default() -> Self {
        Self { append_strip: 0.3, append_deletion: 0.2, drop_last: 0.05, swap_pair: 0.15 }
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

/// The bounded ε-grid archive.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ArchiveParams {
    /// Side of a grid box, as a share of each normalised objective.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    pub epsilon: f64,
    /// Most members.
    #[schemars(extend("minimum" = 1))]
    pub max: usize,
    /// Share of parents drawn from it rather than from the population.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub parents: f64,
}

impl Default for ArchiveParams {
    fn default() -> Self {
        Self { epsilon: 0.01, max: 200, parents: 0.0 }
    }
}
