//! Bodies in water: terminal velocities, draughts, heave periods, the response to long waves, light bodies in long steps.

use lariat_ancf::{At, Cable, Flow, Section, Surface, Vector3, Water, Wave};
use lariat_rapier::convert::vector;
use lariat_rapier::water::{BodiesInWater, Immersed};
use lariat_rapier::{AttachmentKind, CableSet, Error};
use rapier::prelude::*;
use std::f64::consts::{PI, TAU};

const G: f64 = 9.81;
const RHO: f64 = 1000.0;

fn down() -> Vector3<f64> {
    Vector3::new(0.0, -G, 0.0)
}

/// A world with one body in water, and the cables of it.
struct Tank {
    world: PhysicsWorld,
    cables: CableSet,
    body: RigidBodyHandle,
    time: f64,
    dt: f64,
}

impl Tank {
    fn new(body: RigidBodyBuilder, shape: ColliderBuilder, water: Water, immersed: Immersed, dt: f64) -> Self {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(0.0, -G as f32, 0.0);
        world.integration_parameters.dt = dt as f32;
        let (body, _) = world.insert(body, shape);
        let mut water = BodiesInWater::new(water).unwrap();
        water.insert(&mut world, body, immersed).unwrap();
        let mut cables = CableSet::new();
        cables.set_water(water);
        Tank { world, cables, body, time: 0.0, dt }
    }

    fn step(&mut self) {
        self.cables.step(&mut self.world).unwrap();
        self.time += self.dt;
    }

    fn run(&mut self, seconds: f64) {
        for _ in 0..(seconds / self.dt).round() as usize {
            self.step();
        }
    }

    fn body(&self) -> &RigidBody {
        &self.world.bodies[self.body]
    }

    fn y(&self) -> f64 {
        vector(self.body().translation()).y
    }

    fn speed(&self) -> f64 {
        vector(self.body().linvel()).y
    }
}

fn pool() -> Water {
    Water::new(RHO)
}

fn sea() -> Water {
    pool().with_surface(Surface::at(0.0, down()))
}

/// *Source.* v = sqrt(2 |m - rho V| g/(rho C A)); the way there, v(t) = v_T tanh(t/T), T = (m + a) v_T/(|m - rho V| g).
#[test]
fn balls_sink_and_rise_at_their_terminal_velocity() {
    let (radius, coefficient) = (0.1, 0.47);
    let volume = 4.0 / 3.0 * PI * f64::powi(radius, 3);
    let area = PI * radius * radius;
    for (density, added) in [(2500.0, 0.0), (2500.0, 0.5), (200.0, 0.5), (50.0, 0.5)] {
        let shape = ColliderBuilder::ball(radius as f32).density(density as f32);
        let immersed = Immersed::with_drag_area([coefficient * area; 3]).with_added_mass(added);
        let mut tank = Tank::new(RigidBodyBuilder::dynamic(), shape, pool(), immersed, 1.0 / 60.0);
        let force = (density - RHO) * volume * G;
        let terminal = (2.0 * force.abs() / (RHO * coefficient * area)).sqrt();
        let mass = density * volume + added * volume * density.min(RHO);
        let time = mass * terminal / force.abs();
        tank.run(0.5);
        let expected = -force.signum() * terminal * (0.5 / time).tanh();
        println!("{density} {added}: {} {expected}", tank.speed());
        assert!((tank.speed() / expected - 1.0).abs() < 1e-2, "{density} {} {expected}", tank.speed());
        tank.run(20.0);
        println!("   {} {terminal}", tank.speed());
        assert!((tank.speed().abs() / terminal - 1.0).abs() < 1e-5, "{density} {} {terminal}", tank.speed());
    }
}

