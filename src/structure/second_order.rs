//! Second order: (K + Kg(N)) u = f where N are the axial forces of u itself.
//!
//! Two ways. With a factor of P, all combinations together: u ← u + P⁻¹ (f − (K + Kg(N(u))) u), which is what a search
//! uses. With P = K it contracts like 1/λ; with the K of another height about as that differs from this one's, so that
//! one factor serves several heights. Factor by factor: each step solves with K + Kg(N) of the step before; it works up
//! to the critical load, costs a factorisation a step, and is what `frame` and the cases close to the critical load use.
//!
//! An iterate past the critical load proves nothing, for the first-order N may be far from those of equilibrium. So where
//! one is met, or N does not settle, the load is followed from nothing in steps that adapt; only where no step however
//! small goes further is the structure unstable, or the iteration at its end. Which of the two tells the state reached.
//!
//! That an iteration settles does not prove that K + Kg is positive definite: motions that the load does not excite
//! are not seen. Whether it is, is for a Cholesky factorisation of K + Kg at the settled N to tell.
//!
//! Nor does a definite K + Kg prove that the state lies on the path from nothing: N is that of u, so that the tangent is
//! K + Kg(N(u)) + Kg(N(·)) u = (K + Kg) (1 − J), and beyond a limit point, on the way back of a shallow arch, J has a
//! real eigenvalue above 1 though K + Kg is definite. The largest is found by Arnoldi's method with the factor at hand. A
//! state at which it is small is taken at once; where it is not, the load is followed to it.

use super::action::Action;
use super::solver::{Refined, Solver};
use crate::random;
use nalgebra::{DMatrix, DVector};

/// Why there is no answer in second order.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Reason {
    /// K + Kg is not positive definite, or the displacements grow without bounds.
    PastCritical,
    /// The axial forces do not settle, though nothing says that the structure gives way.
    NoConvergence,
}

/// Where the path of equilibrium ends before the whole load is on.
#[derive(Clone, PartialEq, Debug)]
pub struct Lost {
    /// Why.
    pub reason: Reason,
    /// The share of the load up to which there is an answer.
    pub share: f64,
    /// The axial forces there, N.
    pub axial: Vec<f64>,
}

/// The least step in which the load is followed, as a share of what is on already: how closely the critical load is told.
/// Its square, as a share of the whole, is how small a load still counts.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LeastStep(pub f64);

/// Where the path ends, K + Kg with Kg this many steps further must be indefinite, or the displacements must grow this
/// many times faster than at first, for the structure to be called unstable.
const BEYOND: f64 = 4.0;
const FASTER: f64 = 8.0;
/// Or the largest real eigenvalue of J must be beyond this.
const LIMIT: f64 = 0.8;
/// Factorisations for one equilibrium: of the whole load at once, and of a step.
const MOST_AT_ONCE: usize = 100;
const MOST_IN_STEP: usize = 40;
/// Corrections of the displacements of one factorisation.
const MOST_CORRECTIONS: usize = 4;
/// Steps of the iteration by which the next is corrected, and the share of the largest singular value below which they
/// count as dependent.
const DEPTH: usize = 10;
const INDEPENDENT: f64 = 1e-10;
/// Tolerance of the states in between.
const ON_THE_WAY: f64 = 1e-6;
/// Change of the displacements in the norm of strain energy, beside the whole, that is as good as none. Unlike that of
/// the axial forces it does not drown in rounding where N is next to nothing: EA/L times the last digit of a large
/// displacement is a large force, but a small energy.
const ENERGY: f64 = 1e-10;
/// A change that shrinks less than this shrinks no more.
const SHRINKS: f64 = 0.5;

/// The largest real eigenvalue of J up to which the whole load is put on at once, and by how much it may grow in a step.
const MILD: f64 = 0.5;
const GROWS: f64 = 0.25;
/// Steps of Arnoldi's method, and the change of the eigenvalue, beside it or beside 1, at which it ends.
const KRYLOV: usize = 40;
const RITZ: f64 = 1e-3;
/// Steps before which that is no sign, and the imaginary part beside the whole that is rounding.
const LEAST_KRYLOV: usize = 10;
const REAL: f64 = 1e-6;
/// Displacements that differ by less than this share, in the norm of strain energy, are those of one state.
const SAME_STATE: f64 = 1e-6;

