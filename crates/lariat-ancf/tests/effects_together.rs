//! Effects together and at their limits: exact derivatives under every rule, momentum and energy of a free cable with everything on, bad
//! numbers, degenerate states.

mod common;

use common::{Random, rule, soft_cable};
use lariat_ancf::coupling::{Coupling, Linearisation};
use lariat_ancf::effect::Profile;
use lariat_ancf::{
    At, Buoyancy, Cable, Damping, Drag, Effects, Error, Flow, GravityScale, Integrator, LineLoad, Method, PointLoad,
    RestPiece, RestShape, Vector3,
};
use nalgebra::DMatrix;

const WATER: f64 = 1000.0;
const DIAMETER: f64 = 0.02;

fn sheared() -> Flow {
    let profile = Profile { up: Vector3::new(0.3, 1.0, 0.2), rows: vec![[-9.0, -3.0], [9.0, 4.0]] };
    Flow { profile: Some(profile), ..Flow::uniform(Vector3::new(0.5, 0.2, -0.1)) }
}

fn all() -> Effects {
    let piece = |from, stretch, curvature| RestPiece { from, stretch, curvature };
    Effects {
        damping: Some(Damping { axial: 0.02, bending: 0.03 }),
        drag: Some(Drag { diameter: Some(DIAMETER), ..Drag::new(WATER, 1.2, 0.05, sheared()) }),
        buoyancy: Some(Buoyancy { area: Some(3e-4), ..Buoyancy::new(WATER, 1.0) }),
        rest_shape: Some(RestShape { pieces: vec![piece(0.0, 0.97, 0.8), piece(0.4, 1.02, 1.5)] }),
        line_loads: Some(LineLoad { from: 0.2, to: 0.7, force: Vector3::new(0.1, 0.3, -0.2) }.into()),
        gravity_scale: Some(GravityScale(0.8)),
        // it has no rest stretch beside it: `axial_laws.rs`
        axial_law: None,
        // with every method, and contact has one
        contact: None,
        torsion: None,
    }
}

/// All effects that a cable with this rule can have.
fn allowed(name: &str, mut effects: Effects) -> Effects {
    if name.ends_with("none") {
        effects.damping.iter_mut().for_each(|d| d.bending = 0.0);
        effects.rest_shape.iter_mut().flat_map(|r| &mut r.pieces).for_each(|p| p.curvature = 0.0);
    }
    effects
}

/// Every effect alone, none, and all.
fn each() -> Vec<(&'static str, Effects)> {
    let Effects {
        damping,
        drag,
        buoyancy,
        rest_shape,
        line_loads,
        gravity_scale,
        axial_law: _,
        contact: _,
        torsion: _,
    } = all();
    let none = Effects::default;
    vec![
        ("none", none()),
        ("damping", Effects { damping, ..none() }),
        ("drag", Effects { drag, ..none() }),
        ("buoyancy", Effects { buoyancy, ..none() }),
        ("rest shape", Effects { rest_shape, ..none() }),
        ("line load", Effects { line_loads, ..none() }),
        ("gravity scale", Effects { gravity_scale, ..none() }),
        ("all", all()),
    ]
}

/// Bent in space, stretched unevenly, and moving.
fn shaken(effects: Effects, name: &str) -> Cable {
    let mut cable = soft_cable().rule(rule(name)).effects(effects).build().unwrap();
    let mut random = Random::new(7);
    let q: Vec<f64> = cable.positions().iter().map(|x| x + 0.05 * random.next()).collect();
    let v: Vec<f64> = q.iter().map(|_| random.next()).collect();
    cable.set_coordinates(&q, &v).unwrap();
    cable
}

