//! The direction of a clamp in body axes over a step.
//!
//! # Equation
//!
//! ```text
//! u(s) = exp([theta]) u0,   theta = s^2 (3 - 2 s) gamma + h (w0 s (1 - s)^2 - w1 s^2 (1 - s))
//! ```
//!
//! gamma is zero unless the slope is not in the clamped direction when the step begins: then it
//! rotates there within the step, as the gap of a pin closes. w0 and w1 are zero unless the body is
//! driven unsteadily: they are its angular velocities beyond the mean at both ends of the step h,
//! in body axes.
//!
//! # Validity
//!
//! The rate at the end is w1 for small gamma.

use super::rotation::{exponential, jacobian_rate, spin};
use crate::scales::island::ANGLE_ROUNDING;
use nalgebra::{UnitVector3, Vector3};

/// A clamp's direction over one step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clamp {
    from: Vector3<f64>,
    rotation: Vector3<f64>,
    /// w0 and w1 in body axes.
    rates: [Vector3<f64>; 2],
    duration: f64,
}

impl Clamp {
    /// Rotates from the `present` direction of the slope to the `wanted` one of the clamp, both
    /// unit vectors in body axes, within `duration` (s), or by a `share` of the angle. `rates` are
    /// the angular velocities of the body beyond its mean at both ends of the step, in body axes.
    pub fn new(
        present: Vector3<f64>,
        wanted: Vector3<f64>,
        (duration, share): (f64, f64),
        rates: [Vector3<f64>; 2],
    ) -> Self {
        let (sin, cos) = (present.cross(&wanted).norm(), present.dot(&wanted));
        let angle = sin.atan2(cos);
        if angle < ANGLE_ROUNDING {
            return Clamp { from: wanted, rotation: Vector3::zeros(), rates, duration };
        }
        let axis = UnitVector3::try_new(present.cross(&wanted), 1e-9).unwrap_or_else(|| normal(&present));
        Clamp { from: present, rotation: axis.into_inner() * (angle * share), rates, duration }
    }

    /// Returns whether the direction is constant.
    pub fn is_constant(&self) -> bool {
        self.rotation == Vector3::zeros() && self.rates == <[Vector3<f64>; 2]>::default()
    }

    /// Returns the direction and its first and second time derivatives at the elapsed share `s` of
    /// the step.
    pub fn at(&self, s: f64) -> [Vector3<f64>; 3] {
        if self.is_constant() {
            return [self.from, Vector3::zeros(), Vector3::zeros()];
        }
        let (gamma, [w0, w1], h) = (self.rotation, self.rates, self.duration);
        let theta = gamma * (s * s * (3.0 - 2.0 * s)) + (w0 * (1.0 - s) - w1 * s) * (s * (1.0 - s) * h);
        let rate = gamma * (6.0 * s * (1.0 - s) / h) + w0 * ((1.0 - s) * (1.0 - 3.0 * s)) + w1 * (s * (3.0 * s - 2.0));
        let second = (gamma * ((6.0 - 12.0 * s) / h) + w0 * (6.0 * s - 4.0) + w1 * (6.0 * s - 2.0)) / h;
        let (u, turn) = (exponential(&theta) * self.from, spin(&theta, &rate));
        let turn_rate = jacobian_rate(&theta, &rate) * rate + spin(&theta, &second);
        [u, turn.cross(&u), turn_rate.cross(&u) + turn.cross(&turn.cross(&u))]
    }
}

/// Returns a unit vector at a right angle to `x`.
fn normal(x: &Vector3<f64>) -> UnitVector3<f64> {
    let least = (0..3).min_by(|&a, &b| x[a].abs().total_cmp(&x[b].abs())).unwrap_or(0);
    UnitVector3::new_normalize(x.cross(&Vector3::ith(least, 1.0)))
}

#[cfg(test)]
mod tests {
    use super::Clamp;
    use approx::assert_relative_eq;
    use nalgebra::Vector3;

    #[test]
    fn direction_rotates_between_its_ends_and_its_derivatives_match_finite_differences() {
        let wanted = Vector3::new(0.6, -0.8, 0.0);
        for present in [Vector3::new(0.0, 0.6, 0.8), -wanted, wanted] {
            let clamp = Clamp::new(present, wanted, (0.25, 1.0), Default::default());
            assert_relative_eq!(clamp.at(0.0)[0], present, epsilon = 1e-14);
            assert_relative_eq!(clamp.at(1.0)[0], wanted, epsilon = 1e-14);
            check_derivatives(&clamp);
        }
    }

    #[test]
    fn direction_on_an_unsteady_body_has_the_rates_given_and_its_derivatives_match_finite_differences() {
        let (d, rates) = (Vector3::new(0.6, -0.8, 0.0), [Vector3::new(1.0, -2.0, 3.0), Vector3::new(0.5, 4.0, -1.0)]);
        let clamp = Clamp::new(d, d, (0.25, 1.0), rates);
        for (s, w) in [(0.0, rates[0]), (1.0, rates[1])] {
            assert_relative_eq!(clamp.at(s)[0], d, epsilon = 1e-14);
            assert_relative_eq!(clamp.at(s)[1], w.cross(&d), epsilon = 1e-14);
        }
        check_derivatives(&clamp);
    }

    fn check_derivatives(clamp: &Clamp) {
        for s in [0.1, 0.4, 0.9] {
            let e = 1e-5;
            let [u, rate, acceleration] = clamp.at(s);
            let (before, after) = (clamp.at(s - e), clamp.at(s + e));
            assert_relative_eq!(u.norm(), 1.0, epsilon = 1e-14);
            assert_relative_eq!(rate, (after[0] - before[0]) / (2.0 * e * 0.25), epsilon = 1e-7);
            assert_relative_eq!(acceleration, (after[1] - before[1]) / (2.0 * e * 0.25), epsilon = 1e-5);
        }
    }
}
