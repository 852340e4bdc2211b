//! Mass matrix of a cable: (2x2 scalar blocks, tridiagonal) x I_3, symmetric positive definite.
//!
//! # Equation
//!
//! M a = f with the node blocks (rr rt; rt tt) x I_3, where position r and slope t have three
//! components each. Block L D L^T from both ends towards the middle node as for the stiffness, with
//! the 2x2 Schur complements S = (1 0; l 1) diag(p, q) (1 l; 0 1) and G = B S^-1.
//!
//! # Validity
//!
//! Positive definite M; pivots below 2^-42 of their diagonal entry, and entries that are not
//! finite, are an error.
//!
//! # References
//!
//! Golub & Van Loan, Matrix Computations, 4th ed., section 4.5.1.
//!
//! # Alternatives considered
//!
//! - Lumping: the slope inertia then depends on a free choice.
//! - A banded scalar factor: its chain of dependent operations is twice as long.
//! - The explicit inverse: it is dense.

use super::outcome::{Reason, SingularMatrix};
use crate::scales::linalg::MIN_PIVOT;
use crate::simd::dispatch;
use fearless_simd::{Level, Simd, f64x4, prelude::*};

/// Mass matrix: per unknown ordering of a node r (3 numbers), t (3 numbers).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MassMatrix {
    /// rr, rt, tt of each node.
    pub diag: Vec<[f64; 3]>,
    /// Block at row-node i + 1, column-node i: rr, rt, tr, tt (row unknown first).
    pub lower: Vec<[f64; 4]>,
}

impl MassMatrix {
    /// Returns the zero matrix of a number of nodes.
    pub fn zeros(nodes: usize) -> Self {
        Self { diag: vec![[0.0; 3]; nodes], lower: vec![[0.0; 4]; nodes.saturating_sub(1)] }
    }

    /// Returns the number of nodes.
    pub fn nodes(&self) -> usize {
        self.diag.len()
    }

    /// Computes y = M x; both have length 6 * nodes.
    ///
    /// # Panics
    /// If a length does not match.
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) {
        self.multiply_at(Level::new(), x, y);
    }

    /// Returns the mass of all.
    pub fn total(&self) -> f64 {
        self.diag.iter().map(|diag| diag[0]).sum::<f64>() + 2.0 * self.lower.iter().map(|lower| lower[0]).sum::<f64>()
    }

    /// Returns x M x; `x` has length 6 * nodes.
    pub fn quadratic(&self, x: &[f64]) -> f64 {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let (nodes, _) = x.as_chunks::<6>();
        let own = self.diag.iter().zip(nodes).map(|([rr, rt, tt], x)| {
            let (r, t) = x.split_at(3);
            rr * dot(r, r) + 2.0 * rt * dot(r, t) + tt * dot(t, t)
        });
        let between = self.lower.iter().zip(nodes.windows(2)).map(|([rr, rt, tr, tt], pair)| {
            let ((r0, t0), (r, t)) = (pair[0].split_at(3), pair[1].split_at(3));
            2.0 * (rr * dot(r, r0) + rt * dot(r, t0) + tr * dot(t, r0) + tt * dot(t, t0))
        });
        own.sum::<f64>() + between.sum::<f64>()
    }

    /// Returns the sum of the rows of positions of M x, the momentum of velocities x.
    pub fn momentum(&self, x: &[f64]) -> [f64; 3] {
        let (nodes, _) = x.as_chunks::<6>();
        let sum = |r: f64, t: f64, x: &[f64; 6]| [0, 1, 2].map(|i| r * x[i] + t * x[i + 3]);
        let own = self.diag.iter().zip(nodes).map(|([rr, rt, _], x)| sum(*rr, *rt, x));
        let below = self.lower.iter().zip(nodes).map(|([rr, rt, ..], x)| sum(*rr, *rt, x));
        let above = self.lower.iter().zip(&nodes[1..]).map(|([rr, _, tr, _], x)| sum(*rr, *tr, x));
        own.chain(below).chain(above).fold([0.0; 3], |a, b| [0, 1, 2].map(|i| a[i] + b[i]))
    }

    /// Computes y = M x as [`multiply`](Self::multiply) does, with the instructions of `level`.
    ///
    /// # Panics
    /// If a length does not match.
    pub fn multiply_at(&self, level: Level, x: &[f64], y: &mut [f64]) {
        let n = self.nodes();
        assert_eq!(self.lower.len(), n.saturating_sub(1), "number of lower blocks");
        assert_eq!(x.len(), 6 * n, "length of x");
        assert_eq!(y.len(), 6 * n, "length of y");
        dispatch!(level, simd => multiply(simd, self, x, y));
    }
}

/// r and t of a node, padded.
type Pair<S> = [f64x4<S>; 2];

