//! The equation system of a model: numbering, sparsity, symbolic factor. Made once for a pattern, used for every
//! height, load case and for K + Kg.
//!
//! Every node keeps its six unknowns; held ones are zeroed out of the matrix with 1 on the diagonal. So the matrix
//! consists of 6 × 6 blocks, a member's place in it is three numbers, and all vectors have `6 × nodes` entries in
//! *elimination order*: unknown d of node n is entry `first(n) + d`. A member that is not joined rigidly has a block of
//! its own beside its nodes', for the rotations of its two ends ([`super::joint`]).

pub use super::element::DOFS;

use super::element::Blocks;
use super::joint::{BLOCKS, Turned};
use super::model::{FrameModel, MemberKind};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::cholesky::{simplicial, supernodal};
use faer::sparse::{SymbolicSparseColMat, SymbolicSparseColMatRef};
use nalgebra::Matrix3;
use nalgebra_sparse::{CooMatrix, CscMatrix};

const BLOCK: usize = DOFS * DOFS;

/// The model is too large for the memory or the index type.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[error("the model is too large to be factorised")]
pub struct TooLarge;

/// Where a member's blocks are.
#[derive(Clone, Copy, Debug)]
pub struct Slot {
    /// First unknown of its start.
    pub start: usize,
    /// First unknown of its end.
    pub end: usize,
    /// Index, among the blocks of the earlier node's column, of the block that couples the two.
    below: u32,
    /// How it is joined to them.
    pub link: Link,
}

/// What a member does at its nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// A beam joined rigidly.
    Rigid,
    /// It pushes and pulls.
    Truss,
    /// A beam joined by springs or hinges: which of [`System::turned`].
    Turned(u32),
}

/// Numbering, sparsity and symbolic factor.
#[derive(Debug)]
pub struct System {
    nodes: usize,
    position: Vec<u32>,
    block_start: Vec<usize>,
    lower: SymbolicSparseColMat<u32>,
    slots: Vec<Slot>,
    turned: Vec<Turned>,
    /// Whether a block is a member's; empty where none is.
    of_member: Vec<bool>,
    held: Vec<bool>,
    symbolic: supernodal::SymbolicSupernodalCholesky<u32>,
}

impl System {
    /// Numbers the unknowns by approximate minimum degree on the node graph, and prepares the factor.
    ///
    /// # Errors
    /// [`TooLarge`].
    pub fn new(model: &FrameModel) -> Result<Self, TooLarge> {
        let members = model.members();
        let jointed: Vec<usize> =
            (0..members.len()).filter(|&m| members[m].kind.joints().is_some()).collect();
        let nodes = model.nodes().len() + jointed.len();
        // Nodes, and after them the members with joints, by the pairs that are coupled.
        let own = |j: usize| (model.nodes().len() + j) as u32;
        let mut coupled: Vec<(u32, u32)> = members.iter().map(|m| (m.start, m.end)).collect();
        for (j, &m) in jointed.iter().enumerate() {
            coupled.extend([(members[m].start, own(j)), (members[m].end, own(j))]);
        }
        let position = elimination_order(nodes, &coupled)?;
        let at = |n: u32| position[n as usize];
        let mut sorted: Vec<(u32, u32)> =
            coupled.iter().map(|&(a, b)| (at(a).min(at(b)), at(a).max(at(b)))).collect();
        sorted.sort_unstable();
        let (block_start, blocks) = block_columns(nodes, &sorted);
        let (col_ptr, row_idx) = expand(&block_start, &blocks)?;
        let n = DOFS * nodes;
        let lower = SymbolicSparseColMat::new_checked(n, n, col_ptr, None, row_idx);
        let symbolic = symbolic_factor(nodes, &sorted)?;
        let below = |a: u32, b: u32| {
            let (early, late) = (at(a).min(at(b)) as usize, at(a).max(at(b)));
            let column = &blocks[block_start[early]..block_start[early + 1]];
            column.partition_point(|&row| row < late) as u32
        };
        let first = |n: u32| DOFS * at(n) as usize;
        let mut slots: Vec<Slot> = members
            .iter()
            .map(|m| Slot {
                start: first(m.start),
                end: first(m.end),
                below: below(m.start, m.end),
                link: if m.kind == MemberKind::Truss { Link::Truss } else { Link::Rigid },
            })
            .collect();
        let mut turned = Vec::new();
        for (j, &m) in jointed.iter().enumerate() {
            let (start, end, own) = (members[m].start, members[m].end, own(j));
            slots[m].link = Link::Turned(j as u32);
            turned.push(Turned::new(model, m, first(own), [below(start, own), below(end, own)]));
        }
        let mut of_member = vec![false; if turned.is_empty() { 0 } else { nodes }];
        turned.iter().for_each(|own| of_member[own.at / DOFS] = true);
        let held = held(model, &turned, n, first);
        Ok(Self { nodes, position, block_start, lower, slots, turned, of_member, held, symbolic })
    }

