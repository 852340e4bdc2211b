//! Free flight: momenta and tension of a rotating dumbbell.

use super::common::{add_cube, cable, gap, soft, tension, weightless, wire};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{At, Cable, Damping, Fidelity, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

const SPIN: f64 = 5.0;
/// Distance of the anchors from the centres of the balls in m.
const ARM: f64 = 0.1;

/// A cable of Green-strain material that rotates in equilibrium between two balls, by shooting on
/// the position of its start.
struct Steady {
    start: f64,
    positions: Vec<(f64, f64)>,
    /// By node, tension.
    tension: Vec<f64>,
}

/// Returns the stretch f at a tension, `N = EA (f^2 - 1)/2 f`.
fn stretch(n: f64, ea: f64) -> f64 {
    let mut f = 1.0 + n / ea;
    for _ in 0..50 {
        f -= (0.5 * (f * f - 1.0) * f - n / ea) / (1.5 * f * f - 0.5);
    }
    f
}

impl Steady {
    /// Solves x' = f(N), N' = -mu w^2 x with Runge-Kutta steps for a cable of `length` (m) between
    /// balls of masses `m` (kg).
    fn solve(section: Section, length: f64, m: [f64; 2], nodes: usize) -> Steady {
        let (ea, mu) = (section.axial_stiffness, section.mass_per_length);
        let shoot = |start: f64| {
            // the first ball, at start - ARM < 0, is pulled inwards
            let (mut x, mut n) = (start, -m[0] * SPIN * SPIN * (start - ARM));
            let (fine, mut positions, mut tensions) = (200, vec![], vec![]);
            let h = length / ((nodes - 1) * fine) as f64;
            let rate = |x: f64, n: f64| (stretch(n, ea), -mu * SPIN * SPIN * x);
            for k in 0..=(nodes - 1) * fine {
                if k % fine == 0 {
                    positions.push((x, stretch(n, ea)));
                    tensions.push(n);
                }
                if k < (nodes - 1) * fine {
                    let a = rate(x, n);
                    let b = rate(x + 0.5 * h * a.0, n + 0.5 * h * a.1);
                    x += h * b.0;
                    n += h * b.1;
                }
            }
            let missing = n - m[1] * SPIN * SPIN * (x + ARM);
            (missing, positions, tensions)
        };
        let (mut low, mut high) = (-length, 0.0);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if shoot(middle).0 > 0.0 { low = middle } else { high = middle }
        }
        let (_, positions, tension) = shoot(low);
        Steady { start: low, positions, tension }
    }
}

/// Balls of 1 kg and 10 kg on a cable of 1.8 m (soft; steel wire) rotate at 5 rad/s in space for 10
/// s, from their steady state: momenta are conserved, and the tension at every node in every frame
/// is the analytic one. In fidelity game angular momentum is conserved to 1e-4, and the tension is
/// right once the axial vibration of the first steps has decayed, after a second.
///
/// Reference: conservation laws; [`Steady`].
#[test]
fn a_rotating_dumbbell_keeps_its_momenta_and_its_tension() {
    let engineering = (Fidelity::Engineering, 5e-7, 1e-3);
    let game = (Fidelity::Game, 1e-4, 5e-3);
    for (section, (fidelity, most_turned, most_tension)) in
        [(soft(), engineering), (wire(), engineering), (soft(), game), (wire(), game)]
    {
        let steady = Steady::solve(section, 1.8, [1.0, 10.0], 11);
        let mut world = weightless();
        let ends = [steady.start - ARM, steady.positions[10].0 + ARM];
        let balls = [(1.0, ends[0]), (10.0, ends[1])].map(|(mass, x)| {
            let body = RigidBodyBuilder::dynamic()
                .translation(Vector::new(x as Real, 0.0, 0.0))
                .linvel(Vector::new(0.0, (SPIN * x) as Real, 0.0))
                .angvel(Vector::new(0.0, 0.0, SPIN as Real));
            world.insert(body, ColliderBuilder::ball(0.1).mass(mass)).0
        });
        let builder =
            cable([steady.start, 0.0, 0.0], [steady.start + 1.8, 0.0, 0.0], section).gravity(Vector3::zeros());
        let mut sling: Cable = builder.fidelity(fidelity).build().unwrap();
        let (q, rates): (Vec<_>, Vec<_>) = steady
            .positions
            .iter()
            .map(|(x, f)| ([*x, 0.0, 0.0, *f, 0.0, 0.0], [0.0, SPIN * x, 0.0, 0.0, SPIN * f, 0.0]))
            .unzip();
        sling.set_coordinates(&q.concat(), &rates.concat()).unwrap();
        let mut set = CableSet::new();
        let sling = set.insert(sling);
        set.attach(&world, sling, At::Start, balls[0], Vector::new(0.1, 0.0, 0.0), AttachmentKind::Ball).unwrap();
        set.attach(&world, sling, At::End, balls[1], Vector::new(-0.1, 0.0, 0.0), AttachmentKind::Ball).unwrap();
        let momenta = |world: &PhysicsWorld, set: &CableSet| {
            let m = set.get(sling).unwrap().momentum();
            let (mut p, mut l) = (m.linear, m.angular);
            for ball in balls {
                let b = &world.bodies[ball];
                let mass = f64::from(b.mass());
                let push = vector(b.linvel()) * mass;
                p += push;
                l += vector(b.center_of_mass()).cross(&push) + vector(b.angvel()) * (0.4 * mass * 0.01);
            }
            (p, l)
        };
        let (p0, l0) = momenta(&world, &set);
        let (mut worst, mut widest, mut dp) = (0.0f64, 0.0f64, 0.0f64);
        for frame in 0..600 {
            set.step(&mut world).unwrap();
            widest = widest.max(gap(&set));
            dp = dp.max((momenta(&world, &set).0 - p0).norm());
            if fidelity == Fidelity::Game && frame < 60 {
                continue;
            }
            for (node, n) in steady.tension.iter().enumerate() {
                worst = worst.max((tension(&set, sling, 0.18 * node as f64) / n - 1.0).abs());
            }
        }
        let (p, l) = momenta(&world, &set);
        let turned = (l - l0).norm() / l0.norm();
        let case = format!(
            "{fidelity:?}, EA {:.1e} N: dp {dp:.1e} kg m/s, dL/L {turned:.1e}, tension {worst:.1e}, gap {widest:.1e} m",
            section.axial_stiffness
        );
        println!("{case}");
        assert!(
            dp < 1e-5 && (p - p0).norm() < 1e-5 && turned < most_turned && worst < most_tension && widest < 1e-6,
            "{case}"
        );
    }
}

