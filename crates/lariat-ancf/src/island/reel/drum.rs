//! Drums that are bodies of an island.
//!
//! Equation, validity and alternatives: `system/reel/drum.rs`.

use super::super::body::RigidBody;
use super::super::pin::PinConstraint;
use crate::cable::Cable;
use crate::element::side::Side;
use crate::error::{Error, require};
use crate::reel::Feed;
use crate::system::Winch;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A body that turns as the end of a cable runs: the rate of the [reel on it](crate::Reel::on_drum)
/// is its spin about the axis times the radius, relative to the body that holds the eye or to the
/// world, and the torque of the pull acts on both.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drum {
    /// Index in the island of the cable, and its end: the start if true.
    pub cable: (usize, bool),
    /// Index of the body.
    pub body: usize,
    /// Axis, of length 1, in the axes of the body: positive spin pays out.
    pub axis: Vector3<f64>,
    /// Radius in m at which the cable leaves.
    pub radius: f64,
}

impl Drum {
    /// Returns cable and end.
    fn end(&self) -> (usize, Side) {
        (self.cable.0, if self.cable.1 { Side::Start } else { Side::End })
    }

    /// Returns the body that holds the eye.
    fn holder(&self, cables: &[&mut Cable], pins: &[PinConstraint]) -> Option<usize> {
        let (cable, side) = self.end();
        let eye = side.nodes(cables[cable].nodes())[1];
        pins.iter().find(|pin| pin.cable == cable && pin.node == eye).map(|pin| pin.body)
    }

    /// Returns whether it, or what holds the eye, can turn.
    pub(in crate::island) fn can_turn(
        &self,
        cables: &[&mut Cable],
        bodies: &[RigidBody],
        pins: &[PinConstraint],
    ) -> bool {
        let turns = |body: usize| bodies[body].free[3..].contains(&true);
        turns(self.body) || self.holder(cables, pins).is_some_and(turns)
    }

    /// Returns it for a step.
    pub(super) fn winch(&self, cables: &[&mut Cable], pins: &[PinConstraint]) -> Winch {
        let (cable, side) = self.end();
        let pull = cables[cable].snapshot.windings[side as usize].and_then(|winding| winding.pull);
        let bodies = [Some(self.body), self.holder(cables, pins)];
        Winch::new((cable, side), bodies, self.axis, self.radius, pull.unwrap_or(0.0))
    }

    /// Checks its numbers.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a radius that is not positive, and for an axis that is no
    /// direction.
    pub fn check(&self) -> Result<(), Error> {
        let length = self.axis.norm();
        require("radius of a drum (m)", self.radius, self.radius > 0.0, "> 0")?;
        require("length of the axis of a drum", length, length > 0.0, "> 0")?;
        require("length of the axis of a drum", length, (length - 1.0).abs() < 1e-6, "1")
    }
}

/// Checks that drums fit the cables and bodies of an island, and that each end on a drum has one.
pub(super) fn check(
    cables: &[&mut Cable],
    bodies: &[RigidBody],
    pins: &[PinConstraint],
    drums: &[Drum],
) -> Result<(), Error> {
    let refused = |cable: &Cable, reason| Err(Error::ReelPlace { cable: cable.name().to_string(), reason });
    for (i, drum) in drums.iter().enumerate() {
        let (cable, side) = drum.end();
        for (what, index, count) in [("cables", cable, cables.len()), ("bodies", drum.body, bodies.len())] {
            if index >= count {
                return Err(Error::NotInIsland { pin: i, what, index, count });
            }
        }
        let own = &cables[cable];
        drum.check().map_err(|e| e.of_cable(own.name()))?;
        if own.model.reels.get(side).is_none_or(|reel| reel.feed != Feed::BodyDrum) {
            return refused(own, "its end on a drum has no Reel::on_drum");
        }
        if drums[..i].iter().any(|other| other.cable == drum.cable) {
            return refused(own, "an end of a cable is on one drum");
        }
        if drum.holder(cables, pins) == Some(drum.body) {
            return refused(own, "the drum holds its eye: attach the eye to what the drum turns in");
        }
    }
    for (c, cable) in cables.iter().enumerate() {
        let on_drum = |side: &Side| cable.model.reels.get(*side).is_some_and(|reel| reel.feed == Feed::BodyDrum);
        if Side::BOTH.iter().filter(|side| on_drum(side)).any(|side| !drums.iter().any(|d| d.end() == (c, *side))) {
            return refused(cable, "its end is on a drum, which this island does not have");
        }
    }
    Ok(())
}
