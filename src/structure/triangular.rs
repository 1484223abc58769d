//! Solving with a supernodal factor: L y = b, then Lᵀ x = y.
//!
//! faer's own solve is made of general matrix products, which pack their operands; for the few right-hand sides that
//! statics and buckling bring, that costs as much as the work. Here every supernode's columns are read once, six at a
//! time, and used for all right-hand sides while they are in the first-level cache. What is left is reading L.
//!
//! The order of every sum is written down, so that the result does not depend on the width of the processor's vectors.

use super::columns::dot;
use crate::simd::wide;
use faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;

/// Columns of L treated together: those of a node.
const GROUP: usize = 6;
/// Sums kept side by side in a dot product.
const LANES: usize = 4;

/// Solves L Lᵀ x = b in place for each column of `rhs`; `room` needs no content.
pub fn solve(symbolic: &SymbolicSupernodalCholesky<u32>, l: &[f64], rhs: &mut [f64], room: &mut Vec<f64>) {
    let n = symbolic.nrows();
    let columns = rhs.len() / n;
    let supernodes = Supernodes { symbolic, l };
    let tallest = (0..symbolic.n_supernodes()).map(|s| supernodes.get(s).rows()).max().unwrap_or(0);
    room.resize(columns * tallest, 0.0);
    wide(
        #[inline(always)]
        || {
            for s in 0..symbolic.n_supernodes() {
                let node = supernodes.get(s);
                for (b, local) in rhs.chunks_exact_mut(n).zip(room.chunks_exact_mut(tallest)) {
                    node.gather(b, local, false);
                }
                node.forward(room, tallest);
                for (b, local) in rhs.chunks_exact_mut(n).zip(room.chunks_exact(tallest)) {
                    node.scatter_sum(local, b);
                }
            }
            for s in (0..symbolic.n_supernodes()).rev() {
                let node = supernodes.get(s);
                for (b, local) in rhs.chunks_exact_mut(n).zip(room.chunks_exact_mut(tallest)) {
                    node.gather(b, local, true);
                }
                node.backward(room, tallest);
                for (b, local) in rhs.chunks_exact_mut(n).zip(room.chunks_exact(tallest)) {
                    b[node.start..node.start + node.width].copy_from_slice(&local[..node.width]);
                }
            }
        },
    );
}

#[derive(Clone, Copy)]
struct Supernodes<'a> {
    symbolic: &'a SymbolicSupernodalCholesky<u32>,
    l: &'a [f64],
}

impl<'a> Supernodes<'a> {
    #[inline(always)]
    fn get(&self, s: usize) -> Supernode<'a> {
        let begin = |starts: &[u32]| starts[s] as usize..starts[s + 1] as usize;
        let start = self.symbolic.supernode_begin()[s] as usize;
        let end = self.symbolic.supernode_end()[s] as usize;
        Supernode {
            start,
            width: end - start,
            below: &self.symbolic.row_idx()[begin(self.symbolic.col_ptr_for_row_idx())],
            l: &self.l[begin(self.symbolic.col_ptr_for_val())],
        }
    }
}

/// Neighbouring columns of L with the same rows: a lower triangle, and a rectangle on the rows `below`.
#[derive(Clone, Copy)]
struct Supernode<'a> {
    start: usize,
    width: usize,
    below: &'a [u32],
    l: &'a [f64],
}

impl Supernode<'_> {
    #[inline(always)]
    fn rows(&self) -> usize {
        self.width + self.below.len()
    }

    #[inline(always)]
    fn column(&self, j: usize) -> &[f64] {
        &self.l[j * self.rows()..(j + 1) * self.rows()]
    }

    /// The supernode's own entries of b, then those below, or zeros to collect in.
    #[inline(always)]
    fn gather(&self, b: &[f64], local: &mut [f64], below: bool) {
        let (own, rest) = local.split_at_mut(self.width);
        own.copy_from_slice(&b[self.start..self.start + self.width]);
        if below {
            for (value, &row) in rest.iter_mut().zip(self.below) {
                *value = b[row as usize];
            }
        } else {
            rest[..self.below.len()].fill(0.0);
        }
    }

    #[inline(always)]
    fn scatter_sum(&self, local: &[f64], b: &mut [f64]) {
        let (own, rest) = local.split_at(self.width);
        b[self.start..self.start + self.width].copy_from_slice(own);
        for (value, &row) in rest.iter().zip(self.below) {
            b[row as usize] += value;
        }
    }

    /// local ← L⁻¹ of the triangle's part, and minus the rectangle times that below.
    #[inline(always)]
    fn forward(&self, room: &mut [f64], tallest: usize) {
        let mut j = 0;
        while j < self.width {
            let group = if j + GROUP <= self.width { GROUP } else { 1 };
            let l: [&[f64]; GROUP] = std::array::from_fn(|k| self.column(j + k.min(group - 1)));
            let after = j + group;
            let rows = self.rows();
            let mut locals = room.chunks_exact_mut(tallest);
            while let Some(first) = locals.next() {
                let x = solve_corner(&l, j, group, first);
                if group < GROUP {
                    subtract(&l[0][after..rows], x[0], &mut first[after..rows]);
                    continue;
                }
                let below = l.map(|l| &l[after..rows]);
                match locals.next() {
                    Some(second) => {
                        let y = solve_corner(&l, j, group, second);
                        subtract_two(below, x, y, &mut first[after..rows], &mut second[after..rows]);
                    }
                    None => subtract_one(below, x, &mut first[after..rows]),
                }
            }
            j = after;
        }
    }

    /// local ← L⁻ᵀ (local − rectangleᵀ × what is below).
    #[inline(always)]
    fn backward(&self, room: &mut [f64], tallest: usize) {
        let rows = self.rows();
        let mut after = self.width;
        while after > 0 {
            // The same groups as forward, from the end: what does not fill a group singly, then whole groups.
            let group = if after.is_multiple_of(GROUP) { GROUP } else { 1 };
            let j = after - group;
            let l: [&[f64]; GROUP] = std::array::from_fn(|k| self.column(j + k.min(group - 1)));
            let mut locals = room.chunks_exact_mut(tallest);
            while let Some(first) = locals.next() {
                if group < GROUP {
                    let sum = dot(&l[0][after..rows], &first[after..rows]);
                    first[j] = (first[j] - sum) / l[0][j];
                    continue;
                }
                let below = l.map(|l| &l[after..rows]);
                match locals.next() {
                    Some(second) => {
                        let [a, b] = dots_two(below, &first[after..rows], &second[after..rows]);
                        solve_corner_transposed(&l, j, a, first);
                        solve_corner_transposed(&l, j, b, second);
                    }
                    None => solve_corner_transposed(&l, j, dots_one(below, &first[after..rows]), first),
                }
            }
            after = j;
        }
    }
}

