//! Secants of the regularised powers of 1/|r'|^2 that bending energies contain.
//!
//! # Equation
//!
//! With q = max(Q, Q_c) and y = Q - q <= 0, the continued power of
//! [`regularisation`](super::regularisation) is a sum, f(Q) = q^-k + p(y), and both parts have
//! exact secants that need no difference of nearly equal numbers:
//!
//! ```text
//! D(q^-2) = -(q0 + q1)/(q0 q1)^2 Dq            D(q^-3) = -(q0^2 + q0 q1 + q1^2)/(q0 q1)^3 Dq
//! D p     = Q_c^-(k+1) [k (k + 1)/2 (y0 + y1)/Q_c - k] Dy                      DQ = Dq + Dy
//! f[Q0,Q1] = (D(q^-k) + D p)/DQ = (1 - m) D(q^-k)/Dq + m Dp/Dy,                m = Dy/DQ, between 0 and 1
//! ```
//!
//! m is 0 above Q_c, where D(q^-k)/Dq is all that is computed, and 1 below it. Where both ends fall
//! together it is regularised by 1e-20: what that changes in f[Q0,Q1] DQ is of that size too,
//! because there both secants are the derivative.
//!
//! # Validity
//!
//! Any Q; f[Q0,Q1] DQ = f(Q1) - f(Q0) to rounding.
//!
//! # Alternatives considered
//!
//! The discrete gradient of Gonzalez (1996), which adds what the derivative at the midpoint misses
//! along the displacement: it divides by the square of the displacement, which is zero at rest.

use crate::Real;
use crate::scales::element::{LOWER_LIMIT, SMALL, SMALL_SQUARE};

/// A regularised power f of Q over a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PowerSecant<T> {
    /// (f(Q0) + f(Q1))/2.
    pub mean: T,
    /// f[Q0,Q1].
    pub slope: T,
}

impl<T: Real> PowerSecant<T> {
    /// Of Q^-2.
    #[inline(always)]
    pub fn square(start: T, end: T) -> Self {
        Self::new::<2>(start, end)
    }

    /// Of Q^-3.
    #[inline(always)]
    pub fn cube(start: T, end: T) -> Self {
        Self::new::<3>(start, end)
    }

