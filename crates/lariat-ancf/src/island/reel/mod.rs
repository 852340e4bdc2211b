//! Sheaves and drums of an island, and what cables and bodies must be for them.

mod drum;
mod sheave;

use super::body::RigidBody;
use super::pin::{PinConstraint, is_on_free_body};
use crate::cable::Cable;
use crate::error::Error;
use crate::integrate::OneStep;
use crate::system::{Unknowns, Wheel};

pub use crate::system::Sheave;
pub use drum::Drum;

/// The wheels of an island: what its cables run over, and bodies that they are wound on.
#[derive(Debug, Default)]
pub struct Wheels<'a> {
    /// Sheaves between ends of cables.
    pub sheaves: &'a mut [Sheave],
    /// Drums with ends of cables on them.
    pub drums: &'a [Drum],
}

/// Checks that sheaves and drums fit the cables and bodies of an island, and that no end lacks its
/// own.
pub(super) fn check(
    cables: &[&mut Cable],
    bodies: &[RigidBody],
    pins: &[PinConstraint],
    (sheaves, drums): (&[Sheave], &[Drum]),
) -> Result<(), Error> {
    sheave::check(cables, sheaves)?;
    drum::check(cables, bodies, pins, drums)
}

/// Checks the reels of cables for a host step, and tells them which of them ride on free bodies.
pub(super) fn prepare(
    cables: &mut [&mut Cable],
    bodies: &[RigidBody],
    pins: &[PinConstraint],
    method: &dyn OneStep,
    dt: f64,
) -> Result<(), Error> {
    for (i, cable) in cables.iter().enumerate().filter(|(_, cable)| cable.has_reel()) {
        cable.check_reel_in_island(|node| is_on_free_body(bodies, pins, i, node), method, dt)?;
    }
    for (i, cable) in cables.iter_mut().enumerate().filter(|(_, cable)| cable.has_reel()) {
        cable.set_riding_stock(|node| is_on_free_body(bodies, pins, i, node));
    }
    Ok(())
}

/// Sets the laws of reels, sheaves and drums for a host step.
pub(super) fn begin(
    unknowns: &mut Unknowns,
    cables: &mut [&mut Cable],
    pins: &[PinConstraint],
    wheels: &Wheels<'_>,
    dt: f64,
) {
    cables.iter_mut().for_each(|cable| cable.begin_reel(dt));
    unknowns.wheels.clear();
    unknowns.wheels.extend(wheels.sheaves.iter().copied().map(Wheel::new));
    unknowns.winches.clear();
    unknowns.winches.extend(wheels.drums.iter().map(|drum| drum.winch(cables, pins)));
}

/// Ends a host step: of one that was made, sheaves keep what they did.
pub(super) fn end(unknowns: &Unknowns, cables: &mut [&mut Cable], wheels: Wheels<'_>, made: bool) {
    cables.iter_mut().for_each(|cable| cable.end_reel(made));
    if made {
        wheels.sheaves.iter_mut().zip(&unknowns.wheels).for_each(|(sheave, wheel)| *sheave = wheel.sheave);
    }
}
