//! What contacts carry from step to step: part of the [state](super).

use crate::error::{Error, require};
use crate::obstacle::Patch;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A contact at the end of a step: part of the state. Vectors marked so are in the obstacle's axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContactMemory {
    /// Element of the cable.
    pub(crate) element: u32,
    /// Number of the sample, or of the feature behind the samples.
    pub(crate) place: u32,
    /// Key of the obstacle.
    pub(crate) obstacle: u64,
    /// Local coordinate in the element.
    pub(crate) xi: f64,
    /// Weight in m.
    pub(crate) weight: f64,
    /// The patch, in the obstacle's axes.
    pub(crate) patch: Patch,
    /// Outward normal, in the obstacle's axes.
    pub(crate) normal: Vector3<f64>,
    /// Depth in m, less the offset.
    pub(crate) depth: f64,
    /// The offset in m.
    #[serde(default)]
    pub(crate) offset: f64,
    /// Energy in J that others gave when they moved the obstacle against the force, and that
    /// closing the offset has not taken up yet.
    #[serde(default)]
    pub(crate) given: f64,
    /// Spring of friction in m, in the obstacle's axes.
    pub(crate) spring: Vector3<f64>,
    /// Normal force in N.
    pub(crate) force: f64,
    /// Energy in J.
    pub(crate) energy: f64,
    /// Power in W that friction took in the last step.
    #[serde(default)]
    pub(crate) friction_power: f64,
    /// Outward normal, world axes.
    pub(crate) direction: Vector3<f64>,
    /// Friction in N, world axes.
    pub(crate) friction: Vector3<f64>,
    /// Whether it slips.
    pub(crate) slips: bool,
    /// Speed in m/s with which the cable came, for its restitution.
    #[serde(default)]
    pub(crate) came: f64,
    /// Speed in m/s with which came what it stores, 0 if it came slowly.
    #[serde(default)]
    pub(crate) speed: f64,
}

/// Element, obstacle and place: no two contacts share them.
pub(crate) type Key = (u32, u64, u32);

impl ContactMemory {
    pub(crate) fn key(&self) -> Key {
        (self.element, self.obstacle, self.place)
    }

    /// Returns the force on the cable in N, friction and all.
    pub(crate) fn force_on_cable(&self) -> Vector3<f64> {
        self.force * self.direction + self.friction
    }

    pub(crate) fn check(&self, elements: usize) -> Result<(), Error> {
        let element = self.element as usize;
        require("element of a contact", element as f64, element < elements, "one of the cable")?;
        let numbers = [
            self.xi,
            self.weight,
            self.depth,
            self.offset,
            self.given,
            self.force,
            self.energy,
            self.friction_power,
            self.came,
            self.speed,
        ];
        let vectors = [self.normal, self.spring, self.direction, self.friction];
        let mut all = numbers.into_iter().chain(vectors.iter().flat_map(|v| [v.x, v.y, v.z]));
        all.try_for_each(|x| require("contact", x, true, "a number"))
    }
}

/// A contact with a cable at the end of a step: part of the state of the cable with the lower key.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PairMemory {
    /// The contact: vectors in world axes; its obstacle is the key of the other cable.
    pub(crate) contact: ContactMemory,
    /// Arc lengths in m along this cable and the other one.
    pub(crate) arcs: [f64; 2],
    /// Lengths in m that had come through the eye of a reel at the start of each: arc lengths of
    /// all material have grown by them.
    #[serde(default)]
    pub(crate) passed: [f64; 2],
}

impl PairMemory {
    /// Returns how far in m along both cables it is from arc lengths of material.
    pub(crate) fn apart(&self, arcs: [f64; 2]) -> f64 {
        [0, 1].map(|k| (self.arcs[k] - self.passed[k] - arcs[k]).abs()).iter().sum()
    }

    /// Returns the energy in J that it stores.
    pub(crate) fn energy(&self) -> f64 {
        self.contact.energy
    }

    pub(crate) fn check(&self, elements: usize) -> Result<(), Error> {
        self.contact.check(elements)?;
        self.arcs
            .into_iter()
            .chain(self.passed)
            .try_for_each(|x| require("arc length of a contact", x, true, "a number"))
    }
}

/// Gives the elements of contacts, which are found in their memory by `contact`, other numbers.
/// Contacts whose element has none are found anew; returns the energy in J that those held.
pub(crate) fn renumber<T>(
    list: &mut Vec<T>,
    contact: impl Fn(&mut T) -> &mut ContactMemory,
    number: impl Fn(usize) -> Option<usize>,
) -> f64 {
    let mut lost = 0.0;
    list.retain_mut(|own| {
        let contact = contact(own);
        let new = number(contact.element as usize);
        match new {
            Some(element) => contact.element = element as u32,
            None => lost += contact.energy,
        }
        new.is_some()
    });
    lost
}
