//! Sheaves: one cable runs into another where both are attached.

use crate::handle::CableHandle;
use lariat_ancf::At;
use lariat_ancf::island::Sheave as Wheel;
use serde::{Deserialize, Serialize};

/// A sheave: inertia, friction, brake.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SheaveOptions {
    /// Inertia of the wheel over the square of its radius in kg. Default 0.
    pub inertia: f64,
    /// Coefficient of friction of the rope on the wheel: tensions differ by up to exp(friction
    /// angle). Default 0.
    pub friction: f64,
    /// Angle in rad beyond that between the directions of both cables, by which the rope is wound
    /// around the wheel. Default 0.
    pub turns: f64,
    /// Constant friction in N. Default 0.
    pub brake: f64,
    /// Radius of the wheel in m: both ends are within it of one centre, as points of one body.
    /// Default 0, where they are one point.
    pub radius: f64,
    /// Length in m on the wheel, where both cables are parts of one: a reel of it counts both, and
    /// what is on the wheel, as out. Default: they are two cables.
    pub along: Option<f64>,
}

/// A sheave of a [`CableSet`](crate::CableSet), and what it did so far.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Sheave {
    /// Cables, and whether they are there with their start: material runs from the first to the
    /// second at positive rates.
    pub(crate) ends: [(CableHandle, bool); 2],
    /// The mechanics, with the indices of another set of cables.
    pub(crate) wheel: Wheel,
    /// Length in m on the wheel where both are parts of one cable.
    #[serde(default)]
    pub(crate) along: Option<f64>,
}

/// Returns the end of a cable.
fn end(start: bool) -> At {
    if start { At::Start } else { At::End }
}

impl Sheave {
    /// Returns the cables and their ends there; material runs from the first to the second at
    /// positive rates.
    pub fn ends(&self) -> [(CableHandle, At); 2] {
        self.ends.map(|(cable, start)| (cable, end(start)))
    }

    /// Returns whether both ends are [parts of one cable](crate::CableSet::add_sheave_at).
    pub fn is_along_a_cable(&self) -> bool {
        self.along.is_some()
    }

    /// Returns the length in m that ran over it so far.
    pub fn passed(&self) -> f64 {
        self.wheel.passed
    }

    /// Returns the energy in J that friction took so far.
    pub fn lost(&self) -> f64 {
        self.wheel.lost
    }

    /// Returns the friction in N in the last step: what the pull on one side exceeds that on the
    /// other by, but for inertia.
    pub fn force(&self) -> f64 {
        self.wheel.force
    }

    /// Returns the sheave for an island with these cables; `None` if it has not both.
    pub(crate) fn within(&self, cables: &[usize]) -> Option<Wheel> {
        let [from, to] = self
            .ends
            .map(|(cable, start)| cables.iter().position(|&c| c == cable.0 as usize).map(|index| (index, start)));
        Some(Wheel { from: from?, to: to?, ..self.wheel })
    }
}
