//! The set of cables of a world, and their attachments.

use crate::attachment::{Attachment, AttachmentHandle, Event};
use crate::body::BodyMemory;
use crate::convert::vector;
use crate::{Error, islands};
use lariat_ancf::island::Island;
use lariat_ancf::{At, Cable, Support};
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
    /// Rapier steps per host step. Default 4: as accurate in free flight as one, and far better in contact.
    pub rapier_steps: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Settings { rapier_steps: 4 }
    }
}

/// Cables and what they hold to. Serialises with its state; a snapshot of (world, set) replays bitwise.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct CableSet {
    /// How the set steps.
    pub settings: Settings,
    pub(crate) cables: Vec<Option<Cable>>,
    pub(crate) attachments: Vec<Option<Attachment>>,
    pub(crate) memory: Vec<BodyMemory>,
    #[serde(skip)]
    pub(crate) islands: Vec<islands::IslandStep>,
    #[serde(skip)]
    pub(crate) solver: Island,
    #[serde(skip)]
    pub(crate) events: Vec<Event>,
}

impl CableSet {
    /// An empty set.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a cable.
    pub fn insert(&mut self, cable: Cable) -> CableHandle {
        self.cables.push(Some(cable));
        CableHandle(self.cables.len() as u32 - 1)
    }

    /// Removes a cable and its attachments.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn remove(&mut self, world: &mut PhysicsWorld, cable: CableHandle) -> Result<Cable, Error> {
        for i in 0..self.attachments.len() {
            if self.attachments[i].as_ref().is_some_and(|a| a.cable == cable) {
                self.detach(world, AttachmentHandle(i as u32))?;
            }
        }
        self.cables.get_mut(cable.0 as usize).and_then(Option::take).ok_or(Error::NoCable(cable))
    }

    /// A cable.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn get(&self, cable: CableHandle) -> Result<&Cable, Error> {
        self.cables.get(cable.0 as usize).and_then(Option::as_ref).ok_or(Error::NoCable(cable))
    }

    /// A cable, to change it.
    ///
    /// # Errors
    /// [`Error::NoCable`].
    pub fn get_mut(&mut self, cable: CableHandle) -> Result<&mut Cable, Error> {
        self.cables.get_mut(cable.0 as usize).and_then(Option::as_mut).ok_or(Error::NoCable(cable))
    }

    /// All cables.
    pub fn iter(&self) -> impl Iterator<Item = (CableHandle, &Cable)> {
        self.cables.iter().enumerate().filter_map(|(i, c)| c.as_ref().map(|c| (CableHandle(i as u32), c)))
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

    /// Pins a node of a cable to a point of a body (body axes from its origin, in m): a ball joint. A gap closes in the next step.
    ///
    /// # Errors
    /// [`Error::NoCable`], [`Error::NoBody`], [`Error::AlreadyAttached`], or [`Error::Cable`] if no node is there.
    pub fn attach(
        &mut self,
        world: &PhysicsWorld,
        cable: CableHandle,
        at: impl Into<At>,
        body: RigidBodyHandle,
        anchor: Vector,
    ) -> Result<AttachmentHandle, Error> {
        if !world.bodies.contains(body) {
            return Err(Error::NoBody(body));
        }
        let name = self.get(cable)?.name().to_string();
        let node = self.get_mut(cable)?.attach(at)?;
        if self.attachments().any(|(_, a)| a.cable == cable && a.node == node) {
            return Err(Error::AlreadyAttached { cable: name, node });
        }
        let anchor = vector(anchor);
        self.attachments.push(Some(Attachment { cable, node, body, anchor, ledger: None, gap: 0.0 }));
        Ok(AttachmentHandle(self.attachments.len() as u32 - 1))
    }

    /// Ends an attachment; the node is free.
    ///
    /// # Errors
    /// [`Error::NoAttachment`].
    pub fn detach(&mut self, world: &mut PhysicsWorld, attachment: AttachmentHandle) -> Result<(), Error> {
        let slot = self.attachments.get_mut(attachment.0 as usize);
        let ended = slot.and_then(Option::take).ok_or(Error::NoAttachment(attachment))?;
        if let Some(ledger) = ended.ledger {
            world.remove_body(ledger.body);
        }
        let cable = self.get_mut(ended.cable)?;
        let support = Support { position: None, attached: false, ..cable.support(At::Node(ended.node))? };
        cable.set_support(At::Node(ended.node), support)?;
        Ok(())
    }

    /// What happened during the last host step.
    pub fn events(&self) -> &[Event] {
        &self.events
    }
}