/// *Source.* The cubic of the spherical cap, pi d^2 (3 R - d)/3 = m/rho, by bisection; a box, m/(rho A).
#[test]
fn floats_come_to_rest_at_their_draught() {
    let radius: f64 = 0.3;
    for density in [150.0, 500.0, 870.0] {
        let share = density / RHO;
        let (mut low, mut high) = (0.0, 2.0 * radius);
        for _ in 0..60 {
            let d = 0.5 * (low + high);
            let cap = d * d * (3.0 * radius - d) / (4.0 * radius.powi(3));
            if cap < share { low = d } else { high = d }
        }
        let immersed = Immersed::with_drag_area([0.3; 3]).with_added_mass(0.5);
        let start = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, 0.1, 0.0));
        let shape = ColliderBuilder::ball(radius as f32).density(density as f32);
        let mut tank = Tank::new(start, shape, sea(), immersed, 1.0 / 60.0);
        tank.run(240.0);
        println!("{density}: {} {}", tank.y(), radius - low);
        assert!((tank.y() - (radius - low)).abs() < 2e-3, "{density} {} {}", tank.y(), radius - low);
        // and exactly there it stays
        let place = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, (radius - low) as f32, 0.0));
        let shape = ColliderBuilder::ball(radius as f32).density(density as f32);
        let mut tank = Tank::new(place, shape, sea(), immersed, 1.0 / 60.0);
        tank.run(5.0);
        assert!((tank.y() - (radius - low)).abs() < 1e-6, "{density} {} {}", tank.y(), radius - low);
    }
}

/// *Source.* Heave of a spar: T = 2 pi sqrt((m + a)/(rho g A)), undamped.
#[test]
fn a_spar_heaves_with_its_natural_period_and_keeps_its_energy() {
    let (half, radius, density, c) = (1.0f64, 0.25f64, 600.0, 0.3);
    let area = PI * radius * radius;
    let mass = density * area * 2.0 * half;
    let period = TAU * ((1.0 + c) * mass / (RHO * G * area)).sqrt();
    // its draught is 1.2 m, so that its centre is 0.2 m below the surface
    for dt in [1.0 / 60.0, 1.0 / 15.0] {
        let start = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -0.2 + 0.1, 0.0)).lock_rotations();
        let shape = ColliderBuilder::cylinder(half as f32, radius as f32).density(density as f32);
        let mut tank = Tank::new(start, shape, sea(), Immersed::default().with_added_mass(c), dt);
        let (mut crossings, mut largest, mut before) = (Vec::new(), 0.0f64, 0.1);
        while tank.time < 20.0 * period {
            tank.step();
            let now = tank.y() + 0.2;
            if before > 0.0 && now <= 0.0 {
                crossings.push(tank.time - tank.dt * now / (now - before));
            }
            if tank.time > 18.0 * period {
                largest = largest.max(now.abs());
            }
            before = now;
        }
        let n = crossings.len() - 1;
        let found = (crossings[n] - crossings[0]) / n as f64;
        println!("{dt}: {found} {period}, amplitude {largest}");
        assert!((found / period - 1.0).abs() < 0.3 * (dt * TAU / period).powi(2), "{dt} {found} {period}");
        assert!(largest < 0.1001, "{dt} {largest}");
        assert!(dt > 0.02 || largest > 0.098, "{dt} {largest}");
    }
}

/// Amplitude and phase at a frequency of rows of time and value, beside a motion at another one and a mean: least squares.
fn fit(rows: &[[f64; 2]], omega: f64, other: f64) -> [f64; 2] {
    let mut normal = nalgebra::SMatrix::<f64, 5, 5>::zeros();
    let mut right = nalgebra::SVector::<f64, 5>::zeros();
    for [t, x] in rows {
        let (s, c, p, q) = ((omega * t).sin(), (omega * t).cos(), (other * t).sin(), (other * t).cos());
        let base = nalgebra::SVector::<f64, 5>::from([c, s, q, p, 1.0]);
        normal += base * base.transpose();
        right += base * *x;
    }
    let found = normal.lu().solve(&right).unwrap();
    [found[0], found[1]]
}

