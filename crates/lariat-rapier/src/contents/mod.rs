//! The contents of a set: cables, attachments, junctions and records of bodies.
//!
//! | file | what it describes |
//! |---|---|
//! | [`attachment`], [`gaps`] | a node attached to a body, and the gap between them so far |
//! | [`junction`] | nodes that share one position |
//! | [`reel`] | what a cable runs over, and what it is wound on |
//! | [`rules`] | what a cable may touch, and with which friction |
//! | [`mark`] | the mark that a set leaves in its world |
//! | [`table`] | a list whose indices stay |

pub(crate) mod attachment;
pub(crate) mod gaps;
pub(crate) mod junction;
pub(crate) mod mark;
pub(crate) mod reel;
pub(crate) mod rules;
pub(crate) mod table;

use crate::body::record::Records;
use crate::convert;
use crate::error::Error;
use crate::handle::{AttachmentHandle, CableHandle, JunctionHandle};
use crate::water::BodiesInWater;
use attachment::Attachment;
use junction::Junction;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::seal::Checksum;
use lariat_ancf::{At, Cable};
use mark::WorldMark;
use rapier::dynamics::RigidBodyHandle;
use rapier::math::Vector;
use rapier::pipeline::PhysicsWorld;
use reel::Wheels;
use rules::ContactRules;
use serde::{Deserialize, Serialize};
use table::Table;

/// A cable in its set.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Slot {
    pub cable: Cable,
    pub asleep: bool,
    /// Whether the user had access to the cable since the last step.
    pub modified: bool,
    /// Whether its gravity is the world's, and its gravity in m/s^2 when the set last looked.
    pub follows_gravity: bool,
    pub gravity: ::nalgebra::Vector3<f64>,
    /// Positions of both ends and the length when it was inserted, in m.
    pub sort_key: [f64; 7],
    /// Whether its load was compared with its strength since that was set.
    #[serde(default)]
    pub compared: bool,
    /// Whether it was told what is wrong with how it begins.
    #[serde(default)]
    pub introduced: bool,
    /// What it may touch.
    #[serde(default)]
    pub rules: ContactRules,
    /// Keys of the colliders that it touched at the end of the last host step, and where.
    #[serde(default)]
    pub touched: Vec<(u64, f64)>,
    /// Keys of the colliders in which it was found although it cannot touch them, or of whose
    /// restitution it was told.
    #[serde(default)]
    pub ignored: Vec<u64>,
    /// Whether neither dynamic bodies nor other cables acted on it in the last host step, so that
    /// its energy balance closes.
    #[serde(skip)]
    pub alone: bool,
    /// Whether it is off an anchor by more than the limit.
    #[serde(skip)]
    pub parted: bool,
    /// By how much what holds it was rounded in the last host step, in m.
    #[serde(skip)]
    pub rounding: f64,
    /// Whether its island took its last step by the discrete gradient.
    #[serde(skip)]
    pub by_law: Option<bool>,
}

impl Slot {
    /// Compares two cables by name, then by their positions when they were inserted.
    pub fn order(&self, other: &Slot) -> core::cmp::Ordering {
        let keys = self.sort_key.iter().zip(&other.sort_key);
        let by_position = keys.fold(core::cmp::Ordering::Equal, |o, (a, b)| o.then(a.total_cmp(b)));
        self.cable.name().cmp(other.cable.name()).then(by_position)
    }
}

/// The contents of a set: all of its state.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Contents {
    pub cables: Table<Slot>,
    pub attachments: Table<Attachment>,
    pub junctions: Table<Junction>,
    #[serde(default)]
    pub wheels: Wheels,
    pub records: Records,
    /// The water that bodies are in.
    #[serde(default)]
    pub water: Option<Box<BodiesInWater>>,
    /// The mark of the world that the attachments belong to.
    #[serde(default)]
    pub mark: Option<WorldMark>,
    /// The world's gravity when it was last copied to the cables.
    gravity: Option<Vector>,
    /// Number of colliders in Rapier's tree, all of them after each of its steps; `None` before the
    /// first one.
    #[serde(default)]
    pub listed: Option<usize>,
    /// Whether cables, attachments or junctions changed since islands were last found.
    #[serde(skip)]
    pub changed: bool,
}

impl Contents {
    /// Returns the bodies of attachments and drums, some of them more than once.
    pub fn held_bodies(&self) -> impl Iterator<Item = RigidBodyHandle> {
        self.attachments.values().map(|a| a.body).chain(self.wheels.bodies().map(|(_, body)| body))
    }

