//! Twisted cables between Rapier's bodies: torsional pendulums, momenta, energy, snapshots, sleep.

use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::coupling::Coupling;
use lariat_rapier::lariat_ancf::{
    At, Cable, CableBuilder, Damping, Effects, EndSpin, Integrator, Method, Reel, Section, StepControl, Torsion,
    Vector3,
};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet};
use std::f64::consts::TAU;

/// Returns a light cable of GJ (N m^2) along a line, twisted by a number of turns.
fn cable(from: Vector3<f64>, to: Vector3<f64>, stiffness: f64, turns: f64) -> CableBuilder {
    let torsion = Torsion { initial_twist: turns, ..Torsion::new(stiffness) };
    Cable::builder()
        .points([from, to])
        .section(Section::from_stiffness(1e4, 0.05, 0.01).unwrap())
        .elements(4)
        .effects(Effects { torsion: Some(torsion), ..Effects::default() })
}

/// Adds a disc of a mass (kg), with moments of inertia (kg m^2) about and across its axis, which is
/// `axis`.
fn disc(
    world: &mut PhysicsWorld,
    mass: f64,
    [along, across]: [f64; 2],
    at: Vector3<f64>,
    axis: Vector3<f64>,
) -> RigidBodyHandle {
    let inertia = Vector::new(across as Real, along as Real, across as Real);
    let axis = Vector::new(axis.x as Real, axis.y as Real, axis.z as Real);
    let turn = Rotation::from_rotation_arc(Vector::Y, axis.normalize());
    world.insert_body(
        RigidBodyBuilder::dynamic()
            .translation(Vector::new(at.x as Real, at.y as Real, at.z as Real))
            .rotation(turn.to_scaled_axis())
            .can_sleep(false)
            .additional_mass_properties(MassProperties::new(Vector::ZERO, mass as Real, inertia)),
    )
}

/// Returns the twist in rad of a cable.
fn twist(set: &CableSet, cable: CableHandle) -> f64 {
    set.get(cable).unwrap().torsion()[0].twist
}

/// Steps, and returns the twists (rad) at which a cable turns back, which unwinds from `first`.
fn extremes(
    world: &mut PhysicsWorld,
    set: &mut CableSet,
    cable: CableHandle,
    (first, steps): (f64, usize),
) -> Vec<f64> {
    let (mut extremes, mut before, mut rising) = (Vec::new(), first, false);
    for _ in 0..steps {
        set.step(world).unwrap();
        let now = twist(set, cable);
        if (now > before) != rising {
            extremes.push(before);
            rising = !rising;
        }
        before = now;
    }
    extremes
}

/// Returns the angular frequency in rad/s of a twist that oscillates about zero, by its first and
/// last passage through it within a time (s).
fn frequency(world: &mut PhysicsWorld, set: &mut CableSet, cable: CableHandle, time: f64) -> f64 {
    let dt = f64::from(world.integration_parameters.dt);
    let (mut before, mut passages) = (twist(set, cable), Vec::new());
    for k in 0..(time / dt) as usize {
        set.step(world).unwrap();
        let now = twist(set, cable);
        if before * now < 0.0 {
            // of a sine the second derivative is zero there
            passages.push((k as f64 + before / (before - now)) * dt);
        }
        before = now;
    }
    let count = passages.len() - 1;
    std::f64::consts::PI * count as f64 / (passages[count] - passages[0])
}

/// A disc that hangs on a twisted cable turns and turns back, at 1/60 s: discs and stiffnesses over
/// a decade.
///
/// Reference: sqrt(GJ/(L J)); the cable itself has no inertia about its axis.
#[test]
fn a_disc_on_a_cable_is_a_torsional_pendulum() {
    for (stiffness, length, inertia, turns) in
        [(0.02, 1.0, 2e-3, 0.5), (0.05, 0.8, 2.5e-2, 0.25), (0.2, 1.5, 4e-2, 0.4)]
    {
        let mut world = PhysicsWorld::new();
        let mass = 0.5;
        let down = -Vector3::y();
        let body = disc(&mut world, mass, [inertia, 0.6 * inertia], down * length, Vector3::y());
        let mut set = CableSet::new();
        let rope = cable(Vector3::zeros(), down * length, stiffness, turns).clamp(At::Start).build().unwrap();
        let rope = set.insert(rope);
        set.attach(&world, rope, At::End, body, Vector::ZERO, AttachmentKind::Clamp).unwrap();
        let exact = (stiffness / (length * inertia)).sqrt();
        let own = frequency(&mut world, &mut set, rope, 8.0 * TAU / exact);
        println!("GJ {stiffness}, L {length}, J {inertia}: {own} of {exact} rad/s, off by {:.1e}", own / exact - 1.0);
        assert!((own / exact - 1.0).abs() < 1e-4, "{own} of {exact} rad/s");
    }
}

