//! When a cable breaks within a Rapier step: at the end of the integration step in which its load
//! exceeded its limit.
//!
//! # Scheme
//! ```text
//! predict over h    the load exceeds its limit at t < h    revert    predict over t, break, go on with h - t
//! ```
//! The whole cable acts on its bodies until t, its parts after it, and each length is a step of
//! Rapier's. So what a cable of strength S passes on in a host step is at most S t and what it
//! passes on beyond S in one integration step.
//!
//! # Validity
//! One Rapier step more of the whole world for each time at which cables break, up to
//! [`Settings::max_rapier_steps`](crate::Settings::max_rapier_steps); beyond these, and where that
//! setting fixes the number, a cable breaks at the end of the Rapier step. So does one that exceeds
//! its limit in the last [`SHORTEST_REST`] of it. A load above the limit when a Rapier step begins,
//! because a program or a contact changed it since the last, breaks the cable there.
//!
//! # Alternatives considered
//! The break at the end of the host step: a weak link throws back a body that should fly on. The
//! impulse beyond the limit taken back from both sides at that end: its place and direction are
//! those of a cable that should have gone.

use crate::contents::Contents;
use crate::islands::Island;
use crate::scales::TIME_ROUNDING;
use crate::scales::step::SHORTEST_REST;
use crate::step::host_step::HostStep;
use crate::step::prediction::Prediction;
use crate::step::settings::Settings;
use lariat_ancf::coupling::Coupling;

/// Returns the share of a Rapier step of `h` (s), just integrated, at which the first cable
/// exceeded its limit, if it is to break there and not at the end.
pub(crate) fn first_overload(
    contents: &Contents,
    islands: &[Island],
    predictions: &[Prediction],
    (settings, host): (&Settings, &HostStep),
    h: f64,
) -> Option<f64> {
    let stepped = islands.iter().zip(predictions);
    let stepped = stepped.filter(|(_, p)| !p.refused && p.error.is_none() && p.integrator.is_some());
    let cables = stepped.flat_map(|(island, _)| &island.cables).filter_map(|&c| Some(&contents.cables.get(c)?.cable));
    let at_start = |left: f64| left >= 1.0 - TIME_ROUNDING;
    let left = cables.filter_map(|cable| Some((cable.time() - cable.overloaded_at()?) / h));
    let left = left.filter(|&left| host.may_break_at_start() || !at_start(left)).fold(0.0, f64::max);
    if at_start(left) {
        return Some(0.0);
    }
    let is_room = host.rapier_steps() < settings.most_rapier_steps(f64::from(host.dt));
    (left >= SHORTEST_REST && is_room).then_some(1.0 - left)
}
