//! The Schur complement of a factored matrix on the columns of a border, and solutions with it.
//!
//! # Equation
//!
//! With the block factors (I + G) S (I + G)^T of the [two-ended elimination](super::twisted) and
//! the columns B of the border,
//!
//! ```text
//! Y = (I + G)^-1 B        B^T A^-1 B = sum_i Y_i^T S_i^-1 Y_i
//! z = S^-1 (I + G)^-1 b        B^T A^-1 b = Y^T z        A^-1 (b - B d) = (I + G)^-T (z - S^-1 Y d)
//! ```
//!
//! A column only passes the sweep inwards, and only from its first entry on: its nodes between that
//! and the middle node are all that it has in Y, so that the products of columns from different
//! halves have one term. The sweep outwards is made once, for the solution. With the
//! [banded](super::banded) factors, A^-1 B takes the place of S^-1 Y.
//!
//! Columns are in lanes, eight at a time; no sum is across lanes but that of S^-1 Y d.
//!
//! # References
//!
//! Golub & Van Loan, Matrix Computations, 4th ed., section 4.5.1.
//!
//! # Alternatives considered
//!
//! Whole solutions for all columns, and their products with B: on a cable with 20 pins in 40
//! elements the condensation takes seven times as long.

use super::block::Block;
use super::factorisation::Factorisation;
use super::lanes::{Columns, load, load_block, load_six, splat, store_six, transpose_dots};
use super::substitution;
use super::twisted::Node;
use crate::simd::dispatch;
use fearless_simd::{Level, Simd, f64x8, prelude::*};

/// Layout: number of columns in a group.
const LANES: usize = 8;
/// Layout: number of rows of the Schur complement that are summed at a time.
const ROWS: usize = 4;

/// The columns of a border, and what the factors make of them.
#[derive(Clone, Debug, Default)]
pub struct SchurComplement {
    nodes: usize,
    count: usize,
    /// B, then Y, by group of columns and node: by coordinate, the eight columns.
    columns: Vec<Block>,
    /// S^-1 Y, or A^-1 B, likewise.
    solved: Vec<Block>,
    /// By group, the number of nodes before the first entry, at most to the middle node, and after
    /// the last.
    zeros: Vec<[usize; 2]>,
    /// Whether `solved` is A^-1 B.
    whole: bool,
    /// One column.
    scratch: Vec<f64>,
}

impl SchurComplement {
    /// Begins anew with `count` columns of zeros for a matrix of a number of nodes.
    pub fn begin(&mut self, nodes: usize, count: usize) {
        let groups = count.div_ceil(LANES);
        (self.nodes, self.count, self.whole) = (nodes, count, false);
        self.columns.clear();
        self.columns.resize(groups * nodes, Block::ZERO);
        self.solved.resize(groups * nodes, Block::ZERO);
        let middle = nodes / 2;
        self.zeros.clear();
        self.zeros.resize(groups, [middle, nodes.saturating_sub(1 + middle)]);
    }

    /// Sets the entries of a column in the nodes from `first` on, six numbers per node.
    ///
    /// # Panics
    /// If there is no such column or node.
    pub fn set(&mut self, column: usize, first: usize, rows: &[f64]) {
        assert!(column < self.count && 6 * first + rows.len() <= 6 * self.nodes, "place in the border");
        let (group, lane) = (column / LANES, column % LANES);
        for (node, six) in (first..).zip(rows.chunks_exact(6)) {
            if six.iter().any(|x| *x != 0.0) {
                let [before, after] = &mut self.zeros[group];
                (*before, *after) = ((*before).min(node), (*after).min(self.nodes - 1 - node));
            }
            let block = &mut self.columns[group * self.nodes + node].0;
            (0..6).for_each(|k| block[k][lane] = six[k]);
        }
    }

    /// Completes the columns with the factored matrix.
    ///
    /// # Panics
    /// If nothing has been factored successfully, or a matrix of another size.
    pub fn complete(&mut self, level: Level, factorisation: &Factorisation) {
        assert_eq!(factorisation.nodes(), self.nodes, "nodes of the matrix");
        if self.nodes == 0 {
            return;
        }
        let factors = factorisation.twisted();
        self.whole = factors.is_none();
        let groups = self.columns.chunks_exact_mut(self.nodes).zip(self.solved.chunks_exact_mut(self.nodes));
        for (group, (columns, solved)) in groups.enumerate() {
            match factors {
                Some(nodes) => {
                    dispatch!(level, simd => sweep_inwards(simd, nodes, (columns, solved), self.zeros[group]));
                }
                None => {
                    solved.fill(Block::ZERO);
                    for lane in 0..LANES.min(self.count - LANES * group) {
                        solve_lane(level, factorisation, (columns, solved, lane), &mut self.scratch);
                    }
                }
            }
        }
    }

