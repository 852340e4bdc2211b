//! Sparse symmetric matrices of 6x6 blocks, of the border of an island: block L D L^T in an order
//! of few fill-ins.
//!
//! # Equation
//!
//! With the columns G_ik = A_ik D_k^-1 of the factors,
//!
//! ```text
//! A_ij -= G_ik A_jk^T        D_k = L d L^T within a block
//! ```
//!
//! for all pairs of blocks below k in its column. A block is that of a body, or of contacts between
//! cables, whose diagonal is negative.
//!
//! # Validity
//!
//! A matrix of positive blocks A and negative blocks -C with any coupling between them, (A B^T; B
//! -C), is quasidefinite if A and C are definite: then every order of elimination has nonzero
//! pivots with the signs of the blocks, and none is exchanged. Where a pivot has the other sign, or
//! rounding has left nothing of it, the whole matrix is [dense](super::dense), with exchanges.
//!
//! # References
//!
//! Vanderbei, Symmetric quasidefinite matrices, SIAM J. Optim. 5 (1995) 100; Davis, Direct Methods
//! for Sparse Linear Systems (2006), chapter 4.
//!
//! # Alternatives considered
//!
//! docs/decisions/border.md: a dense matrix, faer, nalgebra-sparse, an order by nested dissection.

use super::block::Block;
use super::dense::Dense;
use super::elimination::Elimination;
use super::lanes::{after, columns_times, diagonal, load, load_block, load_six, splat, store_six, transpose_dots};
use super::outcome::SingularMatrix;
use super::schur::{solve_node, store_block};
use super::substitution::solve_block;
use super::twisted::Node;
use crate::scales::linalg::MIN_PIVOT_OF_BORDER;
use crate::simd::dispatch;
use fearless_simd::{Level, Simd, prelude::*};
use nalgebra::Matrix3;

/// A sparse symmetric matrix, and its factors.
#[derive(Clone, Debug, Default)]
pub(crate) struct SparseSymmetric {
    /// By block row, the columns up to the diagonal with their places in `entries`, in ascending
    /// order.
    rows: Vec<Vec<(usize, usize)>>,
    count: usize,
    entries: Vec<Block>,
    /// By entry, row and column.
    places: Vec<(usize, usize)>,
    /// By block, which of its rows are those of the identity.
    locked: Vec<[bool; 6]>,
    any_locked: bool,
    /// By block, the sign of its diagonal.
    signs: Vec<f64>,
    order: Elimination,
    /// The places for which the order was made.
    ordered: Vec<(usize, usize)>,
    /// By entry off the diagonal, its place among the factors.
    targets: Vec<usize>,
    /// By position, D, and the diagonal entries from which it came.
    nodes: Vec<Node>,
    before: Vec<[f64; 8]>,
    /// By place below the diagonal, G.
    gains: Vec<Block>,
    /// By place in the column at hand, A_ik.
    column: Vec<Block>,
    x: Vec<f64>,
    dense: Dense,
    full: Vec<f64>,
    is_dense: bool,
}

impl SparseSymmetric {
    /// Begins anew with zeros for a number of blocks.
    pub fn begin(&mut self, count: usize) {
        if self.rows.len() < count {
            self.rows.resize_with(count, Vec::new);
        }
        self.rows[..count].iter_mut().for_each(Vec::clear);
        self.count = count;
        self.entries.clear();
        self.places.clear();
        self.locked.clear();
        self.locked.resize(count, [false; 6]);
        (self.any_locked, self.is_dense) = (false, false);
        self.signs.clear();
        self.signs.resize(count, 1.0);
    }

    /// Returns the number of rows.
    pub fn size(&self) -> usize {
        6 * self.count
    }

    /// Returns the block at a row and a column that is at most the row.
    pub fn block(&mut self, row: usize, column: usize) -> &mut Block {
        let list = &mut self.rows[row];
        let at = match list.binary_search_by_key(&column, |(column, _)| *column) {
            Ok(found) => list[found].1,
            Err(place) => {
                let new = self.entries.len();
                list.insert(place, (column, new));
                self.entries.push(Block::ZERO);
                self.places.push((row, column));
                new
            }
        };
        &mut self.entries[at]
    }

