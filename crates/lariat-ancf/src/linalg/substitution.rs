//! Substitution with the factors of the two-ended elimination.
//!
//! # Equation
//!
//! With G_i = B_i S_i^-1 towards the middle node m,
//!
//! ```text
//! inwards   b_{i+1} -= G_i b_i,  c_i = S_i^-1 b_i
//! middle    x_m = c_m
//! outwards  x_i = c_i - G_i^T x_{i+1}
//! ```
//!
//! for the block factors (I + G) S (I + G)^T. S_i^-1 is applied by substitution with the scalar L D
//! L^T of S_i, never as an inverse.
//!
//! # Validity
//!
//! After an accepted factorisation.
//!
//! # References
//!
//! Golub & Van Loan, Matrix Computations, 4th ed., section 4.5.1.
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/solvers.md.

use super::lanes::{after, before, columns_times, load, load_block, load_six, splat, store_six, transpose_dots};
use super::twisted::Node;
use fearless_simd::{Simd, f64x8, prelude::*};

/// Returns S^-1 b. Column k of `node.columns` holds the unscaled u_rk = d_k l_rk below and, by
/// symmetry, u_kr above the diagonal; times 1/d_k it serves both triangles.
#[inline(always)]
pub(super) fn solve_block<S: Simd>(simd: S, node: &Node, b: f64x8<S>) -> f64x8<S> {
    let columns = load_block(simd, &node.columns);
    let scaled = |k: usize| columns[k] * splat(simd, node.inverse[k]);
    let mut y = b;
    for k in 0..5 {
        y = after(simd, k).select(y - scaled(k) * splat(simd, y[k]), y);
    }
    for k in (1..6).rev() {
        y = before(simd, k).select(y - scaled(k) * splat(simd, y[k]), y);
    }
    y * load(simd, &node.inverse)
}

/// Returns the number of nodes before the first whose entries are not all +0.
#[inline(always)]
fn zeros(rhs: &[[f64; 6]]) -> usize {
    rhs.iter().position(|six| six.iter().any(|x| x.to_bits() != 0)).unwrap_or(rhs.len())
}

/// Solves in place for a right-hand side of `nodes.len()` nodes.
#[inline(always)]
pub(super) fn solve<S: Simd>(simd: S, nodes: &[Node], rhs: &mut [[f64; 6]]) {
    sweep_inwards(simd, nodes, rhs);
    sweep_outwards(simd, nodes, rhs);
}

/// Replaces a right-hand side by S^-1 b after the sweep inwards.
#[inline(always)]
pub(super) fn sweep_inwards<S: Simd>(simd: S, nodes: &[Node], rhs: &mut [[f64; 6]]) {
    let n = nodes.len();
    let middle = n / 2;
    let from_below = n - 1 - middle;
    let zero = splat(simd, 0.0);
    let rhs = &mut rhs[..n];
    let begin = zeros(&rhs[..middle]);
    let mut top = load_six(simd, &rhs[0]);
    let mut bottom = load_six(simd, &rhs[n - 1]);

    for s in 0..middle {
        let (i, j) = (s, n - 1 - s);
        if i < begin {
            top = load_six(simd, &rhs[i + 1]);
        } else {
            let gain = load_block(simd, &nodes[i].gain);
            let c = solve_block(simd, &nodes[i], top);
            top = load_six(simd, &rhs[i + 1]) - columns_times(simd, &gain, top);
            store_six(simd, c, &mut rhs[i]);
        }
        if s < from_below {
            let gain = load_block(simd, &nodes[j].gain);
            let c = solve_block(simd, &nodes[j], bottom);
            // the middle node's own entries arrive through `top`
            let last = s + 1 == from_below;
            let next = if last { zero } else { load_six(simd, &rhs[j - 1]) };
            bottom = next - columns_times(simd, &gain, bottom);
            store_six(simd, c, &mut rhs[j]);
        }
    }
    if from_below > 0 {
        top += bottom;
    }
    store_six(simd, solve_block(simd, &nodes[middle], top), &mut rhs[middle]);
}

/// Completes S^-1 b, after the sweep inwards, to the solution.
#[inline(always)]
pub(super) fn sweep_outwards<S: Simd>(simd: S, nodes: &[Node], rhs: &mut [[f64; 6]]) {
    let n = nodes.len();
    let middle = n / 2;
    let from_below = n - 1 - middle;
    let rhs = &mut rhs[..n];
    let mut top = load_six(simd, &rhs[middle]);
    let mut bottom = top;
    for s in (0..middle).rev() {
        let (i, j) = (s, n - 1 - s);
        let gain = load_block(simd, &nodes[i].gain);
        top = load_six(simd, &rhs[i]) - transpose_dots(&gain, top);
        store_six(simd, top, &mut rhs[i]);
        if s < from_below {
            let gain = load_block(simd, &nodes[j].gain);
            bottom = load_six(simd, &rhs[j]) - transpose_dots(&gain, bottom);
            store_six(simd, bottom, &mut rhs[j]);
        }
    }
}