    /// Computes `w -= B^T A^-1 B`, row-major and symmetric.
    pub fn subtract_from(&self, level: Level, w: &mut [f64]) {
        dispatch!(level, simd => subtract_from(simd, self, w));
    }

    /// Computes `out = B^T A^-1 b`, and brings b half of the way to the solution, which
    /// [`expand`](Self::expand) completes. The factorisation is that of
    /// [`complete`](Self::complete).
    pub fn reduce(&self, level: Level, factorisation: &Factorisation, b: &mut [f64], out: &mut [f64]) {
        let factors = factorisation.twisted();
        if factors.is_none() {
            factorisation.solve(level, b);
        }
        let (b, _) = b.as_chunks_mut::<6>();
        dispatch!(level, simd => reduce(simd, self, factors, b, out));
    }

    /// Computes `A^-1 (b - B d)` of what [`reduce`](Self::reduce) made of b, in place.
    pub fn expand(&self, level: Level, factorisation: &Factorisation, d: &[f64], b: &mut [f64]) {
        let (b, _) = b.as_chunks_mut::<6>();
        dispatch!(level, simd => expand(simd, self, factorisation.twisted(), d, b));
    }

    /// Returns the columns and `solved` of a group.
    fn group(&self, group: usize) -> (&[Block], &[Block]) {
        let range = group * self.nodes..(group + 1) * self.nodes;
        (&self.columns[range.clone()], &self.solved[range])
    }

    /// Returns the nodes with terms of the products of the columns of two groups.
    fn common(&self, a: usize, b: usize) -> core::ops::Range<usize> {
        let ([before, after], [other_before, other_after]) = (self.zeros[a], self.zeros[b]);
        if self.whole {
            before..self.nodes - after
        } else {
            before.max(other_before)..self.nodes - after.max(other_after)
        }
    }
}

/// Solves for one column of a group; `x` is a buffer.
fn solve_lane(
    level: Level,
    factorisation: &Factorisation,
    (columns, solved, lane): (&[Block], &mut [Block], usize),
    x: &mut Vec<f64>,
) {
    x.clear();
    x.extend(columns.iter().flat_map(|block| block.0.iter().map(move |row| row[lane])));
    factorisation.solve(level, x);
    let entries = solved.iter_mut().flat_map(|block| block.0.iter_mut().map(move |row| &mut row[lane]));
    entries.zip(&*x).for_each(|(entry, x)| *entry = *x);
}

/// Computes `y -= M x`.
#[inline(always)]
fn subtract_product<S: Simd>(simd: S, m: &Block, x: &Columns<S>, y: &mut Columns<S>) {
    for k in 0..6 {
        for r in 0..6 {
            y[r] -= x[k] * splat(simd, m.0[k][r]);
        }
    }
}

/// Returns S^-1 y of a node, of eight columns at a time; its entries as in [`substitution`].
#[inline(always)]
pub(super) fn solve_node<S: Simd>(simd: S, node: &Node, mut y: Columns<S>) -> Columns<S> {
    let (columns, inverse) = (&node.columns.0, &node.inverse);
    for k in 0..5 {
        let scaled = y[k] * splat(simd, inverse[k]);
        for r in k + 1..6 {
            y[r] -= scaled * splat(simd, columns[k][r]);
        }
    }
    for k in (0..6).rev() {
        y[k] *= splat(simd, inverse[k]);
        for r in 0..k {
            y[r] -= y[k] * splat(simd, columns[k][r]);
        }
    }
    y
}

/// Stores six columns, or rows, of a block.
#[inline(always)]
pub(super) fn store_block<S: Simd>(rows: &Columns<S>, block: &mut Block) {
    for k in 0..6 {
        rows[k].store_array(&mut block.0[k]);
    }
}