#[inline(always)]
fn load<S: Simd>(simd: S, v: &[f64; 6]) -> Pair<S> {
    [f64x4::load_array(simd, [v[0], v[1], v[2], 0.0]), f64x4::load_array(simd, [v[3], v[4], v[5], 0.0])]
}

#[inline(always)]
fn store<S: Simd>(v: Pair<S>, out: &mut [f64; 6]) {
    out[..3].copy_from_slice(&v[0].as_array()[..3]);
    out[3..].copy_from_slice(&v[1].as_array()[..3]);
}

/// Returns y - (g0 g1; g2 g3) x.
#[inline(always)]
fn minus<S: Simd>(simd: S, y: Pair<S>, g: [f64; 4], x: Pair<S>) -> Pair<S> {
    let (g0, g1) = (f64x4::splat(simd, g[0]), f64x4::splat(simd, g[1]));
    let (g2, g3) = (f64x4::splat(simd, g[2]), f64x4::splat(simd, g[3]));
    [y[0] - (g0 * x[0] + g1 * x[1]), y[1] - (g2 * x[0] + g3 * x[1])]
}

#[inline(always)]
fn multiply<S: Simd>(simd: S, m: &MassMatrix, x: &[f64], y: &mut [f64]) {
    let (x, _) = x.as_chunks::<6>();
    let (y, _) = y.as_chunks_mut::<6>();
    let zero = f64x4::splat(simd, 0.0);
    let Some(first) = x.first() else { return };
    let (mut before, mut here) = ([zero; 2], load(simd, first));
    for i in 0..m.diag.len() {
        let [rr, rt, tt] = m.diag[i];
        let mut sum = minus(simd, [zero; 2], [rr, rt, rt, tt], here);
        if i > 0 {
            sum = minus(simd, sum, m.lower[i - 1], before);
        }
        before = here;
        if i + 1 < x.len() {
            here = load(simd, &x[i + 1]);
            sum = minus(simd, sum, transposed(m.lower[i]), here);
        }
        store([zero - sum[0], zero - sum[1]], &mut y[i]);
    }
}

#[inline(always)]
fn transposed([a, b, c, d]: [f64; 4]) -> [f64; 4] {
    [a, c, b, d]
}

/// Factors of one node.
#[derive(Clone, Copy, Debug, Default)]
struct Node {
    /// G towards the middle node.
    gain: [f64; 4],
    /// l, 1/p, 1/q.
    inner: [f64; 3],
}

/// A factored mass matrix, with buffers that are reused.
#[derive(Clone, Debug, Default)]
pub struct MassFactorisation {
    nodes: Vec<Node>,
}

/// Factors S = (rr, rt, tt) into l, 1/p, 1/q; `entries` are those of the matrix.
fn eliminate(s: [f64; 3], entries: [f64; 3], node: usize) -> Result<[f64; 3], SingularMatrix> {
    let l = s[1] / s[0];
    let q = s[2] - l * s[1];
    for (pivot, scale) in [(s[0], entries[0]), (q, entries[2])] {
        let inverse = 1.0 / pivot;
        if !pivot.is_finite() || !scale.is_finite() {
            let (pivot, scale, reason) = (0.0, 0.0, Reason::NonFinite);
            return Err(SingularMatrix { node, pivot, scale, reason });
        }
        if pivot <= MIN_PIVOT * scale || pivot <= 0.0 || !inverse.is_finite() {
            return Err(SingularMatrix { node, pivot, scale, reason: Reason::NotPositive });
        }
    }
    Ok([l, 1.0 / s[0], 1.0 / q])
}

/// Returns B S^-1.
fn gain(b: [f64; 4], [l, p, q]: [f64; 3]) -> [f64; 4] {
    let row = |r: f64, t: f64| {
        let t = (t - l * r) * q;
        (r * p - l * t, t)
    };
    let ((g0, g1), (g2, g3)) = (row(b[0], b[1]), row(b[2], b[3]));
    [g0, g1, g2, g3]
}

/// Returns S - G B^T.
fn schur(s: [f64; 3], g: [f64; 4], b: [f64; 4]) -> [f64; 3] {
    [s[0] - (g[0] * b[0] + g[1] * b[1]), s[1] - (g[2] * b[0] + g[3] * b[1]), s[2] - (g[2] * b[2] + g[3] * b[3])]
}

impl MassFactorisation {
    /// Factors `m`. Allocates only if it is larger than all previous matrices.
    ///
    /// # Errors
    /// If the matrix is not positive definite or not finite; `solve` must not be called then.
    ///
    /// # Panics
    /// If the numbers of diagonal and lower blocks do not match.
    pub fn factor(&mut self, m: &MassMatrix) -> Result<(), SingularMatrix> {
        let n = m.nodes();
        assert_eq!(m.lower.len(), n.saturating_sub(1), "number of lower blocks");
        self.nodes.clear();
        let result = self.factor_into(m);
        if result.is_err() {
            self.nodes.clear();
        }
        result
    }

