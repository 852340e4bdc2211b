//! The memory of contacts: snapshots, refused steps, refusals by name, and what an absent contact costs.

use crate::bench::{GRAVITY, rope, run, up, with};
use lariat_ancf::contact::{Ball, HalfSpace, Obstacle, RigidMotion};
use lariat_ancf::{At, Cable, Contact, Error, Fidelity, Integrator, Method, Section, StepFailure, Vector3};

/// A rope that slides down an incline and sticks in part.
fn sliding() -> Cable {
    let gravity = GRAVITY * Vector3::new(0.4, -0.9, 0.1);
    let cable = rope(0.1, &[up() * 0.005, Vector3::new(2.0, 0.3, 0.0)], 20).gravity(gravity).build().unwrap();
    with(cable, vec![Obstacle::new(1, HalfSpace { normal: up() }, Vector3::zeros(), 0.3)])
}

/// A snapshot within slip, and a cable that was read back from a file, continue bitwise.
///
/// *Source.* Equality of states.
#[test]
fn a_snapshot_within_slip_continues_bitwise() {
    let mut cable = sliding();
    run(&mut cable, 30, |_| {});
    assert!(cable.contacts().any(|touch| touch.slips), "{:?}", cable.contacts().collect::<Vec<_>>());
    let snapshot = cable.snapshot().clone();
    let file = serde_json::to_string(&cable).unwrap();
    run(&mut cable, 20, |_| {});
    let end = cable.snapshot().clone();
    cable.restore(snapshot).unwrap();
    run(&mut cable, 20, |_| {});
    assert!(*cable.snapshot() == end);
    let mut read: Cable = serde_json::from_str(&file).unwrap();
    read.set_obstacles(cable.obstacles().to_vec()).unwrap();
    run(&mut read, 20, |_| {});
    assert!(*read.snapshot() == end);
}

/// A step that fails leaves the memory of friction as it was.
///
/// *Source.* Equality of states.
#[test]
fn a_refused_step_leaves_the_memory_of_friction_as_it_was() {
    let mut cable = sliding();
    run(&mut cable, 30, |_| {});
    let before = cable.snapshot().clone();
    let refused = cable.step(1e-3_f64.mul_add(1e250, 1.0));
    assert!(refused.is_err(), "{refused:?}");
    assert!(*cable.snapshot() == before);
    assert!(cable.contacts().count() > 0);
}

/// Other methods refuse contact by name, and a cable whose integrator nobody chose gets the one that can step it.
///
/// *Source.* The contract.
#[test]
fn only_the_discrete_gradient_takes_contact() {
    let line = [Vector3::zeros(), Vector3::x()];
    let section = Section::round(0.01, 1e8, 1500.0).unwrap();
    let build = || Cable::builder().points(line).section(section);
    for method in Method::ALL.into_iter().filter(|method| *method != Method::DiscreteGradient) {
        let integrator = Integrator::substeps(method, 4).unwrap();
        let mut cable = build().integrator(integrator).build().unwrap();
        let refused = cable.set_contact(Contact::default()).unwrap_err();
        assert!(
            matches!(&refused, Error::ContactMethod { method: name, .. } if *name == method.to_string()),
            "{refused}"
        );
        assert!(cable.effects().contact.is_none());
        let mut cable = build().fidelity(Fidelity::Game).build().unwrap();
        cable.set_contact(Contact::default()).unwrap();
        assert!(matches!(cable.step_with(0.01, &integrator), Err(Error::ContactMethod { .. })));
    }
    let mut cable = build().build().unwrap();
    cable.set_contact(Contact::default()).unwrap();
    assert_eq!(cable.integrator().method, Method::DiscreteGradient);
}

/// Numbers out of range are refused with their cable, and nothing is changed.
///
/// *Source.* The contract.
#[test]
fn bad_obstacles_are_refused() {
    let mut cable = sliding();
    let ball = |key, friction| Obstacle::new(key, Ball { radius: 0.1 }, Vector3::zeros(), friction);
    let twice = cable.set_obstacles([ball(3, 0.1), ball(2, 0.1), ball(3, 0.1)]).unwrap_err();
    assert!(matches!(twice, Error::ObstacleKey { key: 3, .. }));
    for bad in [ball(3, -0.1), ball(3, f64::NAN), Obstacle { skin: -1.0, ..ball(3, 0.1) }] {
        assert!(matches!(cable.set_obstacles([bad]), Err(Error::InvalidValue { .. })));
    }
    assert_eq!(cable.obstacles().len(), 1);
    let no_radius = rope(0.1, &[Vector3::zeros(), Vector3::x()], 3).build().unwrap().set_contact(Contact::default());
    assert!(matches!(no_radius, Err(Error::MissingForEffect { .. })));
}

