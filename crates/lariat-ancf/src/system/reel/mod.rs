//! The element at the eye of a reel within the equations of its cable.
//!
//! # Equation
//!
//! Implicit stages evaluate the element at its length l(t): its stiffness, mass and weight are
//! those of l, and the [forces of the feed](crate::element::variable_length) are added. Internal
//! damping sees the rates of the control vectors, of which `d1 = 3 (r_j - r_i)/l` changes with l,
//! too.
//!
//! In a step of the discrete gradient from l0 to l1 the strain energy is `U = l C_a u_a(g) + C_b
//! u_b(g)/l`. With the means over the step
//!
//! ```text
//! D d1 = 3 [D(r_j - r_i) (1/l)_m + (r_j - r_i)_m D(1/l)]      D U = f . D q + Y D l to rounding
//! ```
//!
//! The loop over the elements keeps its form: it is given the eye where it would be on an element
//! of the length l0 with the same control vectors, and its force is scaled by `l0 (1/l)_m`. Weight
//! is that of the mean length. Inertia is the change of the momentum p = M v + l' G q over the
//! step, from one length to the other ([`step`]), so its sum over a cable is the change of the
//! cable's momentum, less what flows in with the material.
//!
//! Where the eye is on a body that moves freely, the stock rides with it: as a mass point m at the
//! eye, whose momentum and weight are those of the node there. What leaves the stock enters the
//! element, so the momentum of cable, stock and body stays to rounding.
//!
//! # Validity
//!
//! Elastic work and momentum are exact for any step; kinetic energy and angular momentum to the
//! second order of the step: means of `l' G q` and of M over the step are not those of its ends.
//! Where nothing holds the system, angular momentum is [restored](crate::system::angular). The
//! tangent takes the symmetric part of the forces of the feed, and with riding stock its sums over
//! rows are exact. Stock has no inertia about the eye.

mod drum;
mod effects;
mod feeds;
mod graph;
mod law;
mod lengths;
mod linear;
mod motors;
mod sheave;
mod step;
mod tension;
#[cfg(test)]
mod tests;
mod unknowns;
mod wheel;
mod work;

pub(crate) use drum::Winch;
pub(crate) use feeds::{FeedElement, Feeds, Source};
pub(crate) use law::{Law, Motor, MotorState, rates, towards};
pub use sheave::Sheave;
pub(crate) use unknowns::Unknowns;
pub(crate) use wheel::Wheel;

/// Any number in -1..1, for tests.
#[cfg(test)]
fn some(seed: usize) -> f64 {
    (1.7 * seed as f64 + 0.3).sin()
}
