//! Cables tied to each other by components.

use super::common::{bits, cable_of, cube, height, pin, soft, steps, world};
use bevy_ecs::prelude::*;
use lariat_bevy::event::{CableBroken, JunctionEnded, JunctionFailed};
use lariat_bevy::lariat_ancf::Vector3;
use lariat_bevy::{
    At, Attachment, Bending, BreakTension, Cables, Damping, Error, Gap, Junction, KinkAlong, OnCable, Rope, Snapshot,
    SpawnRope, lariat_rapier,
};

/// Two ropes from the world to one point, and a third from there to a crate, tied by a junction:
/// the three ropes, the junction and the crate.
fn bridle(world: &mut World) -> ([Entity; 3], Entity, Entity) {
    let load = world.spawn(cube(0.1, 5.0, [0.0, -2.1, 0.0])).id();
    let knot = [0.0, -1.0, 0.0];
    let mut rope = |from, to| world.spawn((soft(from, to), Bending, Damping::critical_fraction(1.0))).id();
    let ropes = [rope([-1.0, 0.0, 0.0], knot), rope([1.0, 0.0, 0.0], knot), rope(knot, [0.0, -2.0, 0.0])];
    world.spawn(pin(ropes[0]));
    world.spawn(pin(ropes[1]));
    world.spawn(Attachment::ball(ropes[2], At::End).to(load).at([0.0, 0.1, 0.0]));
    let tie = Junction::between((ropes[0], At::End), (ropes[1], At::End)).and((ropes[2], At::Start));
    (ropes, world.spawn(tie).id(), load)
}

fn point(world: &World, cable: Entity, s: f64) -> Vector3<f64> {
    cable_of(world, cable).sample(s).unwrap().position
}

/// The three ropes meet in one point, and share the weight of crate and hanger.
///
/// *Source.* The triangle of forces: 2 T sin 45 = (M + m) g, but for the sag of the ropes.
#[test]
fn a_junction_ties_three_ropes() {
    let mut world = world();
    let (ropes, ..) = bridle(&mut world);
    steps(&mut world, 300);
    let knot = point(&world, ropes[2], 0.0);
    for rope in &ropes[..2] {
        assert!((point(&world, *rope, 2.0_f64.sqrt()) - knot).norm() < 1e-6);
        let tension = cable_of(&world, *rope).sample(1.4).unwrap().tension;
        let expected = (5.0 + 0.314 + 0.444) * 9.81 / 2.0_f64.sqrt();
        assert!((tension / expected - 1.0).abs() < 0.03, "{tension} N, by hand {expected} N");
    }
}

#[test]
fn a_removed_or_despawned_junction_unties_its_ropes() {
    for despawn in [false, true] {
        let mut world = world();
        let (ropes, tie, load) = bridle(&mut world);
        steps(&mut world, 60);
        let before = height(&world, load);
        if despawn {
            world.despawn(tie);
        } else {
            world.entity_mut(tie).remove::<Junction>();
        }
        steps(&mut world, 31);
        assert!(before - height(&world, load) > 1.0);
        assert!((point(&world, ropes[0], 2.0_f64.sqrt()) - point(&world, ropes[2], 0.0)).norm() > 0.5);
    }
}

/// Of three tied cables one is despawned: the other two stay tied; of two, the junction ends.
#[test]
fn a_junction_keeps_the_cables_that_are_left_and_ends_with_the_last_pair() {
    let mut world = world();
    let (ropes, tie, load) = bridle(&mut world);
    steps(&mut world, 60);
    world.despawn(ropes[0]);
    steps(&mut world, 120);
    let taut = (point(&world, ropes[1], 2.0_f64.sqrt()) - point(&world, ropes[2], 0.0)).norm();
    assert!(taut < 1e-6 && height(&world, load) > -3.0, "{taut} m");
    assert_eq!(world.resource::<Messages<JunctionEnded>>().len(), 0);
    world.despawn(ropes[1]);
    steps(&mut world, 31);
    let ended: Vec<JunctionEnded> = world.resource_mut::<Messages<JunctionEnded>>().drain().collect();
    assert_eq!(ended, [JunctionEnded { entity: tie }]);
    assert!(height(&world, load) < -3.0);
}

