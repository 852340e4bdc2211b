//! Sheaves along one cable, as entities.

use crate::attachment::{Attached, Attachment, OnCable, ToBody};
use crate::body::BodyHandle;
use crate::breaking::split_entity;
use crate::cable::Cable;
use crate::cables::{AttachmentLink, Cables, SheaveLink};
use crate::error::Error;
use crate::event::SheaveFailed;
use crate::physics::Physics;
use crate::prepare::attachments::ground;
use crate::sheave::Sheave;
use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::{Ref, World};
use bevy_ecs::query::{Allow, QueryState};
use bevy_ecs::world::Mut;
use lariat_ancf::{At, Point, Vector3};
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::rapier::math::{Real, Vector};
use lariat_rapier::{AttachmentKind, CableHandle, Gap, SheaveHandle, SheaveOptions};

/// Asks for a sheave at a point between the ends of one cable: an eye of a body or of the world, over which it runs.
///
/// In the next host step, after the attachments were made, the entity has a [`Sheave`] in the place of this component. The entity of the
/// cable keeps the part before the sheave; the part behind it is a new entity with the same components, and both are attached to the eye by
/// new entities. [`Cables::parts`] lists the parts. The ends of the cable are those of its first and last part then: attach them before, or
/// with it.
///
/// ```
/// # use bevy_ecs::prelude::*;
/// # use lariat_bevy::{At, Attachment, Body, Cable, Cables, CableStep, SheaveAlong};
/// # let mut world = World::new();
/// # lariat_bevy::install(&mut world);
/// let rope = Cable::steel_rope(0.01).through([[0.0, -3.0, 0.0], [0.0, 0.0, 0.0], [0.0, -5.0, 0.0]]).node_at(3.0);
/// let rope = world.spawn(rope).id();
/// let sheave = world.spawn(SheaveAlong::of(rope, At::ArcLength(3.0)).to_world([0.0, 0.0, 0.0])).id();
/// for _ in 0..30 {
///     world.run_schedule(CableStep);
/// }
/// let cables = world.resource::<Cables>();
/// assert!(cables.sheave(sheave).unwrap().passed() > 0.05); // the longer side falls
/// assert_eq!(cables.parts(rope).unwrap().len(), 2);
/// ```
///
/// A cable that is drawn around a corner there needs a [node](Cable::node_at) at it, and has no strain from the corner then. If the sheave
/// cannot be made, [`SheaveFailed`] is sent; it is tried again when this component, the cable or the body changes.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct SheaveAlong {
    /// The cable, and the point that is at the sheave.
    pub cable: (Entity, At),
    /// The body; `None` for the world.
    pub body: Option<Entity>,
    /// The eye in m, in body axes from its origin; in world axes for the world.
    pub anchor: Vector3<f64>,
    /// Inertia, friction, brake.
    pub options: SheaveOptions,
}

impl SheaveAlong {
    /// A sheave without friction at the origin of the world, for a point of a cable.
    pub fn of(cable: Entity, at: impl Into<At>) -> Self {
        SheaveAlong {
            cable: (cable, at.into()),
            body: None,
            anchor: Vector3::zeros(),
            options: SheaveOptions::default(),
        }
    }

    /// Puts the eye on a body, at a point in m in its axes.
    pub fn to(self, body: Entity, anchor: impl Into<Point>) -> Self {
        SheaveAlong { body: Some(body), anchor: anchor.into().0, ..self }
    }

    /// Puts the eye at a point of the world in m.
    pub fn to_world(self, anchor: impl Into<Point>) -> Self {
        SheaveAlong { body: None, anchor: anchor.into().0, ..self }
    }

    /// Sets inertia, friction and brake.
    pub fn with_options(self, options: SheaveOptions) -> Self {
        SheaveAlong { options, ..self }
    }

    /// Returns it with other names of entities.
    pub(crate) fn renamed(self, name: &impl Fn(Entity) -> Entity) -> Self {
        SheaveAlong { cable: (name(self.cable.0), self.cable.1), body: self.body.map(name), ..self }
    }
}

impl Cables {
    /// Returns the parts of a cable that runs over [sheaves along it](SheaveAlong), from start to end; the cable alone if it runs over
    /// none.
    ///
    /// # Errors
    /// [`Error::NotACable`]; [`Error::NotBuilt`] with the reason.
    pub fn parts(&self, entity: Entity) -> Result<Vec<Entity>, Error> {
        let parts = self.set.parts(self.handle(entity)?)?;
        Ok(parts.iter().filter_map(|part| self.links.cables.get(part)).map(|link| link.entity).collect())
    }
}

