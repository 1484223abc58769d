//! The 12-degree-of-freedom beam element, Euler–Bernoulli or Timoshenko, and its geometric stiffness.
//!
//! Stiffness and geometric stiffness have the same block layout, for displacements u and rotations r of start (1)
//! and end (2):
//!
//! ```text
//!        u1   r1   u2   r2
//!  u1 [  D    S   −D    S ]
//!  r1 [  Sᵀ   P   −Sᵀ   Q ]        D, S, P, Q: 3 × 3, local axes x (along), y, z
//!  u2 [ −D   −S    D   −S ]
//!  r2 [  Sᵀ   Q   −Sᵀ   P ]
//! ```
//!
//! Sources: Przemieniecki (1968), *Theory of Matrix Structural Analysis*, §5.6 (stiffness with shear, φ = 12EI/GAsL²)
//! and §15 (geometric stiffness: the plain cubic Hermite matrix, no axial and no torsional term).

use super::model::{Frame3, FrameModel, Material, MemberKind};
use super::section::Section;
use nalgebra::{Matrix3, Vector3};

/// Unknowns of a node.
pub const DOFS: usize = 6;

/// The four blocks of an element matrix, in whatever axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blocks {
    /// Force at a node from its displacement.
    pub d: Matrix3<f64>,
    /// Force at the start from a rotation at either end.
    pub s: Matrix3<f64>,
    /// Moment at a node from its own rotation.
    pub p: Matrix3<f64>,
    /// Moment at a node from the other end's rotation.
    pub q: Matrix3<f64>,
}

impl Blocks {
    /// The whole matrix, for u₁, r₁, u₂, r₂.
    pub fn grid(&self) -> [[Matrix3<f64>; 4]; 4] {
        let Self { d, s, p, q } = *self;
        let t = s.transpose();
        [[d, s, -d, s], [t, p, -t, q], [-d, -s, d, -s], [t, q, -t, p]]
    }
}

/// The distinct stiffness numbers of one element, local axes (N/m, N, Nm).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stiffness {
    /// EA / L.
    pub axial: f64,
    /// GJ / L.
    pub torsion: f64,
    /// Bending in the x–y plane (about z): force–displacement, force–rotation, near and far moment–rotation.
    pub xy: Bending,
    /// Bending in the x–z plane (about y).
    pub xz: Bending,
}

/// Bending in one plane: 12EI/L³, 6EI/L², (4+φ)EI/L, (2−φ)EI/L, each over 1 + φ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bending {
    /// 12EI / (L³ (1 + φ)).
    pub shift: f64,
    /// 6EI / (L² (1 + φ)).
    pub couple: f64,
    /// (4 + φ) EI / (L (1 + φ)).
    pub near: f64,
    /// (2 − φ) EI / (L (1 + φ)).
    pub far: f64,
}

impl Bending {
    /// `ei` in Nm², `gas` = G As in N (0: rigid in shear), `length` in m.
    fn new(ei: f64, gas: f64, length: f64) -> Self {
        let phi = if gas > 0.0 { 12.0 * ei / (gas * length * length) } else { 0.0 };
        let unit = ei / (length * (1.0 + phi));
        Self {
            shift: 12.0 * unit / (length * length),
            couple: 6.0 * unit / length,
            near: (4.0 + phi) * unit,
            far: (2.0 - phi) * unit,
        }
    }
}

impl Stiffness {
    /// The stiffness of a beam of `length` m.
    pub fn new(section: &Section, material: &Material, shear_deformation: bool, length: f64) -> Self {
        let (e, g) = (material.youngs_modulus, material.shear_modulus);
        let gas = |area: f64| if shear_deformation { g * area } else { 0.0 };
        Self {
            axial: e * section.area / length,
            torsion: g * section.j / length,
            xy: Bending::new(e * section.iz, gas(section.asy), length),
            xz: Bending::new(e * section.iy, gas(section.asz), length),
        }
    }

    /// Of member `m` of a model with the given sections.
    pub fn of_member(model: &FrameModel, sections: &[Section], m: usize) -> Self {
        let member = &model.members()[m];
        let section = &sections[member.section as usize];
        let beam = Self::new(section, model.material(), model.shear_deformation(), model.axes()[m].length);
        if member.kind == MemberKind::Truss { beam.axial_only() } else { beam }
    }

