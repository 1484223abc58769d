//! Linear buckling: the smallest positive λ of (K + λ Kg) φ = 0.
//!
//! With M = K + s Kg positive definite (s below the first positive λ; s = 0 always will do), −Kg φ = ν M φ where
//! ν = 1 / (λ − s): the wanted λ are the largest ν. Block Lanczos with thick restarts (Wu, Simon 2000) in the inner
//! product of M, with full re-orthogonalisation; products with M never appear, because for w = M⁻¹ g the product
//! M w = g is at hand. The start block is random: starting from displacements would miss antisymmetric modes. A block
//! finds repeated factors as often as they are repeated.

use super::columns::Columns;
use super::solver::Solver;
use crate::random;
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use nalgebra_sparse::CscMatrix;

/// A buckling mode.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Load factor λ.
    pub factor: f64,
    /// Shape φ, in elimination order.
    pub shape: Vec<f64>,
}

/// The iteration did not settle (it never should not).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoConvergence;

/// How modes are found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// How many modes.
    pub modes: usize,
    /// Residual relative to the eigenvalue at which a mode counts as found; its λ is better than the square of that
    /// over its distance from the next.
    pub tolerance: f64,
}

/// Up to this many unknowns, or this many for each mode, the dense problem is solved.
const DENSE: usize = 150;
const DENSE_A_MODE: usize = 4;
/// Of ν beside the largest |ν|, below which there is no factor but rounding.
const NOTHING: f64 = 1e-10;
const RESTARTS: usize = 40;
/// Restarts after which the tolerance is eased tenfold, up to [`EASED`]: a stiffness whose digits are used up by its
/// own spread (bending 1e-11 of axial) cannot give a smaller residual.
const EASE_EVERY: usize = 6;
const EASED: f64 = 1e-4;
/// Share of a squared norm left by orthogonalisation, below which it is done again.
const CANCELLED: f64 = 1e-3;
/// Orthogonality fades only as Ritz vectors settle (Paige 1971): to rounding over the residual. While no residual is
/// below this, that is nothing, and a new block need only be made orthogonal to the last two.
const LOCAL: f64 = 1e-6;

/// The first modes, λ ascending, at most `search.modes`; fewer if there are no more positive factors.
///
/// # Errors
/// [`NoConvergence`].
pub fn modes(solver: &mut Solver<'_>, axial: &[f64], search: Search) -> Result<Vec<Mode>, NoConvergence> {
    if search.modes == 0 || axial.iter().all(|&n| n == 0.0) {
        return Ok(Vec::new());
    }
    let free = solver.system().held().iter().filter(|h| !**h).count();
    let search = Search { modes: search.modes.min(free), ..search };
    if free <= DENSE.max(DENSE_A_MODE * search.modes) {
        dense(solver, axial, search.modes)
    } else {
        Lanczos::new(solver, axial, search).run()
    }
}

/// All modes of a small model: L⁻¹ (−Kg) L⁻ᵀ with K = L Lᵀ.
fn dense(solver: &Solver<'_>, axial: &[f64], modes: usize) -> Result<Vec<Mode>, NoConvergence> {
    let n = solver.system().unknowns();
    let free: Vec<usize> = (0..n).filter(|&i| !solver.system().held()[i]).collect();
    let m = free.len();
    let of_free = |matrix: CscMatrix<f64>| {
        let whole = DMatrix::from(&matrix);
        whole.select_columns(&free).select_rows(&free)
    };
    let mut k = of_free(solver.stiffness_matrix());
    let mut g = -of_free(solver.geometric_matrix(axial));
    // Scaled to unit diagonal, so that units do not matter.
    let scale = DVector::from_fn(m, |i, _| 1.0 / k[(i, i)].sqrt());
    for j in 0..m {
        for i in 0..m {
            k[(i, j)] *= scale[i] * scale[j];
            g[(i, j)] *= scale[i] * scale[j];
        }
    }
    let l = k.cholesky().ok_or(NoConvergence)?.unpack();
    let half = l.solve_lower_triangular(&g).ok_or(NoConvergence)?;
    let mut a = l.solve_lower_triangular(&half.transpose()).ok_or(NoConvergence)?;
    a = (&a + a.transpose()) * 0.5;
    let eigen = SymmetricEigen::try_new(a, f64::EPSILON, 10_000).ok_or(NoConvergence)?;
    let largest = eigen.eigenvalues.amax();
    let mut order: Vec<usize> = (0..m).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    let mut found = Vec::new();
    for &i in order.iter().take(modes) {
        let nu = eigen.eigenvalues[i];
        if nu > NOTHING * largest {
            let shape = l.tr_solve_lower_triangular(&eigen.eigenvectors.column(i)).ok_or(NoConvergence)?;
            let mut whole = vec![0.0; n];
            for (j, &at) in free.iter().enumerate() {
                whole[at] = shape[j] * scale[j];
            }
            found.push(Mode { factor: 1.0 / nu, shape: whole });
        }
    }
    Ok(found)
}

