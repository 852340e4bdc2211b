//! Invalid pins and failed steps: typed errors, and cables and bodies exactly unchanged.

use super::bench::{Scene, cube, payload, soft, steel};
use lariat_ancf::island::{PinConstraint, RigidBody};
use lariat_ancf::{Error, Integrator, Method, PinProblem, Vector3};
use nalgebra::Matrix3;

fn error_of(change: impl FnOnce(&mut Scene)) -> Error {
    let mut scene = payload(soft(), 50.0, Integrator::default());
    scene.run(1.0 / 60.0, 3);
    change(&mut scene);
    let (cables, bodies) =
        (scene.cables.iter().map(|c| c.snapshot().clone()).collect::<Vec<_>>(), scene.bodies.clone());
    let error = scene.try_step(1.0 / 60.0).expect_err("an invalid step");
    assert!(scene.cables.iter().zip(&cables).all(|(c, state)| c.snapshot() == state), "cables unchanged");
    assert_eq!(scene.bodies, bodies, "bodies unchanged");
    error
}

/// Pins to cables, bodies and nodes that do not exist, two on one node, none on an attached node,
/// one without the clamp of its node, an anchor that is not a number, no cable, a negative step:
/// each is its own error, and the states are unchanged.
///
/// *Source.* The contract.
#[test]
fn invalid_pins_are_typed_errors_and_change_nothing() {
    let not_in_island = |what, index| Error::NotInIsland { pin: 0, what, index, count: 1 };
    assert_eq!(error_of(|s| s.pins[0].cable = 1), not_in_island("cables", 1));
    assert_eq!(error_of(|s| s.pins[0].body = 7), not_in_island("bodies", 7));
    let off = error_of(|s| s.pins[0].node = 99);
    assert!(matches!(&off, Error::OutOfRange { what: "node", value: 99.0, limit: 10.0, .. }), "{off}");
    let not_a_number = error_of(|s| s.pins[0].anchor.y = f64::NAN);
    assert!(matches!(not_a_number, Error::InvalidValue { .. }), "{not_a_number}");
    let pin = |node, problem| Error::Pin { cable: "cable".to_string(), node, problem };
    assert_eq!(error_of(|s| s.pins.push(s.pins[0])), pin(10, PinProblem::Duplicate));
    assert_eq!(error_of(|s| s.pins.clear()), pin(10, PinProblem::Missing));
    assert_eq!(error_of(|s| s.pins.push(PinConstraint { node: 3, ..s.pins[0] })), pin(3, PinProblem::NotAttached));
    assert_eq!(error_of(|s| s.pins[0].direction = Some(Vector3::x())), pin(10, PinProblem::ClampMismatch));
    let mut empty = Scene::new(Vec::new(), Vec::new(), Integrator::default());
    assert_eq!(empty.try_step(0.1), Err(Error::EmptyIsland));
    let mut scene = payload(soft(), 50.0, Integrator::default());
    assert!(matches!(scene.try_step(-1.0), Err(Error::InvalidValue { .. })));
    assert!(matches!(scene.try_step(f64::NAN), Err(Error::InvalidValue { .. })));
}

/// An explicit step far beyond the stability limit of steel, and a force that overflows, fail and
/// keep the state; the next step succeeds without the cause.
///
/// *Source.* The contract; omega_max h = 2 for Verlet, here 2e3.
#[test]
fn a_failed_step_leaves_cables_and_bodies_unchanged() {
    let error = error_of(|s| s.bodies[0].force.y = 1e300);
    assert!(matches!(error, Error::StepFailed { .. }), "{error}");
    let mut scene = payload(steel(), 50.0, Integrator::substeps(Method::Verlet, 4).unwrap());
    let failure = (0..60).find_map(|_| {
        let before = (scene.cables[0].snapshot().clone(), scene.bodies.clone());
        let error = scene.try_step(1.0 / 60.0).err()?;
        assert_eq!(*scene.cables[0].snapshot(), before.0);
        assert_eq!(scene.bodies, before.1);
        Some(error)
    });
    assert!(matches!(failure, Some(Error::StepFailed { .. })), "{failure:?}");
    let mut again = payload(soft(), 50.0, Integrator::default());
    again.bodies[0].force.y = 1e300;
    again.try_step(1.0 / 60.0).unwrap_err();
    again.bodies[0].force.y = -9.81 * 50.0;
    again.run(1.0 / 60.0, 1);
}

/// Bodies without mass, without inertia or with numbers that are not finite are errors.
///
/// *Source.* Physics: mass and inertia are positive.
#[test]
fn invalid_bodies_are_errors() {
    let build = |mass, inertia, x| RigidBody::new(mass, inertia, Vector3::new(x, 0.0, 0.0));
    assert!(build(0.0, cube(1.0, 1.0), 0.0).is_err());
    assert!(build(f64::NAN, cube(1.0, 1.0), 0.0).is_err());
    assert!(build(1.0, Matrix3::zeros(), 0.0).is_err());
    assert!(build(1.0, cube(1.0, 1.0), f64::INFINITY).is_err());
    assert!(RigidBody::junction(Vector3::new(f64::NAN, 0.0, 0.0)).is_err());
}

/// A gap of 0.1 m at a pin when the step begins, after a body was moved, is closed when it ends.
///
/// *Source.* The contract of the island: gaps close within a step.
#[test]
fn a_gap_closes_within_the_step() {
    let mut scene = payload(soft(), 50.0, Integrator::default());
    scene.bodies[0].position.x -= 0.1;
    scene.run(1.0 / 60.0, 1);
    assert!(scene.gap() < 1e-13, "{:.1e} m", scene.gap());
}
