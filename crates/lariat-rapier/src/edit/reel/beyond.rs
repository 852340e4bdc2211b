//! What runs on beyond the sheaves of a cable: a reel at its end counts that as out.

use crate::contents::Contents;
use crate::handle::CableHandle;
use lariat_ancf::coupling::Coupling;

/// Tells each part of a cable how much of it is beyond the sheaves at its ends.
pub(crate) fn count(contents: &mut Contents) {
    let along: Vec<([CableHandle; 2], f64)> = contents
        .wheels
        .sheaves
        .values()
        .filter_map(|sheave| Some((sheave.ends.map(|(cable, _)| cable), sheave.along?)))
        .collect();
    let beyond = |contents: &Contents, first: ([CableHandle; 2], f64), back: bool| {
        let next = |&([before, part], _): &([CableHandle; 2], f64)| {
            let mut found = along.iter().map(|&([a, b], on)| (if back { [b, a] } else { [a, b] }, on));
            found.find(|([a, b], _)| *a == part && *b != before)
        };
        let parts = core::iter::successors(Some(first), next).take(along.len());
        parts.filter_map(|([_, part], on)| Some(contents.cable(part).ok()?.length() + on)).sum::<f64>()
    };
    for &([before, behind], on) in &along {
        let after = beyond(contents, ([before, behind], on), false);
        let ahead = beyond(contents, ([behind, before], on), true);
        for (cable, start, length) in [(before, false, after), (behind, true, ahead)] {
            // only cables that exist have sheaves
            if let Ok(cable) = contents.cable_mut(cable) {
                cable.set_beyond(start, length);
            }
        }
    }
}
