//! One model, assembled and factorised: first order, second order, axial forces, positive definiteness.
//!
//! Everything that does not depend on the sections (numbering, sparsity, symbolic factor, buffers) is made once by
//! [`Solver::new`]; [`Solver::set_sections`] is what a new height costs.
//!
//! Products with K and Kg come in two kinds. Where the matrix itself is wanted (small models, tests) it is assembled as
//! one of `nalgebra-sparse`. The iterations multiply member by member instead: 12 numbers a member are read in place of
//! 72 matrix entries, Kg(N) changes in every step so that its assembly would cost several products, and the residual of
//! the members' own deformations keeps the digits that cancel in a row of an assembled K.

use super::element::{self, EndActions, Ends, Stiffness};
use super::factor::{Factor, NotPositive};
use super::mechanism::{self, FreeMotion};
use super::model::{Frame3, FrameModel};
use super::section::Section;
use super::system::{DOFS, Slot, System, TooLarge};
use nalgebra::Vector3;
use nalgebra_sparse::CscMatrix;

/// A load combination: load case by index, times a factor.
pub type Combination = Vec<(usize, f64)>;

/// A model with its factorised stiffness. Vectors are in elimination order, `6 × nodes` long.
pub struct Solver<'m> {
    model: &'m FrameModel,
    system: System,
    sections: Vec<Section>,
    stiffness: Vec<Stiffness>,
    matrix: Vec<f64>,
    /// Whether `matrix` is K with the sections in use.
    assembled: bool,
    /// K + s Kg.
    shifted: Vec<f64>,
    /// There is room for one factor only: it is by far the largest thing here.
    factor: Factor,
    factored: Factored,
    /// The motion of a part as a whole that no support holds, whatever the sections.
    rigid: Option<FreeMotion>,
}

/// Displacements in two parts, of which the second is what rounding leaves out of the first. Where elements are short
/// and stiff, the last digit of a displacement is a large force: forces are those of both.
#[derive(Clone, Debug, PartialEq)]
pub struct Refined {
    /// The displacements, in elimination order.
    pub u: Vec<f64>,
    /// What is left out of them.
    pub rest: Vec<f64>,
}

impl Refined {
    /// The ends of a member in its local axes.
    pub fn ends(&self, slot: &Slot, axes: &Frame3) -> Ends {
        Ends::local_of(&self.u, &self.rest, slot.start, slot.end, axes)
    }

    /// The sum with a correction.
    pub fn plus(&self, correction: &[f64]) -> Self {
        let small: Vec<f64> = self.rest.iter().zip(correction).map(|(rest, c)| rest + c).collect();
        let u: Vec<f64> = self.u.iter().zip(&small).map(|(u, s)| u + s).collect();
        let rest = self.u.iter().zip(&u).zip(&small).map(|((old, new), s)| s - (new - old)).collect();
        Self { u, rest }
    }
}

/// What rounding does to displacements, in the norm of strain energy beside the whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounding {
    /// To those that the factor gives without a correction.
    pub uncorrected: f64,
    /// What is left of it.
    pub error: f64,
}

/// What the factor is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Factored {
    /// Nothing of use: none was made yet, or the last one failed.
    Nothing,
    /// K with the sections in use.
    Stiffness,
    /// Another positive definite matrix: K + s Kg, or one with former sections.
    Other,
}

/// Why a stiffness cannot be used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unsound {
    /// Something moves freely.
    Mechanism(FreeMotion),
    /// Nothing does, but rounding has used up all digits.
    IllConditioned,
    /// The numbers overflow.
    NotFinite,
}

impl<'m> Solver<'m> {
    /// Prepares the model; no stiffness yet.
    ///
    /// # Errors
    /// [`TooLarge`].
    pub fn new(model: &'m FrameModel) -> Result<Self, TooLarge> {
        let system = System::new(model)?;
        let factor = Factor::new(&system)?;
        Ok(Self {
            model,
            sections: Vec::new(),
            stiffness: Vec::with_capacity(model.members().len()),
            matrix: vec![0.0; system.values()],
            assembled: false,
            shifted: Vec::new(),
            factor,
            factored: Factored::Nothing,
            rigid: mechanism::rigid_motion(model, &system),
            system,
        })
    }

