//! The upper half of a horizontal cylinder; points go to the closest one.

use super::error::{SurfaceError, finite, positive};
use super::{Surface, SurfaceKind};

/// A half cylinder, its two rims at the height of the axis.
#[derive(Clone, Debug)]
pub(super) struct Cylinder {
    center: [f64; 3],
    /// Unit vector across the axis, in plan.
    across: [f64; 2],
    radius: f64,
}

impl Cylinder {
    pub(super) fn new(center: [f64; 3], axis_deg: f64, radius: f64) -> Result<Self, SurfaceError> {
        for value in center {
            finite("center_m", value)?;
        }
        let angle = finite("axis_deg", axis_deg)?.to_radians();
        let across = [-libm::sin(angle), libm::cos(angle)];
        Ok(Self { center, across, radius: positive("radius_m", radius)? })
    }

    /// Signed distance from the axis in plan.
    fn offset(&self, x: f64, y: f64) -> f64 {
        (x - self.center[0]) * self.across[0] + (y - self.center[1]) * self.across[1]
    }

    /// Unit direction (across, up) from the axis to the point, not below the horizontal.
    fn direction(&self, point: [f64; 3]) -> [f64; 2] {
        let v = self.offset(point[0], point[1]);
        let w = (point[2] - self.center[2]).max(0.0);
        let length = (v * v + w * w).sqrt();
        if length > 0.0 { [v / length, w / length] } else { [0.0, 1.0] }
    }
}

impl Surface for Cylinder {
    fn kind(&self) -> SurfaceKind {
        SurfaceKind::Closest
    }

    fn height(&self, x: f64, y: f64) -> Option<f64> {
        let v = self.offset(x, y);
        let rest = self.radius * self.radius - v * v;
        // A boundary drawn on the rim may miss it by a rounding error.
        (rest >= -1e-9 * self.radius * self.radius).then(|| self.center[2] + rest.max(0.0).sqrt())
    }

    fn project(&self, point: [f64; 3]) -> [f64; 3] {
        let [v, w] = self.direction(point);
        let shift = self.radius * v - self.offset(point[0], point[1]);
        [
            point[0] + shift * self.across[0],
            point[1] + shift * self.across[1],
            self.center[2] + self.radius * w,
        ]
    }

    fn normal(&self, point: [f64; 3]) -> [f64; 3] {
        let [v, w] = self.direction(point);
        [v * self.across[0], v * self.across[1], w]
    }

    fn extent(&self) -> String {
        format!("the cylinder reaches {} m to both sides of its axis", self.radius)
    }
}
