//! What vertices are held on (docs/reference/geometry.md §1.2): one surface a file, [`build`] makes them from the config.

mod cylinder;
mod error;

mod free;
mod great_court;
mod height;
mod mesh;

pub mod params;
mod plane;
mod quadric;
mod skin;
mod sphere;
mod tree;
mod triangle;

pub use error::SurfaceError;
pub use great_court::GreatCourt;
pub use height::{HeightFunction, HeightSurface};

pub use mesh::MeshSurface;
pub use params::SurfaceParams;
pub use tree::{Closest, Over, TriangleTree};
pub use triangle::Triangle;

use crate::io::Inputs;
use quadric::{Quadric, Shape};
use std::sync::Arc;

/// How a surface takes a point back (docs/reference/geometry.md §1.2).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SurfaceKind {
    /// z = f(x, y): vertically, x and y are kept.
    Height,
    /// To the closest point.
    Closest,
    /// Not at all: the relaxation finds the form.
    Free,
}

/// A surface: positions and normals, in metres, z up.
pub trait Surface: Send + Sync {
    /// How it takes points back.
    fn kind(&self) -> SurfaceKind;

    /// Height over (x, y), the upper one where there are several; `None` where the surface does not reach or is not finite,
    /// and for a free surface everywhere.
    fn height(&self, x: f64, y: f64) -> Option<f64>;

    /// Brings a point back onto the surface: vertically for a height surface (x, y kept), the closest point elsewhere, not at
    /// all on a free surface. Points a little outside are answered as if the rim went on.
    fn project(&self, point: [f64; 3]) -> [f64; 3];

    /// Unit normal at a point of the surface, upwards where that means something; (0, 0, 1) on a free surface.
    fn normal(&self, point: [f64; 3]) -> [f64; 3];

    /// In words, where the surface exists: for the message that it does not cover the domain.
    fn extent(&self) -> String;

    /// Smallest and largest x and y, m, of a surface that has a rim of its own.
    fn bounds(&self) -> Option<[[f64; 2]; 2]> {
        None
    }

    /// Whether its normal varies smoothly; not so on facets.
    fn is_smooth(&self) -> bool {
        true
    }

    /// The point that [`Surface::project`] gives, and the unit normal there.
    fn foot(&self, point: [f64; 3]) -> ([f64; 3], [f64; 3]) {
        let foot = self.project(point);
        (foot, self.normal(foot))
    }

    /// Sets the heights of many points of a height surface, and its slopes (∂z/∂x, ∂z/∂y) there.
    fn lift_all(&self, points: &mut [[f64; 3]], slopes: &mut [[f64; 2]]) {
        self.project_all(points);
        for (point, slope) in points.iter().zip(slopes) {
            let n = self.normal(*point);
            *slope = [-n[0] / n[2], -n[1] / n[2]];
        }
    }

    /// [`Surface::project`] of many points: one virtual call for all of them.
    fn project_all(&self, points: &mut [[f64; 3]]) {
        for point in points {
            *point = self.project(*point);
        }
    }
}

/// Makes the surface of a config; the file that it names is among `inputs`.
///
/// # Errors
/// A length that is not positive and finite, a faulty expression (with its position), a file that cannot be read.
pub fn build(params: &SurfaceParams, inputs: &Inputs) -> Result<Arc<dyn Surface>, SurfaceError> {
    Ok(match params {
        SurfaceParams::GreatCourt {} => Arc::new(HeightSurface(GreatCourt)),
        SurfaceParams::Plane { z_m } => Arc::new(HeightSurface(plane::Plane::new(*z_m)?)),
        SurfaceParams::Height { expression, constants, lets } => {
            Arc::new(HeightSurface(crate::expression::Expression::parse(expression, constants, lets)?))
        }
        SurfaceParams::Paraboloid { center_m, half_spans_m, rise_m, base_m } => {
            let shape = Shape::Paraboloid;
            Arc::new(HeightSurface(Quadric::new(shape, *center_m, *half_spans_m, *rise_m, *base_m)?))
        }
        SurfaceParams::Hypar { center_m, half_spans_m, rise_m, base_m } => {
            Arc::new(HeightSurface(Quadric::new(Shape::Hypar, *center_m, *half_spans_m, *rise_m, *base_m)?))
        }
        SurfaceParams::Sphere { center_m, radius_m } => Arc::new(sphere::Sphere::new(*center_m, *radius_m)?),
        SurfaceParams::Cylinder { center_m, axis_deg, radius_m } => {
            Arc::new(cylinder::Cylinder::new(*center_m, *axis_deg, *radius_m)?)
        }
        SurfaceParams::Mesh { file, unit } => Arc::new(MeshSurface::read(inputs.get(file)?, *unit)?),
        SurfaceParams::Free {} => Arc::new(free::Free),
    })
}
