//! The paraboloid z = rise · (1 − ((x − cx)/a)² − ((y − cy)/b)²) + base.

use super::error::{SurfaceError, finite, positive};
use super::height::HeightFunction;

/// A paraboloid with a vertical axis.
#[derive(Clone, Debug)]
pub(super) struct Paraboloid {
    center: [f64; 2],
    half_spans: [f64; 2],
    rise: f64,
    base: f64,
}

impl Paraboloid {
    pub(super) fn new(
        center: [f64; 2],
        half_spans: [f64; 2],
        rise: f64,
        base: f64,
    ) -> Result<Self, SurfaceError> {
        Ok(Self {
            center: [finite("center_m", center[0])?, finite("center_m", center[1])?],
            half_spans: [positive("half_spans_m", half_spans[0])?, positive("half_spans_m", half_spans[1])?],
            rise: finite("rise_m", rise)?,
            base: finite("base_m", base)?,
        })
    }
}

impl HeightFunction for Paraboloid {
    fn z(&self, x: f64, y: f64) -> f64 {
        let u = (x - self.center[0]) / self.half_spans[0];
        let v = (y - self.center[1]) / self.half_spans[1];
        self.rise * (1.0 - u * u - v * v) + self.base
    }

    fn gradient(&self, x: f64, y: f64) -> [f64; 2] {
        let [a, b] = self.half_spans;
        [-2.0 * self.rise * (x - self.center[0]) / (a * a), -2.0 * self.rise * (y - self.center[1]) / (b * b)]
    }

    fn extent(&self) -> String {
        "the paraboloid is everywhere".to_owned()
    }
}
