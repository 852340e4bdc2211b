//! Eight-lane helpers: the six numbers of a node are in lanes 0..6 of an `f64x8`, lanes 6 and 7 are
//! 0.
//!
//! # Equation
//!
//! `transpose_dots` is y = A^T x for a block stored by columns, y_j = ((p0+p1)+(p2+p3)) +
//! ((p4+p5)+(p6+p7)) with p_i = A_ij x_i.
//!
//! # Validity
//!
//! Every operation is lane-wise or adds in the fixed order above, and no multiplication and
//! addition are fused, so the bits do not depend on the register width of the level.
//!
//! # References
//!
//! Golub & Van Loan, Matrix Computations, 4th ed., section 1.1 (the dot-product form of the
//! matrix-vector product).
//!
//! # Alternatives considered
//!
//! - `reduce_sum` of the SIMD crate: its order depends on the register width.
//! - Loads beyond the six numbers of a node: out of bounds at the last node, and a NaN of the
//!   neighbour would pass through 0 * NaN.

use super::block::Block;
use fearless_simd::{Simd, f64x2, f64x4, f64x8, mask64x8, prelude::*};

/// Six columns of eight lanes.
pub(super) type Columns<S> = [f64x8<S>; 6];

/// Returns lanes that are all equal to `value`.
#[inline(always)]
pub(super) fn splat<S: Simd>(simd: S, value: f64) -> f64x8<S> {
    f64x8::splat(simd, value)
}

/// Loads a column.
#[inline(always)]
pub(super) fn load<S: Simd>(simd: S, column: &[f64; 8]) -> f64x8<S> {
    f64x8::load_array_ref(simd, column)
}

/// Loads the six columns of a block.
#[inline(always)]
pub(super) fn load_block<S: Simd>(simd: S, block: &Block) -> Columns<S> {
    let b = &block.0;
    [load(simd, &b[0]), load(simd, &b[1]), load(simd, &b[2]), load(simd, &b[3]), load(simd, &b[4]), load(simd, &b[5])]
}

/// Loads the six columns of the transposed block.
#[inline(always)]
pub(super) fn load_transposed<S: Simd>(simd: S, block: &Block) -> Columns<S> {
    let (r0, r1) = row_pair::<S, 0>(simd, block);
    let (r2, r3) = row_pair::<S, 2>(simd, block);
    let (r4, r5) = row_pair::<S, 4>(simd, block);
    [r0, r1, r2, r3, r4, r5]
}

/// Loads rows `ROW` and `ROW + 1` of a block.
#[inline(always)]
fn row_pair<S: Simd, const ROW: usize>(simd: S, block: &Block) -> (f64x8<S>, f64x8<S>) {
    let pair = |column: usize| f64x2::from_slice(simd, &block.0[column][ROW..ROW + 2]);
    let zero = f64x2::splat(simd, 0.0);
    let quad = |a, b| simd.combine_f64x2(a, b);
    let low = simd.combine_f64x4(quad(pair(0), pair(1)), quad(pair(2), pair(3)));
    let high = simd.combine_f64x4(quad(pair(4), pair(5)), quad(zero, zero));
    (low.unzip_low(high), low.unzip_high(high))
}

/// Loads six consecutive numbers, padded with two zeros.
#[inline(always)]
pub(super) fn load_six<S: Simd>(simd: S, six: &[f64]) -> f64x8<S> {
    let low = f64x4::from_slice(simd, &six[..4]);
    let high = f64x2::from_slice(simd, &six[4..6]);
    simd.combine_f64x4(low, simd.combine_f64x2(high, f64x2::splat(simd, 0.0)))
}

/// Stores lanes 0..6.
#[inline(always)]
pub(super) fn store_six<S: Simd>(simd: S, value: f64x8<S>, six: &mut [f64]) {
    let (low, rest) = simd.split_f64x8(value);
    let (high, _) = simd.split_f64x4(rest);
    low.store_slice(&mut six[..4]);
    high.store_slice(&mut six[4..6]);
}

/// Returns the mask of the lanes after `lane`, up to lane 5.
#[inline(always)]
pub(super) fn after<S: Simd>(simd: S, lane: usize) -> mask64x8<S> {
    mask64x8::from_bitmask(simd, 0x3f & !((2u64 << lane) - 1))
}

/// Returns the mask of the lanes before `lane`.
#[inline(always)]
pub(super) fn before<S: Simd>(simd: S, lane: usize) -> mask64x8<S> {
    mask64x8::from_bitmask(simd, (1u64 << lane) - 1)
}

/// Returns the diagonal of a block given by columns; lanes 6 and 7 are the padding of column 0.
#[inline(always)]
pub(super) fn diagonal<S: Simd>(simd: S, columns: &Columns<S>) -> f64x8<S> {
    let mut value = columns[0];
    for k in 1..6 {
        value = mask64x8::from_bitmask(simd, 1 << k).select(columns[k], value);
    }
    value
}

/// Returns A x, the sum of the columns times x_j, added pairwise.
#[inline(always)]
pub(super) fn columns_times<S: Simd>(simd: S, columns: &Columns<S>, x: f64x8<S>) -> f64x8<S> {
    let mut p = *columns;
    for j in 0..6 {
        p[j] = columns[j] * splat(simd, x[j]);
    }
    ((p[0] + p[1]) + (p[2] + p[3])) + (p[4] + p[5])
}

/// Returns A^T x for a block given by columns: lane j is the dot product of column j with x.
#[inline(always)]
pub(super) fn transpose_dots<S: Simd>(columns: &Columns<S>, x: f64x8<S>) -> f64x8<S> {
    let mut p = *columns;
    for j in 0..6 {
        p[j] = columns[j] * x;
    }
    let (p01, p23, p45) = (fold(p[0], p[1]), fold(p[2], p[3]), fold(p[4], p[5]));
    fold(fold(p01, p23), fold(p45, p45))
}

/// Returns the sums of neighbours in `a`, then those in `b`.
#[inline(always)]
fn fold<S: Simd>(a: f64x8<S>, b: f64x8<S>) -> f64x8<S> {
    a.unzip_low(b) + a.unzip_high(b)
}