    /// Sets a block to be negative: its diagonal is minus the identity beside what is added.
    pub fn set_negative(&mut self, block: usize) {
        self.signs[block] = -1.0;
        let own = self.block(block, block);
        (0..6).for_each(|x| own.0[x][x] -= 1.0);
    }

    /// Makes rows and columns of a block those of the identity.
    pub fn lock(&mut self, block: usize, free: &[bool; 6]) {
        self.locked[block] = free.map(|free| !free);
        self.any_locked |= free.contains(&false);
    }

    /// Factors it.
    ///
    /// # Errors
    /// If it is singular or not finite.
    pub fn factor(&mut self) -> Result<(), SingularMatrix> {
        if self.count == 0 {
            return Ok(());
        }
        for block in 0..self.count {
            self.block(block, block);
        }
        if self.any_locked {
            self.apply_locks();
        }
        if self.ordered != self.places {
            self.order.order(self.count, self.places.iter().copied());
            let of = |&(row, column): &(usize, usize)| {
                let [p, q] = [row, column].map(|block| self.order.position[block]);
                if row == column { p } else { self.order.find(p.max(q), p.min(q)).unwrap_or(0) }
            };
            self.targets.clear();
            self.targets.extend(self.places.iter().map(of));
            self.ordered.clone_from(&self.places);
        }
        self.scatter();
        let level = Level::new();
        self.is_dense = !dispatch!(level, simd => eliminate(simd, self));
        if self.is_dense { self.factor_dense() } else { Ok(()) }
    }

    fn apply_locks(&mut self) {
        for (&(row, column), block) in self.places.iter().zip(&mut self.entries) {
            let [of_row, of_column] = [row, column].map(|block| self.locked[block]);
            if of_row == [false; 6] && of_column == [false; 6] {
                continue;
            }
            for c in 0..6 {
                for r in (0..6).filter(|&r| of_row[r] || of_column[c]) {
                    block.0[c][r] = if row == column && r == c { self.signs[row] } else { 0.0 };
                }
            }
        }
    }

    /// Brings the entries to the places of the factors.
    fn scatter(&mut self) {
        self.nodes.resize(self.count, Node::ZERO);
        self.before.resize(self.count, [0.0; 8]);
        self.gains.clear();
        self.gains.resize(self.order.rows.len(), Block::ZERO);
        for ((&(row, column), block), &target) in self.places.iter().zip(&self.entries).zip(&self.targets) {
            if row == column {
                self.nodes[target].columns = *block;
                (0..6).for_each(|x| self.before[target][x] = block.0[x][x]);
            } else if self.order.position[row] > self.order.position[column] {
                self.gains[target] = *block;
            } else {
                let out = &mut self.gains[target].0;
                (0..6).for_each(|c| (0..6).for_each(|r| out[r][c] = block.0[c][r]));
            }
        }
    }

    /// Factors it as a dense matrix, with exchanges.
    fn factor_dense(&mut self) -> Result<(), SingularMatrix> {
        let n = 6 * self.count;
        self.full.clear();
        self.full.resize(n * n, 0.0);
        for (&(row, column), block) in self.places.iter().zip(&self.entries) {
            for r in 0..6 {
                (0..6).for_each(|c| self.full[(6 * row + r) * n + 6 * column + c] = block.0[c][r]);
            }
        }
        self.dense.factor(&self.full, n)
    }

    /// Solves in place.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        if self.count == 0 {
            return;
        }
        if self.is_dense {
            return self.dense.solve(rhs);
        }
        let level = Level::new();
        self.x.clear();
        for block in &self.order.block {
            self.x.extend_from_slice(&rhs[6 * block..6 * block + 6]);
        }
        let (nodes, gains, order, x) = (&self.nodes[..], &self.gains[..], &self.order, &mut self.x[..]);
        dispatch!(level, simd => substitute(simd, nodes, gains, order, x));
        for (block, six) in self.order.block.iter().zip(self.x.chunks_exact(6)) {
            rhs[6 * block..6 * block + 6].copy_from_slice(six);
        }
    }

    /// Returns the number of products of blocks that the factors take.
    #[cfg(test)]
    pub fn products(&self) -> usize {
        self.order.start.windows(2).map(|column| column[1] - column[0]).map(|below| below * (below + 3) / 2).sum()
    }

    /// Returns the number of negative eigenvalues of the factored matrix.
    pub fn negative(&self) -> usize {
        // unless it is dense, all pivots of a block have its sign
        if self.is_dense { self.dense.negative() } else { 6 * self.signs.iter().filter(|sign| **sign < 0.0).count() }
    }
}

