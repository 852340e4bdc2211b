//! Pinned positions and clamped slopes over a step of the [discrete
//! gradient](crate::integrate::discrete_gradient).
//!
//! # Equation
//!
//! ```text
//! pin      D r = h v^ + rho1 - rho0 + D gap = h (v^ + w^ x rho_m) + D gap                        rho = R a
//! clamp    D t = l1 d1 - l0 d0 = D l e + h w^ x t_m + (the rotation of the clamp)                d = R u, t_m = (t0 + t1)/2
//!          e = d_m - h/4 w^ x (d1 - d0)
//! ```
//!
//! l is the stretch at a clamp. Both are exact, by the Cayley map of the [body](super::body), so a
//! hold does to the body what it does to the cable: an impulse p of the held rows passes the
//! impulse p and the angular impulse `rho_m x p`, or of a slope `t_m x p` alone. The closing of a
//! gap and the rotation of a clamp into its direction do work, which counts as that of a support.

use super::body::BodyStep;
use crate::island::hold::{Hold, vector};
use crate::island::layout::Layout;
use crate::state::State;
use crate::system::StepVectors;
use nalgebra::{Matrix3, Vector3};

/// A hold over a step.
#[derive(Clone, Copy, Debug)]
pub(in crate::island) struct HoldStep {
    /// First coordinate within the cable.
    pub at: usize,
    pub node: usize,
    pub pin: usize,
    pub body: usize,
    pub slope: bool,
    /// rho_m or t_m.
    pub arm: Vector3<f64>,
    /// e of a slope.
    pub along: Vector3<f64>,
    /// D l of a slope.
    stretch: f64,
    /// Change of the held coordinates that is neither the body's nor D l e.
    driven: Vector3<f64>,
    /// Impulse of the cable on the body over the iterate.
    pub impulse: Vector3<f64>,
    /// Angular impulses of the torsion behind and before a slope over the iterate.
    pub twists: [Vector3<f64>; 2],
}

impl HoldStep {
    /// Creates it for a hold of the cable whose coordinates begin at `offset`.
    pub fn new(hold: &Hold, offset: usize, body: usize) -> Self {
        let (arm, along, driven, impulse) = (Vector3::zeros(), Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
        let Hold { pin, node, at, slope } = *hold;
        HoldStep {
            at: at - offset,
            node,
            pin,
            body,
            slope,
            arm,
            along,
            stretch: 0.0,
            driven,
            impulse,
            twists: [Vector3::zeros(); 2],
        }
    }

    /// Sets the held coordinates of the iterate to where the body is.
    pub fn follow(&mut self, layout: &Layout, body: &BodyStep, state: &State, b: &mut StepVectors) {
        let (time, h) = (state.time, b.h);
        let start = vector(&state.q[self.at..]);
        let (change, mean) = if self.slope {
            let candidate = start + vector(&b.change[self.at..]);
            let direction = |time: f64| {
                layout.clamps[self.pin].as_ref().map_or_else(Vector3::zeros, |clamp| clamp.at(layout.elapsed(time))[0])
            };
            let (d0, d1) = (body.ends(&direction(time))[0], body.ends(&direction(time + h))[1]);
            let end = d1 * d1.dot(&candidate);
            self.stretch = d1.dot(&candidate) - d0.dot(&start);
            self.arm = 0.5 * (start + end);
            self.along = 0.5 * (d0 + d1) - body.mean[1].cross(&(d1 - d0)) * (0.25 * h);
            let change = end - start;
            self.driven = change - self.velocity(body) * h - self.along * self.stretch;
            (change, change / h)
        } else {
            let [rho0, rho1] = body.ends(&layout.pins[self.pin].anchor);
            self.arm = 0.5 * (rho0 + rho1);
            let gap = layout.gap(self.pin, time + h).0 - layout.gap(self.pin, time).0;
            self.driven = gap;
            // the difference of places is rounded, by more than the velocity in a step of less than
            // 1e-6 s
            let mean = self.velocity(body) + gap / h;
            (mean * h, mean)
        };
        for x in 0..3 {
            let i = self.at + x;
            b.change[i] = change[x];
            b.velocity_change[i] = (mean[x] - state.v[i] + b.leg.a * b.velocity_before[i]) / b.leg.b;
        }
    }

    /// Returns the mean velocity of the held coordinates with the body.
    fn velocity(&self, body: &BodyStep) -> Vector3<f64> {
        let [velocity, spin] = body.mean;
        let rotation = spin.cross(&self.arm);
        if self.slope { rotation } else { velocity + rotation }
    }

    /// Adds an impulse on the held coordinates to the row of the body.
    pub fn pass(&self, impulse: &Vector3<f64>, rows: &mut [f64]) {
        let row = &mut rows[6 * self.body..6 * self.body + 6];
        let angular = self.arm.cross(impulse);
        for x in 0..3 {
            if !self.slope {
                row[x] += impulse[x];
            }
            row[3 + x] += angular[x];
        }
    }

    /// Returns the stiffening part of the lever under the impulse: rotations turn a pulled lever
    /// out of the pull.
    pub fn stiffening(&self) -> Matrix3<f64> {
        let (square, pull) = (self.arm.norm_squared(), self.impulse.dot(&self.arm));
        if self.slope || square == 0.0 || pull <= 0.0 {
            return Matrix3::zeros();
        }
        (Matrix3::identity() - self.arm * self.arm.transpose() / square) * pull
    }

    /// Returns the product of the residual and the free motion of a slope, in J.
    pub fn residual(&self, h: f64) -> f64 {
        -self.along.dot(&self.impulse) * self.stretch / h
    }

    /// Returns the work in J of what closes a gap or rotates a clamp.
    pub fn work(&self, h: f64) -> f64 {
        -self.impulse.dot(&self.driven) / h
    }

    /// Returns force and moment of the cable on the body in N and N m, and their power in W.
    pub fn action(&self, body: &BodyStep, h: f64) -> (Vector3<f64>, Vector3<f64>, f64) {
        let mean = self.impulse / h;
        let power = mean.dot(&self.velocity(body));
        if self.twists != [Vector3::zeros(); 2] {
            let twist = (self.twists[0] + self.twists[1]) / h;
            return (Vector3::zeros(), self.arm.cross(&mean) + twist, power + twist.dot(&body.mean[1]));
        }
        if self.slope { (Vector3::zeros(), self.arm.cross(&mean), power) } else { (mean, Vector3::zeros(), power) }
    }
}
