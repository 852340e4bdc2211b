//! Changing a cable between steps: supports, loads, integrator, snapshots from before, descriptions from files.

use approx::assert_relative_eq;
use lariat_ancf::contact::{Ball, Obstacle};
use lariat_ancf::coupling::{Coupling, Linearisation};
use lariat_ancf::{
    At, AxialRule, BendingRule, Cable, CableBuilder, Error, Fidelity, Integrator, Method, PointLoad, Rule, Section,
    SlopeSupport, StepControl, Support, Vector3, Warning,
};

fn horizontal() -> CableBuilder {
    Cable::builder()
        .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(Section::square(0.01, 1.0e8, 4000.0).unwrap())
}

/// A slope that is newly held to a direction is turned there and keeps its length: projecting it would shrink the cable
/// (|t| = 0.6 at 53 degrees, a collapsed element at 90) and put energy in.
#[test]
fn a_direction_turns_the_slope_and_keeps_its_length() {
    for degrees in [0.0f64, 53.0, 90.0, 179.0, 180.0] {
        let direction = Vector3::new(degrees.to_radians().cos(), degrees.to_radians().sin(), 0.0);
        let mut cable = horizontal().gravity(Vector3::zeros()).fix(At::Start).build().unwrap();
        let slope = SlopeSupport::Direction(direction);
        cable.set_support(At::Start, Support { slope, ..cable.support(At::Start).unwrap() }).unwrap();
        let t = Vector3::from_column_slice(&cable.positions()[3..6]);
        assert_relative_eq!(t, direction, epsilon = 1e-12);
        cable.step(1e-4).unwrap();
        let t = Vector3::from_column_slice(&cable.positions()[3..6]);
        assert!(t.normalize().dot(&direction) > 1.0 - 1e-12 && t.norm() > 0.9, "{degrees}: {t}");
    }
}

/// A direction within rounding of a unit vector is stored as one: its projector must be a projector, or steel at rest is pulled.
#[test]
fn a_direction_is_stored_as_a_unit_vector() {
    let steel = Section::round(0.01, 2.1e11, 7850.0).unwrap();
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(steel)
        .gravity(Vector3::zeros())
        .fix(At::Start)
        .build()
        .unwrap();
    let slope = SlopeSupport::Direction(Vector3::new(1.0 + 9e-7, 0.0, 0.0));
    cable.set_support(At::Start, Support { slope, ..cable.support(At::Start).unwrap() }).unwrap();
    (0..10).for_each(|_| cable.step(1.0 / 60.0).unwrap());
    assert!(cable.sample(0.1).unwrap().tension.abs() < 1e-5);
}

/// A snapshot from before a change has the accelerations of another cable: they are computed anew.
#[test]
fn a_snapshot_from_before_a_change_continues_as_a_fresh_cable_would() {
    // the discrete gradient carries no accelerations, but the changes of the last step, which stay true
    let fidelity = Fidelity::Engineering;
    let mut cable = horizontal().fix(At::Start).fix(At::End).fidelity(fidelity).build().unwrap();
    (0..5).for_each(|_| cable.step(1.0 / 60.0).unwrap());
    let snapshot = cable.snapshot().clone();
    let mut fresh = horizontal().fix(At::Start).fidelity(fidelity).build().unwrap();
    fresh.set_coordinates(cable.positions(), cable.velocities()).unwrap();
    cable.release(At::End).unwrap();
    cable.restore(snapshot).unwrap();
    cable.step(1e-3).unwrap();
    fresh.step(1e-3).unwrap();
    assert_eq!(cable.positions(), fresh.positions());
}

/// Lock-step networking compares whole snapshots: nothing in them may depend on buffers.
#[test]
fn the_whole_state_of_a_cable_read_from_a_file_stays_equal() {
    for method in Method::ALL {
        let control = if method.properties().implicit { StepControl::Substeps(3) } else { StepControl::Stable(0.9) };
        let mut cable = horizontal().fix(At::Start).integrator(Integrator { method, control }).build().unwrap();
        cable.step(1.0 / 60.0).unwrap();
        let mut copy: Cable = serde_json::from_str(&serde_json::to_string(&cable).unwrap()).unwrap();
        for _ in 0..3 {
            cable.step(1.0 / 60.0).unwrap();
            copy.step(1.0 / 60.0).unwrap();
            assert_eq!(cable.snapshot(), copy.snapshot(), "{method}");
        }
    }
}

