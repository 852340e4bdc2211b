//! Clamps: moments reach the body.

use super::common::{add_cube, cable, gap, run, soft, weightless};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{At, Cable, Damping, Integrator, Method, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

/// Returns a beam: axial stiffness 1e6 N, bending stiffness `ei` (N m^2), almost no mass.
fn beam(ei: f64) -> Section {
    Section::from_stiffness(1e6, ei, 1e-4).unwrap()
}

/// Returns an L-stable integrator, which damps the modes of a massless beam to rest.
fn massless_beam_integrator() -> Integrator {
    Integrator::tolerance(Method::Esdirk3, 1e-7).unwrap()
}

/// A body is clamped to the tip of a massless beam, and the beam to a fixed or kinematic body. Set
/// in motion in the lower of its two modes, it is back after a period.
///
/// Reference: Euler-Bernoulli beam, K = EI/L^3 (12, -6L; -6L, 4L^2) for deflection and rotation of
/// the tip, M = (m, I).
#[test]
fn a_body_clamped_to_the_tip_of_a_beam_oscillates_at_its_natural_frequency() {
    let (ei, mass, inertia) = (10.0f64, 2.0, 0.4);
    let (a, b, c) = (mass * inertia, -(12.0 * ei * inertia + 4.0 * ei * mass), 12.0 * ei * ei);
    let omega = ((-b - (b * b - 4.0 * a * c).sqrt()) / (2.0 * a)).sqrt();
    let ratio = (12.0 * ei - omega * omega * mass) / (6.0 * ei);
    for base in [RigidBodyBuilder::fixed(), RigidBodyBuilder::kinematic_velocity_based()] {
        let mut world = weightless();
        let base = world.insert_body(base);
        let speed = 1e-2;
        let properties = MassProperties::new(Vector::ZERO, mass as Real, Vector::splat(inertia as Real));
        let tip = world.insert_body(
            RigidBodyBuilder::dynamic()
                .translation(Vector::new(1.0, 0.0, 0.0))
                .additional_mass_properties(properties)
                .linvel(Vector::new(0.0, speed as Real, 0.0))
                .angvel(Vector::new(0.0, 0.0, (speed * ratio) as Real)),
        );
        let period = std::f64::consts::TAU / omega;
        world.integration_parameters.dt = (period / 60.0) as Real;
        let mut set = CableSet::new();
        let rod =
            cable([0.0; 3], [1.0, 0.0, 0.0], beam(ei)).gravity(Vector3::zeros()).integrator(massless_beam_integrator());
        let rod = set.insert(rod.elements(6).build().unwrap());
        set.attach(&world, rod, At::Start, base, Vector::ZERO, AttachmentKind::Clamp).unwrap();
        let end = set.attach(&world, rod, At::End, tip, Vector::ZERO, AttachmentKind::Clamp).unwrap();
        run(&mut world, &mut set, 15);
        // at a quarter of the period deflection and moment are largest
        let out = vector(world.bodies[tip].translation()).y;
        let angle = vector(world.bodies[tip].rotation().to_scaled_axis()).z;
        assert!((out - speed / omega).abs() < 5e-3 * speed / omega, "{out:.3e} m of {:.3e}", speed / omega);
        let moment = set.attachment(end).unwrap().moment();
        let expected = ei * (6.0 * out - 4.0 * angle);
        assert!((moment.z - expected).abs() < 1e-2 * expected.abs() + 1e-4, "{moment:?} N m of {expected}");
        run(&mut world, &mut set, 45);
        let back = (vector(world.bodies[tip].translation()) - Vector3::x()).norm();
        assert!(back < 5e-3 * speed / omega, "{back:.1e} m");
        assert!((vector(world.bodies[tip].linvel()).y - speed).abs() < 5e-3 * speed);
        assert!(gap(&set) < 1e-6);
    }
}

/// A kinematic arm rotates at 1 rad/s with a heavy cable clamped across its end: the tangent at the
/// clamp rotates with it, and its work is the energy that the cable gains.
///
/// Reference: the prescribed motion; conservation of energy.
#[test]
fn the_work_of_a_rotating_arm_is_the_energy_of_its_clamped_cable() {
    let mut world = weightless();
    let arm = world.insert_body(RigidBodyBuilder::kinematic_velocity_based());
    let mut set = CableSet::new();
    let whip = cable([0.5, 0.0, 0.0], [0.5, 1.0, 0.0], soft()).gravity(Vector3::zeros()).build().unwrap();
    let whip = set.insert(whip);
    let held = set.attach_here(&world, whip, At::Start, arm, AttachmentKind::Clamp).unwrap();
    // the first step accelerates the cable by an impulse, whose work is not along a path
    world.bodies[arm].set_angvel(Vector::new(0.0, 0.0, 1.0), true);
    set.step(&mut world).unwrap();
    let state = |set: &CableSet| (-set.attachment(held).unwrap().work(), set.get(whip).unwrap().energy().total());
    let start = state(&set);
    let (mut worst, mut passed, mut before) = (0.0f64, 0.0, start.0);
    for _ in 0..120 {
        set.step(&mut world).unwrap();
        let tangent = set.get(whip).unwrap().sample(0.0).unwrap().slope.normalize();
        let along = vector(*world.bodies[arm].rotation() * Vector::Y);
        worst = worst.max((tangent - along).norm());
        passed += (state(&set).0 - before).abs();
        before = state(&set).0;
    }
    assert!(worst < 1e-6, "{worst:.1e}");
    let (work, gained) = (state(&set).0 - start.0, state(&set).1 - start.1);
    assert!(passed > 1e-2 && (work - gained).abs() < 0.02 * passed, "{work} J, {gained} J of {passed}");
}

/// A crate is clamped to a vertical rope in equilibrium: after a second it has not moved. The rope was held at both ends, its lower
/// half was compressed and got the bend of a strut, 1.2e-7 m: on 50 N that is 6e-6 N m.
///
/// Reference: statics.
#[test]
fn a_crate_clamped_in_line_with_its_rope_feels_no_moment() {
    let mut world = PhysicsWorld::new();
    let load = add_cube(&mut world, 5.0, 0.1, [0.0, -1.1, 0.0]);
    let mut set = CableSet::new();
    let mut rope: Cable = cable([0.0; 3], [0.0, -1.0, 0.0], soft()).fix(At::Start).build().unwrap();
    rope.fix(At::End).unwrap();
    rope.equilibrium().unwrap();
    rope.release(At::End).unwrap();
    let rope = set.insert(rope);
    let held = set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Clamp).unwrap();
    run(&mut world, &mut set, 60);
    let a = set.attachment(held).unwrap();
    assert_eq!(a.kind(), AttachmentKind::Clamp);
    assert!(a.moment().norm() < 6e-6, "{:?}", a.moment());
    assert!(vector(world.bodies[load].rotation().to_scaled_axis()).norm() < 1e-6);
}

