//! No surface: the relaxation itself finds the form (cable net).

use super::{Surface, SurfaceKind};

/// Takes every point as it is.
#[derive(Clone, Debug)]
pub(super) struct Free;

impl Surface for Free {
    fn kind(&self) -> SurfaceKind {
        SurfaceKind::Free
    }

    fn height(&self, _x: f64, _y: f64) -> Option<f64> {
        None
    }

    fn project(&self, point: [f64; 3]) -> [f64; 3] {
        point
    }

    fn normal(&self, _point: [f64; 3]) -> [f64; 3] {
        [0.0, 0.0, 1.0]
    }

    fn extent(&self) -> String {
        "there is no surface".to_owned()
    }
}
