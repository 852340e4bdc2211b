//! Mechanisms: what joints do to a body that a cable is attached to.
//!
//! A body that joints hold answers its cables with the inertia of all that it moves with, and
//! impulses on it change the velocities of all of it.
//!
//! # Equation
//! ```text
//! L = (W + e S)^-1      L x'' = f + L a0      v += R p,  or of a multibody  u += R p
//! ```
//! W is the mobility of the bodies in their mechanism, S that of each alone, a0 their accelerations
//! by the loads on the other bodies ([`loads`]), and R the response of all bodies, or of the
//! generalised velocity u, to impulses p and their moments about the centres of mass. L is that of
//! all bodies of the mechanism that cables act on ([`group`]); they are members of one island. All
//! are those of the configuration after half a step at the present velocities, and a0 contains the
//! centripetal acceleration on the way there: the prediction is of second order in the step.
//!
//! # Validity
//! Stiff joints. Motors and contacts enter by the reaction estimate. Several ropes on a chain of
//! impulse joints that is near another body ripple by some percent of their forces (tests,
//! arms.rs).
//!
//! # References
//! Khatib 1987, the operational space inertia.
//!
//! # Alternatives considered
//! What was tried, and what it gave: docs/decisions/rapier.md.

mod constraints;
mod find;
mod generalised;
mod group;
mod joint_chain;
mod joint_damping;
mod joint_gap;
mod joint_opening;
mod limits;
mod loads;
mod multibody;
mod of_body;
mod request;

pub(crate) use find::{bodies, find, is_mixed};
pub(crate) use generalised::refresh;
pub(crate) use group::{Group, Jointed, own_inertia, velocity_of};
pub(crate) use multibody::prepare;
pub(crate) use of_body::Mechanism;
pub(crate) use request::Request;
