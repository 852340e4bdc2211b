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
//! halves have one term. A *wall*, a node whose rows and columns are those of the identity, ends it
//! earlier. Only these nodes are stored. The sweep outwards is made once, for the solution. With
//! the [banded](super::banded) factors, A^-1 B takes the place of S^-1 Y, from wall to wall.
//!
//! Columns are in lanes, six at a time; no sum is across lanes but that of S^-1 Y d.
//!
//! # References
//!
//! Golub & Van Loan, Matrix Computations, 4th ed., section 4.5.1.
//!
//! # Alternatives considered
//!
//! Whole solutions for all columns, and their products with B: on a cable with 20 pins in 40
//! elements the condensation takes seven times as long. Eight columns at a time: rows of W in
//! blocks of six are those of a body, or of two pins.

use super::block::Block;
use super::factorisation::Factorisation;
use super::lanes::{Columns, load, load_block, load_six, splat, store_six, transpose_dots};
use super::substitution;
use super::twisted::Node;
use crate::simd::dispatch;
use fearless_simd::{Level, Simd, f64x8, prelude::*};

/// Layout: number of columns in a group.
pub(crate) const GROUP: usize = 6;
/// Layout: number of rows of the Schur complement that are summed at a time.
const ROWS: usize = 3;

/// The nodes from the first to before the second.
pub(crate) type Span = [usize; 2];

/// Returns the nodes that are in both.
fn common([a, b]: [Span; 2]) -> core::ops::Range<usize> {
    let first = a[0].max(b[0]);
    first..a[1].min(b[1]).max(first)
}

/// Entries of a column in successive nodes.
#[derive(Clone, Copy, Debug)]
struct Piece {
    column: usize,
    nodes: Span,
    /// Where its numbers begin.
    at: usize,
}

/// The columns of a border, and what the factors make of them.
#[derive(Clone, Debug, Default)]
pub struct SchurComplement {
    nodes: usize,
    count: usize,
    /// Nodes whose rows and columns are those of the identity, in ascending order.
    walls: Vec<usize>,
    /// B as it was given.
    pieces: Vec<Piece>,
    entries: Vec<f64>,
    /// B, then Y, by group of columns and node of its span: by coordinate, the six columns.
    columns: Vec<Block>,
    /// S^-1 Y, or A^-1 B, likewise.
    solved: Vec<Block>,
    /// By group, the nodes that it has in these, and where they begin.
    spans: Vec<Span>,
    starts: Vec<usize>,
    /// Whether `solved` is A^-1 B.
    whole: bool,
    /// One column.
    scratch: Vec<f64>,
}

impl SchurComplement {
    /// Begins anew with `count` columns of zeros for a matrix of a number of nodes.
    pub fn begin(&mut self, nodes: usize, count: usize) {
        (self.nodes, self.count, self.whole) = (nodes, count, false);
        self.walls.clear();
        self.pieces.clear();
        self.entries.clear();
        self.spans.clear();
        self.spans.resize(count.div_ceil(GROUP), [nodes, 0]);
    }

    /// Names the nodes, in ascending order, whose rows and columns in the matrix are those of the
    /// identity, and in whose rows no column has entries.
    pub(crate) fn set_walls(&mut self, walls: &[usize]) {
        self.walls.extend_from_slice(walls);
    }

    /// Sets the entries of a column in the nodes from `first` on, six numbers per node.
    ///
    /// # Panics
    /// If there is no such column or node.
    pub fn set(&mut self, column: usize, first: usize, rows: &[f64]) {
        assert!(column < self.count && 6 * first + rows.len() <= 6 * self.nodes, "place in the border");
        let is_entry = |six: &[f64]| six.iter().any(|x| *x != 0.0);
        let Some(begin) = rows.chunks_exact(6).position(is_entry) else { return };
        let end = 1 + rows.chunks_exact(6).rposition(is_entry).unwrap_or(begin);
        let nodes = [first + begin, first + end];
        self.pieces.push(Piece { column, nodes, at: self.entries.len() });
        self.entries.extend_from_slice(&rows[6 * begin..6 * end]);
        let span = &mut self.spans[column / GROUP];
        *span = [span[0].min(nodes[0]), span[1].max(nodes[1])];
    }

