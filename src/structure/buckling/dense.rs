//! All modes of a small model: L⁻¹ (−Kg) L⁻ᵀ with K = L Lᵀ.

use super::super::solver::Solver;
use super::{Found, Mode, NOTHING, NoConvergence};
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use nalgebra_sparse::CscMatrix;

/// The first `modes` of them, λ ascending.
///
/// # Errors
/// [`NoConvergence`] where rounding makes K indefinite or the eigenvalue iteration fails.
pub fn dense(solver: &Solver<'_>, axial: &[f64], modes: usize) -> Result<Found, NoConvergence> {
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
    Ok(Found { modes: found, largest, tolerance: f64::EPSILON })
}