/// Two free discs on a twisted cable turn against each other, along an axis of the world and askew.
///
/// Reference: sqrt(GJ/L (1/J1 + 1/J2)); their angular momenta are opposite.
#[test]
fn two_discs_turn_against_each_other_also_askew() {
    for axis in [Vector3::x(), Vector3::new(1.0, -2.0, 0.7).normalize()] {
        let (stiffness, length, [first, second]) = (0.03, 1.2, [3e-3, 8e-3]);
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        let bodies = [(first, 0.0), (second, length)]
            .map(|(inertia, s)| disc(&mut world, 0.4, [inertia, 0.7 * inertia], axis * s, axis));
        let mut set = CableSet::new();
        let rope = cable(Vector3::zeros(), axis * length, stiffness, 0.3).build().unwrap();
        let rope = set.insert(rope);
        for (at, body) in [(At::Start, bodies[0]), (At::End, bodies[1])] {
            set.attach(&world, rope, at, body, Vector::ZERO, AttachmentKind::Clamp).unwrap();
        }
        let exact = (stiffness / length * (1.0 / first + 1.0 / second)).sqrt();
        let own = frequency(&mut world, &mut set, rope, 8.0 * TAU / exact);
        println!("{own} of {exact} rad/s, off by {:.1e}", own / exact - 1.0);
        assert!((own / exact - 1.0).abs() < 1e-4, "{own} of {exact} rad/s");
        let [a, b] = bodies.map(|body| vector(world.bodies[body].angvel()).dot(&axis));
        assert!((a * first + b * second).abs() < 1e-5 * first * exact, "{a} {b}");
    }
}

/// A free dumb-bell, bent, twisted by two turns and thrown, keeps its momenta for 10 s.
///
/// Reference: conservation laws.
#[test]
fn a_twisted_dumb_bell_keeps_its_momenta() {
    for (stiffness, turns, spin, masses) in
        [(0.02, 2.0, [0.3, 1.0, 0.2], [0.5, 0.5]), (0.1, -1.0, [-1.0, 0.5, 1.5], [0.3, 2.0])]
    {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        let spin = Vector3::from(spin);
        let bodies = [0, 1].map(|k| {
            let (mass, at) = (masses[k], Vector3::x() * k as f64);
            let body = disc(&mut world, mass, [4e-3 * mass, 3e-3 * mass], at, Vector3::x());
            let velocity = spin.cross(&at);
            let [v, w] = [velocity, spin].map(|x| Vector::new(x.x as Real, x.y as Real, x.z as Real));
            world.bodies[body].set_linvel(v, true);
            world.bodies[body].set_angvel(w, true);
            body
        });
        let mut set = CableSet::new();
        let rope = cable(Vector3::zeros(), Vector3::x(), stiffness, turns).elements(8).length(1.1).build().unwrap();
        let rope = set.insert(rope);
        for (at, body) in [(At::Start, bodies[0]), (At::End, bodies[1])] {
            set.attach(&world, rope, at, body, Vector::ZERO, AttachmentKind::Clamp).unwrap();
        }
        set.step(&mut world).unwrap();
        let start = set.momentum(&world).unwrap();
        let (mut worst, mut drift, mut made) = (0.0_f64, 0.0_f64, 0.0_f64);
        let first = set.energy(&world).unwrap().total();
        for _ in 0..600 {
            set.step(&mut world).unwrap();
            let now = set.momentum(&world).unwrap();
            worst = worst.max((now.angular - start.angular).norm() / start.angular.norm());
            drift = drift.max((now.linear - start.linear).norm() / start.linear.norm());
            made = made.max(set.energy(&world).unwrap().total() - first);
        }
        println!("angular {worst:.1e}, linear {drift:.1e}, made {made:.1e} of {first} J, twist {}", twist(&set, rope));
        assert!(worst < 1e-6 && drift < 1e-6, "{worst:e} {drift:e}");
        assert!(made < 1e-6 * first, "{made:e} of {first}");
    }
}