/// The iteration's state: M-orthonormal V, W = M V, T = Vᵀ (−Kg) V.
struct Lanczos<'a, 'm> {
    solver: &'a mut Solver<'m>,
    axial: &'a [f64],
    search: Search,
    block: usize,
    most: usize,
    v: Columns,
    w: Columns,
    t: DMatrix<f64>,
    rng: random::Rng,
    /// Whether a new block is made orthogonal to the last two only.
    local: bool,
}

/// Eigenpairs of T, ν descending.
struct Ritz {
    values: Vec<f64>,
    vectors: DMatrix<f64>,
}

impl<'a, 'm> Lanczos<'a, 'm> {
    fn new(solver: &'a mut Solver<'m>, axial: &'a [f64], search: Search) -> Self {
        let n = solver.system().unknowns();
        let block = (search.modes + 1).clamp(2, 6);
        // Restarting keeps the wanted ones; there must be room to go on beside them.
        let most = (8 * block).max(40).max(2 * search.modes + 4 * block);
        Self {
            block,
            most,
            v: Columns::with_room(n, most),
            w: Columns::with_room(n, most),
            t: DMatrix::zeros(0, 0),
            rng: random::stream(0x6275_636b, 0, 0),
            local: search.tolerance > LOCAL,
            solver,
            axial,
            search,
        }
    }

    fn run(mut self) -> Result<Vec<Mode>, NoConvergence> {
        let (mut x, mut mx) = self.random_block();
        let asked = self.search.tolerance;
        for restart in 0..RESTARTS {
            let eased = asked * 10f64.powi((restart / EASE_EVERY) as i32);
            self.search.tolerance = eased.min(EASED).max(asked);
            while self.v.count() + x.count() <= self.most {
                let (z, g, remainder) = self.extend(x, mx);
                let ritz = self.ritz();
                if self.settled(&ritz, &remainder) {
                    return Ok(self.shapes(&ritz));
                }
                (x, mx) = (z, g);
                if x.count() == 0 {
                    // The space is exhausted; look for what it missed.
                    self.local = false;
                    (x, mx) = self.random_block();
                    if x.count() == 0 {
                        return Ok(self.shapes(&ritz));
                    }
                }
            }
            self.restart();
        }
        Err(NoConvergence)
    }

    /// A random block, M-orthonormal and orthogonal to V, with its product with M.
    fn random_block(&mut self) -> (Columns, Columns) {
        let n = self.v.n;
        let mut g =
            Columns { n, data: (0..n * self.block).map(|_| random::unit(&mut self.rng) - 0.5).collect() };
        for column in g.data.chunks_mut(n) {
            self.solver.system().hold_vector(column);
        }
        let mut z = Columns { n, data: g.data.clone() };
        self.solver.solve(&mut z.data);
        self.orthogonalise(&mut z, &mut g);
        self.orthogonalise(&mut z, &mut g);
        orthonormalise(&mut z, &mut g);
        (z, g)
    }

    fn orthogonalise(&self, z: &mut Columns, g: &mut Columns) {
        let c = self.w.inner_from(0, z);
        z.subtract(&self.v, 0, &c);
        g.subtract(&self.w, 0, &c);
    }

    /// Appends the block, and gives the next one with its M-product, and R with (what was left over) = next × R.
    fn extend(&mut self, x: Columns, mx: Columns) -> (Columns, Columns, DMatrix<f64>) {
        let before = self.v.count();
        let added = x.count();
        let mut g = Columns { n: x.n, data: vec![0.0; x.data.len()] };
        self.solver.minus_geometric(self.axial, &x.data, &mut g.data);
        self.v.data.extend_from_slice(&x.data);
        self.w.data.extend_from_slice(&mx.data);
        // T is block tridiagonal until a restart: coefficients of blocks before the last two are zero.
        let from = if self.local { before.saturating_sub(self.block) } else { 0 };
        let column = self.v.inner_from(from, &g);
        let size = before + added;
        let mut t = DMatrix::zeros(size, size);
        t.view_mut((0, 0), (before, before)).copy_from(&self.t);
        for j in 0..added {
            for i in from..size {
                t[(i, before + j)] = column[(i - from, j)];
                t[(before + j, i)] = column[(i - from, j)];
            }
        }
        self.t = t;
        let mut z = Columns { n: g.n, data: g.data.clone() };
        self.solver.solve(&mut z.data);
        let whole = squares(&z, &g);
        z.subtract(&self.v, from, &column);
        g.subtract(&self.w, from, &column);
        // Once is enough unless most of the block was cancelled (Daniel, Gragg, Kaufman, Stewart 1976).
        let kept = squares(&z, &g);
        if kept.iter().zip(&whole).any(|(kept, whole)| *kept < CANCELLED * whole) {
            self.orthogonalise(&mut z, &mut g);
        }
        let remainder = orthonormalise(&mut z, &mut g);
        (z, g, remainder)
    }

