//! Sparse symmetric positive definite systems: LDLᵀ with a fill-reducing order, one thread, one order of sums.
//!
//! Up-looking factorisation after T. A. Davis, *Algorithm 849: a concise sparse Cholesky factorization package*
//! (ACM TOMS 31, 2005). Written out here because libraries choose their kernels by CPU: the last bits of a pattern
//! would then depend on the machine.

const NONE: u32 = u32::MAX;

/// A symmetric matrix being collected: the strict upper or lower entries, each pair once, and the diagonal.
pub struct Symmetric {
    /// Diagonal entries.
    pub diagonal: Vec<f64>,
    /// `(row, column, value)` with row ≠ column, each pair once.
    pub entries: Vec<(u32, u32, f64)>,
}

/// The factor L D Lᵀ = P A Pᵀ.
pub struct Factor {
    perm: Vec<u32>,
    start: Vec<usize>,
    rows: Vec<u32>,
    values: Vec<f64>,
    diagonal: Vec<f64>,
}

impl Factor {
    /// Factorises; `None` if a pivot is not positive.
    pub fn of(matrix: &Symmetric) -> Option<Self> {
        let pairs = matrix.entries.iter().map(|&(i, j, _)| [i, j]);
        Self::in_order(matrix, fill_reducing_order(matrix.diagonal.len(), pairs)?)
    }

    /// The same with the unknowns eliminated in a given order, a permutation of them.
    pub fn in_order(matrix: &Symmetric, perm: Vec<u32>) -> Option<Self> {
        let n = matrix.diagonal.len();
        let mut place = vec![0u32; n];
        for (new, &old) in perm.iter().enumerate() {
            place[old as usize] = new as u32;
        }
        // Upper triangle by columns of the permuted matrix: column j holds the rows i < j.
        let mut start = vec![0usize; n + 1];
        let upper = |&(i, j, _): &(u32, u32, f64)| {
            let (a, b) = (place[i as usize], place[j as usize]);
            (a.min(b), a.max(b))
        };
        for entry in &matrix.entries {
            start[upper(entry).1 as usize + 1] += 1;
        }
        for j in 0..n {
            start[j + 1] += start[j];
        }
        let mut fill = start.clone();
        let mut column = vec![(0u32, 0.0); matrix.entries.len()];
        for entry in &matrix.entries {
            let (i, j) = upper(entry);
            column[fill[j as usize]] = (i, entry.2);
            fill[j as usize] += 1;
        }
        let diagonal: Vec<f64> = perm.iter().map(|&old| matrix.diagonal[old as usize]).collect();
        numeric(perm, &start, &column, diagonal)
    }

    /// Solves A x = b in place.
    pub fn solve(&self, b: &mut [f64]) {
        let n = self.perm.len();
        let mut x: Vec<f64> = self.perm.iter().map(|&old| b[old as usize]).collect();
        for j in 0..n {
            let xj = x[j];
            let (rows, values) = self.column(j);
            for (&row, &value) in rows.iter().zip(values) {
                x[row as usize] -= value * xj;
            }
        }
        for (xj, d) in x.iter_mut().zip(&self.diagonal) {
            *xj /= d;
        }
        for j in (0..n).rev() {
            x[j] -= self.column_times(j, &x);
        }
        for (new, &old) in self.perm.iter().enumerate() {
            b[old as usize] = x[new];
        }
    }

    /// Rows and values of a column of L below the diagonal.
    #[inline(always)]
    fn column(&self, j: usize) -> (&[u32], &[f64]) {
        let entries = self.start[j]..self.start[j + 1];
        (&self.rows[entries.clone()], &self.values[entries])
    }

    /// A column of L below the diagonal times x, in four sums: one would wait for every addition before it begins the next.
    #[inline(always)]
    fn column_times(&self, j: usize, x: &[f64]) -> f64 {
        let (rows, values) = self.column(j);
        let (rows, rest) = rows.as_chunks::<4>();
        let (values, rest_values) = values.as_chunks::<4>();
        let mut sums = [0.0; 4];
        for (rows, values) in rows.iter().zip(values) {
            for k in 0..4 {
                sums[k] += values[k] * x[rows[k] as usize];
            }
        }
        let rest: f64 = rest.iter().zip(rest_values).map(|(&row, value)| value * x[row as usize]).sum();
        ((sums[0] + sums[1]) + (sums[2] + sums[3])) + rest
    }
}