/// Random numbers in -1 to 1.
fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(1);
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// A hundred twisted cables that are thrown with two bodies, or with one on a support, make no
/// energy: GJ, masses, twists, speeds and meshes over decades. None is refused. A thousand in the
/// long run.
///
/// Reference: the energy law. Mechanical energy and what the formula holds beside it never grow, and that is not
/// negative, so that no later energy is above their least sum so far; single precision of Rapier's states is left, 1e-5.
#[test]
fn thrown_twisted_cables_make_no_energy() {
    let runs = if std::env::var_os("LARIAT_LONG_TESTS").is_some() { 1000 } else { 100 };
    for seed in 0..runs {
        let mut next = random(seed);
        let stiffness = 0.01 * 10f64.powf(1.5 * next());
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        let elements = 3 + seed as usize % 6;
        let (twisted, slack) = (3.0 * next(), 1.0 + 0.15 * (1.0 + next()));
        let section = Section::from_stiffness(1e3 * 10f64.powf(next()), 2.0 * stiffness, 0.05).unwrap();
        let mut builder = cable(Vector3::zeros(), Vector3::x(), stiffness, twisted);
        builder = builder.section(section).elements(elements).length(slack);
        let supported = seed % 3 == 0;
        if supported {
            builder = builder.clamp(At::Start);
        }
        let mut set = CableSet::new();
        let rope = set.insert(builder.build().unwrap());
        let ends = [(At::Start, Vector3::zeros()), (At::End, Vector3::x())];
        for (at, position) in ends.into_iter().skip(usize::from(supported)) {
            let mass = 0.3 * 10f64.powf(next());
            let inertia = 5e-3 * mass * (1.5 + next());
            let body = disc(&mut world, mass, [inertia, 0.8 * inertia], position, Vector3::x());
            let mut throw =
                |speed: f64| Vector::new((speed * next()) as Real, (speed * next()) as Real, (speed * next()) as Real);
            let [v, w] = [3.0, 10.0].map(&mut throw);
            world.bodies[body].set_linvel(v, true);
            world.bodies[body].set_angvel(w, true);
            set.attach(&world, rope, at, body, Vector::ZERO, AttachmentKind::Clamp).unwrap();
        }
        set.step(&mut world).unwrap_or_else(|error| panic!("seed {seed}: {error}"));
        let read = |set: &CableSet, world: &PhysicsWorld| {
            (set.energy(world).unwrap().total(), set.get(rope).unwrap().energy_in_store())
        };
        // what the formula holds may come back
        let (now, store) = read(&set, &world);
        let scale = now + store;
        let mut lowest = scale;
        for step in 0..120 {
            set.step(&mut world).unwrap_or_else(|error| panic!("seed {seed}, step {step}: {error}"));
            let (now, store) = read(&set, &world);
            assert!(now < lowest + 1e-5 * scale, "seed {seed}, step {step}: {now} J of {scale} J, least {lowest}");
            lowest = lowest.min(now + store);
        }
        assert!(set.failures().is_empty(), "seed {seed}: {:?}", set.failures());
        let made = set.get(rope).unwrap().energy_law().made;
        assert!(made < 1e-6 * scale, "seed {seed}: {made:e} of {scale}");
    }
}

/// The disc of a wound-up pendulum, and a motor on the support.
fn hoist(start: EndSpin) -> (PhysicsWorld, CableSet, CableHandle) {
    let mut world = PhysicsWorld::new();
    let body = disc(&mut world, 0.5, [2e-3, 2e-3], -Vector3::y(), Vector3::y());
    let mut set = CableSet::new();
    let torsion = Torsion { initial_twist: 0.5, start, ..Torsion::new(0.02) };
    let effects = Effects { torsion: Some(torsion), ..Effects::default() };
    let rope = cable(Vector3::zeros(), -Vector3::y(), 0.02, 0.5).effects(effects).clamp(At::Start).build().unwrap();
    let rope = set.insert(rope);
    set.attach(&world, rope, At::End, body, Vector::ZERO, AttachmentKind::Clamp).unwrap();
    (world, set, rope)
}

