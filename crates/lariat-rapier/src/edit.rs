//! Removing and cutting cables.

use crate::attach::detach;
use crate::contents::Contents;
use crate::error::Error;
use crate::handle::{AttachmentHandle, CableHandle, JunctionHandle};
use crate::join::leave;
use lariat_ancf::{At, Cable};
use rapier::pipeline::PhysicsWorld;

/// Removes a cable with its attachments, and takes it out of its junctions.
pub(crate) fn remove(contents: &mut Contents, world: &mut PhysicsWorld, cable: CableHandle) -> Result<Cable, Error> {
    contents.cable(cable)?;
    for i in 0..contents.attachments.len() {
        if contents.attachments.get(i).is_some_and(|a| a.cable == cable) {
            detach(contents, world, AttachmentHandle(i as u32))?;
        }
    }
    for i in 0..contents.junctions.len() {
        if contents.junctions.get(i).is_some_and(|j| j.nodes.iter().any(|(c, _)| *c == cable)) {
            leave(contents, JunctionHandle(i as u32), cable)?;
        }
    }
    contents.changed = true;
    contents.cables.remove(cable.0 as usize).map(|slot| slot.cable).ok_or(Error::NoCable(cable))
}

/// Cuts a cable in two; `cable` keeps the part before the cut. Returns the handle of the other
/// part.
pub(crate) fn cut(contents: &mut Contents, cable: CableHandle, at: At) -> Result<CableHandle, Error> {
    let kept = contents.cable_mut(cable)?;
    let rest = kept.cut(at)?;
    let length = kept.length();
    let inherited = contents.slot(cable).map(|slot| (slot.follows_gravity, slot.strength, slot.rules));
    let tail = contents.insert(rest);
    if let (Some(slot), Some(inherited)) = (contents.cables.get_mut(tail.0 as usize), inherited) {
        (slot.follows_gravity, slot.strength, slot.rules) = inherited;
    }
    let held = contents.attachments.values_mut().map(|a| (&mut a.cable, &mut a.arc_length));
    let tied = contents.junctions.values_mut().flat_map(|j| j.nodes.iter_mut().zip(&mut j.arc_lengths));
    for (of, s) in held.chain(tied.map(|((of, _), s)| (of, s))) {
        if *of == cable && *s > length * (1.0 + 1e-9) {
            (*of, *s) = (tail, *s - length);
        }
    }
    Ok(tail)
}
