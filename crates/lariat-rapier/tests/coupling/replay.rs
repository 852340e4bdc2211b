//! The same start gives the same bits; so does a snapshot.

use super::bench::{add_cube, bits, cable, run, soft};
use lariat_rapier::lariat_ancf::At;
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

/// A payload that swings into a wall, and two bodies on a cable lying on the ground.
fn scene() -> (PhysicsWorld, CableSet) {
    let mut world = PhysicsWorld::new();
    let ground = RigidBodyBuilder::fixed().translation(Vector::new(0.0, -2.5, 0.0));
    world.insert(ground, ColliderBuilder::cuboid(10.0, 0.5, 10.0));
    let wall = RigidBodyBuilder::fixed().translation(Vector::new(0.2, -1.6, 0.0));
    world.insert(wall, ColliderBuilder::cuboid(0.1, 0.8, 1.0));
    let load = add_cube(&mut world, 20.0, 0.1, [1.6, -0.1, 0.0]);
    let pair = [add_cube(&mut world, 1.0, 0.1, [3.0, -1.9, 0.0]), add_cube(&mut world, 4.0, 0.1, [4.2, -1.5, 0.3])];
    let mut set = CableSet::new();
    let sling = set.insert(cable([0.0; 3], [1.6, 0.0, 0.0], soft()).fix(At::Start).build().unwrap());
    set.attach(&world, sling, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    let tie = set.insert(cable([3.1, -1.9, 0.0], [4.1, -1.5, 0.3], soft()).length(1.2).build().unwrap());
    set.attach(&world, tie, At::Start, pair[0], Vector::new(0.1, 0.0, 0.0), AttachmentKind::Ball).unwrap();
    set.attach(&world, tie, At::End, pair[1], Vector::new(-0.1, 0.0, 0.0), AttachmentKind::Ball).unwrap();
    (world, set)
}

/// 1.5 s with impacts, twice.
///
/// *Source.* The contract: one start, one run.
#[test]
fn two_runs_give_the_same_bits() {
    let [a, b] = [0, 1].map(|_| {
        let (mut world, mut set) = scene();
        run(&mut world, &mut set, 90);
        bits(&world, &set)
    });
    assert!(a == b);
}

/// World and set through bincode every quarter of a second, impacts and friction included: the run goes on bitwise as one that was left alone.
///
/// *Source.* The contract.
#[test]
fn a_snapshot_replays_bitwise() {
    let (mut world, mut set) = scene();
    let (mut other_world, mut other_set) = scene();
    for k in 0..6 {
        run(&mut world, &mut set, 15);
        run(&mut other_world, &mut other_set, 15);
        assert!(bits(&world, &set) == bits(&other_world, &other_set), "quarter {k}");
        let saved = bincode::serialize(&(&other_world, &other_set)).unwrap();
        (other_world, other_set) = bincode::deserialize(&saved).unwrap();
    }
}
