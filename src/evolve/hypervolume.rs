//! The exact hypervolume, for up to four objectives.

/// The volume dominated by `points` up to `reference`, all minimised.
///
/// `points` in any order, dominated ones allowed; points that are not better than `reference` in every objective add
/// nothing, nor do those that are not finite. Exact up to rounding: staircase in 2D, dimension sweep in 3D, slices
/// of it in 4D (hypervolume by slicing objectives, While et al. 2006), O(n² log n). For one objective it is the
/// length. More than four objectives go through [`super::SampledHypervolume`].
///
/// # Panics
/// If `reference` has no or more than four entries, or a point another number of them.
pub fn hypervolume(points: &[&[f64]], reference: &[f64]) -> f64 {
    let inside: Vec<[f64; 4]> = points.iter().filter_map(|p| depths(p, reference)).collect();
    match reference.len() {
        1 => inside.iter().fold(0.0, |best, p| f64::max(best, p[0])),
        2 => sweep(inside, 2, |front| front.iter().fold(0.0, |best, p| f64::max(best, p[0]))),
        3 => volume_3d(inside),
        4 => sweep(inside, 4, |front| volume_3d(front.to_vec())),
        n => panic!("the exact hypervolume is for 1 to 4 objectives, not {n}"),
    }
}

/// How far a point lies before the reference along each axis (so larger is better); `None` if not before it in all.
fn depths(point: &[f64], reference: &[f64]) -> Option<[f64; 4]> {
    assert_eq!(point.len(), reference.len(), "a point has one entry per objective");
    let mut depth = [0.0; 4];
    for ((d, r), x) in depth.iter_mut().zip(reference).zip(point) {
        *d = r - x;
        // Also false for NaN and, on finite references, for −∞.
        if !(*d > 0.0 && d.is_finite()) {
            return None;
        }
    }
    Some(depth)
}

/// Sweeps the last of `n` axes from the deepest point down, summing slice heights × volume of the points above.
fn sweep(mut points: Vec<[f64; 4]>, n: usize, volume: impl Fn(&[[f64; 4]]) -> f64) -> f64 {
    let axis = n - 1;
    points.sort_by(|a, b| b[axis].total_cmp(&a[axis]));
    let mut total = 0.0;
    for k in 0..points.len() {
        let below = points.get(k + 1).map_or(0.0, |p| p[axis]);
        let height = points[k][axis] - below;
        if height > 0.0 {
            total += height * volume(&points[..=k]);
        }
    }
    total
}

/// 3D by sweeping the third axis over a staircase of the first two, whose area is kept up to date.
fn volume_3d(mut points: Vec<[f64; 4]>) -> f64 {
    points.sort_by(|a, b| b[2].total_cmp(&a[2]));
    // Corners (x, y) of the staircase: x ascending, y descending, mutually non-dominated.
    let mut stairs: Vec<(f64, f64)> = Vec::new();
    let (mut area, mut total) = (0.0, 0.0);
    for k in 0..points.len() {
        area += add_step(&mut stairs, points[k][0], points[k][1]);
        let below = points.get(k + 1).map_or(0.0, |p| p[2]);
        total += area * (points[k][2] - below);
    }
    total
}

/// Adds the rectangle from the origin to `(x, y)` to the staircase; returns the area gained.
fn add_step(stairs: &mut Vec<(f64, f64)>, x: f64, y: f64) -> f64 {
    // Steps at or beyond x; if the first of these is as high, the point is covered.
    let right = stairs.partition_point(|s| s.0 < x);
    if stairs.get(right).is_some_and(|s| s.1 >= y) {
        return 0.0;
    }
    let floor = |k: usize| stairs.get(k).map_or(0.0, |s: &(f64, f64)| s.1);
    // Steps right of x are lower than y. A step exactly at x is covered. To the left, those not higher than y are.
    let end = if stairs.get(right).is_some_and(|s| s.0 == x) { right + 1 } else { right };
    let start = stairs[..right].partition_point(|s| s.1 > y);
    let mut gain = 0.0;
    let mut from = start.checked_sub(1).map_or(0.0, |k| stairs[k].0);
    for (k, step) in stairs.iter().enumerate().take(right).skip(start) {
        gain += (step.0 - from) * (y - floor(k));
        from = step.0;
    }
    gain += (x - from) * (y - floor(right));
    stairs.splice(start..end, [(x, y)]);
    gain
}

#[cfg(test)]
mod tests {
    use super::*;

    fn volume(points: &[&[f64]], n: usize) -> f64 {
        hypervolume(points, &vec![1.0; n])
    }

    #[test]
    fn of_one_point_is_its_box() {
        assert_eq!(volume(&[&[0.25]], 1), 0.75);
        assert_eq!(volume(&[&[0.5, 0.25]], 2), 0.375);
        assert_eq!(volume(&[&[0.5, 0.5, 0.5]], 3), 0.125);
        assert_eq!(volume(&[&[0.5, 0.5, 0.5, 0.5]], 4), 0.0625);
    }

    #[test]
    fn of_two_points_is_their_union() {
        assert_eq!(volume(&[&[0.0, 0.5], &[0.5, 0.0]], 2), 0.75);
        assert_eq!(volume(&[&[0.0, 0.5, 0.5], &[0.5, 0.0, 0.0]], 3), 0.25 + 0.5 - 0.125);
    }

    #[test]
    fn points_beyond_the_reference_or_not_finite_add_nothing() {
        assert_eq!(volume(&[], 3), 0.0);
        assert_eq!(volume(&[&[0.0, 1.0], &[f64::NAN, 0.0], &[0.0, f64::NEG_INFINITY], &[0.5, 0.5]], 2), 0.25);
    }

    #[test]
    fn equal_coordinates_are_counted_once() {
        let p: &[f64] = &[0.5, 0.5, 0.5];
        assert_eq!(volume(&[p, p, &[0.5, 0.5, 0.75], &[0.5, 0.75, 0.5], &[0.75, 0.5, 0.5]], 3), 0.125);
    }
}