/// World and set go through bincode every quarter of a second while a motor winds the cable: the
/// run continues to the bit.
///
/// Reference: the contract.
#[test]
fn a_snapshot_of_a_twisted_cable_replays_to_the_bit() {
    let motor = EndSpin::Motor { rate: 0.7, from: 0.2, until: 1.1 };
    let (mut world, mut set, rope) = hoist(motor.clone());
    let (mut other_world, mut other_set, _) = hoist(motor);
    for k in 0..6 {
        for _ in 0..15 {
            set.step(&mut world).unwrap();
            other_set.step(&mut other_world).unwrap();
        }
        let [a, b] =
            [&set, &other_set].map(|set| (twist(set, rope).to_bits(), set.get(rope).unwrap().positions().to_vec()));
        assert!(a == b, "quarter {k}");
        let saved = bincode::serialize(&(&other_world, &other_set)).unwrap();
        (other_world, other_set) = bincode::deserialize(&saved).unwrap();
    }
    assert!(twist(&set, rope).abs() > 0.1);
}

/// The torque acts on the body: the attachment's moment is it, and a motor's work is the energy
/// that the world gains.
///
/// Reference: statics of torque; conservation of energy.
#[test]
fn the_work_of_a_motor_is_the_energy_of_the_disc() {
    let motor = EndSpin::Motor { rate: 1.0, from: 0.0, until: 10.0 };
    let (mut world, mut set, rope) = hoist(motor);
    world.gravity = Vector::ZERO;
    set.step(&mut world).unwrap();
    let start = (set.energy(&world).unwrap().total(), set.get(rope).unwrap().energy_law().supports);
    for _ in 0..120 {
        set.step(&mut world).unwrap();
    }
    let now = (set.energy(&world).unwrap().total(), set.get(rope).unwrap().energy_law().supports);
    let (gained, work) = (now.0 - start.0, now.1 - start.1);
    println!("{gained} J of {work} J");
    assert!(work.abs() > 1e-3 && (gained - work).abs() < 1e-4 * work.abs(), "{gained} J of {work} J");
    let (_, held) = set.attachments().next().unwrap();
    let torque = set.get(rope).unwrap().torsion()[0].torque;
    let along = held.moment().dot(&Vector3::y());
    // right-handed about the cable, which hangs down
    println!("{along} N m of {torque} N m");
    assert!((along - torque).abs() < 0.05 * torque.abs() + 1e-5, "{along} N m, {torque} N m");
}

/// At more turns a body spins through a larger angle in a step, and the pendulum is slower by the
/// error of its rotation: of second order in the step.
///
/// Reference: sqrt(GJ/(L J)); the mean of (h w)^2/12 over the swing, (h W)^2/24 for the largest
/// rate W.
#[test]
fn a_disc_that_turns_by_turns_is_right_to_second_order() {
    let (stiffness, length, inertia, turns) = (0.2, 1.5, 4e-2, 1.5);
    let exact = f64::sqrt(stiffness / (length * inertia));
    let off = [60.0, 120.0].map(|rate| {
        let mut world = PhysicsWorld::new();
        world.integration_parameters.dt = (1.0 / rate) as Real;
        let down = -Vector3::y();
        let body = disc(&mut world, 0.5, [inertia, 0.6 * inertia], down * length, Vector3::y());
        let mut set = CableSet::new();
        let rope = cable(Vector3::zeros(), down * length, stiffness, turns).clamp(At::Start).build().unwrap();
        let integrator = Integrator { control: StepControl::MaxStep(0.25 / rate), ..rope.integrator() };
        let rope = set.insert(rope);
        set.get_mut(rope).unwrap().set_integrator(integrator).unwrap();
        set.attach(&world, rope, At::End, body, Vector::ZERO, AttachmentKind::Clamp).unwrap();
        frequency(&mut world, &mut set, rope, 8.0 * TAU / exact) / exact - 1.0
    });
    let expected = -(TAU * turns * exact / 240.0).powi(2) / 24.0;
    println!("{off:?} of {expected:.1e}");
    assert!((off[0] / expected - 1.0).abs() < 0.1 && (off[0] / off[1] - 4.0).abs() < 0.4, "{off:?}, {expected}");
}

