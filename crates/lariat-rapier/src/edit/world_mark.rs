//! The world that the attachments of a set belong to.
//!
//! # Scheme
//! A world of Rapier's has no identity, and a handle of one world may name a body of another.
//! Therefore a set with attachments adds a mark to its world in the next step: a fixed, disabled
//! body without colliders, whose `user_data` is a hash of attachments and bodies. The mark is part
//! of the world's state and of the set's, so that snapshots of both fit together. It is removed
//! with the last attachment.
//!
//! # Validity
//! Before its first step a set knows its world by its bodies alone: a world in which they exist
//! becomes its own. Two worlds that were equal to the bit when they were marked, with equal sets,
//! are not told apart.
//!
//! # Alternatives considered
//! A number that is given out once: the state of two equal runs would differ.

use crate::contents::Contents;
use crate::contents::mark::WorldMark;
use crate::error::Error;
use rapier::dynamics::RigidBodyBuilder;
use rapier::pipeline::PhysicsWorld;
use std::hash::{DefaultHasher, Hash, Hasher};

/// Returns whether a world may be the one of the attachments: it carries their mark, or there is
/// none yet.
pub(crate) fn is_own(contents: &Contents, world: &PhysicsWorld) -> bool {
    contents.mark.is_none_or(|mark| mark.is_in(world))
}

/// Checks that a world is the one of the attachments, and marks it if it is not marked yet.
pub(crate) fn check(contents: &mut Contents, world: &mut PhysicsWorld) -> Result<(), Error> {
    if contents.attachments.values().next().is_none() {
        return Ok(());
    }
    if !is_own(contents, world) {
        return Err(Error::OtherWorld);
    }
    if contents.mark.is_none() {
        let missing = contents.attachments.values().map(|a| a.body).filter(|body| !world.bodies.contains(*body));
        let newest_missing = missing.map(|body| body.into_raw_parts().1).max();
        if newest_missing.is_some_and(|missing| missing >= next_generation(world)) {
            return Err(Error::OtherWorld);
        }
        let key = key(contents, world);
        let body = RigidBodyBuilder::fixed().enabled(false).user_data(u128::from(key));
        contents.mark = Some(WorldMark { body: world.insert_body(body), key });
    }
    Ok(())
}

/// Returns the generation that the next body of a world gets. Each removal raises it, so a body
/// that was removed from this world is older.
fn next_generation(world: &PhysicsWorld) -> u32 {
    world.bodies.clone().insert(RigidBodyBuilder::fixed()).into_raw_parts().1
}

/// Removes the mark from its world.
pub(crate) fn remove(contents: &mut Contents, world: &mut PhysicsWorld) {
    if let Some(mark) = contents.mark.take()
        && mark.is_in(world)
    {
        world.remove_body(mark.body);
    }
}

/// Returns a number that tells the attachments of this set from others.
fn key(contents: &Contents, world: &PhysicsWorld) -> u64 {
    let mut hasher = DefaultHasher::new();
    for a in contents.attachments.values() {
        a.body.into_raw_parts().hash(&mut hasher);
        if let Some(body) = world.bodies.get(a.body) {
            let (x, v) = (body.translation(), body.linvel());
            [x.x, x.y, x.z, v.x, v.y, v.z, body.mass()].iter().for_each(|x| x.to_bits().hash(&mut hasher));
        }
        a.arc_length.to_bits().hash(&mut hasher);
        a.anchor.iter().for_each(|x| x.to_bits().hash(&mut hasher));
        if let Some(slot) = contents.slot(a.cable) {
            slot.cable.name().hash(&mut hasher);
            slot.cable.positions().iter().for_each(|x| x.to_bits().hash(&mut hasher));
        }
    }
    hasher.finish()
}
