//! Factorisation of positive definite matrices: block L D L^T from both ends towards the middle
//! node.
//!
//! # Equation
//!
//! S_0 = D_0, S_{i+1} = D_{i+1} - B_i S_i^-1 B_i^T from the first node, the same with B^T from the
//! last, and S_m = D_m minus both. With the scalar S_i = L d L^T and W = B L^-T the update is a sum
//! of six rank-1 terms, S_{i+1} -= sum_k (W_k / d_k) W_k^T. Stored for the solution are the columns
//! of S_i, 1/d_k and G_i = B_i S_i^-1, which is W d^-1 L^-1 by substitution.
//!
//! Two pivots at a time share their latency: 1/d_{k+1} = a / (a c - b^2) for the pending pivot
//! block (a b; b c), with an error of a few ulp of c, as of the usual formula.
//!
//! # Validity
//!
//! Accepted only if every pivot d satisfies d > 2^-42 a (a its entry in A) and 1e-140 < d, a <
//! 1e140 (so that a c - b^2 neither overflows nor underflows), and the factors are finite. 2^-42 is
//! about a thousand ulp: the rounding error of a pivot of a singular matrix is a few ulp times the
//! square root of the number of nodes.
//!
//! # References
//!
//! Golub & Van Loan, Matrix Computations, 4th ed., sections 4.1.2 and 4.5.1. Error bounds of the
//! block form for positive definite A: Demmel, Higham & Schreiber, Numer. Linear Algebra Appl. 2
//! (1995) 173.
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/solvers.md.

use super::block::{Block, BlockTridiagonal};
use super::lanes::{Columns, after, diagonal, load_block, load_transposed, splat};
use crate::scales::linalg::{MIN_PIVOT, RANGE};
use core::hint::black_box;
use fearless_simd::{Simd, f64x8, prelude::*};

/// Factors of one node.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    /// Column k: d_k l_rk for r > k, the pivot at r = k, d_r l_kr for r < k.
    pub(super) columns: Block,
    /// G = B S^-1 towards the middle node (unused at the middle node).
    pub(super) gain: Block,
    /// 1 / d_k.
    pub(super) inverse: [f64; 8],
}

impl Node {
    pub(super) const ZERO: Self = Self { columns: Block::ZERO, gain: Block::ZERO, inverse: [0.0; 8] };
}

/// The checks of the pivots so far.
#[derive(Clone, Copy)]
struct Health<S: Simd> {
    bad: bool,
    /// Any NaN or infinity in the factors makes this one NaN or infinite too.
    sum: f64x8<S>,
}

impl<S: Simd> Health<S> {
    #[inline(always)]
    fn inspect(&mut self, simd: S, columns: &Columns<S>, original: &Block) {
        let pivots = diagonal(simd, columns);
        let entries = diagonal(simd, &load_block(simd, original));
        // `max` may return either of NaN and RANGE: a NaN entry fails the last comparison anyway
        let least = (entries * splat(simd, MIN_PIVOT)).max(splat(simd, RANGE));
        let good = pivots.simd_gt(least).to_bitmask() & entries.simd_lt(splat(simd, 1.0 / RANGE)).to_bitmask();
        self.bad |= good & 0x3f != 0x3f;
        // column 0 has no upper triangle; lower triangles affect the pivots
        let [_, c1, c2, c3, c4, c5] = *columns;
        self.sum += (c1 + c2) + (c3 + c4) + c5;
    }
}

/// The elimination of one node.
struct Step<'a, S: Simd> {
    simd: S,
    /// Schur complement, eliminated in place.
    d: &'a mut Columns<S>,
    /// The coupling block, turned into W.
    w: Columns<S>,
    /// W_k / d_k.
    l: Columns<S>,
}

impl<S: Simd> Step<'_, S> {
    /// Returns 1 / d_K and 1 / d_{K+1} of the pending 2x2 pivot block.
    #[inline(always)]
    fn inverses<const K: usize>(&self) -> (f64, f64) {
        let (a, b, c) = (self.d[K][K], self.d[K][K + 1], self.d[K + 1][K + 1]);
        (1.0 / a, a * (1.0 / (a * c - b * b)))
    }

    #[inline(always)]
    fn pivot<const K: usize>(&mut self, inverse: f64, node: &mut Node) {
        let Self { simd, d, w, l } = self;
        d[K].store_array(&mut node.columns.0[K]);
        w[K].store_array(&mut node.gain.0[K]);
        let node = black_box(node);
        let inverse = splat(*simd, inverse);
        let below = after(*simd, K).select(d[K] * inverse, splat(*simd, 0.0));
        l[K] = w[K] * inverse;
        for c in K + 1..6 {
            let u = splat(*simd, node.columns.0[K][c]);
            d[c] -= below * u;
            w[c] -= l[K] * u;
        }
    }

    #[inline(always)]
    fn eliminate(&mut self, node: &mut Node) {
        let (i0, i1) = self.inverses::<0>();
        self.pivot::<0>(i0, node);
        self.pivot::<1>(i1, node);
        let (i2, i3) = self.inverses::<2>();
        self.pivot::<2>(i2, node);
        self.pivot::<3>(i3, node);
        let (i4, i5) = self.inverses::<4>();
        self.pivot::<4>(i4, node);
        self.pivot::<5>(i5, node);
        node.inverse = [i0, i1, i2, i3, i4, i5, 0.0, 0.0];
    }
}