    /// What is left of it without bending and torsion.
    fn axial_only(self) -> Self {
        let none = Bending { shift: 0.0, couple: 0.0, near: 0.0, far: 0.0 };
        Self { axial: self.axial, torsion: 0.0, xy: none, xz: none }
    }

    /// Its blocks in global axes.
    pub fn global(&self, axes: &Frame3) -> Blocks {
        let (x, y, z) = (&axes.x, &axes.y, &axes.z);
        let (xx, yy, zz) = (x * x.transpose(), y * y.transpose(), z * z.transpose());
        let yz = y * z.transpose();
        Blocks {
            d: xx * self.axial + yy * self.xy.shift + zz * self.xz.shift,
            s: yz * self.xy.couple - yz.transpose() * self.xz.couple,
            p: xx * self.torsion + yy * self.xz.near + zz * self.xy.near,
            q: yy * self.xz.far + zz * self.xy.far - xx * self.torsion,
        }
    }
}

/// The geometric stiffness for unit tension, global axes. It knows no `up`: both planes are alike.
pub fn geometric(axes: &Frame3) -> Blocks {
    let length = axes.length;
    let across = Matrix3::identity() - axes.x * axes.x.transpose();
    Blocks {
        d: across * (1.2 / length),
        s: axes.x.cross_matrix() * -0.1,
        p: across * (2.0 * length / 15.0),
        q: across * (-length / 30.0),
    }
}

/// The same of a bar that stays straight: a string.
pub fn geometric_of_truss(axes: &Frame3) -> Blocks {
    let across = Matrix3::identity() - axes.x * axes.x.transpose();
    let none = Matrix3::zeros();
    Blocks { d: across / axes.length, s: none, p: none, q: none }
}

/// Displacement and rotation of the two ends of an element, global axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ends {
    /// Displacement of the start minus that of the end.
    pub shift: Vector3<f64>,
    /// Rotation of the start.
    pub r1: Vector3<f64>,
    /// Rotation of the end.
    pub r2: Vector3<f64>,
}

impl Ends {
    /// Reads an element's ends from a vector of unknowns, given where the two nodes' six begin.
    pub fn read(u: &[f64], start: usize, end: usize) -> Self {
        // Slices of six, so that the bounds are checked twice and not twelve times.
        let (u1, u2) = (&u[start..start + 6], &u[end..end + 6]);
        let at = |u: &[f64], i: usize| Vector3::new(u[i], u[i + 1], u[i + 2]);
        Self { shift: at(u1, 0) - at(u2, 0), r1: at(u1, 3), r2: at(u2, 3) }
    }

    /// Reads them in local axes from a vector of unknowns in two parts, as if with twice the digits: an elongation is
    /// what is left of displacements that may be a million times larger, and what of them is lost is a large force.
    pub fn local_of(u: &[f64], rest: &[f64], start: usize, end: usize, axes: &Frame3) -> Self {
        let part = |from: usize| Precise::read(u, rest, from);
        let turn = |v: &Precise| Vector3::new(v.along(&axes.x), v.along(&axes.y), v.along(&axes.z));
        Self {
            shift: turn(&part(start).less(&part(end))),
            r1: turn(&part(start + 3)),
            r2: turn(&part(end + 3)),
        }
    }

    /// The same in local axes.
    pub fn local(&self, axes: &Frame3) -> Self {
        let turn = |v: &Vector3<f64>| Vector3::new(axes.x.dot(v), axes.y.dot(v), axes.z.dot(v));
        Self { shift: turn(&self.shift), r1: turn(&self.r1), r2: turn(&self.r2) }
    }
}

/// A vector in two parts, the second of which is what rounding leaves out of the first.
#[derive(Clone, Copy)]
struct Precise {
    whole: [f64; 3],
    rest: [f64; 3],
}

impl Precise {
    fn read(u: &[f64], rest: &[f64], from: usize) -> Self {
        Self { whole: std::array::from_fn(|i| u[from + i]), rest: std::array::from_fn(|i| rest[from + i]) }
    }

    fn less(&self, other: &Self) -> Self {
        let differences = std::array::from_fn::<_, 3, _>(|i| sum(self.whole[i], -other.whole[i]));
        Self {
            whole: differences.map(|(whole, _)| whole),
            rest: std::array::from_fn(|i| differences[i].1 + (self.rest[i] - other.rest[i])),
        }
    }

