//! Load cases put together: from a combination to what acts on the unknowns.

use super::action::Action;
use super::element;
use super::solver::Solver;
use super::system::Link;
use nalgebra::Vector3;

/// Share of a displacement that is rounding, with room.
const LAST_DIGITS: f64 = 256.0 * f64::EPSILON;

impl Solver<'_> {
    /// The uniform load on each member (N/m, global) of a combination, self weight included.
    pub fn member_loads(&self, combination: &[(usize, f64)], loads: &mut Vec<Vector3<f64>>) {
        loads.clear();
        loads.resize(self.model().members().len(), Vector3::zeros());
        let density = self.model().material().density;
        for &(case, factor) in combination {
            let case = &self.model().load_cases()[case];
            for load in &case.uniform {
                loads[load.member as usize] += Vector3::from(load.force_per_length) * factor;
            }
            for load in &case.pressure {
                let axes = &self.model().axes()[load.member as usize];
                loads[load.member as usize] -= axes.z * (load.force_per_length * factor);
            }
            if case.gravity != 0.0 {
                let weight = factor * case.gravity * density;
                for (load, member) in loads.iter_mut().zip(self.model().members()) {
                    load.z -= weight * self.sections()[member.section as usize].area;
                }
            }
        }
    }

    /// N that each member would have, were its ends held, in a combination: −EAα ΔT. Empty where nothing changes its
    /// temperature.
    pub fn initial_forces(&self, combination: &[(usize, f64)], initial: &mut Vec<f64>) {
        initial.clear();
        let (model, alpha) = (self.model(), self.model().material().thermal_expansion);
        for &(case, factor) in combination {
            for load in &model.load_cases()[case].temperature {
                initial.resize(model.members().len(), 0.0);
                let m = load.member as usize;
                // EA of EA / L.
                let stiffness = self.stiffness()[m].axial * model.axes()[m].length;
                initial[m] -= factor * stiffness * alpha * load.kelvin;
            }
        }
    }

    /// The load vector of a combination with these member loads and these initial forces, held unknowns included.
    pub fn load_vector(
        &self,
        combination: &[(usize, f64)],
        member_loads: &[Vector3<f64>],
        initial: &[f64],
        f: &mut [f64],
    ) {
        f.fill(0.0);
        for &(case, factor) in combination {
            for load in &self.model().load_cases()[case].nodal {
                let first = self.system().first(load.node);
                for (d, value) in load.load.iter().enumerate() {
                    f[first + d] += factor * value;
                }
            }
        }
        for ((q, axes), slot) in member_loads.iter().zip(self.model().axes()).zip(self.system().slots()) {
            let (force, mut moment) = element::uniform_load(axes, q);
            let mut other = moment;
            match slot.link {
                Link::Rigid => {}
                Link::Truss => (moment, other) = (Vector3::zeros(), Vector3::zeros()),
                Link::Turned(j) => {
                    let turned = &self.system().turned()[j as usize];
                    (moment, other) = turned.load(axes, &moment, f);
                }
            }
            for d in 0..3 {
                f[slot.start + d] += force[d];
                f[slot.end + d] += force[d];
                f[slot.start + 3 + d] += moment[d];
                f[slot.end + 3 + d] -= other[d];
            }
        }
        // What is warmed pushes its ends apart.
        for ((n, axes), slot) in initial.iter().zip(self.model().axes()).zip(self.system().slots()) {
            for d in 0..3 {
                f[slot.start + d] += n * axes.x[d];
                f[slot.end + d] -= n * axes.x[d];
            }
        }
    }

    /// All of a combination, given its member loads.
    pub fn action(&self, combination: &[(usize, f64)], member_loads: &[Vector3<f64>]) -> Action {
        let mut action = Action { f: vec![0.0; self.system().unknowns()], ..Action::default() };
        self.initial_forces(combination, &mut action.initial);
        self.load_vector(combination, member_loads, &action.initial, &mut action.f);
        let cases = self.model().load_cases();
        for &(case, factor) in combination {
            for moved in &cases[case].settlements {
                action.settled.resize(self.system().unknowns(), 0.0);
                let first = self.system().first(moved.node);
                for (d, value) in moved.displacement.iter().enumerate() {
                    action.settled[first + d] += factor * value;
                }
            }
        }
        if action.settled.is_empty() {
            return action;
        }
        let largest = action.settled.iter().fold(0.0f64, |a, v| a.max(v.abs()));
        let stiffness: f64 = self.stiffness().iter().map(|k| k.axial).sum();
        action.noise = (LAST_DIGITS * largest).powi(2) * stiffness;
        let mut forces = vec![0.0; action.f.len()];
        self.subtract_forces(&action.settled, None, &mut forces);
        for (i, force) in forces.iter().enumerate() {
            let kind = usize::from(self.system().is_rotation(i));
            action.scale[kind] = action.scale[kind].max(force.abs());
        }
        action
    }

    /// Loads less what the prescribed displacements take with N (none: first order): the right side for the rest.
    pub fn lifted(&self, action: &Action, axial: Option<&[f64]>) -> Vec<f64> {
        let mut f = action.f.clone();
        if !action.settled.is_empty() {
            self.subtract_forces(&action.settled, axial, &mut f);
        }
        f
    }
}
