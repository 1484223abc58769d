//! NSGA-II (Deb et al. 2002). Knows nothing of meshes: numbers in, indices out.
//!
//! All functions take slices of [`Fitness`] or of objective vectors and return indices into them; none reorders
//! the caller's data. Everything is minimised. Numbers are compared by `total_cmp`, and an objective that is not
//! finite makes a design failed ([`Fitness::new`]), so NaN neither enters a front nor wins a tournament.

mod contribution;
mod crowding;
mod dependence;
mod domination;
mod hypervolume;
mod nondominated;
mod population;
mod preference;
mod sampled;
mod selection;
mod sorting;

pub use crowding::crowding_distance;
pub use dependence::{Redundancy, redundancies};
pub use domination::{Domination, FAILED, Fitness, Violation, compare, compare_objectives};
pub use hypervolume::hypervolume;
pub use nondominated::{NonDominated, visible};
pub use population::{Population, evolve};
pub use preference::Preference;
pub use sampled::{LOWER_CORNER, SAMPLES, SampledHypervolume};
pub use selection::{Standing, standings, survive, survive_by_contribution, tournament};
pub use sorting::fronts;