    /// Number of unknowns, held ones included.
    pub fn unknowns(&self) -> usize {
        DOFS * self.nodes
    }

    /// Where node `n`'s six unknowns begin.
    pub fn first(&self, n: u32) -> usize {
        DOFS * self.position[n as usize] as usize
    }

    /// Whether an unknown is a rotation: the second three of a node, all six of a member with joints.
    pub fn is_rotation(&self, unknown: usize) -> bool {
        unknown % DOFS > 2 || self.of_member.get(unknown / DOFS).is_some_and(|of_member| *of_member)
    }

    /// Places of all members.
    pub fn slots(&self) -> &[Slot] {
        &self.slots
    }

    /// The members with joints, in order.
    pub fn turned(&self) -> &[Turned] {
        &self.turned
    }

    /// Which unknowns are held.
    pub fn held(&self) -> &[bool] {
        &self.held
    }

    /// The symbolic factor.
    pub fn symbolic(&self) -> &supernodal::SymbolicSupernodalCholesky<u32> {
        &self.symbolic
    }

    /// Sparsity of the lower triangle (with whole diagonal blocks).
    pub fn lower(&self) -> SymbolicSparseColMatRef<'_, u32> {
        self.lower.as_ref()
    }

    /// Number of stored values of a matrix.
    pub fn values(&self) -> usize {
        BLOCK * self.block_start[self.nodes]
    }

    /// Where in the values the diagonal entry of an unknown is.
    pub fn diagonal(&self, unknown: usize) -> usize {
        self.entry(unknown / DOFS, 0, unknown % DOFS, unknown % DOFS)
    }

    fn entry(&self, column: usize, block: usize, row: usize, col: usize) -> usize {
        let start = self.block_start[column];
        let height = DOFS * (self.block_start[column + 1] - start);
        BLOCK * start + col * height + block * DOFS + row
    }

    /// Adds a member's blocks × `factor` to a matrix's values.
    pub fn add(&self, values: &mut [f64], member: usize, blocks: &Blocks, factor: f64) {
        let Slot { start, end, below, .. } = self.slots[member];
        let b =
            Blocks { d: blocks.d * factor, s: blocks.s * factor, p: blocks.p * factor, q: blocks.q * factor };
        let turned = b.s.transpose();
        self.add_block(values, start / DOFS, 0, [&b.d, &b.s, &turned, &b.p]);
        self.add_block(values, end / DOFS, 0, [&b.d, &-b.s, &-turned, &b.p]);
        // Row block = later node, column block = earlier one.
        let (d, q) = (-b.d, b.q);
        if start < end {
            self.add_block(values, start / DOFS, below as usize, [&d, &-b.s, &turned, &q]);
        } else {
            self.add_block(values, end / DOFS, below as usize, [&d, &b.s, &-turned, &q]);
        }
    }

    /// The same for a member with joints: its matrix in 3 × 3 blocks, for displacement and rotation of its start and of
    /// its end (global), then the rotations of its own two ends (local).
    pub fn add_turned(&self, values: &mut [f64], member: usize, own: &Turned, blocks: &BLOCKS, factor: f64) {
        let Slot { start, end, below, .. } = self.slots[member];
        let part = |row: usize, column: usize| {
            let of = |r: usize, c: usize| blocks[2 * row + r][2 * column + c] * factor;
            [of(0, 0), of(0, 1), of(1, 0), of(1, 1)]
        };
        let mut add = |column: usize, block: usize, parts: [Matrix3<f64>; 4]| {
            let [uu, ur, ru, rr] = &parts;
            self.add_block(values, column, block, [uu, ur, ru, rr]);
        };
        let places = [start / DOFS, end / DOFS, own.at / DOFS];
        for (i, &place) in places.iter().enumerate() {
            add(place, 0, part(i, i));
        }
        for (i, j, below) in [(0, 1, below), (0, 2, own.below[0]), (1, 2, own.below[1])] {
            let (early, late) = if places[i] < places[j] { (i, j) } else { (j, i) };
            add(places[early], below as usize, part(late, early));
        }
    }

    /// Adds [[uu, ur], [ru, rr]] to one 6 × 6 block.
    fn add_block(&self, values: &mut [f64], column: usize, block: usize, parts: [&Matrix3<f64>; 4]) {
        let start = self.block_start[column];
        let height = DOFS * (self.block_start[column + 1] - start);
        let [uu, ur, ru, rr] = parts;
        for (half, (top, bottom)) in [(uu, ru), (ur, rr)].into_iter().enumerate() {
            for c in 0..3 {
                let from = BLOCK * start + (3 * half + c) * height + block * DOFS;
                let target = &mut values[from..from + DOFS];
                for r in 0..3 {
                    target[r] += top[(r, c)];
                    target[r + 3] += bottom[(r, c)];
                }
            }
        }
    }

    /// A matrix with these values as a symmetric one of nalgebra-sparse, both triangles, in elimination order.
    pub fn symmetric(&self, values: &[f64]) -> CscMatrix<f64> {
        let n = self.unknowns();
        let mut entries = CooMatrix::new(n, n);
        let (col_ptr, row_idx) = (self.lower.col_ptr(), self.lower.row_idx());
        for column in 0..n {
            for at in col_ptr[column] as usize..col_ptr[column + 1] as usize {
                let row = row_idx[at] as usize;
                entries.push(row, column, values[at]);
                // Diagonal blocks are stored whole.
                if row / DOFS != column / DOFS {
                    entries.push(column, row, values[at]);
                }
            }
        }
        CscMatrix::from(&entries)
    }

    /// Takes the held unknowns out of a matrix: rows and columns zero, diagonal `diagonal`.
    pub fn hold(&self, values: &mut [f64], diagonal: f64) {
        let row_idx = self.lower.row_idx();
        for column in 0..self.nodes {
            let start = self.block_start[column];
            let height = DOFS * (self.block_start[column + 1] - start);
            for c in 0..DOFS {
                let from = BLOCK * start + c * height;
                let rows = &row_idx[from..from + height];
                let col_held = self.held[DOFS * column + c];
                for (value, &row) in values[from..from + height].iter_mut().zip(rows) {
                    if col_held || self.held[row as usize] {
                        *value = 0.0;
                    }
                }
                if col_held {
                    values[from + c] = diagonal;
                }
            }
        }
    }

    /// Sets the held entries of a vector to zero.
    pub fn hold_vector(&self, vector: &mut [f64]) {
        for (value, &held) in vector.iter_mut().zip(&self.held) {
            if held {
                *value = 0.0;
            }
        }
    }
}

