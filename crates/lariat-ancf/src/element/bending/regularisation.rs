//! Powers of 1/|r'|^2 that stay finite in a crumpled element.
//!
//! Every curvature divides by a power of Q = |r'|^2, so an element whose slope passes through zero
//! somewhere would hold infinite energy there, and no step could pass through that state.
//!
//! # Equation
//!
//! Below Q_c = 1/4, half the length, the power is continued by its Taylor polynomial of second
//! order:
//!
//! ```text
//! q = max(Q, Q_c), x = (Q - q)/q          Q >= Q_c: x = 0, the powers themselves, bit for bit
//! Q^-k  ->  f = q^-k (1 - k x + k(k+1)/2 x^2),  f' = -k q^-(k+1) (1 - (k+1) x),  f'' = k(k+1) q^-(k+2)
//! ```
//!
//! f, f' and f'' are continuous, and so are energy, force and tangent; f <= 10 Q_c^-3, and with |r'
//! x r''|^2 <= Q |r''|^2 the energy of a point is at most twice what it is at Q_c with the same
//! r'': it goes to zero with r', and the element can pass through.
//!
//! # Validity
//!
//! Q >= Q_c is not changed. Below it no cable law holds: the Green law itself has lost its axial
//! stiffness at |r'| = 0.577 ([`axial`](crate::element::axial)), so no measured behaviour is given
//! up.
//!
//! # Alternatives considered
//!
//! - Q + e in place of Q: it changes every cable a little.
//! - First order: the tangent jumps, and Newton's iteration cycles at Q_c.
//! - A lower bound of Q: no force against the collapse at all.

use crate::Real;
use crate::scales::element::LOWER_LIMIT;

/// A power of 1/Q, continued below Q_c.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RegularisedPower<T> {
    /// 1/q, at most 1/Q_c.
    pub inverse: T,
    /// x, from -1 to 0; 0 in elements that are not crumpled.
    x: T,
}

impl<T: Real> RegularisedPower<T> {
    /// Creates it for Q.
    #[inline(always)]
    pub fn new(square: T) -> Self {
        let q = square.at_least(LOWER_LIMIT);
        let inverse = square.splat(1.0) / q;
        RegularisedPower { inverse, x: (square - q) * inverse }
    }

    /// Returns f q^k, the factor of q^-k.
    #[inline(always)]
    pub fn value(&self, k: f64) -> T {
        (self.x * (0.5 * k * (k + 1.0)) - k) * self.x + 1.0
    }

    /// Returns f' q^(k+1)/(-k), the factor of -k q^-(k+1).
    #[inline(always)]
    pub fn derivative(&self, k: f64) -> T {
        self.x * -(k + 1.0) + 1.0
    }
}

impl RegularisedPower<f64> {
    /// Returns Q^-3, continued.
    pub fn cube(&self) -> f64 {
        self.inverse.powi(3) * self.value(3.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn power(square: f64, k: i32) -> (f64, f64) {
        let at = RegularisedPower::new(square);
        let value = at.inverse.powi(k) * at.value(f64::from(k));
        (value, -f64::from(k) * at.inverse.powi(k + 1) * at.derivative(f64::from(k)))
    }

    #[test]
    fn powers_above_the_limit_are_exact() {
        for k in [2, 3] {
            for square in [LOWER_LIMIT, 0.3, 1.0, 1.7] {
                let inverse = 1.0 / square;
                let own = f64::from(k) * inverse.powi(k + 1);
                assert_eq!(power(square, k), (inverse.powi(k), -own));
            }
        }
    }

    #[test]
    fn powers_below_the_limit_are_finite_and_the_derivative_is_theirs() {
        for k in [2, 3] {
            for square in [0.0, 1e-9, 0.01, 0.1, 0.2, 0.2499] {
                let h = 1e-6;
                let difference = (power(square + h, k).0 - power(square - h, k).0) / (2.0 * h);
                assert_relative_eq!(power(square, k).1, difference, max_relative = 1e-8);
            }
            let (above, below) = (power(LOWER_LIMIT + 1e-9, k), power(LOWER_LIMIT - 1e-9, k));
            assert_relative_eq!(above.0, below.0, max_relative = 1e-7);
            assert_relative_eq!(above.1, below.1, max_relative = 1e-7);
        }
    }
}
