//! Where cables are attached: at any arc length, several times to one body, to each other.

use super::common::{add_cube, bits, cable, gap, l_stable_integrator, run, soft, tension, weightless};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{At, Cable, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet, Error, Gap};

/// A load is attached to a taut rope at its middle, where there was no node.
///
/// Reference: the triangle of forces, m g = 2 T sin a.
#[test]
fn a_load_in_the_middle_of_a_rope_hangs_in_a_triangle_of_forces() {
    let mut world = PhysicsWorld::new();
    let body = RigidBodyBuilder::dynamic().translation(Vector::new(1.0, -0.1, 0.0)).linear_damping(2.0);
    let body = body.angular_damping(2.0).can_sleep(false);
    let (load, _) = world.insert(body, ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(20.0));
    let mut set = CableSet::new();
    // an odd number of elements, so no node in the middle; enough of them for the kink at the load
    let rope = cable([0.0; 3], [2.0, 0.0, 0.0], Section::from_stiffness(1e5, 0.0, 1e-3).unwrap());
    let rope =
        rope.length(2.1).elements(25).fix(At::Start).fix(At::End).integrator(l_stable_integrator()).build().unwrap();
    let rope = set.insert(rope);
    let closing = AttachmentKind::Ball.with_gap(Gap::Close);
    let first = set.attach(&world, rope, At::ArcLength(1.05), load, Vector::new(0.0, 0.1, 0.0), closing).unwrap();
    assert_eq!((set.get(rope).unwrap().nodes(), set.attachment(first).unwrap().node()), (27, 13));
    run(&mut world, &mut set, 900);
    let hook = set.get(rope).unwrap().sample(1.05).unwrap().position;
    let sine = -hook.y / (hook.y * hook.y + 1.0).sqrt();
    let expected = 20.0 * 9.81 / (2.0 * sine);
    let pull = tension(&set, rope, 0.3);
    assert!((pull / expected - 1.0).abs() < 1e-2, "{pull} N of {expected}, hook {hook:?}");
    assert!(hook.x > 0.99 && hook.x < 1.01 && hook.y < -0.3, "{hook:?}");
    let force = set.attachment(first).unwrap().force();
    assert!((force.y / (20.0 * 9.81) - 1.0).abs() < 2e-3, "{force:?}");
}

/// Inserting nodes changes the index of those behind them; attachments stay at their arc length.
///
/// Reference: the contract.
#[test]
fn attachments_keep_their_arc_length_when_nodes_are_inserted() {
    let mut world = weightless();
    let bodies = [0.2, 1.0, 1.7].map(|x| add_cube(&mut world, 1.0, 0.05, [x as Real, 0.0, 0.0]));
    let mut set = CableSet::new();
    let rope = set.insert(cable([0.0; 3], [2.0, 0.0, 0.0], soft()).elements(4).build().unwrap());
    let end = set.attach_here(&world, rope, 1.7, bodies[2], AttachmentKind::Ball).unwrap();
    let start = set.attach_here(&world, rope, 0.2, bodies[0], AttachmentKind::Clamp).unwrap();
    let middle = set.attach_here(&world, rope, 1.0, bodies[1], AttachmentKind::Ball).unwrap();
    let at = |a| set.get(rope).unwrap().node_arc_lengths()[set.attachment(a).unwrap().node()];
    let places = [start, middle, end].map(at);
    assert!((places[0] - 0.2).abs() < 1e-12 && (places[1] - 1.0).abs() < 1e-12 && (places[2] - 1.7).abs() < 1e-12);
    run(&mut world, &mut set, 30);
    assert!(gap(&set) < 1e-6 && vector(world.bodies[bodies[1]].translation()).metric_distance(&Vector3::x()) < 1e-5);
}

