//! New bodies, and targets of kinematic bodies.

use crate::body::{Body, BodyHandle, BodyPose, KinematicTarget};
use crate::cables::Cables;
use crate::physics::Physics;
use bevy_ecs::entity::Entity;
use bevy_ecs::name::Name;
use bevy_ecs::prelude::{Added, Changed, Commands, Query, ResMut, Without};

/// Returns a key that orders new bodies independently of the order of spawning: name, position,
/// velocity and rotation.
fn order(name: Option<&Name>, body: &Body) -> (String, [u32; 7]) {
    let rigid = body.rigid.build();
    let (x, v) = (rigid.translation(), rigid.linvel());
    let numbers = [x.x, x.y, x.z, v.x, v.y, v.z, rigid.rotation().w];
    (name.map(|n| n.as_str().to_string()).unwrap_or_default(), numbers.map(f32::to_bits))
}

/// Adds new bodies to Rapier's world, and sets the targets of kinematic ones.
pub(crate) fn update(
    mut cables: ResMut<Cables>,
    mut physics: ResMut<Physics>,
    mut new: Query<(Entity, &Body, Option<&Name>, &mut BodyPose), Without<BodyHandle>>,
    external: Query<(Entity, &BodyHandle), Added<BodyHandle>>,
    targets: Query<(&BodyHandle, &KinematicTarget), Changed<KinematicTarget>>,
    mut commands: Commands,
) {
    for (entity, body) in &external {
        cables.links.bodies.insert(body.handle, entity);
    }
    let mut ordered: Vec<_> = new.iter().map(|(entity, body, name, _)| (order(name, body), entity)).collect();
    ordered.sort();
    for (_, entity) in ordered {
        let Ok((_, body, _, mut pose)) = new.get_mut(entity) else { continue };
        let handle = physics.insert_body(body.rigid.build());
        for collider in &body.colliders {
            physics.insert_collider(collider.clone(), Some(handle));
        }
        pose.read(&physics.bodies[handle], true);
        cables.links.bodies.insert(handle, entity);
        commands.entity(entity).insert(BodyHandle { handle });
    }
    for (body, target) in &targets {
        if let Some(rigid) = physics.bodies.get_mut(body.handle) {
            rigid.set_next_kinematic_position(target.pose());
        }
    }
}
