//! Cable ends on kinematic bodies that turn, circle, start and stop.

use super::common::{add_cube, cable, weightless};
use lariat_ancf::coupling::Coupling;
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{At, CableBuilder, Damping, Fidelity, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableSet};

/// Returns EA = 1e5 N, 0.1 kg/m, EI = 0.05 N m^2, with internal friction.
fn rope(from: [f64; 3], to: [f64; 3]) -> CableBuilder {
    let section = Section::from_stiffness(1e5, 0.05, 0.1).unwrap();
    cable(from, to, section).damping(Damping { axial: 1e-3, bending: 1e-3 })
}

/// Returns the force that the end of a rope on a rotor reads after a second, if the rotor's centre of mass is on its axis.
fn pull_on_rotor(fidelity: Fidelity, by_pose: bool, clamp: bool, speed: f64, frequency: f64) -> f64 {
    pull_on_eccentric_rotor(fidelity, by_pose, clamp, (speed, 0.0), frequency)
}

/// Returns the force that the end of a rope on a rotor reads after a second. The rotor turns about its centre of mass, `offset` (m) from its
/// origin.
fn pull_on_eccentric_rotor(
    fidelity: Fidelity,
    by_pose: bool,
    clamp: bool,
    (speed, offset): (f64, f64),
    frequency: f64,
) -> f64 {
    let mut world = weightless();
    world.integration_parameters.dt = 1.0 / frequency as Real;
    let builder = if by_pose {
        RigidBodyBuilder::kinematic_position_based()
    } else {
        RigidBodyBuilder::kinematic_velocity_based()
    };
    let centre = Vector::new(0.0, offset as Real, 0.0);
    let builder = builder.translation(-centre).angvel(Vector::new(0.0, 0.0, speed as Real));
    let (rotor, _) = world.insert(builder, ColliderBuilder::ball(0.05).translation(centre).mass(1.0));
    let mut set = CableSet::new();
    let lash = rope([0.2, 0.0, 0.0], [1.2, 0.0, 0.0]).gravity(Vector3::zeros()).fidelity(fidelity);
    let lash = set.insert(lash.build().unwrap());
    let spin = Vector3::new(0.0, 0.0, speed);
    set.get_mut(lash).unwrap().set_rigid_motion(spin.cross(&Vector3::new(0.2, 0.0, 0.0)), spin).unwrap();
    let kind = if clamp { AttachmentKind::Clamp } else { AttachmentKind::Ball };
    let rim = Vector::new(0.2, 0.0, 0.0) + centre;
    let end = set.attach(&world, lash, At::Start, rotor, rim, kind).unwrap();
    for k in 1..=frequency as usize {
        if by_pose {
            let turned = Pose::new(Vector::ZERO, Vector::new(0.0, 0.0, (speed * k as f64 / frequency) as Real));
            let pose = Pose::from_parts(turned.rotation * -centre, turned.rotation);
            world.bodies[rotor].set_next_kinematic_position(pose);
        }
        set.step(&mut world).unwrap();
    }
    set.attachment(end).unwrap().force().norm()
}

/// A rope on the rim of a rotor, by a ball and by a clamp, 1 to 30 rad/s, in steps of 1/30 to 1/960
/// s: it hangs straight out in the rotating frame.
///
/// Reference: the force of inertia, w^2 mu ((r + L)^2 - r^2)/2, plus 0.3 % for the stretch at 30
/// rad/s. The chord in place of v + w x r read 4.96 N of 7 at 10 rad/s and 60 Hz; the cubic through
/// the ends of a host step, in fidelity game, 36.7 of 63 N at half a radian per host step.
#[test]
fn a_rope_on_a_rotor_pulls_with_its_force_of_inertia() {
    for (by_pose, clamp, speed, frequency) in [
        (false, false, 10.0, 60.0),
        (true, false, 10.0, 60.0),
        (false, true, 10.0, 60.0),
        (true, true, 10.0, 60.0),
        (false, false, 10.0, 960.0),
        (false, false, 1.0, 30.0),
        (true, true, 3.0, 240.0),
        (false, false, 30.0, 120.0),
        (true, false, 30.0, 60.0),
        (false, true, 30.0, 120.0),
        (false, false, 15.0, 60.0),
        (true, true, 20.0, 60.0),
        (false, false, 30.0, 240.0),
    ] {
        let expected = speed * speed * 0.1 * (1.2f64.powi(2) - 0.04) / 2.0;
        let pull = pull_on_rotor(Fidelity::Engineering, by_pose, clamp, speed, frequency);
        let case =
            format!("by pose {by_pose}, clamp {clamp}, {speed} rad/s at {frequency} Hz: {pull:.4} N of {expected:.4}");
        println!("{case}");
        assert!((pull / expected - 1.0).abs() < 1e-2, "{case}");
        let pull = pull_on_rotor(Fidelity::Game, by_pose, clamp, speed, frequency);
        println!("game: {pull:.4} N");
        assert!((pull / expected - 1.0).abs() < 2e-2, "game: {pull:.4} N; {case}");
    }
}

