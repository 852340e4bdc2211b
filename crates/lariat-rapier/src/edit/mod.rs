//! Removing and cutting cables.

pub(crate) mod drums;
pub(crate) mod sheaves;

use crate::attach::detach;
use crate::contents::Contents;
use crate::error::Error;
use crate::events::Event;
use crate::handle::{AttachmentHandle, CableHandle, JunctionHandle};
use crate::join::leave;
use lariat_ancf::{Break, Cable};
use rapier::pipeline::PhysicsWorld;

/// Removes a cable with its attachments, and takes it out of its junctions.
pub(crate) fn remove(contents: &mut Contents, world: &mut PhysicsWorld, cable: CableHandle) -> Result<Cable, Error> {
    contents.cable(cable)?;
    for i in 0..contents.attachments.len() {
        if contents.attachments.get(i).is_some_and(|a| a.cable == cable) {
            detach(contents, world, AttachmentHandle(i as u32))?;
        }
    }
    sheaves::remove_at(contents, cable, None)?;
    drums::remove_of(contents, cable)?;
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

/// Makes two cables of one, if `how` does; `cable` keeps the part before the break. Returns the handle of
/// the other part.
pub(crate) fn part(
    contents: &mut Contents,
    cable: CableHandle,
    how: impl FnOnce(&mut Cable) -> Result<Option<(Cable, Break)>, lariat_ancf::Error>,
    events: &mut Vec<Event>,
) -> Result<Option<CableHandle>, Error> {
    let slot = contents.cables.get_mut(cable.0 as usize).ok_or(Error::NoCable(cable))?;
    let Some((rest, how)) = how(&mut slot.cable)? else { return Ok(None) };
    slot.modified = true;
    let (length, follows_gravity, rules) = (slot.cable.length(), slot.follows_gravity, slot.rules);
    let tail = contents.insert(rest);
    if let Some(slot) = contents.cables.get_mut(tail.0 as usize) {
        (slot.follows_gravity, slot.rules) = (follows_gravity, rules);
    }
    sheaves::follow_cut(contents, cable, tail);
    drums::follow_cut(contents, cable, tail);
    let held = contents.attachments.values_mut().map(|a| (&mut a.cable, &mut a.arc_length));
    let tied = contents.junctions.values_mut().flat_map(|j| j.nodes.iter_mut().zip(&mut j.arc_lengths));
    for (of, s) in held.chain(tied.map(|((of, _), s)| (of, s))) {
        if *of == cable && *s > length * (1.0 + 1e-9) {
            (*of, *s) = (tail, *s - length);
        }
    }
    events.push(Event::Broken { cable, rest: tail, how });
    Ok(Some(tail))
}
