//! Flows of the user's own, sampled at the nodes: against free fall in moving air, against tables, in snapshots, bad ones.

mod common;

use common::largest_difference;
use lariat_ancf::coupling::Linearisation;
use lariat_ancf::effect::Profile;
use lariat_ancf::{Cable, Drag, Effects, Error, Flow, Integrator, Method, Section, Vector3};

fn sheared() -> Flow {
    let profile = Profile { up: Vector3::new(0.3, 1.0, 0.2), rows: vec![[-9.0, -3.0], [9.0, 4.0]] };
    Flow { profile: Some(profile), ..Flow::uniform(Vector3::new(0.5, 0.2, -0.1)) }
}

fn falling(flow: Flow) -> Cable {
    Cable::builder()
        .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(Section::round(0.01, 1e8, 4000.0).unwrap())
        .elements(4)
        .effects(Effects { drag: Some(Drag::new(1.2, 1.1, 0.05, flow)), ..Effects::default() })
        .integrator(Integrator::tolerance(Method::Esdirk4, 1e-9).unwrap())
        .build()
        .unwrap()
}

/// A cable that falls in an updraft that grows as u = a t, sampled at the middle of every step: relative to the air it is free fall with
/// drag under g + a. The error of the samples falls by four with half the interval.
///
/// *Source.* v(t) = v_T tanh((g + a) t/v_T) - a t, v_T^2 = 2 m (g + a)/(rho d C_n) (free fall with quadratic drag, in the frame of the air).
#[test]
fn a_sampled_flow_carries_a_falling_cable_and_is_of_order_two() {
    let (a, g, mass) = (3.0, 9.81, 4000.0 * std::f64::consts::FRAC_PI_4 * 1e-4);
    let error = |steps: u32| {
        let mut cable = falling(Flow::default());
        let dt = 2.0 / f64::from(steps);
        for _ in 0..steps {
            let middle = cable.time() + 0.5 * dt;
            cable.sample_flow(|_| Vector3::new(0.0, a * middle, 0.0)).unwrap();
            cable.step(dt).unwrap();
        }
        let terminal: f64 = (2.0 * mass * (g + a) / (1.2 * 0.01 * 1.1)).sqrt();
        let expected = terminal * ((g + a) * 2.0 / terminal).tanh() - a * 2.0;
        (-cable.sample(1.3).unwrap().velocity.y - expected).abs() / expected
    };
    let (coarse, fine) = (error(40), error(80));
    println!("{coarse:e} {fine:e}");
    assert!(fine < 1e-5 && (coarse / fine).log2() > 1.8, "{coarse:e} {fine:e}");
}

/// Samples of a flow that is linear in space make the force of the same flow by a table; a node that is inserted changes nothing.
///
/// *Source.* Linear interpolation of a linear function.
#[test]
fn samples_at_nodes_are_linear_between_them() {
    let flow = sheared();
    let mut tables = falling(flow.clone());
    let mut sampled = falling(Flow::default());
    sampled.sample_flow(|place| flow.at(0.0, &place)).unwrap();
    let difference = |a: &mut Cable, b: &mut Cable| largest_difference(&a.force(), &b.force());
    let size = tables.force().iter().fold(0.0f64, |m, x| m.max(x.abs()));
    assert!(difference(&mut tables, &mut sampled) < 1e-14 * size);
    let (node, same) = (tables.insert_node(0.73).unwrap(), sampled.insert_node(0.73).unwrap());
    assert_eq!((node, sampled.nodes()), (same, 6));
    assert!(difference(&mut tables, &mut sampled) < 1e-14 * size);
}

/// Samples are part of a cable that is serialised: read back, it goes on bitwise, and samples taken again go on from there.
///
/// *Source.* Bitwise equality.
#[test]
fn a_cable_read_back_keeps_its_samples() {
    let gust = |k: f64| move |r: Vector3<f64>| Vector3::new(0.0, k * r.x, 3.0 * k);
    let mut cable = falling(Flow::default());
    for k in 0..4 {
        cable.sample_flow(gust(f64::from(k))).unwrap();
        cable.step(0.05).unwrap();
    }
    let mut copy: Cable = serde_json::from_str(&serde_json::to_string(&cable).unwrap()).unwrap();
    for cable in [&mut cable, &mut copy] {
        cable.step(0.05).unwrap();
        cable.sample_flow(gust(9.0)).unwrap();
        cable.step(0.05).unwrap();
        // the same samples at the same places: nothing happens
        let state = cable.snapshot().clone();
        cable.sample_flow(|_| Vector3::x()).unwrap();
        assert!(*cable.snapshot() != state, "accelerations are to be computed anew");
        cable.step(0.05).unwrap();
        let state = cable.snapshot().clone();
        cable.sample_flow(|_| Vector3::x()).unwrap();
        assert_eq!(*cable.snapshot(), state);
    }
    assert_eq!(cable.snapshot(), copy.snapshot());
    assert_eq!(cable.diagnostics(), copy.diagnostics());
}

/// A flow that is not a number, of the wrong length or without drag is refused, and the cable is as before.
///
/// *Source.* The contract.
#[test]
fn bad_samples_are_refused() {
    let mut cable = falling(Flow::default());
    cable.sample_flow(|place| place).unwrap();
    let (before, force) = (cable.effects().clone(), cable.force());
    let error = cable.sample_flow(|place| place / 0.0).unwrap_err();
    assert!(matches!(&error, Error::InvalidValue { what, .. } if what.contains("sampled flow")), "{error}");
    assert_eq!(*cable.effects(), before);
    assert_eq!(cable.force(), force);
    let mut drag = before.drag.unwrap();
    drag.flow.samples.pop();
    assert!(cable.set_drag(drag).unwrap_err().to_string().contains("4 samples"));
    cable.set_drag(None).unwrap();
    assert!(cable.sample_flow(|place| place).unwrap_err().to_string().contains("drag"));
}
