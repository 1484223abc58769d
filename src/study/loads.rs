//! Whether the loads of a config have the symmetries that make two designs the same.

use super::StudyError;
use crate::domain::{Domain, Symmetry};
use crate::structure::StructureParams;
use crate::structure::params::{Factor, FactorParams, LoadParams};

/// A factor is looked at in this many points along and across the domain.
const POINTS: usize = 24;
/// Heights, m, and normals for which it is.
const HEIGHTS: [f64; 3] = [0.0, 1.7, 11.3];
const NORMALS: [[f64; 3]; 3] = [[0.0, 0.0, 1.0], [0.36, 0.48, 0.8], [-0.64, 0.48, 0.6]];
/// Points may differ by this share of the domain's size from the image of another.
const PLACE: f64 = 1e-6;
/// Values may differ by this share of the larger one.
const TOLERANCE: f64 = 1e-6;

/// Refuses a symmetry that does not carry every load into itself.
pub fn check_symmetry(
    domain: &Domain,
    kind: Symmetry,
    structure: &StructureParams,
) -> Result<(), StudyError> {
    for (name, load) in &structure.loads {
        let refused = |key: &str, reason: String| StudyError::LoadImage {
            key: format!("structure.loads.{name}.{key}"),
            symmetry: kind.name(),
            reason,
        };
        // What cannot be read is told by the check of the config.
        if let Some(Ok(factor)) = load.factor().map(FactorParams::read)
            && let Some(reason) = differs(domain, kind, &factor)
        {
            return Err(refused("factor", reason));
        }
        let LoadParams::Point { points_m, force_n: [fx, fy, _] } = load else { continue };
        let [sx, sy] = kind.signs();
        if *fx != sx * fx || *fy != sy * fy {
            return Err(refused("force_n", "its image is another force".into()));
        }
        let alone = points_m.iter().find(|point| {
            let image = domain.plan_image(**point, kind);
            !points_m.iter().any(|other| is_at(domain, *other, image))
        });
        if let Some([x, y]) = alone {
            return Err(refused("points_m", format!("no point is the image of ({x}, {y})")));
        }
    }
    Ok(())
}

/// Where a factor is another one at the image, in words.
fn differs(domain: &Domain, kind: Symmetry, factor: &Factor) -> Option<String> {
    let [low, high] = domain.bounds();
    let [sx, sy] = kind.signs();
    // Not the middles of the strips, where an image may be the point itself.
    let along =
        |axis: usize, i: usize| low[axis] + (high[axis] - low[axis]) * (i as f64 + 0.37) / POINTS as f64;
    let points = (0..POINTS * POINTS).map(|k| [along(0, k % POINTS), along(1, k / POINTS)]);
    points.filter(|point| domain.contains(*point)).find_map(|[x, y]| {
        let [u, v] = domain.plan_image([x, y], kind);
        let values =
            HEIGHTS.iter().flat_map(|z| NORMALS.iter().map(move |n| (*z, *n))).map(|(z, [nx, ny, nz])| {
                (factor.at([x, y, z], [nx, ny, nz]), factor.at([u, v, z], [sx * nx, sy * ny, nz]))
            });
        let mut values =
            values.filter(|(here, there)| (here - there).abs() > TOLERANCE * here.abs().max(there.abs()));
        let (here, there) = values.next()?;
        Some(format!("it is {here} at ({x:.3}, {y:.3}) and {there} at its image, ({u:.3}, {v:.3})"))
    })
}

/// Whether a point is at a place, but for rounding.
pub fn is_at(domain: &Domain, point: [f64; 2], place: [f64; 2]) -> bool {
    (point[0] - place[0]).hypot(point[1] - place[1]) <= PLACE * domain.size()
}
