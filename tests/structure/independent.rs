//! A second frame solver, for tests: dense, assembled from the textbook's 12 × 12 matrices, and with every spring between
//! a member and its node as an element of no length between unknowns of its own. It shares nothing with the solver but
//! the model's data.
#![allow(dead_code, reason = "each test uses some of it")]

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use quadrille::structure::model::{EndJoint, FrameParts, Joint, Member, MemberKind};

/// A member's unknowns: for each of u₁, θ₁, u₂, θ₂ along its local axes, what it is of all unknowns.
struct Placed {
    /// 12 × n, sparse as a list: of local unknown i, the unknowns and shares.
    rows: Vec<Vec<(usize, f64)>>,
    axial: f64,
    length: f64,
    k: DMatrix<f64>,
    g: DMatrix<f64>,
    /// Loads on its own unknowns with its ends held.
    fixed: DVector<f64>,
    initial: f64,
}

/// The whole model, dense.
pub struct Dense {
    placed: Vec<Placed>,
    k: DMatrix<f64>,
    f: DVector<f64>,
    /// Prescribed values of held unknowns.
    held: Vec<Option<f64>>,
}

fn axes(parts: &FrameParts, member: &Member) -> (Matrix3<f64>, f64) {
    let at = |n: u32| Vector3::from(parts.nodes[n as usize]);
    let chord = at(member.end) - at(member.start);
    let x = chord.normalize();
    let y = Vector3::from(member.up).cross(&x).normalize();
    let z = x.cross(&y);
    (Matrix3::from_rows(&[x.transpose(), y.transpose(), z.transpose()]), chord.norm())
}

/// Przemieniecki (1968), eq. (5.116), and (15.24) without axial and torsional terms; order u v w θx θy θz, twice.
fn matrices(parts: &FrameParts, member: &Member, l: f64) -> (DMatrix<f64>, DMatrix<f64>) {
    let s = &parts.sections[member.section as usize];
    let (e, g) = (parts.material.youngs_modulus, parts.material.shear_modulus);
    let (mut k, mut kg) = (DMatrix::zeros(12, 12), DMatrix::zeros(12, 12));
    let set = |m: &mut DMatrix<f64>, i: usize, j: usize, v: f64| {
        m[(i, j)] = v;
        m[(j, i)] = v;
    };
    for (i, stiffness) in
        [(0, e * s.area / l), (3, if member.kind == MemberKind::Truss { 0.0 } else { g * s.j / l })]
    {
        set(&mut k, i, i, stiffness);
        set(&mut k, i + 6, i + 6, stiffness);
        set(&mut k, i, i + 6, -stiffness);
    }
    if member.kind == MemberKind::Truss {
        for i in [1, 2] {
            set(&mut kg, i, i, 1.0 / l);
            set(&mut kg, i + 6, i + 6, 1.0 / l);
            set(&mut kg, i, i + 6, -1.0 / l);
        }
        return (k, kg);
    }
    // v with θz, and w with −θy.
    for (v, turn, sign, i, shear) in [(1, 5, 1.0, s.iz, s.asy), (2, 4, -1.0, s.iy, s.asz)] {
        let phi =
            if parts.shear_deformation && shear > 0.0 { 12.0 * e * i / (g * shear * l * l) } else { 0.0 };
        let c = e * i / (1.0 + phi);
        let bend = [12.0 * c / l.powi(3), 6.0 * c / l.powi(2), (4.0 + phi) * c / l, (2.0 - phi) * c / l];
        let string = [1.2 / l, 0.1, 2.0 * l / 15.0, -l / 30.0];
        for (m, [shift, couple, near, far]) in [(&mut k, bend), (&mut kg, string)] {
            set(m, v, v, shift);
            set(m, v + 6, v + 6, shift);
            set(m, v, v + 6, -shift);
            set(m, v, turn, sign * couple);
            set(m, v, turn + 6, sign * couple);
            set(m, v + 6, turn, -sign * couple);
            set(m, v + 6, turn + 6, -sign * couple);
            set(m, turn, turn, near);
            set(m, turn + 6, turn + 6, near);
            set(m, turn, turn + 6, far);
        }
    }
    (k, kg)
}

