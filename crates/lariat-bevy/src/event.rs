//! Events of cables and attachments. Each is sent twice: as a message to read, and as an entity
//! event to observe. Failures are logged, too, at level error, once each: a rope that cannot be
//! attached is not missed in a program that observes nothing.

use crate::cables::Cables;
use crate::error::Error;
use crate::links::Links;
use bevy_ecs::entity::Entity;
use bevy_ecs::event::EntityEvent;
use bevy_ecs::message::{Message, Messages};
use bevy_ecs::resource::Resource;
use bevy_ecs::world::World;
use lariat_ancf::Break;
use lariat_ancf::warning::Interface;
use lariat_rapier::rapier::geometry::ColliderHandle;
use std::collections::HashMap;

/// The description of a cable, or a change of its effects, is not possible. A cable that was built
/// keeps its previous effects.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct CableFailed {
    /// The cable.
    pub entity: Entity,
    /// The cause.
    pub error: lariat_ancf::Error,
}

/// A cable could not step: it and all that is connected to it by attachments keep their state, and
/// everything else goes on. Sent at each host step until the cause is removed, for every cable that
/// is connected to it. With an error that concerns all cables ([`Entity::PLACEHOLDER`]) nothing
/// advances.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct StepFailed {
    /// The cable; [`Entity::PLACEHOLDER`] if the error concerns all cables.
    pub entity: Entity,
    /// The cause, with the names of the cables, the time and the value.
    pub error: Error,
}

/// A cable and the bodies attached to it fell asleep.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct CableAsleep {
    /// The cable.
    pub entity: Entity,
}

/// A cable woke up.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct CableAwake {
    /// The cable.
    pub entity: Entity,
}

/// The accuracy of the cable was reduced, by the [budget](lariat_rapier::Budget) of a host step or by a body in contact; see
/// [`Event::Degraded`](lariat_rapier::Event::Degraded).
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct CableDegraded {
    /// The cable.
    pub entity: Entity,
    /// Newton iterations of its island in the host step until then.
    pub iterations: u64,
}

/// A cable broke because its load exceeded [`BreakTension`](crate::BreakTension) or
/// [`BreakStrain`](crate::BreakStrain), or was [cut](crate::Cables::cut).
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct CableBroken {
    /// The cable, which is now the part before the break.
    pub entity: Entity,
    /// A new entity: the part behind the break.
    pub rest: Entity,
    /// Why, where and under which load.
    pub how: Break,
}

/// A cable with [`Contact`](crate::Contact) began to touch a collider.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct ContactStarted {
    /// The cable.
    pub entity: Entity,
    /// The body of the collider, if it is one of an entity.
    pub body: Option<Entity>,
    /// The collider.
    pub collider: ColliderHandle,
    /// Arc length of the centre of the forces in m.
    pub arc_length: f64,
    /// Sum of the normal forces in N.
    pub force: f64,
}

/// A cable no longer touches a collider.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct ContactEnded {
    /// The cable.
    pub entity: Entity,
    /// The body of the collider, if it is one of an entity and still there.
    pub body: Option<Entity>,
    /// The collider.
    pub collider: ColliderHandle,
    /// Arc length in m where it was last touched.
    pub arc_length: f64,
}

/// A cable with [`Contact`](crate::Contact) is in a collider that it cannot touch, one with a shape of the program's own.
/// Sent once for each.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct ContactIgnored {
    /// The cable.
    pub entity: Entity,
    /// The body of the collider, if it is one of an entity.
    pub body: Option<Entity>,
    /// The collider.
    pub collider: ColliderHandle,
}

/// The mesh, the steps, the law or the sizes of a cable are probably not good enough. Sent once for
/// each kind, up to the level of [`Settings::warn_level`](lariat_rapier::Settings::warn_level), and
/// logged; its [`text`](Self::text) says what to do. What is wrong with how cables and attachments
/// meet bodies ([`lariat_rapier::Warning`]) is logged alone, before the first host step;
/// [`Cables::warnings`](crate::Cables::warnings) returns it at any time.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct CableWarning {
    /// The cable.
    pub entity: Entity,
    /// What it says about itself.
    pub warning: lariat_ancf::Warning,
}

impl CableWarning {
    /// Returns what it says, with the names of Bevy's components.
    pub fn text(&self) -> String {
        Interface::Bevy.text(&self.warning)
    }
}

/// A cable and its anchor on a body, which had met, came apart: by more than 2e-3 of the length of the cable. Sent once for each attachment; take shorter
/// steps, or find what holds the body back.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct GapOpened {
    /// The attachment.
    pub entity: Entity,
    /// Its cable.
    pub cable: Entity,
    /// The body it is attached to; `None` for the world.
    pub body: Option<Entity>,
    /// The distance in m.
    pub gap: f64,
}

/// A body on joints did not move as predicted for a second, so that the forces of the cable there are not to be trusted. Sent once for each attachment;
/// take shorter steps or more solver iterations, or weld links into one body.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct MechanismUnsettled {
    /// The attachment.
    pub entity: Entity,
    /// Its cable.
    pub cable: Entity,
    /// The body it is attached to; `None` for the world.
    pub body: Option<Entity>,
    /// When, and by how much.
    pub how: lariat_rapier::Unsettled,
}

/// Reason why an attachment ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EndReason {
    /// The body was removed.
    BodyGone,
    /// The user removed the attachment or its relationship to cable or body, or despawned its
    /// entity; an entity that was not despawned stays.
    Released,
    /// The force exceeded [`BreakForce`](crate::BreakForce).
    Broken,
}

