//! Whether integration steps are short enough for the motion, read from the velocities at host
//! times.
//!
//! # Equation
//!
//! A second-order method turns an oscillation of frequency omega by `(omega h)^2/12` of its angle
//! too little (trapezoidal and midpoint rule, and the discrete gradient, which is both for a linear
//! force), so after one oscillation of a point with velocity v the point is
//!
//! ```text
//! E = 2 pi (omega h)^2/12 |v|/omega = pi/6 h^2 omega |v|
//! ```
//!
//! off. The frequency is that of the motion itself: `omega^2 = |v''|/|v|`, exact for one mode at
//! every time, with `H^2 v'' = (v(t + 2 H) - 2 v(t) + v(t - 2 H))/4`, H the host step, h = H/n with
//! n integration steps in each. The difference over two host steps is the product of the second
//! difference and of the mean `(1, 2, 1)/4`, which takes away what alternates from step to step:
//! the ringing of modes far beyond the step, whose amplitude is small and whose phase nobody sees.
//! So
//!
//! ```text
//! E = pi/6 H/n^2 sqrt(|H^2 v''| |v|)
//! ```
//!
//! # Validity
//!
//! Methods of second order with fixed steps, by their mean length where some are divided; those
//! with a tolerance control their own error. Uniform acceleration has no error, and a jump of the
//! velocity by `dv`, as in a taut snap, gives about `h dv/4`: such a step is of first order. E is
//! the error of one oscillation; over many it adds up, and one that is forced keeps it. For Verlet
//! it is twice the error; for the generalised-alpha method with strong damping, less than it, but
//! its loss of energy is told.
//!
//! # References
//!
//! Relative period errors: Hughes, The Finite Element Method, 1987, section 9.1 (trapezoidal rule:
//! `(omega h)^2/12`).
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/study.md.

use crate::cable::Cable;
use crate::integrate::StepControl;
use crate::watch::{Estimate, Steps};

impl Steps {
    /// Reads the velocities at a host time.
    pub fn note(&mut self, cable: &Cable) {
        let integrator = cable.integrator();
        let controlled = matches!(integrator.control, StepControl::Tolerance(_) | StepControl::ToleranceOf(..));
        if controlled || integrator.method.properties().order != 2 {
            self.known = 0;
            return;
        }
        let (now, v) = (cable.time(), cable.velocities());
        let host_step = now - core::mem::replace(&mut self.time, now);
        let same = (host_step - self.host_step).abs() <= 1e-3 * host_step && self.before[1].len() == v.len();
        if self.known == 0 || !same {
            self.host_step = host_step;
            self.keep(cable, 1);
            return;
        }
        self.between = !self.between;
        if self.between {
            return;
        }
        let steps = 0.5 * cable.diagnostics().steps.saturating_sub(self.steps) as f64;
        if self.known > 1 && steps >= 1.0 {
            let [first, middle] = &self.before;
            let mut largest: f64 = 0.0;
            for ((first, middle), last) in first.chunks_exact(6).zip(middle.chunks_exact(6)).zip(v.chunks_exact(6)) {
                let (mut second, mut speed) = (0.0, 0.0);
                for k in 0..3 {
                    let difference = 0.25 * (first[k] - 2.0 * middle[k] + last[k]);
                    second += difference * difference;
                    speed += middle[k] * middle[k];
                }
                largest = largest.max(second * speed);
            }
            let error = core::f64::consts::FRAC_PI_6 * host_step / (steps * steps) * largest.sqrt().sqrt();
            if error > self.worst.error {
                self.worst = Estimate { error, time: now - 2.0 * host_step, step: host_step / steps };
            }
        }
        self.keep(cable, 2);
    }

    fn keep(&mut self, cable: &Cable, known: u8) {
        self.before.swap(0, 1);
        self.before[1].clear();
        self.before[1].extend_from_slice(cable.velocities());
        (self.known, self.between, self.steps) = (known, false, cable.diagnostics().steps);
    }
}
