//! Clamps: the tangent follows the body, and the moment acts on it.

use super::bench::{Scene, soft};
use lariat_ancf::island::RigidBody;
use lariat_ancf::{At, Cable, Integrator, Method, Section, Vector3};
use nalgebra::{Matrix3, UnitQuaternion};

fn fine() -> Integrator {
    Integrator::tolerance(Method::Esdirk4, 1e-9).unwrap()
}

/// A straight bar without gravity.
fn bar(section: Section) -> Cable {
    Cable::builder()
        .points([Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0)])
        .section(section)
        .elements(6)
        .gravity(Vector3::zeros())
        .build()
        .unwrap()
}

/// A driven body, which keeps its velocities.
fn driven(at: Vector3<f64>, velocity: Vector3<f64>, spin: Vector3<f64>) -> RigidBody {
    let mut body = RigidBody::new(1.0, Matrix3::identity(), at).unwrap();
    body.free = [false; 6];
    body.velocity = velocity;
    body.angular_velocity = spin;
    body
}

/// Returns the sine of the angle between the tangent of a pin's node and its clamped direction.
fn misalignment(scene: &Scene, pin: usize) -> f64 {
    let p = &scene.pins[pin];
    let q = &scene.cables[p.cable].positions()[6 * p.node + 3..6 * p.node + 6];
    let slope = Vector3::from_column_slice(q).normalize();
    slope.cross(&(scene.bodies[p.body].rotation * p.direction.unwrap())).norm()
}

/// A cantilever under gravity, clamped to a body at rest, moves as the same cable with a clamp of
/// its own.
///
/// *Source.* The cable's own clamp, which other code computes (checked by tests/end_moment.rs and
/// elastica.rs).
#[test]
fn a_clamp_to_a_body_at_rest_matches_the_cables_own_clamp() {
    let build = || {
        Cable::builder()
            .points([Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0)])
            .section(soft())
            .elements(6)
            .integrator(fine())
    };
    let mut own = build().clamp(At::Start).build().unwrap();
    let held = build().build().unwrap();
    let mut scene = Scene::new(vec![held], vec![driven(Vector3::zeros(), Vector3::zeros(), Vector3::zeros())], fine())
        .clamp(0, At::Start, 0, Vector3::zeros());
    for _ in 0..30 {
        own.step(1.0 / 60.0).unwrap();
        scene.run(1.0 / 60.0, 1);
    }
    let apart = own.positions().iter().zip(scene.cables[0].positions()).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
    assert!(apart < 1e-8, "{apart:.1e}");
    let (reaction, account) = (own.reactions().unwrap()[0], scene.accounts()[0]);
    assert!((reaction.force + account.force).norm() < 1e-5 * account.force.norm(), "{reaction:?} {account:?}");
    assert!((reaction.moment + account.moment).norm() < 1e-5 * account.moment.norm(), "{reaction:?} {account:?}");
}

