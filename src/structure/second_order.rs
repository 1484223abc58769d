//! Second order: (K + Kg(N)) u = f where N are the axial forces of u itself.
//!
//! Two ways. With a factor of P, all combinations together: u ← u + P⁻¹ (f − (K + Kg(N(u))) u), which is what a search
//! uses. With P = K it contracts like 1/λ; with the K of another height about as that differs from this one's, so that
//! one factor serves several heights. Factor by factor: each step solves with K + Kg(N) of the step before; it works up
//! to the critical load, costs a factorisation a step, and is what `frame` and the cases close to the critical load use.
//!
//! That an iteration settles does not prove that K + Kg is positive definite: motions that the load does not excite
//! are not seen. Whether it is, is for a Cholesky factorisation of K + Kg at the settled N to tell.

use super::solver::Solver;

/// Why an iteration in second order gave no answer.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Unstable {
    /// K + Kg is not positive definite.
    PastCritical,
    /// The axial forces did not settle.
    NoConvergence,
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
    /// several columns at once, each accelerated by its own last step (Anderson 1965, depth 1). `u` comes in as a first
    /// guess and goes out as the displacements. Gives false if they are not in sight.
    pub fn iterate(&mut self, f: &[f64], u: &mut [f64], aim: Aim, room: &mut Room) -> bool {
        let n = self.system().unknowns();
        room.image.resize(f.len(), 0.0);
        room.change.resize(f.len(), 0.0);
        let mut before: Option<Change> = None;
        let mut first = 0.0;
        for step in 0..MOST {
            room.change.copy_from_slice(f);
            for (left, u) in room.change.chunks_mut(n).zip(u.chunks(n)) {
                self.axial_forces(u, &mut room.axial);
                self.subtract_forces(u, aim.second_order.then_some(room.axial.as_slice()), left);
            }
            self.solve_as_factorised(&mut room.change);
            for ((image, change), u) in room.image.iter_mut().zip(&room.change).zip(u.iter()) {
                *image = u + change;
            }
            let now = self.largest_change(n, room);
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

    fn largest_change(&self, n: usize, room: &mut Room) -> Change {
        let largest = |v: &[f64]| v.iter().fold(0.0f64, |a, v| if v.is_nan() { *v } else { a.max(v.abs()) });
        let mut worst = Change::NONE;
        for (change, image) in room.change.chunks(n).zip(room.image.chunks(n)) {
            let moved = [largest(change), largest(image)];
            // N is linear in u.
            self.axial_forces(change, &mut room.axial);
            let change = largest(&room.axial);
            self.axial_forces(image, &mut room.axial);
            let ratio = |change: f64, size: f64| if change == 0.0 { 0.0 } else { change / size };
            worst = worst.worse(Change([ratio(moved[0], moved[1]), ratio(change, largest(&room.axial))]));
        }
        worst
    }

    /// Second order, factor by factor: (K + Kg(N)) u = f with N of u, from the `first`-order N, until N changes by no
    /// more than `tolerance` × max |N|. The last factor proves that the answer is stable.
    ///
    /// # Errors
    /// [`Unstable`] if K + Kg is not positive definite, or N does not settle.
    pub fn second_order(&mut self, f: &[f64], first: &[f64], tolerance: f64) -> Result<Vec<f64>, Unstable> {
        const MOST: usize = 200;
        let mut axial = first.to_vec();
        let mut next = Vec::new();
        for _ in 0..MOST {
            self.factorise_shifted(&axial, 1.0).map_err(|_| Unstable::PastCritical)?;
            let mut u = f.to_vec();
            self.solve_as_factorised(&mut u);
            let mut residual = f.to_vec();
            self.subtract_forces(&u, Some(&axial), &mut residual);
            self.solve_as_factorised(&mut residual);
            for (u, correction) in u.iter_mut().zip(&residual) {
                *u += correction;
            }
            self.axial_forces(&u, &mut next);
            let largest = next.iter().fold(0.0f64, |a, n| a.max(n.abs()));
            let change = next.iter().zip(&axial).fold(0.0f64, |a, (n, o)| a.max((n - o).abs()));
            std::mem::swap(&mut axial, &mut next);
            if change <= tolerance * largest {
                return match self.factorise_shifted(&axial, 1.0) {
                    Ok(()) => Ok(u),
                    Err(_) => Err(Unstable::PastCritical),
                };
            }
        }
        Err(Unstable::NoConvergence)
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
