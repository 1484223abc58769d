//! The hyperbolic paraboloid z = rise · ((x − cx)/a) · ((y − cy)/b) + base.

use super::error::{SurfaceError, finite, positive};
use super::height::HeightFunction;

/// A hyperbolic paraboloid whose straight lines run along x and y.
#[derive(Clone, Debug)]
pub(super) struct Hypar {
    center: [f64; 2],
    half_spans: [f64; 2],
    rise: f64,
    base: f64,
}

impl Hypar {
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

impl HeightFunction for Hypar {
    fn z(&self, x: f64, y: f64) -> f64 {
        let [a, b] = self.half_spans;
        self.rise * ((x - self.center[0]) / a) * ((y - self.center[1]) / b) + self.base
    }

    fn gradient(&self, x: f64, y: f64) -> [f64; 2] {
        let [a, b] = self.half_spans;
        [self.rise * (y - self.center[1]) / (a * b), self.rise * (x - self.center[0]) / (a * b)]
    }

    fn extent(&self) -> String {
        "the hypar is everywhere".to_owned()
    }
}
