//! Sheaves and drums of an island, and what cables and bodies must be for them.

mod drum;
mod sheave;

use super::body::RigidBody;
use super::pin::PinConstraint;
use crate::cable::Cable;
use crate::error::Error;
use crate::system::{Unknowns, Wheel};

pub use crate::system::Sheave;
pub use drum::Drum;

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

/// Sets the laws of sheaves and drums for a host step.
pub(super) fn begin(
    unknowns: &mut Unknowns,
    cables: &[&mut Cable],
    pins: &[PinConstraint],
    (sheaves, drums): (&[Sheave], &[Drum]),
) {
    unknowns.wheels.clear();
    unknowns.wheels.extend(sheaves.iter().copied().map(Wheel::new));
    unknowns.winches.clear();
    unknowns.winches.extend(drums.iter().map(|drum| drum.winch(cables, pins)));
}
