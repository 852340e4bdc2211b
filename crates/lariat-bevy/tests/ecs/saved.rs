//! Snapshots that are written, and loaded into another world.

use super::common::{bits, cable_of, pin, soft, steps, world};
use super::scene::{ask, damped, scene};
use bevy_ecs::message::Messages;
use bevy_ecs::name::Name;
use bevy_ecs::prelude::*;
use lariat_ancf::effect::{CablePoint, ForceDensity};
use lariat_ancf::seal::seal;
use lariat_ancf::{Error as Mechanics, Vector3};
use lariat_bevy::event::{
    AttachmentFailed, CableBroken, DrumFailed, JunctionFailed, SheaveFailed, StepFailed, WaterFailed,
};
use lariat_bevy::rapier::prelude::RigidBodyBuilder;
use lariat_bevy::{
    BodyHandle, BodyPose, Cables, Drag, Drum, Error, InWater, KinematicTarget, Physics, Reel, SheaveAlong, Snapshot,
    lariat_ancf,
};
use std::collections::BTreeMap;
use std::sync::Arc;

/// What no step of the library knows.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
struct Mine(usize);

/// Names and bits of cables.
type CableBits = Vec<(String, Vec<u64>)>;

/// Bits of cables and bodies after a step, and numbers of events in it.
type Step = (CableBits, Vec<Vec<u32>>, [usize; 6]);

/// Bits of all cables and bodies, in the order of their handles.
fn state(world: &World) -> (CableBits, Vec<Vec<u32>>) {
    let cables = world.resource::<Cables>();
    let of =
        |cable: &lariat_ancf::Cable| cable.positions().iter().chain(cable.velocities()).map(|x| x.to_bits()).collect();
    let cables = cables.iter().map(|(_, cable)| (cable.name().to_string(), of(cable))).collect();
    let bodies = &world.resource::<Physics>().bodies;
    let bodies = bodies.iter().map(|(_, body)| {
        let (x, r, v, w) = (body.translation(), body.rotation(), body.linvel(), body.angvel());
        [x.x, x.y, x.z, r.x, r.y, r.z, r.w, v.x, v.y, v.z, w.x, w.y, w.z].map(f32::to_bits).to_vec()
    });
    (cables, bodies.collect())
}

/// The numbers of events since the last call.
fn events(world: &mut World) -> [usize; 6] {
    [
        world.resource_mut::<Messages<AttachmentFailed>>().drain().count(),
        world.resource_mut::<Messages<JunctionFailed>>().drain().count(),
        world.resource_mut::<Messages<SheaveFailed>>().drain().count(),
        world.resource_mut::<Messages<DrumFailed>>().drain().count(),
        world.resource_mut::<Messages<WaterFailed>>().drain().count(),
        world.resource_mut::<Messages<CableBroken>>().drain().count(),
    ]
}

/// Steps with the kinematic body on its way, and notes the state after each step.
fn run(world: &mut World, crane: Entity) -> Vec<Step> {
    let step = |k: usize| {
        world.get_mut::<KinematicTarget>(crane).unwrap().position.x = 0.002 * k as f64;
        steps(world, 1);
        let (cables, bodies) = state(world);
        (cables, bodies, events(world))
    };
    (0..60).map(step).collect()
}

/// A world with entities of the user, with their numbers.
fn other_world() -> (World, Vec<Entity>) {
    let mut world = world();
    let mine = (0..120).map(|k| world.spawn((Mine(k), Name::new("mine"))).id()).collect();
    (world, mine)
}

/// Why a cable was not built.
fn reason(world: &World, cable: Entity) -> Mechanics {
    match world.resource::<Cables>().get(cable) {
        Err(Error::NotBuilt { reason, .. }) => reason,
        other => panic!("{other:?}"),
    }
}

