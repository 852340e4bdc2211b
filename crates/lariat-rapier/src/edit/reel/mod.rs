//! What cables run over, and what they are wound on: sheaves at an end and along a cable, and
//! drums.

pub(crate) mod beyond;
pub(crate) mod drums;
pub(crate) mod passing;
pub(crate) mod sheaves;

use crate::contents::Contents;
use crate::error::Error;
use crate::handle::CableHandle;
use rapier::pipeline::PhysicsWorld;

/// Ends what a cable that is removed runs over or is wound on.
pub(crate) fn remove_of(contents: &mut Contents, cable: CableHandle) -> Result<(), Error> {
    sheaves::remove_at(contents, cable, None)?;
    drums::remove_where(contents, |wound| wound.cable == cable)
}

/// Ends the drums whose bodies were removed from the world.
pub(crate) fn end_lost(contents: &mut Contents, world: &PhysicsWorld) -> Result<(), Error> {
    drums::remove_where(contents, |wound| !world.bodies.contains(wound.drum.body))
}

/// Gives what is at the end of a cable that was cut to the part behind the cut.
pub(crate) fn follow_cut(contents: &mut Contents, cable: CableHandle, tail: CableHandle) {
    sheaves::follow_cut(contents, cable, tail);
    drums::follow_cut(contents, cable, tail);
}
