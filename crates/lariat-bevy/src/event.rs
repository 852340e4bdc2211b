//! What happens to cables and attachments: each is a message to read, and an entity event to observe.

use crate::error::Error;
use bevy_ecs::entity::Entity;
use bevy_ecs::event::EntityEvent;
use bevy_ecs::message::{Message, Messages};
use bevy_ecs::world::World;

/// The description of a cable, or a change of its effects, is not possible. A cable that was built goes on as it was.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct CableFailed {
    /// The cable.
    pub entity: Entity,
    /// Why.
    pub error: lariat_ancf::Error,
}

/// The host step was refused: time stands still, cables and bodies are as after the last step that could be done. Comes again each
/// step until the cause is gone. Triggered for every cable that is connected to the culprit.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct StepRefused {
    /// The cable; [`Entity::PLACEHOLDER`] if the cause is no cable's.
    pub entity: Entity,
    /// Why: with the cable's name, the time and the value.
    pub error: Error,
}

/// A cable and the bodies that it holds came to rest and sleep.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct CableAsleep {
    /// The cable.
    pub entity: Entity,
}

/// A cable was woken.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct CableAwake {
    /// The cable.
    pub entity: Entity,
}

/// Why an attachment ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The body went away, or is no body any more.
    BodyGone,
    /// The user let go: the entity is no longer an attachment to this body.
    Released,
    /// The force grew beyond [`BreakForce`](crate::BreakForce).
    Broken,
}

/// An attachment ended, and its cable goes on free. Its entity is despawned after this, but for [`End::Released`]. Not sent where the cable
/// itself goes away.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct AttachmentEnded {
    /// The attachment.
    pub entity: Entity,
    /// Its cable.
    pub cable: Entity,
    /// The body it held to; none for the world.
    pub body: Option<Entity>,
    /// Why.
    pub end: End,
}

/// An attachment cannot be made. It is tried again when one of its components changes.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct AttachmentFailed {
    /// The attachment.
    pub entity: Entity,
    /// Why.
    pub error: Error,
}

/// An event that waits to be sent.
#[derive(Clone, Debug)]
pub(crate) enum Notice {
    Failed(CableFailed),
    Refused(StepRefused),
    Asleep(CableAsleep),
    Awake(CableAwake),
    Ended(AttachmentEnded),
    NotAttached(AttachmentFailed),
}

impl Notice {
    /// Writes the message and runs the observers.
    pub fn send(self, world: &mut World) {
        fn both<E>(world: &mut World, event: E)
        where
            E: Message + Clone + for<'a> EntityEvent<Trigger<'a>: Default>,
        {
            world.write_message(event.clone());
            world.trigger(event);
        }
        match self {
            Notice::Failed(event) => both(world, event),
            Notice::Refused(event) => both(world, event),
            Notice::Asleep(event) => both(world, event),
            Notice::Awake(event) => both(world, event),
            Notice::Ended(event) => both(world, event),
            Notice::NotAttached(event) => both(world, event),
        }
    }
}

/// Calls `$apply!` with the type of each event.
macro_rules! for_each_event {
    ($apply:ident) => {
        $apply!(CableFailed, StepRefused, CableAsleep, CableAwake, AttachmentEnded, AttachmentFailed)
    };
}
#[cfg(feature = "bevy_app")]
pub(crate) use for_each_event;

/// Makes room for the messages.
pub(crate) fn register(world: &mut World) {
    macro_rules! init {
        ($($event:ident),*) => { $( world.init_resource::<Messages<$event>>(); )* };
    }
    for_each_event!(init);
}

/// Drops messages that are two updates old.
pub(crate) fn update(world: &mut World) {
    macro_rules! update {
        ($($event:ident),*) => { $( world.resource_mut::<Messages<$event>>().update(); )* };
    }
    for_each_event!(update);
}