/// A damped torsional pendulum loses its twist as the damping ratio says.
///
/// Reference: exp(-z omega t) with z = tau omega/2; the energy law.
#[test]
fn torsion_is_damped_by_its_time() {
    let (stiffness, inertia, ratio) = (0.02, 2e-3, 0.05);
    let omega = f64::sqrt(stiffness / inertia);
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::ZERO;
    let body = disc(&mut world, 0.5, [inertia, inertia], -Vector3::y(), Vector3::y());
    let mut set = CableSet::new();
    let torsion = Torsion { initial_twist: 0.1, damping: 2.0 * ratio / omega, ..Torsion::new(stiffness) };
    let effects = Effects { torsion: Some(torsion), ..Effects::default() };
    let rope = cable(Vector3::zeros(), -Vector3::y(), stiffness, 0.1).effects(effects).clamp(At::Start);
    let rope = set.insert(rope.build().unwrap());
    set.attach(&world, rope, At::End, body, Vector::ZERO, AttachmentKind::Clamp).unwrap();
    set.step(&mut world).unwrap();
    let read = |set: &CableSet, world: &PhysicsWorld| {
        (set.energy(world).unwrap().total(), set.get(rope).unwrap().effect_work().dissipated())
    };
    let start = read(&set, &world);
    let first = twist(&set, rope);
    let mut extremes = extremes(&mut world, &mut set, rope, (first, 600));
    extremes.insert(0, first);
    let last = extremes.len() - 1;
    let decay = (extremes[0] / extremes[last]).abs().ln() / last as f64;
    let exact = std::f64::consts::PI * ratio / f64::sqrt(1.0 - ratio * ratio);
    println!("{decay} of {exact} per half period");
    assert!((decay / exact - 1.0).abs() < 0.01, "{decay} of {exact}");
    let end = read(&set, &world);
    let (lost, dissipated) = (start.0 - end.0, end.1 - start.1);
    assert!((dissipated / lost - 1.0).abs() < 1e-3, "{dissipated} J of {lost} J");
}

/// A wound-down disc falls asleep, and wakes when the other end is given a motor, which twists it
/// on.
///
/// Reference: the contract; the motor's angle once the disc has followed it.
#[test]
fn a_disc_that_has_come_to_rest_sleeps_until_a_motor_is_set() {
    let mut world = PhysicsWorld::new();
    let body = disc(&mut world, 0.5, [2e-3, 2e-3], -Vector3::y(), Vector3::y());
    *world.bodies[body].activation_mut() = RigidBodyActivation::default();
    let mut set = CableSet::new();
    let torsion = Torsion { initial_twist: 0.05, damping: 0.3, ..Torsion::new(0.02) };
    let damping = Some(Damping::from_ratio(0.1, 140.0).unwrap());
    let effects = Effects { torsion: Some(torsion.clone()), damping, ..Effects::default() };
    let rope = cable(Vector3::zeros(), -Vector3::y(), 0.02, 0.05).effects(effects).clamp(At::Start);
    let rope = set.insert(rope.build().unwrap());
    set.attach(&world, rope, At::End, body, Vector::ZERO, AttachmentKind::Clamp).unwrap();
    for _ in 0..600 {
        set.step(&mut world).unwrap();
    }
    assert!(set.is_asleep(rope).unwrap());
    let time = set.get(rope).unwrap().time();
    let start = EndSpin::Motor { rate: 0.5, from: time + 0.1, until: time + 0.6 };
    let effects = Effects { torsion: Some(Torsion { start, ..torsion }), damping, ..Effects::default() };
    set.get_mut(rope).unwrap().set_effects(effects).unwrap();
    let rotation = *world.bodies[body].rotation();
    let mut most = 0.0_f64;
    for _ in 0..600 {
        set.step(&mut world).unwrap();
        most = most.max(twist(&set, rope).abs());
    }
    let turned = vector((*world.bodies[body].rotation() * rotation.inverse()).to_scaled_axis());
    println!("{most} rad, turned {turned:?}");
    assert!(most > 0.3, "{most}");
    // a quarter of a turn, right-handed about the cable, which points down
    assert!((turned + Vector3::y() * 0.25 * TAU).norm() < 0.05, "{turned:?}");
}

