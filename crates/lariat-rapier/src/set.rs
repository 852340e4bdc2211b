//! The set of cables of a world.

use crate::attachment::{Attachment, AttachmentHandle};
use crate::body::Remembered;
use crate::event::Event;
use crate::islands::{Held, IslandStep};
use crate::junction::{Junction, JunctionHandle};
use crate::{Error, convert};
use lariat_ancf::Cable;
use lariat_ancf::island::Island;
use rapier::dynamics::RigidBodyHandle;
use rapier::math::Vector;
use rapier::pipeline::PhysicsWorld;
use serde::{Deserialize, Serialize};

/// Names a cable of a [`CableSet`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct CableHandle(pub(crate) u32);

/// How a set steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// Rapier steps per host step, at least. Default 4: as accurate in free flight as one, and far better in contact.
    pub rapier_steps: u32,
    /// Rapier steps per host step at most: where a light body near others hangs on a stiff, taut cable, `rapier_steps` are too few, and
    /// as many are taken as the body's vibration on its cables needs. Default 32; `rapier_steps` or less: never more than those.
    #[serde(default = "most_rapier_steps")]
    pub most_rapier_steps: u32,
    /// Cables and bodies on them that are slower than this, in m/s, may sleep, if their forces are steady. Default 2e-3; 0: never.
    pub sleep_speed: f64,
}

fn most_rapier_steps() -> u32 {
    32
}

impl Default for Settings {
    fn default() -> Self {
        Settings { rapier_steps: 4, most_rapier_steps: most_rapier_steps(), sleep_speed: 2e-3 }
    }
}

/// A cable in its set.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Slot {
    pub cable: Cable,
    pub asleep: bool,
    /// Touched by the user since the last step.
    pub stirred: bool,
    /// Whether its gravity is the world's, and what it was when the set last looked, in m/s^2.
    pub falls: bool,
    pub gravity: ::nalgebra::Vector3<f64>,
    /// Where the ends were when it was inserted, and its length, in m.
    pub first: [f64; 7],
}

/// Cables and what they hold to. Serialises with its state; a snapshot of (world, set) replays bitwise.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct CableSet {
    /// How the set steps.
    pub settings: Settings,
    pub(crate) cables: Vec<Option<Box<Slot>>>,
    pub(crate) attachments: Vec<Option<Attachment>>,
    pub(crate) junctions: Vec<Option<Junction>>,
    /// Ascending by handle.
    pub(crate) memory: Vec<Remembered>,
    pub(crate) gravity: Option<Vector>,
    /// Whether islands must be found anew.
    #[serde(skip)]
    pub(crate) stale: bool,
    /// Whether a prediction waits to be reconciled.
    #[serde(skip)]
    pub(crate) pending: bool,
    #[serde(skip)]
    pub(crate) held: Vec<Held>,
    #[serde(skip)]
    pub(crate) islands: Vec<IslandStep>,
    #[serde(skip)]
    pub(crate) solver: Island,
    #[serde(skip)]
    pub(crate) events: Vec<Event>,
    #[serde(skip)]
    pub(crate) refused: Vec<CableHandle>,
}

impl CableSet {
    /// An empty set.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a cable; its clock is set to that of the others. If its gravity is the builder's default, it follows the world's until the user
    /// sets it; else it keeps its own.
    pub fn insert(&mut self, mut cable: Cable) -> CableHandle {
        if let Some(other) = self.cables.iter().flatten().next() {
            // the time of a cable is always a number
            let _ = cable.set_time(other.cable.time());
        }
        let (start, end) = (cable.node_position(0), cable.node_position(cable.nodes() - 1));
        let first = [start.x, start.y, start.z, end.x, end.y, end.z, cable.length()];
        let falls = cable.gravity() == lariat_ancf::STANDARD_GRAVITY;
        let gravity = cable.gravity();
        self.cables.push(Some(Box::new(Slot { asleep: false, stirred: true, falls, gravity, first, cable })));
        self.stale = true;
        self.gravity = None;
        CableHandle(self.cables.len() as u32 - 1)
    }

