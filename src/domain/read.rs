//! From a loop of the config to a curve and what tells its corners.

use super::curve::{Curve, signed_area};
use super::error::DomainError;
use super::kinks;
use super::params::{CornerRule, Corners, LoopParams};
use crate::io::{Input, Inputs, LengthUnit, obj};

/// What tells the corners of a curve.
pub(super) enum Marked {
    /// Their parameters.
    At(Vec<f64>),
    /// That it turns there by more than this angle within a short way, rad.
    Turning(f64),
}

impl Marked {
    /// Parameters of the corners; `way` is how short a way is, m.
    pub(super) fn corners(self, curve: &Curve, way: f64) -> Vec<f64> {
        match (self, curve) {
            (Self::At(corners), _) => corners,
            (Self::Turning(angle), Curve::Polyline { points }) => kinks::find(points, angle, way),
            (Self::Turning(_), Curve::Ellipse { .. }) => Vec::new(),
        }
    }
}

/// The curve of a loop, counter-clockwise, and what tells its corners.
pub(super) fn curve(
    number: usize,
    given: &LoopParams,
    inputs: &Inputs,
) -> Result<(Curve, Marked), DomainError> {
    match given {
        LoopParams::Polyline { points_m, corners, corner_angle_deg } => {
            let points = points_m
                .iter()
                .enumerate()
                .map(|(i, p)| point(number, p, || format!("points_m[{i}]")))
                .collect::<Result<Vec<_>, _>>()?;
            polyline(number, points, corners, *corner_angle_deg)
        }
        LoopParams::Circle { center_m, radius_m } => {
            let center = point(number, center_m, || "center_m".to_owned())?;
            let radius = positive(number, "radius_m", *radius_m)?;
            Ok((Curve::Ellipse { center, axes: [radius; 2], turn: [1.0, 0.0] }, Marked::At(Vec::new())))
        }
        LoopParams::Ellipse { center_m, semi_axes_m, rotation_deg } => {
            let center = point(number, center_m, || "center_m".to_owned())?;
            let axes = [
                positive(number, "semi_axes_m", semi_axes_m[0])?,
                positive(number, "semi_axes_m", semi_axes_m[1])?,
            ];
            let angle = finite(number, || "rotation_deg".to_owned(), *rotation_deg)?.to_radians();
            Ok((
                Curve::Ellipse { center, axes, turn: [libm::cos(angle), libm::sin(angle)] },
                Marked::At(Vec::new()),
            ))
        }
        LoopParams::Obj { file, unit, polyline: index, corners, corner_angle_deg } => {
            let read = inputs.get(file).map_err(|error| DomainError::File { loop_number: number, error })?;
            let points = obj_points(number, read, *unit, *index)?;
            polyline(number, points, corners, *corner_angle_deg)
        }
    }
}

fn finite(loop_number: usize, what: impl Fn() -> String, value: f64) -> Result<f64, DomainError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(DomainError::NotFinite { loop_number, what: what(), value })
    }
}

fn positive(loop_number: usize, key: &'static str, value: f64) -> Result<f64, DomainError> {
    finite(loop_number, || key.to_owned(), value)?;
    if value > 0.0 { Ok(value) } else { Err(DomainError::NotPositive { loop_number, key, value }) }
}

/// `[x, y]` or `[x, y, z]` as a point; z is 0 where not given.
fn point(loop_number: usize, given: &[f64], what: impl Fn() -> String) -> Result<[f64; 3], DomainError> {
    if given.len() != 2 && given.len() != 3 {
        return Err(DomainError::Coordinates { loop_number, what: what(), found: given.len() });
    }
    let mut position = [0.0; 3];
    for (k, (value, &number)) in position.iter_mut().zip(given).enumerate() {
        *value = finite(loop_number, || format!("{}[{k}]", what()), number)?;
    }
    Ok(position)
}

/// The points of a closed polyline of an OBJ file. It is closed when it ends in its first vertex, or at the place of it:
/// exporters write that vertex twice.
fn obj_points(
    loop_number: usize,
    input: Input<'_>,
    unit: LengthUnit,
    index: usize,
) -> Result<Vec<[f64; 3]>, DomainError> {
    let obj = obj::read(input, unit).map_err(|error| DomainError::File { loop_number, error })?;
    let name = || input.file.display().to_string();
    let Some(polyline) = obj.polylines.get(index) else {
        let found = obj.polylines.len();
        return Err(DomainError::NoSuchPolyline { loop_number, file: name(), polyline: index, found });
    };
    let mut points: Vec<_> = polyline.iter().map(|&v| obj.vertices[v as usize]).collect();
    let (first, last) = (points[0], points[points.len() - 1]);
    let reach = points.iter().flat_map(|p| (0..3).map(|k| (p[k] - first[k]).abs())).fold(0.0, f64::max);
    if (0..3).any(|k| (first[k] - last[k]).abs() > 1e-9 * reach) {
        return Err(DomainError::OpenPolyline { loop_number, file: name(), line: obj.polyline_lines[index] });
    }
    points.pop();
    Ok(points)
}

/// A polyline from its points, turned counter-clockwise.
fn polyline(
    loop_number: usize,
    mut points: Vec<[f64; 3]>,
    corners: &Corners,
    angle_deg: f64,
) -> Result<(Curve, Marked), DomainError> {
    let count = points.len();
    if count < 3 {
        return Err(DomainError::TooFewPoints { loop_number, found: count });
    }
    if !(angle_deg > 0.0 && angle_deg < 180.0) {
        return Err(DomainError::CornerAngle { loop_number, value: angle_deg });
    }
    for first in 0..count {
        let second = (first + 1) % count;
        let ([x, y, _], [u, v, _]) = (points[first], points[second]);
        if (x, y) == (u, v) {
            return Err(DomainError::ZeroEdge { loop_number, first, second, x, y });
        }
    }
    super::check::simple(loop_number, &points)?;
    let is_clockwise = signed_area(&points) < 0.0;
    if is_clockwise {
        // The first point stays the first.
        points[1..].reverse();
    }
    let chosen = match corners {
        Corners::Rule(CornerRule::Auto) => {
            return Ok((Curve::Polyline { points }, Marked::Turning(angle_deg.to_radians())));
        }
        Corners::Rule(CornerRule::All) => (0..count).collect(),
        Corners::Indices(given) => checked_corners(loop_number, given, count)?,
    };
    let turned = |i: usize| if is_clockwise { (count - i) % count } else { i };
    let corners = chosen.into_iter().map(|i| turned(i) as f64).collect();
    Ok((Curve::Polyline { points }, Marked::At(corners)))
}

fn checked_corners(loop_number: usize, given: &[usize], count: usize) -> Result<Vec<usize>, DomainError> {
    let mut seen = vec![false; count];
    for &corner in given {
        let Some(slot) = seen.get_mut(corner) else {
            return Err(DomainError::NoSuchCorner { loop_number, corner, last: count - 1 });
        };
        if std::mem::replace(slot, true) {
            return Err(DomainError::CornerTwice { loop_number, corner });
        }
    }
    Ok(given.to_vec())
}