/// A ramp begins when its load is added, not at time zero.
#[test]
fn a_load_added_later_ramps_from_then() {
    let mut cable = horizontal().gravity(Vector3::zeros()).fix(At::Start).build().unwrap();
    cable.step(1.0).unwrap();
    cable.add_load(PointLoad { ramp: 0.5, ..PointLoad::force(2.0, Vector3::new(10.0, 0.0, 0.0)) }).unwrap();
    assert_relative_eq!(cable.loads()[0].factor(1.25), 0.5, epsilon = 1e-12);
    let pull: f64 = cable.force()[60];
    assert!(pull.abs() < 1e-6, "{pull} N at once");
}

/// Held nodes do not take part in the initial motion, so the first step loses no energy.
#[test]
fn an_initial_velocity_leaves_held_nodes_at_rest() {
    let mut cable = horizontal().gravity(Vector3::zeros()).velocity(Vector3::y()).fix(At::Start).build().unwrap();
    assert_eq!(cable.velocities()[..3], [0.0; 3]);
    let before = cable.energy().total();
    cable.step(1e-4).unwrap();
    assert_relative_eq!(cable.energy().total(), before, max_relative = 1e-6);
}

/// An attached node belongs to an island; alone, the cable would let it fly on.
#[test]
fn a_cable_with_attached_nodes_is_not_stepped_alone() {
    let mut cable = horizontal().fix(At::Start).build().unwrap();
    cable.attach(At::End).unwrap();
    assert!(matches!(cable.step(0.01), Err(Error::Attached { node, .. }) if node == cable.nodes() - 1));
    cable.release(At::End).unwrap();
    cable.step(0.01).unwrap();
}

/// Rules and sections with public fields are checked when a cable is built from them.
#[test]
fn numbers_set_past_the_constructors_are_refused_too() {
    let good = Section::square(0.01, 1.0e8, 4000.0).unwrap();
    for axial_stiffness in [f64::NAN, -1.0e4, 0.0] {
        let section = Section { axial_stiffness, ..good };
        assert!(matches!(horizontal().section(section).build(), Err(Error::InvalidValue { .. })));
    }
    for rule in [
        Rule::new(AxialRule::Gauss(0), BendingRule::Gauss(3)),
        Rule::new(AxialRule::Exact, BendingRule::Gauss(0)),
        Rule::new(AxialRule::Gauss(11), BendingRule::T2),
    ] {
        assert!(matches!(horizontal().rule(rule).allow_rank_deficient().build(), Err(Error::UnknownRule { .. })));
    }
    assert!(horizontal().elements(usize::MAX).build().is_err());
}

/// A description from a file is checked as the builder's is: no panic later.
#[test]
fn a_broken_file_is_refused_when_it_is_read() {
    let mut cable = horizontal().fix(At::Start).build().unwrap();
    cable.step(0.01).unwrap();
    let good: serde_json::Value = serde_json::to_value(&cable).unwrap();
    let broken = [
        ("/model/elements/0/length", serde_json::json!(-0.2)),
        ("/model/elements/3/section/axial_stiffness", serde_json::json!(0.0)),
        ("/model/supports/0/0", serde_json::json!(99)),
        ("/snapshot/state/q", serde_json::json!([1.0, 2.0])),
        ("/snapshot/state/memory/acceleration", serde_json::json!([1.0])),
        ("/model/rule", serde_json::json!("G0-3")),
    ];
    for (path, value) in broken {
        let mut text = good.clone();
        *text.pointer_mut(path).unwrap_or_else(|| panic!("{path}")) = value;
        assert!(serde_json::from_value::<Cable>(text).is_err(), "{path}");
    }
    assert!(serde_json::from_value::<Cable>(good).is_ok());
}

