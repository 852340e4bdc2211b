//! Cables that break where they are overloaded.
//!
//! # Validity
//! Broken between two steps of Rapier, by the largest load of its integration steps; where within
//! a host step: [`breaks`](crate::step).

use super::part::part;
use crate::contents::{Contents, Slot};
use crate::events::Event;
use crate::handle::CableHandle;
use lariat_ancf::Cable;

/// Breaks the cables that carry more than they withstand.
pub(crate) fn break_overloaded(contents: &mut Contents, events: &mut Vec<Event>) {
    // the load of a sleeping cable does not change
    break_those(contents, events, |slot| !(slot.asleep && slot.compared));
}

/// Breaks the sleeping cables that carry more than what they withstand by now.
pub(crate) fn break_sleeping(contents: &mut Contents, events: &mut Vec<Event>) {
    break_those(contents, events, |slot| slot.asleep && !slot.compared);
}

fn break_those(contents: &mut Contents, events: &mut Vec<Event>, chosen: fn(&Slot) -> bool) {
    for i in 0..contents.cables.len() {
        let compares = |slot: &&mut Slot| slot.cable.strength().is_limited() && chosen(slot);
        let Some(slot) = contents.cables.get_mut(i).filter(compares) else { continue };
        slot.compared = true;
        // a cable that was built can be cut at its nodes
        let _ = part(contents, CableHandle(i as u32), Cable::break_overloaded, events);
    }
}
