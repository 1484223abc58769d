//! Area of the surface within the boundary (docs/reference/geometry.md §1.2): what target lengths come from.

use super::curve::Curve;
use crate::surface::{Surface, SurfaceKind};

/// Four-point Gauss rules across all bands together, and along each part of a scan line. Always as many, however long the part: so
/// that a rounding error in a length cannot change the rule, and a turned or mirrored domain has the same points.
const RULES: [usize; 2] = [40, 12];

/// The least across one band.
const LEAST_RULES: usize = 3;

/// Polylines with more points than this together do not part the domain into bands at each of them: they are drawn curves.
const MOST_BANDS: usize = 24;

/// Slopes count up to this: 1/|n_z| is without bound where the surface stands upright, as at the rim of a half sphere.
const STEEPEST: f64 = 1000.0;

/// Area of the surface above the region of area `plan_area` between the curves, the first of which is the outer one, m². On a
/// free surface, which is not there yet, `plan_area` itself.
///
/// It is `plan_area` × the mean of 1/|n_z|, over scan lines along x and along y: so that a domain turned by 90° has the
/// same area, and a plane has `plan_area` to the last bit. (Scanned along one axis, a surface with ridges would not.)
pub(super) fn on_surface(curves: &[Curve], plan_area: f64, surface: &dyn Surface) -> f64 {
    if surface.kind() == SurfaceKind::Free {
        return plan_area;
    }
    let mut mean = Mean::default();
    let mut means = [0, 1].map(|axis| {
        let mut along = Mean::default();
        scan(curves, surface, axis, &mut along);
        along
    });
    means.sort_by(|a, b| a.sum.total_cmp(&b.sum));
    for along in means {
        mean.add(along.sum, along.weight);
    }
    if mean.weight > 0.0 { plan_area * (mean.sum / mean.weight) } else { plan_area }
}

/// A weighted mean while it grows.
#[derive(Default)]
struct Mean {
    sum: f64,
    weight: f64,
}

impl Mean {
    fn add(&mut self, sum: f64, weight: f64) {
        self.sum += sum;
        self.weight += weight;
    }
}

/// Adds 1/|n_z| on all scan lines along one axis (0: x, 1: y).
fn scan(curves: &[Curve], surface: &dyn Surface, axis: usize, mean: &mut Mean) {
    let bands = bands(curves, 1 - axis);
    let rules = (RULES[0] / (bands.len() - 1).max(1)).max(LEAST_RULES);
    for (level, breadth) in bands.windows(2).flat_map(|b| stations(b[0], b[1], rules)) {
        let mut crossings: Vec<f64> = curves.iter().flat_map(|c| c.crossings(axis, level)).collect();
        crossings.sort_by(f64::total_cmp);
        for part in crossings.chunks_exact(2) {
            for (at, width) in stations(part[0], part[1], RULES[1]) {
                let (x, y) = if axis == 0 { (at, level) } else { (level, at) };
                if let Some(slope) = slope(surface, x, y) {
                    mean.add(breadth * width * slope, breadth * width);
                }
            }
        }
    }
}

/// Where scan lines begin or cease to cross a curve, in the coordinate `axis`: between two of these the parts of a line vary
/// smoothly from one line to the next.
fn bands(curves: &[Curve], axis: usize) -> Vec<f64> {
    let points = || curves.iter().flat_map(Curve::points);
    let mut levels: Vec<f64> = curves.iter().flat_map(|c| c.bounds().map(|p| p[axis])).collect();
    if points().count() <= MOST_BANDS {
        levels.extend(points().map(|p| p[axis]));
    }
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    levels
}

/// Positions and weights of an integral from `low` to `high`: Gauss rules in u, with the place 3u² − 2u³ of the way, so that a
/// root at an end, such as that of an ellipse's chord or of a half sphere's slope, does no harm.
fn stations(low: f64, high: f64, rules: usize) -> impl Iterator<Item = (f64, f64)> {
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    (0..rules).flat_map(move |k| {
        GAUSS.into_iter().map(move |(node, weight)| {
            // From −1 to 1, so that both halves of a symmetric domain have the same points.
            let v = (2.0 * k as f64 + 1.0 + node) / rules as f64 - 1.0;
            (middle + half * v * (1.5 - 0.5 * v * v), half * weight / rules as f64 * 1.5 * (1.0 - v * v))
        })
    })
}

/// 1/|n_z| above (x, y); `None` where the surface does not reach.
fn slope(surface: &dyn Surface, x: f64, y: f64) -> Option<f64> {
    let z = match surface.kind() {
        SurfaceKind::Height => 0.0,
        SurfaceKind::Closest | SurfaceKind::Free => surface.height(x, y)?,
    };
    let slope = 1.0 / surface.normal([x, y, z])[2].abs();
    (!slope.is_nan()).then(|| slope.clamp(1.0, STEEPEST))
}

/// Gauss–Legendre on −1..1 with four points: position and weight.
const GAUSS: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
];