    /// Adds a cable; its clock is set to that of the others, or of the water.
    pub fn insert(&mut self, mut cable: Cable) -> CableHandle {
        if let Some(other) = self.cables.values().next() {
            // the time of a cable is always finite, so this cannot fail
            let _ = cable.set_time(other.cable.time());
        } else if let Some(water) = &self.water {
            let _ = cable.set_time(water.time());
        }
        let (start, end) = (cable.node_position(0), cable.node_position(cable.nodes() - 1));
        let sort_key = [start.x, start.y, start.z, end.x, end.y, end.z, cable.length()];
        let gravity = cable.gravity();
        let follows_gravity = gravity == lariat_ancf::STANDARD_GRAVITY;
        let mut slot = Slot {
            asleep: false,
            modified: true,
            follows_gravity,
            gravity,
            sort_key,
            compared: false,
            introduced: false,
            rules: ContactRules::default(),
            touched: Vec::new(),
            ignored: Vec::new(),
            alone: false,
            parted: false,
            rounding: 0.0,
            cable,
            by_law: None,
        };
        let key = self.free_key(&slot);
        slot.cable.set_contact_key(key);
        let index = self.cables.push(slot);
        self.changed = true;
        self.gravity = None;
        CableHandle(index as u32)
    }

    /// Returns a key by which other cables remember a new one: by its name and place, so that it
    /// does not depend on the order of insertion.
    fn free_key(&self, slot: &Slot) -> u64 {
        let mut sum = Checksum::of(slot.cable.name().as_bytes());
        slot.sort_key.iter().for_each(|x| sum.add(&x.to_bits().to_le_bytes()));
        // 0 stands for no key
        let mut key = sum.value().max(1);
        while self.cables.values().any(|other| other.cable.contact_key() == key) {
            key = key.wrapping_add(1).max(1);
        }
        key
    }

    /// Returns the slot of a cable.
    pub fn slot(&self, cable: CableHandle) -> Option<&Slot> {
        self.cables.get(cable.0 as usize)
    }

    /// Returns a cable.
    pub fn cable(&self, cable: CableHandle) -> Result<&Cable, Error> {
        self.slot(cable).map(|s| &s.cable).ok_or(Error::NoCable(cable))
    }

    /// Returns whether a point of a cable is its start, named as such, as a node or by its arc
    /// length.
    pub fn is_start(&self, cable: CableHandle, at: At) -> Result<bool, Error> {
        Ok(self.cable(cable)?.arc_length(at).is_ok_and(|s| s == 0.0))
    }

    /// Returns a cable, to change it, and marks it as modified.
    pub fn cable_mut(&mut self, cable: CableHandle) -> Result<&mut Cable, Error> {
        let slot = self.cables.get_mut(cable.0 as usize).ok_or(Error::NoCable(cable))?;
        slot.modified = true;
        Ok(&mut slot.cable)
    }

    /// Returns an attachment.
    pub fn attachment(&self, attachment: AttachmentHandle) -> Result<&Attachment, Error> {
        self.attachments.get(attachment.0 as usize).ok_or(Error::NoAttachment(attachment))
    }

    /// Returns a junction.
    pub fn junction(&self, junction: JunctionHandle) -> Result<&Junction, Error> {
        self.junctions.get(junction.0 as usize).ok_or(Error::NoJunction(junction))
    }

    /// Calls `act` with each of the cables at `indices` and its place among them, in that order.
    pub fn for_cables(&mut self, indices: &[usize], mut act: impl FnMut(usize, &mut Cable)) {
        for (place, &index) in indices.iter().enumerate() {
            if let Some(slot) = self.cables.get_mut(index) {
                act(place, &mut slot.cable);
            }
        }
    }

    /// Sets the clocks of the cables of an island to the latest of them: one that could not step
    /// for a while may since have been attached to others.
    pub fn align_clocks(&mut self, indices: &[usize]) -> Result<(), Error> {
        let times = indices.iter().filter_map(|&i| self.cables.get(i)).map(|slot| slot.cable.time());
        let latest = times.fold(f64::NEG_INFINITY, f64::max);
        for &i in indices {
            if let Some(slot) = self.cables.get_mut(i).filter(|slot| slot.cable.time() < latest) {
                slot.cable.set_time(latest)?;
            }
        }
        Ok(())
    }

    /// Copies the world's gravity to the cables that follow it when it changed, unless theirs is
    /// equal to it within Rapier's rounding.
    pub fn follow_gravity(&mut self, world: &PhysicsWorld) -> Result<(), Error> {
        if self.gravity == Some(world.gravity) {
            return Ok(());
        }
        for slot in self.cables.values_mut() {
            // a cable whose gravity was set by the user no longer follows the world's
            slot.follows_gravity &= slot.gravity == slot.cable.gravity();
            if slot.follows_gravity && convert::to_vector(&slot.cable.gravity()) != world.gravity {
                slot.cable.set_gravity(convert::vector(world.gravity))?;
                slot.modified = true;
            }
            slot.gravity = slot.cable.gravity();
        }
        self.gravity = Some(world.gravity);
        Ok(())
    }
}