    /// Returns the nodes in which columns with entries in some nodes have any with such factors.
    pub(crate) fn spread(&self, factorisation: &Factorisation, [first, end]: Span) -> Span {
        if first >= end {
            return [0; 2];
        }
        let (middle, walls) = (self.nodes / 2, &self.walls);
        let next = |end: usize| walls.get(walls.partition_point(|wall| *wall < end)).copied().unwrap_or(self.nodes);
        let last =
            |first: usize| walls[..walls.partition_point(|wall| *wall < first)].last().map_or(0, |wall| wall + 1);
        if factorisation.twisted().is_none() {
            [last(first), next(end)]
        } else if end <= middle {
            [first, next(end).min(middle + 1)]
        } else if first > middle {
            [last(first).max(middle), end]
        } else {
            [first, end]
        }
    }

    /// Completes the columns with the factored matrix.
    ///
    /// # Panics
    /// If nothing has been factored successfully, or a matrix of another size.
    pub fn complete(&mut self, level: Level, factorisation: &Factorisation) {
        assert_eq!(factorisation.nodes(), self.nodes, "nodes of the matrix");
        let factors = factorisation.twisted();
        self.whole = factors.is_none();
        self.starts.clear();
        let mut size = 0;
        for group in 0..self.spans.len() {
            let span = self.spread(factorisation, self.spans[group]);
            self.spans[group] = span;
            self.starts.push(size);
            size += span[1] - span[0];
        }
        self.columns.clear();
        self.columns.resize(size, Block::ZERO);
        self.solved.resize(size, Block::ZERO);
        for &Piece { column, nodes, at } in &self.pieces {
            let (group, lane) = (column / GROUP, column % GROUP);
            let start = self.starts[group] + nodes[0] - self.spans[group][0];
            let sixes = self.entries[at..].chunks_exact(6).take(nodes[1] - nodes[0]);
            for (block, six) in self.columns[start..].iter_mut().zip(sixes) {
                (0..6).for_each(|k| block.0[k][lane] = six[k]);
            }
        }
        for (group, (&span, &start)) in
            self.spans.iter().zip(&self.starts).enumerate().filter(|(_, (s, _))| s[0] < s[1])
        {
            let range = start..start + span[1] - span[0];
            let parts = (&mut self.columns[range.clone()], &mut self.solved[range]);
            match factors {
                Some(nodes) => dispatch!(level, simd => sweep_inwards(simd, nodes, parts, span)),
                None => {
                    parts.1.fill(Block::ZERO);
                    for lane in 0..GROUP.min(self.count - GROUP * group) {
                        let parts = (&*parts.0, &mut *parts.1, lane);
                        solve_lane(level, factorisation, parts, span, &mut self.scratch);
                    }
                }
            }
        }
    }

    /// Computes `w -= B^T A^-1 B`, row-major and symmetric.
    pub fn subtract_from(&self, level: Level, w: &mut [f64]) {
        let (count, groups) = (self.count, self.spans.len());
        for [a, b] in (0..groups).flat_map(|a| (a..groups).map(move |b| [a, b])) {
            let mut product = Block::ZERO;
            self.subtract_products(level, &[[a, b]], core::slice::from_mut(&mut product));
            for (row, of_row) in (GROUP * a..count.min(GROUP * (a + 1))).zip(&product.0) {
                for (column, value) in (GROUP * b..count.min(GROUP * (b + 1))).zip(of_row) {
                    if column >= row {
                        w[row * count + column] += value;
                    }
                    if column > row {
                        w[column * count + row] += value;
                    }
                }
            }
        }
    }

