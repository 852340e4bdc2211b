//! What a [wheel](super::wheel) is and did, as its user has it.

use crate::at::At;
use crate::element::side::Side;
use serde::{Deserialize, Serialize};

/// A wheel without extent at one point, over which one cable runs into another, and what it did so
/// far. Plain data: a snapshot of an island has its sheaves beside its cables and bodies.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sheave {
    /// Index in the island of the cable from which material runs at positive rates, and its end:
    /// the start if true.
    pub from: (usize, bool),
    /// The same of the cable into which it runs.
    pub to: (usize, bool),
    /// Inertia of the wheel over the square of its radius in kg. Default 0.
    pub inertia: f64,
    /// Coefficient of friction of the rope on the wheel: tensions differ by up to exp(mu theta).
    /// Default 0.
    pub friction: f64,
    /// Angle in rad beyond that between the directions of both cables, at most half a turn, by
    /// which the rope is wound around the wheel. Default 0.
    pub turns: f64,
    /// Constant friction in N. Default 0.
    pub brake: f64,
    /// Radius of the wheel in m: the ends may be as far apart as two points of its rim are.
    /// Default 0.
    #[serde(default)]
    pub radius: f64,
    /// Length in m that ran over it so far.
    pub passed: f64,
    /// Energy in J that friction took so far.
    pub lost: f64,
    /// Friction in N in the last step.
    pub force: f64,
}

impl Sheave {
    /// A sheave without inertia and friction, between an end of a cable, given by its index in the
    /// island, and one of another. Ends other than [`At::Start`] count as [`At::End`].
    pub fn new(from: (usize, At), to: (usize, At)) -> Self {
        let end = |(cable, at): (usize, At)| (cable, at == At::Start);
        Sheave {
            from: end(from),
            to: end(to),
            inertia: 0.0,
            friction: 0.0,
            turns: 0.0,
            brake: 0.0,
            radius: 0.0,
            passed: 0.0,
            lost: 0.0,
            force: 0.0,
        }
    }

    /// Returns cables and ends, from which and to which material runs at positive rates.
    pub(crate) fn ends(&self) -> [(usize, Side); 2] {
        [self.from, self.to].map(|(cable, start)| (cable, if start { Side::Start } else { Side::End }))
    }
}
