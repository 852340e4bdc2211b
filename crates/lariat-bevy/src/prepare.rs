//! Before a host step: what was spawned, changed, removed or despawned since the last one reaches the set and Rapier's world.

use crate::attachment::{Attachment, Holds, OnCable, ToBody, Unable};
use crate::body::{Body, BodyHandle, BodyPose, KinematicTarget};
use crate::cable::{Cable, State};
use crate::diagnostics::{Diagnostics, Stage};
use crate::effects::{self, *};
use crate::error::Error;
use crate::event::{AttachmentEnded, AttachmentFailed, CableFailed, End, Notice};
use crate::interpolate::Interpolate;
use crate::point::to_vector;
use crate::world::{AllCables, Bound, Cables, Physics, bring_home, lend_out};
use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::name::Name;
use bevy_ecs::prelude::{Added, Changed, Commands, Has, Or, Query, Ref, Res, ResMut, With, Without};
use bevy_ecs::query::Allow;
use bevy_ecs::resource::Resource;
use bevy_ecs::world::World;
use lariat_rapier::CableHandle;
use lariat_rapier::rapier::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use lariat_rapier::rapier::math::Vector;
use std::collections::BTreeSet;
use std::time::Instant;

/// When the stage began.
#[derive(Resource)]
pub(crate) struct Begun(Instant);

/// Starts the clock of the stage.
pub(crate) fn begin(mut commands: Commands) {
    commands.insert_resource(Begun(Instant::now()));
}

/// Stops the clock of the stage.
pub(crate) fn end(begun: Res<Begun>, mut diagnostics: ResMut<Diagnostics>) {
    diagnostics.spent(Stage::Prepare, begun.0);
}

/// Cables, attachments and bodies that went away or were replaced.
pub(crate) fn retire(
    mut cables: ResMut<Cables>,
    mut physics: ResMut<Physics>,
    mut of: AllCables,
    attachments: Query<(), With<Attachment>>,
    mut commands: Commands,
) {
    let cables = &mut *cables;
    bring_home(cables, &mut of);
    write_off(cables, &mut physics, &mut commands);
    for (entity, lent) in core::mem::take(&mut cables.handed_in) {
        let handle = lent.handle();
        // one whose component was overwritten by a copy of itself goes on as the copy
        if cables.set.give_back(lent).is_err() || cables.links.cables.get(&handle) != Some(&entity) {
            continue;
        }
        cables.links.cables.remove(&handle);
        let _ = cables.set.remove(&mut physics, handle);
        unlink(cables, &mut commands);
    }
    for (entity, handle) in core::mem::take(&mut cables.retired_attachments) {
        let Some(bound) = cables.links.attachments.remove(&handle) else { continue };
        if cables.set.detach(&mut physics, handle).is_ok() && commands.get_entity(entity).is_ok() {
            let replaced = attachments.contains(entity);
            if !replaced {
                let (cable, body) = (bound.cable, bound.body);
                cables.notices.push(Notice::Ended(AttachmentEnded { entity, cable, body, end: End::Released }));
            }
        }
    }
    for handle in core::mem::take(&mut cables.retired_bodies) {
        cables.links.bodies.remove(&handle.into_raw_parts());
        physics.remove_body(handle);
    }
    lend_out(cables, &mut of);
}

/// Gives up cables that were lent and are nowhere: their components were overwritten in place.
fn write_off(cables: &mut Cables, physics: &mut Physics, commands: &mut Commands) {
    let Cables { set, links, handed_in, .. } = &mut *cables;
    let lost: Vec<CableHandle> = set.lent().filter(|h| !handed_in.iter().any(|(_, l)| l.handle() == *h)).collect();
    for handle in &lost {
        let _ = set.forget(physics, *handle);
        links.cables.remove(handle);
    }
    if !lost.is_empty() {
        unlink(cables, commands);
    }
}

/// Forgets attachments that the set has no more; they hold to the cable that takes the place, if one does.
fn unlink(cables: &mut Cables, commands: &mut Commands) {
    let Cables { set, links, .. } = cables;
    links.attachments.retain(|attachment, bound| {
        let holds = set.attachment(*attachment).is_ok();
        if !holds && let Ok(mut entity) = commands.get_entity(bound.entity) {
            entity.try_remove::<Holds>();
        }
        holds
    });
}

/// Builds cables that were written over others in place.
pub(crate) fn build_planned(world: &mut World) {
    let mut of = world.query_filtered::<(Entity, &Cable), Allow<Disabled>>();
    let planned: Vec<Entity> =
        of.iter(world).filter(|(_, cable)| matches!(cable.state, State::Planned)).map(|(entity, _)| entity).collect();
    for entity in planned {
        crate::cable::build_one(world.into(), entity);
        world.flush();
    }
}