    fn ritz(&self) -> Ritz {
        let eigen = SymmetricEigen::new(self.t.clone());
        let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
        let vectors = eigen.eigenvectors.select_columns(&order);
        Ritz { values: order.iter().map(|&i| eigen.eigenvalues[i]).collect(), vectors }
    }

    /// Whether the wanted pairs have small residuals: those of the last block's remainder.
    fn settled(&self, ritz: &Ritz, remainder: &DMatrix<f64>) -> bool {
        let size = self.t.nrows();
        if size < self.search.modes.min(size) + self.block {
            return false;
        }
        let last = remainder.ncols();
        let largest = ritz.values.iter().fold(0.0f64, |a, v| a.max(v.abs()));
        (0..self.search.modes.min(size)).all(|i| {
            let tail = ritz.vectors.view((size - last, i), (last, 1));
            let residual = (remainder * tail).norm();
            // Where there is no positive factor, ν tends to 0 and is judged beside the largest.
            residual <= self.search.tolerance * ritz.values[i].max(NOTHING * largest)
                || (ritz.values[i] <= NOTHING * largest && residual <= 1e-6 * largest)
        })
    }

    fn shapes(&self, ritz: &Ritz) -> Vec<Mode> {
        let largest = ritz.values.iter().fold(0.0f64, |a, v| a.max(v.abs()));
        let wanted = ritz.values.iter().take(self.search.modes).filter(|v| **v > NOTHING * largest).count();
        let shapes = self.v.times(&ritz.vectors.columns(0, wanted).into_owned());
        (0..wanted)
            .map(|i| Mode {
                factor: 1.0 / ritz.values[i],
                shape: shapes.data[i * shapes.n..(i + 1) * shapes.n].to_vec(),
            })
            .collect()
    }

    /// Keeps the best Ritz vectors.
    fn restart(&mut self) {
        self.local = false;
        let ritz = self.ritz();
        let keep = (self.most / 3).max(self.search.modes + 2).min(self.v.count());
        let s = ritz.vectors.columns(0, keep).into_owned();
        self.v = self.v.times(&s);
        self.w = self.w.times(&s);
        self.t = DMatrix::from_diagonal(&DVector::from_column_slice(&ritz.values[..keep]));
    }
}

/// Squared M-norms of the columns of Z, with G = M Z.
fn squares(z: &Columns, g: &Columns) -> Vec<f64> {
    let product = |(z, g): (&[f64], &[f64])| z.iter().zip(g).map(|(z, g)| z * g).sum();
    z.data.chunks(z.n).zip(g.data.chunks(z.n)).map(product).collect()
}

/// Makes Z M-orthonormal (G = M Z), dropping what is not independent; Z before = Z after × the matrix returned.
fn orthonormalise(z: &mut Columns, g: &mut Columns) -> DMatrix<f64> {
    let gram = z.inner_from(0, g);
    let gram = (&gram + gram.transpose()) * 0.5;
    let eigen = SymmetricEigen::new(gram);
    let largest = eigen.eigenvalues.amax();
    let kept: Vec<usize> = (0..eigen.eigenvalues.len())
        .filter(|&i| {
            eigen.eigenvalues[i] > 1e-20 * largest.max(f64::MIN_POSITIVE) && eigen.eigenvalues[i] > 0.0
        })
        .collect();
    let vectors = eigen.eigenvectors.select_columns(&kept);
    let roots: Vec<f64> = kept.iter().map(|&i| eigen.eigenvalues[i].sqrt()).collect();
    let to_unit = DMatrix::from_fn(vectors.nrows(), kept.len(), |i, j| vectors[(i, j)] / roots[j]);
    *z = z.times(&to_unit);
    *g = g.times(&to_unit);
    DMatrix::from_fn(kept.len(), vectors.nrows(), |i, j| roots[i] * vectors[(j, i)])
}