/// A rope from one corner of a crate to the other hangs by its middle from a hook.
///
/// Reference: the triangle of forces; near the sharp bend the tension that is read oscillates, within its uncertainty.
#[test]
fn a_sling_with_both_ends_on_one_body_carries_it() {
    let mut world = PhysicsWorld::new();
    let body = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -0.7, 0.0)).linear_damping(2.0);
    let body = body.angular_damping(4.0).can_sleep(false);
    let (load, _) = world.insert(body, ColliderBuilder::cuboid(0.4, 0.1, 0.1).mass(30.0));
    let mut set = CableSet::new();
    let points = [[-0.4, -0.6, 0.0], [0.0, 0.0, 0.0], [0.4, -0.6, 0.0]].map(Vector3::from);
    let section = Section::from_stiffness(1e5, 0.0, 1e-3).unwrap();
    let sling = lariat_rapier::lariat_ancf::Cable::builder().points(points).section(section).elements(24);
    let length: f64 = 2.0 * 0.52f64.sqrt();
    let sling = set.insert(sling.fix(0.5 * length).integrator(l_stable_integrator()).build().unwrap());
    for (at, x) in [(At::Start, -0.4), (At::End, 0.4)] {
        set.attach(&world, sling, at, load, Vector::new(x, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    }
    run(&mut world, &mut set, 900);
    let lift: f64 = set.attachments().map(|(_, a)| a.force().y).sum();
    assert!((lift / (30.0 * 9.81) - 1.0).abs() < 2e-3, "{lift} N");
    let expected = 30.0 * 9.81 / 2.0 / (0.6 / 0.52f64.sqrt());
    for (_, attachment) in set.attachments() {
        assert!((attachment.force().norm() / expected - 1.0).abs() < 1e-2, "{:?} of {expected} N", attachment.force());
    }
    let read = set.get(sling).unwrap().sample(0.01).unwrap();
    let off = (read.tension - expected).abs();
    assert!(off < read.tension_uncertainty && off < 0.05 * expected, "{read:?} {expected}");
    assert!(gap(&set) < 1e-6);
}

/// Two stays and a hanger with a load, tied in a point.
///
/// Reference: three forces in balance, by the weight and the directions of the stays.
#[test]
fn three_cables_tied_in_a_point_balance() {
    let mut world = PhysicsWorld::new();
    let body = RigidBodyBuilder::dynamic().translation(Vector::new(0.2, -2.1, 0.0)).linear_damping(2.0);
    let (load, _) =
        world.insert(body.angular_damping(2.0).can_sleep(false), ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(8.0));
    let section = Section::from_stiffness(1e5, 0.0, 1e-3).unwrap();
    let hub = [0.2, -1.0, 0.0];
    let mut set = CableSet::new();
    let [left, right] = [-1.0, 0.6].map(|x| {
        set.insert(
            cable([x, 0.0, 0.0], hub, section)
                .elements(4)
                .fix(At::Start)
                .integrator(l_stable_integrator())
                .build()
                .unwrap(),
        )
    });
    let hanger = set
        .insert(cable(hub, [0.2, -2.0, 0.0], section).elements(4).integrator(l_stable_integrator()).build().unwrap());
    let knot = set.join((left, At::End), (right, At::End)).unwrap();
    assert_eq!(set.join((left, At::End), (hanger, At::Start)).unwrap(), knot);
    assert_eq!(set.junction(knot).unwrap().nodes().len(), 3);
    set.attach(&world, hanger, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    run(&mut world, &mut set, 900);
    let end = |c| set.get(c).unwrap().sample(set.get(c).unwrap().length()).unwrap();
    let sum = end(left).slope.normalize() * end(left).tension + end(right).slope.normalize() * end(right).tension;
    // the stays pull the hub up along their slopes reversed, the hanger down
    assert!((sum - Vector3::new(0.0, -8.0 * 9.81, 0.0)).norm() < 0.5, "{sum:?}");
    let apart = end(left).position.metric_distance(&end(right).position);
    assert!(apart < 1e-9 && end(left).position.metric_distance(&set.get(hanger).unwrap().node_position(0)) < 1e-9);
    // untied, the hanger falls with its load
    set.leave(knot, hanger).unwrap();
    run(&mut world, &mut set, 30);
    assert!(vector(world.bodies[load].translation()).y < -2.5);
    assert!(end_of(&set, left).metric_distance(&end_of(&set, right)) < 1e-9);
    assert_eq!(set.leave(knot, hanger), Err(Error::NoCable(hanger)));
    set.leave(knot, left).unwrap();
    assert_eq!(set.leave(knot, right), Err(Error::NoJunction(knot)));
}

fn end_of(set: &CableSet, cable: lariat_rapier::CableHandle) -> Vector3<f64> {
    let cable = set.get(cable).unwrap();
    cable.node_position(cable.nodes() - 1)
}

/// A free chain of two cables and two bodies, tied in the middle, rotates.
///
/// Reference: conservation laws.
#[test]
fn a_rotating_chain_with_a_junction_keeps_its_momenta_and_energy() {
    let mut world = weightless();
    let ends = [-1.0, 1.0].map(|x: f64| {
        let body = RigidBodyBuilder::dynamic().translation(Vector::new(x as Real, 0.0, 0.0)).linvel(Vector::new(
            0.0,
            3.0 * x as Real,
            0.3,
        ));
        world.insert(body, ColliderBuilder::ball(0.05).mass(2.0)).0
    });
    let mut set = CableSet::new();
    let halves = ends.map(|body| {
        let x = f64::from(world.bodies[body].translation().x);
        let half = cable([0.0; 3], [x, 0.0, 0.0], soft()).gravity(Vector3::zeros()).elements(5);
        let half = half.velocity(Vector3::new(0.0, 0.0, 0.3)).angular_velocity(Vector3::new(0.0, 0.0, 3.0));
        let half = set.insert(half.build().unwrap());
        set.attach(&world, half, At::End, body, Vector::ZERO, AttachmentKind::Ball).unwrap();
        half
    });
    set.join((halves[0], At::Start), (halves[1], At::Start)).unwrap();
    let before = (set.momentum(&world).unwrap(), set.energy(&world).unwrap().total());
    run(&mut world, &mut set, 120);
    let after = (set.momentum(&world).unwrap(), set.energy(&world).unwrap().total());
    assert!((after.0.linear - before.0.linear).norm() < 1e-4, "{:?} {:?}", after.0, before.0);
    assert!((after.0.angular - before.0.angular).norm() < 1e-3 * before.0.angular.norm());
    assert!((after.1 - before.1).abs() < 1e-3 * before.1, "{} J, {} J", after.1, before.1);
}

/// Cables are inserted and attached in different orders: the states are equal to the bit.
///
/// Reference: the contract.
#[test]
fn the_result_does_not_depend_on_the_order_of_insertion() {
    let runs = [[0, 1, 2, 3], [3, 1, 0, 2], [2, 3, 1, 0]].map(|order: [usize; 4]| {
        let mut world = PhysicsWorld::new();
        let ground = RigidBodyBuilder::fixed().translation(Vector::new(0.0, -1.75, 0.0));
        world.insert(ground, ColliderBuilder::cuboid(10.0, 0.5, 10.0));
        let deck = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -1.1, 0.0));
        let (deck, _) = world.insert(deck, ColliderBuilder::cuboid(0.5, 0.1, 0.3).mass(20.0));
        let corners = [(-0.5, -0.3), (-0.5, 0.3), (0.5, -0.3), (0.5, 0.3)];
        let mut set = CableSet::new();
        let mut ropes = [None; 4];
        for k in order {
            let (x, z) = corners[k];
            let rope = cable([1.5 * x, 0.0, z], [x, -1.0, z], soft()).length(1.1 + 0.03 * k as f64).fix(At::Start);
            ropes[k] = Some(set.insert(rope.elements(4).build().unwrap()));
        }
        for k in order.into_iter().rev() {
            let (x, z) = corners[k];
            let anchor = Vector::new(x as Real, 0.1, z as Real);
            set.attach(&world, ropes[k].unwrap(), At::End, deck, anchor, AttachmentKind::Ball).unwrap();
        }
        run(&mut world, &mut set, 60);
        assert!(vector(world.bodies[deck].translation()).y < -1.12, "it has come down on the ground");
        let mut all = bits(&world, &CableSet::new());
        for rope in ropes {
            all.extend(set.get(rope.unwrap()).unwrap().positions().iter().map(|x| x.to_bits()));
        }
        all
    });
    assert!(runs[0] == runs[1] && runs[1] == runs[2]);
}

