//! Normalised objectives, and the hypervolume that is measured in them (docs/reference/search.md §6).

use serde::{Deserialize, Serialize};

use crate::evolve::{NonDominated, SampledHypervolume, hypervolume};

/// Fewest feasible evaluations from which a missing ideal or reference is taken.
pub const ENOUGH: usize = 20;

/// The most objectives whose hypervolume is exact.
const EXACT: usize = 4;

/// Where 0 and 1 of each normalised objective lie. Absolute numbers, fixed for a run.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Normalisation {
    /// 0 of each axis.
    pub ideal: Vec<f64>,
    /// 1 of each axis, beyond which nothing counts.
    pub reference: Vec<f64>,
}

impl Normalisation {
    /// From the config's lists, an empty one of which is filled from `feasible`: the ideal is the best value of each
    /// objective, the reference the worst plus a tenth of its size. `None` while something is missing and there are
    /// fewer than [`ENOUGH`] designs to take it from.
    pub fn establish<'a>(
        ideal: &[f64],
        reference: &[f64],
        feasible: impl ExactSizeIterator<Item = &'a [f64]>,
    ) -> Option<Self> {
        if !ideal.is_empty() && !reference.is_empty() {
            return Some(Self { ideal: ideal.to_vec(), reference: reference.to_vec() });
        }
        if feasible.len() < ENOUGH {
            return None;
        }
        let (best, worst) = extremes(feasible)?;
        let ideal = if ideal.is_empty() { best } else { ideal.to_vec() };
        let reference = if reference.is_empty() {
            let beyond = |(w, i): (&f64, &f64)| {
                let r = w + 0.1 * w.abs();
                // An objective that never varied still needs an axis of some length.
                if r > *i { r } else { i + 0.1 * i.abs() + f64::MIN_POSITIVE.sqrt() }
            };
            worst.iter().zip(&ideal).map(beyond).collect()
        } else {
            reference.to_vec()
        };
        Some(Self { ideal, reference })
    }

    /// From the spread of a sample: 0 at the 1 % quantile of each objective, 1 at the 95 % quantile, so that neither
    /// depends on one odd design. `None` without points.
    pub fn quantiles<'a>(points: impl Iterator<Item = &'a [f64]>) -> Option<Self> {
        let mut columns: Vec<Vec<f64>> = Vec::new();
        for point in points {
            columns.resize(point.len(), Vec::new());
            columns.iter_mut().zip(point).for_each(|(column, x)| column.push(*x));
        }
        columns.iter_mut().for_each(|column| column.sort_by(f64::total_cmp));
        let axis = |q: f64| columns.iter().map(|column| quantile(column, q)).collect();
        (!columns.is_empty()).then(|| Self { ideal: axis(0.01), reference: axis(0.95) })
    }

    /// A point in units of the axes.
    pub fn apply(&self, objectives: &[f64]) -> Vec<f64> {
        let axes = self.ideal.iter().zip(&self.reference);
        objectives.iter().zip(axes).map(|(f, (ideal, reference))| (f - ideal) / (reference - ideal)).collect()
    }

    /// The volume that points dominate below the axes' one, in units of the axes; points better than the axes' zero
    /// count in full with up to 4 objectives (exact), down to [`LOWER_CORNER`](crate::evolve::LOWER_CORNER) with more (sampled).
    pub fn hypervolume<'a>(&self, points: impl Iterator<Item = &'a [f64]>) -> f64 {
        let points: Vec<Vec<f64>> = points.map(|point| self.apply(point)).collect();
        let dimensions = self.ideal.len();
        if dimensions > EXACT {
            let mut sampled = SampledHypervolume::new(dimensions);
            points.iter().for_each(|point| sampled.offer(point));
            return sampled.value();
        }
        let points: Vec<&[f64]> = points.iter().map(Vec::as_slice).collect();
        hypervolume(&points, &vec![1.0; dimensions])
    }
}

