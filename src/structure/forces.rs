//! Stress resultants of members and what they use of the strength.

use super::element::{EndActions, Ends};
use super::model::{NodeId, Spring};
use super::section::Section;
use super::solver::{Refined, Solver};
use super::system::{DOFS, Link};
use nalgebra::Vector3;

/// Stress resultants on the cut face whose outward normal is local +x, local axes (N, Nm); N > 0 is tension.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Resultants {
    /// Axial force.
    pub n: f64,
    /// Shear force along y.
    pub vy: f64,
    /// Shear force along z.
    pub vz: f64,
    /// Torsional moment.
    pub mt: f64,
    /// Bending moment about y.
    pub my: f64,
    /// Bending moment about z.
    pub mz: f64,
}

/// Resultants at the two ends of a member, and the uniform load between (local axes, N/m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MemberForces {
    /// At local x = 0.
    pub start: Resultants,
    /// At local x = L.
    pub end: Resultants,
    /// Uniform load along local x, y, z.
    pub load: Vector3<f64>,
    /// Length L, m.
    pub length: f64,
}

/// What a member uses of the strength (1 = all of it).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Utilisation {
    /// (|N|/A + |My|/Wy + |Mz|/Wz) / f at the worse end.
    pub ends: f64,
    /// The same at the worst place, between the ends or at them.
    pub inner: f64,
    /// √(σ² + 3 τ²) / f at the worst of the ends and the worst place between; only σ where the section's shape is
    /// not known.
    pub von_mises: f64,
}

/// What else than the ends decides the forces of one member.
#[derive(Clone, Copy, Debug)]
pub struct Between {
    /// N of second order; none in first.
    pub axial: Option<f64>,
    /// N if its ends were held: of a change of temperature.
    pub initial: f64,
    /// Uniform load, N/m, global.
    pub load: Vector3<f64>,
}

/// The same of all members.
#[derive(Clone, Copy, Debug)]
pub struct BetweenAll<'a> {
    /// N of second order; none in first.
    pub axial: Option<&'a [f64]>,
    /// N if the ends were held; empty where nothing changes its temperature.
    pub initial: &'a [f64],
    /// Uniform load on each member that the displacements were found with, N/m, global.
    pub loads: &'a [Vector3<f64>],
}

impl BetweenAll<'_> {
    /// Of member `m`.
    pub fn of(&self, m: usize) -> Between {
        Between {
            axial: self.axial.map(|a| a[m]),
            initial: self.initial.get(m).copied().unwrap_or(0.0),
            load: self.loads[m],
        }
    }
}

impl Solver<'_> {
    /// The forces on every member: (k + N kg) u − fixed-end forces.
    pub fn member_forces(&self, u: &[f64], between: BetweenAll<'_>) -> Vec<MemberForces> {
        (0..self.model().members().len()).map(|m| self.forces_of(m, u, between.of(m))).collect()
    }

    /// The same of displacements in two parts.
    pub fn member_forces_of(&self, found: &Refined, between: BetweenAll<'_>) -> Vec<MemberForces> {
        let count = self.model().members().len();
        (0..count).map(|m| self.forces_at(m, &self.refined_ends(m, found).beam, between.of(m))).collect()
    }

    /// The same of member `m` alone.
    pub fn forces_of(&self, m: usize, u: &[f64], between: Between) -> MemberForces {
        self.forces_at(m, &self.ends(m, u).beam, between)
    }

    /// The same, given the ends of the beam in local axes.
    fn forces_at(&self, m: usize, ends: &Ends, Between { axial, initial, load: q }: Between) -> MemberForces {
        let axes = &self.model().axes()[m];
        let EndActions { force, m1, m2 } = self.end_actions(m, ends, axial);
        let load = Vector3::new(axes.x.dot(&q), axes.y.dot(&q), axes.z.dot(&q));
        let half = load * (0.5 * axes.length);
        let fixed = match self.system().slots()[m].link {
            Link::Truss => Vector3::zeros(),
            Link::Rigid | Link::Turned(_) => Vector3::x().cross(&load) * (axes.length * axes.length / 12.0),
        };
        let (f1, f2) = (force - half, -force - half);
        let (m1, m2) = (m1 - fixed, m2 + fixed);
        // Not + 0, which would take the sign from a −0.
        let with_initial = |n: f64| if initial == 0.0 { n } else { n + initial };
        MemberForces {
            start: Resultants {
                n: with_initial(-f1.x),
                vy: -f1.y,
                vz: -f1.z,
                mt: -m1.x,
                my: -m1.y,
                mz: -m1.z,
            },
            end: Resultants { n: with_initial(f2.x), vy: f2.y, vz: f2.z, mt: m2.x, my: m2.y, mz: m2.z },
            load,
            length: axes.length,
        }
    }

    /// Forces of the members, and of the springs of supports, on every node, less the loads: the reactions where it is
    /// held, global, six a node in elimination order. On free unknowns it is the residual of equilibrium.
    pub fn reactions(&self, u: &[f64], axial: Option<&[f64]>, f: &[f64]) -> Vec<f64> {
        let mut reactions = Vec::with_capacity(f.len());
        self.reactions_into(u, axial, f, &mut reactions);
        reactions
    }

    /// The same into a vector that is there already.
    pub fn reactions_into(&self, u: &[f64], axial: Option<&[f64]>, f: &[f64], reactions: &mut Vec<f64>) {
        reactions.clear();
        reactions.extend_from_slice(f);
        self.subtract_forces(u, axial, reactions);
        reactions.iter_mut().for_each(|r| *r = -*r);
    }
}

