//! Members that are joined to their nodes by springs or hinges.
//!
//! The rotations of such a member's two ends are six unknowns of its own, about its local axes. Nothing but the member
//! and its two nodes' rotations know them, so that they are the first to be eliminated: the factorisation condenses them,
//! out of K and of K + s Kg alike and for every s exactly. (Condensed beforehand with the shape that K alone gives them, Kg
//! would be that of a bar whose ends turn as if nothing pressed on it: one between two hinges would have no Euler load.)
//!
//! ```text
//!   end rotation  θ = a ∘ r + y        r: rotation of the node, local; y: the unknown; a = 0 or 1 about each axis
//!   spring        c = k (θ − r) = k (y − (1 − a) r)
//! ```
//!
//! With a = 1 the unknown is the rotation of the spring: a spring of 10¹² EI/L costs no digit, and one that is rigid is y
//! held at 0. With a = 0 it is that of the end: a hinge gives its node exactly nothing.

use super::element::{Blocks, DOFS, EndActions, Ends, Stiffness};
use super::model::{EndJoint, Frame3, FrameModel, Joint};
use nalgebra::{Matrix3, Vector3};

/// A member's matrix for u₁, r₁, u₂, r₂ (global), y₁, y₂ (local).
pub type BLOCKS = [[Matrix3<f64>; 6]; 6];

/// Where the rotations of a member's ends are, and what they mean.
#[derive(Clone, Copy, Debug)]
pub struct Turned {
    /// The member.
    pub member: usize,
    /// Its first unknown: y of the start, then of the end.
    pub at: usize,
    /// Index of the blocks that couple it with the start and the end, in the column of the earlier.
    pub below: [u32; 2],
    joints: [EndJoint; 2],
    /// a, of start and end.
    carried: [Vector3<f64>; 2],
}

impl Turned {
    /// Of member `m`, with its first unknown and the places of its blocks.
    pub fn new(model: &FrameModel, m: usize, at: usize, below: [u32; 2]) -> Self {
        let joints = model.members()[m].kind.joints().copied().unwrap_or([EndJoint::RIGID; 2]);
        let own = per_length(&Stiffness::of_member(model, model.sections(), m));
        // Which is the better unknown is settled once, for all heights of the section.
        let carried = joints.map(|end| {
            let about = end.about();
            let stiff = |d: usize| about[d].is_rigid() || about[d].stiffness(own[d]) > own[d];
            Vector3::from_fn(|d, _| f64::from(u8::from(stiff(d))))
        });
        Self { member: m, at, below, joints, carried }
    }

    /// Which of the six are held, because the end turns with its node.
    pub fn rigid(&self) -> [bool; DOFS] {
        std::array::from_fn(|i| self.joints[i / 3].about()[i % 3].is_rigid())
    }

    /// The springs of start and end beside a member of this stiffness, Nm/rad; 0 where it is rigid.
    pub fn springs(&self, member: &Stiffness) -> [Vector3<f64>; 2] {
        let own = per_length(member);
        let spring = |joint: Joint, own: f64| if joint.is_rigid() { 0.0 } else { joint.stiffness(own) };
        self.joints.map(|end| {
            let about = end.about();
            Vector3::from_fn(|d, _| spring(about[d], own[d]))
        })
    }

    /// Its own unknowns of a vector.
    pub fn read(&self, u: &[f64]) -> [Vector3<f64>; 2] {
        let y = &u[self.at..self.at + DOFS];
        [Vector3::new(y[0], y[1], y[2]), Vector3::new(y[3], y[4], y[5])]
    }

    /// The ends of the beam from those of its nodes, both in local axes.
    pub fn ends(&self, nodes: &Ends, y: &[Vector3<f64>; 2]) -> Ends {
        let [a1, a2] = &self.carried;
        Ends {
            shift: nodes.shift,
            r1: a1.component_mul(&nodes.r1) + y[0],
            r2: a2.component_mul(&nodes.r2) + y[1],
        }
    }

