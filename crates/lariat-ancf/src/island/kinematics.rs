//! Motion of the pinned coordinates with their bodies: positions, and slopes that are clamped.
//!
//! # Equation
//!
//! ```text
//! ball    r = x + rho + gap        r'' = x'' + omega' x rho + omega x (omega x rho) + gap''
//! clamp   t = lambda d,  d = R u   t'' = (d.t'') d + (I - d d^T) (2 lambda' d' + lambda d'')
//!         d' = omega x d + R u'
//!         d'' = omega' x d + omega x (omega x d) + 2 omega x R u' + R u''
//! ```
//!
//! `rho = R a` is the lever. lambda, the stretch at a clamp, is free: it is `d.t` of the
//! integrator's own t. u is the clamped direction in body axes, constant unless the
//! [clamp](super::clamp) rotates in this step.
//!
//! # References
//!
//! Rigid body kinematics.

use super::hold::{Hold, vector};
use super::layout::{Layout, Motion};
use super::rotation::angular_acceleration;
use nalgebra::Vector3;

/// A clamped direction at an instant, in world axes.
struct ClampedDirection {
    d: Vector3<f64>,
    rate: Vector3<f64>,
    /// d'' without the term of omega'.
    acceleration: Vector3<f64>,
}

impl Layout {
    /// Returns the motion of a pin's body, and the lever of the pin in world axes.
    pub(super) fn lever(&self, pin: usize, q: &[f64], v: &[f64]) -> (Motion, Vector3<f64>) {
        let body = self.pins[pin].body;
        let at = self.body_at(body);
        let motion = self.motion(body, &q[at..at + 6], &v[at..at + 6]);
        (motion, motion.rotation * self.pins[pin].anchor)
    }

    /// Returns the vector that rotates with the body: a small rotation phi of the body about its
    /// centre changes the held coordinates by `phi x rotating_vector`.
    pub(super) fn rotating_vector(&self, hold: &Hold, q: &[f64]) -> Vector3<f64> {
        if hold.slope {
            return vector(&q[hold.at..]);
        }
        let pin = &self.pins[hold.pin];
        self.attitude(pin.body, &q[self.body_at(pin.body)..]) * pin.anchor
    }

    fn clamped_direction(&self, pin: usize, time: f64, motion: &Motion) -> Option<ClampedDirection> {
        let [u, du, ddu] = self.clamps[pin].as_ref()?.at(self.elapsed(time)).map(|x| motion.rotation * x);
        let spin = motion.spin;
        Some(ClampedDirection {
            d: u,
            rate: spin.cross(&u) + du,
            acceleration: spin.cross(&spin.cross(&u)) + 2.0 * spin.cross(&du) + ddu,
        })
    }

    /// Sets pinned positions, clamped slopes and their velocities to those of their bodies.
    pub(super) fn follow(&self, time: f64, q: &mut [f64], v: &mut [f64]) {
        for pin in 0..self.pins.len() {
            let (motion, rho) = self.lever(pin, q, v);
            let (gap, closing) = self.gap(pin, time);
            let at = self.pin_at(pin);
            q[at..at + 3].copy_from_slice((motion.position + rho + gap).as_slice());
            v[at..at + 3].copy_from_slice((motion.velocity + motion.spin.cross(&rho) + closing).as_slice());
            if let Some(ClampedDirection { d, rate, .. }) = self.clamped_direction(pin, time, &motion) {
                let (stretch, stretch_rate) = (d.dot(&vector(&q[at + 3..])), d.dot(&vector(&v[at + 3..])));
                q[at + 3..at + 6].copy_from_slice((d * stretch).as_slice());
                v[at + 3..at + 6].copy_from_slice((d * stretch_rate + rate * stretch).as_slice());
            }
        }
    }

    /// Sets pinned accelerations to those of their bodies. `k` holds accelerations times `scale`,
    /// those of bodies in the chart.
    pub(super) fn follow_acceleration(&self, time: f64, scale: f64, q: &[f64], v: &[f64], k: &mut [f64]) {
        for pin in 0..self.pins.len() {
            let (motion, rho) = self.lever(pin, q, v);
            let body = self.body_at(self.pins[pin].body);
            let closing = self.gap_acceleration(pin, time);
            let (theta, rate) = (vector(&q[body + 3..]), vector(&v[body + 3..]));
            let alpha = angular_acceleration(scale, &theta, &rate, &vector(&k[body + 3..]));
            let spin = motion.spin;
            let a = vector(&k[body..]) + alpha.cross(&rho) + (spin.cross(&spin.cross(&rho)) + closing) * scale;
            let at = self.pin_at(pin);
            k[at..at + 3].copy_from_slice(a.as_slice());
            if let Some(ClampedDirection { d, rate, acceleration }) = self.clamped_direction(pin, time, &motion) {
                let (stretch, stretch_rate) = (d.dot(&vector(&q[at + 3..])), d.dot(&vector(&v[at + 3..])));
                let across = (rate * (2.0 * stretch_rate) + acceleration * stretch) * scale + alpha.cross(&d) * stretch;
                let along = d.dot(&vector(&k[at + 3..])) - d.dot(&across);
                k[at + 3..at + 6].copy_from_slice((across + d * along).as_slice());
            }
        }
    }
}