/// *Source.* Linear response of a slender spar of draught d: (rho g A exp(-k d) - a omega^2 exp(-k d/2))/(rho g A - (m + a)
/// omega^2) of the amplitude, in phase below resonance (Faltinsen 1990, ch. 3, for long waves).
#[test]
fn a_spar_in_long_waves_heaves_by_its_linear_response() {
    let (half, radius, density, c) = (1.0f64, 0.25f64, 600.0, 0.3);
    let (area, draught) = (PI * radius * radius, 1.2);
    let mass = density * area * 2.0 * half;
    for period in [4.0, 6.0, 10.0] {
        let omega = TAU / period;
        let k = omega * omega / G;
        let (spring, added) = (RHO * G * area, c * mass);
        let natural = (spring / (mass + added)).sqrt();
        let expected = (spring * (-k * draught).exp() - added * omega * omega * (-0.5 * k * draught).exp())
            / (spring - (mass + added) * omega * omega);
        let amplitude = 0.02;
        let wave = Wave::deep(amplitude, period, Vector3::x());
        let water = pool().with_surface(Surface::at(0.0, down()).with_wave(wave));
        let start = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -0.2, 0.0)).lock_rotations();
        let start = start.locked_axes(LockedAxes::ROTATION_LOCKED | LockedAxes::TRANSLATION_LOCKED_X);
        let shape = ColliderBuilder::cylinder(half as f32, radius as f32).density(density as f32);
        let mut tank = Tank::new(start, shape, water, Immersed::default().with_added_mass(c), 1.0 / 60.0);
        let mut rows = Vec::new();
        while tank.time < 20.0 * period {
            tank.step();
            rows.push([tank.time, (tank.y() + 0.2) / amplitude]);
        }
        let [real, imaginary] = fit(&rows, omega, natural);
        println!("{period}: {real} {imaginary} expected {expected}");
        assert!(
            (real - expected).abs() < 1.5e-2 * expected && imaginary.abs() < 1e-2,
            "{period} {real} {imaginary} {expected}"
        );
    }
}

/// *Source.* Without other forces, drag takes energy and reverses nothing; a float has no more energy than it was given.
#[test]
fn light_bodies_in_long_steps_make_no_energy() {
    // a ball of 4 g and 40 cm, thrown at 50 m/s in water without weight
    let start = RigidBodyBuilder::dynamic().linvel(Vector::new(30.0, -40.0, 0.0)).gravity_scale(0.0);
    let shape = ColliderBuilder::ball(0.2).density(0.12);
    let mut tank = Tank::new(start, shape, pool(), Immersed::with_drag_area([0.06; 3]), 0.1);
    tank.world.gravity = Vector::ZERO;
    let mut before = vector(tank.body().linvel());
    for _ in 0..100 {
        tank.step();
        let now = vector(tank.body().linvel());
        assert!(now.dot(&before) >= 0.0 && now.norm() <= before.norm(), "{before} {now}");
        before = now;
    }
    // the same ball dropped on water, without drag and with it, and with the sea's own added mass or without
    for area in [0.0, 0.06] {
        for added in [0.0, 0.5] {
            let start = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -0.1, 0.0));
            let shape = ColliderBuilder::ball(0.2).density(5.0);
            let immersed = Immersed::with_drag_area([area; 3]).with_added_mass(added);
            let mut tank = Tank::new(start, shape, sea(), immersed, 0.1);
            let (mut highest, mut late) = (0.0f64, 0.0f64);
            for i in 0..600 {
                tank.step();
                highest = highest.max(tank.y());
                if i > 500 {
                    late = late.max(tank.speed().abs());
                }
            }
            println!("{area} {added}: {highest} {late}");
            // the energy of the water that it displaces, rho V_s times the depth of its centroid, lifts its weight
            let (r, h, mass) = (0.2f64, 0.1, 5.0 * 4.0 / 3.0 * PI * f64::powi(0.2, 3));
            let volume = PI / 3.0 * (r + h).powi(2) * (2.0 * r - h);
            let centre = h + 0.75 * (r - h).powi(2) / (2.0 * r - h);
            let most = RHO * volume * centre / mass - h;
            assert!(highest < most * (1.0 + 1e-4), "{area} {added} {highest} {most}");
        }
    }
}