/// What tells new bodies apart, whatever the order in which they were spawned.
fn rank(name: Option<&Name>, body: &Body) -> (String, [u32; 7]) {
    let rigid = body.rigid.clone().build();
    let (x, v) = (rigid.translation(), rigid.linvel());
    let numbers = [x.x, x.y, x.z, v.x, v.y, v.z, rigid.rotation().w];
    (name.map(|n| n.as_str().to_string()).unwrap_or_default(), numbers.map(f32::to_bits))
}

/// Makes the bodies that are new, and moves kinematic ones.
pub(crate) fn make_bodies(
    mut cables: ResMut<Cables>,
    mut physics: ResMut<Physics>,
    mut new: Query<(Entity, &Body, Option<&Name>, &mut BodyPose), Without<BodyHandle>>,
    external: Query<(Entity, &BodyHandle), Added<BodyHandle>>,
    targets: Query<(&BodyHandle, &KinematicTarget), Changed<KinematicTarget>>,
    mut commands: Commands,
) {
    for (entity, body) in &external {
        cables.links.bodies.insert(body.handle.into_raw_parts(), entity);
    }
    let mut ranked: Vec<_> = new.iter().map(|(entity, body, name, _)| (rank(name, body), entity)).collect();
    ranked.sort();
    for (_, entity) in ranked {
        let Ok((_, body, _, mut pose)) = new.get_mut(entity) else { continue };
        let handle = physics.insert_body(body.rigid.clone());
        for collider in &body.colliders {
            physics.insert_collider(collider.clone(), Some(handle));
        }
        pose.follow(&physics.bodies[handle], true);
        cables.links.bodies.insert(handle.into_raw_parts(), entity);
        commands.entity(entity).insert(BodyHandle { handle });
    }
    for (body, target) in &targets {
        if let Some(rigid) = physics.bodies.get_mut(body.handle) {
            rigid.set_next_kinematic_position(target.pose());
        }
    }
}

type AnyEffectChanged = Or<(
    Changed<Rule>,
    Changed<Bending>,
    Changed<Damping>,
    Changed<Drag>,
    Changed<Buoyancy>,
    Changed<RestShape>,
    Changed<LineLoads>,
    Changed<PointLoads>,
    Changed<GravityScale>,
)>;

/// Entities whose effects may differ from what their cables do.
#[derive(Resource, Default)]
pub(crate) struct ChangedEffects(pub BTreeSet<Entity>);

/// Collects them.
pub(crate) fn watch_effects(
    mut changed: ResMut<ChangedEffects>,
    of: Query<Entity, (With<Cable>, AnyEffectChanged, Allow<Disabled>)>,
) {
    changed.0.extend(&of);
}

/// Makes cables do what their entities' components ask.
pub(crate) fn change_effects(world: &mut World) {
    let changed = core::mem::take(&mut world.resource_mut::<ChangedEffects>().0);
    for entity in changed {
        let Ok(reference) = world.get_entity(entity) else { continue };
        let wanted = Wanted::of(reference);
        let Some(mut cable) = world.get_mut::<Cable>(entity) else { continue };
        if let Err(error) = effects::update(&mut cable, &wanted) {
            world.resource_mut::<Cables>().notices.push(Notice::Failed(CableFailed { entity, error }));
        }
    }
}

/// Takes new cables into the set.
pub(crate) fn take_cables(mut cables: ResMut<Cables>, mut of: Query<(Entity, &mut Cable), Allow<Disabled>>) {
    let clock = of.iter().find_map(|(_, cable)| match &cable.state {
        State::Lent(lent) => Some(lent.time()),
        _ => None,
    });
    for (entity, mut cable) in &mut of {
        let State::Built(_) = cable.state else { continue };
        let state = &mut cable.state;
        if let State::Built(mut core) = core::mem::replace(state, State::Away) {
            // those in the set are lent, and do not tell it the time
            if let Some(time) = clock {
                let _ = core.set_time(time);
            }
            cables.fresh = true;
            let handle = cables.set.insert(*core);
            cables.links.cables.insert(handle, entity);
            if let Ok(lent) = cables.set.lend(handle) {
                *state = State::Lent(lent);
            }
        }
    }
}

/// What an attachment's entity asks, and what it has.
type Asked = (
    Entity,
    Ref<'static, Attachment>,
    Option<Ref<'static, OnCable>>,
    Option<Ref<'static, ToBody>>,
    Option<&'static Holds>,
    Has<Unable>,
);