/// The first `group` unknowns from row `j` on, by the corner of the triangle.
#[inline(always)]
fn solve_corner(l: &[&[f64]; GROUP], j: usize, group: usize, local: &mut [f64]) -> [f64; GROUP] {
    let mut x = [0.0; GROUP];
    for k in 0..group {
        let mut value = local[j + k];
        for i in 0..k {
            value -= l[i][j + k] * x[i];
        }
        x[k] = value / l[k][j + k];
        local[j + k] = x[k];
    }
    x
}

#[inline(always)]
fn solve_corner_transposed(l: &[&[f64]; GROUP], j: usize, sums: [f64; GROUP], local: &mut [f64]) {
    for k in (0..GROUP).rev() {
        let mut value = local[j + k] - sums[k];
        for i in k + 1..GROUP {
            value -= l[k][j + i] * local[j + i];
        }
        local[j + k] = value / l[k][j + k];
    }
}

#[inline(always)]
fn subtract(l: &[f64], x: f64, y: &mut [f64]) {
    for (y, l) in y.iter_mut().zip(l) {
        *y -= l * x;
    }
}

#[inline(always)]
fn subtract_one(l: [&[f64]; GROUP], x: [f64; GROUP], y: &mut [f64]) {
    let n = y.len();
    let [l0, l1, l2, l3, l4, l5] = l.map(|l| &l[..n]);
    for i in 0..n {
        y[i] -= (l0[i] * x[0] + l1[i] * x[1]) + (l2[i] * x[2] + l3[i] * x[3]) + (l4[i] * x[4] + l5[i] * x[5]);
    }
}

#[inline(always)]
fn subtract_two(l: [&[f64]; GROUP], x: [f64; GROUP], y: [f64; GROUP], first: &mut [f64], second: &mut [f64]) {
    let n = first.len();
    let second = &mut second[..n];
    let [l0, l1, l2, l3, l4, l5] = l.map(|l| &l[..n]);
    for i in 0..n {
        let l = [l0[i], l1[i], l2[i], l3[i], l4[i], l5[i]];
        first[i] -= (l[0] * x[0] + l[1] * x[1]) + (l[2] * x[2] + l[3] * x[3]) + (l[4] * x[4] + l[5] * x[5]);
        second[i] -= (l[0] * y[0] + l[1] * y[1]) + (l[2] * y[2] + l[3] * y[3]) + (l[4] * y[4] + l[5] * y[5]);
    }
}

#[inline(always)]
fn total([a, b, c, d]: [f64; LANES]) -> f64 {
    (a + b) + (c + d)
}

#[inline(always)]
fn dots_one(l: [&[f64]; GROUP], x: &[f64]) -> [f64; GROUP] {
    let whole = x.len() - x.len() % LANES;
    let mut sums = [[0.0; LANES]; GROUP];
    for at in (0..whole).step_by(LANES) {
        let x = lanes(x, at);
        for (sums, l) in sums.iter_mut().zip(&l) {
            let l = lanes(l, at);
            for lane in 0..LANES {
                sums[lane] += l[lane] * x[lane];
            }
        }
    }
    std::array::from_fn(|k| total(sums[k]) + rest(&l[k][whole..], &x[whole..]))
}

#[inline(always)]
fn dots_two(l: [&[f64]; GROUP], x: &[f64], y: &[f64]) -> [[f64; GROUP]; 2] {
    let whole = x.len() - x.len() % LANES;
    let (mut a, mut b) = ([[0.0; LANES]; GROUP], [[0.0; LANES]; GROUP]);
    for at in (0..whole).step_by(LANES) {
        let (x, y) = (lanes(x, at), lanes(y, at));
        for k in 0..GROUP {
            let l = lanes(l[k], at);
            for lane in 0..LANES {
                a[k][lane] += l[lane] * x[lane];
                b[k][lane] += l[lane] * y[lane];
            }
        }
    }
    [
        std::array::from_fn(|k| total(a[k]) + rest(&l[k][whole..], &x[whole..])),
        std::array::from_fn(|k| total(b[k]) + rest(&l[k][whole..], &y[whole..])),
    ]
}

#[inline(always)]
fn rest(l: &[f64], x: &[f64]) -> f64 {
    l.iter().zip(x).map(|(l, x)| l * x).sum()
}

#[inline(always)]
fn lanes(v: &[f64], at: usize) -> [f64; LANES] {
    std::array::from_fn(
        #[inline(always)]
        |lane| v[at + lane],
    )
}