/// Makes the sheaves that were asked for. Attachments to the ends of their cables are there already.
pub(crate) fn update(world: &mut World, asked: &mut QueryState<(Entity, Ref<SheaveAlong>), Allow<Disabled>>) {
    let asked: Vec<_> = asked.iter(world).map(|(entity, sheave)| (entity, *sheave, sheave.is_changed())).collect();
    for (entity, sheave, is_changed) in asked {
        let changed = |cable: Entity| {
            world.get_entity(cable).is_ok_and(|cable| cable.get_ref::<Cable>().is_some_and(|own| own.is_changed()))
        };
        let body = |body: Entity| {
            world.get_entity(body).is_ok_and(|body| body.get_ref::<BodyHandle>().is_some_and(|own| own.is_changed()))
        };
        if (is_changed || changed(sheave.cable.0) || sheave.body.is_some_and(body))
            && let Err(error) = make(world, entity, sheave)
        {
            world.resource_mut::<Cables>().events.push(SheaveFailed { entity, error }.into());
        }
    }
}

/// Makes a sheave, and the entities of its part and its attachments.
fn make(world: &mut World, entity: Entity, sheave: SheaveAlong) -> Result<(), Error> {
    let body = match sheave.body {
        None => None,
        Some(body) => {
            let handle = world.get::<BodyHandle>(body).map(|body| body.handle);
            Some((body, handle.ok_or(Error::NotABody(body))?))
        }
    };
    let (cable, rest, made, rigid) = world.resource_scope(|world, mut cables: Mut<Cables>| {
        let mut physics = world.resource_mut::<Physics>();
        let whole = cables.handle(sheave.cable.0)?;
        let rigid = body.map_or_else(|| ground(&mut cables, &mut physics), |(_, handle)| handle);
        let anchor: [f64; 3] = sheave.anchor.into();
        let eye = (rigid, Vector::from(anchor.map(|x| x as Real)));
        let made = cables.set.add_sheave_at(&physics, (whole, sheave.cable.1), eye, sheave.options)?;
        let [(cable, _), (rest, _)] = cables.set.sheave(made)?.ends();
        Ok::<_, Error>((cable, rest, made, rigid))
    })?;
    let owner = world.resource::<Cables>().links.cables.get(&cable).map(|link| link.entity);
    let before = owner.ok_or(Error::NotACable(sheave.cable.0))?;
    let behind = split_entity(world, before, cable, rest).ok_or(Error::NotACable(before))?;
    hold(world, (before, cable, At::End), sheave, rigid);
    hold(world, (behind, rest, At::Start), sheave, rigid);
    link(world, entity, [before, behind], sheave, made);
    Ok(())
}

/// Spawns the entity of the attachment of a part at a sheave.
fn hold(world: &mut World, (part, handle, at): (Entity, CableHandle, At), sheave: SheaveAlong, rigid: RigidBodyHandle) {
    let made = Attachment {
        at,
        kind: AttachmentKind::Ball,
        anchor: Some(sheave.anchor),
        world: sheave.body.is_none(),
        gap: Gap::Close,
    };
    let cables = world.resource::<Cables>();
    let node = cables.set.get(handle).map_or(0, |cable| if at == At::End { cable.nodes() - 1 } else { 0 });
    let own = cables.set.attachments().find(|(_, own)| own.cable() == handle && own.node() == node);
    let Some(attachment) = own.map(|(attachment, _)| attachment) else { return };
    let mut spawned = world.spawn((made, OnCable(part)));
    if let Some(body) = sheave.body {
        spawned.insert(ToBody(body));
    }
    let entity = spawned.insert(Attached(attachment)).id();
    let link = AttachmentLink { entity, cable: part, body: sheave.body, handle: rigid, made, counted: 0.0 };
    world.resource_mut::<Cables>().links.attachments.insert(attachment, link);
}

/// Makes an entity that asked for a sheave the sheave.
fn link(world: &mut World, entity: Entity, [before, behind]: [Entity; 2], sheave: SheaveAlong, handle: SheaveHandle) {
    let made = Sheave::between((before, At::End), (behind, At::Start)).with_options(sheave.options);
    world.resource_mut::<Cables>().links.sheaves.insert(entity, SheaveLink { made, handle: Some(handle) });
    world.entity_mut(entity).remove::<SheaveAlong>().insert(made);
}
