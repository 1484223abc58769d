//! NSGA-II as a loop over anything that can be bred and evaluated (Deb et al. 2002, §III-C).

use super::domination::Fitness;
use super::selection::{standings, survive, tournament};
use super::sorting::fronts;
use crate::random::{Rng, stream};

/// A population: designs of any kind, each with its fitness.
#[derive(Clone, PartialEq, Debug)]
pub struct Population<D> {
    /// The designs.
    pub designs: Vec<D>,
    /// The fitness of each.
    pub fitness: Vec<Fitness>,
}

impl<D> Population<D> {
    /// Evaluates the designs that a search starts from.
    pub fn new(designs: Vec<D>, evaluate: impl Fn(&D) -> Fitness) -> Self {
        let fitness = designs.iter().map(evaluate).collect();
        Self { designs, fitness }
    }

    /// One generation: as many children as there are designs, each of two parents that won their tournaments; of parents and
    /// children together as many survive as there were.
    pub fn advance(
        &mut self,
        rng: &mut Rng,
        breed: impl Fn(&D, &D, &mut Rng) -> D,
        evaluate: impl Fn(&D) -> Fitness,
    ) {
        let size = self.designs.len();
        let standings = standings(&self.fitness);
        for _ in 0..size {
            let (Some(a), Some(b)) = (tournament(&standings, rng), tournament(&standings, rng)) else {
                break;
            };
            let child = breed(&self.designs[a], &self.designs[b], rng);
            self.fitness.push(evaluate(&child));
            self.designs.push(child);
        }
        let mut kept = vec![false; self.designs.len()];
        survive(&self.fitness, size).into_iter().for_each(|survivor| kept[survivor] = true);
        retain(&mut self.designs, &kept);
        retain(&mut self.fitness, &kept);
    }

    /// The designs that no other dominates, with their fitness; of a population without a feasible design those that violate
    /// least.
    pub fn front(&self) -> Vec<(&D, &Fitness)> {
        let first = fronts(&self.fitness).into_iter().next().unwrap_or_default();
        first.into_iter().map(|i| (&self.designs[i], &self.fitness[i])).collect()
    }
}

/// Keeps what is marked.
fn retain<T>(all: &mut Vec<T>, kept: &[bool]) {
    let mut marks = kept.iter();
    all.retain(|_| marks.next().is_some_and(|kept| *kept));
}

/// NSGA-II from `start` on, for so many generations, everything minimised. The same seed gives the same population.
pub fn evolve<D>(
    start: Vec<D>,
    (generations, seed): (u32, u64),
    breed: impl Fn(&D, &D, &mut Rng) -> D,
    evaluate: impl Fn(&D) -> Fitness,
) -> Population<D> {
    let mut population = Population::new(start, &evaluate);
    for generation in 1..=generations {
        population.advance(&mut stream(seed, generation, 0), &breed, &evaluate);
    }
    population
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evolve::Violation;
    use crate::random::unit;

    /// Schaffer's SCH (1985): x² and (x − 2)², whose Pareto set is 0 ≤ x ≤ 2.
    fn schaffer(x: &f64) -> Fitness {
        Fitness::new(Violation::NONE, vec![x * x, (x - 2.0).powi(2)])
    }

    fn breed(a: &f64, b: &f64, rng: &mut Rng) -> f64 {
        let t = unit(rng) * 2.0 - 0.5;
        a + t * (b - a) + 0.1 * (unit(rng) - 0.5)
    }

    #[test]
    fn schaffers_front_is_found_and_its_ends_are_reached() {
        let start: Vec<f64> = (0..20).map(|k| f64::from(k) * 10.0 - 100.0).collect();
        let found = evolve(start.clone(), (60, 1), breed, schaffer);
        assert_eq!(found.designs.len(), 20);
        assert!(found.designs.iter().all(|x| (-0.1..=2.1).contains(x)), "{:?}", found.designs);
        let least = found.designs.iter().copied().fold(f64::INFINITY, f64::min);
        let most = found.designs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        assert!(least < 0.2 && most > 1.8, "{least} to {most}");
        assert_eq!(found, evolve(start, (60, 1), breed, schaffer));
    }

    #[test]
    fn nobody_breeds_nobody() {
        let none: Vec<f64> = Vec::new();
        assert!(evolve(none, (3, 1), breed, schaffer).front().is_empty());
    }
}