/// A step a trillion times shorter than the host's is an error before it begins.
#[test]
fn steps_too_short_to_end_are_errors() {
    for (method, control) in [
        (Method::Esdirk4, StepControl::MaxStep(1e-12)),
        (Method::Esdirk4, StepControl::MaxStep(1e-320)),
        (Method::Verlet, StepControl::Stable(1e-320)),
    ] {
        let mut cable = horizontal().fix(At::Start).integrator(Integrator { method, control }).build().unwrap();
        let before = cable.snapshot().clone();
        let error = cable.step(1.0 / 60.0).unwrap_err();
        assert!(matches!(error, Error::StepFailed { time: 0.0, .. }), "{error}");
        assert_eq!(*cable.snapshot(), before);
    }
}

/// The two arms of a symmetric V start as mirror images, whatever the rounding of the corner's arc length.
#[test]
fn the_two_arms_of_a_corner_are_mirror_images() {
    for i in 1..60 {
        let height = 0.1 * f64::from(i);
        let points = [Vector3::new(-1.0, height, 0.0), Vector3::zeros(), Vector3::new(1.0, height, 0.0)];
        let section = Section::square(0.01, 1.0e8, 4000.0).unwrap();
        let cable = Cable::builder().points(points).section(section).elements(10).build().unwrap();
        let corner = &cable.positions()[30..36];
        assert!(corner[4].abs() < 1e-9 && corner[3] > 0.9, "height {height}: {corner:?}");
    }
}

/// A node placed on a bent, moving cable changes neither its shape nor its momenta nor its energies; supports, loads and the nodes
/// behind keep their places, and the run goes on.
///
/// *Source.* A cubic is its own interpolant on any part; the exact axial rule and a bending rule of 10 points leave no error of
/// quadrature.
#[test]
fn a_new_node_changes_nothing() {
    let rule = Rule { axial: AxialRule::Exact, bending: BendingRule::Gauss(10) };
    let load = PointLoad::force(1.7, Vector3::new(0.0, 0.3, 1.0));
    let mut cable = horizontal().rule(rule).fix(At::Start).clamp(At::End).load(load).elements(4).build().unwrap();
    (0..10).for_each(|_| cable.step(1.0 / 60.0).unwrap());
    let mut refined = cable.clone();
    assert_eq!(refined.insert_node(At::ArcLength(1.0)).unwrap(), 2, "there is one");
    assert_eq!(refined.nodes(), 5);
    assert_eq!(refined.insert_node(At::ArcLength(1.13)).unwrap(), 3);
    assert_eq!(refined.insert_node(0.02).unwrap(), 1);
    assert_eq!((refined.nodes(), refined.node(1.13).unwrap()), (7, 4));
    for s in [0.0, 0.01, 0.5, 1.05, 1.2, 1.9, 2.0] {
        let (a, b) = (cable.sample(s).unwrap(), refined.sample(s).unwrap());
        assert_relative_eq!(a.position, b.position, epsilon = 1e-14);
        assert_relative_eq!(a.slope, b.slope, epsilon = 1e-13);
        assert_relative_eq!(a.velocity, b.velocity, epsilon = 1e-12);
        assert_relative_eq!(a.curvature, b.curvature, epsilon = 1e-10);
    }
    let (a, b) = (cable.energy(), refined.energy());
    assert_relative_eq!(a.kinetic, b.kinetic, max_relative = 1e-12);
    assert_relative_eq!(a.axial, b.axial, max_relative = 1e-9);
    assert_relative_eq!(a.bending, b.bending, max_relative = 1e-5);
    assert_relative_eq!(a.gravity, b.gravity, max_relative = 1e-12);
    assert_relative_eq!(cable.momentum().angular, refined.momentum().angular, max_relative = 1e-12);
    let before = cable.sample(1.5).unwrap().position;
    for _ in 0..10 {
        cable.step(1.0 / 60.0).unwrap();
        refined.step(1.0 / 60.0).unwrap();
    }
    // two meshes of one cable: near, and both moved on
    let (a, b) = (cable.sample(1.5).unwrap().position, refined.sample(1.5).unwrap().position);
    assert!((a - b).norm() < 0.02 && (a - before).norm() > 0.05, "{a} {b} {before}");
    assert!((refined.sample(2.0).unwrap().position - Vector3::new(2.0, 0.0, 0.0)).norm() < 1e-14);
    assert!(refined.insert_node(2.1).is_err() && refined.insert_node(f64::NAN).is_err());
}