/// A rotor whose centre of mass is half a metre or more from its origin, as of an arm that is drawn from its hub: Rapier turns it about the
/// centre of mass, and the origin moves on a circle.
///
/// Reference: the force of inertia, as above.
#[test]
fn a_rope_on_an_eccentric_rotor_pulls_with_its_force_of_inertia() {
    for fidelity in [Fidelity::Engineering, Fidelity::Game] {
        for (by_pose, clamp, speed, offset, frequency) in [
            (false, false, 10.0, 0.5, 60.0),
            (false, true, 10.0, 0.5, 60.0),
            (false, false, 20.0, 2.0, 60.0),
            (false, true, 15.0, 1.0, 30.0),
            (false, false, 3.0, 5.0, 240.0),
            (true, false, 10.0, 0.5, 60.0),
            (true, true, 20.0, 1.0, 60.0),
        ] {
            let expected = speed * speed * 0.1 * (1.2f64.powi(2) - 0.04) / 2.0;
            let pull = pull_on_eccentric_rotor(fidelity, by_pose, clamp, (speed, offset), frequency);
            let case = format!(
                "{fidelity:?}, by pose {by_pose}, clamp {clamp}, {speed} rad/s, offset {offset} m, {frequency} Hz: {pull:.4} N of {expected:.4}"
            );
            println!("{case}");
            assert!((pull / expected - 1.0).abs() < 2e-2, "{case}");
        }
    }
}

/// Ropes with strong internal friction, on the rims of rotors of any size and speed: what friction takes must not hide the errors of the
/// iteration. Undetected they grow to a thousand times the force.
///
/// Reference: the mean over a second of the force of inertia, as above; a rope in the plane of the rotor may swing.
#[test]
fn a_damped_rope_on_a_rotor_pulls_with_its_force_of_inertia() {
    for (radius, length, mass, stiffness, damping, clamp, speed, frequency) in [
        (0.42, 0.59, 0.109, 1.5e6, 0.01, true, 25.9, 30.0),
        (0.42, 0.59, 0.109, 1.5e6, 0.01, false, 20.0, 60.0),
        (0.42, 0.59, 0.109, 1.5e6, 0.01, false, 25.0, 30.0),
        (0.42, 0.59, 0.109, 1.5e6, 0.01, false, 30.0, 60.0),
        (0.1, 1.0, 0.02, 3e5, 0.05, false, 12.0, 60.0),
        (1.0, 0.4, 0.4, 4e6, 0.003, true, 18.0, 120.0),
        (0.05, 2.0, 0.05, 1e6, 0.02, false, 7.0, 240.0),
    ] {
        let mut world = weightless();
        world.integration_parameters.dt = 1.0 / frequency as Real;
        // by poses: Rapier rotates by less than the velocity says, 6 % at 0.86 rad per step
        let rotor = RigidBodyBuilder::kinematic_position_based().angvel(Vector::new(0.0, 0.0, speed as Real));
        let rotor = world.insert_body(rotor);
        let mut set = CableSet::new();
        let section = Section::from_stiffness(stiffness, 1e-7 * stiffness, mass).unwrap();
        let lash = cable([radius, 0.0, 0.0], [radius + length, 0.0, 0.0], section)
            .damping(Damping { axial: damping, bending: damping })
            .gravity(Vector3::zeros())
            .fidelity(Fidelity::Game);
        let lash = set.insert(lash.build().unwrap());
        let spin = Vector3::new(0.0, 0.0, speed);
        set.get_mut(lash).unwrap().set_rigid_motion(spin.cross(&Vector3::new(radius, 0.0, 0.0)), spin).unwrap();
        let kind = if clamp { AttachmentKind::Clamp } else { AttachmentKind::Ball };
        let end = set.attach(&world, lash, At::Start, rotor, Vector::new(radius as Real, 0.0, 0.0), kind).unwrap();
        let expected = speed * speed * mass * length * (radius + 0.5 * length);
        let (steps, mut sum, mut largest) = (2 * frequency as usize, 0.0, 0.0_f64);
        for step in 0..steps {
            let angle = (speed * (step + 1) as f64 / frequency) as Real;
            let pose = Pose::new(Vector::ZERO, Vector::new(0.0, 0.0, angle));
            world.bodies[rotor].set_next_kinematic_position(pose);
            set.step(&mut world).unwrap();
            let pull = set.attachment(end).unwrap().force().norm();
            // friction takes the jerk with which the rope gets its stretch
            if 2 * step >= steps {
                sum += pull;
                largest = largest.max(pull);
            }
        }
        let (mean, largest) = (sum / frequency / expected, largest / expected);
        let case = format!("{radius} m, {length} m, {speed} rad/s at {frequency} Hz: {mean:.4}, at most {largest:.4}");
        println!("{case}");
        assert!((mean - 1.0).abs() < 1e-2 && largest < 1.1, "{case}");
    }
}