    fn factor_into(&mut self, m: &MassMatrix) -> Result<(), SingularMatrix> {
        let n = m.nodes();
        if n == 0 {
            return Ok(());
        }
        self.nodes.resize(n, Node::default());
        let middle = n / 2;
        let mut top = m.diag[0];
        for i in 0..middle {
            let inner = eliminate(top, m.diag[i], i)?;
            let gain = gain(m.lower[i], inner);
            finite(&gain, i)?;
            self.nodes[i] = Node { gain, inner };
            top = schur(m.diag[i + 1], gain, m.lower[i]);
        }
        let mut bottom = m.diag[n - 1];
        for i in (middle + 1..n).rev() {
            let coupling = transposed(m.lower[i - 1]);
            let inner = eliminate(bottom, m.diag[i], i)?;
            let gain = gain(coupling, inner);
            finite(&gain, i)?;
            self.nodes[i] = Node { gain, inner };
            let next = if i - 1 == middle { top } else { m.diag[i - 1] };
            bottom = schur(next, gain, coupling);
        }
        let last = if middle + 1 < n { bottom } else { top };
        let inner = eliminate(last, m.diag[middle], middle)?;
        finite(&inner, middle)?;
        self.nodes[middle] = Node { gain: [0.0; 4], inner };
        Ok(())
    }

    /// Returns the number of nodes of the factored matrix, 0 after an error.
    pub fn nodes(&self) -> usize {
        self.nodes.len()
    }

    /// Replaces `rhs` (6 numbers per node) by M^-1 rhs.
    ///
    /// # Panics
    /// If the length does not match the matrix that was factored last (successfully).
    pub fn solve(&self, level: Level, rhs: &mut [f64]) {
        assert_eq!(rhs.len(), 6 * self.nodes.len(), "length of the right-hand side");
        let (rhs, _) = rhs.as_chunks_mut::<6>();
        if !rhs.is_empty() {
            dispatch!(level, simd => solve(simd, &self.nodes, rhs));
        }
    }
}

fn finite(values: &[f64], node: usize) -> Result<(), SingularMatrix> {
    if values.iter().all(|v| v.is_finite()) {
        return Ok(());
    }
    let (pivot, scale, reason) = (0.0, 0.0, Reason::NonFinite);
    Err(SingularMatrix { node, pivot, scale, reason })
}

/// Returns S^-1 b.
#[inline(always)]
fn inner<S: Simd>(simd: S, node: &Node, b: Pair<S>) -> Pair<S> {
    let [l, p, q] = node.inner;
    let (l, p, q) = (f64x4::splat(simd, l), f64x4::splat(simd, p), f64x4::splat(simd, q));
    let t = (b[1] - l * b[0]) * q;
    [b[0] * p - l * t, t]
}

#[inline(always)]
fn solve<S: Simd>(simd: S, nodes: &[Node], rhs: &mut [[f64; 6]]) {
    let n = nodes.len();
    let rhs = &mut rhs[..n];
    let middle = n / 2;
    let from_below = n - 1 - middle;
    let mut top = load(simd, &rhs[0]);
    let mut bottom = load(simd, &rhs[n - 1]);
    let zero = f64x4::splat(simd, 0.0);
    for s in 0..middle {
        let (i, j) = (s, n - 1 - s);
        let c = inner(simd, &nodes[i], top);
        top = minus(simd, load(simd, &rhs[i + 1]), nodes[i].gain, top);
        store(c, &mut rhs[i]);
        if s < from_below {
            let c = inner(simd, &nodes[j], bottom);
            // the middle node's own entries arrive through `top`
            let last = s + 1 == from_below;
            let next = if last { [zero; 2] } else { load(simd, &rhs[j - 1]) };
            bottom = minus(simd, next, nodes[j].gain, bottom);
            store(c, &mut rhs[j]);
        }
    }
    if from_below > 0 {
        top = [top[0] + bottom[0], top[1] + bottom[1]];
    }
    top = inner(simd, &nodes[middle], top);
    bottom = top;
    store(top, &mut rhs[middle]);
    for s in (0..middle).rev() {
        let (i, j) = (s, n - 1 - s);
        top = minus(simd, load(simd, &rhs[i]), transposed(nodes[i].gain), top);
        store(top, &mut rhs[i]);
        if s < from_below {
            bottom = minus(simd, load(simd, &rhs[j]), transposed(nodes[j].gain), bottom);
            store(bottom, &mut rhs[j]);
        }
    }
}
