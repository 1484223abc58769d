//! Finds what moves freely: the node and direction of a mechanism, instead of a huge number.
//!
//! A singular K shows as a pivot that is not positive, or tiny beside the diagonal it came from. Both also happen to
//! sound but very slender models, so the suspicion is tested: inverse iteration with K + ε diag K (positive definite
//! whatever K is) gives the softest motion v, whose strain energy is then summed from the deformations of the
//! elements. For a true mechanism that sum is the square of a rounding error.

use super::element::{Ends, Stiffness};
use super::factor::Factor;
use super::model::{FrameModel, NodeId};
use super::params::Direction;
use super::system::{DOFS, System};
use crate::random;

/// A motion that meets (next to) no resistance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeMotion {
    /// The node that moves most.
    pub node: NodeId,
    /// The direction in which it moves most.
    pub direction: Direction,
    /// Its whole motion, ux … rz, scaled to 1 in that direction.
    pub motion: [f64; 6],
}

const DIRECTIONS: [Direction; 6] =
    [Direction::Ux, Direction::Uy, Direction::Uz, Direction::Rx, Direction::Ry, Direction::Rz];

/// A pivot this small beside its diagonal starts the search.
const DOUBT: f64 = 1e-9;
/// The shift ε of the inverse iteration, relative to the diagonal.
const SHIFT: f64 = 1e-10;
/// Strain energy relative to Σ diag(K) v² below which a motion counts as free: no digit of a solution would be true.
const FREE: f64 = 1e-15;

/// Whether a pivot of the factor is so small that the matrix may be singular.
pub fn suspicious(system: &System, matrix: &[f64], factor: &Factor) -> bool {
    let mut doubt = false;
    factor.pivots(system, |unknown, pivot| {
        let diagonal = matrix[system.diagonal(unknown)];
        doubt |= pivot.is_nan() || pivot <= DOUBT * diagonal;
    });
    doubt
}

/// The motion that costs next to nothing, if there is one. Uses `factor` as room.
pub fn free_motion(
    model: &FrameModel,
    system: &System,
    stiffness: &[Stiffness],
    matrix: &[f64],
    factor: &mut Factor,
) -> Option<FreeMotion> {
    let diagonal: Vec<f64> = (0..system.unknowns()).map(|i| matrix[system.diagonal(i)]).collect();
    let mut shifted = matrix.to_vec();
    for (i, d) in diagonal.iter().enumerate() {
        shifted[system.diagonal(i)] += SHIFT * d;
    }
    if let Err(at) = factor.factorise(system, &shifted) {
        return Some(named(system, at.unknown));
    }
    let mut rng = random::stream(0x6d65_6368, 0, 0);
    let mut v: Vec<f64> = diagonal.iter().map(|d| (random::unit(&mut rng) - 0.5) / d.sqrt()).collect();
    for _ in 0..4 {
        // b = D v, v = (K + εD)⁻¹ b.
        for (v, d) in v.iter_mut().zip(&diagonal) {
            *v *= d;
        }
        system.hold_vector(&mut v);
        factor.solve(system, &mut v);
        let norm = weight(&v, &diagonal).sqrt();
        v.iter_mut().for_each(|v| *v /= norm);
    }
    let energy: f64 = model
        .axes()
        .iter()
        .zip(system.slots())
        .zip(stiffness)
        .map(|((axes, slot), k)| {
            k.twice_energy(&Ends::read(&v, slot.start, slot.end).local(axes), axes.length)
        })
        .sum();
    // Not `<`, so that a NaN counts as free.
    if energy > FREE * weight(&v, &diagonal) { None } else { Some(largest(model, system, &v)) }
}

fn weight(v: &[f64], diagonal: &[f64]) -> f64 {
    v.iter().zip(diagonal).map(|(v, d)| v * v * d).sum()
}

/// Names the node of a motion: where it moves most; where it only turns, where it turns most.
pub fn largest(model: &FrameModel, system: &System, v: &[f64]) -> FreeMotion {
    // A rotation counts as the displacement at the end of a member of mean length.
    let mean = model.axes().iter().map(|a| a.length).sum::<f64>() / model.axes().len() as f64;
    let mut best = (0, 0, 0.0);
    for n in 0..model.nodes().len() as u32 {
        let first = system.first(n);
        for (d, value) in v[first..first + DOFS].iter().enumerate() {
            let size = value.abs() * if d < 3 { 1.0 } else { mean };
            // A little more is no more: of several that move alike, the first is named.
            if size > best.2 * (1.0 + 1e-6) {
                best = (n, d, size);
            }
        }
    }
    let (node, d, _) = best;
    let first = system.first(node);
    let unit = v[first + d];
    let motion = std::array::from_fn(|i| if unit == 0.0 { 0.0 } else { v[first + i] / unit });
    FreeMotion { node: NodeId(node), direction: DIRECTIONS[d], motion }
}

/// Names an unknown as a motion.
pub fn named(system: &System, unknown: usize) -> FreeMotion {
    let (node, d) = system.unknown(unknown);
    let motion = std::array::from_fn(|i| if i == d { 1.0 } else { 0.0 });
    FreeMotion { node: NodeId(node), direction: DIRECTIONS[d], motion }
}
