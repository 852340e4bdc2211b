//! Friction that follows the normal force of its own step.
//!
//! # Equation
//!
//! The bound of friction is first `c = mu N0`, N0 that of the last step; zero in a first touch.
//! When the iteration has ended with N,
//!
//! ```text
//! L = sum |mu N - c| (slipping) + sum (|f| - mu N)+ (sticking)
//! L <= 0.003 sum mu N    or    h L <= 0.001 of the impulses of the step without those of contacts        else c := mu N, and it goes on
//! ```
//!
//! A bound that misses mu N leaves the impulse `h (mu N - c)` out of the balance. Where that is
//! little beside inertia, loads and supports, the motion does not see it: a net that carries a ball
//! need not know its friction on it to 0.003.
//!
//! Return mapping loses energy for any bound, so the energy law holds for each of them. Along a
//! rope on a drum the bounds determine the tensions one after the other, so the sequence ends after
//! as many rounds as there are contacts, and its error after k of them is that of Taylor's series
//! of `exp(mu phi)`.
//!
//! h N is the impulse of the step, that of an impact too: a rope that falls on a floor while it
//! moves along it loses the speed `mu v`, v that of the fall, and one that is put on a slope below
//! the angle of friction stays.
//!
//! # Validity
//!
//! Friction of the first touch acts over the whole step, although the cable touches in a part of
//! it. Forty rounds are taken at most; steps that need more are
//! [counted](crate::Diagnostics::lagging_steps).
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/contact.md.

use super::point::ContactPoint;
use super::step::ContactStep;
use crate::scales::contact::LAG;

impl ContactStep {
    /// Returns the sum in N by which friction misses its bounds by the normal forces of the present
    /// iterate, and notes whether that is much.
    pub fn find_lag(&mut self) -> f64 {
        let [missed, all] = lag(self.points.iter());
        self.lags = missed > LAG * all;
        missed
    }

    /// Sets the bounds of friction by the normal forces of the present iterate.
    pub fn renew_friction(&mut self) {
        renew(self.points.iter_mut());
    }
}

/// Returns the sums in N by which friction misses its bounds, and of these.
pub(super) fn lag<'a>(points: impl Iterator<Item = &'a ContactPoint>) -> [f64; 2] {
    let (mut missed, mut all) = (0.0, 0.0);
    for point in points.filter(|point| point.friction > 0.0) {
        let due = point.friction * point.now.normal_force;
        all += due;
        missed += match point.now.slides {
            Some(_) => (due - point.bound).abs(),
            None => (point.now.friction.norm() - due).max(0.0),
        };
    }
    [missed, all]
}

/// Sets the bounds of friction by the present normal forces.
pub(super) fn renew<'a>(points: impl Iterator<Item = &'a mut ContactPoint>) {
    for point in points.filter(|point| point.friction > 0.0) {
        point.bound = (point.friction * point.now.normal_force).max(f64::MIN_POSITIVE);
        point.renewed = true;
    }
}
