//! Rest shape, line loads and scaled gravity against outside values, named with their source.

mod common;

use common::beam::{cantilever, first_mode, only};
use lariat_ancf::{At, Cable, GravityScale, LineLoad, PointLoad, RestShape, Section, Vector3};

/// A pre-curved rod without load is an arc of its natural curvature, and an end moment M changes the curvature by M/EI.
///
/// *Source.* Euler-Bernoulli rod, kappa = kappa_0 + M/EI (Timoshenko 1930, part II, initially curved bars); the stretch that the Green
/// law makes is below 1e-4 here.
#[test]
fn a_pre_curved_rod_takes_its_natural_shape() {
    let (k0, n) = (1.2, 10);
    // drawn as a polyline on the arc
    let arc = |k: f64, s: f64| Vector3::new((k * s).sin() / k, (1.0 - (k * s).cos()) / k, 0.0);
    let points: Vec<_> = (0..=60).map(|i| arc(1.1 * k0, f64::from(i) / 60.0)).collect();
    let build = || {
        let mut cable = Cable::builder()
            .points(points.clone())
            .length(1.0)
            .section(Section::from_stiffness(1e5, 1.0, 1.0).unwrap())
            .elements(n)
            .gravity(Vector3::zeros())
            .effects(only(|e| e.rest_shape = Some(RestShape::curved(k0))))
            .build()
            .unwrap();
        let mut support = cable.support(At::Start).unwrap();
        support.position = Some(lariat_ancf::Motion::fixed(Vector3::zeros()));
        support.slope = lariat_ancf::SlopeSupport::Direction(Vector3::x());
        cable.set_support(At::Start, support).unwrap();
        cable
    };
    let mut cable = build();
    cable.equilibrium().unwrap();
    for i in 0..=n {
        let s = i as f64 / n as f64;
        let r = cable.node_position(i);
        assert!((r - arc(k0, s)).norm() < 1e-5, "{s}: {r} {}", arc(k0, s));
    }
    assert!(cable.energy().bending < 1e-6 && cable.sample(0.55).unwrap().moment.norm() < 1e-3);
    for moment in [0.5, 1.0] {
        let mut cable = build();
        cable.add_load(PointLoad::moment(1.0, Vector3::new(0.0, 0.0, moment))).unwrap();
        cable.equilibrium().unwrap();
        let (r, expected) = (cable.node_position(n), arc(k0 + moment, 1.0));
        assert!((r - expected).norm() < 5e-4, "{moment}: {r} {expected}");
        let read = cable.sample(0.5).unwrap().moment.norm();
        assert!((read - moment.abs()).abs() < 5e-3, "{read}");
    }
}

/// A cable laid between supports at its reference length, stress-free at a stretch below 1, is under the tension EA (1 - f_0^2)/2.
///
/// *Source.* The Green law. A string so tensioned vibrates at pi sqrt(N/rhoA)/L.
#[test]
fn pre_strain_is_tension() {
    let f0: f64 = 0.98;
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0)])
        .section(Section::from_stiffness(1e4, 1e-4, 0.1).unwrap())
        .elements(10)
        .gravity(Vector3::zeros())
        .fix(At::Start)
        .fix(At::End)
        .effects(only(|e| e.rest_shape = Some(RestShape::stretched(f0))))
        .build()
        .unwrap();
    let tension = 1e4 * 0.5 * (1.0 - f0 * f0);
    assert!((cable.sample(0.37).unwrap().tension - tension).abs() < 1e-9 * tension);
    let reaction = cable.reactions().unwrap()[0].force.x;
    assert!((reaction + tension).abs() < 1e-9 * tension, "{reaction} {tension}");
    let (omega, _) = first_mode(&mut cable);
    let expected = std::f64::consts::PI * (tension / 0.1f64).sqrt();
    assert!((omega / expected - 1.0).abs() < 1e-3, "{omega} {expected}");
    let energy = cable.energy().axial;
    assert!((energy - 0.5 * 1e4 * (0.5 * (1.0 - f0 * f0)).powi(2)).abs() < 1e-9);
}

/// A cantilever under a force per length bends as a beam does, on a part of it too; the line load's work is counted.
///
/// *Source.* Tip deflections q L^4/(8 EI), and for a load on the outer half 41 q L^4/(384 EI) (superposition of Timoshenko 1930).
#[test]
fn line_loads_bend_a_cantilever_as_a_beam() {
    let q = Vector3::new(0.0, 0.0, 1e-3);
    for (load, expected) in [
        (LineLoad::uniform(q), 1e-3 / 8.0),
        (LineLoad { from: 0.5, to: 1.0, force: q }, 41e-3 / 384.0),
        // inside elements: the sum of two pieces is the whole
        (LineLoad { from: 0.0, to: 0.33, force: q }, 1e-3 / 8.0),
    ] {
        let mut cable = cantilever(7).build().unwrap();
        cable.add_line_load(load).unwrap();
        if load.to == 0.33 {
            cable.add_line_load(LineLoad { from: 0.33, to: 5.0, force: q }).unwrap();
        }
        cable.equilibrium().unwrap();
        let tip = cable.node_position(7).z;
        assert!((tip / expected - 1.0).abs() < 1e-4, "{load:?}: {tip} {expected}");
    }
    let mut cable = cantilever(7).build().unwrap();
    cable.add_line_load(LineLoad::uniform(1000.0 * q)).unwrap();
    (0..20).for_each(|_| cable.step(0.02).unwrap());
    let (total, work) = (cable.energy().total(), cable.effect_work().line_loads);
    assert!(work > 1e-3 && (total - work).abs() < 1e-5 * work, "{total} {work}");
}

/// Gravity's scale is gravity's scale.
///
/// *Source.* A run with that gravity, to rounding.
#[test]
fn a_gravity_scale_is_a_scaled_gravity() {
    let run = |scale: f64, g: f64| {
        let mut cable = common::pendulum(6).gravity(Vector3::new(0.0, -g, 0.0)).build().unwrap();
        cable.set_gravity_scale(GravityScale(scale)).unwrap();
        (0..20).for_each(|_| cable.step(0.01).unwrap());
        cable.positions().to_vec()
    };
    assert!(common::largest_difference(&run(0.5, 9.0), &run(1.0, 4.5)) < 1e-12);
    assert!(common::largest_difference(&run(0.0, 9.0), &run(0.0, 4.5)) == 0.0);
}
