//! Which design of a front suits best: the achievement of Wierzbicki (1980), doi:10.1007/978-3-642-48782-8_32.

/// What is wanted of the objectives. All slices have one number per objective.
#[derive(Clone, Copy, Debug)]
pub struct Preference<'a> {
    /// What would do, and is measured from.
    pub aspiration: &'a [f64],
    /// How much each objective matters.
    pub weights: &'a [f64],
    /// Lengths of the axes, in which objectives are compared; all more than 0.
    pub lengths: &'a [f64],
}

/// How much the sum counts beside the largest term, so that of two designs with the same largest one the dominating wins.
const SUM: f64 = 1e-3;

impl Preference<'_> {
    /// The largest weighted distance beyond the aspiration (below 0 where all is better), and a little of all distances: less is better.
    pub fn achievement(&self, objectives: &[f64]) -> f64 {
        let axes = self.aspiration.iter().zip(self.weights).zip(self.lengths);
        let terms = || objectives.iter().zip(axes.clone()).map(|(f, ((a, w), l))| w * (f - a) / l);
        terms().fold(f64::NEG_INFINITY, f64::max) + SUM * terms().sum::<f64>()
    }

    /// The place of each point, from 1, the best first; of equal ones the earlier first.
    pub fn places(&self, points: &[&[f64]]) -> Vec<usize> {
        let mut order: Vec<usize> = (0..points.len()).collect();
        let achieved: Vec<f64> = points.iter().map(|point| self.achievement(point)).collect();
        order.sort_by(|&a, &b| achieved[a].total_cmp(&achieved[b]).then(a.cmp(&b)));
        let mut places = vec![0; points.len()];
        for (place, i) in order.into_iter().enumerate() {
            places[i] = place + 1;
        }
        places
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_and_aspirations_order_a_front() {
        let points = [[0.0, 10.0], [1.0, 1.0], [10.0, 0.0]];
        let points: Vec<&[f64]> = points.iter().map(|p| p.as_slice()).collect();
        let places = |aspiration: [f64; 2], weights: [f64; 2]| {
            let preference =
                Preference { aspiration: &aspiration, weights: &weights, lengths: &[10.0, 10.0] };
            preference.places(&points)
        };
        assert_eq!(places([0.0, 0.0], [1.0, 1.0]), [2, 1, 3]);
        assert_eq!(places([0.0, 0.0], [1.0, 0.01])[0], 1, "the first objective is nearly all that matters");
        assert_eq!(places([9.0, -1.0], [1.0, 1.0]), [3, 2, 1], "the second is to be as good as can be");
        let dominating = Preference { aspiration: &[0.0; 2], weights: &[1.0; 2], lengths: &[1.0; 2] };
        assert_eq!(dominating.places(&[&[2.0, 1.0], &[2.0, 0.0]]), [2, 1]);
    }
}
