//! Generalised-alpha with spectral radius rho at infinity: order 2, one stage.
//!
//! # Equation
//!
//! In the form of Arnold & Bruls, with algorithmic accelerations a and true ones k (M k = F at
//! every step):
//!
//! ```text
//! (1 - am) a_{n+1} + am a_n = (1 - af) k_{n+1} + af k_n
//! q_{n+1} = q_n + h v_n + h^2 ((1/2 - beta) a_n + beta a_{n+1})
//! v_{n+1} = v_n + h ((1 - gamma) a_n + gamma a_{n+1})
//! am = (2 rho - 1)/(rho + 1)   af = rho/(rho + 1)   gamma = 1/2 + af - am
//! beta = (gamma + 1/2)^2/4
//! ```
//!
//! The error estimate is `h^2 |beta - 1/6 + (am - af)/2| |k_{n+1} - k_n|`, the leading term of the
//! local error.
//!
//! # Validity
//!
//! On steel at 1/60 s, rho = 0 is stable without spurious tension, rho >= 0.5 stable with it; rho =
//! 1 is the trapezoidal rule. Fixed steps that are too long for a slack cable in fast motion can
//! create energy.
//!
//! # References
//!
//! Chung & Hulbert 1993; Arnold & Bruls, Multibody Syst. Dyn. 18 (2007) 185.
//!
//! # Alternatives considered
//!
//! - HHT-alpha: kilonewtons of spurious tension on steel.
//! - One Newton iteration (a linearly implicit step): it creates energy where a slack cable is
//!   thrown. The [discrete gradient](super::discrete_gradient) costs half as much and cannot.

use super::dynamics::{Dynamics, Stage};
use super::one_step::{OneStep, Scratch, StepRequest, add_scaled};
use crate::error::{Error, StepFailure, require};
use crate::state::State;

/// Generalised-alpha.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeneralisedAlpha {
    /// Spectral radius at infinity, 0 (damps at once) to 1 (no damping).
    pub rho: f64,
}

impl OneStep for GeneralisedAlpha {
    fn name(&self) -> String {
        format!("generalised-alpha-{}", self.rho)
    }

    fn estimate_order(&self) -> Option<u32> {
        Some(3)
    }

    fn has_algorithmic_acceleration(&self) -> bool {
        true
    }

    fn check(&self) -> Result<(), Error> {
        require("rho of generalised-alpha", self.rho, (0.0..=1.0).contains(&self.rho), "between 0 and 1")
    }

    fn step(
        &self,
        system: &mut dyn Dynamics,
        now: &State,
        StepRequest { h, newton_tolerance, estimate }: StepRequest,
        scratch: &mut Scratch,
    ) -> Result<Option<f64>, StepFailure> {
        let am = (2.0 * self.rho - 1.0) / (self.rho + 1.0);
        let af = self.rho / (self.rho + 1.0);
        let gamma = 0.5 + af - am;
        let beta = 0.25 * (gamma + 0.5) * (gamma + 0.5);
        let Scratch { next, base, velocity_base, error, .. } = scratch;
        let (a, k) = (&now.memory.algorithmic, &now.memory.acceleration);
        // a_{n+1} = share k_{n+1} + (af k_n - am a_n)/(1 - am)
        let share = (1.0 - af) / (1.0 - am);
        for i in 0..base.len() {
            let known = (af * k[i] - am * a[i]) / (1.0 - am);
            base[i] = now.q[i] + h * (now.v[i] + h * ((0.5 - beta) * a[i] + beta * known));
            velocity_base[i] = now.v[i] + h * ((1.0 - gamma) * a[i] + gamma * known);
        }
        let c2 = h * h * beta * share;
        let c1 = h * gamma * share;
        let acceleration = &mut next.memory.acceleration;
        acceleration.copy_from_slice(k);
        let stage = Stage { time: now.time + h, c2, dv_dq: c1 / c2, newton_tolerance, reuse: false };
        system.solve_stage(&stage, base, velocity_base, &mut next.q, acceleration)?;
        next.v.copy_from_slice(velocity_base);
        add_scaled(&mut next.v, c1, acceleration);
        for i in 0..base.len() {
            next.memory.algorithmic[i] = share * acceleration[i] + (af * k[i] - am * a[i]) / (1.0 - am);
        }
        system.prescribe(now.time + h, &mut next.q, &mut next.v);
        if !estimate {
            return Ok(None);
        }
        let constant = h * h * (beta - 1.0 / 6.0 + 0.5 * (am - af));
        for i in 0..error.len() {
            error[i] = constant * (acceleration[i] - k[i]);
        }
        system.filter(error);
        Ok(Some(system.norm(error)))
    }
}