/// Which unknowns are held: by supports, because a node has no rotation, or because an end turns with its node.
fn held(model: &FrameModel, turned: &[Turned], n: usize, first: impl Fn(u32) -> usize) -> Vec<bool> {
    let mut held = vec![false; n];
    for (node, fixed) in model.fixed().iter().enumerate() {
        let first = first(node as u32);
        held[first..first + DOFS].copy_from_slice(fixed);
    }
    for &node in model.unturned() {
        let first = first(node);
        held[first + DOFS / 2..first + DOFS].fill(true);
    }
    for own in turned {
        held[own.at..own.at + DOFS].copy_from_slice(&own.rigid());
    }
    held
}

/// For each node, its place in the elimination order.
fn elimination_order(nodes: usize, coupled: &[(u32, u32)]) -> Result<Vec<u32>, TooLarge> {
    let mut edges: Vec<(i64, i64)> = Vec::with_capacity(2 * coupled.len());
    for &(a, b) in coupled {
        edges.push((i64::from(a), i64::from(b)));
        edges.push((i64::from(b), i64::from(a)));
    }
    edges.sort_unstable();
    let mut starts = vec![0i64; nodes + 1];
    for &(column, _) in &edges {
        starts[column as usize + 1] += 1;
    }
    for n in 0..nodes {
        starts[n + 1] += starts[n];
    }
    let rows: Vec<i64> = edges.iter().map(|e| e.1).collect();
    let control = amd::Control::default();
    let (order, _, _) = amd::order(nodes as i64, &starts, &rows, &control).map_err(|_| TooLarge)?;
    let mut position = vec![0u32; nodes];
    for (place, node) in order.into_iter().enumerate() {
        position[node as usize] = place as u32;
    }
    Ok(position)
}