fn untouched(world: &World, mine: &[Entity]) {
    for (k, entity) in mine.iter().enumerate() {
        let entity = world.entity(*entity);
        assert!(entity.get() == Some(&Mine(k)) && entity.archetype().components().len() == 2);
    }
}

/// A scene with one of everything goes through bytes and JSON into worlds whose entities have the same numbers, and into one
/// that ran a scene of its own: it goes on to the bit, with the same events; the entities of these worlds are as they were.
#[test]
fn a_loaded_snapshot_goes_on_to_the_bit() {
    let mut world = world();
    let made = scene(&mut world);
    steps(&mut world, 25);
    ask(&mut world);
    let snapshot = Snapshot::take(&mut world).unwrap();
    events(&mut world);
    let bytes = snapshot.to_bytes().unwrap();
    let json = serde_json::to_string(&snapshot).unwrap();
    println!("{} bytes, {} of JSON", bytes.len(), json.len());
    let once = run(&mut world, made.crane);
    let broken = once.iter().position(|(_, _, events)| events[5] > 0);
    assert!(broken.is_some_and(|step| step > 1), "broken in step {broken:?}");
    assert!(once[1..].iter().all(|(_, _, events)| events[..5] == [0; 5]), "what failed was tried again");

    let reasons = made.not_built.map(|cable| reason(&world, cable));
    assert!(matches!(reasons, [Mechanics::InvalidValue { value: -1.0, .. }, Mechanics::TooFewPoints { count: 0, .. }]));
    let load = |snapshot: &Snapshot, world: &mut World, mine: &[Entity]| {
        let names = snapshot.restore(world).unwrap();
        assert!(mine.iter().any(|entity| names.contains_key(entity)), "no number is that of a saved entity");
        assert!(mine.iter().all(|entity| !names.values().any(|new| new == entity)));
        untouched(world, mine);
        assert_eq!(world.get::<Name>(names[&made.hoist]).unwrap().as_str(), "hoist");
        assert!(world.get::<BodyHandle>(names[&made.load]).is_some());
        assert_eq!(world.get::<Drum>(names[&made.wound]).unwrap().body, names[&made.wheel]);
        assert_eq!(made.not_built.map(|cable| reason(world, names[&cable])), reasons);
        assert!(world.get::<SheaveAlong>(names[&made.far]).is_some());
        events(world);
        let again = run(world, names[&made.crane]);
        for (k, (then, now)) in once.iter().zip(&again).enumerate() {
            let differs = then.0.iter().zip(&now.0).position(|(a, b)| a != b);
            assert!(
                then == now,
                "step {k}: {} and {} cables, number {differs:?} {:?} {:?}",
                then.0.len(),
                now.0.len(),
                then.2,
                now.2
            );
        }
        untouched(world, mine);
        names
    };
    let read: [Snapshot; 2] = [Snapshot::from_bytes(&bytes).unwrap(), serde_json::from_str(&json).unwrap()];
    assert_eq!(read[0].to_bytes().unwrap(), bytes);
    for loaded in &read {
        let (mut new, mine) = other_world();
        load(loaded, &mut new, &mine);
        // once more, into the world where it is already
        let names = load(loaded, &mut new, &mine);
        assert_eq!(new.resource::<Cables>().get(names[&made.hoist]).unwrap().name(), "hoist");
    }
    // into a world that ran, and one that was taken there
    let (mut busy, mine) = other_world();
    let own = scene(&mut busy);
    steps(&mut busy, 10);
    let own_snapshot = Snapshot::take(&mut busy).unwrap();
    let names = load(&read[0], &mut busy, &mine);
    assert!(busy.get_entity(own.hoist).is_err() && busy.get_entity(own.float).is_err());
    load(&snapshot, &mut busy, &mine);
    assert!(names.values().all(|old| busy.get_entity(*old).is_err()));
    let names = own_snapshot.restore(&mut busy).unwrap();
    assert!(busy.get::<BodyPose>(names[&own.load]).is_some());

    // its own world keeps its entities
    let names = snapshot.restore(&mut world).unwrap();
    assert!(names.is_empty(), "{names:?}");
    assert!(run(&mut world, made.crane) == once);
}