/// A brick tumbles in space, about its middle axis at first, with a cable at rest tied to its centre of mass: angular momentum and kinetic energy
/// stay.
///
/// Reference: conservation laws.
#[test]
fn a_tumbling_brick_keeps_its_angular_momentum_and_energy() {
    let mut world = weightless();
    let body = RigidBodyBuilder::dynamic().angvel(Vector::new(0.1, 5.0, 0.1));
    let (brick, _) = world.insert(body, ColliderBuilder::cuboid(0.1, 0.2, 0.3).mass(1.0));
    let mut set = CableSet::new();
    let rope = cable([0.0; 3], [1.0, 0.0, 0.0], soft()).gravity(Vector3::zeros()).fidelity(Fidelity::Engineering);
    let rope = set.insert(rope.build().unwrap());
    set.attach(&world, rope, At::Start, brick, Vector::ZERO, AttachmentKind::Ball).unwrap();
    let inertia = Vector3::new(0.13, 0.10, 0.05) / 3.0;
    let read = |world: &PhysicsWorld| {
        let body = &world.bodies[brick];
        let rotation = lariat_rapier::convert::rotation(*body.rotation());
        let spin = rotation.inverse() * vector(body.angvel());
        let momentum = inertia.component_mul(&spin);
        (rotation * momentum, 0.5 * spin.dot(&momentum))
    };
    let (l0, t0) = read(&world);
    for _ in 0..300 {
        set.step(&mut world).unwrap();
    }
    let (l, t) = read(&world);
    let (turned, gained) = ((l - l0).norm() / l0.norm(), t / t0 - 1.0);
    println!("dL/L {turned:.1e}, dT/T {gained:.1e}");
    assert!(turned < 1e-4 && gained.abs() < 1e-4, "dL/L {turned:.1e}, dT/T {gained:.1e}");
}

/// A point mass, a body without collider or inertia, swings on a light cord; and one that a spherical joint hangs below a cube on a cord.
///
/// Reference: energy, and the cord's pull at the lowest point, m g (3 - 2 cos 60 deg) = 2 m g, of all that hangs on it.
#[test]
fn a_point_mass_swings() {
    for joint in [false, true] {
        let mut world = PhysicsWorld::new();
        let mut set = CableSet::new();
        let out = [3f64.sqrt(), -1.0, 0.0].map(|x| x as Real);
        let at = Vector::from(out);
        let point = RigidBodyBuilder::dynamic().translation(at).additional_mass(2.0);
        let point = world.insert_body(point);
        let held = if joint {
            let cube = add_cube(&mut world, 3.0, 0.05, out);
            world.insert_impulse_joint(cube, point, SphericalJointBuilder::new());
            cube
        } else {
            point
        };
        let cord = cable([0.0; 3], [3f64.sqrt(), -1.0, 0.0], Section::from_stiffness(1e5, 1e-3, 1e-3).unwrap());
        let cord = set.insert(cord.damping(Damping { axial: 1e-3, bending: 1e-3 }).fix(At::Start).build().unwrap());
        let end = set.attach(&world, cord, At::End, held, Vector::ZERO, AttachmentKind::Ball).unwrap();
        let (mut largest, mut lowest) = (0.0f64, 0.0f64);
        for _ in 0..240 {
            set.step(&mut world).unwrap();
            largest = largest.max(set.attachment(end).unwrap().force().norm());
            lowest = lowest.min(f64::from(world.bodies[point].translation().y));
        }
        let weight = if joint { 5.0 } else { 2.0 } * 9.81;
        println!("joint {joint}: {largest:.3} N of {:.3}, lowest {lowest:.4} m", 2.0 * weight);
        assert!((largest / (2.0 * weight) - 1.0).abs() < 0.01, "joint {joint}: {largest} N");
        assert!((lowest + 2.0).abs() < 0.01, "joint {joint}: {lowest} m");
    }
}
