//! Corners that are found (docs/reference/geometry.md §1.1): where a polyline turns within a short way, whether at one kink or at several,
//! as a fillet of a millimetre does that a drawing program made of four.

use std::f64::consts::PI;

/// Angles differ by more than this, rad, in more than their rounding.
const ROUNDING: f64 = 1e-9;

/// Parameters of the corners of a closed polyline, counter-clockwise: where it turns by more than `angle` (rad) within `way` metres
/// in plan, at the middle of the turn. A polyline that turns so all the way round, a hole smaller than its panels, has none.
pub(super) fn find(points: &[[f64; 3]], angle: f64, way: f64) -> Vec<f64> {
    let polyline = Polyline::of(points, way);
    let mut corners: Vec<f64> = [1.0, -1.0]
        .into_iter()
        .flat_map(|sign| joined(polyline.turns(sign, angle), points.len()))
        .map(|turn| polyline.middle(turn))
        .collect();
    corners.sort_by(f64::total_cmp);
    corners.dedup();
    corners
}

/// Points from the first to the last of a turn; the last counts on beyond the end where the turn passes the first point.
type Turn = [usize; 2];

/// A closed polyline: by how much it turns at each point, −π..π, and how long the piece after each is.
struct Polyline {
    turning: Vec<f64>,
    pieces: Vec<f64>,
    way: f64,
}

impl Polyline {
    fn of(points: &[[f64; 3]], way: f64) -> Self {
        let count = points.len();
        let step = |i: usize| {
            let (a, b) = (points[i % count], points[(i + 1) % count]);
            [b[0] - a[0], b[1] - a[1]]
        };
        let pieces: Vec<f64> = (0..count).map(|i| step(i)[0].hypot(step(i)[1])).collect();
        let turning = (0..count)
            .map(|i| {
                let (u, v) = (step(i + count - 1), step(i));
                libm::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])
            })
            .collect();
        // More than a part of the outline is no corner of it.
        let way = way.min(0.25 * pieces.iter().sum::<f64>()) * (1.0 + ROUNDING);
        Self { turning, pieces, way }
    }

    fn count(&self) -> usize {
        self.turning.len()
    }

    /// The turning at a point to one side (1: to the left, −1: to the right).
    fn turning(&self, i: usize, sign: f64) -> f64 {
        sign * self.turning[i % self.count()]
    }

    /// From each point that turns to this side, the longest turn within the way that is larger than `angle`.
    fn turns(&self, sign: f64, angle: f64) -> Vec<Turn> {
        let longest = |first: usize| {
            let (mut sum, mut length, mut last) = (0.0, 0.0, None);
            for i in first..first + self.count() {
                let here = self.turning(i, sign);
                sum += here;
                if here > ROUNDING && sum > angle + ROUNDING {
                    last = Some(i);
                }
                length += self.pieces[i % self.count()];
                if length > self.way {
                    break;
                }
            }
            last.map(|last| [first, last])
        };
        (0..self.count()).filter(|&i| self.turning(i, sign) > ROUNDING).filter_map(longest).collect()
    }

    /// Parameter of the place where half of a turn is done: at a kink, or, if just half is done between two, midway between
    /// them; so that a mirrored outline has the mirrored corners.
    fn middle(&self, [first, last]: Turn) -> f64 {
        let sign = if self.turning(first, 1.0) > 0.0 { 1.0 } else { -1.0 };
        let half = 0.5 * (first..=last).map(|i| self.turning(i, sign)).sum::<f64>();
        let mut done = 0.0;
        for i in first..last {
            done += self.turning(i, sign);
            if done > half + ROUNDING * PI {
                return self.parameter(i, 0.0);
            }
            if done > half - ROUNDING * PI {
                let next = (i + 1..last).find(|&k| self.turning(k, sign).abs() > ROUNDING).unwrap_or(last);
                return self
                    .parameter(i, 0.5 * (i..next).map(|k| self.pieces[k % self.count()]).sum::<f64>());
            }
        }
        self.parameter(last, 0.0)
    }

    /// Parameter of the place so many metres after a point.
    fn parameter(&self, point: usize, mut way: f64) -> f64 {
        let mut i = point;
        while way > self.pieces[i % self.count()] {
            way -= self.pieces[i % self.count()];
            i += 1;
        }
        ((i % self.count()) as f64 + way / self.pieces[i % self.count()]) % self.count() as f64
    }
}

