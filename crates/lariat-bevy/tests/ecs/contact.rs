//! Contact of cables with the bodies of a world.

use super::common::{cable_of, soft, steps, world};
use bevy_ecs::prelude::*;
use lariat_bevy::event::{ContactEnded, ContactStarted};
use lariat_bevy::rapier::prelude::ColliderBuilder;
use lariat_bevy::{Body, Contact};

/// A cable with the component lies down on a fixed body, whose entity the event names, and falls when the component is removed.
///
/// *Source.* Geometry: the radius of the cable is 5 mm.
#[test]
fn a_cable_with_contact_lies_on_a_fixed_body_until_the_component_is_removed() {
    let mut world = world();
    let floor = world.spawn(Body::fixed().with(ColliderBuilder::cuboid(3.0, 0.5, 3.0))).id();
    let cable = world.spawn((soft([-1.0, 0.6, 0.0], [1.0, 0.6, 0.0]), Contact::with_friction(0.3))).id();
    steps(&mut world, 120);
    let began: Vec<_> = world.resource_mut::<Messages<ContactStarted>>().drain().collect();
    assert!(!began.is_empty() && began.iter().all(|e| e.entity == cable && e.body == Some(floor)), "{began:?}");
    let height = cable_of(&world, cable).node_position(5).y;
    assert!((height - 0.505).abs() < 1e-4, "{height}");
    world.entity_mut(cable).remove::<Contact>();
    steps(&mut world, 30);
    let ended: Vec<_> = world.resource_mut::<Messages<ContactEnded>>().drain().collect();
    assert!(matches!(ended[..], [ContactEnded { entity, .. }] if entity == cable), "{ended:?}");
    assert!(cable_of(&world, cable).node_position(5).y < 0.0);
}
