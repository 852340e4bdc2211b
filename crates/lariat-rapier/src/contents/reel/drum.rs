//! Drums: bodies whose spin pays cable out and takes it in.

use crate::convert::vector;
use crate::handle::CableHandle;
use ::nalgebra::Vector3;
use lariat_ancf::At;
use lariat_ancf::island::Drum as Winch;
use rapier::dynamics::RigidBodyHandle;
use rapier::math::{Real, Vector};
use serde::{Deserialize, Serialize};

/// A body that turns as the end of a cable runs, which feels its pull: torque or a motor on its
/// joint hoist a load, and without one it runs free. The body turns about an axis through its
/// centre of mass: by an impulse joint to a fixed or kinematic body, or with its other axes locked.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drum {
    /// The dynamic body.
    pub body: RigidBodyHandle,
    /// Axis in its frame, of any length: positive spin about it pays out.
    pub axis: Vector,
    /// Radius in m at which the cable leaves.
    pub radius: Real,
}

impl Drum {
    /// Returns it for an island, with a cable, whether by its start, and a body at their indices.
    pub(crate) fn winch(&self, cable: (usize, bool), body: usize) -> Winch {
        let axis = vector(self.axis).try_normalize(0.0).unwrap_or_else(Vector3::zeros);
        Winch { cable, body, axis, radius: f64::from(self.radius) }
    }
}

/// A drum, and the end of the cable on it.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Wound {
    pub cable: CableHandle,
    /// Whether that end is its start.
    pub start: bool,
    pub drum: Drum,
}

impl Wound {
    /// Returns the end.
    pub fn at(&self) -> At {
        if self.start { At::Start } else { At::End }
    }

    /// Returns it for an island with these cables and, at an index, its body.
    pub fn within(&self, cables: &[usize], body: usize) -> Option<Winch> {
        let cable = cables.iter().position(|&c| c == self.cable.0 as usize)?;
        Some(self.drum.winch((cable, self.start), body))
    }
}