impl Dense {
    /// Assembles a model under its first load case.
    pub fn new(parts: &FrameParts) -> Self {
        let mut count = 6 * parts.nodes.len();
        let mut springs: Vec<(Vec<(usize, f64)>, f64)> = Vec::new();
        let mut placed = Vec::new();
        let case = &parts.load_cases[0];
        for (m, member) in parts.members.iter().enumerate() {
            let (turn, length) = axes(parts, member);
            let along = |first: usize, axis: usize| -> Vec<(usize, f64)> {
                (0..3).map(|d| (first + d, turn[(axis, d)])).collect()
            };
            let mut rows = Vec::new();
            let ends = match member.kind {
                MemberKind::Beam(ends) => ends,
                MemberKind::Truss => [EndJoint::RIGID; 2],
            };
            let s = &parts.sections[member.section as usize];
            let (e, g) = (parts.material.youngs_modulus, parts.material.shear_modulus);
            let own = [g * s.j / length, e * s.iy / length, e * s.iz / length];
            for (node, end) in [member.start, member.end].into_iter().zip(ends) {
                let first = 6 * node as usize;
                rows.extend((0..3).map(|axis| along(first, axis)));
                for (axis, joint) in [end.torsion, end.bending_y, end.bending_z].into_iter().enumerate() {
                    let of_node = along(first + 3, axis);
                    let stiffness = match joint {
                        Joint::Rigid => {
                            rows.push(of_node);
                            continue;
                        }
                        Joint::Relative(times) => times * own[axis],
                        Joint::Absolute(stiffness) => stiffness,
                    };
                    let mut slip: Vec<(usize, f64)> = of_node.iter().map(|(i, v)| (*i, -v)).collect();
                    slip.push((count, 1.0));
                    springs.push((slip, stiffness));
                    rows.push(vec![(count, 1.0)]);
                    count += 1;
                }
            }
            let (k, g) = matrices(parts, member, length);
            let mut q = Vector3::zeros();
            case.uniform
                .iter()
                .filter(|u| u.member as usize == m)
                .for_each(|u| q += Vector3::from(u.force_per_length));
            q.z -= case.gravity * parts.material.density * s.area;
            let mut local = turn * q;
            case.pressure
                .iter()
                .filter(|p| p.member as usize == m)
                .for_each(|p| local.z -= p.force_per_length);
            let kelvin: f64 =
                case.temperature.iter().filter(|t| t.member as usize == m).map(|t| t.kelvin).sum();
            let initial = -e * s.area * parts.material.thermal_expansion * kelvin;
            let mut fixed = DVector::zeros(12);
            for d in 0..3 {
                fixed[d] = 0.5 * length * local[d];
                fixed[d + 6] = 0.5 * length * local[d];
            }
            if member.kind != MemberKind::Truss {
                let moment = length * length / 12.0;
                (fixed[5], fixed[11]) = (moment * local.y, -moment * local.y);
                (fixed[4], fixed[10]) = (-moment * local.z, moment * local.z);
            }
            fixed[0] += initial;
            fixed[6] -= initial;
            placed.push(Placed { rows, axial: e * s.area / length, length, k, g, fixed, initial });
        }
        let mut dense = Self {
            k: DMatrix::zeros(count, count),
            f: DVector::zeros(count),
            held: vec![None; count],
            placed,
        };
        for load in &case.nodal {
            (0..6).for_each(|d| dense.f[6 * load.node as usize + d] += load.load[d]);
        }
        for p in &dense.placed {
            add(&mut dense.k, &p.rows, &p.k, 1.0);
            for (row, value) in p.rows.iter().zip(p.fixed.iter()) {
                row.iter().for_each(|(i, share)| dense.f[*i] += share * value);
            }
        }
        for (slip, stiffness) in &springs {
            for (i, a) in slip {
                slip.iter().for_each(|(j, b)| dense.k[(*i, *j)] += stiffness * a * b);
            }
        }
        for support in &parts.supports {
            for d in 0..6 {
                let at = 6 * support.node as usize + d;
                dense.k[(at, at)] += support.stiffness[d];
                if support.fixed[d] {
                    dense.held[at] = Some(0.0);
                }
            }
        }
        for moved in &case.settlements {
            (0..6).for_each(|d| {
                let held = &mut dense.held[6 * moved.node as usize + d];
                *held = held.map(|v| v + moved.displacement[d]);
            });
        }
        // Where only trusses meet there is no rotation.
        for n in 0..parts.nodes.len() as u32 {
            let beams = |m: &Member| m.kind != MemberKind::Truss && (m.start == n || m.end == n);
            if !parts.members.iter().any(beams) {
                (3..6).for_each(|d| dense.held[6 * n as usize + d] = Some(0.0));
            }
        }
        dense
    }

