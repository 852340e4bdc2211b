//! Symmetric block-tridiagonal matrix of 6x6 blocks, and y = A x.
//!
//! # Equation
//!
//! y_i = D_i x_i + B_{i-1} x_{i-1} + B_i^T x_{i+1}
//!
//! # Validity
//!
//! Any finite entries; the caller keeps each diagonal block symmetric.
//!
//! # References
//!
//! Golub & Van Loan, Matrix Computations, 4th ed., section 4.5.1.
//!
//! # Alternatives considered
//!
//! - Packed 6x6 storage: of 36 numbers, a column straddles registers and cache lines.
//! - Storing one triangle of the diagonal blocks: it saves a quarter of the memory and costs a
//!   transposition at every use.

use super::lanes::{columns_times, load_block, load_six, store_six, transpose_dots};
use fearless_simd::{Level, Simd, dispatch};

/// One 6x6 block, column-major; column j is `.0[j]`, rows 6 and 7 are padding and always 0.0.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block(pub [[f64; 8]; 6]);

impl Block {
    /// The zero block.
    pub const ZERO: Self = Self([[0.0; 8]; 6]);
}

impl Default for Block {
    fn default() -> Self {
        Self::ZERO
    }
}

/// A = A^T. `diag[i]` is symmetric with both triangles stored; `lower[i]` is the block at row-node
/// i + 1, column-node i, so it has one entry less than `diag`.
#[derive(Clone, Debug, Default)]
pub struct BlockTridiagonal {
    /// Diagonal blocks.
    pub diag: Vec<Block>,
    /// Blocks below the diagonal.
    pub lower: Vec<Block>,
}

impl BlockTridiagonal {
    /// Returns the zero matrix of a number of nodes.
    pub fn zeros(nodes: usize) -> Self {
        let mut matrix = Self::default();
        matrix.resize(nodes);
        matrix
    }

    /// Changes the number of nodes; remaining blocks keep their entries, new ones are zero.
    pub fn resize(&mut self, nodes: usize) {
        self.diag.resize(nodes, Block::ZERO);
        self.lower.resize(nodes.saturating_sub(1), Block::ZERO);
    }

    /// Sets every entry to zero, keeping the size.
    pub fn clear(&mut self) {
        self.diag.fill(Block::ZERO);
        self.lower.fill(Block::ZERO);
    }

    /// Returns the number of nodes.
    pub fn nodes(&self) -> usize {
        self.diag.len()
    }

    /// Computes y = A x; both have length 6 * nodes.
    ///
    /// # Panics
    /// If a length does not match.
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) {
        self.check();
        assert_eq!(x.len(), 6 * self.nodes(), "length of x");
        assert_eq!(y.len(), 6 * self.nodes(), "length of y");
        dispatch!(Level::new(), simd => multiply(simd, self, x, y));
    }

    /// Panics unless `lower` has one block less than `diag`.
    pub(super) fn check(&self) {
        let expected = self.nodes().saturating_sub(1);
        assert_eq!(self.lower.len(), expected, "number of lower blocks");
    }
}

#[inline(always)]
fn multiply<S: Simd>(simd: S, a: &BlockTridiagonal, x: &[f64], y: &mut [f64]) {
    let (x, _) = x.as_chunks::<6>();
    let (y, _) = y.as_chunks_mut::<6>();
    for i in 0..a.diag.len() {
        let here = load_six(simd, &x[i]);
        let mut sum = columns_times(simd, &load_block(simd, &a.diag[i]), here);
        if i > 0 {
            let before = load_six(simd, &x[i - 1]);
            sum += columns_times(simd, &load_block(simd, &a.lower[i - 1]), before);
        }
        if i + 1 < x.len() {
            let after = load_six(simd, &x[i + 1]);
            sum += transpose_dots(&load_block(simd, &a.lower[i]), after);
        }
        store_six(simd, sum, &mut y[i]);
    }
}