/// A state of equilibrium.
struct State {
    found: Refined,
    axial: Vec<f64>,
    /// The largest real eigenvalue of J there, at least 0: 1 at a limit point.
    feedback: f64,
}

/// Steps of the iteration with one factor; those that shrink the change so slowly that it would not do leave
/// earlier.
const MOST: usize = 40;
/// Steps after which the change must have shrunk to a [`PATIENCE`]-th power of [`SLOWEST`].
const PATIENCE: i32 = 8;
const SLOWEST: f64 = 0.75;

/// Room that the iteration keeps between calls.
#[derive(Debug, Default)]
pub struct Room {
    /// g(u), the next iterate.
    image: Vec<f64>,
    /// g(u) − u.
    change: Vec<f64>,
    /// The two of the step before.
    image_before: Vec<f64>,
    change_before: Vec<f64>,
    axial: Vec<f64>,
}

/// How much a step changed: displacements and axial forces, each beside their largest.
#[derive(Clone, Copy, Debug)]
struct Change([f64; 2]);

impl Change {
    const NONE: Self = Self([0.0; 2]);

    fn worse(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i].max(other.0[i])))
    }

    /// Whether the next step can be expected to change nothing by more than `tolerance`: this one did not, or it would
    /// not if it shrank the change only half as well as this one.
    fn settled(self, before: Option<Self>, tolerance: f64) -> bool {
        self.0.iter().enumerate().all(|(i, &change)| {
            let shrinks = before.map_or(1.0, |before| (2.0 * change / before.0[i]).min(1.0));
            change * if shrinks.is_nan() { 1.0 } else { shrinks } <= tolerance
        })
    }
}

/// What an iteration is to find.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aim {
    /// Whether Kg(N(u)) counts: second order, else first.
    pub second_order: bool,
    /// Share of their largest by which neither u nor N may still change.
    pub tolerance: f64,
}

