//! Contact of cables with the colliders of the world, and with each other.
//!
//! The mechanics are those of [`lariat_ancf::contact`]: before each Rapier step a cable with the
//! effect [`Contact`](lariat_ancf::Contact) is given the colliders that it can reach as obstacles,
//! with their motion over the step.
//!
//! | file | what it does |
//! |---|---|
//! | [`broad`] | finds the colliders that a cable can reach, by Rapier's tree |
//! | [`neighbours`] | finds the cables that can touch each other |
//! | [`shape`], [`mesh`], [`compound`], [`cone`] | the surface of a collider in `f64`, from the exact numbers of its shape |
//! | [`events`] | contacts that began and ended |
//! | [`pull`] | what a cable pulls at a node, with contacts that other cables keep |
//!
//! Which of them a cable touches, and with which friction, is said by its
//! [rules](crate::contents::rules), as Rapier decides it.
//!
//! # Validity
//!
//! All colliders but those with a shape of the program's own: a cable that is found in one says so
//! by [`Event::ContactIgnored`](crate::Event), once for each. A dynamic body joins the island of
//! the cables that can reach it in a step, as an unknown, and leaves it when it is far; a body that
//! sleeps wakes up when a cable that moves comes near. Within four radii of an attachment, and as
//! much further as its anchor is inside, a cable does not touch the body that holds it.
//!
//! A body that cables press on another one feels them in Rapier's step by the estimate of its
//! reactions alone, without the motors of attachments: a load that is lashed to a vehicle slides
//! too easily.
//!
//! Restitution is combined as friction is, and at most 15/17.
//!
//! Rapier's tree holds the boxes of its last step. A fixed collider that is moved by hand is found
//! a step later; a cable that is in it by then gets no energy from it, but stays as deep as it was
//! found.

pub(crate) mod broad;
mod compound;
mod cone;
pub(crate) mod events;
mod mesh;
mod neighbours;
pub(crate) mod pull;
mod shape;

pub(crate) use shape::Surfaces;

use rapier::geometry::ColliderHandle;

/// Returns the key of a collider among obstacles.
pub(crate) fn key(collider: ColliderHandle) -> u64 {
    let (index, generation) = collider.into_raw_parts();
    u64::from(generation) << 32 | u64::from(index)
}

/// Returns the collider that a warning of a cable of a set calls an obstacle, by its key, as
/// [`Through::Obstacle`](lariat_ancf::warning::Through::Obstacle).
pub fn collider(key: u64) -> ColliderHandle {
    ColliderHandle::from_raw_parts(key as u32, (key >> 32) as u32)
}
