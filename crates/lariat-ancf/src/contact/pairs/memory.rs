//! What contacts between cables carry from step to step, and what is read of them.

use super::super::memory::ContactMemory;
use crate::cable::Cable;
use crate::error::{Error, require};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A contact with a cable at the end of a step: part of the state of the cable with the lower key.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PairMemory {
    /// The contact: vectors in world axes; its obstacle is the key of the other cable.
    pub(super) contact: ContactMemory,
    /// Arc lengths in m along this cable and the other one.
    pub(super) arcs: [f64; 2],
}

impl PairMemory {
    /// Returns the energy in J that it stores.
    pub(in crate::contact) fn energy(&self) -> f64 {
        self.contact.energy
    }

    pub(crate) fn check(&self, elements: usize) -> Result<(), Error> {
        self.contact.check(elements)?;
        self.arcs.into_iter().try_for_each(|x| require("arc length of a contact", x, true, "a number"))
    }
}

/// A contact of a cable with a cable, or with itself, as it was at the end of the last step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairTouch {
    /// [Key](Cable::set_contact_key) of the other cable.
    pub other: u64,
    /// Arc length in m of the point that touches.
    pub arc_length: f64,
    /// Arc length in m along the other cable.
    pub other_arc_length: f64,
    /// Unit normal, from the other cable to this one.
    pub normal: Vector3<f64>,
    /// Normal force in N, > 0.
    pub normal_force: f64,
    /// Friction on this cable in N.
    pub friction: Vector3<f64>,
    /// Depth in m by which the surfaces are in each other.
    pub depth: f64,
    /// Whether it slips.
    pub slips: bool,
}

impl PairTouch {
    /// Returns it as the other cable has it; `key` is that of this one.
    pub fn mirrored(self, key: u64) -> Self {
        PairTouch {
            other: key,
            arc_length: self.other_arc_length,
            other_arc_length: self.arc_length,
            normal: -self.normal,
            friction: -self.friction,
            ..self
        }
    }
}

impl Cable {
    /// Returns the contacts with other cables and with itself at the end of the last step. A contact of two cables is with the one of the lower key.
    pub fn cable_contacts(&self) -> impl Iterator<Item = PairTouch> {
        self.snapshot.state.memory.pairs.iter().map(|PairMemory { contact, arcs }| PairTouch {
            other: contact.obstacle,
            arc_length: arcs[0],
            other_arc_length: arcs[1],
            normal: contact.direction,
            normal_force: contact.force,
            friction: contact.friction,
            depth: contact.depth + contact.offset,
            slips: contact.slips,
        })
    }

    /// Returns the key by which other cables remember their contacts with this one.
    pub fn contact_key(&self) -> u64 {
        self.model.contact_key
    }

    /// Sets the key by which other cables remember their contacts with this one, unique among cables that can touch. Default: 0, which stands for
    /// the place of the cable in its island.
    pub fn set_contact_key(&mut self, key: u64) {
        self.model.contact_key = key;
    }
}
