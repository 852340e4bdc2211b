//! Cables that break where their tension exceeds their strength.
//!
//! # Validity
//! Compared after each host step: a peak between two host steps is not seen. The cable breaks at the
//! inner node nearest to the largest tension, so that a cable of one element does not break.

use crate::contents::Contents;
use crate::edit;
use crate::events::Event;
use crate::handle::CableHandle;
use lariat_ancf::{At, Cable};
use serde::{Deserialize, Serialize};

/// The strength of a cable.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Strength {
    /// Tension in N above which the cable breaks.
    pub limit: f64,
    /// Whether it was compared since it was set. The tension of a sleeping cable does not change.
    pub compared: bool,
}

/// Breaks the cables whose tension exceeds their strength.
pub(crate) fn break_overloaded(contents: &mut Contents, events: &mut Vec<Event>) {
    for i in 0..contents.cables.len() {
        let Some(slot) = contents.cables.get_mut(i) else { continue };
        let Some(strength) = slot.strength.as_mut().filter(|s| !(slot.asleep && s.compared)) else { continue };
        strength.compared = true;
        let (peak, tension) = slot.cable.peak_tension();
        let exceeded = tension > strength.limit;
        if !exceeded {
            continue;
        }
        let (cable, Some(at)) = (CableHandle(i as u32), inner_node(&slot.cable, peak)) else { continue };
        if let Ok(rest) = edit::cut(contents, cable, At::ArcLength(at)) {
            events.push(Event::Broken { cable, rest, arc_length: at, tension });
        }
    }
}

/// Returns the arc length in m of the inner node nearest to another; a cable of one element has none.
fn inner_node(cable: &Cable, arc_length: f64) -> Option<f64> {
    let nodes = cable.node_arc_lengths();
    let distance = |node: &f64| (node - arc_length).abs();
    nodes[1..nodes.len() - 1].iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)))
}
