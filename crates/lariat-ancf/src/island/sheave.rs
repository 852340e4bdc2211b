//! Sheaves: one cable runs into another at a point that both are held at.
//!
//! Cable ends at a sheave have a [reel over a sheave](crate::Reel::over_sheave), and are held at one point: by pins to one body, or by
//! supports. Equation, validity and alternatives: `system/flow/wheel.rs`.

use crate::cable::{At, Cable, Feed};
use crate::element::side::Side;
use crate::error::{Error, require};
use crate::system::Wheel;
use serde::{Deserialize, Serialize};

/// Largest distance in m between the two ends at a sheave.
const GAP: f64 = 1e-3;
/// Share by which the masses per length may differ.
const SAME: f64 = 1e-9;

/// A wheel without extent at one point, over which one cable runs into another, and what it did so far. Plain data: a snapshot of an
/// island has its sheaves beside its cables and bodies.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sheave {
    /// Index in the island of the cable from which material runs at positive rates, and its end: the start if true.
    pub from: (usize, bool),
    /// The same of the cable into which it runs.
    pub to: (usize, bool),
    /// Inertia of the wheel over the square of its radius in kg. Default 0.
    pub inertia: f64,
    /// Coefficient of friction of the rope on the wheel: tensions differ by up to exp(mu theta). Default 0.
    pub friction: f64,
    /// Angle in rad beyond that between the directions of both cables, at most half a turn, by which the rope is wound around the wheel.
    /// Default 0.
    pub turns: f64,
    /// Constant friction in N. Default 0.
    pub brake: f64,
    /// Length in m that ran over it so far.
    pub passed: f64,
    /// Energy in J that friction took so far.
    pub lost: f64,
    /// Friction in N in the last step.
    pub force: f64,
}

impl Sheave {
    /// A sheave without inertia and friction, between an end of a cable, given by its index in the island, and one of another.
    /// Ends other than [`At::Start`] count as [`At::End`].
    pub fn new(from: (usize, At), to: (usize, At)) -> Self {
        let end = |(cable, at): (usize, At)| (cable, at == At::Start);
        Sheave {
            from: end(from),
            to: end(to),
            inertia: 0.0,
            friction: 0.0,
            turns: 0.0,
            brake: 0.0,
            passed: 0.0,
            lost: 0.0,
            force: 0.0,
        }
    }

    fn ends(&self) -> [(usize, Side); 2] {
        [self.from, self.to].map(|(cable, start)| (cable, if start { Side::Start } else { Side::End }))
    }

    /// Returns the sheave as a step has it.
    pub(super) fn wheel(&self) -> Wheel {
        let mut wheel = Wheel::new(self.ends());
        (wheel.inertia, wheel.friction, wheel.turns, wheel.brake) =
            (self.inertia, self.friction, self.turns, self.brake);
        (wheel.passed, wheel.lost, wheel.force) = (self.passed, self.lost, self.force);
        wheel
    }

    /// Takes over what a step did.
    pub(super) fn follow(&mut self, wheel: &Wheel) {
        (self.passed, self.lost, self.force) = (wheel.passed, wheel.lost, wheel.force);
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
        for (what, value) in [
            ("inertia of a sheave (kg)", sheave.inertia),
            ("friction of a sheave", sheave.friction),
            ("turns of a sheave (rad)", sheave.turns),
            ("brake of a sheave (N)", sheave.brake),
        ] {
            require(what, value, value >= 0.0, ">= 0").map_err(|e| e.of_cable(a.name()))?;
        }
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
        if (p - q).norm() > GAP {
            return refused(a, "the two ends at a sheave are not at one point");
        }
        let [m, n] = ends.map(|(cable, side)| {
            let model = &cables[cable].model;
            model.inertia(&model.elements[side.element(model.elements.len())])
        });
        if (m - n).abs() > SAME * m {
            return refused(b, "a sheave joins cables of one mass per length");
        }
    }
    for (c, cable) in cables.iter().enumerate() {
        let mut over_sheaves = cable.model.reels.sides().filter(|&side| cable.is_over_sheave(side));
        if over_sheaves.any(|side| !sheaves.iter().any(|sheave| sheave.ends().contains(&(c, side)))) {
            return refused(cable, "its end is at a sheave, which this island does not have");
        }
    }
    Ok(())
}
