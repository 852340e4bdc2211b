//! Factorisation of indefinite matrices: L U with partial pivoting of the equilibrated band.
//!
//! # Equation
//!
//! P S A S = L U, A^-1 = S (P^T L U)^-1 S, with 11 diagonals below, 11 above, and 22 above after
//! the interchanges. The condition number follows from Hager's estimate of |A^-1|_1, for which A =
//! A^T saves the solution with the transposed matrix.
//!
//! # Validity
//!
//! Accepted only if the entries grew by no more than 2^20 and the estimated reciprocal condition
//! number of the equilibrated matrix is at least 2^-48.
//!
//! # References
//!
//! Golub & Van Loan, Matrix Computations, 4th ed., sections 3.4, 3.5.4 and 4.3.3; Higham, Accuracy
//! and Stability, 2nd ed., algorithm 15.1.
//!
//! # Alternatives considered
//!
//! - Bunch-Kaufman and complete pivoting: symmetric interchanges fill the band.
//! - A threshold on single pivots: no pivot of a nearly singular matrix need be small.

use super::block::BlockTridiagonal;
use super::equilibrate::{check_finite, equilibrate, for_lower_triangle};
use super::inertia;
use super::outcome::{Definiteness, Reason, SingularMatrix};
use crate::scales::linalg::{MAX_GROWTH, MIN_RCOND};
use crate::simd::dispatch;
use fearless_simd::Level;

/// Layout: number of diagonals below the main one.
const BELOW: usize = 11;
/// Layout: number of diagonals above the main one, fill included.
const ABOVE: usize = 2 * BELOW;

/// One column: the entry of row r, column c is at `ABOVE + r - c`.
type Column = [f64; ABOVE + 1 + BELOW];

/// L U factors of the equilibrated band.
#[derive(Clone, Debug, Default)]
pub(super) struct Banded {
    columns: Vec<Column>,
    /// Row exchanged with row j at step j.
    exchanged: Vec<usize>,
    scale: Vec<f64>,
    exponents: Vec<i32>,
    largest: Vec<i32>,
    /// Buffers of the condition estimate: the iterate and two solutions.
    work: [Vec<f64>; 3],
}

/// Computes y -= a x, with a fixed length where possible, which is vectorised.
#[inline(always)]
fn subtract<const N: usize>(y: &mut [f64], a: &[f64], x: f64) {
    if let (Some(y), Some(a)) = (y.first_chunk_mut::<N>(), a.first_chunk::<N>()) {
        for k in 0..N {
            y[k] -= a[k] * x;
        }
    } else {
        for (y, a) in y.iter_mut().zip(a) {
            *y -= a * x;
        }
    }
}

/// Eliminates with row interchanges; an unusable pivot remains on the diagonal.
#[inline(always)]
fn eliminate(columns: &mut [Column], exchanged: &mut Vec<usize>) {
    let n = columns.len();
    exchanged.clear();
    for j in 0..n {
        let reach = BELOW.min(n - 1 - j);
        let (head, tail) = columns[j..].split_at_mut(1);
        let pivot_column = &mut head[0];
        let mut best = 0;
        for k in 1..=reach {
            if pivot_column[ABOVE + k].abs() > pivot_column[ABOVE + best].abs() {
                best = k;
            }
        }
        pivot_column.swap(ABOVE, ABOVE + best);
        exchanged.push(j + best);
        let pivot = pivot_column[ABOVE];
        if pivot == 0.0 || !pivot.is_finite() {
            return;
        }
        for v in &mut pivot_column[ABOVE + 1..] {
            *v /= pivot;
        }
        let multipliers = &pivot_column[ABOVE + 1..];
        for (distance, column) in tail.iter_mut().take(ABOVE).enumerate() {
            let top = ABOVE - 1 - distance; // row j of this column
            column.swap(top, top + best);
            let u = column[top];
            subtract::<BELOW>(&mut column[top + 1..=top + BELOW], multipliers, u);
        }
    }
}

/// Substitutes forwards and backwards.
#[inline(always)]
fn substitute(columns: &[Column], exchanged: &[usize], x: &mut [f64]) {
    for j in 0..columns.len() {
        x.swap(j, exchanged[j]);
        let value = x[j];
        subtract::<BELOW>(&mut x[j + 1..], &columns[j][ABOVE + 1..], value);
    }
    for j in (0..columns.len()).rev() {
        let column = &columns[j];
        x[j] /= column[ABOVE];
        let value = x[j];
        let reach = ABOVE.min(j);
        subtract::<ABOVE>(&mut x[j - reach..j], &column[ABOVE - reach..ABOVE], value);
    }
}