    /// Its product with an axis: a dot product with compensation (Ogita, Rump, Oishi 2005).
    fn along(&self, axis: &Vector3<f64>) -> f64 {
        let (mut whole, mut rest) = (0.0, 0.0);
        for i in 0..3 {
            let product = axis[i] * self.whole[i];
            let (total, lost) = sum(whole, product);
            rest += lost + axis[i].mul_add(self.whole[i], -product) + axis[i] * self.rest[i];
            whole = total;
        }
        whole + rest
    }
}

/// a + b, and what rounding leaves out of it (Knuth).
fn sum(a: f64, b: f64) -> (f64, f64) {
    let total = a + b;
    let part = total - a;
    (total, (a - (total - part)) + (b - part))
}

/// What an element does on its nodes: force on the start (the end has the opposite) and the two moments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndActions {
    /// Force on the element at its start, N.
    pub force: Vector3<f64>,
    /// Moment on the element at its start, Nm.
    pub m1: Vector3<f64>,
    /// Moment on the element at its end, Nm.
    pub m2: Vector3<f64>,
}

impl Stiffness {
    /// End forces k u of the element in local axes.
    pub fn apply_local(&self, e: &Ends) -> EndActions {
        let turn = e.r1 + e.r2;
        let (xy, xz) = (&self.xy, &self.xz);
        let couple_y = -xz.couple * e.shift.z;
        let couple_z = xy.couple * e.shift.y;
        let moment = |near: &Vector3<f64>, far: &Vector3<f64>| {
            Vector3::new(
                self.torsion * (near.x - far.x),
                couple_y + xz.near * near.y + xz.far * far.y,
                couple_z + xy.near * near.z + xy.far * far.z,
            )
        };
        EndActions {
            force: Vector3::new(
                self.axial * e.shift.x,
                xy.shift * e.shift.y + xy.couple * turn.z,
                xz.shift * e.shift.z - xz.couple * turn.y,
            ),
            m1: moment(&e.r1, &e.r2),
            m2: moment(&e.r2, &e.r1),
        }
    }

    /// Strain energy × 2 of the element, from its deformations alone: of a rigid motion it is zero but for the
    /// square of a rounding error, where uᵀKu would be zero but for a rounding error.
    pub fn twice_energy(&self, e: &Ends, length: f64) -> f64 {
        let bending = |b: &Bending, [a, c]: [f64; 2]| b.near * (a * a + c * c) + 2.0 * b.far * a * c;
        let (xy, xz) = turns_of_ends(e, length);
        let twist = e.r1.x - e.r2.x;
        self.axial * e.shift.x * e.shift.x
            + self.torsion * twist * twist
            + bending(&self.xy, xy)
            + bending(&self.xz, xz)
    }

    /// Six deformations whose squares sum up to that energy.
    pub fn deformations(&self, e: &Ends, length: f64) -> [f64; 6] {
        // The two ends bent alike and against each other.
        let bending = |b: &Bending, [a, c]: [f64; 2]| {
            let of = |stiffness: f64, turn: f64| (0.5 * stiffness.max(0.0)).sqrt() * turn;
            [of(b.near + b.far, a + c), of(b.near - b.far, a - c)]
        };
        let (xy, xz) = turns_of_ends(e, length);
        let ([a, b], [c, d]) = (bending(&self.xy, xy), bending(&self.xz, xz));
        [self.axial.sqrt() * e.shift.x, self.torsion.sqrt() * (e.r1.x - e.r2.x), a, b, c, d]
    }
}

/// How far both ends are turned from the chord, in the x–y and the x–z plane.
fn turns_of_ends(e: &Ends, length: f64) -> ([f64; 2], [f64; 2]) {
    // The chord turns by (v2 − v1)/L about z and −(w2 − w1)/L about y.
    let about_z = -e.shift.y / length;
    let about_y = e.shift.z / length;
    ([e.r1.z - about_z, e.r2.z - about_z], [e.r1.y - about_y, e.r2.y - about_y])
}

/// End forces of the geometric stiffness for `tension` N; the same in local and in global axes.
#[inline]
pub fn geometric_actions(x: &Vector3<f64>, length: f64, tension: f64, e: &Ends) -> EndActions {
    let across = |v: Vector3<f64>| v - x * x.dot(&v);
    let turn = e.r1 + e.r2;
    let tenth = 0.1 * tension;
    let (near, far) = (tension * length * (2.0 / 15.0), tension * length * (-1.0 / 30.0));
    let shared = x.cross(&e.shift) * tenth;
    EndActions {
        force: across(e.shift) * (1.2 * tension / length) - x.cross(&turn) * tenth,
        m1: shared + across(e.r1 * near + e.r2 * far),
        m2: shared + across(e.r2 * near + e.r1 * far),
    }
}

