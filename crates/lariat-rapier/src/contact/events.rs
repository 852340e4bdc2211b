//! Contacts that began and ended, and what is read of them.

use super::collider;
use crate::contents::Contents;
use crate::events::Event;
use crate::handle::CableHandle;
use lariat_ancf::Cable;

/// What a cable touches: key of the collider, sum of the normal forces in N, and the arc length in
/// m of their centre.
type Touched = (u64, f64, f64);

/// Compares what cables touch with what they touched at the end of the last host step.
pub(crate) fn compare(contents: &mut Contents, events: &mut Vec<Event>) {
    for index in 0..contents.cables.len() {
        let Some(slot) = contents.cables.get_mut(index) else { continue };
        if slot.asleep || slot.touched.is_empty() && slot.cable.effects().contact.is_none() {
            continue;
        }
        let cable = CableHandle(index as u32);
        let now = touched(&slot.cable);
        for &(key, force, arc_length) in &now {
            if !slot.touched.iter().any(|(before, _)| *before == key) {
                events.push(Event::ContactStarted { cable, collider: collider(key), arc_length, force });
            }
        }
        for &(key, arc_length) in &slot.touched {
            if !now.iter().any(|(after, ..)| *after == key) {
                events.push(Event::ContactEnded { cable, collider: collider(key), arc_length });
            }
        }
        slot.touched.clear();
        slot.touched.extend(now.into_iter().map(|(key, _, arc_length)| (key, arc_length)));
    }
}

fn touched(cable: &Cable) -> Vec<Touched> {
    let mut sums: Vec<Touched> = Vec::new();
    for touch in cable.contacts() {
        let (force, moment) = (touch.normal_force, touch.normal_force * touch.arc_length);
        match sums.iter_mut().find(|(key, ..)| *key == touch.obstacle) {
            Some(sum) => (sum.1, sum.2) = (sum.1 + force, sum.2 + moment),
            None => sums.push((touch.obstacle, force, moment)),
        }
    }
    sums.sort_unstable_by_key(|(key, ..)| *key);
    sums.into_iter().map(|(key, force, moment)| (key, force, moment / force)).collect()
}
