//! Checks of sheaves: one cable runs into another at a point that both are held at.
//!
//! Cable ends at a sheave have a [reel over a sheave](crate::Reel::over_sheave), and are held at
//! one point: by pins to one body, or by supports. Equation, validity and alternatives:
//! `system/reel/wheel.rs`.

use crate::cable::Cable;
use crate::error::{Error, require};
use crate::reel::Feed;
use crate::scales::SAME;
use crate::scales::reel::GAP;
use crate::system::Sheave;

impl Sheave {
    /// Checks its numbers.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for one that is negative, or is none.
    pub fn check(&self) -> Result<(), Error> {
        let numbers = [
            ("inertia of a sheave (kg)", self.inertia),
            ("friction of a sheave", self.friction),
            ("turns of a sheave (rad)", self.turns),
            ("brake of a sheave (N)", self.brake),
            ("radius of a sheave (m)", self.radius),
        ];
        numbers.into_iter().try_for_each(|(what, value)| require(what, value, value >= 0.0, ">= 0"))
    }
}

/// Checks that sheaves fit the cables of an island, and that each end at a sheave has one.
pub(super) fn check(cables: &[&mut Cable], sheaves: &[Sheave]) -> Result<(), Error> {
    let refused = |cable: &Cable, reason| Err(Error::ReelPlace { cable: cable.name().to_string(), reason });
    for (i, sheave) in sheaves.iter().enumerate() {
        let ends = sheave.ends();
        for (cable, _) in ends {
            if cable >= cables.len() {
                return Err(Error::NotInIsland { pin: i, what: "cables", index: cable, count: cables.len() });
            }
        }
        let [a, b] = ends.map(|(cable, _)| &cables[cable]);
        sheave.check().map_err(|e| e.of_cable(a.name()))?;
        let ends_of = |other: &Sheave| other.ends();
        let taken = sheaves[..i].iter().flat_map(ends_of).any(|end| ends.contains(&end));
        if taken || ends[0] == ends[1] {
            return refused(a, "an end of a cable is at one sheave");
        }
        for (cable, side) in ends {
            if cables[cable].model.reels.get(side).is_none_or(|reel| reel.feed != Feed::Sheave) {
                return refused(cables[cable], "its end at a sheave has no Reel::over_sheave");
            }
        }
        let [p, q] = ends.map(|(cable, side)| cables[cable].node_position(side.nodes(cables[cable].nodes())[1]));
        if (p - q).norm() > GAP + 2.0 * sheave.radius {
            return refused(a, "the two ends at a sheave are not at one point");
        }
        // what passes takes the section of the other side
        let [of_a, of_b] = ends.map(|(cable, side)| {
            let model = &cables[cable].model;
            let element = &model.elements[side.element(model.elements.len())];
            [model.inertia(element), element.section.axial_stiffness, element.section.bending_stiffness]
        });
        if of_a.iter().zip(of_b).any(|(m, n)| (m - n).abs() > SAME * m) {
            return refused(b, "a sheave joins cables of one mass per length, EA and EI");
        }
    }
    for (c, cable) in cables.iter().enumerate() {
        let mut over_sheaves = cable
            .model
            .reels
            .sides()
            .filter(|&side| cable.model.reels.get(side).is_some_and(|reel| reel.feed == Feed::Sheave));
        if over_sheaves.any(|side| !sheaves.iter().any(|sheave| sheave.ends().contains(&(c, side)))) {
            return refused(cable, "its end is at a sheave, which this island does not have");
        }
    }
    Ok(())
}