/// A disc that turns to and fro on its rope slower than Rapier lets a body sleep does not fall
/// asleep on the way: it comes to rest where nothing twists it.
///
/// Reference: the torque at rest is zero; 15 degrees at 1.6 rad/s are 0.42 rad/s.
#[test]
fn a_disc_that_swings_slowly_does_not_fall_asleep_on_the_way() {
    let mut world = PhysicsWorld::new();
    let body = disc(&mut world, 0.5, [2e-3, 2e-3], -Vector3::y(), Vector3::y());
    *world.bodies[body].activation_mut() = RigidBodyActivation::default();
    let mut set = CableSet::new();
    let turns = 15.0 / 360.0;
    let torsion = Torsion { initial_twist: turns, damping: 0.5, ..Torsion::new(0.005) };
    let damping = Some(Damping::from_ratio(0.1, 140.0).unwrap());
    let effects = Effects { torsion: Some(torsion), damping, ..Effects::default() };
    let rope = cable(Vector3::zeros(), -Vector3::y(), 0.005, turns).effects(effects).clamp(At::Start);
    let rope = set.insert(rope.build().unwrap());
    set.attach(&world, rope, At::End, body, Vector::ZERO, AttachmentKind::Clamp).unwrap();
    let mut slept = 0;
    for _ in 0..1800 {
        set.step(&mut world).unwrap();
        slept += usize::from(set.is_asleep(rope).unwrap());
    }
    println!("asleep for {slept} steps, {} rad of {}", twist(&set, rope), turns * TAU);
    assert!(slept > 600 && twist(&set, rope).abs() < 0.02 * turns * TAU, "{slept}: {}", twist(&set, rope));
}

/// A winch takes a rope in on which a disc turns to and fro: of its swing the action stays, so that
/// it turns faster and less far.
///
/// Reference: the adiabatic invariant E/omega of an oscillator whose stiffness GJ/L grows slowly:
/// amplitudes go with the fourth root of the length, periods with its square root.
#[test]
fn a_disc_that_is_hoisted_turns_faster_and_less_far() {
    let (mut world, mut set, rope) = hoist(EndSpin::Held);
    let reel = Reel { rate: vec![[0.0, 0.0], [10.0, -0.05], [20.0, 0.0]], ..Reel::default() };
    set.get_mut(rope).unwrap().add_reel(At::Start, reel).unwrap();
    let (mut twists, h) = (Vec::new(), 1.0 / 240.0);
    world.integration_parameters.dt = h as Real;
    for _ in 0..(32.0 / h) as usize {
        set.step(&mut world).unwrap();
        twists.push(twist(&set, rope));
    }
    assert!((set.get(rope).unwrap().length() - 0.5).abs() < 1e-6);
    // largest twist, and time from one passage of zero to the next but one, between two times
    let of = |from: f64, until: f64| {
        let part = &twists[(from / h) as usize..(until / h) as usize];
        let largest = part.iter().fold(0.0_f64, |largest, twist| largest.max(twist.abs()));
        let passages: Vec<f64> = (1..part.len())
            .filter(|&k| part[k - 1] < 0.0 && part[k] >= 0.0)
            .map(|k| h * (k as f64 - part[k] / (part[k] - part[k - 1])))
            .collect();
        (largest, (passages[passages.len() - 1] - passages[0]) / (passages.len() - 1) as f64)
    };
    let (before, after) = (of(0.0, 10.0), of(21.0, 32.0));
    println!("{before:?} before, {after:?} after");
    assert!((after.0 / before.0 / 0.5f64.powf(0.25) - 1.0).abs() < 0.03, "{before:?} {after:?}");
    assert!((after.1 / before.1 / 0.5f64.sqrt() - 1.0).abs() < 2e-3, "{before:?} {after:?}");
}

/// Two bodies on a bent, twisted cable that are moved and turned together go on as those that were
/// not: the twist stays.
///
/// Reference: the same world without the move; the laws do not depend on the place.
#[test]
fn a_bent_cable_keeps_its_twist_when_its_bodies_are_moved() {
    let run = |turn: Option<Vector>| {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        let (start, end) = (Vector3::zeros(), Vector3::new(0.6, -0.6, 0.0));
        let bodies = [(start, Vector3::x()), (end, Vector3::y())]
            .map(|(at, axis)| disc(&mut world, 0.4, [3e-3, 4e-3], at, axis));
        let mut set = CableSet::new();
        let rope = cable(start, end, 0.03, 0.2).points([start, Vector3::new(0.6, 0.0, 0.0), end]).elements(8);
        let rope = set.insert(rope.build().unwrap());
        for (at, body) in [(At::Start, bodies[0]), (At::End, bodies[1])] {
            set.attach(&world, rope, at, body, Vector::ZERO, AttachmentKind::Clamp).unwrap();
        }
        (0..20).for_each(|_| set.step(&mut world).unwrap());
        if let Some(turn) = turn {
            let by = Pose::new(Vector::new(1.0, -2.0, 0.5), turn);
            set.move_bodies(&mut world, &bodies, &by).unwrap();
        }
        let twists: Vec<f64> = (0..40)
            .map(|_| {
                set.step(&mut world).unwrap();
                twist(&set, rope)
            })
            .collect();
        twists
    };
    let stays = run(None);
    let most = stays.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    assert!(most > 0.1, "{stays:?}");
    for turn in [Vector::new(1.5, 0.0, 0.0), Vector::new(0.4, -1.2, 2.0)] {
        for (moved, stays) in run(Some(turn)).iter().zip(&stays) {
            assert!((moved - stays).abs() < 1e-3 * most, "{turn:?}: {moved} for {stays}");
        }
    }
}