impl Solver<'_> {
    /// What the support of a node does to the structure, N and Nm, given all [`Solver::reactions`]; `None` where there
    /// is neither a fixed direction nor a spring.
    pub fn support_reaction(&self, node: NodeId, u: &[f64], reactions: &[f64]) -> [Option<f64>; DOFS] {
        let first = self.system().first(node.0);
        let springs = self.model().springs();
        let fixed = &self.model().fixed()[node.0 as usize];
        std::array::from_fn(|d| {
            let spring = |s: &Spring| (s.node, s.direction).cmp(&(node.0, d));
            match springs.binary_search_by(spring) {
                Ok(at) => Some(-springs[at].stiffness * u[first + d]),
                Err(_) => fixed[d].then(|| reactions[first + d]),
            }
        })
    }
}

impl MemberForces {
    /// The resultants at `x` m from the start: N and V linear, My and Mz parabolas through the values at the start
    /// and the end.
    pub fn at(&self, x: f64) -> Resultants {
        let (a, b, t) = (&self.start, &self.end, x / self.length);
        let bow = 0.5 * x * (self.length - x);
        let lerp = |a: f64, b: f64| a + (b - a) * t;
        Resultants {
            n: lerp(a.n, b.n),
            vy: lerp(a.vy, b.vy),
            vz: lerp(a.vz, b.vz),
            mt: lerp(a.mt, b.mt),
            my: lerp(a.my, b.my) + self.load.z * bow,
            mz: lerp(a.mz, b.mz) - self.load.y * bow,
        }
    }

    /// What the member uses of `strength` (Pa).
    pub fn utilisation(&self, section: &Section, strength: f64) -> Utilisation {
        let normal = |r: &Resultants| {
            (r.n.abs() / section.area + r.my.abs() / section.wy + r.mz.abs() / section.wz) / strength
        };
        let mises = |r: &Resultants| {
            let tau = section
                .shear
                .map_or(0.0, |s| (r.mt.abs() / s.wt + r.vy.abs() / s.avy + r.vz.abs() / s.avz) / strength);
            let sigma = normal(r);
            (sigma * sigma + 3.0 * tau * tau).sqrt()
        };
        let ends = normal(&self.start).max(normal(&self.end));
        let mut worst =
            Utilisation { ends, inner: ends, von_mises: mises(&self.start).max(mises(&self.end)) };
        for x in self.turning_points(section) {
            let r = self.at(x);
            worst.inner = worst.inner.max(normal(&r));
            worst.von_mises = worst.von_mises.max(mises(&r));
        }
        worst
    }

    /// Where the sum of |N|/A, |My|/Wy, |Mz|/Wz can have a maximum between the ends. The sum is the largest, over the
    /// signs, of ±N/A ± My/Wy ± Mz/Wz, each a parabola: its maxima are maxima of those. The common sign does not move
    /// them, so there are four.
    fn turning_points(&self, section: &Section) -> impl Iterator<Item = f64> {
        let length = self.length;
        let (a, b) = (self.start, self.end);
        let slope = |a: f64, b: f64| (b - a) / length;
        let (n, my, mz) = (slope(a.n, b.n), slope(a.my, b.my), slope(a.mz, b.mz));
        let (bow_y, bow_z) = (self.load.z, -self.load.y);
        let (area, wy, wz) = (section.area, section.wy, section.wz);
        [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)].into_iter().filter_map(move |(sy, sz)| {
            // d/dx: slope + bow (L − 2x)/2 = 0
            let linear = n / area + sy * my / wy + sz * mz / wz;
            let bow = sy * bow_y / wy + sz * bow_z / wz;
            let x = 0.5 * length + linear / bow;
            (bow != 0.0 && x > 0.0 && x < length).then_some(x)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn beam(q: f64, length: f64) -> MemberForces {
        // Simply supported, load q downwards (−z): My = −qL²/8 in the middle (+z fibre in compression).
        let v = q * length / 2.0;
        MemberForces {
            start: Resultants { vz: -v, ..Default::default() },
            end: Resultants { vz: v, ..Default::default() },
            load: Vector3::new(0.0, 0.0, -q),
            length,
        }
    }

    #[test]
    fn simply_supported_beam_is_worst_in_the_middle() {
        let section = Section::rectangular_hollow(0.1, 0.2, 0.01).unwrap();
        let forces = beam(5e3, 6.0);
        assert!((forces.at(3.0).my + 5e3 * 36.0 / 8.0).abs() < 1e-9);
        let used = forces.utilisation(&section, 355e6);
        assert_eq!(used.ends, 0.0);
        assert!((used.inner - 5e3 * 36.0 / 8.0 / section.wy / 355e6).abs() < 1e-15);
    }

    #[test]
    fn inner_extreme_is_found_wherever_it_is() {
        let section = Section::rectangular_hollow(0.1, 0.2, 0.01).unwrap();
        let mut forces = beam(5e3, 6.0);
        forces.load.y = 2e3;
        forces.start.mz = 4e3;
        forces.end.my = 9e3;
        forces.end.n = -6e4;
        let used = forces.utilisation(&section, 355e6);
        let scanned = (0..=100_000)
            .map(|i| {
                let r = forces.at(6.0 * f64::from(i) / 1e5);
                (r.n.abs() / section.area + r.my.abs() / section.wy + r.mz.abs() / section.wz) / 355e6
            })
            .fold(0.0, f64::max);
        assert!((used.inner / scanned - 1.0).abs() < 1e-9, "{} {scanned}", used.inner);
    }
}