/// An attachment ended, and the cable is free there. Its entity is despawned after this event,
/// except for [`EndReason::Released`]. Not sent when the cable itself is removed.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct AttachmentEnded {
    /// The attachment.
    pub entity: Entity,
    /// Its cable.
    pub cable: Entity,
    /// The body it was attached to; `None` for the world.
    pub body: Option<Entity>,
    /// Why it ended.
    pub reason: EndReason,
}

/// An attachment cannot be made. It is tried again when one of its components changes, or when a
/// cable is spawned.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct AttachmentFailed {
    /// The attachment.
    pub entity: Entity,
    /// The cause.
    pub error: Error,
}

/// A junction cannot be made. It is tried again when its component changes, or when a cable is
/// spawned.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct JunctionFailed {
    /// The junction.
    pub entity: Entity,
    /// The cause.
    pub error: Error,
}

/// A junction ended because fewer than two of its cables are left; the entity stays.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct JunctionEnded {
    /// The junction.
    pub entity: Entity,
}

/// A drum cannot be, or its body is gone. It is tried again when its component, its cable or its body changes.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct DrumFailed {
    /// The cable.
    pub entity: Entity,
    /// The cause.
    pub error: Error,
}

/// A body cannot be in water; or the water cannot be, for which the entity is `Entity::PLACEHOLDER`. It is tried again when the
/// component, the body or the water changes.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct WaterFailed {
    /// The body.
    pub entity: Entity,
    /// The cause.
    pub error: Error,
}

/// A sheave cannot be made, or ended with one of its cables or attachments. It is tried again when its component changes, or when
/// a cable is spawned.
#[derive(EntityEvent, Message, Clone, Debug, PartialEq)]
pub struct SheaveFailed {
    /// The sheave.
    pub entity: Entity,
    /// The cause.
    pub error: Error,
}

/// Calls `$apply!` with the type of each event.
macro_rules! for_each_event {
    ($apply:ident) => {
        $apply!(
            CableFailed,
            StepFailed,
            CableAsleep,
            CableAwake,
            CableDegraded,
            CableBroken,
            CableWarning,
            ContactStarted,
            ContactEnded,
            ContactIgnored,
            GapOpened,
            MechanismUnsettled,
            AttachmentEnded,
            AttachmentFailed,
            JunctionFailed,
            JunctionEnded,
            DrumFailed,
            SheaveFailed,
            WaterFailed
        );
    };
}
#[cfg(feature = "bevy_app")]
pub(crate) use for_each_event;

macro_rules! queue {
    ($($event:ident),*) => {
        /// An event that is sent at the end of the host step.
        #[derive(Clone, Debug)]
        pub(crate) enum QueuedEvent {
            $($event($event)),*
        }

        impl QueuedEvent {
            /// Writes the message, runs the observers, and logs a failure that this entity has not had.
            pub fn send(self, world: &mut World) {
                let failure = self.failure(world.get_resource::<Cables>().map(|cables| &cables.links));
                if let (Some(failure), Some(mut logged)) = (failure, world.get_resource_mut::<Logged>()) {
                    logged.note(failure);
                }
                match self {
                    $(QueuedEvent::$event(event) => {
                        world.write_message(event.clone());
                        world.trigger(event);
                    })*
                }
            }
        }

        $(impl From<$event> for QueuedEvent {
            fn from(event: $event) -> Self {
                QueuedEvent::$event(event)
            }
        })*
    };
}
for_each_event!(queue);

macro_rules! failures {
    ($($event:ident),*) => {
        impl QueuedEvent {
            /// Returns entity, event and text of one that the program has to mend; entities have
            /// their names by `links`.
            pub fn failure(&self, links: Option<&Links>) -> Option<Failure> {
                let text = |error: &dyn core::fmt::Display| {
                    let text = Interface::Bevy.text(&error);
                    links.map_or_else(|| text.clone(), |links| links.name_entities(&text))
                };
                match self {
                    $(QueuedEvent::$event(event) => Some((event.entity, stringify!($event), text(&event.error))),)*
                    _ => None,
                }
            }
        }
    };
}
failures!(CableFailed, StepFailed, AttachmentFailed, JunctionFailed, DrumFailed, SheaveFailed, WaterFailed);

/// Entity, event and text of a failure.
type Failure = (Entity, &'static str, String);

/// The last failure that was logged of each entity and event.
#[derive(Resource, Default)]
pub(crate) struct Logged(HashMap<(Entity, &'static str), String>);

impl Logged {
    /// Logs a failure, unless it is the last one of its entity and event.
    pub fn note(&mut self, (entity, event, failure): Failure) {
        if self.0.get(&(entity, event)) != Some(&failure) {
            log::error!("{event} of {entity}: {failure}");
            self.0.insert((entity, event), failure);
        }
    }
}

/// Adds the message queues to a world.
pub(crate) fn register(world: &mut World) {
    macro_rules! init {
        ($($event:ident),*) => { $( world.init_resource::<Messages<$event>>(); )* };
    }
    for_each_event!(init);
    world.init_resource::<Logged>();
}

/// Drops messages that are two updates old.
pub(crate) fn update(world: &mut World) {
    macro_rules! update {
        ($($event:ident),*) => { $( world.resource_mut::<Messages<$event>>().update(); )* };
    }
    for_each_event!(update);
}
