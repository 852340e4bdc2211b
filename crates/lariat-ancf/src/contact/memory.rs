//! What contacts carry from step to step, and what is read of them.

use super::pairs::PairMemory;
use super::patch::Patch;
use crate::cable::Cable;
use crate::error::{Error, require};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A contact at the end of a step: part of the state. Vectors marked so are in the obstacle's axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContactMemory {
    /// Element of the cable.
    pub(in crate::contact) element: u32,
    /// Number of the sample, or of the feature behind the samples.
    pub(in crate::contact) place: u32,
    /// Key of the obstacle.
    pub(in crate::contact) obstacle: u64,
    /// Local coordinate in the element.
    pub(in crate::contact) xi: f64,
    /// Weight in m.
    pub(in crate::contact) weight: f64,
    /// The patch, in the obstacle's axes.
    pub(in crate::contact) patch: Patch,
    /// Outward normal, in the obstacle's axes.
    pub(in crate::contact) normal: Vector3<f64>,
    /// Depth in m, less the offset.
    pub(in crate::contact) depth: f64,
    /// The offset in m.
    #[serde(default)]
    pub(in crate::contact) offset: f64,
    /// Spring of friction in m, in the obstacle's axes.
    pub(in crate::contact) spring: Vector3<f64>,
    /// Normal force in N.
    pub(in crate::contact) force: f64,
    /// Energy in J.
    pub(in crate::contact) energy: f64,
    /// Power in W that friction took in the last step.
    #[serde(default)]
    pub(in crate::contact) friction_power: f64,
    /// Outward normal, world axes.
    pub(in crate::contact) direction: Vector3<f64>,
    /// Friction in N, world axes.
    pub(in crate::contact) friction: Vector3<f64>,
    /// Whether it slips.
    pub(in crate::contact) slips: bool,
    /// Speed in m/s with which the cable came, for its restitution.
    #[serde(default)]
    pub(in crate::contact) came: f64,
}

/// Element, obstacle and place: no two contacts share them.
pub(in crate::contact) type Key = (u32, u64, u32);

impl ContactMemory {
    pub(in crate::contact) fn key(&self) -> Key {
        (self.element, self.obstacle, self.place)
    }

    pub(crate) fn check(&self, elements: usize) -> Result<(), Error> {
        let element = self.element as usize;
        require("element of a contact", element as f64, element < elements, "one of the cable")?;
        let numbers =
            [self.xi, self.weight, self.depth, self.offset, self.force, self.energy, self.friction_power, self.came];
        let vectors = [self.normal, self.spring, self.direction, self.friction];
        let mut all = numbers.into_iter().chain(vectors.iter().flat_map(|v| [v.x, v.y, v.z]));
        all.try_for_each(|x| require("contact", x, true, "a number"))
    }
}

/// Adapts contacts to an element that is split in two: its own are found anew.
pub(crate) fn split_element(contacts: &mut Vec<ContactMemory>, element: usize) {
    contacts.retain(|contact| contact.element as usize != element);
    contacts.iter_mut().filter(|contact| contact.element as usize > element).for_each(|contact| contact.element += 1);
}

/// A contact of a cable with an obstacle, as it was at the end of the last step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Key of the obstacle.
    pub obstacle: u64,
    /// Arc length in m of the point that touches.
    pub arc_length: f64,
    /// Outward normal of the obstacle.
    pub normal: Vector3<f64>,
    /// Normal force in N, > 0: the obstacle pushes the cable along the normal.
    pub normal_force: f64,
    /// Friction on the cable in N.
    pub friction: Vector3<f64>,
    /// Depth in m by which the cable's surface is in the obstacle, offset and all.
    pub depth: f64,
    /// Whether it slips.
    pub slips: bool,
}

impl Cable {
    /// Returns the contacts with obstacles at the end of the last step, by element.
    pub fn contacts(&self) -> impl Iterator<Item = Touch> {
        let (mut element, mut begin) = (0, 0.0);
        self.snapshot.state.memory.contacts.iter().map(move |contact| {
            while element < contact.element as usize {
                begin += self.model.elements[element].length;
                element += 1;
            }
            Touch {
                obstacle: contact.obstacle,
                arc_length: begin + contact.xi * self.model.elements[element].length,
                normal: contact.direction,
                normal_force: contact.force,
                friction: contact.friction,
                depth: contact.depth + contact.offset,
                slips: contact.slips,
            }
        })
    }

    /// Returns the largest radius in m with which it touches; 0 without [`Contact`](crate::Contact).
    pub fn contact_radius(&self) -> f64 {
        let Some(contact) = self.effects().contact else { return 0.0 };
        self.elements().iter().fold(0.0, |most: f64, element| most.max(contact.radius_of(&element.section)))
    }

    /// Returns the energy in J that contacts store.
    pub fn contact_energy(&self) -> f64 {
        let memory = &self.snapshot.state.memory;
        let pairs = memory.pairs.iter().map(PairMemory::energy);
        memory.contacts.iter().map(|contact| contact.energy).chain(pairs).sum()
    }
}
