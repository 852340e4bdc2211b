//! Guarded discrete gradient: order 2, cannot make energy, one Newton iteration in most steps.
//!
//! # Equation
//!
//! With `D x = x1 - x0` over a step h, `O x` that of the step before (zero after a change by the
//! host), `b = 1/2 + a`, a = 1/16 unless the user chooses less
//!
//! ```text
//! M D v = h (G + F - f + R)        D q = h v^        v^ = v0 + b D v - a O v
//! ```
//!
//! f is the discrete gradient of the strain energy U ([`element::step`](crate::element::step)): `f
//! . D q = D U + loss`. G are dead loads, F all other forces, R the reactions of supports, which
//! move by D q as prescribed. The product of the first equation with v^ is the *energy law*: with
//!
//! ```text
//! H = 1/2 v.M v + U - G.q + S          S = a/2 (|D v|^2 + |D y|^2 + |D d|^2), of the last step
//! D H = (F + R).D q - a/2 (|D v - O v|^2 + |D y - O y|^2 + |D d - O d|^2) - internal damping
//! ```
//!
//! (|v|^2 = v.M v; y are strains, d slopes.) So H never rises but by the work of F and of supports,
//! at any h, and neither does the mechanical energy E = H - S beyond it. It is the one-leg G-stable
//! formula with the coefficients (b, 1/2 - 2a, a): `b L^2 + (1/2 - 2a) L + a = 0` has the double
//! root L = -1/3 for a = 1/16, so that modes which a step does not resolve fall to a third in every
//! step. Slow ones have the damping ratio a (h omega)^3/2.
//!
//! # Solution
//!
//! Newton's iteration begins at the constant acceleration of the step before. One iteration is
//! taken, and *the step is accepted by its own energy law*: the residual r of the equation makes
//! the energy `v^.r`, which must not be above what the step loses, to 1e-9 of its energy
//! (safeguard.rs). Only if it is, the step is iterated further, then its velocities relative to
//! rigid motion are scaled down, then it is divided by four.
//!
//! # Validity
//!
//! Any stiffness, any step. Games: h = 1/240 s, or by choice other steps (pace.rs).
//! The error of a slow motion is that of the midpoint rule; fast modes are not resolved,
//! but bounded. With a tolerance steps follow an estimate of that error (advance.rs), with a =
//! 1/256, and impulses balance to 1e-3.
//!
//! # References
//!
//! Dahlquist, BIT 18 (1978) 384 (G-stability); Gonzalez, J. Nonlinear Sci. 6 (1996) 449; Simo &
//! Tarnow, ZAMP 43 (1992) 757; Armero & Romero, CMAME 190 (2001) 2603 and 6783 (energy-decaying
//! methods for nonlinear elastodynamics).
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/integration.md.

mod advance;
mod law;
mod pace;
mod relaxation;
mod safeguard;

use super::{Dynamics, OneStep, Scratch, State, StepRequest};
use crate::error::{Error, StepFailure, require};
use crate::scales::integrate::ALPHA;
pub use crate::state::Differences;
pub use crate::state::Pace;
pub use crate::term::EnergyLaw;
pub(crate) use advance::advance;
pub(crate) use law::{DiscreteGradientSystem, Event, share_to_take, sum_of_forces};

/// Name of the method with the dissipation of games.
const NAME: &str = "discrete-gradient";

/// The guarded discrete gradient as a method; only [`Cable`](crate::Cable) and
/// [`Island`](crate::island::Island) can take it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiscreteGradient {
    /// Dissipation a, 0 to 1/16.
    pub dissipation: f64,
}

impl Default for DiscreteGradient {
    /// With the dissipation of fidelity `game`, 1/16.
    fn default() -> Self {
        DiscreteGradient { dissipation: ALPHA }
    }
}

impl OneStep for DiscreteGradient {
    fn name(&self) -> String {
        let dissipation = self.dissipation;
        if dissipation == ALPHA { NAME.to_string() } else { format!("{NAME}-{dissipation}") }
    }

    fn estimate_order(&self) -> Option<u32> {
        Some(3)
    }

    fn dissipation(&self) -> f64 {
        self.dissipation
    }

    fn check(&self) -> Result<(), Error> {
        let within = (0.0..=ALPHA).contains(&self.dissipation);
        require("dissipation", self.dissipation, within, "0 to 0.0625")
    }

    fn uses_discrete_gradients(&self) -> bool {
        true
    }

    fn step(
        &self,
        _: &mut dyn Dynamics,
        _: &State,
        _: StepRequest,
        _: &mut Scratch,
    ) -> Result<Option<f64>, StepFailure> {
        Err(StepFailure::NoDiscreteGradient)
    }
}