    /// K + s Kg(N) and what is free.
    fn matrix(&self, axial: &[f64], s: f64) -> DMatrix<f64> {
        let mut matrix = self.k.clone();
        self.placed.iter().zip(axial).for_each(|(p, n)| add(&mut matrix, &p.rows, &p.g, s * n));
        matrix
    }

    fn free(&self) -> Vec<usize> {
        (0..self.held.len()).filter(|&i| self.held[i].is_none()).collect()
    }

    /// Displacements with Kg of these N.
    fn solve(&self, axial: &[f64]) -> DVector<f64> {
        let matrix = self.matrix(axial, 1.0);
        let mut u = DVector::from_iterator(self.held.len(), self.held.iter().map(|h| h.unwrap_or(0.0)));
        let right = &self.f - &matrix * &u;
        let free = self.free();
        let k = matrix.select_rows(&free).select_columns(&free);
        let x = k.cholesky().expect("stable").solve(&right.select_rows(&free));
        free.iter().zip(x.iter()).for_each(|(&i, x)| u[i] = *x);
        u
    }

    fn ends(&self, p: &Placed, u: &DVector<f64>) -> DVector<f64> {
        let value = |row: &Vec<(usize, f64)>| row.iter().map(|(i, share)| share * u[*i]).sum();
        DVector::from_iterator(12, p.rows.iter().map(value))
    }

    /// N of each member.
    pub fn axial(&self, u: &DVector<f64>) -> Vec<f64> {
        let of = |p: &Placed| {
            let e = self.ends(p, u);
            p.axial * (e[6] - e[0]) + p.initial
        };
        self.placed.iter().map(of).collect()
    }

    /// First order: displacements (six a node, then the members' own) and N.
    pub fn first_order(&self) -> (DVector<f64>, Vec<f64>) {
        let u = self.solve(&vec![0.0; self.placed.len()]);
        let axial = self.axial(&u);
        (u, axial)
    }

    /// Second order, by iterating on N.
    pub fn second_order(&self) -> (DVector<f64>, Vec<f64>) {
        let (mut u, mut axial) = self.first_order();
        for _ in 0..200 {
            u = self.solve(&axial);
            let next = self.axial(&u);
            let change = axial.iter().zip(&next).fold(0.0f64, |a, (n, m)| a.max((n - m).abs()));
            axial = next;
            if change < 1e-12 * axial.iter().fold(0.0f64, |a, n| a.max(n.abs())) {
                break;
            }
        }
        (u, axial)
    }

    /// Forces at both ends of a member on the cut with normal +x: N Vy Vz Mt My Mz, twice.
    pub fn forces(&self, m: usize, u: &DVector<f64>, axial: Option<&[f64]>) -> [f64; 12] {
        let p = &self.placed[m];
        let k = axial.map_or(p.k.clone(), |n| &p.k + &p.g * n[m]);
        let f = k * self.ends(p, u) - &p.fixed;
        std::array::from_fn(|i| if i < 6 { -f[i] } else { f[i] })
    }

    /// Whether K + s Kg(N) is positive definite: whether no buckling factor lies below s.
    pub fn stands(&self, axial: &[f64], s: f64) -> bool {
        let free = self.free();
        self.matrix(axial, s).select_rows(&free).select_columns(&free).cholesky().is_some()
    }
}

fn add(matrix: &mut DMatrix<f64>, rows: &[Vec<(usize, f64)>], element: &DMatrix<f64>, factor: f64) {
    for (a, row) in rows.iter().enumerate() {
        for (b, column) in rows.iter().enumerate() {
            let value = factor * element[(a, b)];
            if value != 0.0 {
                for (i, x) in row {
                    column.iter().for_each(|(j, y)| matrix[(*i, *j)] += value * x * y);
                }
            }
        }
    }
}
