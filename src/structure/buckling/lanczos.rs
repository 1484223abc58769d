//! −Kg φ = ν K φ where ν = 1/λ: the wanted λ are the largest ν. Block Lanczos with thick restarts (Wu, Simon 2000) in
//! the inner product of K, with full re-orthogonalisation; products with K never appear, because for w = K⁻¹ g the
//! product K w = g is at hand. The start block is random: starting from displacements would miss antisymmetric modes. A
//! block finds a repeated factor as often as it has columns, not more: what it finds is counted afterwards.

use super::super::columns::Columns;
use super::super::solver::Solver;
use super::{BELIEVED, Found, Mode, NOTHING, NoConvergence, Search};
use crate::random;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Restarts after which the factors are counted instead.
const RESTARTS: usize = 12;
/// Restarts after which what is believed is enough: a stiffness whose digits are used up by its own spread (bending
/// 1e-11 of axial) cannot give a smaller residual.
const EASED_AFTER: usize = 6;
/// Ritz values that differ by less than this share are one repeated factor.
const REPEATED: f64 = 1e-9;
/// Share of a squared norm left by orthogonalisation, below which it is done again.
const CANCELLED: f64 = 1e-3;
/// Orthogonality fades only as Ritz vectors settle (Paige 1971): to rounding over the residual. While no residual is
/// below this, that is nothing, and a new block need only be made orthogonal to the last two.
const LOCAL: f64 = 1e-6;

/// The iteration's state: M-orthonormal V, W = M V, T = Vᵀ (−Kg) V.
pub struct Lanczos<'a, 'm> {
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
    /// Ready to look for `search.modes` modes.
    pub fn new(solver: &'a mut Solver<'m>, axial: &'a [f64], search: Search) -> Self {
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

    /// The modes found, which may not be all.
    ///
    /// # Errors
    /// [`NoConvergence`] if the residuals do not become small.
    pub fn run(mut self) -> Result<Found, NoConvergence> {
        let (mut x, mut mx) = self.random_block();
        let asked = self.search.tolerance;
        for restart in 0..RESTARTS {
            self.search.tolerance = if restart < EASED_AFTER { asked } else { asked.max(BELIEVED) };
            while self.v.count() + x.count() <= self.most {
                let (z, g, remainder) = self.extend(x, mx);
                let ritz = self.ritz();
                if self.settled(&ritz, &remainder) {
                    return Ok(self.found(&ritz));
                }
                (x, mx) = (z, g);
                if x.count() == 0 {
                    // The space is exhausted; look for what it missed.
                    self.local = false;
                    (x, mx) = self.random_block();
                    if x.count() == 0 {
                        return Ok(self.found(&ritz));
                    }
                }
            }
            if self.restart() {
                break;
            }
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
        self.solver.solve_corrected(&mut z.data, self.search.corrections);
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
        self.solver.solve_corrected(&mut z.data, self.search.corrections);
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

    fn found(&self, ritz: &Ritz) -> Found {
        let largest = ritz.values.iter().fold(0.0f64, |a, v| a.max(v.abs()));
        let wanted = ritz.values.iter().take(self.search.modes).filter(|v| **v > NOTHING * largest).count();
        let shapes = self.v.times(&ritz.vectors.columns(0, wanted).into_owned());
        let mode = |i: usize| Mode {
            factor: 1.0 / ritz.values[i],
            shape: shapes.data[i * shapes.n..(i + 1) * shapes.n].to_vec(),
        };
        Found { modes: (0..wanted).map(mode).collect(), largest, tolerance: self.search.tolerance }
    }

    /// Keeps the best Ritz vectors. Whether going on is in vain: a factor repeated as often as the block has columns, or
    /// more often, is wanted, and no more of it would be seen.
    fn restart(&mut self) -> bool {
        self.local = false;
        let ritz = self.ritz();
        let wanted = &ritz.values[..self.search.modes.min(ritz.values.len())];
        let repeated = |run: &[f64]| run[0] - run[run.len() - 1] <= REPEATED * run[0].abs();
        let in_vain = wanted.windows(self.block).any(repeated);
        let keep = (self.most / 3).max(self.search.modes + 2).min(self.v.count());
        let s = ritz.vectors.columns(0, keep).into_owned();
        self.v = self.v.times(&s);
        self.w = self.w.times(&s);
        self.t = DMatrix::from_diagonal(&DVector::from_column_slice(&ritz.values[..keep]));
        in_vain
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
