//! Cutting cables.

use super::reel;
use crate::contents::Contents;
use crate::error::Error;
use crate::events::Event;
use crate::handle::CableHandle;
use crate::scales::edit::AT_CUT;
use lariat_ancf::{Break, Cable};

/// Makes two cables of one, if `how` does; `cable` keeps the part before the break. Returns the
/// handle of the other part.
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
    reel::follow_cut(contents, cable, tail);
    let held = contents.attachments.values_mut().map(|a| (&mut a.cable, &mut a.arc_length));
    let tied = contents.junctions.values_mut().flat_map(|j| j.nodes.iter_mut().zip(&mut j.arc_lengths));
    for (of, s) in held.chain(tied.map(|((of, _), s)| (of, s))) {
        if *of == cable && *s > length * (1.0 + AT_CUT) {
            (*of, *s) = (tail, *s - length);
        }
    }
    events.push(Event::Broken { cable, rest: tail, how });
    Ok(Some(tail))
}