    /// Subtracts from blocks of `B^T A^-1 B`, by rows, those of pairs of groups, the first at most
    /// the second. Of a group with itself it is the upper triangle that counts.
    pub(crate) fn subtract_products(&self, level: Level, pairs: &[[usize; 2]], blocks: &mut [Block]) {
        dispatch!(level, simd => subtract_products(simd, self, pairs, blocks));
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

    /// Returns those of the columns and of `solved` of a group that are in some nodes of its span.
    fn group(&self, group: usize, nodes: &core::ops::Range<usize>) -> (&[Block], &[Block]) {
        let at = self.starts[group] + nodes.start - self.spans[group][0];
        let range = at..at + nodes.len();
        (&self.columns[range.clone()], &self.solved[range])
    }

    /// Returns the nodes with terms of the product of two groups.
    pub(crate) fn common(&self, groups: [usize; 2]) -> core::ops::Range<usize> {
        common(groups.map(|group| self.spans[group]))
    }
}

/// Solves for one column of a group; `x` is a buffer.
fn solve_lane(
    level: Level,
    factorisation: &Factorisation,
    (columns, solved, lane): (&[Block], &mut [Block], usize),
    span: Span,
    x: &mut Vec<f64>,
) {
    x.clear();
    x.resize(6 * factorisation.nodes(), 0.0);
    let own = 6 * span[0]..6 * span[1];
    let entries = columns.iter().flat_map(|block| block.0.iter().map(move |row| row[lane]));
    x[own.clone()].iter_mut().zip(entries).for_each(|(x, entry)| *x = entry);
    factorisation.solve(level, x);
    let entries = solved.iter_mut().flat_map(|block| block.0.iter_mut().map(move |row| &mut row[lane]));
    entries.zip(&x[own]).for_each(|(entry, x)| *entry = *x);
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

/// Brings the columns of a group, which have the nodes of a span, to the middle node.
#[inline(always)]
fn sweep_inwards<S: Simd>(simd: S, nodes: &[Node], (columns, solved): (&mut [Block], &mut [Block]), span: Span) {
    let [first, end] = span;
    let middle = nodes.len() / 2;
    let mut at_middle = [splat(simd, 0.0); 6];
    let has_middle = first <= middle && middle < end;
    if has_middle {
        at_middle = load_block(simd, &columns[middle - first]);
    }
    for side in 0..2 {
        let mut carried = [splat(simd, 0.0); 6];
        let length = if side == 0 { end.min(middle).max(first) - first } else { end - first.max(middle + 1).min(end) };
        for s in 0..length {
            let i = if side == 0 { first + s } else { end - 1 - s };
            let own = load_block(simd, &columns[i - first]);
            let y: Columns<S> = core::array::from_fn(|k| own[k] + carried[k]);
            store_block(&y, &mut columns[i - first]);
            store_block(&solve_node(simd, &nodes[i], y), &mut solved[i - first]);
            carried = [splat(simd, 0.0); 6];
            subtract_product(simd, &nodes[i].gain, &y, &mut carried);
        }
        (0..6).for_each(|k| at_middle[k] += carried[k]);
    }
    if has_middle {
        store_block(&at_middle, &mut columns[middle - first]);
        store_block(&solve_node(simd, &nodes[middle], at_middle), &mut solved[middle - first]);
    }
}

#[inline(always)]
fn subtract_products<S: Simd>(simd: S, border: &SchurComplement, pairs: &[[usize; 2]], blocks: &mut [Block]) {
    for (&[a, b], block) in pairs.iter().zip(blocks) {
        let nodes = border.common([a, b]);
        if nodes.is_empty() {
            continue;
        }
        let ((columns, _), (_, solved)) = (border.group(a, &nodes), border.group(b, &nodes));
        for first in (0..GROUP).step_by(ROWS).take_while(|first| GROUP * a + first < border.count) {
            let mut sums = [splat(simd, 0.0); ROWS];
            for (y, x) in columns.iter().zip(solved) {
                for k in 0..6 {
                    let x = load(simd, &x.0[k]);
                    for r in 0..ROWS {
                        sums[r] += splat(simd, y.0[k][first + r]) * x;
                    }
                }
            }
            for r in 0..ROWS {
                let row = &mut block.0[first + r];
                (load(simd, row) - sums[r]).store_array(row);
            }
        }
    }
}

#[inline(always)]
fn reduce<S: Simd>(simd: S, border: &SchurComplement, factors: Option<&[Node]>, b: &mut [[f64; 6]], out: &mut [f64]) {
    if let Some(nodes) = factors.filter(|nodes| !nodes.is_empty()) {
        substitution::sweep_inwards(simd, nodes, b);
    }
    for (group, out) in out.chunks_mut(GROUP).enumerate() {
        let nodes = border.common([group; 2]);
        let mut sums = splat(simd, 0.0);
        for (y, z) in border.group(group, &nodes).0.iter().zip(&b[nodes]) {
            for k in 0..6 {
                sums += load(simd, &y.0[k]) * splat(simd, z[k]);
            }
        }
        out.iter_mut().enumerate().for_each(|(lane, out)| *out = sums[lane]);
    }
}

#[inline(always)]
fn expand<S: Simd>(simd: S, border: &SchurComplement, factors: Option<&[Node]>, d: &[f64], b: &mut [[f64; 6]]) {
    for (group, amounts) in d.chunks(GROUP).enumerate() {
        let nodes = border.common([group; 2]);
        let mut six = [0.0; 8];
        six[..amounts.len()].copy_from_slice(amounts);
        let (amounts, solved) = (load(simd, &six), border.group(group, &nodes).1);
        for (block, x) in solved.iter().zip(&mut b[nodes]) {
            let total: f64x8<S> = transpose_dots(&load_block(simd, block), amounts);
            store_six(simd, load_six(simd, x) - total, x);
        }
    }
    if let Some(nodes) = factors.filter(|nodes| !nodes.is_empty()) {
        substitution::sweep_outwards(simd, nodes, b);
    }
}