/// A foam board that is let go askew comes to rest flat, at host steps beyond its periods of heave and roll (80 ms) too; without drag it is never
/// higher nor faster than its energy allows.
///
/// *Source.* The energy of the displaced water, at most rho g V times its half length.
#[test]
fn a_light_board_comes_to_rest_at_long_steps_and_is_bounded() {
    for (dt, drag) in [(1.0 / 60.0, true), (0.1, true), (0.1, false)] {
        let start = RigidBodyBuilder::dynamic().rotation(Vector::new(0.3, 0.0, 0.5));
        let shape = ColliderBuilder::cuboid(0.5, 0.02, 0.3).density(40.0);
        let area = if drag { [0.02, 0.6, 0.04] } else { [0.0; 3] };
        let mut immersed = Immersed::with_drag_area(area);
        if drag {
            immersed.spin_drag = Vector3::new(0.05, 0.0, 0.05);
        }
        let mut tank = Tank::new(start, shape, sea(), immersed, dt);
        let mass = f64::from(tank.body().mass());
        let most = RHO * G * 0.5 * 0.024;
        for _ in 0..(60.0 / dt) as usize {
            tank.step();
            let body = tank.body();
            let energy = 0.5 * mass * vector(body.linvel()).norm_squared() + mass * G * tank.y();
            assert!(energy < most && tank.y().abs() < 10.0, "{dt} {drag} {energy} {most} {}", tank.y());
        }
        let body = tank.body();
        let tilt = (body.rotation() * Vector::Y).y;
        println!("{dt} {drag}: tilt {tilt} y {} spin {}", tank.y(), vector(body.angvel()).norm());
        assert!(!drag || (tilt.abs() > 0.999 && (tank.y() - (0.02 - 0.0016)).abs() < 3e-3), "{dt} {tilt} {}", tank.y());
    }
}

/// *Source.* Balance of moments at rest: the cable points along the sum of drag and weight in water, whatever the step.
#[test]
fn a_weight_on_a_cable_hangs_askew_in_a_current() {
    for dt in [1.0 / 60.0, 1.0 / 20.0] {
        let (radius, u, area) = (0.1, 1.5, 0.02);
        let water = pool().with_flow(Flow::uniform(Vector3::new(u, 0.0, 0.0)));
        let start = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -5.0, 0.0));
        let shape = ColliderBuilder::ball(radius as f32).density(3000.0);
        let mut tank = Tank::new(start, shape, water, Immersed::with_drag_area([area; 3]).with_added_mass(0.5), dt);
        let line = Cable::builder()
            .points([Vector3::zeros(), Vector3::new(0.0, -5.0, 0.0)])
            .section(Section::from_stiffness(1e5, 0.0, 1e-3).unwrap())
            .elements(4)
            .gravity(Vector3::zeros())
            .fix(At::Start)
            .build()
            .unwrap();
        let line = tank.cables.insert(line);
        tank.cables.attach(&tank.world, line, At::End, tank.body, Vector::ZERO, AttachmentKind::Ball).unwrap();
        tank.run(120.0);
        let place = vector(tank.body().translation());
        let volume = 4.0 / 3.0 * PI * f64::powi(radius, 3);
        let expected = 0.5 * RHO * area * u * u / ((3000.0 - RHO) * volume * G);
        println!("{dt}: {} {expected}", -place.x / place.y);
        assert!((-place.x / place.y / expected - 1.0).abs() < 1e-3, "{dt} {place} {expected}");
    }
}

