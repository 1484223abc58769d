//! The net of given force densities (Schek 1974, *The force density method for form finding and computation of general networks*).

use super::laplacian::{Laplacian, Weights};
use super::rejection::Rejection;
use super::vector::Vec3;

/// Positions in equilibrium: Σ q (xⱼ − xᵢ) + loadᵢ = 0 at every vertex that is not held.
///
/// `edges` with one density each (N/m), `loads` by vertex (N; empty for none). Held vertices stay where `positions` has them.
///
/// # Errors
/// [`Rejection::NotFinite`] where the densities make no stable net.
pub fn solve(
    positions: &[Vec3],
    edges: &[[u32; 2]],
    densities: &[f64],
    loads: &[Vec3],
    is_held: &[bool],
) -> Result<Vec<Vec3>, Rejection> {
    let net = Laplacian::new(edges, Weights::Each(densities), is_held)
        .ok_or(Rejection::NotFinite { stage: "force densities" })?;
    let mut result = positions.to_vec();
    for k in 0..3 {
        let mut values: Vec<f64> = positions.iter().map(|p| p[k]).collect();
        net.solve(&mut values, |_| 0.0, |v| loads.get(v).map_or(0.0, |load| load[k]));
        for (p, value) in result.iter_mut().zip(values) {
            p[k] = value;
        }
    }
    Ok(result)
}
