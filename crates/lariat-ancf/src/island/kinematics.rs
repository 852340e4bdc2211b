//! What pinned coordinates do when their body moves: positions, and slopes that are clamped.
//!
//! ```text
//! ball    r = x + rho + gap            r'' = x'' + omega' x rho + omega x (omega x rho) + gap''
//! clamp   t = lambda d,  d = R u       t'' = (d.t'') d + P (2 lambda' d' + lambda d''),   P = I - d d^T
//!         d' = omega x d + R u'        d'' = omega' x d + omega x (omega x d) + 2 omega x R u' + R u''
//! ```
//!
//! `rho = R a` is the lever. lambda, the stretch at a clamp, is free: it is read from the integrator's own t as `d.t`. u is the
//! clamped direction in body axes, constant unless the clamp has to turn first. *Source.* Rigid body kinematics.

use super::rotation::angular_acceleration;
use super::system::Work;
use super::workspace::{Hold, Motion, vector};
use nalgebra::Vector3;

/// A clamped direction at an instant.
struct Direction {
    d: Vector3<f64>,
    rate: Vector3<f64>,
    /// d'' without the part of omega'.
    acceleration: Vector3<f64>,
}

impl Work<'_, '_> {
    /// The lever of a pin in world axes, with the body's motion.
    pub(super) fn lever(&self, pin: usize, q: &[f64], v: &[f64]) -> (Motion, Vector3<f64>) {
        let body = self.pins[pin].body;
        let at = self.body_at(body);
        let motion = self.workspace.motion(body, &q[at..at + 6], &v[at..at + 6]);
        (motion, motion.rotation * self.pins[pin].anchor)
    }

    /// What a rotation of the body about its centre moves: `turn x arm` is the change of the held vector.
    pub(super) fn arm(&self, hold: &Hold, q: &[f64]) -> Vector3<f64> {
        if hold.slope {
            return vector(&q[hold.at..]);
        }
        let pin = &self.pins[hold.pin];
        self.workspace.attitude(pin.body, &q[self.body_at(pin.body)..]) * pin.anchor
    }

    fn direction(&self, pin: usize, time: f64, motion: &Motion) -> Option<Direction> {
        let [u, du, ddu] =
            self.workspace.clamps[pin].as_ref()?.at(self.workspace.elapsed(time)).map(|x| motion.rotation * x);
        let spin = motion.spin;
        Some(Direction {
            d: u,
            rate: spin.cross(&u) + du,
            acceleration: spin.cross(&spin.cross(&u)) + 2.0 * spin.cross(&du) + ddu,
        })
    }

    /// Puts pinned positions, clamped slopes and their velocities where their bodies have them.
    pub(super) fn follow(&self, time: f64, q: &mut [f64], v: &mut [f64]) {
        for pin in 0..self.pins.len() {
            let (motion, rho) = self.lever(pin, q, v);
            let (gap, closing) = self.workspace.gap(pin, time);
            let at = self.pin_at(pin);
            q[at..at + 3].copy_from_slice((motion.position + rho + gap).as_slice());
            v[at..at + 3].copy_from_slice((motion.velocity + motion.spin.cross(&rho) + closing).as_slice());
            if let Some(Direction { d, rate, .. }) = self.direction(pin, time, &motion) {
                let (stretch, stretching) = (d.dot(&vector(&q[at + 3..])), d.dot(&vector(&v[at + 3..])));
                q[at + 3..at + 6].copy_from_slice((d * stretch).as_slice());
                v[at + 3..at + 6].copy_from_slice((d * stretching + rate * stretch).as_slice());
            }
        }
    }

    /// Puts pinned accelerations where their bodies have them. `k` holds accelerations times `scale`, of bodies in the chart.
    pub(super) fn follow_acceleration(&self, time: f64, scale: f64, q: &[f64], v: &[f64], k: &mut [f64]) {
        for pin in 0..self.pins.len() {
            let (motion, rho) = self.lever(pin, q, v);
            let body = self.body_at(self.pins[pin].body);
            let closing = self.workspace.closing_acceleration(pin, time);
            let (theta, rate) = (vector(&q[body + 3..]), vector(&v[body + 3..]));
            let alpha = angular_acceleration(scale, &theta, &rate, &vector(&k[body + 3..]));
            let spin = motion.spin;
            let a = vector(&k[body..]) + alpha.cross(&rho) + (spin.cross(&spin.cross(&rho)) + closing) * scale;
            let at = self.pin_at(pin);
            k[at..at + 3].copy_from_slice(a.as_slice());
            if let Some(Direction { d, rate, acceleration }) = self.direction(pin, time, &motion) {
                let (stretch, stretching) = (d.dot(&vector(&q[at + 3..])), d.dot(&vector(&v[at + 3..])));
                let turned = (rate * (2.0 * stretching) + acceleration * stretch) * scale + alpha.cross(&d) * stretch;
                let along = d.dot(&vector(&k[at + 3..])) - d.dot(&turned);
                k[at + 3..at + 6].copy_from_slice((turned + d * along).as_slice());
            }
        }
    }
}