/// The forces of the user stay what they are, and count beside those of water; a snapshot of world and set replays to the bit, with a wave, on a
/// cable and without one, in host steps of several Rapier steps.
///
/// *Source.* The balance at rest: a float on which W pushes down stands W/(rho g A) lower. A copy continues as the original.
#[test]
fn the_users_forces_stay_and_a_snapshot_replays() {
    let push = Vector::new(0.0, -100.3, 0.0);
    let lower = 100.3 / (RHO * G);
    let start = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -lower as f32, 0.0)).lock_rotations();
    let shape = ColliderBuilder::cuboid(0.5, 0.5, 0.5).density(500.0);
    let mut tank = Tank::new(start, shape, sea(), Immersed::with_drag_area([1.0; 3]), 1.0 / 30.0);
    tank.world.bodies[tank.body].add_force(push, true);
    tank.run(10.0);
    assert_eq!(tank.body().user_force(), push);
    assert!((tank.y() + lower).abs() < 1e-6, "{} {lower}", tank.y());
    let water = pool().with_surface(Surface::at(0.0, down()).with_wave(Wave::deep(0.2, 4.0, Vector3::x())));
    for tied in [false, true] {
        let start = RigidBodyBuilder::dynamic();
        let shape = ColliderBuilder::ball(0.5).density(300.0);
        let mut tank = Tank::new(start, shape, water.clone(), Immersed::with_drag_area([0.4; 3]), 1.0 / 20.0);
        tank.cables.settings.rapier_steps = 2;
        if tied {
            let line = Cable::builder()
                .points([Vector3::new(0.0, -5.0, 0.0), Vector3::zeros()])
                .section(Section::from_stiffness(1e5, 0.0, 0.1).unwrap())
                .elements(4)
                .fix(At::Start)
                .build()
                .unwrap();
            let line = tank.cables.insert(line);
            tank.cables.attach(&tank.world, line, At::End, tank.body, Vector::ZERO, AttachmentKind::Ball).unwrap();
        }
        tank.run(2.0);
        let saved = bincode::serialize(&(&tank.world, &tank.cables)).unwrap();
        let (world, cables): (PhysicsWorld, CableSet) = bincode::deserialize(&saved).unwrap();
        let mut copy = Tank { world, cables, body: tank.body, time: tank.time, dt: tank.dt };
        tank.run(2.0);
        copy.run(2.0);
        assert_eq!(tank.body().position(), copy.body().position(), "{tied}");
        assert!((tank.cables.water().unwrap().time() - 4.0).abs() < 1e-6);
    }
}

#[test]
fn what_is_no_body_in_water_is_refused() {
    let mut world = PhysicsWorld::new();
    let bare = world.insert_body(RigidBodyBuilder::dynamic().additional_mass(1.0));
    let (fixed, _) = world.insert(RigidBodyBuilder::fixed(), ColliderBuilder::ball(1.0));
    let (ball, _) = world.insert(RigidBodyBuilder::dynamic(), ColliderBuilder::ball(1.0));
    let mut water = BodiesInWater::new(pool()).unwrap();
    assert_eq!(water.insert(&mut world, bare, Immersed::default()), Err(Error::NoVolume(bare)));
    assert_eq!(water.insert(&mut world, fixed, Immersed::default()), Err(Error::NotDynamic(fixed)));
    for bad in [
        Immersed::default().with_volume(0.0),
        Immersed::default().with_added_mass(-1.0),
        Immersed::with_drag_area([1.0, f64::NAN, 1.0]),
    ] {
        assert!(matches!(water.insert(&mut world, ball, bad), Err(Error::WaterValue { .. })));
    }
    assert!(BodiesInWater::new(Water::new(0.0)).is_err());
    water.insert(&mut world, bare, Immersed::default().with_volume(1e-3).with_added_mass(0.5)).unwrap();
    let mass = f64::from(world.bodies[bare].mass());
    assert!((mass - 1.5).abs() < 1e-6, "{mass}");
    assert!(water.remove(&mut world, bare));
    assert!((f64::from(world.bodies[bare].mass()) - 1.0).abs() < 1e-6);
}

