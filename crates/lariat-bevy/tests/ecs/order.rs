//! Neither the order of spawning nor the number of threads changes a bit.

use super::common::{bits, cube, soft, steps, world};
use bevy_ecs::prelude::*;
use bevy_ecs::schedule::{Schedules, SingleThreadedExecutor};
use lariat_bevy::lariat_ancf::Fidelity;
use lariat_bevy::rapier::prelude::ColliderBuilder;
use lariat_bevy::{At, Attachment, Bending, Body, BodyPose, CableStep, RapierStep};

/// Three loads on cables of one beam body, which lies on the ground, spawned in an order.
fn run(order: [usize; 3], one_thread: bool) -> Vec<u64> {
    let mut world = world();
    if one_thread {
        let mut schedules = world.resource_mut::<Schedules>();
        schedules.get_mut(CableStep).unwrap().set_executor(SingleThreadedExecutor::new());
        schedules.get_mut(RapierStep).unwrap().set_executor(SingleThreadedExecutor::new());
    }
    world.spawn(Body::fixed().at([0.0, -2.0, 0.0]).with(ColliderBuilder::cuboid(10.0, 0.5, 10.0)));
    let beam = world.spawn(Body::dynamic().with(ColliderBuilder::cuboid(2.0, 0.1, 0.1).mass(30.0))).id();
    let mut ends = [(Entity::PLACEHOLDER, Entity::PLACEHOLDER); 3];
    for k in order {
        let x = k as f64 - 1.0;
        let load = world.spawn(cube(0.1, 1.0 + k as f32, [x, -1.2, 0.0])).id();
        let cable = world.spawn((soft([x, -0.1, 0.0], [x, -1.1, 0.0]).fidelity(Fidelity::Game), Bending)).id();
        world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0]));
        world.spawn(Attachment::ball(cable, At::Start).to(beam).at([x, -0.1, 0.0]));
        ends[k] = (cable, load);
    }
    steps(&mut world, 60);
    ends.iter()
        .flat_map(|(cable, load)| {
            let pose = world.get::<BodyPose>(*load).unwrap().position;
            bits(&world, *cable).into_iter().chain([pose.x, pose.y, pose.z].map(f64::to_bits)).collect::<Vec<_>>()
        })
        .collect()
}

#[test]
fn the_order_of_spawning_does_not_change_a_bit() {
    let first = run([0, 1, 2], false);
    assert!(first == run([2, 0, 1], false));
    assert!(first == run([2, 1, 0], false));
}

#[test]
fn the_number_of_threads_does_not_change_a_bit() {
    assert!(run([0, 1, 2], false) == run([0, 1, 2], true));
}