/// An anchor far from the point of the cable is an error by default, with the distance, and changes
/// nothing; a limit of the user's holds instead, and with [`Gap::Close`] the gap closes. The same for
/// two cables that are tied.
#[test]
fn a_gap_is_refused_or_closed_as_the_user_says() {
    for distance in [0.5, 2e-3, 0.9e-3] {
        for kind in [AttachmentKind::Ball, AttachmentKind::Clamp] {
            let mut world = PhysicsWorld::new();
            let load = add_cube(&mut world, 5.0, 0.1, [2.0, -0.1, 0.0]);
            let mut set = CableSet::new();
            let rope = set.insert(cable([0.0; 3], [2.0, 0.0, 0.0], soft()).fix(At::Start).build().unwrap());
            let anchor = Vector::new(0.0, 0.1, distance);
            let nodes = set.get(rope).unwrap().nodes();
            let attached = set.attach(&world, rope, 1.93, load, anchor - Vector::X * 0.07, kind);
            assert_eq!(attached.is_ok(), distance < 1e-3);
            if let Err(error) = attached {
                let Error::GapTooLong { gap, limit, .. } = error else { panic!("{error}") };
                assert!((gap - f64::from(distance)).abs() < 1e-6 && limit == 1e-3);
                assert_eq!(set.get(rope).unwrap().nodes(), nodes);
                let limit = kind.with_gap(Gap::Refuse(1.01 * f64::from(distance)));
                let wide = set.attach(&world, rope, At::End, load, anchor, limit).unwrap();
                set.detach(&mut world, wide).unwrap();
                set.attach(&world, rope, At::End, load, anchor, kind.with_gap(Gap::Close)).unwrap();
            }
            run(&mut world, &mut set, 30);
            assert!(gap(&set) < 1e-6, "{distance} m, {kind:?}: {:.1e} m", gap(&set));
        }
    }
    let mut set = CableSet::new();
    let [a, b] = [0.0, 0.5].map(|z| set.insert(cable([0.0, 0.0, z], [1.0, 0.0, z], soft()).build().unwrap()));
    assert!(matches!(set.join((a, At::End), (b, At::End)), Err(Error::GapTooLong { gap: 0.5, limit: 1e-3, .. })));
    assert!(set.join_with_gap((a, At::End), (b, At::End), Gap::Refuse(f64::NAN)).is_err());
    set.join_with_gap((a, At::End), (b, At::End), Gap::Close).unwrap();
    run(&mut PhysicsWorld::new(), &mut set, 30);
    let [a, b] = [a, b].map(|c| set.get(c).unwrap().sample(1.0).unwrap().position);
    assert!((a - b).norm() < 1e-6);
}

