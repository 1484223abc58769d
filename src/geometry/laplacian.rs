//! Functions on a mesh in balance: at every free vertex Σ w (fⱼ − fᵢ) + loadᵢ = 0 over its edges.
//!
//! With equal weights this is the map of Tutte (1963); with force densities the net of Schek (1974).

use super::sparse::{Factor, Symmetric};

const FIXED: u32 = u32::MAX;

/// The factorised weighted graph Laplacian of the free vertices.
pub struct Laplacian<'a> {
    edges: &'a [[u32; 2]],
    weights: Weights<'a>,
    /// For each vertex, its unknown; [`FIXED`] for given ones.
    unknown: Vec<u32>,
    count: usize,
    factor: Factor,
}

/// Weights of the edges.
#[derive(Clone, Copy)]
pub enum Weights<'a> {
    /// All 1.
    Equal,
    /// One for each edge.
    Each(&'a [f64]),
}

impl Weights<'_> {
    fn of(&self, edge: usize) -> f64 {
        match self {
            Self::Equal => 1.0,
            Self::Each(weights) => weights[edge],
        }
    }
}

impl<'a> Laplacian<'a> {
    /// Factorises for given fixed vertices; `None` where the free ones are not held (a part of the mesh without a fixed
    /// vertex, or negative weights).
    pub fn new(edges: &'a [[u32; 2]], weights: Weights<'a>, is_fixed: &[bool]) -> Option<Self> {
        let mut count = 0;
        let unknown: Vec<u32> = is_fixed
            .iter()
            .map(|&fixed| {
                let number = if fixed { FIXED } else { count };
                count += u32::from(!fixed);
                number
            })
            .collect();
        let mut matrix = Symmetric { diagonal: vec![0.0; count as usize], entries: Vec::new() };
        for (e, &[u, v]) in edges.iter().enumerate() {
            let (i, j) = (unknown[u as usize], unknown[v as usize]);
            for k in [i, j] {
                if k != FIXED {
                    matrix.diagonal[k as usize] += weights.of(e);
                }
            }
            if i != FIXED && j != FIXED {
                matrix.entries.push((i, j, -weights.of(e)));
            }
        }
        Some(Self { edges, weights, unknown, count: count as usize, factor: Factor::of(&matrix)? })
    }

    /// Fills in the free entries of `values` from the fixed ones.
    pub fn extend(&self, values: &mut [f64]) {
        self.solve(values, |_| 0.0, |_| 0.0);
    }

    /// The same with `jump(e)`, what the function gains along edge `e` from its first to its second vertex beside the
    /// difference of the values (a function of several values), and with `load(v)`.
    pub fn solve(&self, values: &mut [f64], jump: impl Fn(usize) -> f64, load: impl Fn(usize) -> f64) {
        let mut b = vec![0.0; self.count];
        for (v, &i) in self.unknown.iter().enumerate().filter(|&(_, &i)| i != FIXED) {
            b[i as usize] = load(v);
        }
        for (e, &[u, v]) in self.edges.iter().enumerate() {
            let (i, j) = (self.unknown[u as usize], self.unknown[v as usize]);
            let weight = self.weights.of(e);
            if i != FIXED {
                b[i as usize] += weight * (jump(e) + if j == FIXED { values[v as usize] } else { 0.0 });
            }
            if j != FIXED {
                b[j as usize] += weight * (-jump(e) + if i == FIXED { values[u as usize] } else { 0.0 });
            }
        }
        self.factor.solve(&mut b);
        for (value, &i) in values.iter_mut().zip(&self.unknown) {
            if i != FIXED {
                *value = b[i as usize];
            }
        }
    }
}
