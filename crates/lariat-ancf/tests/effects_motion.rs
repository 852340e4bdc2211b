//! Effects in motion: every implicit integrator, islands, snapshots, energy balance, hard cases.

mod common;

use common::{implicit, largest_difference, pendulum, rule};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::{Island, PinConstraint, RigidBody};
use lariat_ancf::{
    At, Buoyancy, Cable, CableBuilder, Damping, Drag, Effects, Fidelity, Flow, GravityScale, Integrator, LineLoad,
    Method, RestPiece, RestShape, Section, StepControl, Vector3,
};
use nalgebra::Matrix3;

/// Everything at once, in water for the 1 cm pendulum of 0.4 kg/m.
fn all() -> Effects {
    let flow = Flow::uniform(Vector3::new(0.4, 0.0, 0.3)).with_history([[0.0, 0.0], [0.5, 1.0]]);
    Effects {
        damping: Some(Damping { axial: 1e-3, bending: 1e-2 }),
        drag: Some(Drag::new(1000.0, 1.2, 0.02, flow)),
        buoyancy: Some(Buoyancy::new(1000.0, 1.0)),
        rest_shape: Some(RestShape { pieces: vec![RestPiece { from: 1.0, stretch: 0.999, curvature: 0.05 }] }),
        line_loads: Some(LineLoad { from: 0.3, to: 1.1, force: Vector3::new(0.0, -0.5, 0.2) }.into()),
        gravity_scale: Some(GravityScale(0.9)),
        // it has no rest stretch beside it: `axial_laws.rs`
        axial_law: None,
        // with every method, and contact and torsion have one
        contact: None,
        torsion: None,
    }
}

fn wet(effects: Effects) -> CableBuilder {
    pendulum(6).effects(effects)
}

fn run(cable: &mut Cable, steps: usize) {
    (0..steps).for_each(|_| cable.step(1.0 / 60.0).unwrap());
}

/// Every implicit method converges to the same motion with damping, drag and the constant effects on, with its order.
///
/// *Source.* ESDIRK4 with sixteen times the steps; the orders that the methods claim, of which half an order may be missing in this
/// range of steps. A curvature that begins at the straight line is left out: there the natural direction is free.
#[test]
fn every_implicit_method_keeps_its_order_with_effects() {
    let effects = Effects { rest_shape: Some(RestShape::stretched(0.999)), ..all() };
    let end = |method: Method, substeps: u32| {
        let soft = Section::round(0.012, 2e6, 3000.0).unwrap();
        let builder = Cable::builder()
            .points([Vector3::zeros(), Vector3::new(0.9, 0.0, 0.0), Vector3::new(1.6, 0.7, 0.2)])
            .section(soft)
            .elements(4)
            .fix(At::Start)
            .effects(Effects { damping: Some(Damping { axial: 1e-3, bending: 0.0 }), ..effects.clone() });
        let mut cable = builder.integrator(Integrator::substeps(method, substeps).unwrap()).build().unwrap();
        (0..4).for_each(|_| cable.step(0.05).unwrap());
        cable.positions().to_vec()
    };
    let reference = end(Method::Esdirk4, 1600);
    for method in implicit() {
        let errors = [50, 100, 200].map(|n| largest_difference(&end(method, n), &reference));
        let order = (errors[1] / errors[2]).log2();
        println!("{method}: {errors:?} order {order:.2}");
        let expected = f64::from(method.properties().order);
        assert!(order > expected - 0.5 || errors[2] < 1e-9, "{method}: {errors:?}, order {order}");
        assert!(errors[2] < 3e-4, "{method}: {errors:?}");
    }
}

/// Kinetic, strain and gravity energy, what damping and drag took and what line loads gave, balance; the same with a flow.
///
/// *Source.* Conservation of energy.
#[test]
fn energy_less_the_work_of_effects_is_constant() {
    for method in [Method::Esdirk4, Method::Esdirk3, Method::Trapezoid] {
        let integrator = Integrator::substeps(method, 100).unwrap();
        let mut cable = wet(all()).integrator(integrator).build().unwrap();
        let balance = |cable: &Cable| cable.energy().total() - cable.effect_work().total();
        let start = balance(&cable);
        run(&mut cable, 30);
        let work = *cable.effect_work();
        println!("{method}: drift {:e} of {work:?}", balance(&cable) - start);
        assert!(work.damping < 0.0 && work.drag.abs() > 0.01 && work.line_loads.abs() > 0.01);
        assert!((balance(&cable) - start).abs() < 2e-4 * work.dissipated().abs(), "{method}");
    }
}

