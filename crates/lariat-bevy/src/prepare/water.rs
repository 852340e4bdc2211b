//! Gives the set the water and the bodies in it that a resource and components describe.

use crate::body::BodyHandle;
use crate::cables::Cables;
use crate::event::WaterFailed;
use crate::physics::Physics;
use crate::water::{InWater, Sea};
use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::entity::Entity;
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::prelude::{Query, Ref, Res, ResMut, With};
use bevy_ecs::query::Allow;
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::water::BodiesInWater;

/// Fills, changes and empties the water, and puts bodies into it.
pub(crate) fn update(
    mut cables: ResMut<Cables>,
    mut physics: ResMut<Physics>,
    sea: Option<Res<Sea>>,
    bodies: Query<(Entity, Ref<InWater>, Ref<BodyHandle>)>,
    in_water: Query<(), (With<InWater>, Allow<Disabled>)>,
) {
    let Some(sea) = sea else {
        if let Some(mut water) = cables.set.set_water(None) {
            let inside: Vec<_> = water.bodies().collect();
            inside.into_iter().for_each(|body| _ = water.remove(&mut physics, body));
        }
        return;
    };
    let Cables { set, links, .. } = &mut *cables;
    if let Some(water) = set.water_mut() {
        let without = |body| links.bodies.get(&body).is_some_and(|entity| in_water.get(*entity).is_err());
        let removed: Vec<RigidBodyHandle> = water.bodies().filter(|body| without(*body)).collect();
        removed.into_iter().for_each(|body| _ = water.remove(&mut physics, body));
    }
    let is_new = cables.set.water().is_none();
    if sea.is_changed() || is_new {
        let outcome = match cables.set.water_mut() {
            Some(water) => water.set_water(sea.0.clone()),
            None => BodiesInWater::new(sea.0.clone()).map(|water| _ = cables.set.set_water(water)),
        };
        if let Err(error) = outcome {
            cables.events.push(WaterFailed { entity: Entity::PLACEHOLDER, error: error.into() }.into());
        }
    }
    for (entity, own, body) in &bodies {
        let Some(water) = cables.set.water_mut() else { return };
        // one that was restored is in it as it was
        let known = water.immersed(body.handle) == Some(&own.0);
        if !(own.is_changed() || (body.is_changed() || is_new) && !known) {
            continue;
        }
        if let Err(error) = water.insert(&mut physics, body.handle, own.0) {
            cables.events.push(WaterFailed { entity, error: error.into() }.into());
        }
    }
}