/// A mass with rotary inertia on the tip of a clamped massless beam, released in the shape of one
/// of its two modes, is back at its start after a period of that mode.
///
/// *Source.* Euler-Bernoulli beam with K = EI/L^3 (12, -6L; -6L, 4L^2) about (deflection, rotation)
/// of the tip, M = (m, I).
#[test]
fn a_body_on_the_tip_of_a_beam_has_the_two_analytic_frequencies() {
    let (ei, mass, inertia): (f64, f64, f64) = (10.0, 2.0, 0.4);
    let k = [[12.0 * ei, -6.0 * ei], [-6.0 * ei, 4.0 * ei]];
    // det(K - w^2 M) = 0
    let (a, b, c) = (mass * inertia, -(k[0][0] * inertia + k[1][1] * mass), k[0][0] * k[1][1] - k[0][1] * k[1][0]);
    for sign in [-1.0f64, 1.0] {
        let omega = ((-b + sign * (b * b - 4.0 * a * c).sqrt()) / (2.0 * a)).sqrt();
        let shape = [1.0, (k[0][0] - omega * omega * mass) / -k[0][1]];
        let light = Section::from_stiffness(1e6, ei, 1e-6).unwrap();
        let mut body = RigidBody::new(mass, Matrix3::from_diagonal_element(inertia), Vector3::x()).unwrap();
        let speed = 1e-3;
        body.velocity.y = speed * shape[0];
        body.angular_velocity.z = speed * shape[1];
        let start = body.clone();
        let rest = driven(Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
        let mut scene =
            Scene::new(vec![bar(light)], vec![rest, body], Integrator::tolerance(Method::Esdirk3, 1e-9).unwrap())
                .clamp(0, At::Start, 0, Vector3::zeros())
                .clamp(0, At::End, 1, Vector3::zeros());
        scene.run(std::f64::consts::TAU / omega / 40.0, 40);
        let after = &scene.bodies[1];
        let (away, error) = (speed / omega, (after.position - start.position).norm());
        assert!(error < 2e-3 * away, "mode {sign}: {error:.1e} of {away:.1e} m");
        assert!((after.velocity - start.velocity).norm() < 2e-3 * speed, "mode {sign}: {:?}", after.velocity);
        assert!((after.angular_velocity.z - start.angular_velocity.z).abs() < 2e-3 * speed * shape[1].abs());
    }
}

/// Two bricks clamped to the ends of a bar, translating and rotating in space: momenta and energy
/// are conserved, and the tangents stay in their clamps.
///
/// *Source.* Conservation laws.
#[test]
fn clamped_bodies_conserve_momenta_and_energy() {
    let mut ends = [0.0, 1.0].map(|x| {
        let inertia = Matrix3::from_diagonal(&Vector3::new(0.002, 0.005, 0.006));
        let mut body = RigidBody::new(0.5 + x, inertia, Vector3::new(x, 0.03, 0.0)).unwrap();
        body.rotation = UnitQuaternion::from_euler_angles(0.3, -0.5 * x, 1.1);
        body
    });
    ends[0].velocity = Vector3::new(0.0, 1.0, 0.3);
    ends[1].velocity = Vector3::new(0.0, -0.5, 0.2);
    ends[1].angular_velocity = Vector3::new(2.0, 0.5, 1.0);
    let anchors = [0.0, 1.0].map(|x| Vector3::new(x, 0.0, 0.0));
    let local: Vec<Vector3<f64>> =
        ends.iter().zip(anchors).map(|(b, a)| b.rotation.inverse() * (a - b.position)).collect();
    let mut scene = Scene::new(vec![bar(soft())], ends.to_vec(), fine()).clamp(0, At::Start, 0, local[0]).clamp(
        0,
        At::End,
        1,
        local[1],
    );
    scene.run(1e-3, 1);
    let (before, energy) = (scene.momentum(), scene.energy());
    scene.run(1.0 / 60.0, 60);
    let after = scene.momentum();
    assert!((after.0 - before.0).norm() < 1e-9, "{:.1e}", (after.0 - before.0).norm());
    assert!((after.1 - before.1).norm() < 1e-7, "{:.1e}", (after.1 - before.1).norm());
    assert!((scene.energy() - energy).abs() < 1e-5 * energy, "{} {energy}", scene.energy());
    assert!(scene.gap() < 1e-12 && misalignment(&scene, 0) < 1e-12 && misalignment(&scene, 1) < 1e-12);
}

/// A driven body rotates a bar that is clamped to it off its centre, about an inclined axis: the
/// energy of the bar is the work at the clamp, and the tangent stays in the clamp.
///
/// *Source.* Conservation of energy.
#[test]
fn the_work_of_a_driven_body_is_the_energy_gain_of_its_cable() {
    let mut scene = Scene::new(
        vec![bar(soft())],
        vec![driven(Vector3::new(0.0, -0.2, 0.1), Vector3::zeros(), Vector3::new(0.3, 1.5, 0.8))],
        fine(),
    )
    .clamp(0, At::Start, 0, Vector3::new(0.0, 0.2, -0.1));
    // in the first step the bar takes the velocity of the body by an impact, whose energy loss is
    // not in the work
    scene.run(1.0 / 240.0, 1);
    let before = scene.energy();
    let (mut work, mut passed) = (0.0, 0.0);
    for _ in 0..240 {
        scene.run(1.0 / 240.0, 1);
        work -= scene.accounts()[0].work;
        passed += scene.accounts()[0].work.abs();
    }
    let gained = scene.energy() - before;
    assert!(passed > 0.1, "{passed}");
    assert!((gained - work).abs() < 1e-3 * passed, "gained {gained} J, work {work} J of {passed}");
    assert!(misalignment(&scene, 0) < 1e-12);
}

/// Impulse and work at the pin of the payload, with those of gravity, are the changes of the body's
/// momentum and energy.
///
/// *Source.* Newton's second law, work and energy.
#[test]
fn impulse_and_work_at_a_pin_change_momentum_and_energy_of_its_body() {
    let mut scene = super::bench::payload(soft(), 50.0, fine());
    let weight = scene.bodies[0].force;
    let (mut impulse, mut work, mut fall) = (Vector3::zeros(), 0.0, 0.0);
    for _ in 0..60 {
        let y = scene.bodies[0].position.y;
        scene.run(1.0 / 60.0, 1);
        let account = scene.accounts()[0];
        impulse += account.impulse + weight / 60.0;
        work += account.work;
        fall += weight.y * (scene.bodies[0].position.y - y);
    }
    let body = &scene.bodies[0];
    let momentum = body.mass * body.velocity;
    assert!((momentum - impulse).norm() < 1e-3 * momentum.norm(), "{momentum:?} {impulse:?}");
    let energy = body.kinetic_energy();
    assert!((energy - work - fall).abs() < 1e-3 * energy, "{energy} J, work {work} J and {fall} J");
}

/// A slope that is not in its clamp's direction rotates into it within the step, and stays there.
///
/// *Source.* The contract of a clamp.
#[test]
fn a_clamp_rotates_a_slope_into_its_direction_within_the_step() {
    let body = driven(Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
    let mut scene = Scene::new(vec![bar(soft())], vec![body], fine()).clamp(0, At::Start, 0, Vector3::zeros());
    let wanted = Vector3::new(1.0, 0.2, -0.1).normalize();
    scene.pins[0].direction = Some(wanted);
    scene.run(1.0 / 60.0, 1);
    assert!(misalignment(&scene, 0) < 1e-9, "{:.1e}", misalignment(&scene, 0));
    scene.run(1.0 / 60.0, 10);
    assert!(misalignment(&scene, 0) < 1e-12);
}

/// Two bodies, clamped to the ends of a rope without bending stiffness, move towards and past each
/// other: the slopes at the ends of the rope reverse against their clamps. Energy and angular
/// momentum are conserved.
///
/// *Source.* Conservation laws: a stretch that passes through zero is not a rotation.
#[test]
fn a_slope_that_reverses_at_a_clamp_creates_no_energy() {
    let limp = Section::from_stiffness(100.0, 0.0, 0.1).unwrap();
    let ends = [0.0, 1.0].map(|x| {
        let mut body = RigidBody::new(1.0, Matrix3::from_diagonal_element(0.01), Vector3::new(x, 0.0, 0.0)).unwrap();
        body.velocity = Vector3::new(3.0 - 6.0 * x, 0.2 * x, 0.0);
        body.angular_velocity = Vector3::new(0.0, 0.0, 1.0 - 3.0 * x);
        body
    });
    let mut scene = Scene::new(vec![bar(limp)], ends.to_vec(), fine()).clamp(0, At::Start, 0, Vector3::zeros()).clamp(
        0,
        At::End,
        1,
        Vector3::zeros(),
    );
    let angular = scene.momentum().1;
    // in the first step the ends of the rope, initially at rest, take the velocities of their
    // bodies by an inelastic impact
    scene.run(1.0 / 240.0, 1);
    let start = scene.energy();
    let mut reversed = 0;
    for _ in 0..120 {
        scene.run(1.0 / 240.0, 1);
        for p in &scene.pins {
            let q = &scene.cables[0].positions()[6 * p.node + 3..6 * p.node + 6];
            let along = scene.bodies[p.body].rotation * p.direction.unwrap();
            reversed += usize::from(Vector3::from_column_slice(q).dot(&along) < 0.0);
        }
        assert!((scene.energy() - start).abs() < 1e-5 * start, "{} J of {start} J", scene.energy() - start);
    }
    assert!(reversed > 5, "the slopes never reversed");
    assert!((scene.momentum().1 - angular).norm() < 1e-6, "{:?} {angular:?}", scene.momentum().1);
}
