//! Finds what moves freely: the node and direction of a mechanism, instead of a huge number.
//!
//! A singular K shows as a pivot that is not positive, or tiny beside the diagonal it came from. Both also happen to
//! sound but very slender models, so the suspicion is tested.
//!
//! Members are joined rigidly. Where each of them resists all that can be done to it, what moves freely can only be a
//! part of the model that moves as a whole: [`rigid_motion`] compares its six motions with what the supports hold, which
//! is exact however soft the part is (a chain of n elements has motions n⁴ times softer than its elements, and is sound).
//!
//! Members without stiffness in bending or torsion can move freely in other ways. There, inverse iteration with
//! K + ε diag K (positive definite whatever K is) gives the softest motion v, whose strain energy is then summed from the
//! deformations of the elements. For a true mechanism that sum is the square of a rounding error.

use super::element::{Ends, Stiffness};
use super::factor::Factor;
use super::model::Direction;
use super::model::{FrameModel, NodeId};
use super::system::{DOFS, System};
use crate::random;
use nalgebra::{Matrix6, SymmetricEigen, Vector3, Vector6};

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

/// Share of the largest below which an eigenvalue of what the supports hold is none: lever arms of 1e-7 of the size.
const HELD: f64 = 1e-14;

/// The motion of a part of the model as a whole that no support holds, if there is one.
pub fn rigid_motion(model: &FrameModel, system: &System) -> Option<FreeMotion> {
    parts(model).iter().find_map(|part| {
        let positions = part.iter().map(|&n| Vector3::from(model.nodes()[n as usize]));
        let center = positions.clone().sum::<Vector3<f64>>() / part.len() as f64;
        let size = positions.map(|p| (p - center).norm()).fold(f64::MIN_POSITIVE, f64::max);
        // Unknowns: displacement of the centre, rotation × size.
        let mut held = Matrix6::zeros();
        for &n in part {
            let arm = (Vector3::from(model.nodes()[n as usize]) - center) / size;
            for (d, _) in model.fixed()[n as usize].iter().enumerate().filter(|(_, fixed)| **fixed) {
                let axis = Vector3::ith(d % 3, 1.0);
                let turn = if d < 3 { arm.cross(&axis) } else { axis };
                let shift = if d < 3 { axis } else { Vector3::zeros() };
                let row = Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z);
                held += row * row.transpose();
            }
        }
        let free = not_held(&held)?;
        let mut v = vec![0.0; system.unknowns()];
        let turn = Vector3::new(free[3], free[4], free[5]) / size;
        for &n in part {
            let arm = Vector3::from(model.nodes()[n as usize]) - center;
            let moved = Vector3::new(free[0], free[1], free[2]) + turn.cross(&arm);
            let first = system.first(n);
            v[first..first + 3].copy_from_slice(moved.as_slice());
            v[first + 3..first + DOFS].copy_from_slice(turn.as_slice());
        }
        system.hold_vector(&mut v);
        Some(largest(model, system, &v))
    })
}

/// Of what the matrix does not hold, the part of that direction which has most of it; none if it holds everything.
fn not_held(held: &Matrix6<f64>) -> Option<Vector6<f64>> {
    let eigen = SymmetricEigen::new(*held);
    let least = HELD * eigen.eigenvalues.amax();
    let free = (0..6).filter(|&i| eigen.eigenvalues[i] <= least).map(|i| eigen.eigenvectors.column(i));
    let projection = free.fold(Matrix6::zeros(), |sum, v| sum + v * v.transpose());
    let mut best = 0;
    for d in 1..6 {
        // A little more is no more, so that the first is named.
        if projection[(d, d)] > projection[(best, best)] + 1e-6 {
            best = d;
        }
    }
    (projection[(best, best)] > 0.0).then(|| projection.column(best).into_owned())
}

/// The nodes of each connected part of the model, in order.
fn parts(model: &FrameModel) -> Vec<Vec<u32>> {
    let mut root: Vec<u32> = (0..model.nodes().len() as u32).collect();
    let find = |root: &mut Vec<u32>, mut n: u32| {
        while root[n as usize] != n {
            root[n as usize] = root[root[n as usize] as usize];
            n = root[n as usize];
        }
        n
    };
    for member in model.members() {
        let (a, b) = (find(&mut root, member.start), find(&mut root, member.end));
        root[a.max(b) as usize] = a.min(b);
    }
    let mut parts: Vec<Vec<u32>> = Vec::new();
    let mut place = vec![usize::MAX; root.len()];
    for n in 0..root.len() as u32 {
        let r = find(&mut root, n) as usize;
        if place[r] == usize::MAX {
            place[r] = parts.len();
            parts.push(Vec::new());
        }
        parts[place[r]].push(n);
    }
    parts
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
    if factor.factorise(system, &shifted).is_err() {
        // Not even with a shift that no rounding reaches: the search is at its end, and says nothing.
        return None;
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
