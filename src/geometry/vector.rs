//! Arithmetic of points in space.

/// A point or vector, m.
pub type Vec3 = [f64; 3];

/// a + b.
#[inline]
pub fn add(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// a − b.
#[inline]
pub fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// k a.
#[inline]
pub fn scale(a: Vec3, k: f64) -> Vec3 {
    [a[0] * k, a[1] * k, a[2] * k]
}

/// a · b.
#[inline]
pub fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a × b.
#[inline]
pub fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// |a|.
#[inline]
pub fn norm(a: Vec3) -> f64 {
    dot(a, a).sqrt()
}

/// |a − b|.
#[inline]
pub fn distance(a: Vec3, b: Vec3) -> f64 {
    norm(sub(a, b))
}

/// Angle between two vectors, in 0..π; accurate also for small and nearly straight ones. It is 0 where one of them has no length:
/// a corner with such an arm is no corner at all, the worst that there is.
#[inline]
pub fn angle(a: Vec3, b: Vec3) -> f64 {
    let (across, along) = (norm(cross(a, b)), dot(a, b));
    // The product with a vector of zeros may be −0, of which atan2 would make π.
    if across == 0.0 && along == 0.0 { 0.0 } else { libm::atan2(across, along) }
}