/// A snapshot carries effects, memory and work: read back, the run goes on bitwise; effects switched off and on go on too.
///
/// *Source.* Bitwise equality.
#[test]
fn a_snapshot_carries_the_effects() {
    for method in implicit() {
        let integrator = Integrator { method, control: StepControl::Substeps(20) };
        let mut cable = wet(all()).integrator(integrator).build().unwrap();
        run(&mut cable, 5);
        cable.set_drag(None).unwrap();
        run(&mut cable, 2);
        let text = serde_json::to_string(&cable).unwrap();
        let mut copy: Cable = serde_json::from_str(&text).unwrap();
        for cable in [&mut cable, &mut copy] {
            run(cable, 2);
            cable.set_drag(all().drag).unwrap();
            run(cable, 5);
        }
        assert_eq!(cable.snapshot(), copy.snapshot(), "{method}");
        assert_eq!(cable.diagnostics(), copy.diagnostics(), "{method}");
        assert_eq!(cable.effects(), copy.effects());
        assert!(cable.effect_work().drag != 0.0);
    }
}

/// A cable whose effects were switched on and off again is the bare cable.
///
/// *Source.* Bitwise equality with a run that never had them.
#[test]
fn effects_switched_off_leave_nothing() {
    let build = || pendulum(6).integrator(Integrator::substeps(Method::Esdirk3, 20).unwrap()).build().unwrap();
    let (mut bare, mut switched) = (build(), build());
    switched.set_effects(all()).unwrap();
    switched.set_effects(Effects::default()).unwrap();
    run(&mut bare, 10);
    run(&mut switched, 10);
    assert_eq!(bare.positions(), switched.positions());
    assert_eq!(switched.effect_work().dissipated(), 0.0);
}

/// A failed step adds no work.
///
/// *Source.* The contract: a refused step leaves the cable as it was.
#[test]
fn a_failed_step_adds_no_work() {
    let mut cable = wet(all()).build().unwrap();
    run(&mut cable, 3);
    let before = cable.snapshot().clone();
    cable.set_integrator(Integrator::tolerance(Method::Trapezoid, 1e-300).unwrap()).unwrap();
    assert!(cable.step(0.1).is_err());
    assert_eq!(cable.effect_work().drag, {
        let mut other = cable.clone();
        other.restore(before).unwrap();
        other.effect_work().drag
    });
}

fn fixed_body() -> RigidBody {
    let mut body = RigidBody::new(1.0, Matrix3::identity(), Vector3::zeros()).unwrap();
    body.free = [false; 6];
    body
}

/// A cable pinned to a body that does not move goes as one held by a support, for every implicit method.
///
/// *Source.* The cable alone; bound: rounding and Newton's tolerance.
#[test]
fn an_island_carries_the_effects_as_a_cable_alone_does() {
    for method in implicit() {
        let integrator = Integrator::substeps(method, 40).unwrap();
        let mut alone = wet(all()).integrator(integrator).build().unwrap();
        let mut cable = alone.clone();
        let node = cable.attach(At::Start).unwrap();
        let (mut bodies, mut island) = ([fixed_body()], Island::default());
        let pins = [PinConstraint { cable: 0, node, body: 0, anchor: Vector3::zeros(), direction: None }];
        for _ in 0..12 {
            alone.step(1.0 / 60.0).unwrap();
            island.step(&mut [&mut cable], &mut bodies, &pins, integrator, 1.0 / 60.0).unwrap();
        }
        let difference = largest_difference(alone.positions(), cable.positions());
        println!("{method}: {difference:e}");
        // an island starts every host step without the algorithmic accelerations of generalised-alpha
        let bound = if matches!(method, Method::GeneralisedAlpha { .. }) { 1e-4 } else { 1e-6 };
        assert!(difference < bound, "{method}: {difference:e}");
        let (a, b) = (alone.effect_work(), cable.effect_work());
        assert!((a.drag - b.drag).abs() < 1e-3 * a.drag.abs(), "{a:?} {b:?}");
        assert!((a.damping - b.damping).abs() < 1e-2 * a.damping.abs(), "{method}: {a:?} {b:?}");
        assert!((a.line_loads - b.line_loads).abs() < 1e-3 * a.line_loads.abs(), "{a:?} {b:?}");
    }
    let mut cable = wet(all()).build().unwrap();
    let node = cable.attach(At::Start).unwrap();
    let pins = [PinConstraint { cable: 0, node, body: 0, anchor: Vector3::zeros(), direction: None }];
    let explicit = Integrator::substeps(Method::Verlet, 1000).unwrap();
    assert!(Island::default().step(&mut [&mut cable], &mut [fixed_body()], &pins, explicit, 0.01).is_err());
}

