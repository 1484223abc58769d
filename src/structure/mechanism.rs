//! Finds what moves freely: the node and direction of a mechanism, instead of a huge number.
//!
//! The pivots of a factor do not tell: those of a sound but very slender model may be tiny, and where members are slender
//! rounding leaves pivots of ε (L/i)² where a mechanism has none.
//!
//! Members are joined rigidly. Where each of them resists all that can be done to it, what moves freely can only be a
//! part of the model that moves as a whole: [`rigid_motion`] compares its six motions with what the supports hold, which
//! is exact however soft the part is (a chain of n elements has motions n⁴ times softer than its elements, and is sound).
//! It needs no stiffness and is always asked.
//!
//! Members without stiffness in bending or torsion, trusses and hinges can move freely in other ways. There, inverse iteration with
//! K + ε D (D: diag K, nowhere nothing; positive definite whatever K is) gives the softest motions; of their
//! combinations that is taken whose strain energy, summed from the deformations of the elements, is least. For a true mechanism that sum is the square of a rounding error.

use super::element::{Ends, Stiffness};
use super::factor::Factor;
use super::model::{Direction, FrameModel, NodeId, Spring};
use super::system::{DOFS, Link, System};
use crate::random;
use nalgebra::{DMatrix, Matrix6, SVD, SymmetricEigen, Vector3, Vector6};

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

/// The shift ε of the inverse iteration, relative to the diagonal.
const SHIFT: f64 = 1e-10;
/// The least entry of D, beside the stiffest of its kind at the node: where nothing resists, or rounding, the diagonal is
/// no measure.
const LEAST: f64 = 1e-8;
/// How many motions are looked at together, so that the softest is told from the next, and how often they are improved.
const BLOCK: usize = 8;
const ITERATIONS: usize = 5;
/// Strain energy relative to Σ D v² below which a motion counts as free: no digit of a solution would be true.
const FREE: f64 = 1e-15;

/// Share of the largest below which an eigenvalue of what the supports hold is none: lever arms of 1e-7 of the size.
const HELD: f64 = 1e-14;