/// A hold that is lost and given back between two steps has lost the twist.
///
/// Reference: what turns freely bears no torque.
#[test]
fn a_hold_that_is_given_back_begins_without_twist() {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::ZERO;
    let down = -Vector3::y();
    let body = disc(&mut world, 0.5, [2e-3, 1e-3], down, Vector3::y());
    let mut set = CableSet::new();
    let rope = set.insert(cable(Vector3::zeros(), down, 0.02, 0.5).clamp(At::Start).build().unwrap());
    let held = set.attach(&world, rope, At::End, body, Vector::ZERO, AttachmentKind::Clamp).unwrap();
    set.step(&mut world).unwrap();
    assert!(twist(&set, rope).abs() > 2.0);
    set.detach(&mut world, held).unwrap();
    set.attach(&world, rope, At::End, body, Vector::ZERO, AttachmentKind::Clamp).unwrap();
    set.step(&mut world).unwrap();
    // the disc goes on turning with what the first step gave it
    assert!(twist(&set, rope).abs() < 0.2, "{}", twist(&set, rope));
}

/// A hook that swings on a stranded rope under its weight is damped by about GJ/G of what damps one whose rope cannot
/// stretch, G = GJ + EA k^2: elongation gives way to the twist, and its rate takes part in that of the torque. With
/// axial damping of the same time it is damped by all of it.
///
/// Reference: M = GJ phi + k T + tau (GJ phi' - M' r/(1 + r)) at the tension T, r = EA k^2/GJ, by the law of the effect, where no
/// inertia is along the rope: M/phi = GJ (1 + i w tau)/(1 + i w tau r/(1 + r)), whose loss angle is twice the damping ratio. Where
/// both laws have the factor 1 + tau d/dt, so has M - k T = GJ phi.
#[test]
fn a_hook_on_a_stranded_rope_is_damped_by_a_share() {
    let (stiffness, inertia, tau, axial) = (0.5, 0.05, 0.05, 1e5);
    let omega = f64::sqrt(stiffness / inertia);
    for (factor, along) in [(0.0, 0.0), (1e-3, 0.0), (2e-3, 0.0), (2e-3, tau)] {
        let mut world = PhysicsWorld::new();
        let body = disc(&mut world, 10.0, [inertia, inertia], -Vector3::y(), Vector3::y());
        let mut set = CableSet::new();
        let torsion =
            Torsion { damping: tau, torque_per_tension: factor, initial_twist: 0.1, ..Torsion::new(stiffness) };
        let damping = Some(Damping { axial: along, bending: 0.0 });
        let effects = Effects { torsion: Some(torsion), damping, ..Effects::default() };
        let rope = cable(Vector3::zeros(), -Vector3::y(), stiffness, 0.0).effects(effects);
        let section = Section::from_stiffness(axial, 0.6, 0.1).unwrap();
        let rope = set.insert(rope.section(section).gravity(Vector3::zeros()).clamp(At::Start).build().unwrap());
        set.attach(&world, rope, At::End, body, Vector::ZERO, AttachmentKind::Clamp).unwrap();
        let extremes = extremes(&mut world, &mut set, rope, (TAU * 0.1, 1200));
        // between successive extremes, whatever the mean is
        let ways: Vec<f64> = extremes.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
        let last = ways.len() - 1;
        let decay = (ways[1] / ways[last]).ln() / (last - 1) as f64;
        let r = axial * factor * factor / stiffness;
        let of_stretch = if along > 0.0 { 0.0 } else { omega * tau * r / (1.0 + r) };
        let angle = (omega * tau).atan() - of_stretch.atan();
        let ratio = 0.5 * angle.tan();
        let exact = std::f64::consts::PI * ratio / f64::sqrt(1.0 - ratio * ratio);
        println!("k {factor} m, {along} s: {decay} of {exact} per half period, {} extremes", ways.len());
        assert!((decay / exact - 1.0).abs() < 0.03, "{factor}: {decay} of {exact}");
    }
}