impl Solver<'_> {
    /// First or second order with the factor at hand, be it of K, of K + Kg or of the K of similar sections, for
    /// several columns at once, each accelerated by its own last step (Anderson 1965, depth 1). `initial`: the axial forces
    /// of each column if all ends were held. `u` comes in as a first guess and goes out as the displacements. Gives false
    /// if they are not in sight.
    pub fn iterate(
        &mut self,
        f: &[f64],
        initial: &[&[f64]],
        u: &mut [f64],
        aim: Aim,
        room: &mut Room,
    ) -> bool {
        let n = self.system().unknowns();
        room.image.resize(f.len(), 0.0);
        room.change.resize(f.len(), 0.0);
        let mut before: Option<Change> = None;
        let mut first = 0.0;
        for step in 0..MOST {
            room.change.copy_from_slice(f);
            for ((left, u), initial) in room.change.chunks_mut(n).zip(u.chunks(n)).zip(initial) {
                self.axial_forces(u, initial, &mut room.axial);
                self.subtract_forces(u, aim.second_order.then_some(room.axial.as_slice()), left);
            }
            self.solve_as_factorised(&mut room.change);
            for ((image, change), u) in room.image.iter_mut().zip(&room.change).zip(u.iter()) {
                *image = u + change;
            }
            let now = self.largest_change(n, initial, room);
            if now.settled(before, aim.tolerance) {
                u.copy_from_slice(&room.image);
                return u.iter().all(|v| v.is_finite());
            }
            if step == 0 {
                first = now.0[1];
            }
            let hopeless = step as i32 == PATIENCE && now.0[1] > first * SLOWEST.powi(PATIENCE);
            if hopeless || !now.0.iter().all(|change| change.is_finite()) {
                return false;
            }
            for (k, u) in u.chunks_mut(n).enumerate() {
                room.next_iterate(k * n..(k + 1) * n, before.is_some(), u);
            }
            std::mem::swap(&mut room.image, &mut room.image_before);
            std::mem::swap(&mut room.change, &mut room.change_before);
            room.image.resize(f.len(), 0.0);
            room.change.resize(f.len(), 0.0);
            before = Some(now);
        }
        false
    }

    fn largest_change(&self, n: usize, initial: &[&[f64]], room: &mut Room) -> Change {
        let largest = |v: &[f64]| v.iter().fold(0.0f64, |a, v| if v.is_nan() { *v } else { a.max(v.abs()) });
        let mut worst = Change::NONE;
        for ((change, image), initial) in room.change.chunks(n).zip(room.image.chunks(n)).zip(initial) {
            let moved = [largest(change), largest(image)];
            // N is linear in u.
            self.axial_forces(change, &[], &mut room.axial);
            let change = largest(&room.axial);
            self.axial_forces(image, initial, &mut room.axial);
            let ratio = |change: f64, size: f64| if change == 0.0 { 0.0 } else { change / size };
            worst = worst.worse(Change([ratio(moved[0], moved[1]), ratio(change, largest(&room.axial))]));
        }
        worst
    }

    /// Second order, factor by factor: (K + Kg(N)) u = f with N of u, at once from the `first`-order N, else following
    /// the load in steps, until N changes by no more than `tolerance` × max |N| or rounding lets it come no nearer. The
    /// last factor proves that the answer is stable.
    ///
    /// # Errors
    /// [`Lost`] where the path of equilibrium ends before.
    pub fn second_order(
        &mut self,
        action: &Action,
        first: &[f64],
        tolerance: f64,
        least: LeastStep,
    ) -> Result<Refined, Lost> {
        let at_once = match self.equilibrium(action, first.to_vec(), tolerance, MOST_AT_ONCE) {
            Ok(state) if state.feedback <= MILD => return Ok(state.found),
            Ok(state) => Some(state),
            Err(_) => None,
        };
        let followed = self.follow(action, first, tolerance, least)?;
        Ok(match at_once {
            // The same state; with its own last digits.
            Some(state) if self.is_same(&state.found.u, &followed.u, SAME_STATE, action.noise) => state.found,
            _ => followed,
        })
    }

    /// The largest real eigenvalue of J = −(K + Kg)⁻¹ Kg(N(·)) u, at least 0, with the factor of K + Kg at hand: by
    /// Arnoldi's method on N, whose norm is that of the strain energy of N.
    fn feedback(&mut self, u: &[f64]) -> f64 {
        let weights: Vec<f64> = self.stiffness().iter().map(|k| 1.0 / k.axial.sqrt()).collect();
        let m = weights.len();
        let mut rng = random::stream(0x6172_6e6f, 0, 0);
        let mut next = DVector::from_fn(m, |_, _| random::unit(&mut rng) - 0.5);
        let (mut axial, mut image) = (Vec::new(), vec![0.0; u.len()]);
        let mut basis: Vec<DVector<f64>> = Vec::new();
        let mut h = DMatrix::<f64>::zeros(KRYLOV + 1, KRYLOV);
        let mut largest = 0.0f64;
        let mut size = next.norm();
        for step in 0..KRYLOV.min(m) {
            basis.push(next / size);
            axial.clear();
            axial.extend(basis[step].iter().zip(&weights).map(|(y, w)| y / w));
            self.minus_geometric(&axial, u, &mut image);
            self.solve_as_factorised(&mut image);
            self.axial_forces(&image, &[], &mut axial);
            next = DVector::from_iterator(m, axial.iter().zip(&weights).map(|(n, w)| n * w));
            // Twice, so that it stays orthogonal to rounding.
            for _ in 0..2 {
                for (i, v) in basis.iter().enumerate() {
                    let part = v.dot(&next);
                    h[(i, step)] += part;
                    next.axpy(-part, v, 1.0);
                }
            }
            size = next.norm();
            h[(step + 1, step)] = size;
            if !size.is_finite() {
                return f64::INFINITY;
            }
            let before = largest;
            largest = largest_real(&h.view((0, 0), (step + 1, step + 1)).into_owned());
            let settled = (largest - before).abs() <= RITZ * largest.max(1.0);
            if size <= f64::EPSILON || (settled && step + 1 >= LEAST_KRYLOV) {
                break;
            }
        }
        largest
    }

    /// The equilibrium under a load, from a guess of N.
    fn equilibrium(
        &mut self,
        action: &Action,
        mut axial: Vec<f64>,
        tolerance: f64,
        most: usize,
    ) -> Result<State, Reason> {
        let mut next = Vec::new();
        let (mut before, mut change_before): (Option<Vec<f64>>, f64) = (None, f64::INFINITY);
        let mut mixing = Mixing::default();
        for _ in 0..most {
            self.factorise_shifted(&axial, 1.0).map_err(|_| Reason::PastCritical)?;
            let mut u = self.lifted(action, Some(&axial));
            self.solve_as_factorised(&mut u);
            action.add_settled(&mut u);
            let found = Refined { rest: vec![0.0; u.len()], u };
            let found = self.refined(found, &axial, action, tolerance, &mut next);
            let largest = next.iter().fold(0.0f64, |a, n| a.max(n.abs()));
            let change = largest_difference(&next, &axial);
            let settled = change <= tolerance * largest
                || (change > SHRINKS * change_before
                    && before.as_ref().is_some_and(|before| {
                        self.is_same(&found.u, before, tolerance.max(ENERGY), action.noise)
                    }));
            if settled {
                self.factorise_shifted(&next, 1.0).map_err(|_| Reason::PastCritical)?;
                let mut correction = self.residual(&found, Some(&next), &action.f);
                self.solve_as_factorised(&mut correction);
                // As long as it is one of rounding; else N has changed with it.
                let refined = found.plus(&correction);
                let is_same = self.is_same(&refined.u, &found.u, tolerance.max(ENERGY), action.noise);
                let found = if is_same { refined } else { found };
                let feedback = self.feedback(&found.u);
                if feedback >= 1.0 {
                    // An equilibrium, but beyond a limit point: no load from nothing leads there.
                    return Err(Reason::PastCritical);
                }
                return Ok(State { found, axial: next, feedback });
            }
            mixing.step(&mut axial, &next);
            (before, change_before) = (Some(found.u), change);
        }
        Err(Reason::NoConvergence)
    }

    /// Corrects displacements with the factor of K + Kg(N) at hand until their own axial forces, `next`, no longer change
    /// beside the tolerance: close to the critical load, and where members are slender, once is not enough.
    fn refined(
        &mut self,
        mut found: Refined,
        axial: &[f64],
        action: &Action,
        tolerance: f64,
        next: &mut Vec<f64>,
    ) -> Refined {
        let mut before = Vec::new();
        self.axial_forces_of(&found, &action.initial, next);
        for _ in 0..MOST_CORRECTIONS {
            let mut correction = self.residual(&found, Some(axial), &action.f);
            self.solve_as_factorised(&mut correction);
            found = found.plus(&correction);
            std::mem::swap(&mut before, next);
            self.axial_forces_of(&found, &action.initial, next);
            let largest = next.iter().fold(0.0f64, |a, n| a.max(n.abs()));
            if largest_difference(next, &before) <= 0.1 * tolerance * largest {
                break;
            }
        }
        found
    }

    /// Whether two displacements differ by no more than a share of the first, in the norm of strain energy, or by no more
    /// energy than `noise`.
    fn is_same(&self, u: &[f64], v: &[f64], share: f64, noise: f64) -> bool {
        let change: Vec<f64> = u.iter().zip(v).map(|(u, v)| u - v).collect();
        self.twice_energy(&change) <= share * share * self.twice_energy(u) + noise
    }

    /// The load from nothing to the whole, in steps that halve where there is no equilibrium in sight.
    fn follow(
        &mut self,
        action: &Action,
        first: &[f64],
        tolerance: f64,
        LeastStep(least): LeastStep,
    ) -> Result<Refined, Lost> {
        let largest = |v: &[f64]| v.iter().fold(0.0f64, |a, v| a.max(v.abs()));
        let mut share = 0.0;
        let mut axial = vec![0.0; first.len()];
        let mut u = vec![0.0; action.f.len()];
        // How fast the displacements grow with the share: at first, and in the last step.
        let (mut slow, mut fast) = (0.0, 0.0);
        // How N grows with the share: at first as in first order, then as in the step before.
        let mut growth = first.to_vec();
        let mut step = 0.5f64;
        let mut feedback = 0.0;
        loop {
            let next = (share + step).min(1.0);
            let guess = axial.iter().zip(&growth).map(|(n, g)| n + (next - share) * g).collect();
            let (tolerance, most) =
                if next == 1.0 { (tolerance, MOST_AT_ONCE) } else { (ON_THE_WAY, MOST_IN_STEP) };
            let state = self.equilibrium(&action.scaled(next), guess, tolerance, most);
            // What is far from the state before may lie on another path.
            let jumps = |state: &State| state.feedback > MILD && state.feedback > feedback + GROWS;
            match state {
                Ok(state) if jumps(&state) && step > least * share.max(least) => step *= 0.5,
                Ok(state) if next == 1.0 => return Ok(state.found),
                Ok(state) => {
                    let taken = next - share;
                    let moved: Vec<f64> = state.found.u.iter().zip(&u).map(|(u, old)| u - old).collect();
                    fast = largest(&moved) / taken;
                    slow = if share == 0.0 { fast } else { slow };
                    u = state.found.u;
                    growth = state.axial.iter().zip(&axial).map(|(n, o)| (n - o) / taken).collect();
                    (share, axial, feedback) = (next, state.axial, state.feedback);
                    step = (1.5 * taken).min(1.0 - share);
                }
                Err(_) if step > least * share.max(least) => step *= 0.5,
                Err(_) => {
                    // At a limit point they grow without bounds, at a bifurcation K + Kg loses its definiteness.
                    let ahead: Vec<f64> =
                        axial.iter().zip(&growth).map(|(n, g)| n + BEYOND * step * g).collect();
                    let gives_way = share == 0.0
                        || feedback > LIMIT
                        || fast > FASTER * slow
                        || !self.is_definite(&ahead, 1.0);
                    let reason = if gives_way { Reason::PastCritical } else { Reason::NoConvergence };
                    return Err(Lost { reason, share, axial });
                }
            }
        }
    }
}

