//! Height surfaces z = f(x, y): a function and its gradient make a [`Surface`].

use super::{Surface, SurfaceKind};
use crate::expression::Expression;
use crate::expression::dual::Dual;

/// A function z = f(x, y) with its gradient, in metres.
pub trait HeightFunction: Send + Sync {
    /// Height. Total: where the function does not exist it is continued from the rim, or not finite.
    fn z(&self, x: f64, y: f64) -> f64;

    /// Sets the heights of many points.
    fn lift_all(&self, points: &mut [[f64; 3]]) {
        for point in points {
            point[2] = self.z(point[0], point[1]);
        }
    }

    /// Sets the heights of many points, and the slopes there.
    fn lift_all_with_slopes(&self, points: &mut [[f64; 3]], slopes: &mut [[f64; 2]]) {
        self.lift_all(points);
        for (point, slope) in points.iter().zip(slopes) {
            *slope = self.gradient(point[0], point[1]);
        }
    }

    /// (∂z/∂x, ∂z/∂y).
    fn gradient(&self, x: f64, y: f64) -> [f64; 2];

    /// Whether (x, y) lies where the function is meant to be used.
    fn covers(&self, _x: f64, _y: f64) -> bool {
        true
    }

    /// In words, where that is.
    fn extent(&self) -> String;
}

/// The surface of a height function.
#[derive(Clone, Debug)]
pub struct HeightSurface<F>(pub F);

impl<F: HeightFunction> Surface for HeightSurface<F> {
    fn kind(&self) -> SurfaceKind {
        SurfaceKind::Height
    }

    fn height(&self, x: f64, y: f64) -> Option<f64> {
        Some(self.0.z(x, y)).filter(|z| z.is_finite() && self.0.covers(x, y))
    }

    fn project(&self, [x, y, _]: [f64; 3]) -> [f64; 3] {
        [x, y, self.0.z(x, y)]
    }

    fn project_all(&self, points: &mut [[f64; 3]]) {
        self.0.lift_all(points);
    }

    fn lift_all(&self, points: &mut [[f64; 3]], slopes: &mut [[f64; 2]]) {
        self.0.lift_all_with_slopes(points, slopes);
    }

    fn normal(&self, [x, y, _]: [f64; 3]) -> [f64; 3] {
        let [zx, zy] = self.0.gradient(x, y);
        let length = (1.0 + zx * zx + zy * zy).sqrt();
        [-zx / length, -zy / length, 1.0 / length]
    }

    fn extent(&self) -> String {
        self.0.extent()
    }
}

impl HeightFunction for Expression {
    fn z(&self, x: f64, y: f64) -> f64 {
        self.run(&[x, y])
    }

    fn gradient(&self, x: f64, y: f64) -> [f64; 2] {
        self.run(&Dual::variables(x, y)).slope
    }

    fn extent(&self) -> String {
        format!("`{}` gives no finite number there", self.text())
    }
}
