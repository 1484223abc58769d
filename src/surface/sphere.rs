//! The upper half of a sphere; points go to the closest one.

use super::error::{SurfaceError, finite, positive};
use super::{Surface, SurfaceKind};

/// A half sphere, its rim at the height of the centre.
#[derive(Clone, Debug)]
pub(super) struct Sphere {
    center: [f64; 3],
    radius: f64,
}

impl Sphere {
    pub(super) fn new(center: [f64; 3], radius: f64) -> Result<Self, SurfaceError> {
        for value in center {
            finite("center_m", value)?;
        }
        Ok(Self { center, radius: positive("radius_m", radius)? })
    }

    /// Unit direction from the centre to the point, not below the horizontal.
    fn direction(&self, point: [f64; 3]) -> [f64; 3] {
        let [x, y] = [point[0] - self.center[0], point[1] - self.center[1]];
        let z = (point[2] - self.center[2]).max(0.0);
        let length = (x * x + y * y + z * z).sqrt();
        if length > 0.0 { [x / length, y / length, z / length] } else { [0.0, 0.0, 1.0] }
    }
}

impl Surface for Sphere {
    fn kind(&self) -> SurfaceKind {
        SurfaceKind::Closest
    }

    fn height(&self, x: f64, y: f64) -> Option<f64> {
        let [dx, dy] = [x - self.center[0], y - self.center[1]];
        let rest = self.radius * self.radius - dx * dx - dy * dy;
        // A boundary drawn on the rim may miss it by a rounding error.
        (rest >= -1e-9 * self.radius * self.radius).then(|| self.center[2] + rest.max(0.0).sqrt())
    }

    fn project(&self, point: [f64; 3]) -> [f64; 3] {
        let d = self.direction(point);
        std::array::from_fn(|i| self.center[i] + self.radius * d[i])
    }

    fn normal(&self, point: [f64; 3]) -> [f64; 3] {
        self.direction(point)
    }

    fn extent(&self) -> String {
        let [x, y, _] = self.center;
        format!("the sphere reaches {} m around ({x}, {y})", self.radius)
    }
}