/// A point that is led comes to its place with the velocity that was asked for, and stays there; a restored snapshot leads it as it did, and one
/// from before frees it.
///
/// *Source.* The cubic of Hermite; the same run, not interrupted, but for the memory of the method.
#[test]
fn a_point_that_is_led_is_held_at_its_place_and_restored() {
    for fidelity in [Fidelity::Game, Fidelity::Engineering] {
        let mut cable = Cable::builder()
            .points([Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0)])
            .length(1.3)
            .section(Section::from_stiffness(1e4, 0.01, 0.1).unwrap())
            .fix(At::Start)
            .fidelity(fidelity)
            .build()
            .unwrap();
        let free = cable.snapshot().clone();
        let place = Vector3::new(0.8, 0.3, 0.1);
        cable.prescribe(At::End, place, [0.5, 0.0, 0.0], 0.25).unwrap();
        let last = cable.nodes() - 1;
        let step = |cable: &mut Cable, count: usize| (0..count).for_each(|_| cable.step(1.0 / 64.0).unwrap());
        step(&mut cable, 8);
        let middle: Vector3<f64> = 0.5 * (Vector3::x() + place) - 0.125 * 0.25 * Vector3::new(0.5, 0.0, 0.0);
        assert!((cable.node_position(last) - middle).norm() < 1e-12, "{:?}", cable.node_position(last));
        let halfway = cable.snapshot().clone();
        step(&mut cable, 24);
        assert!((cable.node_position(last) - place).norm() < 1e-12, "{:?}", cable.node_position(last));
        let velocity = &cable.velocities()[6 * last..6 * last + 3];
        assert!(velocity.iter().all(|v| v.abs() < 1e-12), "{fidelity:?}: {velocity:?}");
        let end = cable.positions().to_vec();
        // led elsewhere, then as it was
        cable.prescribe(At::End, [3.0, 0.0, 0.0], [0.0; 3], 10.0).unwrap();
        cable.prescribe(At::Start, [0.0, -0.2, 0.0], [0.0; 3], 0.1).unwrap();
        step(&mut cable, 4);
        cable.restore(halfway).unwrap();
        step(&mut cable, 24);
        // from positions and velocities: what the method carried was of other supports
        let off = cable.positions().iter().zip(&end).fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
        assert!(off < 0.02, "{fidelity:?}: {off}");
        assert!((cable.node_position(last) - place).norm() < 1e-12);
        assert_eq!(cable.support(At::Start).unwrap().position.map(|motion| motion.at(9.0)[1]), Some(Vector3::zeros()));
        cable.restore(free).unwrap();
        assert!(cable.support(At::End).unwrap().is_free());
        step(&mut cable, 16);
        assert!(cable.node_position(last).y < -0.1);
    }
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::x()])
        .section(Section::from_stiffness(1e4, 0.01, 0.1).unwrap())
        .build()
        .unwrap();
    for duration in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            cable.prescribe(At::End, [1.0, 0.0, 0.0], [0.0; 3], duration),
            Err(Error::InvalidValue { .. })
        ));
    }
}

/// Obstacles of a cable that does not touch are told of.
#[test]
fn obstacles_without_contact_are_told() {
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::x()])
        .section(Section::from_stiffness(1e4, 0.01, 0.1).unwrap())
        .build()
        .unwrap();
    let told =
        |cable: &Cable| cable.warnings().iter().any(|w| matches!(w, Warning::UntouchedObstacles { count: 1, .. }));
    assert!(!told(&cable));
    cable.set_obstacles([Obstacle::new(7, Ball { radius: 0.1 }, Vector3::new(0.0, -1.0, 0.0), 0.3)]).unwrap();
    assert!(told(&cable));
}