/// Blocks of the matrix that the elimination of a node reads.
struct Blocks<'a, S: Simd> {
    /// Block between the node and the next one, rows of the next.
    coupling: Columns<S>,
    /// Diagonal block of the next node.
    next: Columns<S>,
    /// Diagonal block of the node.
    original: &'a Block,
}

/// Eliminates a node: `d` is its Schur complement on entry and that of the next node on return.
#[inline(always)]
fn eliminate_node<S: Simd>(
    simd: S,
    d: &mut Columns<S>,
    Blocks { coupling, next, original }: Blocks<'_, S>,
    node: &mut Node,
    health: &mut Health<S>,
) {
    let l = [splat(simd, 0.0); 6];
    let w = coupling;
    let mut step = Step { simd, d, w, l };
    step.eliminate(node);
    let Step { d, w, l, .. } = step;
    health.inspect(simd, d, original);

    let node = black_box(node); // its `gain` holds W for now
    for c in 0..6 {
        let p = |k: usize| l[k] * splat(simd, node.gain.0[k][c]);
        d[c] = next[c] - p(0) - p(1) - p(2) - p(3) - p(4) - p(5);
    }
    let mut gain = w;
    for k in (0..6).rev() {
        for j in k + 1..6 {
            gain[k] -= gain[j] * splat(simd, node.columns.0[k][j]);
        }
        gain[k] *= splat(simd, node.inverse[k]);
    }
    // column 0 contains every other column times something, 0 * infinity included
    health.sum += gain[0];
    for c in 0..6 {
        gain[c].store_array(&mut node.gain.0[c]);
    }
}

/// Factors `a` (at least one node) into `nodes` (as many), and returns whether the matrix is safely
/// positive definite.
#[inline(always)]
pub(super) fn factor<S: Simd>(simd: S, a: &BlockTridiagonal, nodes: &mut [Node]) -> bool {
    let n = a.diag.len();
    let middle = n / 2;
    let from_below = n - 1 - middle;
    let zero = splat(simd, 0.0);
    let mut health = Health { bad: false, sum: zero };
    let diag = &a.diag[..n];
    let lower = &a.lower[..n - 1];
    let nodes = &mut nodes[..n];
    let mut top = load_block(simd, &diag[0]);
    let mut bottom = load_block(simd, &diag[n - 1]);
    for s in 0..from_below {
        let (i, j) = (s, n - 1 - s);
        let coupling = load_block(simd, &lower[i]);
        let next = load_block(simd, &diag[i + 1]);
        let blocks = Blocks { coupling, next, original: &diag[i] };
        eliminate_node(simd, &mut top, blocks, &mut nodes[i], &mut health);
        let coupling = load_transposed(simd, &lower[j - 1]);
        // the middle node's own block is added with `top`
        let last = s + 1 == from_below;
        let next = if last { [zero; 6] } else { load_block(simd, &diag[j - 1]) };
        let blocks = Blocks { coupling, next, original: &diag[j] };
        eliminate_node(simd, &mut bottom, blocks, &mut nodes[j], &mut health);
    }
    if middle > from_below {
        let i = middle - 1;
        let coupling = load_block(simd, &lower[i]);
        let next = load_block(simd, &diag[middle]);
        let blocks = Blocks { coupling, next, original: &diag[i] };
        eliminate_node(simd, &mut top, blocks, &mut nodes[i], &mut health);
    }
    if from_below > 0 {
        for c in 0..6 {
            top[c] += bottom[c];
        }
    }
    let mut step = Step { simd, d: &mut top, w: [zero; 6], l: [zero; 6] };
    step.eliminate(&mut nodes[middle]);
    health.inspect(simd, &top, &diag[middle]);
    let finite = (health.sum * zero).simd_eq(zero).to_bitmask() & 0x3f == 0x3f;
    finite && !health.bad
}