/// The value that a share `q` of the sorted `values` does not exceed (nearest rank).
///
/// # Panics
/// Without values.
pub fn quantile(values: &[f64], q: f64) -> f64 {
    let rank = (q * values.len() as f64).ceil() as usize;
    values[rank.clamp(1, values.len()) - 1]
}

/// The smallest and the largest value of each objective.
pub(crate) fn extremes<'a>(points: impl Iterator<Item = &'a [f64]>) -> Option<(Vec<f64>, Vec<f64>)> {
    points.fold(None, |extremes, point| {
        let Some((mut low, mut high)) = extremes else { return Some((point.to_vec(), point.to_vec())) };
        for ((l, h), x) in low.iter_mut().zip(&mut high).zip(point) {
            *l = l.min(*x);
            *h = h.max(*x);
        }
        Some((low, high))
    })
}

/// The hypervolume of a front that only ever improves.
#[derive(Clone, Debug)]
pub(crate) struct Volume {
    normalisation: Normalisation,
    sampled: Option<SampledHypervolume>,
    value: f64,
}

impl Volume {
    /// Nothing dominated yet.
    pub(crate) fn new(normalisation: Normalisation) -> Self {
        let dimensions = normalisation.ideal.len();
        let sampled = (dimensions > EXACT).then(|| SampledHypervolume::new(dimensions));
        Self { normalisation, sampled, value: 0.0 }
    }

    /// Goes on from a front and the value it had.
    pub(crate) fn restore(&mut self, front: &NonDominated, value: f64) {
        self.update(front, |_| true);
        self.value = value;
    }

    /// The value after the last update.
    pub(crate) fn value(&self) -> f64 {
        self.value
    }

    pub(crate) fn normalisation(&self) -> &Normalisation {
        &self.normalisation
    }

    /// Takes a front that dominates all earlier ones; `new` tells which of its members are new.
    pub(crate) fn update(&mut self, front: &NonDominated, new: impl Fn(usize) -> bool) {
        let value = match &mut self.sampled {
            Some(sampled) => {
                let points = front.ids().zip(front.points()).filter(|(id, _)| new(*id));
                points.for_each(|(_, point)| sampled.offer(&self.normalisation.apply(point)));
                sampled.value()
            }
            None => self.normalisation.hypervolume(front.points()),
        };
        // Sums over another set of points may differ in the last bit; a front that improved has not lost volume.
        self.value = self.value.max(value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_numbers_come_from_the_first_designs() {
        let points: Vec<Vec<f64>> = (0..20).map(|k| vec![f64::from(k), -f64::from(k), 3.0]).collect();
        let few = points[..19].iter().map(Vec::as_slice);
        assert_eq!(Normalisation::establish(&[], &[], few.clone()), None);
        let given = Normalisation::establish(&[0.0; 3], &[1.0; 3], few).expect("given");
        assert_eq!(given.apply(&[0.5, 1.0, -1.0]), [0.5, 1.0, -1.0]);
        let taken = Normalisation::establish(&[], &[], points.iter().map(Vec::as_slice)).expect("enough");
        assert_eq!(taken.ideal, [0.0, -19.0, 3.0]);
        assert!((taken.reference[0] - 20.9).abs() < 1e-12 && taken.reference[1] == 0.0);
        assert!(taken.reference[2] > 3.0);
    }

    #[test]
    fn axes_of_a_sample() {
        let points: Vec<[f64; 2]> = (1..=1000).rev().map(|k| [f64::from(k), -f64::from(k)]).collect();
        let axes = Normalisation::quantiles(points.iter().map(|p| &p[..])).expect("points");
        assert_eq!((axes.ideal, axes.reference), (vec![10.0, -991.0], vec![950.0, -51.0]));
        assert_eq!(Normalisation::quantiles(std::iter::empty()), None);
        assert_eq!([0.25, 0.5, 0.75].map(|q| quantile(&[1.0, 2.0, 3.0], q)), [1.0, 2.0, 3.0]);
    }
}