/// The exact derivatives, which the scalar kernels give, are those of the force, which eight lanes give: by position and velocity, under
/// every kind of rule, for every effect alone and all at once.
///
/// *Source.* Central differences, Richardson-extrapolated.
#[test]
fn exact_derivatives_are_those_of_the_force_under_every_rule_and_effect() {
    for name in ["projected-3", "projected-none", "ST1", "ST2", "L2T2", "G5-3", "G5-5"] {
        for (effect, effects) in each() {
            let mut cable = shaken(allowed(name, effects), name);
            cable.add_load(PointLoad::moment(0.6, Vector3::new(0.3, -0.2, 0.1))).unwrap();
            if cable.effects().drag.is_some() {
                cable.sample_flow(|r| 0.5 * r + Vector3::z()).unwrap();
            }
            let exact = cable.jacobians();
            let (q, v) = (cable.positions().to_vec(), cable.velocities().to_vec());
            for (by, matrix) in [("position", &exact.stiffness), ("velocity", &exact.damping)] {
                let mut force = |i: usize, h: f64| {
                    let (mut q, mut v) = (q.clone(), v.clone());
                    if by == "position" {
                        q[i] += h
                    } else {
                        v[i] += h
                    };
                    cable.set_coordinates(&q, &v).unwrap();
                    nalgebra::DVector::from_vec(cable.force())
                };
                let mut expected = DMatrix::zeros(q.len(), q.len());
                for i in 0..q.len() {
                    let mut central = |h: f64| (force(i, -h) - force(i, h)) / (2.0 * h);
                    let (coarse, fine) = (central(1e-3), central(5e-4));
                    expected.set_column(i, &((4.0 * fine - coarse) / 3.0));
                }
                let error = (matrix - &expected).amax();
                // forces of 100 N make differences of 1e-11, over 1e-3
                assert!(error < 3e-7 * expected.amax() + 1e-8, "{name}, {effect}, {by}: {error:e}");
            }
        }
    }
}

/// What the step matrix holds: exact by velocity; of drag by position the symmetric half, at rest in a still fluid all there is.
///
/// *Source.* The exact derivatives.
#[test]
fn the_step_matrix_holds_the_parts_that_the_effects_say() {
    let half = |m: &DMatrix<f64>| (m + m.transpose()) * 0.5;
    for (effect, effects) in each().into_iter().filter(|(_, e)| e.rest_shape.is_none()) {
        let mut cable = shaken(effects.clone(), "projected-3");
        let (k, c) = (common::dense(&cable.stiffness_matrix()), common::dense(&cable.damping_matrix()));
        let exact = cable.jacobians();
        assert!((&c - &exact.damping).amax() < 1e-12 * exact.stiffness.amax(), "{effect}");
        let mut flow_in_space = effects.drag.is_some();
        if let Some(mut drag) = effects.drag {
            // of a flow that is the same everywhere
            drag.flow.profile = None;
            cable.set_drag(drag).unwrap();
            flow_in_space = false;
        }
        let (k, exact) =
            if effect == "drag" { (common::dense(&cable.stiffness_matrix()), cable.jacobians()) } else { (k, exact) };
        if effects.damping.is_none() && !flow_in_space {
            let error = (&k - half(&exact.stiffness)).amax();
            assert!(error < 1e-12 * exact.stiffness.amax(), "{effect}: {error:e}");
        }
        let v = vec![0.0; cable.positions().len()];
        let q = cable.positions().to_vec();
        cable.set_coordinates(&q, &v).unwrap();
        if effects.damping.is_some() {
            let error = (common::dense(&cable.stiffness_matrix()) - cable.jacobians().stiffness).amax();
            assert!(error < 1e-12 * exact.stiffness.amax(), "{effect} at rest: {error:e}");
        }
    }
}

/// Morison's force on a cable and its moment about the origin, by the midpoint rule over 400 pieces.
fn morison(cable: &Cable, drag: &Drag) -> [Vector3<f64>; 2] {
    let (n, mut sum) = (400, [Vector3::zeros(); 2]);
    for i in 0..n {
        let ds = cable.length() / f64::from(n);
        let s = cable.sample((f64::from(i) + 0.5) * ds).unwrap();
        let e = s.slope.normalize();
        let v = s.velocity - drag.flow.at(cable.time(), &s.position);
        let (along, across) = (e * v.dot(&e), v - e * v.dot(&e));
        let f = -0.5
            * drag.fluid_density
            * DIAMETER
            * (drag.normal * across.norm() * across + drag.tangential * along.norm() * along);
        sum[0] += f * ds;
        sum[1] += s.position.cross(&f) * ds;
    }
    sum
}