    /// The model.
    pub fn model(&self) -> &'m FrameModel {
        self.model
    }

    /// Its equation system.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// The sections in use.
    pub fn sections(&self) -> &[Section] {
        &self.sections
    }

    /// Stiffness numbers of each member.
    pub fn stiffness(&self) -> &[Stiffness] {
        &self.stiffness
    }

    /// Assembles and factorises the stiffness with these sections (one for each of the model's).
    ///
    /// # Errors
    /// [`Unsound`].
    pub fn set_sections(&mut self, sections: &[Section]) -> Result<(), Unsound> {
        self.use_sections(sections);
        self.assemble();
        if let Some(motion) = self.rigid {
            return Err(Unsound::Mechanism(motion));
        }
        let factored = self.refactorise();
        if self.matrix.iter().any(|v| !v.is_finite()) {
            return Err(Unsound::NotFinite);
        }
        // Members that resist every motion, joined rigidly and held, are no mechanism, however soft.
        if self.sections.iter().all(Section::resists_all) {
            return factored.map_err(|_| Unsound::IllConditioned);
        }
        self.factored = Factored::Nothing;
        let room = &mut self.factor;
        match mechanism::free_motion(self.model, &self.system, &self.stiffness, &self.matrix, room) {
            Some(motion) => Err(Unsound::Mechanism(motion)),
            // The search for a free motion has used the factor's room.
            None => self.refactorise().map_err(|_| Unsound::IllConditioned),
        }
    }

    /// Takes other sections without a factorisation. The factor stays what it was, good enough for
    /// [`Solver::iterate`] if the sections before were much the same; whatever needs K's own makes it.
    pub fn use_sections(&mut self, sections: &[Section]) {
        self.sections.clear();
        self.sections.extend_from_slice(sections);
        self.stiffness.clear();
        let count = self.model.members().len();
        self.stiffness.extend((0..count).map(|m| Stiffness::of_member(self.model, &self.sections, m)));
        self.assembled = false;
        if self.factored == Factored::Stiffness {
            self.factored = Factored::Other;
        }
    }

    /// Whether there is a factor of anything.
    pub fn has_factor(&self) -> bool {
        self.factored != Factored::Nothing
    }

    /// Factorises the stiffness once more: what everything else is measured against.
    ///
    /// # Errors
    /// [`NotPositive`].
    pub fn refactorise(&mut self) -> Result<(), NotPositive> {
        self.assemble();
        let outcome = self.factor.factorise(&self.system, &self.matrix);
        self.factored = if outcome.is_ok() { Factored::Stiffness } else { Factored::Nothing };
        outcome
    }

    fn assemble(&mut self) {
        if self.assembled {
            return;
        }
        self.matrix.fill(0.0);
        for (m, (axes, stiffness)) in self.model.axes().iter().zip(&self.stiffness).enumerate() {
            self.system.add(&mut self.matrix, m, &stiffness.global(axes), 1.0);
        }
        self.system.hold(&mut self.matrix, 1.0);
        self.assembled = true;
    }

    /// The uniform load on each member (N/m, global) of a combination, self weight included.
    pub fn member_loads(&self, combination: &[(usize, f64)], loads: &mut Vec<Vector3<f64>>) {
        loads.clear();
        loads.resize(self.model.members().len(), Vector3::zeros());
        let density = self.model.material().density;
        for &(case, factor) in combination {
            let case = &self.model.load_cases()[case];
            for load in &case.uniform {
                loads[load.member as usize] += Vector3::from(load.force_per_length) * factor;
            }
            if case.gravity != 0.0 {
                let weight = factor * case.gravity * density;
                for (load, member) in loads.iter_mut().zip(self.model.members()) {
                    load.z -= weight * self.sections[member.section as usize].area;
                }
            }
        }
    }

    /// The load vector of a combination with these member loads, held unknowns included.
    pub fn load_vector(&self, combination: &[(usize, f64)], member_loads: &[Vector3<f64>], f: &mut [f64]) {
        f.fill(0.0);
        for &(case, factor) in combination {
            for load in &self.model.load_cases()[case].nodal {
                let first = self.system.first(load.node);
                for (d, value) in load.load.iter().enumerate() {
                    f[first + d] += factor * value;
                }
            }
        }
        for ((q, axes), slot) in member_loads.iter().zip(self.model.axes()).zip(self.system.slots()) {
            let (force, moment) = element::uniform_load(axes, q);
            for d in 0..3 {
                f[slot.start + d] += force[d];
                f[slot.end + d] += force[d];
                f[slot.start + 3 + d] += moment[d];
                f[slot.end + 3 + d] -= moment[d];
            }
        }
    }

    /// Solves K u = f in place, for one or several columns. If the factor is of something else by now, K is
    /// factorised once more.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        if self.factored != Factored::Stiffness && self.refactorise().is_err() {
            // It was factorised before, by `set_sections`; without that there is no stiffness and no answer.
            rhs.fill(f64::NAN);
            return;
        }
        self.solve_as_factorised(rhs);
    }

    /// Solves K u = f in place, corrected `corrections` times with the residual of the elements' own forces. Gives the
    /// largest share of a column that the first correction was: what rounding does to an answer without one.
    pub fn solve_corrected(&mut self, rhs: &mut [f64], corrections: usize) -> f64 {
        if corrections == 0 {
            self.solve(rhs);
            return 0.0;
        }
        let n = self.system.unknowns();
        let f = rhs.to_vec();
        self.solve(rhs);
        let mut worst = 0.0f64;
        for (f, u) in f.chunks(n).zip(rhs.chunks_mut(n)) {
            let mut found = Refined { u: u.to_vec(), rest: vec![0.0; n] };
            for k in 0..corrections {
                let mut correction = self.residual(&found, None, f);
                self.solve(&mut correction);
                let change = if k == 0 { self.beside(&correction, &found.u) } else { 0.0 };
                worst = if change.is_nan() { f64::INFINITY } else { worst.max(change) };
                found = found.plus(&correction);
            }
            u.copy_from_slice(&found.u);
        }
        worst
    }

    /// Solves in place with whatever the factor is of.
    pub fn solve_as_factorised(&mut self, rhs: &mut [f64]) {
        for column in rhs.chunks_mut(self.system.unknowns()) {
            self.system.hold_vector(column);
        }
        self.factor.solve(&self.system, rhs);
    }

    /// First order: K u = f, refined with the residual of the elements' own end forces: once for a sound model, more
    /// often for a badly scaled one, until the nodes are in balance or come no nearer to it, and the displacements change
    /// no more. Gives also what rounding does.
    ///
    /// Balance alone proves nothing: in a chain of 50,000 elements a tip that is 40 % off is in balance to 1e-9.
    pub fn first_order(&mut self, f: &[f64]) -> (Refined, Rounding) {
        const MOST: usize = 40;
        const SMALL: f64 = 1e-10;
        const SETTLED: f64 = 1e-6;
        let mut u = f.to_vec();
        self.solve(&mut u);
        let mut found = Refined { rest: vec![0.0; u.len()], u };
        let mut imbalance = f64::INFINITY;
        let mut changes = Vec::new();
        for _ in 0..MOST {
            let mut correction = self.residual(&found, None, f);
            self.solve(&mut correction);
            let better = found.plus(&correction);
            let left = self.imbalance(&better, None, f);
            changes.push(self.beside(&correction, &better.u));
            let change = changes[changes.len() - 1];
            let nearer = left < imbalance || changes.len() > 1 && change < changes[changes.len() - 2];
            if !nearer {
                break;
            }
            (found, imbalance) = (better, left);
            if left <= SMALL && change <= SETTLED {
                break;
            }
        }
        (found, Rounding { uncorrected: changes[0], error: left_over(&changes) })
    }

    /// The error of displacements in (K + Kg(N)) u = f with the factor of K + Kg at hand: what one more correction
    /// would change, in the norm of strain energy beside the whole.
    pub fn error_of(&mut self, found: &Refined, axial: Option<&[f64]>, f: &[f64]) -> f64 {
        let mut correction = self.residual(found, axial, f);
        self.solve_as_factorised(&mut correction);
        self.beside(&correction, &found.u)
    }

    /// A part of displacements beside the whole, in the norm of strain energy; 0 where there is nothing.
    fn beside(&self, part: &[f64], whole: &[f64]) -> f64 {
        let part = self.twice_energy(part);
        if part == 0.0 { 0.0 } else { (part / self.twice_energy(whole)).sqrt() }
    }

    /// f − (K + Kg(N)) u.
    pub fn residual(&self, found: &Refined, axial: Option<&[f64]>, f: &[f64]) -> Vec<f64> {
        let mut left = f.to_vec();
        self.subtract_forces_of(|slot, axes| found.ends(slot, axes), axial, &mut left);
        left
    }

    /// How far the free nodes are from equilibrium: the largest force left over, relative to the largest force on a
    /// node, and the same for moments; the worse of the two.
    pub fn imbalance(&self, found: &Refined, axial: Option<&[f64]>, f: &[f64]) -> f64 {
        let left = self.residual(found, axial, f);
        let mut worst = [0.0f64; 2];
        let mut scale = [0.0f64; 2];
        for (i, (left, f)) in left.iter().zip(f).enumerate() {
            let kind = usize::from(i % DOFS > 2);
            // A reaction is part of what is in balance.
            scale[kind] = scale[kind].max(f.abs());
            if self.system.held()[i] {
                scale[kind] = scale[kind].max(left.abs());
            } else {
                worst[kind] = worst[kind].max(left.abs());
            }
        }
        let arm = self.model.axes().iter().fold(0.0f64, |a, axes| a.max(axes.length));
        let force = scale[0].max(scale[1] / arm);
        let moment = scale[1].max(scale[0] * arm);
        let ratio = |left: f64, scale: f64| if left > 0.0 { left / scale } else { 0.0 };
        ratio(worst[0], force).max(ratio(worst[1], moment))
    }

    /// r −= (K + Kg(N)) u, element by element.
    pub fn subtract_forces(&self, u: &[f64], axial: Option<&[f64]>, r: &mut [f64]) {
        self.subtract_forces_of(|slot, axes| Ends::read(u, slot.start, slot.end).local(axes), axial, r);
    }

    /// The same, given the ends of each member in its local axes.
    #[inline]
    fn subtract_forces_of(
        &self,
        ends: impl Fn(&Slot, &Frame3) -> Ends,
        axial: Option<&[f64]>,
        r: &mut [f64],
    ) {
        for (m, (axes, slot)) in self.model.axes().iter().zip(self.system.slots()).enumerate() {
            let ends = ends(slot, axes);
            let mut actions = self.stiffness[m].apply_local(&ends);
            if let Some(axial) = axial {
                let g = element::geometric_actions(&Vector3::x(), axes.length, axial[m], &ends);
                actions.force += g.force;
                actions.m1 += g.m1;
                actions.m2 += g.m2;
            }
            let back = |v: &Vector3<f64>| axes.x * v.x + axes.y * v.y + axes.z * v.z;
            let actions =
                EndActions { force: back(&actions.force), m1: back(&actions.m1), m2: back(&actions.m2) };
            scatter(&actions, slot.start, slot.end, -1.0, r);
        }
    }

    /// Twice the strain energy of displacements, from the deformations of the elements.
    pub fn twice_energy(&self, u: &[f64]) -> f64 {
        let members = self.model.axes().iter().zip(self.system.slots()).zip(&self.stiffness);
        members
            .map(|((axes, slot), k)| {
                k.twice_energy(&Ends::read(u, slot.start, slot.end).local(axes), axes.length)
            })
            .sum()
    }

    /// The mean axial force N of each member (tension positive): EA/L times the linear elongation.
    pub fn axial_forces(&self, u: &[f64], axial: &mut Vec<f64>) {
        axial.clear();
        let members = self.model.axes().iter().zip(self.system.slots()).zip(&self.stiffness);
        axial.extend(members.map(|((axes, slot), k)| {
            let (s, e) = (slot.start, slot.end);
            let stretch = Vector3::new(u[e] - u[s], u[e + 1] - u[s + 1], u[e + 2] - u[s + 2]);
            k.axial * axes.x.dot(&stretch)
        }));
    }

    /// The same of displacements in two parts.
    pub fn axial_forces_of(&self, found: &Refined, axial: &mut Vec<f64>) {
        axial.clear();
        let members = self.model.axes().iter().zip(self.system.slots()).zip(&self.stiffness);
        // The shift is that of the start less that of the end.
        axial.extend(members.map(|((axes, slot), k)| -k.axial * found.ends(slot, axes).shift.x));
    }

    /// y = −Kg(N) x, for several columns, without a matrix.
    pub fn minus_geometric(&self, axial: &[f64], x: &[f64], y: &mut [f64]) {
        let n = self.system.unknowns();
        y.fill(0.0);
        for (x, y) in x.chunks(n).zip(y.chunks_mut(n)) {
            for ((axes, slot), &tension) in self.model.axes().iter().zip(self.system.slots()).zip(axial) {
                let ends = Ends::read(x, slot.start, slot.end);
                let actions = element::geometric_actions(&axes.x, axes.length, tension, &ends);
                scatter(&actions, slot.start, slot.end, -1.0, y);
            }
            self.system.hold_vector(y);
        }
    }

    /// Factorises K + s Kg(N), in the room of the factor of K.
    ///
    /// # Errors
    /// [`NotPositive`] if it is not positive definite, that is (with N fixed) if s is past the critical factor.
    pub fn factorise_shifted(&mut self, axial: &[f64], s: f64) -> Result<(), NotPositive> {
        self.assemble_shifted(axial, s);
        let outcome = self.factor.factorise(&self.system, &self.shifted);
        self.factored = if outcome.is_ok() { Factored::Other } else { Factored::Nothing };
        outcome
    }

    fn assemble_shifted(&mut self, axial: &[f64], s: f64) {
        self.assemble();
        self.shifted.clear();
        self.shifted.extend_from_slice(&self.matrix);
        for (m, axes) in self.model.axes().iter().enumerate() {
            self.system.add(&mut self.shifted, m, &element::geometric(axes), s * axial[m]);
        }
        self.system.hold(&mut self.shifted, 1.0);
    }

    /// Whether K + s Kg(N) is positive definite: whether no factor lies below s. The factor then is of nothing.
    pub fn is_definite(&mut self, axial: &[f64], s: f64) -> bool {
        let definite = self.factorise_shifted(axial, s).is_ok();
        self.factored = Factored::Nothing;
        definite
    }

    /// How many factors λ of (K + λ Kg(N)) φ = 0 lie between 0 and s: the negative pivots of K + s Kg. The factor then
    /// is of nothing. None if a pivot is not a number.
    pub fn factors_below(&mut self, axial: &[f64], s: f64) -> Option<usize> {
        self.assemble_shifted(axial, s);
        self.factored = Factored::Nothing;
        self.factor.negative_pivots(&self.system, &self.shifted)
    }

    /// K with the held unknowns taken out (diagonal 1), assembled.
    pub fn stiffness_matrix(&self) -> CscMatrix<f64> {
        self.system.symmetric(&self.matrix)
    }

    /// Kg(N) with the held unknowns taken out (diagonal 0), assembled.
    pub fn geometric_matrix(&self, axial: &[f64]) -> CscMatrix<f64> {
        let mut values = vec![0.0; self.system.values()];
        for (m, axes) in self.model.axes().iter().enumerate() {
            self.system.add(&mut values, m, &element::geometric(axes), axial[m]);
        }
        self.system.hold(&mut values, 0.0);
        self.system.symmetric(&values)
    }
}

/// The error after corrections of these sizes: the last one times the rate at which they have shrunk. That of the first is
/// beside the whole, which is what the factor alone leaves.
fn left_over(changes: &[f64]) -> f64 {
    match *changes {
        [.., before, last] => last * (last / before).min(1.0),
        [only] => only * only.min(1.0),
        [] => 0.0,
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