/// A slack cable that is clamped to a turned body along an axis of the body starts at rest, and the clamp holds that angle exactly.
///
/// Reference: the contract; the equilibrium of the cable by itself, with a clamp in the same direction.
#[test]
fn a_clamp_on_a_body_holds_the_direction_that_is_given() {
    let mut world = PhysicsWorld::new();
    let turn = Vector::new(0.0, 0.0, 0.7);
    let post = world.insert_body(RigidBodyBuilder::fixed().translation(Vector::ZERO).rotation(turn));
    let build = || {
        let section = Section::from_stiffness(1e4, 0.5, 0.2).unwrap();
        let builder = Cable::builder().points([Vector3::zeros(), Vector3::x()]).length(1.3).section(section);
        builder.elements(16).fix(At::End)
    };
    let mut set = CableSet::new();
    let rope = set.insert(build().build().unwrap());
    let along = AttachmentKind::Clamp.along(Vector3::x());
    let clamp = set.attach(&world, rope, At::Start, post, Vector3::zeros(), along).unwrap();
    assert_eq!(set.attachment(clamp).unwrap().kind(), AttachmentKind::Clamp);
    // the body has single precision
    let direction = Vector3::new(0.7f64.cos(), 0.7f64.sin(), 0.0);
    let slope = |set: &CableSet| set.get(rope).unwrap().sample(0.0).unwrap().slope.normalize();
    assert!((slope(&set) - direction).norm() < 1e-6, "{:?}", slope(&set));
    let alone = build().clamp_along(At::Start, direction).build().unwrap();
    let difference = |set: &CableSet| {
        let pairs = alone.positions().iter().zip(set.get(rope).unwrap().positions());
        pairs.fold(0.0f64, |most, (a, b)| most.max((a - b).abs()))
    };
    assert!(difference(&set) < 1e-5, "{:e}", difference(&set));
    run(&mut world, &mut set, 60);
    assert!((slope(&set) - direction).norm() < 1e-6 && difference(&set) < 1e-4, "{:e}", difference(&set));
}
