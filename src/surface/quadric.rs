//! The two built-in surfaces of second degree, in u = (x − cx)/a and v = (y − cy)/b:
//! the paraboloid z = rise · (1 − u² − v²) + base and the hyperbolic paraboloid z = rise · u · v + base.

use super::error::{SurfaceError, finite, positive};
use super::height::HeightFunction;

/// Which of the two.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Shape {
    /// A paraboloid with a vertical axis.
    Paraboloid,
    /// A hyperbolic paraboloid whose straight lines run along x and y.
    Hypar,
}

/// A surface of second degree over a rectangle.
#[derive(Clone, Debug)]
pub(super) struct Quadric {
    shape: Shape,
    center: [f64; 2],
    half_spans: [f64; 2],
    rise: f64,
    base: f64,
}

impl Quadric {
    pub(super) fn new(
        shape: Shape,
        center: [f64; 2],
        half_spans: [f64; 2],
        rise: f64,
        base: f64,
    ) -> Result<Self, SurfaceError> {
        Ok(Self {
            shape,
            center: [finite("center_m", center[0])?, finite("center_m", center[1])?],
            half_spans: [positive("half_spans_m", half_spans[0])?, positive("half_spans_m", half_spans[1])?],
            rise: finite("rise_m", rise)?,
            base: finite("base_m", base)?,
        })
    }
}

impl HeightFunction for Quadric {
    fn z(&self, x: f64, y: f64) -> f64 {
        let u = (x - self.center[0]) / self.half_spans[0];
        let v = (y - self.center[1]) / self.half_spans[1];
        match self.shape {
            Shape::Paraboloid => self.rise * (1.0 - u * u - v * v) + self.base,
            Shape::Hypar => self.rise * u * v + self.base,
        }
    }

    fn gradient(&self, x: f64, y: f64) -> [f64; 2] {
        let [a, b] = self.half_spans;
        let (dx, dy) = (x - self.center[0], y - self.center[1]);
        match self.shape {
            Shape::Paraboloid => [-2.0 * self.rise * dx / (a * a), -2.0 * self.rise * dy / (b * b)],
            Shape::Hypar => [self.rise * dy / (a * b), self.rise * dx / (a * b)],
        }
    }

    fn extent(&self) -> String {
        match self.shape {
            Shape::Paraboloid => "the paraboloid is everywhere".to_owned(),
            Shape::Hypar => "the hypar is everywhere".to_owned(),
        }
    }
}
