//! What vertices are held on (GEOMETRY §1).

pub mod params;

pub use params::SurfaceParams;

/// A surface: positions and normals. Implementors are one file each and one line in [`params`].
pub trait Surface: Send + Sync {
    /// Brings a point back onto the surface: vertically for a height surface (x, y kept), the closest point elsewhere.
    fn project(&self, point: [f64; 3]) -> [f64; 3];

    /// Unit normal at a point of the surface, upwards where that means something.
    fn normal(&self, point: [f64; 3]) -> [f64; 3];
}
