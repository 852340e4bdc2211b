//! Sheaves, as entities.

use crate::cables::{Cables, SheaveLink};
use crate::error::Error;
use crate::event::SheaveFailed;
use crate::pending::Pending;
use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::{Query, Ref, Res, ResMut};
use bevy_ecs::query::Allow;
use lariat_ancf::At;
use lariat_rapier::SheaveOptions;

/// Lets a cable run into another over a wheel without extent: both ends are attached at one point, of a body or of the world.
/// [`Cables::sheave`] reads it. It ends when this component is removed or its entity is despawned.
///
/// ```
/// # use bevy_ecs::prelude::*;
/// # use lariat_bevy::{At, Attachment, Cable, Cables, CableStep, Sheave};
/// # let mut world = World::new();
/// # lariat_bevy::install(&mut world);
/// let up = world.spawn(Cable::steel_rope(0.01).between([0.0, -3.0, 0.0], [0.0, 0.0, 0.0])).id();
/// let down = world.spawn(Cable::steel_rope(0.01).between([0.0, 0.0, 0.0], [0.0, -5.0, 0.0])).id();
/// world.spawn(Attachment::ball(up, At::End).to_world());
/// world.spawn(Attachment::ball(down, At::Start).to_world());
/// let sheave = world.spawn(Sheave::between((up, At::End), (down, At::Start)).friction(0.1)).id();
/// for _ in 0..30 {
///     world.run_schedule(CableStep);
/// }
/// assert!(world.resource::<Cables>().sheave(sheave).unwrap().passed() > 0.05); // the longer side falls
/// ```
///
/// Both cables need the integrator `discrete-gradient`, the default, and one mass per length. If a sheave cannot be made, or ends with
/// one of its cables or attachments, [`SheaveFailed`] is sent; it is tried again when the component changes or a cable is spawned.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct Sheave {
    /// The cable that runs into the other at positive rates, and its end.
    pub from: (Entity, At),
    /// The other, and its end.
    pub to: (Entity, At),
    /// Inertia, friction, brake.
    pub options: SheaveOptions,
}

impl Sheave {
    /// A sheave without friction between the ends of two cables.
    pub fn between(from: (Entity, impl Into<At>), to: (Entity, impl Into<At>)) -> Self {
        let options = SheaveOptions::default();
        Sheave { from: (from.0, from.1.into()), to: (to.0, to.1.into()), options }
    }

    /// Sets the coefficient of friction of the rope on the wheel.
    pub fn friction(mut self, friction: f64) -> Self {
        self.options.friction = friction;
        self
    }

    /// Sets inertia, friction and brake.
    pub fn with_options(self, options: SheaveOptions) -> Self {
        Sheave { options, ..self }
    }

    /// Renames entities.
    pub(crate) fn rename(&mut self, name: &impl Fn(Entity) -> Entity) {
        (self.from.0, self.to.0) = (name(self.from.0), name(self.to.0));
    }
}

impl Cables {
    /// Returns what the sheave of an entity did so far: what passed, its friction, what that took.
    ///
    /// # Errors
    /// [`Error::NotASheave`], also if it could not be made or has ended.
    pub fn sheave(&self, entity: Entity) -> Result<&lariat_rapier::Sheave, Error> {
        let handle = self.links.sheaves.get(&entity).and_then(|link| link.handle);
        handle.and_then(|handle| self.set.sheave(handle).ok()).ok_or(Error::NotASheave(entity))
    }
}

/// Makes the sheaves that the components ask for, and ends the others. `pending.new_cables` is still that of the attachments.
pub(crate) fn update(
    mut cables: ResMut<Cables>,
    pending: Res<Pending>,
    sheaves: Query<(Entity, Ref<Sheave>), Allow<Disabled>>,
) {
    let Cables { set, links, events, .. } = &mut *cables;
    links.sheaves.retain(|entity, link| {
        let stays = sheaves.get(*entity).is_ok_and(|(_, sheave)| *sheave == link.made);
        if let Some(handle) = link.handle.filter(|_| !stays) {
            // one that has ended already is what is wanted
            let _ = set.remove_sheave(handle);
        }
        stays
    });
    for (entity, sheave) in &sheaves {
        if let Some(link) = links.sheaves.get_mut(&entity) {
            match link.handle.map(|handle| set.sheave(handle)) {
                Some(Ok(_)) => continue,
                Some(Err(error)) => {
                    link.handle = None;
                    events.push(SheaveFailed { entity, error: error.into() }.into());
                    continue;
                }
                None if !pending.new_cables && !sheave.is_changed() => continue,
                None => {}
            }
        }
        let handle = |cable: Entity| match links.built.get(&cable) {
            Some(Ok(handle)) => Ok(*handle),
            Some(Err(reason)) => Err(Error::NotBuilt { entity: cable, reason: reason.clone() }),
            None => Err(Error::NotACable(cable)),
        };
        let added = handle(sheave.from.0).and_then(|from| {
            let to = handle(sheave.to.0)?;
            Ok(set.add_sheave((from, sheave.from.1), (to, sheave.to.1), sheave.options)?)
        });
        let link = SheaveLink { made: *sheave, handle: added.as_ref().ok().copied() };
        links.sheaves.insert(entity, link);
        if let Err(error) = added {
            events.push(SheaveFailed { entity, error }.into());
        }
    }
}
