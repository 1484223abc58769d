//! One model, assembled and factorised: first order, second order, axial forces, positive definiteness.
//!
//! Everything that does not depend on the sections (numbering, sparsity, symbolic factor, buffers) is made once by
//! [`Solver::new`]; [`Solver::set_sections`] is what a new height costs.
//!
//! Products with K and Kg come in two kinds. Where the matrix itself is wanted (small models, tests) it is assembled as
//! one of `nalgebra-sparse`. The iterations multiply member by member instead: 12 numbers a member are read in place of
//! 72 matrix entries, Kg(N) changes in every step so that its assembly would cost several products, and the residual of
//! the members' own deformations keeps the digits that cancel in a row of an assembled K.

use super::action::Action;
use super::element::{self, Blocks, Stiffness};
use super::factor::{Factor, NotPositive};
use super::mechanism::{self, FreeMotion};
use super::model::FrameModel;
use super::section::Section;
use super::system::{Link, System, TooLarge};
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
    /// The springs of each member with joints, at its start and end, Nm/rad.
    joints: Vec<[Vector3<f64>; 2]>,
    /// The springs of supports: unknown and stiffness.
    springs: Vec<(usize, f64)>,
    /// Whether members, joints and springs of supports resist so much that only supports can be missing, given that the
    /// sections do.
    is_firm: bool,
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
            joints: Vec::new(),
            springs: model
                .springs()
                .iter()
                .map(|spring| (system.first(spring.node) + spring.direction, spring.stiffness))
                .collect(),
            is_firm: model.members().iter().all(|member| member.kind.is_firm()),
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

    /// The springs of each member with joints, at its start and end, Nm/rad.
    pub fn joints(&self) -> &[[Vector3<f64>; 2]] {
        &self.joints
    }

    /// The springs of supports: unknown and stiffness.
    pub fn springs(&self) -> &[(usize, f64)] {
        &self.springs
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
        // Members that resist every motion, joined rigidly or by springs and held, are no mechanism, however soft.
        if self.is_firm && self.sections.iter().all(Section::resists_all) {
            return factored.map_err(|_| Unsound::IllConditioned);
        }
        self.factored = Factored::Nothing;
        match self.free_motion() {
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
        self.joints.clear();
        self.joints.extend(self.system.turned().iter().map(|own| own.springs(&self.stiffness[own.member])));
        self.assembled = false;
        if self.factored == Factored::Stiffness {
            self.factored = Factored::Other;
        }
    }

    /// Whether there is a factor of anything.
    pub fn has_factor(&self) -> bool {
        self.factored != Factored::Nothing
    }

    fn free_motion(&mut self) -> Option<FreeMotion> {
        let structure = mechanism::Resisting {
            model: self.model,
            system: &self.system,
            stiffness: &self.stiffness,
            joints: &self.joints,
            springs: &self.springs,
        };
        mechanism::free_motion(&structure, &self.matrix, &mut self.factor)
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
            if let Link::Turned(j) = self.system.slots()[m].link {
                let (own, springs) = (&self.system.turned()[j as usize], &self.joints[j as usize]);
                let blocks = own.matrix(axes, &stiffness.global(&axes.local()), Some(springs));
                self.system.add_turned(&mut self.matrix, m, own, &blocks, 1.0);
            } else {
                self.system.add(&mut self.matrix, m, &stiffness.global(axes), 1.0);
            }
        }
        for &(unknown, stiffness) in &self.springs {
            self.matrix[self.system.diagonal(unknown)] += stiffness;
        }
        self.system.hold(&mut self.matrix, 1.0);
        self.assembled = true;
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
                let change = if k == 0 { self.beside(&correction, &found.u, 0.0) } else { 0.0 };
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
    pub fn first_order(&mut self, action: &Action) -> (Refined, Rounding) {
        const MOST: usize = 40;
        const SMALL: f64 = 1e-10;
        const SETTLED: f64 = 1e-6;
        let f = &action.f;
        let mut u = self.lifted(action, None);
        self.solve(&mut u);
        action.add_settled(&mut u);
        let mut found = Refined { rest: vec![0.0; u.len()], u };
        let mut imbalance = f64::INFINITY;
        let mut changes = Vec::new();
        for _ in 0..MOST {
            let mut correction = self.residual(&found, None, f);
            self.solve(&mut correction);
            let better = found.plus(&correction);
            let left = self.imbalance(&better, None, action);
            changes.push(self.beside(&correction, &better.u, action.noise));
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
    pub fn error_of(&mut self, found: &Refined, axial: Option<&[f64]>, action: &Action) -> f64 {
        let mut correction = self.residual(found, axial, &action.f);
        self.solve_as_factorised(&mut correction);
        self.beside(&correction, &found.u, action.noise)
    }

    /// A part of displacements beside the whole, in the norm of strain energy; 0 where there is nothing, or no more than
    /// `noise`.
    fn beside(&self, part: &[f64], whole: &[f64], noise: f64) -> f64 {
        let part = self.twice_energy(part);
        if part <= noise { 0.0 } else { (part / self.twice_energy(whole)).sqrt() }
    }

    /// How far the free nodes are from equilibrium: the largest force left over, relative to the largest force on a
    /// node, and the same for moments; the worse of the two.
    pub fn imbalance(&self, found: &Refined, axial: Option<&[f64]>, action: &Action) -> f64 {
        let left = self.residual(found, axial, &action.f);
        let mut worst = [0.0f64; 2];
        let mut scale = action.scale;
        for (i, (left, f)) in left.iter().zip(&action.f).enumerate() {
            let kind = usize::from(self.system.is_rotation(i));
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
        let mut shifted = std::mem::take(&mut self.shifted);
        self.add_geometric(&mut shifted, axial, s);
        self.shifted = shifted;
        self.system.hold(&mut self.shifted, 1.0);
    }

    /// Adds s Kg(N) to the values of a matrix.
    fn add_geometric(&self, values: &mut [f64], axial: &[f64], s: f64) {
        for (m, (axes, slot)) in self.model.axes().iter().zip(self.system.slots()).enumerate() {
            let factor = s * axial[m];
            let blocks: Blocks = match slot.link {
                Link::Rigid => element::geometric(axes),
                Link::Truss => element::geometric_of_truss(axes),
                Link::Turned(j) => {
                    let own = &self.system.turned()[j as usize];
                    let blocks = own.matrix(axes, &element::geometric(&axes.local()), None);
                    self.system.add_turned(values, m, own, &blocks, factor);
                    continue;
                }
            };
            self.system.add(values, m, &blocks, factor);
        }
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
        self.add_geometric(&mut values, axial, 1.0);
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