/// A body that hangs on a cable in a flow: energy of both, what effects took, and the work of gravity on the body balance.
///
/// *Source.* Conservation of energy. Gravity acts on the body as its constant force.
#[test]
fn an_island_balances_its_energy_with_effects() {
    let integrator = Integrator::substeps(Method::Esdirk4, 60).unwrap();
    let mut cable = wet(all()).build().unwrap();
    let node = cable.attach(At::End).unwrap();
    let tip = cable.node_position(node);
    let mut body = RigidBody::new(2.0, Matrix3::identity() * 0.02, tip - Vector3::new(0.0, 0.1, 0.0)).unwrap();
    body.force = Vector3::new(0.0, -2.0 * 9.81, 0.0);
    let (mut bodies, mut island) = ([body], Island::default());
    let pins = [PinConstraint { cable: 0, node, body: 0, anchor: Vector3::new(0.0, 0.1, 0.0), direction: None }];
    let balance = |cable: &Cable, body: &RigidBody| {
        cable.energy().total() - cable.effect_work().total() + body.kinetic_energy() - body.force.dot(&body.position)
    };
    let start = balance(&cable, &bodies[0]);
    for _ in 0..30 {
        island.step(&mut [&mut cable], &mut bodies, &pins, integrator, 1.0 / 60.0).unwrap();
    }
    let drift = balance(&cable, &bodies[0]) - start;
    println!("drift {drift:e} of {:?}", cable.effect_work());
    assert!(drift.abs() < 1e-3 * cable.effect_work().dissipated(), "{drift:e} {:?}", cable.effect_work());
}

/// Everything at once on a cable that starts without stress: drawn at 0.999 of its length, straight.
fn from_rest() -> Effects {
    Effects { rest_shape: Some(RestShape::stretched(0.999)), ..all() }
}

/// Hard cases at the coarse step of a game with every effect on: steel at 1/60 s, a limp slack rope, one that snaps taut. No step is
/// refused, and no energy comes out of nowhere.
///
/// *Source.* Kinetic, strain and gravity energy cannot rise above the start by more than what flow and line loads gave.
#[test]
fn hard_cases_pass_with_every_effect_on() {
    let steel = || {
        Cable::builder()
            .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
            .section(Section::round(0.01, 2.1e11, 7850.0).unwrap())
            .elements(20)
            .fix(At::Start)
    };
    let limp = || {
        Cable::builder()
            .points([Vector3::zeros(), Vector3::new(0.2, 0.0, 0.0)])
            .length(2.0)
            .section(Section::round(0.01, 1e8, 1500.0).unwrap())
            .rule(rule("projected-none"))
            .elements(10)
            .fix(At::Start)
    };
    let strip = |mut effects: Effects| {
        effects.damping = Some(Damping { axial: 1e-3, bending: 0.0 });
        effects
    };
    for (name, builder, effects) in [
        ("steel", steel(), from_rest()),
        ("limp", limp(), strip(from_rest())),
        ("pendulum", pendulum(10), all()),
        ("heavily damped", pendulum(10), Effects { damping: Some(Damping { axial: 1.0, bending: 1.0 }), ..all() }),
    ] {
        for fidelity in [Fidelity::Game, Fidelity::Engineering] {
            let mut bare = builder.clone().fidelity(fidelity).build().unwrap();
            let mut cable = builder.clone().effects(effects.clone()).fidelity(fidelity).build().unwrap();
            // drawn unstretched: shrunk to its rest shape about the point that holds it
            let rest = cable.effects().rest_shape.as_ref().map_or(1.0, |rest| rest.at(0.0).0);
            let q: Vec<f64> = cable.positions().iter().map(|x| rest * x).collect();
            cable.set_coordinates(&q, &vec![0.0; q.len()]).unwrap();
            let start = cable.energy().total();
            for _ in 0..120 {
                cable.step(1.0 / 60.0).unwrap();
                let work = cable.effect_work();
                let given = work.line_loads + work.drag.max(0.0);
                let now = cable.energy().total();
                let scale = cable.energy().kinetic + start.abs() + given.abs() + 1.0;
                assert!(now <= start + given + 0.02 * scale, "{name} {fidelity:?}: {now} {start} {work:?}");
            }
            (0..120).for_each(|_| bare.step(1.0 / 60.0).unwrap());
            let (a, b) = (bare.diagnostics(), cable.diagnostics());
            println!(
                "{name} {fidelity:?}: steps, rejected, Newton: bare {} {} {}, all effects {} {} {}",
                a.steps, a.rejected_steps, a.newton_iterations, b.steps, b.rejected_steps, b.newton_iterations
            );
            // effects may cost steps that are rejected and retried shorter, but not many
            assert!(b.steps <= 2 * a.steps.max(480), "{name} {fidelity:?}: {b:?}");
        }
    }
}

/// A limp cable that lies slack keeps a regular step matrix: it falls freely where nothing pulls at it.
///
/// *Source.* Free fall; no bending code runs.
#[test]
fn a_limp_slack_cable_falls_freely_and_runs_no_bending() {
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(0.5, 0.2, 0.0)])
        .length(1.5)
        .section(Section::from_stiffness(1e5, 0.0, 0.2).unwrap())
        .rule(rule("projected-none"))
        .elements(8)
        .build()
        .unwrap();
    let start = cable.positions().to_vec();
    run(&mut cable, 30);
    let fallen = start.iter().zip(cable.positions()).skip(1).step_by(6).map(|(a, b)| a - b);
    let mean = fallen.sum::<f64>() / cable.nodes() as f64;
    assert!((mean - 0.5 * 9.81 * 0.25).abs() < 0.02, "{mean}");
    assert_eq!(cable.diagnostics().bending_evaluations, 0);
}
