//! Statics of bodies in water: floats at the surface, bodies in a current.

use super::{G, down, moves};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{At, Cable, Flow, Section, Surface, Vector3, Water, Wave};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::water::{BodiesInWater, Immersed};
use lariat_rapier::{AttachmentKind, CableSet, Gap};
use std::f64::consts::PI;

const RHO: f64 = 1000.0;

fn sea() -> Water {
    Water::new(RHO).with_surface(Surface::at(0.0, down(G)))
}

/// A world with one body in water.
fn tank(body: RigidBodyBuilder, shape: ColliderBuilder, water: Water, immersed: Immersed) -> Tank {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::new(0.0, -G as f32, 0.0);
    let (body, _) = world.insert(body, shape);
    let mut water = BodiesInWater::new(water).unwrap();
    water.insert(&mut world, body, immersed).unwrap();
    let mut set = CableSet::new();
    set.set_water(water);
    (world, set, body)
}

type Tank = (PhysicsWorld, CableSet, RigidBodyHandle);

/// A line of EA (N) and mass per length (kg/m) from a fixed point to a body's.
fn tie((world, set, body): &mut Tank, points: [Vector3<f64>; 2], length: f64, [ea, mass]: [f64; 2], anchor: Vector) {
    let line = Cable::builder()
        .points(points)
        .length(length)
        .section(Section::from_stiffness(ea, 0.0, mass).unwrap())
        .elements(16)
        .fix(At::Start)
        .build()
        .unwrap();
    let line = set.insert(line);
    set.attach(world, line, At::End, *body, anchor, AttachmentKind::Ball.with_gap(Gap::Close)).unwrap();
}

/// The volume of a ball of a radius below the surface, its centre at a height.
fn cap(radius: f64, y: f64) -> f64 {
    let d = (radius - y).clamp(0.0, 2.0 * radius);
    PI * d * d * (3.0 * radius - d) / 3.0
}

/// A ball on a line to the ground that is too short, from above and from below the surface: the line pulls with what it displaces too much. It
/// stays there, also when a wave was only said to come.
///
/// *Source.* rho g V(y) = m g + T, T = EA (s^2 - 1)/2 s of a light line (Green's strain), V of the spherical cap.
#[test]
fn a_tethered_ball_floats_where_its_line_balances_buoyancy() {
    for (length, start) in [(4.9, 0.4), (4.7, -0.6), (5.05, -0.1)] {
        let (radius, density) = (0.5, 300.0);
        let shape = ColliderBuilder::ball(radius as f32).density(density as f32);
        let place = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, start as f32, 0.0));
        let mut tank = tank(place, shape, sea(), Immersed::with_drag_area([0.4; 3]).with_added_mass(0.5));
        tie(&mut tank, [down(5.0), down(-start)], length, [1e5, 1e-3], Vector::ZERO);
        let (mut world, mut set, body) = tank;
        let found = set.equilibrium(&mut world).unwrap();
        let y = vector(world.bodies[body].translation()).y;
        let stretch = (5.0 + y) / length;
        let tension = 0.5e5 * (stretch * stretch - 1.0) * stretch;
        let (up, weight) = (RHO * G * cap(radius, y), density * G * 4.0 / 3.0 * PI * radius.powi(3));
        println!("{length}: {y}, {tension} N, off by {} N, {:?}", up - weight - tension, found.cables[0].1);
        // half of the line hangs on it
        let own = 0.5 * 1e-3 * length * G;
        assert!((up - weight - tension.max(0.0) - own).abs() < 1e-4 * weight, "{y} {tension} {up} {weight}");
        let moved = moves(&mut world, &mut set, body);
        assert!(moved < 1e-6, "{moved:e}");
    }
}

/// A box on three slack heavy lines, dropped askew from above, floats level at the draught of its weight and that of the lines that hang on it,
/// in still water; with a wave to come statics are the same.
///
/// *Source.* Archimedes; the vertical forces on the supports of the lines hold the rest of their weight.
#[test]
fn a_moored_box_floats_level_at_its_draught() {
    for wave in [false, true] {
        let mut water = sea();
        if wave {
            water =
                Water::new(RHO).with_surface(Surface::at(0.0, down(G)).with_wave(Wave::deep(0.3, 6.0, Vector3::x())));
        }
        let shape = ColliderBuilder::cuboid(1.0, 0.5, 1.0).density(400.0);
        let place =
            RigidBodyBuilder::dynamic().translation(Vector::new(0.1, 0.8, 0.0)).rotation(Vector::new(0.2, 0.0, 0.1));
        let mut tank = tank(place, shape, water, Immersed::with_drag_area([2.0, 4.0, 2.0]).with_added_mass(0.7));
        for k in 0..3 {
            let angle = 2.0 * PI / 3.0 * f64::from(k);
            let (out, own) = (Vector3::new(angle.cos(), 0.0, angle.sin()), 0.8);
            let ends = [out * 8.0 + down(6.0), out * own + down(-0.4)];
            tie(&mut tank, ends, 11.0, [1e6, 3.0], Vector::new((own * out.x) as f32, -0.4, (own * out.z) as f32));
        }
        let (mut world, mut set, body) = tank;
        let found = set.equilibrium(&mut world).unwrap();
        let pull: f64 = set.attachments().map(|(_, a)| -a.reading().force.y).sum();
        let (place, up) = (vector(world.bodies[body].translation()), world.bodies[body].rotation() * Vector::Y);
        let mass = 1600.0;
        let draught = (mass + pull / G) / (RHO * 4.0);
        println!("{place:?} {up:?} {pull} {draught} {:?}", found.cables[0].1);
        assert!(found.is_stable() && f64::from(up.y) > 1.0 - 1e-6, "{up:?}");
        assert!((0.5 - place.y - draught).abs() < 1e-5, "{place:?} {draught}");
        assert!(pull > 3.0 * 3.0 * 6.0 * G && pull < 33.0 * 3.0 * G, "{pull}");
        if !wave {
            let moved = moves(&mut world, &mut set, body);
            assert!(moved < 1e-6, "{moved:e}");
        }
    }
}

