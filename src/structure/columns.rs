//! Tall thin blocks of vectors, and the three products the eigenvalue iteration spends its time in.
//!
//! The blocks are a few columns wide. A general matrix product packs its operands first, which here costs several
//! times the work itself; these loops read every column of the basis once.

use crate::simd::wide;
use nalgebra::DMatrix;

/// Rows treated together, so that the narrow operand stays in the first-level cache.
const STRIP: usize = 1024;
/// Sums kept side by side in a dot product: fixed, so that the result does not depend on the machine.
const LANES: usize = 8;

/// Columns of length `n`, one after the other.
pub struct Columns {
    /// Length of a column.
    pub n: usize,
    /// The columns.
    pub data: Vec<f64>,
}

impl Columns {
    /// No columns yet, room for so many.
    pub fn with_room(n: usize, count: usize) -> Self {
        Self { n, data: Vec::with_capacity(n * count) }
    }

    /// How many columns.
    pub fn count(&self) -> usize {
        self.data.len() / self.n
    }

    #[inline(always)]
    fn column(&self, i: usize) -> &[f64] {
        &self.data[i * self.n..(i + 1) * self.n]
    }

    /// self −= (columns of other, `from` on) × c
    pub fn subtract(&mut self, other: &Columns, from: usize, c: &DMatrix<f64>) {
        wide(
            #[inline(always)]
            || {
                for (j, target) in self.data.chunks_mut(self.n).enumerate() {
                    for (s, strip) in target.chunks_mut(STRIP).enumerate() {
                        for i in 0..c.nrows() {
                            let source = &other.column(from + i)[s * STRIP..s * STRIP + strip.len()];
                            subtract(strip, source, c[(i, j)]);
                        }
                    }
                }
            },
        );
    }

    /// self × c
    pub fn times(&self, c: &DMatrix<f64>) -> Columns {
        let mut product = Columns { n: self.n, data: vec![0.0; self.n * c.ncols()] };
        product.subtract(self, 0, &-c);
        product
    }

    /// (columns of self, `from` on)ᵀ × other
    pub fn inner_from(&self, from: usize, other: &Columns) -> DMatrix<f64> {
        wide(
            #[inline(always)]
            || {
                DMatrix::from_fn(
                    self.count() - from,
                    other.count(),
                    #[inline(always)]
                    |i, j| dot(self.column(from + i), other.column(j)),
                )
            },
        )
    }
}

#[inline(always)]
fn subtract(target: &mut [f64], source: &[f64], factor: f64) {
    for (t, v) in target.iter_mut().zip(source) {
        *t -= factor * v;
    }
}

/// A dot product with a fixed order of summation that vectorises.
#[inline(always)]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; LANES];
    let (a_lanes, b_lanes) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest: f64 = a_lanes.remainder().iter().zip(b_lanes.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a_lanes.zip(b_lanes) {
        for lane in 0..LANES {
            sums[lane] += x[lane] * y[lane];
        }
    }
    rest + sums.iter().sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_those_of_matrices() {
        let n = 2_500;
        let fill = |count: usize, seed: f64| Columns {
            n,
            data: (0..n * count).map(|i| (seed * i as f64).sin()).collect(),
        };
        let (v, mut z) = (fill(5, 0.37), fill(2, 0.91));
        let dense = |c: &Columns| DMatrix::from_column_slice(n, c.count(), &c.data);
        let (dv, dz) = (dense(&v), dense(&z));
        let c = v.inner_from(0, &z);
        assert!((&c - dv.transpose() * &dz).amax() < 1e-10);
        z.subtract(&v, 0, &c);
        assert!((dense(&z) - (dz - &dv * &c)).amax() < 1e-9);
        assert!((dense(&v.times(&c)) - dv * c).amax() < 1e-9);
    }
}