/// The largest real eigenvalue of a small matrix, at least 0.
fn largest_real(h: &DMatrix<f64>) -> f64 {
    let values = h.complex_eigenvalues();
    values.iter().filter(|v| v.im.abs() <= REAL * v.norm()).fold(0.0, |a, v| a.max(v.re))
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |largest, (a, b)| largest.max((a - b).abs()))
}

/// The last steps of an iteration N ← g(N), oldest first.
#[derive(Default)]
struct Mixing {
    /// g(N) and g(N) − N.
    steps: Vec<(DVector<f64>, DVector<f64>)>,
}

impl Mixing {
    /// N ← g(N), `image`; corrected so that the change, if g were linear, would be least (Anderson 1965): as Newton's
    /// method would, which for this g is not symmetric.
    fn step(&mut self, axial: &mut Vec<f64>, image: &[f64]) {
        let image = DVector::from_column_slice(image);
        let change = &image - DVector::from_column_slice(axial);
        self.steps.push((image, change));
        if self.steps.len() > DEPTH + 1 {
            self.steps.remove(0);
        }
        let last = self.steps.len() - 1;
        let (image, change) = &self.steps[last];
        let differences: Vec<DVector<f64>> = self.steps.windows(2).map(|w| &w[1].1 - &w[0].1).collect();
        // Scaled to unit length, so that old steps, which were longer, do not drown the new ones.
        let sizes: Vec<f64> = differences.iter().map(|d| d.norm().max(f64::MIN_POSITIVE)).collect();
        let product = |i: usize, j: usize| differences[i].dot(&differences[j]) / (sizes[i] * sizes[j]);
        let right = DVector::from_fn(last, |i, _| differences[i].dot(change) / sizes[i]);
        let products = DMatrix::from_fn(last, last, product);
        let mut next = image.clone();
        if last > 0
            && products.iter().chain(&right).all(|v| v.is_finite())
            && let Ok(inverse) = products.pseudo_inverse(INDEPENDENT)
        {
            for (i, share) in (inverse * right).iter().enumerate() {
                next -= (&self.steps[i + 1].0 - &self.steps[i].0) * (share / sizes[i]);
            }
        }
        axial.clear();
        axial.extend_from_slice(next.as_slice());
    }
}

impl Room {
    /// The next iterate of a column: g(u), corrected by the step before so that the change, if the iteration were
    /// linear along it, would be least.
    fn next_iterate(&self, column: std::ops::Range<usize>, has_before: bool, u: &mut [f64]) {
        let image = &self.image[column.clone()];
        if !has_before {
            u.copy_from_slice(image);
            return;
        }
        let (change, before) = (&self.change[column.clone()], &self.change_before[column.clone()]);
        let (mut product, mut square) = (0.0, 0.0);
        for (now, before) in change.iter().zip(before) {
            let difference = now - before;
            product += now * difference;
            square += difference * difference;
        }
        let theta = if square > 0.0 { product / square } else { 0.0 };
        for ((u, now), before) in u.iter_mut().zip(image).zip(&self.image_before[column]) {
            *u = now - theta * (now - before);
        }
    }
}