/// A ball falls freely, on its own and on a rope, although it has added mass in water; it comes in with the momentum of both, and
/// goes out with the velocity that it has. No step makes energy of it.
///
/// *Source.* Free fall; m v = (m + a) v'.
#[test]
fn a_body_has_its_added_mass_in_water_alone() {
    let (radius, density, c) = (0.1, 1500.0, 0.5);
    let mass = density * 4.0 / 3.0 * PI * f64::powi(radius, 3);
    let added = c * RHO / density * mass;
    for (height, dt, tied) in [(6.0, 1.0 / 60.0, false), (6.0, 1.0 / 240.0, true), (2.3, 1.0 / 30.0, false)] {
        let start = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, height as f32, 0.0));
        let shape = ColliderBuilder::ball(radius as f32).density(density as f32);
        let mut tank = Tank::new(start, shape, sea(), Immersed::default().with_added_mass(c), dt);
        if tied {
            let section = Section::from_stiffness(1e4, 0.0, 1e-3).unwrap();
            let slack = Cable::builder().points([Vector3::new(0.1, height, 0.0), Vector3::new(0.0, height, 0.0)]);
            let slack = tank.cables.insert(slack.length(20.0).section(section).elements(10).build().unwrap());
            tank.cables.attach(&tank.world, slack, At::End, tank.body, Vector::ZERO, AttachmentKind::Ball).unwrap();
        }
        let (mut before, mut after) = (0.0, 0.0);
        let mut fallen = 0.0;
        for step in 1..=(2.0 / dt) as usize {
            let speed = tank.speed();
            tank.step();
            let time = step as f64 * dt;
            if f64::from(tank.body().mass()) < mass * (1.0 + 1e-6) {
                fallen = height - tank.y();
                let expected = 0.5 * G * time * time;
                // Rapier's steps are of first order
                assert!((fallen / expected - 1.0).abs() < 1.5 * dt / time + 1e-2, "{time}: {fallen} {expected}");
            } else if after == 0.0 {
                (before, after) = (speed, tank.speed());
            }
        }
        // within the step it gains weight less buoyancy over m + a, at most
        let (expected, step) = (before * mass / (mass + added), G * dt);
        println!("{height} {tied}: fell {fallen}, {before} to {after}, {expected}");
        assert!(fallen > 0.8 * (height - radius), "{fallen} of {height}");
        assert!((after - expected).abs() < step, "{after} {expected}");
        assert!((f64::from(tank.body().mass()) / (mass + added) - 1.0).abs() < 1e-5);
    }
    // one that is thrown out has the velocity with which it left, and its own mass
    let start = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -0.3, 0.0)).linvel(Vector::new(0.0, 6.0, 0.0));
    let shape = ColliderBuilder::ball(radius as f32).density(density as f32);
    let mut tank = Tank::new(start, shape, sea(), Immersed::default().with_added_mass(c), 1.0 / 240.0);
    tank.run(0.2);
    let (y, v) = (tank.y(), tank.speed());
    assert!(y > 0.3 && (f64::from(tank.body().mass()) / mass - 1.0).abs() < 1e-6);
    tank.run(0.25);
    let expected = y + v * 0.25 - 0.5 * G * 0.0625;
    assert!((tank.y() - expected).abs() < 1e-2, "{} {expected}", tank.y());
}

