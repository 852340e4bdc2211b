//! Removing cables.

use super::attach::detach;
use super::join::leave;
use super::reel;
use crate::contents::Contents;
use crate::error::Error;
use crate::handle::{AttachmentHandle, CableHandle, JunctionHandle};
use lariat_ancf::Cable;
use lariat_ancf::coupling::Coupling;
use rapier::pipeline::PhysicsWorld;

/// Removes a cable with its attachments, and takes it out of its junctions.
pub(crate) fn remove(contents: &mut Contents, world: &mut PhysicsWorld, cable: CableHandle) -> Result<Cable, Error> {
    contents.cable(cable)?;
    for i in 0..contents.attachments.len() {
        if contents.attachments.get(i).is_some_and(|a| a.cable == cable) {
            detach(contents, world, AttachmentHandle(i as u32))?;
        }
    }
    reel::remove_of(contents, cable)?;
    for i in 0..contents.junctions.len() {
        if contents.junctions.get(i).is_some_and(|j| j.nodes.iter().any(|(c, _)| *c == cable)) {
            leave(contents, JunctionHandle(i as u32), cable)?;
        }
    }
    contents.changed = true;
    let mut removed = contents.cables.remove(cable.0 as usize).ok_or(Error::NoCable(cable))?.cable;
    removed.set_least_damping(0.0);
    Ok(removed)
}
