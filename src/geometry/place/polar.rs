//! A closed curve seen from a point inside: angle ↔ arc length.

use crate::domain::BoundaryLoop as Curve;
use std::f64::consts::TAU;

/// Points of the table, beside the corners.
const SAMPLES: usize = 256;
/// Steps of the search between two points of the table; each at least halves the interval every second time.
const STEPS: usize = 60;

/// A curve whose every point is seen from `center`, with a table to start from.
pub struct Polar<'a> {
    curve: &'a Curve,
    center: [f64; 2],
    /// Arc length and angle, both ascending, over one turn.
    table: Vec<(f64, f64)>,
}

impl<'a> Polar<'a> {
    /// The curve seen from `center`; `None` unless it turns around it counter-clockwise without turning back.
    pub fn of(curve: &'a Curve, center: [f64; 2]) -> Option<Self> {
        let length = curve.length();
        let mut stops: Vec<f64> = (0..SAMPLES).map(|i| length * i as f64 / SAMPLES as f64).collect();
        stops.extend(curve.corners().iter().map(|s| s.rem_euclid(length)));
        stops.sort_by(f64::total_cmp);
        stops.dedup_by(|b, a| *b - *a <= 1e-9 * length);
        stops.push(length);
        let mut polar = Self { curve, center, table: Vec::with_capacity(stops.len()) };
        let mut angle = 0.0;
        for s in stops {
            let direct = polar.direct_angle(s);
            let angle_here = match polar.table.last() {
                None => direct,
                Some(_) => angle + wrapped(direct - angle),
            };
            if polar.table.last().is_some_and(|&(_, before)| angle_here <= before) {
                return None;
            }
            angle = angle_here;
            polar.table.push((s, angle));
        }
        let turn = angle - polar.table[0].1;
        ((turn - TAU).abs() < 1e-6).then_some(polar)
    }

    fn direct_angle(&self, s: f64) -> f64 {
        let [x, y, _] = self.curve.point(s);
        libm::atan2(y - self.center[1], x - self.center[0])
    }

    /// Angle at an arc length, growing with it without end.
    pub fn angle(&self, s: f64) -> f64 {
        let length = self.curve.length();
        let turns = (s / length).floor();
        let within = s - turns * length;
        let i = self.table.partition_point(|&(at, _)| at <= within).clamp(1, self.table.len() - 1);
        let before = self.table[i - 1].1;
        before + wrapped(self.direct_angle(s) - before) + turns * TAU
    }

    /// Arc length at an angle: the inverse of [`Polar::angle`], by regula falsi with halved ends (Illinois).
    pub fn arc(&self, angle: f64) -> f64 {
        let first = self.table[0].1;
        let turns = ((angle - first) / TAU).floor();
        let within = angle - turns * TAU;
        let i = self.table.partition_point(|&(_, at)| at <= within).clamp(1, self.table.len() - 1);
        let (mut a, mut fa) = (self.table[i - 1].0, self.table[i - 1].1 - within);
        let (mut b, mut fb) = (self.table[i].0, self.table[i].1 - within);
        let mut s = a;
        let mut side = 0;
        for _ in 0..STEPS {
            if fb - fa <= 0.0 {
                break;
            }
            s = (a * fb - b * fa) / (fb - fa);
            let f = wrapped(self.direct_angle(s) - within);
            if f.abs() <= 1e-15 * TAU {
                break;
            }
            if f > 0.0 {
                (b, fb) = (s, f);
                if side == 1 {
                    fa *= 0.5;
                }
                side = 1;
            } else {
                (a, fa) = (s, f);
                if side == -1 {
                    fb *= 0.5;
                }
                side = -1;
            }
        }
        s + turns * self.curve.length()
    }
}

/// An angle brought to −π ..= π.
fn wrapped(angle: f64) -> f64 {
    angle - TAU * libm::round(angle / TAU)
}