    /// Of Q^-K, K = 2 or 3. No closures: the compiler does not inline them into a function of
    /// another SIMD level.
    #[inline(always)]
    fn new<const K: usize>(start: T, end: T) -> Self {
        // 1/Q_c^(K + 1)
        const { assert!(K == 2 || K == 3) };
        let limit = 1.0 / LOWER_LIMIT;
        let (k, limit_power) = if K == 2 { (2.0, limit * limit * limit) } else { (3.0, limit * limit * limit * limit) };
        let curvature = 0.5 * k * (k + 1.0) * limit;
        let one = start.splat(1.0);
        let (q0, q1) = (start.at_least(LOWER_LIMIT), end.at_least(LOWER_LIMIT));
        let (i, j) = (one / q0, one / q1);
        let (above, powers) = if K == 2 {
            (i * j * (i + j), i * i + j * j)
        } else {
            (i * j * (i * i + i * j + j * j), i * i * i + j * j * j)
        };
        // m and p are zeros, and what follows leaves these bits
        if start.is_above(LOWER_LIMIT) && end.is_above(LOWER_LIMIT) {
            return PowerSecant { mean: powers * 0.5, slope: -above };
        }
        let (y0, y1) = (start - q0, end - q1);
        let (sum, change) = (y0 + y1, end - start);
        let below = sum / (sum - SMALL);
        let share = ((y1 - y0) * change + below * SMALL_SQUARE) / (change * change + SMALL_SQUARE);
        let crumpled = (sum * curvature - k) * limit_power;
        let slope = crumpled * share - above * (one - share);
        let taylor = ((y0 * curvature - k) * y0 + (y1 * curvature - k) * y1) * limit_power;
        PowerSecant { mean: (powers + taylor) * 0.5, slope }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::bending::regularisation::RegularisedPower;

    /// Lanes that are all above Q_c take a shorter way than those of which one is not: the others
    /// have the same bits either way, whatever their change.
    #[test]
    fn the_shorter_way_above_the_limit_has_the_same_bits() {
        use crate::simd::dispatch;
        use fearless_simd::{Level, f64x8, prelude::*};
        let changes = [0.0, -0.0, 1e-300, 1e-14, -1e-14, -1e-6, 0.3, 40.0];
        for start in [LOWER_LIMIT * (1.0 + 1e-15), 0.3, 1.0, 1.7, 50.0] {
            let ends = changes.map(|change| f64::max(start + change, LOWER_LIMIT * (1.0 + 1e-15)));
            // the last lane is crumpled
            let (mut starts, mut mixed) = ([start; 8], ends);
            (starts[7], mixed[7]) = (0.1, 0.2);
            let long: [[[f64; 8]; 2]; 2] = dispatch!(Level::new(), simd => {
                let (start, end) = (f64x8::simd_from(simd, starts), f64x8::simd_from(simd, mixed));
                let (square, cube) = (PowerSecant::square(start, end), PowerSecant::cube(start, end));
                let mut out = [[[0.0; 8]; 2]; 2];
                square.mean.store_slice(&mut out[0][0]);
                square.slope.store_slice(&mut out[0][1]);
                cube.mean.store_slice(&mut out[1][0]);
                cube.slope.store_slice(&mut out[1][1]);
                out
            });
            for lane in 0..7 {
                let short = [PowerSecant::square(start, ends[lane]), PowerSecant::cube(start, ends[lane])];
                for (long, short) in long.iter().zip(short) {
                    let [mean, slope] = [long[0][lane], long[1][lane]];
                    assert_eq!(mean.to_bits(), short.mean.to_bits(), "{start} {}", ends[lane]);
                    assert_eq!(slope.to_bits(), short.slope.to_bits(), "{start} {}", ends[lane]);
                }
            }
        }
    }

    fn power(square: f64, k: i32) -> f64 {
        let at = RegularisedPower::new(square);
        at.inverse.powi(k) * at.value(f64::from(k))
    }

    /// Both ends above, both below, and one on each side of Q_c; far apart, close together, and
    /// equal.
    #[test]
    fn the_secant_times_the_change_is_the_difference_and_at_rest_it_is_the_derivative() {
        let starts = [0.0, 1e-3, 0.1, 0.2, LOWER_LIMIT - 1e-9, LOWER_LIMIT, LOWER_LIMIT + 1e-9, 0.3, 1.0, 1.7];
        let changes = [0.0, 1e-14, 1e-11, -1e-11, 1e-9, 1e-6, -1e-6, 1e-3, -0.05, 0.3, 2.0];
        for (start, change) in starts.iter().flat_map(|s| changes.map(|c| (*s, c))) {
            let end = f64::max(start + change, 0.0);
            for (k, secant) in [(2, PowerSecant::square(start, end)), (3, PowerSecant::cube(start, end))] {
                let (f0, f1) = (power(start, k), power(end, k));
                let error = (secant.slope * (end - start) - (f1 - f0)).abs();
                assert!(error <= 4e-15 * f0.max(f1), "{k} {start} {end}: {error:e}");
                assert!((secant.mean - 0.5 * (f0 + f1)).abs() <= 2e-15 * f0.max(f1), "{k} {start} {end}");
                if (end - start).abs() < 1e-8 {
                    let at = RegularisedPower::new(start);
                    let derivative = -f64::from(k) * at.inverse.powi(k + 1) * at.derivative(f64::from(k));
                    assert!((secant.slope / derivative - 1.0).abs() < 1e-6, "{k} {start} {end}: {}", secant.slope);
                }
            }
        }
    }
}