/// Components that were removed just before the snapshot are not brought back by what the cables still have.
#[test]
fn what_was_removed_before_the_snapshot_stays_removed() {
    let mut world = world();
    let made = scene(&mut world);
    steps(&mut world, 10);
    world.entity_mut(made.reeled).remove::<Reel>();
    world.entity_mut(made.float).remove::<InWater>();
    world.entity_mut(made.hoist).remove::<Drag>();
    world.despawn(made.load);
    world.entity_mut(made.wound).remove::<Drum>();
    world.resource_mut::<Cables>().cut(made.hoist, 1.0).unwrap();
    let snapshot = Snapshot::take(&mut world).unwrap();
    let bytes = snapshot.to_bytes().unwrap();
    events(&mut world);
    let once = run(&mut world, made.crane);
    let (mut new, mine) = other_world();
    let names = Snapshot::from_bytes(&bytes).unwrap().restore(&mut new).unwrap();
    let again = run(&mut new, names[&made.crane]);
    assert!(once.iter().zip(&again).all(|(a, b)| a.0 == b.0 && a.1 == b.1 && a.2[..5] == b.2[..5]));
    assert!(once.iter().all(|(_, _, events)| events[..5] == [0; 5]), "what failed was tried again");
    assert!(new.resource::<Cables>().set().drums().next().is_none());
    untouched(&new, &mine);
}

/// Every bit that flips and every end that is missing is refused, as a world of another kind is; bytes that are sealed and no
/// snapshot are refused, too, and none panics.
#[test]
fn damaged_bytes_are_refused() {
    let mut world = world();
    let made = scene(&mut world);
    steps(&mut world, 3);
    let bytes = Snapshot::take(&mut world).unwrap().to_bytes().unwrap();
    for k in 0..240 {
        let mut damaged = bytes.clone();
        // the first line whole, then all through
        let at = if k < 60 { k } else { (k - 60) * (bytes.len() - 1) / 179 };
        damaged[at] ^= 1 << (k % 8);
        assert!(matches!(Snapshot::from_bytes(&damaged), Err(Error::Seal(_))), "byte {at}");
        assert!(matches!(Snapshot::from_bytes(&bytes[..at]), Err(Error::Seal(_))), "byte {at}");
    }
    assert!(matches!(Snapshot::from_bytes(b""), Err(Error::Seal(_))));
    assert!(matches!(Snapshot::from_bytes(&seal("cable", b"{}")), Err(Error::Seal(_))));
    assert!(matches!(Snapshot::from_bytes(&seal("bevy snapshot", b"{}")), Err(Error::NotASnapshot(_))));
    let body = bytes.iter().position(|byte| *byte == b'\n').unwrap() + 1;
    let (mut read, mut refused) = (0, 0);
    for k in 0..400 {
        let mut damaged = bytes[body..].to_vec();
        let at = k * (damaged.len() - 1) / 399;
        damaged[at] ^= 1 << (k % 8);
        match Snapshot::from_bytes(&seal("bevy snapshot", &damaged)) {
            Ok(_) => read += 1,
            Err(error) => refused += usize::from(matches!(error, Error::NotASnapshot(_))),
        }
        assert!(Snapshot::from_bytes(&seal("bevy snapshot", &damaged[..at])).is_err());
    }
    assert_eq!(read + refused, 400);
    assert!(bits(&world, made.hoist).len() > 1);
}

