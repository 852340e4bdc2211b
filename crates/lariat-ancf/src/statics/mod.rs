//! Static equilibrium from any start, slack or taut: F(q) = 0.
//!
//! The attempts, one file each, are made in this order until one ends in a shape without folds:
//! - `load_ramp`, if there are moments: load incrementation by Newton's method, because beyond 90
//!   degrees a moment holds a cable, which has no torsional stiffness, in unstable shapes only;
//! - `pseudo_transient`: minimisation of the potential energy from the present shape, to a stable
//!   one;
//! - `load_ramp`, with other point loads;
//! - `start_shape`: minimisation from the shape that a new cable would have between the supports;
//! - `dynamic_relaxation`, then minimisation from there.
//!
//! In a flow there is no potential energy to minimise: the search of an [island](crate::island)
//! without bodies, and, for a cable that it does not bring to rest and that touches nothing,
//! `rest_in_flow`; where neither finds a shape, the flow grows from none (`driven`). With contact,
//! the law of contact is made harder from search to search (`continuation`).
//!
//! A shape with [folded elements](folds) is straightened once and minimised again; if it folds
//! again the attempt has failed. A small residual is not enough: the increments of Newton's method
//! must have fallen to rounding (`polish`), because the axial stiffness hides moments that are out
//! of balance; and a saddle of the energy is left along its softest mode (`saddle`). A stable shape
//! is preferred, an unstable one is returned if no stable one is found. The iterations of each
//! attempt and of all together are bounded.
//!
//! # Validity
//!
//! Any cable that is held against its loads. Without bending stiffness, slack parts without load
//! are indeterminate, and any shape of zero force is returned.
//!
//! # Alternatives considered
//!
//! - Newton's method without regularisation: the matrix of a slack cable is singular.
//! - Arc length methods: no branch has to be followed.

mod attempt;
mod continuation;
mod driven;
mod dynamic_relaxation;
mod folds;
mod load_ramp;
mod polish;
mod potential;
mod pseudo_transient;
mod relaxation;
mod rest_in_flow;
mod saddle;
mod self_stress;
mod start_shape;

pub(crate) use attempt::{Budget, Failure};
pub use attempt::{EquilibriumOptions, EquilibriumReport};
pub(crate) use continuation::{Continued, find};
pub(crate) use driven::in_shares;
pub(crate) use folds::{first_fold, straighten};
pub(crate) use potential::potential;
pub(crate) use start_shape::{lay_out, move_with_supports};