#[test]
fn an_impossible_junction_fails_once_with_its_cause_and_is_retried_when_it_changes() {
    let mut world = world();
    let [a, b] = [0.0, 1.0].map(|z| world.spawn(soft([0.0, 0.0, z], [1.0, 0.0, z])).id());
    let rock = world.spawn_empty().id();
    let far = world.spawn(Junction::between((a, At::Start), (b, At::Start))).id();
    let lost = world.spawn(Junction::between((a, At::End), (rock, At::End))).id();
    steps(&mut world, 5);
    let failures: Vec<JunctionFailed> = world.resource_mut::<Messages<JunctionFailed>>().drain().collect();
    let of = |entity: Entity| failures.iter().find(|f| f.entity == entity).map(|f| &f.error).unwrap();
    assert_eq!(failures.len(), 2);
    let Error::Coupling(lariat_rapier::Error::GapTooLong { gap: 1.0, .. }) = of(far) else { panic!("{}", of(far)) };
    assert_eq!(of(lost), &Error::NotACable(rock));
    world.get_mut::<Junction>(far).unwrap().gap = Gap::Close;
    steps(&mut world, 60);
    assert!((point(&world, a, 0.0) - point(&world, b, 0.0)).norm() < 1e-6);
    // a point belongs to one junction
    let third = world.spawn(soft([0.0, 0.0, 2.0], [1.0, 0.0, 2.0])).id();
    world.spawn(Junction::between((a, At::Start), (third, At::Start)).gap(Gap::Close));
    steps(&mut world, 1);
    let failures: Vec<JunctionFailed> = world.resource_mut::<Messages<JunctionFailed>>().drain().collect();
    assert!(
        failures.iter().any(|f| matches!(f.error, Error::Coupling(lariat_rapier::Error::AlreadyAttached { .. }))),
        "{failures:?}"
    );
}

/// A cable breaks: the junction behind the break stays with the part there. A snapshot restores
/// junctions, also one that was despawned.
#[test]
fn junctions_follow_the_parts_of_a_broken_cable_and_snapshots() {
    let mut world = world();
    let (ropes, tie, load) = bridle(&mut world);
    steps(&mut world, 60);
    let snapshot = Snapshot::take(&mut world).unwrap();
    steps(&mut world, 20);
    let then = height(&world, load).to_bits();
    world.entity_mut(ropes[0]).insert(BreakTension(10.0));
    steps(&mut world, 1);
    let broken: Vec<CableBroken> = world.resource_mut::<Messages<CableBroken>>().drain().collect();
    let rest = broken[0].rest;
    world.entity_mut(rest).remove::<BreakTension>();
    world.entity_mut(ropes[0]).remove::<BreakTension>();
    steps(&mut world, 30);
    assert_eq!(world.get::<Junction>(tie).unwrap().points[0], (rest, At::End));
    let end = cable_of(&world, rest).length();
    assert!((point(&world, rest, end) - point(&world, ropes[2], 0.0)).norm() < 1e-6);
    assert_eq!(world.resource::<Messages<JunctionFailed>>().len(), 0);
    world.despawn(tie);
    steps(&mut world, 10);
    let renamed = snapshot.restore(&mut world).unwrap();
    assert!(renamed.contains_key(&tie) && world.get_entity(rest).is_err());
    steps(&mut world, 20);
    assert_eq!(height(&world, load).to_bits(), then);
}

/// A rope in one call: cable, attachments, damping and strength.
#[test]
fn a_spawned_rope_hangs_breaks_and_is_despawned_as_a_whole() {
    let mut world = world();
    let load = world.spawn(cube(0.1, 5.0, [0.0, -2.1, 0.0])).id();
    let rope = Rope::steel(0.006).strength(1e4).name("sling");
    let (cable, ends) = world.spawn_rope([0.0, 0.0, 0.0], (load, [0.0, -2.0, 0.0]), rope);
    steps(&mut world, 120);
    assert!((height(&world, load) + 2.1).abs() < 1e-3 && cable_of(&world, cable).name() == "sling");
    world.get_mut::<BreakTension>(cable).unwrap().0 = 20.0;
    steps(&mut world, 2);
    assert!(!world.resource::<Messages<CableBroken>>().is_empty());
    world.despawn(cable);
    assert!(world.get_entity(ends[0]).is_err());
    assert!(world.resource::<Cables>().get(cable).is_err());
}

