//! Many cables on a body, many bodies on cables, closed loops.

use super::common::{cable, gap, run, soft, weightless};
use lariat_rapier::convert::{to_vector, vector};
use lariat_rapier::lariat_ancf::{At, Damping, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

/// A deck of 100 kg on six vertical hangers, with a crate of 50 kg on one side, at rest.
///
/// Reference: a rigid deck on six equal springs: by symmetry the force of a hanger is (W + w)/6 + w
/// e x/(sum of x^2), x along the deck.
#[test]
fn six_hangers_share_the_load_of_a_deck() {
    let mut world = PhysicsWorld::new();
    let body = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -2.1, 0.0)).can_sleep(false);
    let (deck, _) =
        world.insert(body.linear_damping(1.0).angular_damping(1.0), ColliderBuilder::cuboid(2.0, 0.1, 0.5).mass(100.0));
    let body = RigidBodyBuilder::dynamic().translation(Vector::new(1.0, -1.9, 0.0)).can_sleep(false);
    let crate_ = world.insert(body, ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(50.0)).0;
    let mut set = CableSet::new();
    let mut held = Vec::new();
    for x in [-1.8, 0.0, 1.8] {
        for z in [-0.4, 0.4] {
            let hanger = cable([x, 0.0, z], [x, -2.0, z], Section::from_stiffness(1e5, 0.0, 0.05).unwrap());
            let hanger =
                hanger.elements(6).fix(At::Start).damping(Damping::from_ratio(0.3, 60.0).unwrap()).build().unwrap();
            let hanger = set.insert(hanger);
            held.push((
                x,
                set.attach(&world, hanger, At::End, deck, Vector::new(x as Real, 0.1, z as Real), AttachmentKind::Ball)
                    .unwrap(),
            ));
        }
    }
    run(&mut world, &mut set, 900);
    let e = vector(world.bodies[crate_].translation()).x;
    for (x, a) in held {
        let force = set.attachment(a).unwrap().force();
        let expected = 9.81 * (150.0 / 6.0 + 50.0 * e * x / (4.0 * 1.8 * 1.8));
        assert!((force.y / expected - 1.0).abs() < 0.01, "x = {x}: {} N of {expected}", force.y);
    }
    assert!(vector(world.bodies[deck].linvel()).norm() < 1e-3 && gap(&set) < 1e-4, "{:.1e} m", gap(&set));
}

/// Three balls and three cables in a ring that rotates in space for 2 s.
///
/// Reference: conservation laws; the threefold symmetry of the initial state.
#[test]
fn a_rotating_ring_of_balls_and_cables_keeps_its_momenta_energy_and_shape() {
    let mut world = weightless();
    let at = |k: usize| {
        let a = std::f64::consts::TAU / 3.0 * k as f64;
        Vector3::new(a.cos(), a.sin(), 0.0)
    };
    let balls = [0, 1, 2].map(|k| {
        let velocity = Vector3::z().cross(&at(k)) * 3.0;
        let body = RigidBodyBuilder::dynamic()
            .translation(to_vector(&at(k)))
            .linvel(to_vector(&velocity))
            .angvel(Vector::new(0.0, 0.0, 3.0));
        world.insert(body, ColliderBuilder::ball(0.05).mass(2.0)).0
    });
    let mut set = CableSet::new();
    for k in 0..3 {
        let (a, b) = (at(k), at((k + 1) % 3));
        let side = cable(a.into(), b.into(), soft()).elements(4).gravity(Vector3::zeros());
        let side = side.velocity(Vector3::z().cross(&a) * 3.0).angular_velocity(Vector3::z() * 3.0).build().unwrap();
        let side = set.insert(side);
        set.attach(&world, side, At::Start, balls[k], Vector::ZERO, AttachmentKind::Ball).unwrap();
        set.attach(&world, side, At::End, balls[(k + 1) % 3], Vector::ZERO, AttachmentKind::Ball).unwrap();
    }
    run(&mut world, &mut set, 1);
    let (before, energy) = (set.momentum(&world).unwrap(), set.energy(&world).unwrap().total());
    run(&mut world, &mut set, 120);
    let (after, left) = (set.momentum(&world).unwrap(), set.energy(&world).unwrap().total());
    assert!((after.linear - before.linear).norm() < 1e-4, "{:?}", after.linear - before.linear);
    assert!((after.angular - before.angular).norm() < 1e-4 * before.angular.norm());
    assert!((left / energy - 1.0).abs() < 1e-3, "{left} J of {energy}");
    let sides = [0, 1, 2].map(|k| {
        (vector(world.bodies[balls[k]].translation()) - vector(world.bodies[balls[(k + 1) % 3]].translation())).norm()
    });
    assert!(sides.iter().all(|s| (s - sides[0]).abs() < 1e-4), "{sides:?}");
}

/// Twenty balls on twenty cables hang in a row, released a little off equilibrium: no gap, and no
/// spurious energy.
///
/// Reference: statics, on average over the oscillation; conservation of energy.
#[test]
fn the_top_cable_of_a_chain_of_twenty_bodies_carries_all_below_it() {
    let mut world = PhysicsWorld::new();
    let mut set = CableSet::new();
    let mut before: Option<RigidBodyHandle> = None;
    let mut top = None;
    for k in 0..20 {
        let y = -0.5 * k as f64;
        let body = RigidBodyBuilder::dynamic().translation(Vector::new(0.02, (y - 0.5) as Real, 0.0)).can_sleep(false);
        let ball = world.insert(body, ColliderBuilder::ball(0.05).mass(1.0)).0;
        let link =
            cable([0.02, y, 0.0], [0.02, y - 0.5, 0.0], Section::from_stiffness(1e5, 0.0, 0.02).unwrap()).elements(2);
        let link = link.damping(Damping::from_ratio(0.2, 100.0).unwrap());
        let link = set.insert(if k == 0 { link.fix(At::Start).build().unwrap() } else { link.build().unwrap() });
        if let Some(before) = before {
            set.attach(&world, link, At::Start, before, Vector::ZERO, AttachmentKind::Ball).unwrap();
        }
        let held = set.attach(&world, link, At::End, ball, Vector::ZERO, AttachmentKind::Ball).unwrap();
        top.get_or_insert(held);
        before = Some(ball);
    }
    let start = set.energy(&world).unwrap().total();
    let (mut widest, mut most, mut pull) = (0.0f64, f64::MIN, 0.0);
    for _ in 0..300 {
        set.step(&mut world).unwrap();
        widest = widest.max(gap(&set));
        most = most.max(set.energy(&world).unwrap().total() - start);
        pull += set.attachment(top.unwrap()).unwrap().force().y / 300.0;
    }
    let below = 9.81 * (20.0 + 19.5 * 0.01);
    assert!((pull / below - 1.0).abs() < 0.02, "{pull} N of {below}");
    assert!(widest < 1e-5 && most < 1e-3, "{widest:.1e} m, {most:.1e} J");
}
