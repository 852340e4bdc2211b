//! The direction of a clamp in body axes over a step.
//!
//! ```text
//! u(s) = exp(s^2 (3 - 2 s) [gamma]) u0,   u(1) = the clamped direction
//! ```
//!
//! gamma is zero, and u constant, unless node and body do not agree when the step begins: then the slope turns into the clamp
//! within the step, as the gap of a pin closes.

use nalgebra::{Rotation3, UnitVector3, Vector3};

/// Angles below this in rad are rounding.
const LEAST_ANGLE: f64 = 1e-12;

/// A clamp's direction over one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clamp {
    from: Vector3<f64>,
    turn: Vector3<f64>,
    duration: f64,
}

impl Clamp {
    /// From the direction that the slope has to the one it is held to, both unit vectors in body axes.
    pub fn new(has: Vector3<f64>, wanted: Vector3<f64>, duration: f64) -> Self {
        let (sin, cos) = (has.cross(&wanted).norm(), has.dot(&wanted));
        let angle = sin.atan2(cos);
        if angle < LEAST_ANGLE {
            return Clamp { from: wanted, turn: Vector3::zeros(), duration };
        }
        let axis = UnitVector3::try_new(has.cross(&wanted), 1e-9).unwrap_or_else(|| across(&has));
        Clamp { from: has, turn: axis.into_inner() * angle, duration }
    }

    /// Whether it is constant.
    pub fn settled(&self) -> bool {
        self.turn == Vector3::zeros()
    }

    /// Direction, its rate and its acceleration at the elapsed share `s` of the step.
    pub fn at(&self, s: f64) -> [Vector3<f64>; 3] {
        if self.settled() {
            return [self.from, Vector3::zeros(), Vector3::zeros()];
        }
        let (share, h) = (s * s * (3.0 - 2.0 * s), self.duration);
        let (rate, acceleration) = (6.0 * s * (1.0 - s) / h, (6.0 - 12.0 * s) / (h * h));
        let u = Rotation3::from_scaled_axis(self.turn * share) * self.from;
        let across = self.turn.cross(&u);
        [u, across * rate, across * acceleration + self.turn.cross(&across) * (rate * rate)]
    }
}

/// A direction at right angles.
fn across(x: &Vector3<f64>) -> UnitVector3<f64> {
    let least = (0..3).min_by(|&a, &b| x[a].abs().total_cmp(&x[b].abs())).unwrap_or(0);
    UnitVector3::new_normalize(x.cross(&Vector3::ith(least, 1.0)))
}

#[cfg(test)]
mod tests {
    use super::Clamp;
    use approx::assert_relative_eq;
    use nalgebra::Vector3;

    #[test]
    fn it_turns_from_the_one_direction_into_the_other_and_its_rates_are_those_of_finite_differences() {
        let wanted = Vector3::new(0.6, -0.8, 0.0);
        for has in [Vector3::new(0.0, 0.6, 0.8), -wanted, wanted] {
            let clamp = Clamp::new(has, wanted, 0.25);
            assert_relative_eq!(clamp.at(0.0)[0], has, epsilon = 1e-14);
            assert_relative_eq!(clamp.at(1.0)[0], wanted, epsilon = 1e-14);
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
}
