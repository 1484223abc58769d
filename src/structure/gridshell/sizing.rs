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
/// After so many cuts the bracket must be half as wide; else the next one halves it, so that it cannot crawl.
const HALF_BY: usize = 5;
/// While no height is known to be too low, a cut goes no further down than to this share of the last: what is far too
/// low tells nothing, and takes long to be found unstable.
const BOLDEST: f64 = 0.5;
/// How exact the displacements are at first, and how near to its limit a share then is known better.
const COARSE: f64 = 1e-3;
const DOUBTFUL: f64 = 0.02;

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
    let used = Point::new(max, evaluator.used()?);
    if used.most() > 1.0 {
        return Ok(max);
    }
    let by_statics = Bracket::new(min, used).narrow(|height| used_at(evaluator, height, false))?;
    let used = used_at(evaluator, by_statics, true)?;
    if used.most() <= 1.0 {
        return Ok(by_statics);
    }
    let used_by_max = used_at(evaluator, max, true)?;
    if used_by_max.most() > 1.0 || by_statics >= max {
        return Ok(max);
    }
    let mut bracket = Bracket::new(by_statics, used_by_max);
    bracket.add(used);
    bracket.narrow(|height| used_at(evaluator, height, true))
}

/// The shares of the limits used at a height; none is known where the structure does not stand.
fn used_at(evaluator: &mut Evaluator<'_>, height: f64, all: bool) -> Result<Point, AnalysisError> {
    match shares_at(evaluator, height, all) {
        Ok(Some(shares)) => Ok(Point::new(height, shares)),
        Ok(None)
        | Err(
            AnalysisError::Mechanism(_) | AnalysisError::NoConvergence(_) | AnalysisError::IllConditioned,
        ) => Ok(Point { height, shares: None }),
        Err(other) => Err(other),
    }
}

/// What is far from the limits need not be known well.
fn shares_at(
    evaluator: &mut Evaluator<'_>,
    height: f64,
    all: bool,
) -> Result<Option<Vec<f64>>, AnalysisError> {
    let tolerance = evaluator.tolerance();
    if tolerance < COARSE {
        if evaluator.statics_within(height, COARSE)?.is_some() {
            return Ok(None);
        }
        let shares = evaluator.used()?;
        let over = largest(&shares) - 1.0;
        if over > DOUBTFUL || (!all && over < -DOUBTFUL) {
            return Ok(Some(shares));
        }
    }
    if evaluator.statics_within(height, tolerance)?.is_some() {
        return Ok(None);
    }
    let mut shares = evaluator.used()?;
    if all && largest(&shares) <= 1.0 {
        let Some(by_buckling) = evaluator.used_by_buckling()? else { return Ok(None) };
        shares.extend(by_buckling);
    }
    Ok(Some(shares))
}

fn largest(shares: &[f64]) -> f64 {
    shares.iter().fold(0.0, |a, &share| if share > a || share.is_nan() { share } else { a })
}

/// A height and the shares of the limits used there.
#[derive(Clone, Debug)]
struct Point {
    height: f64,
    /// Those of statics, then, if they were asked for, those of buckling; none if the structure does not stand.
    shares: Option<Vec<f64>>,
}

impl Point {
    fn new(height: f64, shares: Vec<f64>) -> Self {
        Self { height, shares: Some(shares) }
    }

    /// The largest share; infinite where the structure does not stand.
    fn most(&self) -> f64 {
        self.shares.as_ref().map_or(f64::INFINITY, |shares| largest(shares))
    }

    /// Height and share of the limit of requirement `k` on logarithmic paper, where it can be drawn.
    fn drawn(&self, k: usize) -> Option<(f64, f64)> {
        let share = *self.shares.as_ref()?.get(k)?;
        (share > 0.0 && share.is_finite()).then(|| (self.height.ln(), share.ln()))
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
    /// The last points, the latest first.
    last: Vec<Point>,
}

impl Bracket {
    fn new(min: f64, high: Point) -> Self {
        Self { min, low: None, last: vec![high.clone()], high }
    }

    fn add(&mut self, point: Point) {
        if point.shares.is_some() {
            self.last.insert(0, point.clone());
            self.last.truncate(3);
        }
        // Not `>`: what is not a number is no answer.
        if point.most() <= 1.0 {
            self.high = point;
        } else {
            self.low = Some(point);
        }
    }

    fn width(&self) -> f64 {
        self.high.height - self.low.as_ref().map_or(self.min, |low| low.height)
    }

    fn is_narrow(&self) -> bool {
        match &self.low {
            Some(low) => self.high.height - low.height <= RESOLUTION,
            None => self.high.height <= self.min,
        }
    }

    fn narrow(
        mut self,
        mut used: impl FnMut(f64) -> Result<Point, AnalysisError>,
    ) -> Result<f64, AnalysisError> {
        let mut wide = self.width();
        for cut in 1.. {
            if self.is_narrow() {
                break;
            }
            let crawls = cut % HALF_BY == 0 && self.width() > 0.5 * wide;
            if cut % HALF_BY == 0 {
                wide = self.width();
            }
            let height = self.next_cut(crawls);
            self.add(used(height)?);
        }
        Ok(self.high.height)
    }

    /// Where to cut the bracket next.
    fn next_cut(&self, crawls: bool) -> f64 {
        let halved = self.high.height - 0.5 * self.width();
        let expected = if crawls { None } else { self.expected() };
        let Some(low) = &self.low else {
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

    /// Where the limits are expected to be just used; none if nothing can be expected, or not inside the bracket. Each
    /// requirement has its own line: their largest has a kink where another one begins to govern.
    fn expected(&self) -> Option<f64> {
        let requirements = self.last.iter().filter_map(|point| point.shares.as_ref()).map(Vec::len).max()?;
        let mut expected: Option<f64> = None;
        for k in 0..requirements {
            let points: Vec<(f64, f64)> = self.last.iter().filter_map(|point| point.drawn(k)).collect();
            let Some(root) = self.root(&points) else { continue };
            // It is met by the high end, whatever its line says.
            let root = root.min(self.high.height - 0.5 * RESOLUTION);
            expected = Some(expected.map_or(root, |known| known.max(root)));
        }
        expected.filter(|&height| self.is_inside(height))
    }

    /// Where the curve through the points, the latest first, meets 1: the parabola if it does so inside the bracket,
    /// else the straight line. None if it does not fall with the height.
    fn root(&self, points: &[(f64, f64)]) -> Option<f64> {
        let line = |(xa, ya): (f64, f64), (xb, yb): (f64, f64)| xa - ya * (xb - xa) / (yb - ya);
        let straight = match *points {
            [] => return None,
            [(x, y)] => x + y / POWER,
            [a, b, ..] if (b.1 - a.1) * (b.0 - a.0) < 0.0 => line(a, b),
            _ => return None,
        };
        if let [a, b, c] = *points {
            // Neville's scheme for x(y) at y = 0.
            let curved = ((line(b, c) * a.1 - straight * c.1) / (a.1 - c.1)).exp();
            if self.is_inside(curved) {
                return Some(curved);
            }
        }
        Some(straight.exp()).filter(|height| height.is_finite())
    }

    fn is_inside(&self, height: f64) -> bool {
        let above = self.low.as_ref().is_none_or(|low| height > low.height);
        height.is_finite() && above && height < self.high.height
    }
}