/// A limp rope that a weight bends, with a kink at the weight: the two parts move as two cables that a junction ties, the hook at its
/// end stays with the part behind, a snapshot from before goes on bitwise; at a point that is tied no kink is made.
///
/// *Source.* The two cables that are spawned as such.
#[test]
fn a_kink_is_an_entity() {
    let ends = [[-1.0, 0.0, 0.0], [0.5, 0.0, 0.0], [1.0, 0.0, 0.0]];
    let damped = || Damping::time(2e-3);
    let weigh = |world: &mut World| {
        let load = world.spawn(cube(0.05, 5.0, [0.5, -0.6, 0.0])).id();
        let hanger = world.spawn((soft([0.5, 0.0, 0.0], [0.5, -0.55, 0.0]), damped())).id();
        world.spawn(Attachment::ball(hanger, At::End).to(load).at([0.0, 0.05, 0.0]));
        (hanger, At::Start)
    };
    let mut world = world();
    let rope = world.spawn((soft(ends[0], ends[2]).elements(8), damped())).id();
    world.spawn(pin(rope));
    let hook = world.spawn(Attachment::ball(rope, At::End).to_world()).id();
    let kink = world.spawn(KinkAlong::of(rope, At::ArcLength(1.5))).id();
    let tied = world.spawn(KinkAlong::of(rope, At::End)).id();
    let snapshot = Snapshot::take(&mut world).unwrap();
    let run = |world: &mut World| {
        steps(world, 1);
        let points = world.get::<Junction>(kink).unwrap().points.clone();
        let hanger = weigh(world);
        let mut junction = world.get_mut::<Junction>(kink).unwrap();
        junction.points.push(hanger);
        junction.gap = Gap::Close;
        steps(world, 120);
        points
    };
    let points = run(&mut world);
    let failed: Vec<JunctionFailed> = world.resource_mut::<Messages<JunctionFailed>>().drain().collect();
    assert!(matches!(failed[..], [JunctionFailed { entity, .. }] if entity == tied), "{failed:?}");
    let [(before, At::End), (behind, At::Start)] = points[..] else { panic!("{points:?}") };
    assert!(before == rope && world.get::<KinkAlong>(kink).is_none() && world.get::<Damping>(behind).is_some());
    assert_eq!(world.get::<OnCable>(hook).unwrap().0, behind);
    let once = [rope, behind].map(|part| bits(&world, part));
    let knot = point(&world, rope, 1.5);
    assert!(knot.y < -1e-3 && (knot - point(&world, behind, 0.0)).norm() < 1e-9, "{knot:?}");

    snapshot.restore(&mut world).unwrap();
    assert!(world.get::<Junction>(kink).is_none() && world.get::<KinkAlong>(kink).is_some());
    let behind = run(&mut world)[1].0;
    assert!(once == [rope, behind].map(|part| bits(&world, part)));

    let mut two = super::common::world();
    let parts = [(ends[0], ends[1], 6), (ends[1], ends[2], 2)];
    let [first, last] = parts.map(|(from, to, n)| two.spawn((soft(from, to).elements(n), damped())).id());
    two.spawn(pin(first));
    two.spawn(Attachment::ball(last, At::End).to_world());
    let knot = two.spawn(Junction::between((first, At::End), (last, At::Start))).id();
    steps(&mut two, 1);
    let hanger = weigh(&mut two);
    let mut junction = two.get_mut::<Junction>(knot).unwrap();
    junction.points.push(hanger);
    junction.gap = Gap::Close;
    steps(&mut two, 120);
    let apart = (point(&two, first, 1.5) - point(&world, rope, 1.5)).norm();
    assert!(apart < 1e-6, "{apart:e} m");
}
