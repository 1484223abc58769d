//! What each point of a front adds to the hypervolume, by sampling (Bader and Zitzler 2011, doi:10.1162/EVCO_a_00009).

use super::sampled::unit_sample;

/// Number of sample points, 2¹⁴.
const SAMPLES: usize = 1 << 14;

/// The volume that each point of a front dominates alone, while points are taken away.
///
/// The fixed sample lies between the front's own best values and the reference. A sample that one point alone dominates is that
/// point's. A point not better than the reference everywhere has none.
#[derive(Clone, Debug)]
pub(super) struct Contributions {
    /// The samples that each point dominates.
    dominated: Vec<Vec<u32>>,
    /// Of each sample, how many points that are left dominate it, and the exclusive or of their numbers: the number itself once it
    /// is one.
    dominators: Vec<(u32, u32)>,
    /// How many samples are each point's.
    own: Vec<u32>,
}

impl Contributions {
    /// Of the points of one front, all finite and as long as `reference`.
    pub(super) fn new(front: &[&[f64]], reference: &[f64]) -> Self {
        let inside = |p: &usize| front[*p].iter().zip(reference).all(|(x, r)| x < r);
        let inside: Vec<usize> = (0..front.len()).filter(inside).collect();
        let best: Vec<f64> = (0..reference.len())
            .map(|m| inside.iter().fold(reference[m], |best, &p| best.min(front[p][m])))
            .collect();
        let mut contributions = Self {
            dominated: vec![Vec::new(); front.len()],
            dominators: vec![(0, 0); SAMPLES],
            own: vec![0; front.len()],
        };
        let mut sample = unit_sample(reference.len(), SAMPLES);
        for (k, sample) in sample.chunks_exact_mut(reference.len()).enumerate() {
            for (x, (best, reference)) in sample.iter_mut().zip(best.iter().zip(reference)) {
                *x = best + (reference - best) * *x;
            }
            for &p in &inside {
                if front[p].iter().zip(&*sample).all(|(x, s)| x <= s) {
                    contributions.dominated[p].push(k as u32);
                    let (count, who) = &mut contributions.dominators[k];
                    *count += 1;
                    *who ^= p as u32;
                }
            }
        }
        for &(_, who) in contributions.dominators.iter().filter(|(count, _)| *count == 1) {
            contributions.own[who as usize] += 1;
        }
        contributions
    }

    /// The share of the sample that is a point's, in samples.
    pub(super) fn of(&self, point: usize) -> u32 {
        self.own[point]
    }

    /// Takes a point away: what it shared with one other is the other's now.
    pub(super) fn remove(&mut self, point: usize) {
        for &sample in &self.dominated[point] {
            let (count, who) = &mut self.dominators[sample as usize];
            *count -= 1;
            *who ^= point as u32;
            if *count == 1 {
                self.own[*who as usize] += 1;
            }
        }
        self.own[point] = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evolve::hypervolume;
    use crate::random::{stream, unit};

    #[test]
    fn what_is_dominated_alone_also_after_points_went() {
        let mut rng = stream(6, 0, 0);
        for m in [2, 3, 4] {
            let points: Vec<Vec<f64>> =
                (0..9).map(|_| (0..m).map(|_| 1.05 * unit(&mut rng)).collect()).collect();
            let mut left: Vec<usize> = (0..9).collect();
            let all: Vec<&[f64]> = points.iter().map(Vec::as_slice).collect();
            let reference = vec![1.0; m];
            let mut contributions = Contributions::new(&all, &reference);
            let inside = |p: &&&[f64]| p.iter().all(|x| *x < 1.0);
            let side = |k: usize| 1.0 - all.iter().filter(inside).fold(1.0, |best, p| f64::min(best, p[k]));
            let cell = (0..m).fold(1.0 / SAMPLES as f64, |v, k| v * side(k));
            while left.len() > 3 {
                let volume =
                    |of: &[usize]| hypervolume(&of.iter().map(|&i| all[i]).collect::<Vec<_>>(), &reference);
                for &p in &left {
                    let others: Vec<usize> = left.iter().copied().filter(|&i| i != p).collect();
                    let exact = volume(&left) - volume(&others);
                    let sampled = f64::from(contributions.of(p)) * cell;
                    assert!((exact - sampled).abs() < 0.01, "{m}: {exact} {sampled}");
                }
                contributions.remove(left.remove(4 % left.len()));
            }
        }
    }
}