/// What moves the winch of [`towed`].
#[derive(Clone, Copy, Debug, PartialEq)]
enum Winch {
    /// By poses.
    Poses,
    /// By velocities, the chords between the poses.
    Velocities,
}

/// Moves a winch on `path` (m, by time in s) for `duration` (s), a bob of `mass` (kg) on 2 m of
/// rope below it, in host steps of 1/`frequency` s. Returns the position of the bob, and the
/// largest force on it.
fn towed(
    winch: Winch,
    path: impl Fn(f64) -> Vector3<f64>,
    (mass, duration, frequency): (f64, f64, f64),
    start: Vector3<f64>,
) -> (Vector3<f64>, f64) {
    let mut world = PhysicsWorld::new();
    world.integration_parameters.dt = 1.0 / frequency as Real;
    let builder = match winch {
        Winch::Poses => RigidBodyBuilder::kinematic_position_based(),
        Winch::Velocities => RigidBodyBuilder::kinematic_velocity_based(),
    };
    let (at, to_vector) = (path(0.0), lariat_rapier::convert::to_vector);
    let body = world.insert_body(builder.translation(to_vector(&at)));
    let low = at.y - 2.0 - mass * 9.81 * 2.0 / 1e5;
    let bob = add_cube(&mut world, mass as Real, 0.05, [at.x as Real, low as Real, at.z as Real]);
    world.bodies[bob].set_linvel(to_vector(&start), true);
    let mut set = CableSet::new();
    let line = rope([at.x, low, at.z], [at.x, at.y, at.z]).length(2.0);
    let line = set.insert(line.build().unwrap());
    set.get_mut(line).unwrap().set_rigid_motion(start, Vector3::zeros()).unwrap();
    let low = set.attach(&world, line, At::Start, bob, Vector::ZERO, AttachmentKind::Ball).unwrap();
    set.attach(&world, line, At::End, body, Vector::ZERO, AttachmentKind::Ball).unwrap();
    let mut peak = 0.0f64;
    for k in 0..(duration * frequency).round() as usize {
        let next = path((k + 1) as f64 / frequency);
        match winch {
            Winch::Poses => {
                world.bodies[body].set_next_kinematic_position(Pose::from_translation(to_vector(&next)));
            }
            Winch::Velocities => {
                let velocity = (next - vector(world.bodies[body].translation())) * frequency;
                world.bodies[body].set_linvel(to_vector(&velocity), true);
            }
        }
        set.step(&mut world).unwrap();
        peak = peak.max(force_at(&set, low));
    }
    (vector(world.bodies[bob].translation()), peak)
}

fn force_at(set: &CableSet, attachment: AttachmentHandle) -> f64 {
    set.attachment(attachment).unwrap().force().norm()
}

/// A winch on a circle of 0.5 m, 2 s a turn, with a bob of 1 and 20 kg: at 60 Hz the bob is within
/// 2 mm of where it is at 960 Hz, by poses and by velocities.
///
/// Reference: the same motion in steps a sixteenth as long.
#[test]
fn a_bob_on_a_circling_winch_does_not_depend_on_the_step() {
    let circle =
        |t: f64| Vector3::new(0.5 * (core::f64::consts::PI * t).cos(), 0.0, 0.5 * (core::f64::consts::PI * t).sin());
    let start = Vector3::new(0.0, 0.0, 0.5 * core::f64::consts::PI);
    for mass in [1.0, 20.0] {
        let (fine, _) = towed(Winch::Poses, circle, (mass, 3.0, 960.0), start);
        for winch in [Winch::Poses, Winch::Velocities] {
            let (coarse, _) = towed(winch, circle, (mass, 3.0, 60.0), start);
            let case = format!("{mass} kg, {winch:?}: {:.1e} m", (coarse - fine).norm());
            println!("{case}");
            assert!((coarse - fine).norm() < 2e-3, "{case}");
        }
    }
}

/// A hoist starts at once at 0.2 m/s with 150 kg on the rope: the tension swings up to the weight
/// plus v sqrt(k m).
///
/// Reference: an oscillator whose support starts at v, k = EA/L, within 3 % for the mass and the
/// friction of the rope. A motion that starts smoothly overshoots it.
#[test]
fn a_hoist_that_starts_at_once_overshoots_by_the_impedance() {
    let path = |t: f64| Vector3::new(0.0, 0.2 * (t - 0.3).max(0.0), 0.0);
    let (stiffness, mass) = (1e5 / 2.0, 150.0);
    let expected = mass * 9.81 + 0.2 * f64::sqrt(stiffness * mass);
    for winch in [Winch::Poses, Winch::Velocities] {
        let (_, peak) = towed(winch, path, (mass, 0.7, 60.0), Vector3::zeros());
        println!("{winch:?}: {peak:.0} N of {expected:.0}");
        assert!((peak / expected - 1.0).abs() < 0.05, "{winch:?}: {peak:.0} N of {expected:.0}");
    }
}
