//! Symmetric block-tridiagonal matrix of 6x6 blocks.
//!
//! # Validity
//!
//! Any finite entries; the caller keeps each diagonal block symmetric.
//!
//! # Alternatives considered
//!
//! - Packed 6x6 storage: of 36 numbers, a column straddles registers and cache lines.
//! - Storing one triangle of the diagonal blocks: it saves a quarter of the memory and costs a
//!   transposition at every use.

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

    /// Panics unless `lower` has one block less than `diag`.
    pub(super) fn check(&self) {
        let expected = self.nodes().saturating_sub(1);
        assert_eq!(self.lower.len(), expected, "number of lower blocks");
    }
}