/// A cable that is near nothing has the bits and the counts of one without the effect, but for the search: a test for each
/// element and step.
///
/// *Source.* Equality.
#[test]
fn a_contact_that_is_far_costs_nothing() {
    let build = || rope(0.1, &[Vector3::zeros(), Vector3::x()], 10).fix(At::Start).build().unwrap();
    let far = Obstacle::new(1, Ball { radius: 0.5 }, Vector3::new(0.0, -9.0, 0.0), 0.3);
    let (mut without, mut with) = (build(), with(build(), vec![far]));
    for _ in 0..60 {
        without.step(1.0 / 60.0).unwrap();
        with.step(1.0 / 60.0).unwrap();
    }
    assert_eq!(without.positions(), with.positions());
    assert_eq!(without.velocities(), with.velocities());
    let mut counts = *with.diagnostics();
    assert!(counts.search_tests <= 10 * counts.steps && counts.effects.contact == 0, "{counts:?}");
    counts.search_tests = 0;
    assert_eq!(without.diagnostics(), &counts);
}

/// A rope that begins within an obstacle is not thrown out of it.
///
/// *Source.* Energy: there is no work.
#[test]
fn a_rope_that_begins_inside_an_obstacle_gains_no_energy() {
    let cable = rope(0.1, &[Vector3::zeros(), Vector3::x()], 10).fix(At::Start).build().unwrap();
    let ball = Obstacle::new(1, Ball { radius: 0.3 }, Vector3::new(0.2, 0.0, 0.0), 0.3);
    let mut cable = with(cable, vec![ball]);
    let made = run(&mut cable, 120, |_| {});
    assert!(made < 1e-8, "{made:e}");
}

/// A rope that begins two millimetres deep in a floor comes out of it while friction pays for that, makes no energy, and stays in it where nothing
/// does.
///
/// *Source.* The energy law; geometry. The offset falls by exp(-t/0.05 s) in the time v/(mu g) in which the rope slides, but for six steps in which it begins and ends.
#[test]
fn an_offset_closes_while_friction_pays_for_it() {
    for (friction, speed) in [(0.3, 2.0), (0.8, 1.0), (0.3, 0.0), (0.0, 2.0)] {
        let start = up() * 0.003;
        let cable = rope(0.1, &[start, start + Vector3::new(2.0, 0.0, 0.0)], 20);
        let cable = cable.velocity(Vector3::new(speed, 0.0, 0.0)).build().unwrap();
        let mut cable = with(cable, vec![Obstacle::new(1, HalfSpace { normal: up() }, Vector3::zeros(), friction)]);
        let deepest = |cable: &Cable| cable.contacts().fold(0.0, |most: f64, touch| most.max(touch.depth));
        let before = cable.energy_law().contacts;
        let made = run(&mut cable, 60, |_| {});
        let (depth, lost) = (deepest(&cable), cable.energy_law().contacts - before);
        println!("mu {friction}, {speed} m/s: {depth:.1e} m deep, contacts lost {lost:.2e} J, made {made:.0e}");
        // at rest there is no energy to have a share of
        assert!((made < 1e-8 || speed == 0.0) && lost >= 0.0, "{made:e} {lost:e}");
        if friction * speed > 0.0 {
            let closing = speed / (friction * GRAVITY) - 6.0 / 240.0;
            assert!(depth < 2e-3 * (-closing / 0.05).exp() + 1e-6, "{depth:e}");
        } else {
            assert!((depth - 2e-3).abs() < 2e-4, "{depth:e}");
        }
    }
}

/// An error keeps its failure.
///
/// *Source.* The contract.
#[test]
fn failures_are_typed() {
    let mut cable = sliding();
    let huge = vec![1e200; cable.positions().len()];
    let still = vec![0.0; huge.len()];
    cable.set_coordinates(&huge, &still).unwrap();
    match cable.step(0.01) {
        Err(Error::StepFailed {
            failure:
                StepFailure::NotFinite { .. }
                | StepFailure::EnergyMade { .. }
                | StepFailure::NotConverged { .. }
                | StepFailure::Singular(_),
            ..
        }) => {}
        other => panic!("{other:?}"),
    }
}

/// A step that fails beside an obstacle that was moved by its pose alone says so, by its key and how far it was moved; with a velocity, or
/// where nothing was moved, it does not.
///
/// *Source.* The contract.
#[test]
fn a_failure_names_an_obstacle_that_was_moved_by_its_pose() {
    let floor = |height: f64| Obstacle::new(7, HalfSpace { normal: up() }, up() * height, 0.3);
    let moving = |height: f64| {
        let floor = floor(height);
        let motion = RigidMotion { velocity: up() * 3.0, ..floor.motion };
        floor.moving(motion)
    };
    for (next, named) in [(floor(-0.07), true), (floor(-0.1), false), (moving(-0.07), false)] {
        let mut cable = with(sliding(), vec![floor(-0.1)]);
        cable.set_obstacles([next]).unwrap();
        let huge = vec![1e200; cable.positions().len()];
        let still = vec![0.0; huge.len()];
        cable.set_coordinates(&huge, &still).unwrap();
        let Err(Error::StepFailed { failure, .. }) = cable.step(0.01) else { panic!("it steps") };
        let found =
            matches!(&failure, StepFailure::PosedObstacle { key: 7, distance, .. } if (distance - 0.03).abs() < 1e-12);
        assert_eq!(found, named, "{failure}");
        assert_eq!(failure.to_string().contains("needs its velocity"), named, "{failure}");
    }
}