    /// Removes a cable, its attachments and its part in junctions.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn remove(&mut self, world: &mut PhysicsWorld, cable: CableHandle) -> Result<Cable, Error> {
        self.get(cable)?;
        self.let_go(world, cable)?;
        let slot = self.cables.get_mut(cable.0 as usize).and_then(Option::take);
        slot.map(|s| s.cable).ok_or(Error::NoCable(cable))
    }

    /// Ends the attachments of a cable and its part in junctions.
    fn let_go(&mut self, world: &mut PhysicsWorld, cable: CableHandle) -> Result<(), Error> {
        for i in 0..self.attachments.len() {
            if self.attachments[i].as_ref().is_some_and(|a| a.cable == cable) {
                self.detach(world, AttachmentHandle(i as u32))?;
            }
        }
        for i in 0..self.junctions.len() {
            if self.junctions[i].as_ref().is_some_and(|j| j.nodes.iter().any(|(c, _)| *c == cable)) {
                self.leave(JunctionHandle(i as u32), cable)?;
            }
        }
        self.stale = true;
        Ok(())
    }

    /// A cable.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn get(&self, cable: CableHandle) -> Result<&Cable, Error> {
        self.cables.get(cable.0 as usize).and_then(Option::as_ref).map(|s| &s.cable).ok_or(Error::NoCable(cable))
    }

    /// A cable, to change it; a sleeping one wakes.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn get_mut(&mut self, cable: CableHandle) -> Result<&mut Cable, Error> {
        self.get(cable)?;
        let slot = self.cables[cable.0 as usize].as_mut().expect("it is here");
        slot.stirred = true;
        Ok(&mut slot.cable)
    }

    /// All cables.
    pub fn iter(&self) -> impl Iterator<Item = (CableHandle, &Cable)> {
        self.cables.iter().enumerate().filter_map(|(i, c)| c.as_ref().map(|s| (CableHandle(i as u32), &s.cable)))
    }

    /// Whether a cable sleeps with the bodies that it holds.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn is_asleep(&self, cable: CableHandle) -> Result<bool, Error> {
        self.get(cable)?;
        Ok(self.cables[cable.0 as usize].as_ref().is_some_and(|s| s.asleep))
    }

    /// All attachments.
    pub fn attachments(&self) -> impl Iterator<Item = (AttachmentHandle, &Attachment)> {
        self.attachments.iter().enumerate().filter_map(|(i, a)| a.as_ref().map(|a| (AttachmentHandle(i as u32), a)))
    }

    /// An attachment.
    ///
    /// # Errors
    /// [`Error::NoAttachment`].
    pub fn attachment(&self, attachment: AttachmentHandle) -> Result<&Attachment, Error> {
        self.attachments.get(attachment.0 as usize).and_then(Option::as_ref).ok_or(Error::NoAttachment(attachment))
    }

    /// A junction.
    ///
    /// # Errors
    /// [`Error::NoJunction`].
    pub fn junction(&self, junction: JunctionHandle) -> Result<&Junction, Error> {
        self.junctions.get(junction.0 as usize).and_then(Option::as_ref).ok_or(Error::NoJunction(junction))
    }

    /// What happened during the last host step.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Takes what happened during the last host step out, so that nobody reads it twice.
    pub fn take_events(&mut self) -> Vec<Event> {
        core::mem::take(&mut self.events)
    }

    /// The cables of the island whose step was refused; none if the last step was done.
    pub fn refused(&self) -> &[CableHandle] {
        &self.refused
    }

    /// What is remembered of a body.
    pub(crate) fn remembered(&self, body: RigidBodyHandle) -> Option<&Remembered> {
        let key = |m: &Remembered| m.handle.into_raw_parts();
        self.memory.binary_search_by_key(&body.into_raw_parts(), key).ok().map(|i| &self.memory[i])
    }

    /// What is remembered of a body, to change it; nothing at first.
    pub(crate) fn remember(&mut self, body: RigidBodyHandle) -> &mut Remembered {
        let key = |m: &Remembered| m.handle.into_raw_parts();
        let i = match self.memory.binary_search_by_key(&body.into_raw_parts(), key) {
            Ok(i) => i,
            Err(i) => {
                self.memory.insert(i, Remembered::new(body));
                i
            }
        };
        &mut self.memory[i]
    }

    /// Gives cables that fall with the world its gravity when it changed; one that is the world's to the world's precision stays as it is.
    pub(crate) fn follow_gravity(&mut self, world: &PhysicsWorld) -> Result<(), Error> {
        if self.gravity == Some(world.gravity) {
            return Ok(());
        }
        for slot in self.cables.iter_mut().flatten() {
            // a user who sets a cable's gravity wants it so
            slot.falls &= slot.gravity == slot.cable.gravity();
            if slot.falls && convert::to_vector(&slot.cable.gravity()) != world.gravity {
                slot.cable.set_gravity(convert::vector(world.gravity))?;
                slot.stirred = true;
            }
            slot.gravity = slot.cable.gravity();
        }
        self.gravity = Some(world.gravity);
        Ok(())
    }
}
