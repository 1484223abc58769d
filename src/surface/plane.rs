//! The horizontal plane.

use super::error::{SurfaceError, finite};
use super::height::HeightFunction;

/// z = const.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    z: f64,
}

impl Plane {
    pub(super) fn new(z: f64) -> Result<Self, SurfaceError> {
        Ok(Self { z: finite("z_m", z)? })
    }
}

impl HeightFunction for Plane {
    fn z(&self, _x: f64, _y: f64) -> f64 {
        self.z
    }

    fn gradient(&self, _x: f64, _y: f64) -> [f64; 2] {
        [0.0, 0.0]
    }

    fn extent(&self) -> String {
        "the plane is everywhere".to_owned()
    }
}
