//! Cables that break where they are overloaded.
//!
//! # Validity
//! Broken at the end of a host step, by the largest load of its integration steps. Until then the
//! whole cable goes on: bodies that it holds get at most the impulse of its tension over what is
//! left of the host step more.
//!
//! # Alternatives considered
//! What was tried, and what it gave: docs/decisions/rapier.md.

use super::part::part;
use crate::contents::Contents;
use crate::events::Event;
use crate::handle::CableHandle;
use lariat_ancf::Cable;

/// Breaks the cables that carry more than they withstand.
pub(crate) fn break_overloaded(contents: &mut Contents, events: &mut Vec<Event>) {
    for i in 0..contents.cables.len() {
        // the load of a sleeping cable does not change
        let compares =
            |slot: &&mut crate::contents::Slot| slot.cable.strength().is_limited() && !(slot.asleep && slot.compared);
        let Some(slot) = contents.cables.get_mut(i).filter(compares) else { continue };
        slot.compared = true;
        // a cable that was built can be cut at its nodes
        let _ = part(contents, CableHandle(i as u32), Cable::break_overloaded, events);
    }
}
