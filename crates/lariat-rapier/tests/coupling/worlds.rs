//! A set belongs to the world that its attachments were made in.

use super::common::{add_cube, bits, cable, run, soft};
use lariat_rapier::lariat_ancf::At;
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableSet, Error, Event, Gap};

/// Returns a load on a cable, x (m) from its middle.
fn scene(x: Real) -> (PhysicsWorld, CableSet, RigidBodyHandle, AttachmentHandle) {
    let mut world = PhysicsWorld::new();
    let load = add_cube(&mut world, 5.0, 0.1, [x, -0.1, 0.0]);
    let mut set = CableSet::new();
    let rope = cable([0.0; 3], [2.0, 0.0, 0.0], soft()).fix(At::Start).build().unwrap();
    let rope = set.insert(rope);
    let closing = AttachmentKind::Ball.with_gap(Gap::Close);
    let held = set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), closing).unwrap();
    (world, set, load, held)
}

/// Steps a set on a wrong world, and checks that nothing changes and that it goes on in its own.
fn refuses(set: &mut CableSet, world: &mut PhysicsWorld, other: &mut PhysicsWorld, held: AttachmentHandle) {
    let before = (bits(world, set), bits(other, set));
    let bodies = other.bodies.len();
    for _ in 0..3 {
        assert_eq!(set.step(other), Err(Error::OtherWorld));
    }
    assert!(before == (bits(world, set), bits(other, set)));
    assert_eq!(other.bodies.len(), bodies);
    assert!(set.attachment(held).is_ok() && set.attachments().count() == 1);
    run(world, set, 5);
}

/// Worlds that are empty, hold other bodies under the same handles, or were stepped with another set;
/// before the first step of the set and after it.
#[test]
fn a_step_on_another_world_is_an_error_that_keeps_the_attachments() {
    let (mut world, mut set, load, held) = scene(2.0);
    refuses(&mut set, &mut world, &mut PhysicsWorld::new(), held);
    let (mut same_handles, ..) = scene(2.0);
    assert!(same_handles.bodies.contains(load));
    refuses(&mut set, &mut world, &mut same_handles, held);
    let (mut stepped, mut its_own, ..) = scene(1.9);
    run(&mut stepped, &mut its_own, 7);
    refuses(&mut set, &mut world, &mut stepped, held);
    let (elsewhere, rope) = (add_cube(&mut same_handles, 1.0, 0.1, [0.0; 3]), set.attachment(held).unwrap().cable());
    let attached = set.attach(&same_handles, rope, 1.0, elsewhere, Vector::ZERO, AttachmentKind::Ball);
    assert_eq!(attached, Err(Error::OtherWorld));
    // without attachments any world will do
    set.detach(&mut world, held).unwrap();
    assert_eq!(world.bodies.len(), 1);
    run(&mut PhysicsWorld::new(), &mut set, 3);
}

/// A body that is removed before the first step ends its attachment, as at any other time.
#[test]
fn a_body_that_is_removed_before_the_first_step_ends_its_attachment() {
    let (mut world, mut set, load, held) = scene(2.0);
    world.remove_body(load);
    set.step(&mut world).unwrap();
    assert_eq!(set.events(), [Event::AttachmentEnded { attachment: held, body: load }]);
    assert_eq!(world.bodies.len(), 0);
}

/// A snapshot of world and set, made before or after the first step, steps on; and a detachment with
/// the wrong world leaves that world alone.
#[test]
fn snapshots_of_world_and_set_belong_together() {
    let (mut world, mut set, _, held) = scene(2.0);
    for _ in 0..2 {
        let bytes = bincode::serialize(&(&world, &set)).unwrap();
        run(&mut world, &mut set, 10);
        let (mut world_then, mut set_then): (PhysicsWorld, CableSet) = bincode::deserialize(&bytes).unwrap();
        run(&mut world_then, &mut set_then, 10);
        assert!(bits(&world, &set) == bits(&world_then, &set_then));
    }
    let (mut other, ..) = scene(2.0);
    let before = bits(&other, &set);
    set.detach(&mut other, held).unwrap();
    assert!(before == bits(&other, &set) && other.bodies.len() == 1);
}
