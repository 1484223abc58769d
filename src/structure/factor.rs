//! Cholesky factors of matrices with a [`System`]'s sparsity. Buffers are reused; nothing is allocated per factor.

use super::system::{System, TooLarge};
use super::triangular;
use faer::Par;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::sparse::SparseColMatRef;
use faer::sparse::linalg::cholesky::supernodal::{self, SupernodalLltRef};

/// The matrix is not positive definite; the pivot of this unknown was the first that was not positive.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct NotPositive {
    /// The unknown, in elimination order.
    pub unknown: usize,
}

/// Room for one factor L of L Lᵀ and for solving with it.
pub struct Factor {
    values: Vec<f64>,
    memory: MemBuffer,
    /// Of a solve.
    room: Vec<f64>,
}

impl Factor {
    /// Room for factors of the system.
    ///
    /// # Errors
    /// [`TooLarge`].
    pub fn new(system: &System) -> Result<Self, TooLarge> {
        let symbolic = system.symbolic();
        let scratch = supernodal::factorize_supernodal_numeric_llt_scratch::<u32, f64>(
            symbolic,
            Par::Seq,
            Default::default(),
        )
        .or(supernodal::factorize_supernodal_numeric_intranode_lblt_scratch::<u32, f64>(
            symbolic,
            Par::Seq,
            Default::default(),
        ));
        let memory = MemBuffer::try_new(scratch).map_err(|_| TooLarge)?;
        // Whether it fits; then zeros that the kernel gives when they are first written to, which costs half as much as
        // to write them here.
        Vec::<f64>::new().try_reserve_exact(symbolic.len_val()).map_err(|_| TooLarge)?;
        Ok(Self { values: vec![0.0; symbolic.len_val()], memory, room: Vec::new() })
    }

    /// Factorises the matrix with these values.
    ///
    /// # Errors
    /// [`NotPositive`] if it is not positive definite (or holds a NaN).
    pub fn factorise(&mut self, system: &System, matrix: &[f64]) -> Result<(), NotPositive> {
        let lower = SparseColMatRef::new(system.lower(), matrix);
        let factored = supernodal::factorize_supernodal_numeric_llt(
            &mut self.values,
            lower,
            Default::default(),
            system.symbolic(),
            Par::Seq,
            MemStack::new(&mut self.memory),
            Default::default(),
        );
        match factored {
            Ok(_) => Ok(()),
            Err(LltError::NonPositivePivot { index }) => Err(NotPositive { unknown: index }),
        }
    }

    /// How many negative eigenvalues the matrix with these values has: the negative pivots of L D Lᵀ, with the pivots of
    /// a supernode in the best order (Bunch, Kaufman 1977). Takes the room of the factor. None if a pivot is not a
    /// number.
    pub fn negative_pivots(&mut self, system: &System, matrix: &[f64]) -> Option<usize> {
        let symbolic = system.symbolic();
        let n = system.unknowns();
        let (mut beside, mut forward, mut inverse) = (vec![0.0; n], vec![0u32; n], vec![0u32; n]);
        supernodal::factorize_supernodal_numeric_intranode_lblt(
            &mut self.values,
            &mut beside,
            &mut forward,
            &mut inverse,
            SparseColMatRef::new(system.lower(), matrix),
            symbolic,
            Par::Seq,
            MemStack::new(&mut self.memory),
            Default::default(),
        );
        let mut pivots = vec![0.0; n];
        self.diagonal(system, |unknown, pivot| pivots[unknown] = pivot);
        let mut negative = 0;
        let mut at = 0;
        while at < n {
            let (a, b) = (pivots[at], beside[at]);
            if !(a.is_finite() && b.is_finite()) {
                return None;
            }
            if b == 0.0 {
                negative += usize::from(a < 0.0);
                at += 1;
            } else {
                // A block [[a, b], [b, c]]: one of each sign, or two of the sign of the diagonal.
                let c = pivots[at + 1];
                negative += if a * c < b * b { 1 } else { 2 * usize::from(a < 0.0) };
                at += 2;
            }
        }
        Some(negative)
    }

    /// Solves in place for the columns of `rhs`, each `system.unknowns()` long.
    pub fn solve(&mut self, system: &System, rhs: &mut [f64]) {
        triangular::solve(system.symbolic(), &self.values, rhs, &mut self.room);
    }

    /// Calls `f(unknown, entry)` with the diagonal entries of the supernodes.
    fn diagonal(&self, system: &System, mut f: impl FnMut(usize, f64)) {
        let symbolic = system.symbolic();
        let factor = SupernodalLltRef::new(symbolic, &self.values);
        for s in 0..symbolic.n_supernodes() {
            let node = factor.supernode(s);
            let block = node.val();
            for j in 0..block.ncols() {
                f(node.start() + j, block[(j, j)]);
            }
        }
    }
}