impl Block {
    /// Adds to the part from a row and a column on.
    pub(crate) fn add(&mut self, row: usize, column: usize, part: &Matrix3<f64>) {
        for c in 0..3 {
            (0..3).for_each(|r| self.0[column + c][row + r] += part[(r, c)]);
        }
    }
}

/// Returns whether all pivots have their signs.
#[inline(always)]
fn eliminate<S: Simd>(simd: S, matrix: &mut SparseSymmetric) -> bool {
    let SparseSymmetric { order, nodes, before, gains, column, signs, .. } = matrix;
    for k in 0..nodes.len() {
        let node = &mut nodes[k];
        let mut d = load_block(simd, &node.columns);
        for p in 0..6 {
            let inverse = 1.0 / d[p][p];
            node.inverse[p] = inverse;
            let below = after(simd, p).select(d[p] * splat(simd, inverse), splat(simd, 0.0));
            d[p].store_array(&mut node.columns.0[p]);
            for c in p + 1..6 {
                d[c] -= below * splat(simd, node.columns.0[p][c]);
            }
        }
        let pivots = diagonal(simd, &d) * splat(simd, signs[order.block[k]]);
        let least = load(simd, &before[k]).abs() * splat(simd, MIN_PIVOT_OF_BORDER);
        if pivots.simd_gt(least).to_bitmask() & 0x3f != 0x3f {
            return false;
        }
        let node = &nodes[k];
        let (begin, end) = (order.start[k], order.start[k + 1]);
        column.clear();
        for gain in &mut gains[begin..end] {
            column.push(*gain);
            store_block(&solve_node(simd, node, load_block(simd, gain)), gain);
        }
        for (j, other) in column.iter().enumerate() {
            let place = order.rows[begin + j];
            subtract_product(simd, &gains[begin + j], other, &mut nodes[place].columns);
            let mut at = order.start[place];
            for i in j + 1..column.len() {
                while order.rows[at] != order.rows[begin + i] {
                    at += 1;
                }
                let (before, after) = gains.split_at_mut(at);
                subtract_product(simd, &before[begin + i], other, &mut after[0]);
            }
        }
    }
    true
}

/// Computes `out -= g a^T`.
#[inline(always)]
fn subtract_product<S: Simd>(simd: S, g: &Block, a: &Block, out: &mut Block) {
    let g = load_block(simd, g);
    for c in 0..6 {
        let mut sum = load(simd, &out.0[c]);
        for m in 0..6 {
            sum -= g[m] * splat(simd, a.0[m][c]);
        }
        sum.store_array(&mut out.0[c]);
    }
}

/// Solves in place, in the order of elimination.
#[inline(always)]
fn substitute<S: Simd>(simd: S, nodes: &[Node], gains: &[Block], order: &Elimination, x: &mut [f64]) {
    for k in 0..nodes.len() {
        let own = load_six(simd, &x[6 * k..6 * k + 6]);
        for at in order.start[k]..order.start[k + 1] {
            let row = &mut x[6 * order.rows[at]..][..6];
            let product = columns_times(simd, &load_block(simd, &gains[at]), own);
            store_six(simd, load_six(simd, row) - product, row);
        }
        store_six(simd, solve_block(simd, &nodes[k], own), &mut x[6 * k..6 * k + 6]);
    }
    for k in (0..nodes.len()).rev() {
        let mut own = load_six(simd, &x[6 * k..6 * k + 6]);
        for at in order.start[k]..order.start[k + 1] {
            let row = load_six(simd, &x[6 * order.rows[at]..][..6]);
            own -= transpose_dots(&load_block(simd, &gains[at]), row);
        }
        store_six(simd, own, &mut x[6 * k..6 * k + 6]);
    }
}

#[cfg(test)]
mod tests;
