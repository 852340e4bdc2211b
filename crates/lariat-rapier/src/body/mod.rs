//! Bodies of the world, each by itself: what the mechanics read of them, what is remembered of
//! their motion, and what they are near.
//!
//! | file | what it does |
//! |---|---|
//! | [`rigid_body`](mod@rigid_body) | Rapier's bodies as the mechanics see them |
//! | [`saved`] | the settings of a body that a step changes and restores |
//! | [`pose`], [`spatial`] | positions and attitudes, and vectors of six |
//! | [`record`], [`motion_memory`] | what is kept of each body between steps |
//! | [`prescribed_motion`] | how fixed and kinematic bodies move in a host step |
//! | [`lost_spin`] | the angular velocity of kinematic bodies that Rapier does not carry out |
//! | [`ledger`] | the heavy body and the motors through which a body feels its cable |
//! | [`proximity`] | which bodies a body is near, and which it will collide with |
//! | [`unsettled`] | whether Rapier does with bodies on joints what was predicted for them |

pub(crate) mod ledger;
pub(crate) mod lost_spin;
pub(crate) mod motion_memory;
pub(crate) mod pose;
pub(crate) mod prescribed_motion;
pub(crate) mod proximity;
pub(crate) mod record;
mod rigid_body;
mod saved;
pub(crate) mod spatial;
pub(crate) mod unsettled;

pub use rigid_body::rigid_body;
pub(crate) use rigid_body::{give_mass, is_integrated, read, update_mass};
pub(crate) use saved::{SavedBody, replace_loads};