/// Column starts and row numbers of the lower block triangle, diagonal first, rows ascending.
fn block_columns(nodes: usize, sorted: &[(u32, u32)]) -> (Vec<usize>, Vec<u32>) {
    let mut starts = Vec::with_capacity(nodes + 1);
    let mut rows = Vec::with_capacity(nodes + sorted.len());
    let mut pairs = sorted.iter().peekable();
    for column in 0..nodes as u32 {
        starts.push(rows.len());
        rows.push(column);
        while let Some(&(_, row)) = pairs.next_if(|p| p.0 == column) {
            rows.push(row);
        }
    }
    starts.push(rows.len());
    (starts, rows)
}

/// The same by unknowns.
fn expand(block_start: &[usize], blocks: &[u32]) -> Result<(Vec<u32>, Vec<u32>), TooLarge> {
    let total = BLOCK * blocks.len();
    u32::try_from(total).map_err(|_| TooLarge)?;
    let mut col_ptr = Vec::with_capacity(DOFS * block_start.len());
    let mut row_idx = Vec::with_capacity(total);
    for column in block_start.windows(2) {
        for _ in 0..DOFS {
            col_ptr.push(row_idx.len() as u32);
            for &block in &blocks[column[0]..column[1]] {
                row_idx.extend((0..DOFS as u32).map(|r| DOFS as u32 * block + r));
            }
        }
    }
    col_ptr.push(row_idx.len() as u32);
    Ok((col_ptr, row_idx))
}

fn symbolic_factor(
    nodes: usize,
    sorted: &[(u32, u32)],
) -> Result<supernodal::SymbolicSupernodalCholesky<u32>, TooLarge> {
    let n = DOFS * nodes;
    // faer reads the upper triangle here: column = later node, rows = earlier ones and itself. Of each block only the
    // row of the earlier node's first unknown is given: eliminating that unknown fills in the rest, so that the factor's
    // structure is the same, found from a sixth of the entries.
    let mut upper: Vec<(u32, u32)> = sorted.iter().map(|&(early, late)| (late, early)).collect();
    upper.sort_unstable();
    let mut col_ptr = Vec::with_capacity(n + 1);
    let mut row_idx: Vec<u32> = Vec::with_capacity(DOFS * (2 * nodes + upper.len()));
    let mut pairs = upper.iter().peekable();
    let mut above = Vec::new();
    for column in 0..nodes as u32 {
        above.clear();
        while let Some(&(_, row)) = pairs.next_if(|p| p.0 == column) {
            above.push(row);
        }
        for c in 0..DOFS as u32 {
            col_ptr.push(row_idx.len() as u32);
            row_idx.extend(above.iter().map(|block| DOFS as u32 * block));
            row_idx.extend([0, c].iter().take(1 + c.min(1) as usize).map(|r| DOFS as u32 * column + r));
        }
    }
    col_ptr.push(row_idx.len() as u32);
    let pattern = SymbolicSparseColMatRef::new_checked(n, n, &col_ptr, None, &row_idx);
    let scratch = simplicial::prefactorize_symbolic_cholesky_scratch::<u32>(n, row_idx.len())
        .or(supernodal::factorize_supernodal_symbolic_cholesky_scratch::<u32>(n));
    let mut memory = MemBuffer::try_new(scratch).map_err(|_| TooLarge)?;
    let stack = MemStack::new(&mut memory);
    let mut tree = vec![0i32; n];
    let mut counts = vec![0u32; n];
    let tree = simplicial::prefactorize_symbolic_cholesky(&mut tree, &mut counts, pattern, stack);
    supernodal::factorize_supernodal_symbolic_cholesky(pattern, tree, &counts, stack, Default::default())
        .map_err(|_| TooLarge)
}
