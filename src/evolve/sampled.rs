//! Hypervolume over a fixed quasi-random sample, for any number of objectives.

/// Number of sample points, 2¹⁷.
pub const SAMPLES: usize = 1 << 17;

/// Lower corner of the sampled box along every normalised axis; its upper corner is 1.
///
/// A little below the ideal, because the ideal may be a quantile of random designs, which a search goes beyond;
/// what lies still farther below adds nothing more.
pub const LOWER_CORNER: f64 = -0.25;

/// The share of a fixed sample that any offered point dominates, times the volume of the sampled box.
///
/// The sample is the additive recurrence of the generalised golden ratio (Roberts 2018; R_d sequence) in the box
/// from [`LOWER_CORNER`] to 1 on every axis. A sample point once dominated stays so: the value never falls, and it
/// does not depend on the order of the offers.
#[derive(Clone, Debug)]
pub struct SampledHypervolume {
    dimensions: usize,
    points: Vec<f64>,
    dominated: Vec<bool>,
    count: usize,
}

impl SampledHypervolume {
    /// The sample for `dimensions` ≥ 1 objectives, nothing dominated yet.
    pub fn new(dimensions: usize) -> Self {
        let place = |u: f64| LOWER_CORNER + (1.0 - LOWER_CORNER) * u;
        let points = unit_sample(dimensions, SAMPLES).into_iter().map(place).collect();
        Self { dimensions, points, dominated: vec![false; SAMPLES], count: 0 }
    }

    /// Adds a point in normalised coordinates, to be minimised. What is not finite is ignored.
    pub fn offer(&mut self, point: &[f64]) {
        debug_assert_eq!(point.len(), self.dimensions);
        if point.iter().any(|x| !x.is_finite() || *x >= 1.0) {
            return;
        }
        for (sample, dominated) in self.points.chunks_exact(self.dimensions).zip(&mut self.dominated) {
            if !*dominated && point.iter().zip(sample).all(|(p, s)| p <= s) {
                *dominated = true;
                self.count += 1;
            }
        }
    }

    /// The dominated volume in units of the normalised box: 1 is all between ideal and reference.
    pub fn value(&self) -> f64 {
        let side = 1.0 - LOWER_CORNER;
        let volume = (0..self.dimensions).fold(1.0, |v, _| v * side);
        volume * (self.count as f64 / SAMPLES as f64)
    }
}

/// The first `count` points of the R_d sequence in the unit cube, one after another.
pub(super) fn unit_sample(dimensions: usize, count: usize) -> Vec<f64> {
    let steps = steps(dimensions);
    let point = |k: usize| steps.iter().map(move |step| (0.5 + k as f64 * step).fract());
    (1..=count).flat_map(point).collect()
}

/// Steps of the R_d sequence: powers of 1/φ, where φ is the real root of x^(d+1) = x + 1.
fn steps(dimensions: usize) -> Vec<f64> {
    let power = |x: f64, n: usize| (0..n).fold(1.0, |p, _| p * x);
    let mut phi = 2.0;
    // Newton's iteration converges to the last bit well within this.
    for _ in 0..60 {
        let slope = (dimensions + 1) as f64 * power(phi, dimensions) - 1.0;
        phi -= (power(phi, dimensions + 1) - phi - 1.0) / slope;
    }
    (1..=dimensions).map(|k| power(1.0 / phi, k)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_has_its_volume() {
        for d in [2, 5, 6, 7] {
            let mut sampled = SampledHypervolume::new(d);
            sampled.offer(&vec![0.1; d]);
            let exact = (0..d).fold(1.0, |v, _| v * 0.9);
            assert!((sampled.value() - exact).abs() < 0.01 * exact, "{d}: {} {exact}", sampled.value());
        }
    }

    #[test]
    fn it_never_falls_and_ignores_what_is_not_finite() {
        let mut sampled = SampledHypervolume::new(5);
        sampled.offer(&[f64::NAN, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(sampled.value(), 0.0);
        sampled.offer(&[0.5; 5]);
        let before = sampled.value();
        sampled.offer(&[0.6; 5]);
        assert_eq!(sampled.value(), before);
        sampled.offer(&[0.4, 0.9, 0.4, 0.4, 0.4]);
        assert!(sampled.value() > before);
    }
}