/// What contradicts itself is refused when it is read, although it is well formed.
#[test]
fn a_snapshot_that_contradicts_itself_is_refused() {
    let mut world = world();
    world.spawn(soft([0.0; 3], [1.0, 0.0, 0.0]));
    steps(&mut world, 1);
    let snapshot = Snapshot::take(&mut world).unwrap();
    let written = serde_json::to_value(&snapshot).unwrap();
    let read =
        |value: serde_json::Value| serde_json::from_value::<Snapshot>(value).map(|_| ()).map_err(|e| e.to_string());
    assert_eq!(read(written.clone()), Ok(()));
    let mut twice = written.clone();
    let first = twice["entities"][0].clone();
    twice["entities"].as_array_mut().unwrap().push(first);
    assert!(read(twice).unwrap_err().contains("more than once"));
    let mut lost = written.clone();
    lost["links"]["cables"][0][0] = 7.into();
    assert!(read(lost).unwrap_err().contains("not in the set"));
    let mut swapped = written;
    swapped["links"]["cables"][0][1]["entity"] = 99.into();
    assert!(read(swapped).unwrap_err().contains("that of another"));
}

/// A body of the user in Rapier's world, which no component describes, is that of the loaded world; a handle of the world before
/// is none any more.
#[test]
fn handles_of_the_world_before_are_removed() {
    let mut world = world();
    let handle = world.resource_mut::<Physics>().insert_body(RigidBodyBuilder::dynamic());
    let own = world.spawn(BodyHandle::external(handle)).id();
    steps(&mut world, 2);
    let snapshot = Snapshot::take(&mut world).unwrap();
    let mut new = super::common::world();
    let old = new.resource_mut::<Physics>().insert_body(RigidBodyBuilder::dynamic());
    let old = new.spawn((BodyHandle::external(old), Mine(0))).id();
    let names: BTreeMap<Entity, Entity> = snapshot.restore(&mut new).unwrap();
    assert_eq!(new.get::<BodyHandle>(names[&own]).unwrap().handle(), handle);
    assert!(new.get::<BodyHandle>(old).is_none() && new.get::<Mine>(old).is_some());
}

/// A constant force per length.
#[derive(Debug)]
struct Push;

impl ForceDensity for Push {
    fn force(&self, _: &CablePoint) -> Vector3<f64> {
        Vector3::new(0.0, 0.0, 2.0)
    }

    fn depends_on_velocity(&self) -> bool {
        false
    }
}

/// A cable with a function of the user waits for it after a load, while all else goes on, and goes on where it was.
#[test]
fn a_loaded_cable_waits_for_its_function() {
    let mut world = world();
    let [pushed, other] = [0.0, 3.0].map(|z| world.spawn((soft([0.0, 0.0, z], [1.6, 0.0, z]), damped())).id());
    world.spawn(pin(pushed));
    world.spawn(pin(other));
    let push = |world: &mut World, cable: Entity| {
        world.resource_mut::<Cables>().get_mut(cable).unwrap().add_force_density(Arc::new(Push)).unwrap();
    };
    push(&mut world, pushed);
    steps(&mut world, 10);
    let bytes = Snapshot::take(&mut world).unwrap().to_bytes().unwrap();
    let mut new = super::common::world();
    let names = Snapshot::from_bytes(&bytes).unwrap().restore(&mut new).unwrap();
    let waiting = bits(&new, names[&pushed]);
    steps(&mut new, 1);
    let failed: Vec<StepFailed> = new.resource_mut::<Messages<StepFailed>>().drain().collect();
    assert!(matches!(failed[..], [StepFailed { entity, .. }] if entity == names[&pushed]), "{failed:?}");
    steps(&mut world, 1);
    assert!(bits(&new, names[&pushed]) == waiting && bits(&new, names[&other]) == bits(&world, other));
    push(&mut new, names[&pushed]);
    steps(&mut new, 1);
    assert_eq!(new.resource::<Messages<StepFailed>>().len(), 0);
    let [here, there] =
        [(&world, pushed), (&new, names[&pushed])].map(|(world, cable)| cable_of(world, cable).positions());
    let apart = here.iter().zip(there).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(apart < 1e-12, "{apart:e}");
}