/// Turns that overlap, which come by ascending first point, are one; none is left if they go all the way round.
fn joined(turns: Vec<Turn>, count: usize) -> Vec<Turn> {
    let mut joined: Vec<Turn> = Vec::new();
    for turn in turns {
        match joined.last_mut() {
            Some(before) if turn[0] <= before[1] => before[1] = before[1].max(turn[1]),
            _ => joined.push(turn),
        }
    }
    // The last may reach over the first point into the first.
    while let (Some(&[first, end]), Some(&[start, last])) = (joined.first(), joined.last()) {
        if last < first + count {
            break;
        }
        if joined.len() == 1 {
            return Vec::new();
        }
        joined.remove(0);
        if let Some(turn) = joined.last_mut() {
            *turn = [start, last.max(end + count)];
        }
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners(points: &[[f64; 2]], way: f64) -> Vec<f64> {
        let points: Vec<[f64; 3]> = points.iter().map(|&[x, y]| [x, y, 0.0]).collect();
        find(&points, 30f64.to_radians(), way)
    }

    /// A square of ten metres whose corners are cut by `cuts` chords each of a fillet of radius `r`.
    fn filleted(r: f64, cuts: u32) -> Vec<[f64; 2]> {
        let centers = [[10.0 - r, r], [10.0 - r, 10.0 - r], [r, 10.0 - r], [r, r]];
        let mut points = Vec::new();
        for (quarter, [x, y]) in (-1..3).zip(centers) {
            for k in 0..=cuts {
                let angle = (f64::from(quarter) + f64::from(k) / f64::from(cuts)) * 0.5 * PI;
                points.push([x + r * angle.cos(), y + r * angle.sin()]);
            }
        }
        points
    }

    #[test]
    fn a_fillet_is_one_corner_at_its_middle() {
        // Four chords turn at five points, the middle one of them is the third; of three chords the middle one is cut in two.
        assert_eq!(corners(&filleted(0.001, 4), 0.1), [2.0, 7.0, 12.0, 17.0]);
        assert_eq!(corners(&filleted(0.001, 3), 0.1), [1.5, 5.5, 9.5, 13.5]);
        assert_eq!(corners(&filleted(0.03, 4), 0.1), [2.0, 7.0, 12.0, 17.0]);
        assert_eq!(corners(&[[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0]], 0.1), [0.0, 1.0, 2.0, 3.0]);
    }

    #[test]
    fn what_is_smooth_has_none() {
        assert!(corners(&filleted(3.0, 40), 0.1).is_empty());
        let circle = |radius: f64| -> Vec<[f64; 2]> {
            (0..200)
                .map(|k| f64::from(k) * PI / 100.0)
                .map(|a| [radius * a.cos(), radius * a.sin()])
                .collect()
        };
        for radius in [10.0, 1.0, 0.02] {
            assert!(corners(&circle(radius), 0.1).is_empty(), "{radius}");
        }
    }

    /// A corner that lies at the first point, within a turn that begins before it.
    #[test]
    fn a_turn_may_pass_the_first_point() {
        let mut points = filleted(0.001, 4);
        points.rotate_left(2);
        assert_eq!(corners(&points, 0.1), [0.0, 5.0, 10.0, 15.0]);
        points.rotate_left(1);
        assert_eq!(corners(&points, 0.1), [4.0, 9.0, 14.0, 19.0]);
    }

    /// A re-entrant corner beside a convex one keeps its own.
    #[test]
    fn turns_to_both_sides_stay_apart() {
        let step = [[0.0, 0.0], [9.0, 0.0], [9.0, 4.0], [5.0, 4.0], [5.0, 4.05], [0.0, 4.05]];
        assert_eq!(corners(&step, 0.1), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    }
}