/// A weight on a line in a current is found at once where its drag holds it, at every speed, and stays there.
///
/// *Source.* Balance of moments about the support of a light line: tan of the angle is drag over weight in water.
#[test]
fn a_weight_in_a_current_hangs_at_its_angle_at_every_speed() {
    let (radius, area) = (0.1, 0.02);
    for (speed, length) in [(0.3, 5.0), (1.5, 20.0), (4.0, 5.0), (10.0, 100.0)] {
        let water = Water::new(RHO).with_flow(Flow::uniform(Vector3::new(speed, 0.0, 0.0)));
        let start = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -length as f32, 0.0));
        let shape = ColliderBuilder::ball(radius as f32).density(3000.0);
        let mut tank = tank(start, shape, water, Immersed::with_drag_area([area; 3]).with_added_mass(0.5));
        tie(&mut tank, [Vector3::zeros(), down(length)], length, [1e6, 1e-6], Vector::ZERO);
        let (mut world, mut set, body) = tank;
        let found = set.equilibrium(&mut world).unwrap();
        let place = vector(world.bodies[body].translation());
        let volume = 4.0 / 3.0 * PI * f64::powi(radius, 3);
        let expected = 0.5 * RHO * area * speed * speed / ((3000.0 - RHO) * volume * G);
        println!("{speed}: {} {expected} {:?}", -place.x / place.y, found.cables[0].1);
        assert!((-place.x / place.y / expected - 1.0).abs() < 1e-4, "{speed} {place} {expected}");
        let moved = moves(&mut world, &mut set, body);
        println!("moves by {moved:e}");
        assert!(moved < 1e-6, "{moved:e}");
    }
}

/// A plate whose drag and added mass depend on its attitude, on an arm: statics find it, and the residual of all forces and moments is rounding.
///
/// *Source.* It balances: the moment about the tie, by the force of the water as the steps have it, with Munk's moment -u x A u.
#[test]
fn a_body_whose_drag_depends_on_its_attitude_is_found() {
    for (speed, added) in
        [(0.5, [0.3; 3]), (2.0, [0.3; 3]), (5.0, [0.3; 3]), (0.5, [0.1, 1.2, 0.3]), (2.0, [0.1, 1.2, 0.3])]
    {
        let water = Water::new(RHO).with_flow(Flow::uniform(Vector3::new(speed, 0.0, 0.0)));
        let start = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -10.0, 0.0));
        let shape = ColliderBuilder::cuboid(0.4, 0.05, 0.2).density(4000.0);
        let mut immersed = Immersed::with_drag_area([0.01, 0.3, 0.05]).with_added_mass_along(added);
        immersed.spin_drag = Vector3::new(0.01, 0.01, 0.02);
        let mut tank = tank(start, shape, water, immersed);
        tie(&mut tank, [Vector3::zeros(), down(9.9)], 9.9, [1e6, 0.05], Vector::new(-0.1, 0.1, 0.0));
        let (mut world, mut set, body) = tank;
        let found = set.equilibrium(&mut world).unwrap();
        let own = &world.bodies[body];
        let turn =
            |local: Vector3<f64>| vector(*own.rotation() * Vector::new(local.x as f32, local.y as f32, local.z as f32));
        let force = set.water().unwrap().at_rest(&world, body, 0.0).unwrap();
        let tie = turn(Vector3::new(-0.1, 0.1, 0.0));
        let weight = down(G * 128.0);
        let moment = (turn(force.pressure_point) - tie).cross(&force.pressure)
            + (turn(force.drag_point) - tie).cross(&force.drag)
            + force.moment
            - tie.cross(&weight);
        let flow = own.rotation().inverse() * Vector::new(speed as f32, 0.0, 0.0);
        let munk = vector(flow * Vector::from(added.map(|c| 32.0 * c as f32))).cross(&vector(flow));
        let expected = turn(munk);
        assert!((force.moment - expected).norm() < 1e-4 * (1.0 + expected.norm()), "{expected} {:?}", force.moment);
        println!("{speed}: {:?} {moment:?} {:?}", own.translation(), found.cables[0].1);
        assert!(moment.norm() < 1e-5 * (weight.norm() + force.drag.norm()), "{speed} {moment:?}");
    }
}
