//! Runs and snapshots repeat to the bit.

use super::common::{add_cube, bits, cable, run, soft};
use lariat_rapier::lariat_ancf::At;
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

/// Returns a payload that swings into a wall, and two bodies on a cable lying on the ground.
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
/// Reference: the contract.
#[test]
fn two_runs_are_equal_to_the_bit() {
    let [a, b] = [0, 1].map(|_| {
        let (mut world, mut set) = scene();
        run(&mut world, &mut set, 90);
        bits(&world, &set)
    });
    assert!(a == b);
}

/// World and set go through bincode every quarter of a second, with impacts and friction: the run
/// continues like one that was left alone.
///
/// Reference: the contract.
#[test]
fn a_snapshot_replays_to_the_bit() {
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

/// The scene and twelve islands more (loads on ropes, two loads on one rope, ropes without a load) on pools of 1, 2 and 4 threads.
///
/// Reference: the contract; islands do not act on each other while they are integrated.
#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let runs = [1, 2, 4].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let (mut world, mut set) = scene();
            for k in 0..12 {
                let (z, length) = (10.0 + 3.0 * f64::from(k), 1.0 + 0.1 * f64::from(k));
                let rope = cable([0.0, 0.0, z], [length, 0.0, z], soft()).elements(3 + k as usize);
                let rope = set.insert(rope.fix(At::Start).build().unwrap());
                for at in [1.0, 0.6].into_iter().take(k as usize % 3) {
                    let load = add_cube(&mut world, 2.0, 0.1, [(at * length) as Real, -0.1, z as Real]);
                    let anchor = Vector::new(0.0, 0.1, 0.0);
                    set.attach(&world, rope, at * length, load, anchor, AttachmentKind::Ball).unwrap();
                }
            }
            run(&mut world, &mut set, 30);
            bits(&world, &set)
        })
    });
    assert!(runs[0] == runs[1] && runs[0] == runs[2]);
}