/// A free cable with every effect on gains the momentum, linear and angular, of its weight less buoyancy, its line load and its drag;
/// damping, rest shape and added mass give none. The energy less the work of effects is constant.
///
/// *Source.* Newton's laws for the cable with its added mass; Morison's formula integrated here.
#[test]
fn a_free_cable_with_every_effect_keeps_momentum_and_energy() {
    let effects = all();
    let drag = effects.drag.clone().unwrap();
    let load = effects.line_loads.as_ref().unwrap().0[0];
    let integrator = Integrator::substeps(Method::Esdirk4, 4).unwrap();
    let mut cable = soft_cable().elements(8).effects(effects).integrator(integrator).build().unwrap();
    cable.set_rigid_motion(Vector3::new(0.4, 0.1, -0.3), Vector3::new(0.5, 1.0, 2.0)).unwrap();
    let weight = Vector3::new(0.0, -9.81, 0.0) * (0.8 * (1.0 - WATER * 3e-4));
    let rates = |cable: &Cable| {
        let [mut force, mut moment] = morison(cable, &drag);
        for (from, to, f) in [(0.0, 1.0, weight), (load.from, load.to, load.force)] {
            for i in 0..200 {
                let ds = (to - from) / 200.0;
                let r = cable.sample(from + (f64::from(i) + 0.5) * ds).unwrap().position;
                force += f * ds;
                moment += r.cross(&f) * ds;
            }
        }
        [force, moment]
    };
    let balance = |cable: &Cable| cable.energy().total() - cable.effect_work().total();
    let (start, energy) = (cable.momentum(), balance(&cable));
    let (dt, steps) = (1.0 / 600.0, 120);
    let mut impulse = [Vector3::zeros(); 2];
    let mut before = rates(&cable);
    for _ in 0..steps {
        cable.step(dt).unwrap();
        let after = rates(&cable);
        for k in 0..2 {
            impulse[k] += (before[k] + after[k]) * (0.5 * dt);
        }
        before = after;
    }
    let end = cable.momentum();
    let (linear, angular) = (end.linear - start.linear, end.angular - start.angular);
    println!("linear {linear:?} {:?}\nangular {angular:?} {:?}", impulse[0], impulse[1]);
    assert!((linear - impulse[0]).norm() < 1e-3 * impulse[0].norm(), "{linear:?} {:?}", impulse[0]);
    assert!((angular - impulse[1]).norm() < 2e-3 * impulse[1].norm(), "{angular:?} {:?}", impulse[1]);
    let work = *cable.effect_work();
    let drift = balance(&cable) - energy;
    println!("energy drift {drift:e} of {work:?}");
    assert!(work.damping < -1e-3 && work.drag.abs() > 1e-2 && work.line_loads.abs() > 1e-3, "{work:?}");
    assert!(drift.abs() < 1e-4 * work.dissipated().abs(), "{drift:e} {work:?}");
}

/// Every number of every effect is checked: negative where it must not be, zero where it must be more, not finite anywhere. The error
/// names it and the cable keeps the effects it had.
///
/// *Source.* The contract: a typed error, never a NaN.
#[test]
fn every_number_of_every_effect_is_checked() {
    type Change = fn(&mut Effects, f64);
    fn drag(e: &mut Effects) -> &mut Drag {
        e.drag.as_mut().unwrap()
    }
    fn buoyancy(e: &mut Effects) -> &mut Buoyancy {
        e.buoyancy.as_mut().unwrap()
    }
    fn piece(e: &mut Effects) -> &mut RestPiece {
        &mut e.rest_shape.as_mut().unwrap().pieces[0]
    }
    fn load(e: &mut Effects) -> &mut LineLoad {
        &mut e.line_loads.as_mut().unwrap().0[0]
    }
    // change, whether 0 is refused, whether -1 is
    let numbers: &[(Change, bool, bool)] = &[
        (|e, x| e.damping.as_mut().unwrap().axial = x, false, true),
        (|e, x| e.damping.as_mut().unwrap().bending = x, false, true),
        (|e, x| drag(e).fluid_density = x, true, true),
        (|e, x| drag(e).normal = x, false, true),
        (|e, x| drag(e).tangential = x, false, true),
        (|e, x| drag(e).diameter = Some(x), true, true),
        (|e, x| drag(e).flow.velocity.y = x, false, false),
        (|e, x| drag(e).flow.history = vec![[0.0, x]], false, false),
        (|e, x| drag(e).flow.profile.as_mut().unwrap().rows[0][1] = x, false, false),
        (|e, x| drag(e).flow.profile.as_mut().unwrap().up = Vector3::new(x, 0.0, 0.0), true, false),
        (|e, x| drag(e).flow.samples = vec![Vector3::new(x, 0.0, 0.0); 4], false, false),
        (|e, x| buoyancy(e).fluid_density = x, true, true),
        (|e, x| buoyancy(e).added_mass = x, false, true),
        (|e, x| buoyancy(e).area = Some(x), true, true),
        (|e, x| piece(e).stretch = x, true, true),
        (|e, x| piece(e).curvature = x, false, true),
        (|e, x| piece(e).from = x, false, false),
        (|e, x| load(e).from = x, false, true),
        (|e, x| load(e).to = x, true, true),
        (|e, x| load(e).force.z = x, false, false),
        (|e, x| e.gravity_scale = Some(GravityScale(x)), false, false),
    ];
    let mut cable = soft_cable().effects(all()).build().unwrap();
    for (k, (change, zero, negative)) in numbers.iter().enumerate() {
        for (x, refused) in [(f64::NAN, true), (f64::INFINITY, true), (0.0, *zero), (-1.0, *negative)] {
            let mut effects = all();
            change(&mut effects, x);
            let outcome = cable.set_effects(effects);
            assert_eq!(outcome.is_err(), refused, "number {k}, {x}: {outcome:?}");
            match outcome {
                Ok(()) => cable.set_effects(all()).unwrap(),
                Err(error) => assert!(matches!(error, Error::InvalidValue { .. }), "number {k}, {x}: {error}"),
            }
            assert_eq!(*cable.effects(), all());
        }
    }
}