/// What a cable is read to carry at a body is what its attachment carries: the tension along its end, and the moment of a clamp; hanging in
/// equilibrium askew, on every mesh. (In motion that of the attachment is the mean over the host step.)
///
/// *Source.* Newton's third law.
#[test]
fn a_cable_is_read_at_a_body_as_its_attachment() {
    for (kind, elements) in
        [AttachmentKind::Ball, AttachmentKind::Clamp].into_iter().flat_map(|k| [4, 15].map(|n| (k, n)))
    {
        let mut world = PhysicsWorld::new();
        let load = add_cube(&mut world, 5.0, 0.1, [1.5, -0.1, 0.0]);
        let mut set = CableSet::new();
        let stiff = Section::from_stiffness(1e5, 2.0, 0.3).unwrap();
        let rope = cable([0.0; 3], [1.5, 0.0, 0.0], stiff).elements(elements).length(1.7).clamp(At::Start);
        let rope = rope.damping(Damping { axial: 1e-3, bending: 0.02 }).build().unwrap();
        let rope = set.insert(rope);
        let held = set.attach(&world, rope, At::End, load, Vector::new(0.0, 0.1, 0.0), kind).unwrap();
        set.equilibrium(&mut world).unwrap();
        set.step(&mut world).unwrap();
        let (end, held) = (set.get(rope).unwrap().sample(1.7).unwrap(), set.attachment(held).unwrap());
        let (tension, moment) = (held.force().dot(&end.slope.normalize()).abs(), held.moment().norm());
        println!("{kind:?} {elements}: {} {tension} N, {} {moment} N m", end.tension, end.moment.norm());
        assert!((end.tension - tension).abs() < 1e-3 * held.force().norm(), "{} {tension}", end.tension);
        let scale = moment.max(0.1 * held.force().norm());
        assert!((end.moment.norm() - moment).abs() < 1e-3 * scale, "{} {moment}", end.moment.norm());
    }
}