/// The same of a bar that stays straight.
#[inline]
pub fn geometric_actions_of_truss(x: &Vector3<f64>, length: f64, tension: f64, e: &Ends) -> EndActions {
    let across = e.shift - x * x.dot(&e.shift);
    EndActions { force: across * (tension / length), m1: Vector3::zeros(), m2: Vector3::zeros() }
}

/// Nodal forces equal to a uniform load `q` (N/m, global): force on each end and moment on the start (the end has
/// the opposite): qL/2 and x × q L²/12.
pub fn uniform_load(axes: &Frame3, q: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
    let l = axes.length;
    (q * (0.5 * l), axes.x.cross(q) * (l * l / 12.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axes() -> Frame3 {
        let x = Vector3::new(2.0, -1.0, 0.5).normalize();
        let y = Vector3::new(0.3, 0.4, 1.0).cross(&x).normalize();
        Frame3 { x, y, z: x.cross(&y), length: 2.3 }
    }

    fn stiffness() -> Stiffness {
        let section = Section::rectangular_hollow(0.1, 0.2, 0.008).unwrap();
        let material = Material {
            youngs_modulus: 210e9,
            shear_modulus: 80e9,
            density: 0.0,
            strength: 1.0,
            thermal_expansion: 0.0,
        };
        Stiffness::new(&section, &material, true, 2.3)
    }

    fn ends(u: [f64; 12]) -> Ends {
        Ends::read(&u, 0, 6)
    }

    #[test]
    fn rigid_motion_costs_nothing() {
        // u = a + ω × p at both ends, r = ω.
        let axes = axes();
        let (a, w) = (Vector3::new(0.3, -0.7, 0.2), Vector3::new(0.01, 0.02, -0.03));
        let far = a + w.cross(&(axes.x * axes.length));
        let u = [a.x, a.y, a.z, w.x, w.y, w.z, far.x, far.y, far.z, w.x, w.y, w.z];
        let k = stiffness();
        let actions = k.apply_local(&ends(u).local(&axes));
        assert!(actions.force.amax() < 1e-4 && actions.m1.amax() < 1e-4 && actions.m2.amax() < 1e-4);
        assert!(k.twice_energy(&ends(u).local(&axes), axes.length).abs() < 1e-18);
    }

    #[test]
    fn energy_from_deformations_is_the_quadratic_form() {
        let axes = axes();
        let k = stiffness();
        let u = std::array::from_fn(|i| (0.7 * i as f64).sin());
        let e = ends(u).local(&axes);
        let f = k.apply_local(&e);
        let work = f.force.dot(&e.shift) + f.m1.dot(&e.r1) + f.m2.dot(&e.r2);
        assert!((k.twice_energy(&e, axes.length) / work - 1.0).abs() < 1e-12);
        let squares: f64 = k.deformations(&e, axes.length).iter().map(|d| d * d).sum();
        assert!((squares / work - 1.0).abs() < 1e-12);
    }

    #[test]
    fn blocks_and_actions_agree() {
        let axes = axes();
        let k = stiffness();
        let e = ends(std::array::from_fn(|i| (1.3 * i as f64).cos()));
        let b = k.global(&axes);
        let force = b.d * e.shift + b.s * (e.r1 + e.r2);
        let m1 = b.s.transpose() * e.shift + b.p * e.r1 + b.q * e.r2;
        let local = k.apply_local(&e.local(&axes));
        let back = |v: &Vector3<f64>| axes.x * v.x + axes.y * v.y + axes.z * v.z;
        assert!((back(&local.force) - force).amax() < 1e-6 * force.amax());
        assert!((back(&local.m1) - m1).amax() < 1e-6 * m1.amax());
        let g = geometric(&axes);
        let actions = geometric_actions(&axes.x, axes.length, -2.0, &e);
        let force = (g.d * e.shift + g.s * (e.r1 + e.r2)) * -2.0;
        let m2 = (g.s.transpose() * e.shift + g.p * e.r2 + g.q * e.r1) * -2.0;
        assert!((actions.force - force).amax() < 1e-12);
        assert!((actions.m2 - m2).amax() < 1e-12);
    }
}
