//! What the members do, one by one: products with K and Kg(N) without a matrix, energies, axial forces.

use super::element::{self, EndActions, Ends};
use super::model::Frame3;
use super::solver::{Refined, Solver};
use super::system::{DOFS, Link, Slot};
use nalgebra::Vector3;

/// The ends of a member in its local axes.
#[derive(Clone, Copy, Debug)]
pub struct BothEnds {
    /// Of the beam itself.
    pub beam: Ends,
    /// By how much it is turned against its nodes, at its start and its end; nothing where it is joined rigidly.
    pub slips: [Vector3<f64>; 2],
}

impl BothEnds {
    #[inline]
    fn rigid(nodes: Ends) -> Self {
        Self { beam: nodes, slips: [Vector3::zeros(); 2] }
    }
}

impl Solver<'_> {
    /// f − (K + Kg(N)) u.
    pub fn residual(&self, found: &Refined, axial: Option<&[f64]>, f: &[f64]) -> Vec<f64> {
        let mut left = f.to_vec();
        self.subtract_forces_of(|m| self.refined_ends(m, found), axial, &mut left);
        self.subtract_springs(&found.u, &mut left);
        left
    }

    /// r −= (K + Kg(N)) u, element by element.
    pub fn subtract_forces(&self, u: &[f64], axial: Option<&[f64]>, r: &mut [f64]) {
        self.subtract_forces_of(|m| self.ends(m, u), axial, r);
        self.subtract_springs(u, r);
    }

    fn subtract_springs(&self, u: &[f64], r: &mut [f64]) {
        for &(unknown, stiffness) in self.springs() {
            r[unknown] -= stiffness * u[unknown];
        }
    }

    /// The same for the members, given the ends of each.
    #[inline]
    fn subtract_forces_of(&self, ends: impl Fn(usize) -> BothEnds, axial: Option<&[f64]>, r: &mut [f64]) {
        for (m, (axes, slot)) in self.model().axes().iter().zip(self.system().slots()).enumerate() {
            let BothEnds { beam, slips } = ends(m);
            let actions = self.end_actions(m, &beam, axial.map(|axial| axial[m]));
            let springs = |j: usize| {
                let [k1, k2] = &self.joints()[j];
                [k1.component_mul(&slips[0]), k2.component_mul(&slips[1])]
            };
            self.scatter_local(&actions, slot, axes, springs, r);
        }
    }

    /// Adds −1 × the end actions of a beam (local axes), and of the springs at its ends, to a vector.
    #[inline]
    fn scatter_local(
        &self,
        actions: &EndActions,
        slot: &Slot,
        axes: &Frame3,
        springs: impl Fn(usize) -> [Vector3<f64>; 2],
        r: &mut [f64],
    ) {
        let mut at_nodes = *actions;
        if let Link::Turned(j) = slot.link {
            let turned = &self.system().turned()[j as usize];
            let (nodes, own) = turned.passed_on(actions, &springs(j as usize));
            at_nodes = nodes;
            let unknowns = &mut r[turned.at..turned.at + DOFS];
            unknowns.iter_mut().zip(own.iter().flatten()).for_each(|(r, m)| *r -= m);
        }
        let back = |v: &Vector3<f64>| axes.x * v.x + axes.y * v.y + axes.z * v.z;
        let actions =
            EndActions { force: back(&at_nodes.force), m1: back(&at_nodes.m1), m2: back(&at_nodes.m2) };
        scatter(&actions, slot.start, slot.end, -1.0, r);
    }

    /// What member `m` does at its ends, local axes: (k + N kg) u, `tension` = N.
    #[inline]
    pub fn end_actions(&self, m: usize, ends: &Ends, tension: Option<f64>) -> EndActions {
        let mut actions = self.stiffness()[m].apply_local(ends);
        if let Some(tension) = tension {
            let g = self.geometric_actions(m, ends, tension);
            actions.force += g.force;
            actions.m1 += g.m1;
            actions.m2 += g.m2;
        }
        actions
    }

    #[inline]
    fn geometric_actions(&self, m: usize, ends: &Ends, tension: f64) -> EndActions {
        let (x, length) = (Vector3::x(), self.model().axes()[m].length);
        match self.system().slots()[m].link {
            Link::Truss => element::geometric_actions_of_truss(&x, length, tension, ends),
            Link::Rigid | Link::Turned(_) => element::geometric_actions(&x, length, tension, ends),
        }
    }

    /// The ends of member `m`, local axes.
    #[inline]
    pub fn ends(&self, m: usize, u: &[f64]) -> BothEnds {
        let slot = &self.system().slots()[m];
        let nodes = Ends::read(u, slot.start, slot.end).local(&self.model().axes()[m]);
        match slot.link {
            Link::Rigid | Link::Truss => BothEnds::rigid(nodes),
            Link::Turned(j) => {
                let turned = &self.system().turned()[j as usize];
                let y = turned.read(u);
                BothEnds { beam: turned.ends(&nodes, &y), slips: turned.slips(&nodes, &y) }
            }
        }
    }

    /// The same of displacements in two parts.
    pub fn refined_ends(&self, m: usize, found: &Refined) -> BothEnds {
        let slot = &self.system().slots()[m];
        let axes = &self.model().axes()[m];
        let nodes = Ends::local_of(&found.u, &found.rest, slot.start, slot.end, axes);
        match slot.link {
            Link::Rigid | Link::Truss => BothEnds::rigid(nodes),
            Link::Turned(j) => {
                let turned = &self.system().turned()[j as usize];
                let (whole, rest) = (turned.read(&found.u), turned.read(&found.rest));
                let y = [whole[0] + rest[0], whole[1] + rest[1]];
                BothEnds { beam: turned.ends(&nodes, &y), slips: turned.slips(&nodes, &y) }
            }
        }
    }

    /// Twice the strain energy of displacements, from the deformations of the elements.
    pub fn twice_energy(&self, u: &[f64]) -> f64 {
        let axes = self.model().axes();
        let members: f64 = (0..axes.len())
            .map(|m| self.stiffness()[m].twice_energy(&self.ends(m, u).beam, axes[m].length))
            .sum();
        if self.springs().is_empty() && self.joints().is_empty() {
            return members;
        }
        let joints: f64 = self
            .system()
            .turned()
            .iter()
            .zip(self.joints())
            .map(|(turned, springs)| {
                let slips = self.ends(turned.member, u).slips;
                (0..2).map(|i| springs[i].dot(&slips[i].component_mul(&slips[i]))).sum::<f64>()
            })
            .sum();
        let springs: f64 = self.springs().iter().map(|&(unknown, k)| k * u[unknown] * u[unknown]).sum();
        members + joints + springs
    }

    /// The mean axial force N of each member (tension positive): EA/L times the linear elongation, and the `initial` N of
    /// what is warmed and held (empty: none).
    pub fn axial_forces(&self, u: &[f64], initial: &[f64], axial: &mut Vec<f64>) {
        axial.clear();
        let members = self.model().axes().iter().zip(self.system().slots()).zip(self.stiffness());
        axial.extend(members.map(|((axes, slot), k)| {
            let (s, e) = (slot.start, slot.end);
            let stretch = Vector3::new(u[e] - u[s], u[e + 1] - u[s + 1], u[e + 2] - u[s + 2]);
            k.axial * axes.x.dot(&stretch)
        }));
        axial.iter_mut().zip(initial).for_each(|(n, initial)| *n += initial);
    }

    /// The same of displacements in two parts.
    pub fn axial_forces_of(&self, found: &Refined, initial: &[f64], axial: &mut Vec<f64>) {
        axial.clear();
        let members = self.model().axes().iter().zip(self.system().slots()).zip(self.stiffness());
        // The shift is that of the start less that of the end.
        axial.extend(members.map(|((axes, slot), k)| {
            -k.axial * Ends::local_of(&found.u, &found.rest, slot.start, slot.end, axes).shift.x
        }));
        axial.iter_mut().zip(initial).for_each(|(n, initial)| *n += initial);
    }

    /// y = −Kg(N) x, for several columns, without a matrix.
    pub fn minus_geometric(&self, axial: &[f64], x: &[f64], y: &mut [f64]) {
        let n = self.system().unknowns();
        y.fill(0.0);
        for (x, y) in x.chunks(n).zip(y.chunks_mut(n)) {
            for (m, (axes, slot)) in self.model().axes().iter().zip(self.system().slots()).enumerate() {
                if slot.link == Link::Rigid {
                    let ends = Ends::read(x, slot.start, slot.end);
                    let actions = element::geometric_actions(&axes.x, axes.length, axial[m], &ends);
                    scatter(&actions, slot.start, slot.end, -1.0, y);
                } else {
                    let actions = self.geometric_actions(m, &self.ends(m, x).beam, axial[m]);
                    self.scatter_local(&actions, slot, axes, |_| [Vector3::zeros(); 2], y);
                }
            }
            self.system().hold_vector(y);
        }
    }
}

/// Adds `factor` × an element's end actions to a vector.
fn scatter(actions: &EndActions, start: usize, end: usize, factor: f64, y: &mut [f64]) {
    let mut add = |at: usize, force_sign: f64, moment: &Vector3<f64>| {
        let node = &mut y[at..at + DOFS];
        for d in 0..3 {
            node[d] += force_sign * actions.force[d];
            node[d + 3] += factor * moment[d];
        }
    };
    add(start, factor, &actions.m1);
    add(end, -factor, &actions.m2);
}