/// Makes attachments hold what their entities ask, and ends those that ask no more.
pub(crate) fn bind(
    mut cables: ResMut<Cables>,
    mut physics: ResMut<Physics>,
    mut of: AllCables,
    attachments: Query<Asked>,
    handles: Query<Ref<BodyHandle>>,
    mut commands: Commands,
) {
    let cables = &mut *cables;
    bring_home(cables, &mut of);
    let fresh = core::mem::take(&mut cables.fresh);
    for (entity, attachment, on, to, holds, unable) in &attachments {
        let changed = attachment.is_changed()
            || on.as_ref().is_some_and(|on| on.is_changed())
            || to.as_ref().is_some_and(|to| to.is_changed())
            || fresh
            || to.as_ref().is_some_and(|to| handles.get(to.0).is_ok_and(|body| body.is_changed()));
        let body = to.as_ref().map(|to| to.0).filter(|_| !attachment.world);
        if let Some(&Holds(handle)) = holds {
            let Some(bound) = cables.links.attachments.get(&handle).copied() else {
                commands.entity(entity).remove::<Holds>();
                continue;
            };
            let same_body = match body {
                Some(body) => handles.get(body).is_ok_and(|b| b.handle == bound.handle),
                None => attachment.world && bound.body.is_none(),
            };
            if same_body && bound.made == *attachment && on.as_ref().is_some_and(|on| on.0 == bound.cable) {
                continue;
            }
            cables.links.attachments.remove(&handle);
            let _ = cables.set.detach(&mut physics, handle);
            commands.entity(entity).remove::<Holds>();
            let no_body = body.is_some_and(|body| handles.get(body).is_err());
            if on.is_none() || no_body || (body.is_none() && !attachment.world) {
                let gone = no_body || !physics.bodies.contains(bound.handle);
                let end = if gone { End::BodyGone } else { End::Released };
                let (cable, body) = (bound.cable, bound.body);
                cables.notices.push(Notice::Ended(AttachmentEnded { entity, cable, body, end }));
                continue;
            }
        } else if on.is_none() || (body.is_none() && !attachment.world) || (unable && !changed) {
            continue;
        }
        let Some(cable) = on.map(|on| on.0) else { continue };
        match hold(cables, &mut physics, &of, &handles, &attachment, entity, cable, body) {
            Ok(holds) => {
                commands.entity(entity).insert(holds).remove::<Unable>();
            }
            Err(error) => {
                commands.entity(entity).insert(Unable);
                cables.notices.push(Notice::NotAttached(AttachmentFailed { entity, error }));
            }
        }
    }
    lend_out(cables, &mut of);
}

/// Makes one attachment.
fn hold(
    cables: &mut Cables,
    physics: &mut Physics,
    of: &AllCables,
    handles: &Query<Ref<BodyHandle>>,
    attachment: &Attachment,
    entity: Entity,
    cable: Entity,
    body: Option<Entity>,
) -> Result<Holds, Error> {
    of.get(cable).map_err(|_| Error::NotACable(cable))?;
    let known = cables.links.cables.iter().find(|(_, e)| **e == cable).map(|(handle, _)| *handle);
    let known = known.ok_or(Error::NotBuilt)?;
    let rigid = match body {
        Some(body) => handles.get(body).map_err(|_| Error::NotABody(body))?.handle,
        None => ground(cables, physics),
    };
    let held = match attachment.anchor {
        Some(anchor) => cables.set.attach(physics, known, attachment.at, rigid, to_vector(&anchor), attachment.pin)?,
        None => cables.set.attach_here(physics, known, attachment.at, rigid, attachment.pin)?,
    };
    let bound = Bound { entity, cable, body, handle: rigid, made: *attachment, counted: 0.0 };
    cables.links.attachments.insert(held, bound);
    Ok(Holds(held))
}

/// The body that stands for the world.
fn ground(cables: &mut Cables, physics: &mut Physics) -> RigidBodyHandle {
    match cables.links.ground {
        Some(handle) if physics.bodies.contains(handle) => handle,
        _ => {
            let handle = physics.insert_body(RigidBodyBuilder::fixed().translation(Vector::ZERO));
            cables.links.ground = Some(handle);
            handle
        }
    }
}

/// Remembers where cables were before the step, for those that are drawn between steps.
pub(crate) fn remember(mut drawn: Query<(&Cable, &mut Interpolate)>) {
    for (cable, mut interpolate) in &mut drawn {
        interpolate.remember(cable);
    }
}