    /// By how much the springs are turned.
    pub fn slips(&self, nodes: &Ends, y: &[Vector3<f64>; 2]) -> [Vector3<f64>; 2] {
        let slip =
            |a: &Vector3<f64>, r: &Vector3<f64>, y: &Vector3<f64>| y - a.zip_map(r, |a, r| (1.0 - a) * r);
        [slip(&self.carried[0], &nodes.r1, &y[0]), slip(&self.carried[1], &nodes.r2, &y[1])]
    }

    /// What moments at the ends of the beam and in the springs do at the nodes: the actions there (local axes), and on
    /// the unknowns of the member.
    pub fn passed_on(
        &self,
        beam: &EndActions,
        springs: &[Vector3<f64>; 2],
    ) -> (EndActions, [Vector3<f64>; 2]) {
        let moment = |i: usize, m: &Vector3<f64>| {
            let a = &self.carried[i];
            Vector3::from_fn(|d, _| a[d] * m[d] - (1.0 - a[d]) * springs[i][d])
        };
        let own = [beam.m1 + springs[0], beam.m2 + springs[1]];
        (EndActions { force: beam.force, m1: moment(0, &beam.m1), m2: moment(1, &beam.m2) }, own)
    }

    /// What a moment on the start, and its opposite on the end (global), put on the nodes; adds what they put on the
    /// member's own unknowns.
    pub fn load(&self, axes: &Frame3, moment: &Vector3<f64>, f: &mut [f64]) -> (Vector3<f64>, Vector3<f64>) {
        let local = Vector3::new(axes.x.dot(moment), axes.y.dot(moment), axes.z.dot(moment));
        for d in 0..3 {
            f[self.at + d] += local[d];
            f[self.at + 3 + d] -= local[d];
        }
        let part = |i: usize| {
            let v = self.carried[i].component_mul(&local);
            axes.x * v.x + axes.y * v.y + axes.z * v.z
        };
        (part(0), part(1))
    }

    /// The matrix of the beam (its blocks in local axes) in terms of all unknowns; `springs` as of [`Turned::springs`],
    /// none for Kg.
    pub fn matrix(&self, axes: &Frame3, local: &Blocks, springs: Option<&[Vector3<f64>; 2]>) -> BLOCKS {
        let beam = local.grid();
        let turn = Matrix3::from_rows(&[axes.x.transpose(), axes.y.transpose(), axes.z.transpose()]);
        let carried = |i: usize| Matrix3::from_diagonal(&self.carried[i]) * turn;
        let one = Matrix3::identity();
        // Which displacement or rotation of the beam an unknown moves, and how.
        let moves = [(0, turn), (1, carried(0)), (2, turn), (3, carried(1)), (1, one), (3, one)];
        let mut blocks = moves.map(|(i, left)| moves.map(|(j, right)| left.transpose() * beam[i][j] * right));
        for (i, k) in springs.into_iter().flatten().enumerate() {
            let k = Matrix3::from_diagonal(k);
            let (node, own) = (2 * i + 1, 4 + i);
            // The spring turns by y − (1 − a) r.
            let free = Matrix3::from_diagonal(&self.carried[i].map(|a| a - 1.0)) * turn;
            blocks[node][node] += free.transpose() * k * free;
            blocks[node][own] += free.transpose() * k;
            blocks[own][node] += k * free;
            blocks[own][own] += k;
        }
        blocks
    }
}

/// GJ/L, EI/L about y and z of a member, Nm.
fn per_length(member: &Stiffness) -> Vector3<f64> {
    // The moments against both ends turned alike and against each other differ by 2 EI/L, with shear or without.
    Vector3::new(
        member.torsion,
        0.5 * (member.xz.near - member.xz.far),
        0.5 * (member.xy.near - member.xy.far),
    )
}