impl Banded {
    /// Factors the matrix and checks growth and condition; counts negative eigenvalues if `count`.
    pub(super) fn factor(
        &mut self,
        level: Level,
        a: &BlockTridiagonal,
        count: bool,
    ) -> Result<Definiteness, SingularMatrix> {
        check_finite(a)?;
        equilibrate(a, &mut self.scale, &mut self.exponents, &mut self.largest)?;
        let (largest, norm) = self.assemble(a);
        dispatch!(level => eliminate(&mut self.columns, &mut self.exchanged));
        let unusable = |c: &Column| c[ABOVE] == 0.0 || !c[ABOVE].is_finite();
        if let Some(j) = self.columns.iter().position(unusable) {
            let zero = self.columns[j][ABOVE] == 0.0;
            let reason = if zero { Reason::Pivot } else { Reason::NonFinite };
            return Err(SingularMatrix { node: j / 6, pivot: 0.0, scale: largest, reason });
        }

        let (mut node, mut pivot, mut growth) = (0, f64::INFINITY, 0.0f64);
        for (j, column) in self.columns.iter().enumerate() {
            if column[ABOVE].abs() < pivot {
                (node, pivot) = (j / 6, column[ABOVE].abs());
            }
            growth = column[..=ABOVE].iter().fold(growth, |g, v| g.max(v.abs()));
        }
        let error = |reason| Err(SingularMatrix { node, pivot, scale: largest, reason });
        let inverse_norm = self.inverse_norm(level);
        let rcond = 1.0 / (norm * inverse_norm);
        if !inverse_norm.is_finite() || rcond.is_nan() || rcond < MIN_RCOND {
            return error(Reason::Condition);
        }
        if growth > MAX_GROWTH * largest {
            return error(Reason::Growth);
        }
        if !count {
            return Ok(Definiteness::Indefinite { negative: None });
        }
        // the estimate is a lower bound, rarely by more than a factor of three
        let smallest = 1.0 / (3.0 * inverse_norm);
        let negative = inertia::negative(a, &self.scale, smallest)
            .filter(|count| (count % 2 == 1) == (self.determinant_sign() < 0.0));
        Ok(match negative {
            Some(0) => Definiteness::PositiveDefinite,
            negative => Definiteness::Indefinite { negative },
        })
    }

    /// Fills the band with S A S, and returns its largest entry and its 1-norm.
    fn assemble(&mut self, a: &BlockTridiagonal) -> (f64, f64) {
        let n = self.scale.len();
        let Self { columns, scale, work, .. } = self;
        columns.clear();
        columns.resize(n, [0.0; ABOVE + 1 + BELOW]);
        let sums = &mut work[0];
        sums.clear();
        sums.resize(n, 0.0);
        let mut largest = 0.0f64;
        for_lower_triangle(a, |r, c, value| {
            let value = value * scale[r] * scale[c];
            largest = largest.max(value.abs());
            columns[c][ABOVE + r - c] = value;
            sums[c] += value.abs();
            if r != c {
                columns[r][ABOVE + c - r] = value;
                sums[r] += value.abs();
            }
        });
        (largest, sums.iter().fold(0.0, |m, v| v.max(m)))
    }

    /// Replaces `rhs` by A^-1 rhs.
    pub(super) fn solve(&self, level: Level, rhs: &mut [f64]) {
        let scale = |x: &mut [f64]| x.iter_mut().zip(&self.scale).for_each(|(v, s)| *v *= s);
        scale(rhs);
        dispatch!(level => substitute(&self.columns, &self.exchanged, rhs));
        scale(rhs);
    }

    /// Returns the sign of the determinant.
    pub(super) fn determinant_sign(&self) -> f64 {
        let exchanges = self.exchanged.iter().enumerate().filter(|&(j, &p)| p != j).count();
        let negative = self.columns.iter().filter(|c| c[ABOVE] < 0.0).count();
        if (exchanges + negative) % 2 == 0 { 1.0 } else { -1.0 }
    }

    /// Returns an estimate of |(S A S)^-1|_1 from below.
    fn inverse_norm(&mut self, level: Level) -> f64 {
        let n = self.columns.len();
        let Self { columns, exchanged, work: [x, y, z], .. } = self;
        let solve = |x: &mut [f64]| dispatch!(level => substitute(columns, exchanged, x));
        let one_norm = |v: &[f64]| v.iter().fold(0.0, |s, v| s + v.abs());
        // a vector of alternating signs covers cases that the iteration misses
        y.clear();
        y.extend((0..n).map(|i| {
            let size = 1.0 + i as f64 / (n - 1).max(1) as f64;
            if i % 2 == 0 { size } else { -size }
        }));
        solve(y);
        let mut estimate = 2.0 * one_norm(y) / (3.0 * n as f64);
        x.clear();
        x.resize(n, 1.0 / n as f64);
        for _ in 0..5 {
            y.clone_from(x);
            solve(y);
            let norm = one_norm(y);
            if !norm.is_finite() {
                estimate = f64::INFINITY;
                break;
            }
            estimate = estimate.max(norm);
            z.clear();
            z.extend(y.iter().map(|v| 1f64.copysign(*v)));
            solve(z);
            let slope: f64 = z.iter().zip(x.iter()).fold(0.0, |s, (z, x)| s + z * x);
            let (mut best, mut steepest) = (0, 0.0);
            for (i, v) in z.iter().enumerate() {
                if v.abs() > steepest {
                    (best, steepest) = (i, v.abs());
                }
            }
            if !steepest.is_finite() {
                estimate = f64::INFINITY;
                break;
            }
            if steepest <= slope {
                break;
            }
            x.fill(0.0);
            x[best] = 1.0;
        }
        estimate
    }
}