/// An order that leaves few entries in the factor of a matrix with entries at `pairs`, each of them once: approximate minimum degree
/// (Amestoy, Davis, Duff 1996).
pub fn fill_reducing_order(n: usize, pairs: impl Iterator<Item = [u32; 2]> + Clone) -> Option<Vec<u32>> {
    let mut start = vec![0i32; n + 1];
    for i in pairs.clone().flatten() {
        start[i as usize + 1] += 1;
    }
    for i in 0..n {
        start[i + 1] += start[i];
    }
    let mut fill = start.clone();
    let mut rows = vec![0i32; start[n] as usize];
    for [i, j] in pairs {
        for (a, b) in [(i, j), (j, i)] {
            let slot = &mut fill[a as usize];
            rows[*slot as usize] = b as i32;
            *slot += 1;
        }
    }
    for j in 0..n {
        rows[start[j] as usize..start[j + 1] as usize].sort_unstable();
    }
    let (perm, _, _) = amd::order(n as i32, &start, &rows, &amd::Control::default()).ok()?;
    Some(perm.into_iter().map(|p| p as u32).collect())
}

fn numeric(perm: Vec<u32>, start: &[usize], column: &[(u32, f64)], mut diagonal: Vec<f64>) -> Option<Factor> {
    let n = perm.len();
    let (parent, counts) = elimination_tree(n, start, column);
    let mut factor_start = vec![0usize; n + 1];
    for j in 0..n {
        factor_start[j + 1] = factor_start[j] + counts[j];
    }
    let mut rows = vec![0u32; factor_start[n]];
    let mut values = vec![0.0; factor_start[n]];
    let mut filled = vec![0usize; n];
    let mut y = vec![0.0; n];
    let mut pattern = vec![0u32; n];
    let mut mark = vec![NONE; n];
    for k in 0..n {
        // Pattern of row k of L: the columns reached from the entries of column k in the elimination tree.
        let mut top = n;
        mark[k] = k as u32;
        for &(i, value) in &column[start[k]..start[k + 1]] {
            y[i as usize] += value;
            let mut length = 0;
            let mut i = i as usize;
            while mark[i] != k as u32 {
                pattern[length] = i as u32;
                mark[i] = k as u32;
                length += 1;
                i = parent[i] as usize;
            }
            while length > 0 {
                length -= 1;
                top -= 1;
                pattern[top] = pattern[length];
            }
        }
        for &i in &pattern[top..] {
            let i = i as usize;
            let yi = std::mem::take(&mut y[i]);
            let (from, to) = (factor_start[i], factor_start[i] + filled[i]);
            for p in from..to {
                y[rows[p] as usize] -= values[p] * yi;
            }
            let l = yi / diagonal[i];
            diagonal[k] -= l * yi;
            rows[to] = k as u32;
            values[to] = l;
            filled[i] += 1;
        }
        if diagonal[k].is_nan() || diagonal[k] <= 0.0 {
            return None;
        }
    }
    Some(Factor { perm, start: factor_start, rows, values, diagonal })
}

/// Parent of each column in the elimination tree and the number of entries below the diagonal.
fn elimination_tree(n: usize, start: &[usize], column: &[(u32, f64)]) -> (Vec<u32>, Vec<usize>) {
    let mut parent = vec![NONE; n];
    let mut counts = vec![0usize; n];
    let mut mark = vec![NONE; n];
    for k in 0..n {
        mark[k] = k as u32;
        for &(i, _) in &column[start[k]..start[k + 1]] {
            let mut i = i as usize;
            while mark[i] != k as u32 {
                if parent[i] == NONE {
                    parent[i] = k as u32;
                }
                counts[i] += 1;
                mark[i] = k as u32;
                i = parent[i] as usize;
            }
        }
    }
    (parent, counts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_grid_laplacian() {
        let n = 12u32;
        let mut matrix = Symmetric { diagonal: vec![4.0; (n * n) as usize], entries: Vec::new() };
        for i in 0..n {
            for j in 0..n {
                let v = i * n + j;
                if i + 1 < n {
                    matrix.entries.push((v, v + n, -1.0));
                }
                if j + 1 < n {
                    matrix.entries.push((v + 1, v, -1.0));
                }
            }
        }
        let exact: Vec<f64> = (0..n * n).map(|v| libm::sin(f64::from(v))).collect();
        let mut b: Vec<f64> = exact.iter().map(|x| 4.0 * x).collect();
        for &(i, j, value) in &matrix.entries {
            b[i as usize] += value * exact[j as usize];
            b[j as usize] += value * exact[i as usize];
        }
        Factor::of(&matrix).expect("positive definite").solve(&mut b);
        let error = b.iter().zip(&exact).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        assert!(error < 1e-12, "{error}");
    }

    #[test]
    fn an_indefinite_matrix_is_refused() {
        let matrix = Symmetric { diagonal: vec![1.0, 1.0], entries: vec![(0, 1, 2.0)] };
        assert!(Factor::of(&matrix).is_none());
    }
}