/// Light floats of all sizes that rise from a depth, at host steps far longer than their motion: with drag they leave the water no faster than they rise in it,
/// and come to their draught, to 1 % of their side; without it they have no more energy than the water gave them.
///
/// *Source.* The terminal velocity sqrt(2 V g/A), and the energy of the displaced water, rho g V times the way.
#[test]
fn floats_of_any_mass_and_size_leave_the_water_as_fast_as_they_rise() {
    for (mass, side) in [(0.1, 0.5), (0.1, 1.0), (0.1, 2.0), (0.3, 0.5), (0.3, 2.0), (10.0, 0.5), (100.0, 2.0)] {
        for rate in [240.0, 60.0, 15.0, 10.0] {
            for drag in [true, false] {
                let (area, depth) = (1.05 * side * side, 3.0);
                let spin_drag = Vector3::repeat(0.1 * side.powi(5));
                let dragged = Immersed { spin_drag, ..Immersed::with_drag_area([area; 3]) };
                let immersed = if drag { dragged } else { Immersed::default() };
                let body = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -depth as f32, 0.0));
                let half = 0.5 * side as f32;
                let shape = ColliderBuilder::cuboid(half, half, half).mass(mass as f32);
                let mut tank = Tank::new(body, shape, sea(), immersed.with_added_mass(0.5), 1.0 / rate);
                let terminal = (2.0 * side.powi(3) * G / area).sqrt();
                let energy = RHO * G * side.powi(3) * (depth + 0.5 * side);
                let draught = mass / (RHO * side * side);
                let (mut fastest, mut bob) = (0.0f64, 0.0f64);
                for _ in 0..(20.0 * rate) as usize {
                    tank.step();
                    fastest = fastest.max(tank.speed());
                    if tank.time > 18.0 {
                        bob = bob.max((tank.y() - 0.5 * side + draught).abs());
                    }
                    let held = 0.5 * mass * tank.speed().powi(2) + mass * G * (tank.y() + depth);
                    assert!(held <= 1.01 * energy, "{mass} kg, {side} m, {rate}/s: {held} J of {energy} J");
                }
                if drag {
                    assert!(fastest < 2.0 * terminal, "{mass} kg, {side} m, {rate}/s: {fastest} m/s, {terminal} m/s");
                    assert!(bob < 0.01 * side, "{mass} kg, {side} m, {rate}/s: {bob} m off its draught at last");
                }
            }
        }
    }
}

/// A body of the density of the water is taken along by a current, on its own and on a cable of no weight: its velocity is of second order in the step, and so is
/// the place of a body with a cable. Rapier's substeps move a body without one ahead, by half a substep of the change of its velocity.
///
/// *Source.* v = u - u/(1 + c u t/m), x = u t - (m/c) log(1 + c u t/m), c = rho C A/2.
#[test]
fn a_current_takes_a_body_along_as_its_closed_form_says() {
    let (current, mass, area, seconds) = (2.0f64, 20.0f64, 0.05f64, 1.0f64);
    let rate = 0.5 * RHO * area * current / mass;
    let velocity = current - current / (1.0 + rate * seconds);
    let place = current * seconds - current / rate * (rate * seconds).ln_1p();
    let off = |held: bool, steps: f64| {
        let half = (0.5 * (mass / RHO).cbrt()) as f32;
        let shape = ColliderBuilder::cuboid(half, half, half).mass(mass as f32);
        let water = Water::new(RHO).with_flow(Flow::uniform(Vector3::new(current, 0.0, 0.0)));
        let body = RigidBodyBuilder::dynamic().can_sleep(false);
        let mut tank = Tank::new(body, shape, water, Immersed::with_drag_area([area; 3]), seconds / steps);
        if held {
            let section = Section::from_stiffness(1e3, 1e-6, 1e-6).unwrap();
            let cable =
                Cable::builder().points([Vector3::zeros(), Vector3::new(0.0, -1.0, 0.0)]).section(section).elements(3);
            let cable = tank.cables.insert(cable.build().unwrap());
            tank.cables.attach_here(&tank.world, cable, At::Start, tank.body, AttachmentKind::Ball).unwrap();
        }
        tank.run(seconds);
        let (x, v) = (vector(tank.body().translation()).x, vector(tank.body().linvel()).x);
        let substeps = f64::from(tank.world.integration_parameters.num_solver_iterations as u32);
        (v - velocity, x - place, 0.5 * seconds / steps / substeps * velocity)
    };
    for held in [false, true] {
        let [(v, x, ahead), (fine_v, fine_x, finely_ahead)] = [off(held, 32.0), off(held, 64.0)];
        println!("{held}: {v:e} {x:e} {ahead:e}, {fine_v:e} {fine_x:e} {finely_ahead:e}");
        assert!((v / fine_v).log2() > 1.8 && v.abs() < 1e-3, "{held}: {v:e}, {fine_v:e}");
        let [x, fine_x] = if held { [x, fine_x] } else { [x - ahead, fine_x - finely_ahead] };
        assert!((x / fine_x).log2() > 1.8 && x.abs() < 2e-3, "{held}: {x:e}, {fine_x:e}");
    }
}