/// A piece of a rest shape that lies behind the end, or between the middles of two elements, would change nothing: it is refused.
///
/// *Source.* The contract: nothing is ignored without a word.
#[test]
fn a_rest_shape_that_no_element_has_is_refused() {
    let mut cable = soft_cable().build().unwrap();
    let piece = |from| RestPiece { from, stretch: 1.0, curvature: 0.5 };
    for pieces in [vec![piece(2.0)], vec![piece(0.0), piece(0.35), piece(0.4)]] {
        let error = cable.set_rest_shape(RestShape { pieces }).unwrap_err().to_string();
        assert!(error.contains("no element has its middle"), "{error}");
    }
    cable.set_rest_shape(RestShape { pieces: vec![piece(0.0), piece(0.35)] }).unwrap();
}

/// A cable crushed into a point, where no direction and no curvature is defined, is refused by its step with a typed error and left as it
/// was; with drag alone on a limp cable too.
///
/// *Source.* The contract: no NaN leaves a step.
#[test]
fn a_crushed_cable_with_effects_is_refused_not_a_nan() {
    for name in ["projected-3", "projected-none"] {
        for (effect, effects) in each() {
            let mut cable = soft_cable().rule(rule(name)).effects(allowed(name, effects)).build().unwrap();
            let still = vec![0.0; cable.positions().len()];
            cable.set_coordinates(&still, &still).unwrap();
            let before = cable.snapshot().clone();
            match cable.step(0.01) {
                Ok(()) => assert!(cable.positions().iter().all(|x| x.is_finite()), "{name} {effect}"),
                Err(error) => {
                    assert!(matches!(error, Error::StepFailed { .. }), "{name} {effect}: {error}");
                    assert_eq!(cable.positions(), before_positions(&before, &cable), "{name} {effect}");
                }
            }
            assert!(cable.effect_work().dissipated().is_finite());
        }
    }
}

fn before_positions(before: &lariat_ancf::Snapshot, cable: &Cable) -> Vec<f64> {
    let mut other = cable.clone();
    other.restore(before.clone()).unwrap();
    other.positions().to_vec()
}

/// A mode is named by its number, from 1; motions without stiffness have none.
///
/// *Source.* zeta = tau omega/2 (Clough & Penzien 1993); a free straight rod has five rigid motions (none about its axis); a limp cable no bending to damp.
#[test]
fn a_damping_ratio_is_asked_for_by_the_number_of_a_mode() {
    let straight = [Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0)];
    let build = || soft_cable().points(straight).gravity(Vector3::zeros());
    let mut clamped = build().clamp(At::Start).build().unwrap();
    let omega = clamped.natural_frequencies();
    let damping = clamped.damping_at_mode(0.05, 3).unwrap();
    assert!((damping.bending_ratio(omega[2]) / 0.05 - 1.0).abs() < 1e-12);
    let mut free = build().build().unwrap();
    let omega = free.natural_frequencies()[5];
    let damping = free.damping_at_mode(0.05, 1).unwrap();
    assert!((damping.bending_ratio(omega) / 0.05 - 1.0).abs() < 1e-12);
    for mode in [0, 1000] {
        assert!(matches!(clamped.damping_at_mode(0.05, mode), Err(Error::OutOfRange { .. })));
    }
    assert!(matches!(clamped.damping_at_mode(-0.05, 1), Err(Error::InvalidValue { .. })));
    let mut limp = build().rule(rule("projected-none")).build().unwrap();
    let damping = limp.damping_at_mode(0.05, 1).unwrap();
    assert!(damping.axial > 0.0 && damping.bending == 0.0);
    limp.set_damping(damping).unwrap();
}
