//! The least section height that meets every requirement.
//!
//! A bracket (too low, high enough) is narrowed as in bisection, and ends as narrow; but it is cut where the
//! requirements are expected to be just met. The share of a limit that is used goes nearly with a power of the height,
//! so that is where the straight line, then the parabola, through the last points meets 1 on logarithmic paper.
//!
//! Cheap requirements come first: the height is found by statics; buckling factor and stability, which cost as much
//! again, are asked of the height found, where both nearly always hold. Only if they do not is the search repeated
//! above it with all requirements.

use super::AnalysisError;
use super::evaluate::Evaluator;
use crate::structure::params::{HeightParams, StructureParams};

/// Width of the bracket at which the search ends, m: a tenth of a millimetre.
pub const RESOLUTION: f64 = 1e-4;
/// The power of the height that a first guess supposes.
const POWER: f64 = 1.0;
/// Every so many cuts one halves the bracket, so that it cannot crawl.
const HALVE_EVERY: usize = 5;
/// While no height is known to be too low, a cut goes no further down than to this share of the last: what is far too
/// low tells nothing, and takes long to be found unstable.
const BOLDEST: f64 = 0.6;

/// The height to report: the fixed one, or the least of the range that meets all requirements, or the largest if
/// none does.
///
/// # Errors
/// What keeps the largest height from being analysed; at smaller ones it counts as a requirement not met.
pub fn height(evaluator: &mut Evaluator<'_>, params: &StructureParams) -> Result<f64, AnalysisError> {
    let (min, max) = match params.height {
        HeightParams::Fixed { fixed_m } => return Ok(fixed_m),
        HeightParams::Sized { min_m, max_m, .. } => (min_m, max_m),
    };
    evaluator.statics(max)?;
    let used = evaluator.used()?;
    if used > 1.0 {
        return Ok(max);
    }
    let by_statics = least(min, Point::new(max, used), |height| used_at(evaluator, height, false))?;
    let used = used_at(evaluator, by_statics, true)?;
    if used <= 1.0 {
        return Ok(by_statics);
    }
    let used_by_max = used_at(evaluator, max, true)?;
    if used_by_max > 1.0 || by_statics >= max {
        return Ok(max);
    }
    let mut bracket = Bracket::new(by_statics, Point::new(max, used_by_max));
    bracket.add(Point::new(by_statics, used));
    bracket.narrow(|height| used_at(evaluator, height, true))
}

/// The share of the limits used at a height; infinite where the structure does not stand.
fn used_at(evaluator: &mut Evaluator<'_>, height: f64, all: bool) -> Result<f64, AnalysisError> {
    let mut used = || {
        evaluator.statics(height)?;
        let by_statics = evaluator.used()?;
        if all && by_statics <= 1.0 {
            Ok(by_statics.max(evaluator.used_by_buckling()?))
        } else {
            Ok(by_statics)
        }
    };
    match used() {
        Err(
            AnalysisError::Unstable { .. } | AnalysisError::Mechanism(_) | AnalysisError::NoConvergence(_),
        ) => Ok(f64::INFINITY),
        other => other,
    }
}

/// The least height from `min` on that uses at most all of the limits, within [`RESOLUTION`]; `high` does.
fn least(
    min: f64,
    high: Point,
    used: impl FnMut(f64) -> Result<f64, AnalysisError>,
) -> Result<f64, AnalysisError> {
    Bracket::new(min, high).narrow(used)
}

/// A height and the share of the limits used there.
#[derive(Clone, Copy, Debug)]
struct Point {
    height: f64,
    used: f64,
}

impl Point {
    fn new(height: f64, used: f64) -> Self {
        Self { height, used }
    }

    fn is_drawn(self) -> bool {
        self.used > 0.0 && self.used.is_finite()
    }
}

/// What is known of where the least height is.
#[derive(Debug)]
struct Bracket {
    /// Nothing below is asked.
    min: f64,
    /// The highest that is too low, once one is known.
    low: Option<Point>,
    /// The lowest that is high enough.
    high: Point,
    /// The last points that can be drawn on logarithmic paper, the latest first.
    last: [Option<Point>; 3],
}

impl Bracket {
    fn new(min: f64, high: Point) -> Self {
        Self { min, low: None, high, last: [Some(high).filter(|p| p.is_drawn()), None, None] }
    }

    fn add(&mut self, point: Point) {
        if point.used > 1.0 {
            self.low = Some(point);
        } else {
            self.high = point;
        }
        if point.is_drawn() {
            self.last = [Some(point), self.last[0], self.last[1]];
        }
    }

    fn is_narrow(&self) -> bool {
        match self.low {
            Some(low) => self.high.height - low.height <= RESOLUTION,
            None => self.high.height <= self.min,
        }
    }

    fn narrow(
        mut self,
        mut used: impl FnMut(f64) -> Result<f64, AnalysisError>,
    ) -> Result<f64, AnalysisError> {
        for cut in 1.. {
            if self.is_narrow() {
                break;
            }
            let height = self.next_cut(cut);
            self.add(Point::new(height, used(height)?));
        }
        Ok(self.high.height)
    }

    /// Where to cut the bracket next.
    fn next_cut(&self, cut: usize) -> f64 {
        let bottom = self.low.map_or(self.min, |low| low.height);
        let halved = 0.5 * (bottom + self.high.height);
        let expected = if cut.is_multiple_of(HALVE_EVERY) { None } else { self.expected() };
        let Some(low) = self.low else {
            let high = self.high.height;
            let height = expected.unwrap_or(halved).max(BOLDEST * high).min(high - 0.5 * RESOLUTION);
            // `min` itself is worth asking only if the guess comes near it.
            return if height <= self.min + RESOLUTION { self.min } else { height };
        };
        let Some(expected) = expected else { return halved };
        // Where both ends come to lie within the resolution: first the low end, a little below the expected root,
        // then the high end, so that the last height analysed is the one that is reported.
        let margin = 0.3 * RESOLUTION;
        let height = if expected - low.height < 0.6 * RESOLUTION {
            low.height + 0.95 * RESOLUTION
        } else if self.high.height - expected < 0.6 * RESOLUTION {
            self.high.height - 0.95 * RESOLUTION
        } else {
            expected - margin
        };
        height.clamp(low.height + 0.25 * margin, self.high.height - 0.25 * margin)
    }

    /// Where the limits are expected to be just used; none if nothing can be expected, or not inside the bracket.
    fn expected(&self) -> Option<f64> {
        let drawn = |point: Option<Point>| point.map(|p| (p.height.ln(), p.used.ln()));
        let [latest, before, third] = self.last.map(drawn);
        let (x1, y1) = latest?;
        let Some((x2, y2)) = before else { return self.inside(x1 + y1 / POWER) };
        let line = |(xa, ya): (f64, f64), (xb, yb): (f64, f64)| xa - ya * (xb - xa) / (yb - ya);
        let straight = line((x1, y1), (x2, y2));
        // Neville's scheme for x(y) at y = 0: the parabola through three points.
        let curved = third.map(|(x3, y3)| {
            let (a, b) = (straight, line((x2, y2), (x3, y3)));
            (b * y1 - a * y3) / (y1 - y3)
        });
        curved.and_then(|x| self.inside(x)).or_else(|| self.inside(straight))
    }

    fn inside(&self, logarithm: f64) -> Option<f64> {
        let height = logarithm.exp();
        let above = self.low.is_none_or(|low| height > low.height);
        (height.is_finite() && above && height < self.high.height).then_some(height)
    }
}