/// The motion of a part of the model as a whole that no support holds, if there is one.
pub fn rigid_motion(model: &FrameModel, system: &System) -> Option<FreeMotion> {
    let holds = |node: u32, direction: usize| {
        let spring = |spring: &Spring| (spring.node, spring.direction).cmp(&(node, direction));
        model.fixed()[node as usize][direction] || model.springs().binary_search_by(spring).is_ok()
    };
    parts(model).iter().find_map(|part| {
        let positions = part.iter().map(|&n| Vector3::from(model.nodes()[n as usize]));
        let center = positions.clone().sum::<Vector3<f64>>() / part.len() as f64;
        let size = positions.map(|p| (p - center).norm()).fold(f64::MIN_POSITIVE, f64::max);
        // Unknowns: displacement of the centre, rotation × size.
        let mut held = Matrix6::zeros();
        for &n in part {
            let arm = (Vector3::from(model.nodes()[n as usize]) - center) / size;
            for d in (0..DOFS).filter(|&d| holds(n, d)) {
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

/// All that resists a motion.
pub struct Resisting<'a> {
    /// The model.
    pub model: &'a FrameModel,
    /// Its equation system.
    pub system: &'a System,
    /// Stiffness numbers of each member.
    pub stiffness: &'a [Stiffness],
    /// Springs of each member with joints.
    pub joints: &'a [[Vector3<f64>; 2]],
    /// Springs of supports: unknown and stiffness.
    pub springs: &'a [(usize, f64)],
}

impl Resisting<'_> {
    /// Deformations whose squares sum up to twice the strain energy.
    fn deformations(&self, v: &[f64]) -> Vec<f64> {
        let mut all =
            Vec::with_capacity(DOFS * (self.stiffness.len() + self.joints.len()) + self.springs.len());
        for ((axes, slot), k) in self.model.axes().iter().zip(self.system.slots()).zip(self.stiffness) {
            let nodes = Ends::read(v, slot.start, slot.end).local(axes);
            let Link::Turned(j) = slot.link else {
                all.extend(k.deformations(&nodes, axes.length));
                continue;
            };
            let turned = &self.system.turned()[j as usize];
            let y = turned.read(v);
            all.extend(k.deformations(&turned.ends(&nodes, &y), axes.length));
            let slips = turned.slips(&nodes, &y);
            let springs = self.joints[j as usize].iter().flatten();
            all.extend(springs.zip(slips.iter().flatten()).map(|(k, slip)| k.sqrt() * slip));
        }
        all.extend(self.springs.iter().map(|&(unknown, k)| k.sqrt() * v[unknown]));
        all
    }
}

/// The motion that costs next to nothing, if there is one. Uses `factor` as room.
pub fn free_motion(structure: &Resisting<'_>, matrix: &[f64], factor: &mut Factor) -> Option<FreeMotion> {
    let &Resisting { model, system, stiffness, .. } = structure;
    let diagonal = weights(model, system, stiffness, matrix);
    let mut shifted = matrix.to_vec();
    for (i, d) in diagonal.iter().enumerate() {
        shifted[system.diagonal(i)] += SHIFT * d;
    }
    if factor.factorise(system, &shifted).is_err() {
        // Not even with a shift that no rounding reaches: the search is at its end, and says nothing.
        return None;
    }
    let n = diagonal.len();
    let free = system.held().iter().filter(|held| !**held).count();
    let mut rng = random::stream(0x6d65_6368, 0, 0);
    let mut block: Vec<f64> = (0..BLOCK.min(free))
        .flat_map(|_| {
            diagonal.iter().map(|d| (random::unit(&mut rng) - 0.5) / d.sqrt()).collect::<Vec<f64>>()
        })
        .collect();
    for _ in 0..ITERATIONS {
        // b = D v, v = (K + εD)⁻¹ b.
        for v in block.chunks_mut(n) {
            v.iter_mut().zip(&diagonal).for_each(|(v, d)| *v *= d);
            system.hold_vector(v);
        }
        factor.solve(system, &mut block);
        orthonormalise(&mut block, &diagonal);
    }
    // Of their combinations, the one that deforms the elements least.
    let deformed: Vec<f64> = block.chunks(n).flat_map(|v| structure.deformations(v)).collect();
    let columns = block.len() / n;
    let deformed = DMatrix::from_vec(deformed.len() / columns, columns, deformed);
    let parts = SVD::try_new(deformed.qr().r(), false, true, f64::EPSILON, 10_000)?;
    let shares = parts.v_t?;
    let (least, stretch) = parts.singular_values.argmin();
    // Not `<`, so that a NaN counts as free.
    if stretch * stretch > FREE {
        return None;
    }
    let mut v = vec![0.0; n];
    for (part, share) in block.chunks(n).zip(shares.row(least).iter()) {
        v.iter_mut().zip(part).for_each(|(v, part)| *v += share * part);
    }
    Some(largest(model, system, &v))
}

/// Makes the vectors orthonormal in the inner product of D.
fn orthonormalise(block: &mut [f64], diagonal: &[f64]) {
    let n = diagonal.len();
    let product =
        |v: &[f64], w: &[f64]| -> f64 { v.iter().zip(w).zip(diagonal).map(|((v, w), d)| v * w * d).sum() };
    for i in 0..block.len() / n {
        let (before, rest) = block.split_at_mut(i * n);
        let v = &mut rest[..n];
        // Twice: what is left of much is not yet orthogonal.
        for w in before.chunks(n).chain(before.chunks(n)) {
            let share = product(v, w);
            v.iter_mut().zip(w).for_each(|(v, w)| *v -= share * w);
        }
        let norm = product(v, v).sqrt();
        v.iter_mut().for_each(|v| *v /= norm);
    }
}

/// D: the diagonal of K, but no less than a share of what its node has at most in displacement, or in rotation; there
/// the stiffest member counts as if it were fixed to its far end by a lever of its length.
fn weights(model: &FrameModel, system: &System, stiffness: &[Stiffness], matrix: &[f64]) -> Vec<f64> {
    let mut weights: Vec<f64> = (0..system.unknowns()).map(|i| matrix[system.diagonal(i)]).collect();
    let mut levers = vec![0.0f64; system.unknowns() / DOFS];
    for ((axes, slot), k) in model.axes().iter().zip(system.slots()).zip(stiffness) {
        for node in [slot.start / DOFS, slot.end / DOFS] {
            levers[node] = levers[node].max(k.axial * axes.length * axes.length);
        }
    }
    for (node, (unknowns, lever)) in weights.chunks_mut(DOFS).zip(levers).enumerate() {
        let (shifts, turns) =
            unknowns.split_at_mut(if system.is_rotation(DOFS * node) { 0 } else { DOFS / 2 });
        for (kind, lever) in [(shifts, 0.0), (turns, LEAST * lever)] {
            let least = LEAST * kind.iter().fold(lever, |a: f64, w| a.max(*w));
            kind.iter_mut().for_each(|w| *w = w.max(least));
        }
    }
    weights
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
    FreeMotion { node: NodeId(node), direction: Direction::ALL[d], motion }
}