/// A hook on a stranded rope turns under its load: with a right-hand lay it unlays the rope, and
/// swings about the angle at which the rope bears no torque; held, it gets the torque c d T.
///
/// Reference: k T L/GJ with k = c d and the tension T of its weight, T and GJ by hand (Green's law:
/// the weight over the stretch).
#[test]
fn a_hook_on_a_stranded_rope_turns_under_its_load() {
    let (stiffness, factor, mass) = (0.5, 0.1 * 0.01, 10.0);
    let weight = 9.81 * mass;
    let run = |end: EndSpin, frames: usize| {
        let mut world = PhysicsWorld::new();
        let body = disc(&mut world, mass, [0.05, 0.05], -Vector3::y(), Vector3::y());
        let mut set = CableSet::new();
        let torsion = Torsion { damping: 0.2, end, ..Torsion::stranded(stiffness, 0.1, 0.01) };
        let damping = Some(Damping { axial: 0.01, bending: 0.05 });
        let effects = Effects { torsion: Some(torsion), damping, ..Effects::default() };
        let rope = cable(Vector3::zeros(), -Vector3::y(), stiffness, 0.0).effects(effects);
        let section = Section::from_stiffness(1e5, 0.6, 0.1).unwrap();
        let rope = set.insert(rope.section(section).gravity(Vector3::zeros()).clamp(At::Start).build().unwrap());
        set.attach(&world, rope, At::End, body, Vector::ZERO, AttachmentKind::Clamp).unwrap();
        let mut most = 0.0f64;
        for _ in 0..frames {
            set.step(&mut world).unwrap();
            most = most.min(set.get(rope).unwrap().torsion().first().map_or(0.0, |reading| reading.twist));
        }
        let turned = vector(world.bodies[body].rotation().to_scaled_axis());
        (set.get(rope).unwrap().torsion().first().copied(), most, turned, set.get(rope).unwrap().node_position(4))
    };
    let (reading, most, turned, at) = run(EndSpin::Held, 1800);
    let over = weight / -at.y;
    let exact = -factor * over / stiffness;
    let reading = reading.unwrap();
    println!("{reading:?}, most {most}, turned {turned:?}, of {exact} rad");
    assert!((reading.twist / exact - 1.0).abs() < 1e-3 && most < 1.3 * exact, "{reading:?} {most} {exact}");
    assert!(reading.torque.abs() < 1e-4 * factor * over, "{reading:?}");
    // the rope points down: left-handed about it is right-handed about y
    assert!((turned - Vector3::y() * -exact).norm() < 1e-3 * exact.abs(), "{turned:?} {exact}");
    let softer = 1e5 * stiffness / (stiffness + 1e5 * factor * factor);
    assert!(((0.5 * (at.y * at.y - 1.0)) * softer / over - 1.0).abs() < 1e-3, "{at:?}");
    // on a swivel the rope turns alone
    let (reading, _, turned, end) = run(EndSpin::Swivel, 1800);
    assert!(reading.is_none() && turned.norm() < 1e-6, "{turned:?}");
    assert!((end - at).norm() < 1e-6, "{end:?} {at:?}");
}

/// On a body no other method than the discrete gradient carries torsion, and the step says so by
/// name; let go of the body, the cable goes on by its own.
///
/// *Source.* The contract.
#[test]
fn other_methods_carry_torsion_beside_bodies_and_not_on_them() {
    let mut world = PhysicsWorld::new();
    let body = disc(&mut world, 0.1, [1e-4, 1e-4], -Vector3::y(), Vector3::y());
    let mut set = CableSet::new();
    let esdirk = Integrator { method: Method::Esdirk4, control: StepControl::Tolerance(1e-5) };
    let built = cable(Vector3::zeros(), -Vector3::y(), 0.05, 1.0).clamp(At::Start).integrator(esdirk);
    let rope = set.insert(built.build().unwrap());
    let held = set.attach(&world, rope, At::End, body, Vector::ZERO, AttachmentKind::Clamp).unwrap();
    let error = set.step(&mut world).unwrap_err().to_string();
    assert!(error.contains("torsion") && error.contains("esdirk4") && error.contains("discrete-gradient"), "{error}");
    set.detach(&mut world, held).unwrap();
    (0..10).for_each(|_| set.step(&mut world).unwrap());
    assert!(set.get(rope).unwrap().node_position(4).y < -1.0);
}
