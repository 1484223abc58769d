//! Which of several candidates is worth an analysis, by what geometry alone tells.

use super::normalise::Normalisation;
use super::params::SearchParams;
use super::problem::{Preview, Problem};
use super::state::State;
use crate::random::{Rng, unit};

/// How a generation is screened.
#[derive(Clone, Copy)]
pub(crate) struct Screening<'a> {
    /// Candidates for each place.
    pub(crate) candidates: usize,
    axes: &'a Normalisation,
}

impl<'a> Screening<'a> {
    /// `None` where nothing is screened: geometry tells nothing, the axes are not known yet, or most designs fail before
    /// their structure is analysed, so that one which does not is too rare to be passed over.
    pub(crate) fn of<P: Problem>(problem: &P, search: &SearchParams, state: &'a State) -> Option<Self> {
        let common = 2 * state.structural() >= state.rows.len() as u64;
        let axes = state.normalisation()?;
        let screened = search.screen > 1 && common && problem.has_preview();
        screened.then_some(Self { candidates: search.screen, axes })
    }

    /// The places of the previews, the most promising first: by violation, then by the weighted Chebyshev norm of the
    /// objectives that are known. The weights are drawn anew each time, evenly from the simplex, so that no part of the
    /// front is preferred.
    pub(crate) fn order(&self, previews: &[Preview], rng: &mut Rng) -> Vec<usize> {
        let weights: Vec<f64> = self.axes.ideal.iter().map(|_| -libm::log(1.0 - unit(rng))).collect();
        let norm = |preview: &Preview| {
            let known = preview.objectives.iter().enumerate().filter_map(|(m, value)| {
                value.map(|f| {
                    weights[m] * (f - self.axes.ideal[m]) / (self.axes.reference[m] - self.axes.ideal[m])
                })
            });
            known.fold(f64::NEG_INFINITY, f64::max)
        };
        let scores: Vec<_> = previews.iter().map(|preview| (preview.violation, norm(preview))).collect();
        let mut order: Vec<usize> = (0..previews.len()).collect();
        order.sort_by(|&a, &b| scores[a].0.total_cmp(scores[b].0).then(scores[a].1.total_cmp(&scores[b].1)));
        order
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evolve::Violation;
    use crate::random::stream;

    fn preview(stage: u8, objectives: &[f64]) -> Preview {
        let known = objectives.iter().map(|&f| Some(f));
        Preview {
            violation: Violation::new(stage, 1.0),
            objectives: std::iter::once(None).chain(known).collect(),
        }
    }

    #[test]
    fn violations_first_then_what_is_known_in_all_directions() {
        let axes = Normalisation { ideal: vec![0.0, 10.0, 0.0], reference: vec![1.0, 20.0, 1.0] };
        let screening = Screening { candidates: 4, axes: &axes };
        let previews = [
            preview(1, &[10.0, 0.0]),
            preview(0, &[19.0, 0.1]),
            preview(0, &[11.0, 0.9]),
            preview(0, &[20.0, 1.0]),
        ];
        let mut first = [0; 4];
        for k in 0..1000 {
            let order = screening.order(&previews, &mut stream(3, k, 0));
            assert_eq!(order[3], 0, "the one that fails is last");
            assert!(order[2] == 3, "and the dominated one before it");
            first[order[0]] += 1;
        }
        assert!(first[1] > 400 && first[2] > 400, "{first:?}");
    }
}
