//! Cables that break where they are overloaded.
//!
//! # Validity
//! Broken at the end of a host step, by the largest load of its integration steps. Until then the
//! whole cable goes on: bodies that it holds get at most the impulse of its tension over what is
//! left of the host step more.
//!
//! # Alternatives considered
//! Parts that go on from the time of the break. Rapier moves a body with one velocity in its step,
//! so that step would have to end there: the prediction of an island that breaks would be reverted,
//! as that of a mechanism that turns is, and made anew up to the time of the break, and islands,
//! attachments and contacts found anew before the rest. All islands of the world would take the
//! additional Rapier step, and a rope that frays would divide a host step as often as it breaks.

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