/// Brings the columns of a group to the middle node.
#[inline(always)]
fn sweep_inwards<S: Simd>(simd: S, nodes: &[Node], (columns, solved): (&mut [Block], &mut [Block]), zeros: [usize; 2]) {
    let n = nodes.len();
    let middle = n / 2;
    let mut at_middle = load_block(simd, &columns[middle]);
    for (side, length) in [middle, n - 1 - middle].into_iter().enumerate() {
        let mut carried = [splat(simd, 0.0); 6];
        for s in zeros[side]..length {
            let i = if side == 0 { s } else { n - 1 - s };
            let own = load_block(simd, &columns[i]);
            let y: Columns<S> = core::array::from_fn(|k| own[k] + carried[k]);
            store_block(&y, &mut columns[i]);
            store_block(&solve_node(simd, &nodes[i], y), &mut solved[i]);
            carried = [splat(simd, 0.0); 6];
            subtract_product(simd, &nodes[i].gain, &y, &mut carried);
        }
        (0..6).for_each(|k| at_middle[k] += carried[k]);
    }
    store_block(&at_middle, &mut columns[middle]);
    store_block(&solve_node(simd, &nodes[middle], at_middle), &mut solved[middle]);
}

#[inline(always)]
fn subtract_from<S: Simd>(simd: S, border: &SchurComplement, w: &mut [f64]) {
    let (count, groups) = (border.count, border.zeros.len());
    for a in 0..groups {
        for b in a..groups {
            let (range, (columns, _), (_, solved)) = (border.common(a, b), border.group(a), border.group(b));
            for first in (0..LANES).step_by(ROWS).take_while(|first| LANES * a + first < count) {
                let mut sums = [splat(simd, 0.0); ROWS];
                for (y, x) in columns[range.clone()].iter().zip(&solved[range.clone()]) {
                    for k in 0..6 {
                        let x = load(simd, &x.0[k]);
                        for r in 0..ROWS {
                            sums[r] += splat(simd, y.0[k][first + r]) * x;
                        }
                    }
                }
                for (row, sums) in (LANES * a + first..count).zip(sums) {
                    for (lane, column) in (LANES * b..count.min(LANES * (b + 1))).enumerate() {
                        if column >= row {
                            w[row * count + column] -= sums[lane];
                        }
                        if column > row {
                            w[column * count + row] -= sums[lane];
                        }
                    }
                }
            }
        }
    }
}

#[inline(always)]
fn reduce<S: Simd>(simd: S, border: &SchurComplement, factors: Option<&[Node]>, b: &mut [[f64; 6]], out: &mut [f64]) {
    if let Some(nodes) = factors.filter(|nodes| !nodes.is_empty()) {
        substitution::sweep_inwards(simd, nodes, b);
    }
    for (group, out) in out.chunks_mut(LANES).enumerate() {
        let [before, after] = border.zeros[group];
        let range = before..border.nodes - after;
        let mut sums = splat(simd, 0.0);
        for (y, z) in border.group(group).0[range.clone()].iter().zip(&b[range]) {
            for k in 0..6 {
                sums += load(simd, &y.0[k]) * splat(simd, z[k]);
            }
        }
        out.iter_mut().enumerate().for_each(|(lane, out)| *out = sums[lane]);
    }
}

#[inline(always)]
fn expand<S: Simd>(simd: S, border: &SchurComplement, factors: Option<&[Node]>, d: &[f64], b: &mut [[f64; 6]]) {
    let n = border.nodes;
    for (i, six) in b.iter_mut().enumerate() {
        let mut sums = [splat(simd, 0.0); 6];
        for (group, amounts) in d.chunks(LANES).enumerate() {
            let [before, after] = border.zeros[group];
            if border.whole || (before..n - after).contains(&i) {
                let mut eight = [0.0; LANES];
                eight[..amounts.len()].copy_from_slice(amounts);
                let (eight, block) = (load(simd, &eight), &border.solved[group * n + i]);
                (0..6).for_each(|k| sums[k] += load(simd, &block.0[k]) * eight);
            }
        }
        let total: f64x8<S> = transpose_dots(&sums, splat(simd, 1.0));
        store_six(simd, load_six(simd, six) - total, six);
    }
    if let Some(nodes) = factors.filter(|nodes| !nodes.is_empty()) {
        substitution::sweep_outwards(simd, nodes, b);
    }
}
