//! Effects as forces: derivatives by differences, rigid motion, rest, counters.

mod common;

use common::{Random, dense, rule, soft_cable};
use lariat_ancf::coupling::Linearisation;
use lariat_ancf::{
    At, Buoyancy, Cable, Damping, Drag, Effects, Error, Flow, GravityScale, Integrator, LineLoad, Method, RestPiece,
    RestShape, Section, Vector3,
};
use nalgebra::{DMatrix, DVector};

const DAMPING: Damping = Damping { axial: 0.02, bending: 0.03 };

fn drag(flow: Vector3<f64>) -> Drag {
    Drag { diameter: Some(0.02), ..Drag::new(1000.0, 1.2, 0.02, Flow::uniform(flow)) }
}

fn rest_shape() -> RestShape {
    let piece = |from, stretch, curvature| RestPiece { from, stretch, curvature };
    RestShape { pieces: vec![piece(0.0, 0.97, 0.8), piece(0.4, 1.02, 1.5)] }
}

fn all() -> Effects {
    Effects {
        damping: Some(DAMPING),
        drag: Some(drag(Vector3::new(0.5, 0.2, -0.1))),
        buoyancy: Some(Buoyancy { area: Some(3e-4), ..Buoyancy::new(1000.0, 1.0) }),
        rest_shape: Some(rest_shape()),
        line_loads: Some(LineLoad { from: 0.2, to: 0.7, force: Vector3::new(0.1, 0.3, -0.2) }.into()),
        gravity_scale: Some(GravityScale(0.8)),
        // it has no rest stretch beside it: `axial_laws.rs`
        axial_law: None,
        // with every method, and contact has one
        contact: None,
        torsion: None,
    }
}

/// Bent in space, stretched unevenly, and moving.
fn shaken(effects: Effects, name: &str) -> Cable {
    let mut cable = soft_cable().rule(rule(name)).effects(effects).build().unwrap();
    let mut random = Random::new(3);
    let q: Vec<f64> = cable.positions().iter().map(|x| x + 0.05 * random.next()).collect();
    let v: Vec<f64> = q.iter().map(|_| random.next()).collect();
    cable.set_coordinates(&q, &v).unwrap();
    cable
}

/// Derivative of the generalised force by positions or velocities, by central differences.
fn differences(cable: &mut Cable, by_velocity: bool) -> DMatrix<f64> {
    let (q, v) = (cable.positions().to_vec(), cable.velocities().to_vec());
    let n = q.len();
    let mut at = |i: usize, h: f64| {
        let (mut q, mut v) = (q.clone(), v.clone());
        if by_velocity {
            v[i] += h
        } else {
            q[i] += h
        }
        cable.set_coordinates(&q, &v).unwrap();
        DVector::from_vec(cable.force())
    };
    let mut out = DMatrix::zeros(n, n);
    for i in 0..n {
        let central = |a: DVector<f64>, b: DVector<f64>, h: f64| (a - b) / (2.0 * h);
        let h = 1e-3;
        let coarse = central(at(i, h), at(i, -h), h);
        let fine = central(at(i, 0.5 * h), at(i, -0.5 * h), 0.5 * h);
        out.set_column(i, &((4.0 * fine - coarse) / 3.0));
    }
    cable.set_coordinates(&q, &v).unwrap();
    out
}

fn only(change: impl FnOnce(&mut Effects)) -> Effects {
    let mut effects = Effects::default();
    change(&mut effects);
    effects
}

/// The damping matrix is minus the derivative of the force by velocity, for damping and for drag, under every kind of bending rule.
///
/// *Source.* Central differences, Richardson-extrapolated.
#[test]
fn the_damping_matrix_is_the_derivative_of_the_force_by_velocity() {
    for name in ["projected-3", "G5-none", "ST2", "exact-T1", "G5-5"] {
        let axial_only = Damping { bending: 0.0, ..DAMPING };
        let damping = if name == "G5-none" { axial_only } else { DAMPING };
        for effects in
            [only(|e| e.damping = Some(damping)), only(|e| e.drag = Some(drag(Vector3::new(0.5, 0.2, -0.1))))]
        {
            let mut cable = shaken(effects, name);
            let c = dense(&cable.damping_matrix());
            let expected = -differences(&mut cable, true);
            assert!((&c - &expected).amax() < 1e-7 * expected.amax(), "{name}: {:e}", (&c - &expected).amax());
            // it removes energy from every motion
            let least = c.symmetric_eigenvalues().min();
            assert!(least > -1e-9 * c.amax(), "{name}: {least}");
        }
    }
}

/// Rest shape and constant loads enter the stiffness exactly; so does drag by its symmetric half.
///
/// *Source.* Central differences.
#[test]
fn the_stiffness_matrix_is_the_derivative_of_the_force_by_position() {
    for name in ["projected-3", "ST2", "G5-5"] {
        let mut effects = Effects { damping: None, drag: None, ..all() };
        // natural curvatures that the shaken cable exceeds: below, its tangent is not exact on purpose
        effects.rest_shape.iter_mut().flat_map(|r| &mut r.pieces).for_each(|p| p.curvature *= 0.01);
        let mut cable = shaken(effects, name);
        let k = dense(&cable.stiffness_matrix());
        let expected = -differences(&mut cable, false);
        assert!((&k - &expected).amax() < 1e-6 * expected.amax(), "{name}: {:e}", (&k - &expected).amax());
    }
    let bare = dense(&shaken(Effects::default(), "projected-3").stiffness_matrix());
    let mut cable = shaken(only(|e| e.drag = Some(drag(Vector3::new(0.5, 0.2, -0.1)))), "projected-3");
    let k = dense(&cable.stiffness_matrix()) - &bare;
    let expected = -differences(&mut cable, false) - &bare;
    let expected = 0.5 * (&expected + expected.transpose());
    assert!((&k - &expected).amax() < 1e-6 * expected.amax(), "{:e}", (&k - &expected).amax());
}

/// The force of a rest shape is the gradient of its energy.
///
/// *Source.* Central differences of the energy.
#[test]
fn the_force_of_a_rest_shape_is_the_gradient_of_its_energy() {
    for name in ["projected-3", "ST2", "L2T2", "G5-5", "G3-none"] {
        let mut rest = rest_shape();
        if name == "G3-none" {
            rest.pieces.iter_mut().for_each(|piece| piece.curvature = 0.0);
        }
        let mut cable = shaken(only(|e| e.rest_shape = Some(rest)), name);
        cable.set_gravity_scale(GravityScale(0.0)).unwrap();
        let (q, v, force) = (cable.positions().to_vec(), cable.velocities().to_vec(), cable.force());
        let mut energy = |i: usize, h: f64| {
            let mut q = q.clone();
            q[i] += h;
            cable.set_coordinates(&q, &v).unwrap();
            let e = cable.energy();
            e.axial + e.bending
        };
        for i in 0..q.len() {
            let central = |a: f64, b: f64, h: f64| (a - b) / (2.0 * h);
            let (c, f) =
                (central(energy(i, 1e-3), energy(i, -1e-3), 1e-3), central(energy(i, 5e-4), energy(i, -5e-4), 5e-4));
            let slope = (4.0 * f - c) / 3.0;
            assert!((slope + force[i]).abs() < 1e-7, "{name} {i}: {slope} {}", force[i]);
        }
    }
}

/// A rigid motion, spin about any axis included, makes no damping force and dissipates nothing; the power of damping is that of its force.
///
/// *Source.* Objectivity; the bound is rounding.
#[test]
fn rigid_motion_is_not_damped_and_dissipation_is_the_work_of_the_force() {
    let mut damped = shaken(only(|e| e.damping = Some(DAMPING)), "projected-3");
    let mut bare = shaken(Effects::default(), "projected-3");
    let q = bare.positions().to_vec();
    let mut random = Random::new(5);
    for _ in 0..5 {
        let (u, spin) = (random.vector() * 10.0, random.vector() * 10.0);
        let v: Vec<f64> = q
            .chunks_exact(3)
            .enumerate()
            .flat_map(|(i, x)| {
                let turn = spin.cross(&Vector3::new(x[0], x[1], x[2]));
                let v = if i % 2 == 0 { u + turn } else { turn };
                [v.x, v.y, v.z]
            })
            .collect();
        damped.set_coordinates(&q, &v).unwrap();
        bare.set_coordinates(&q, &v).unwrap();
        let (a, b) = (damped.force(), bare.force());
        let size = b.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        for (a, b) in a.iter().zip(&b) {
            assert!((a - b).abs() < 1e-13 * size, "{a} {b}");
        }
    }
    // at rest it leaves nothing either
    let still = vec![0.0; q.len()];
    damped.set_coordinates(&q, &still).unwrap();
    bare.set_coordinates(&q, &still).unwrap();
    assert_eq!(damped.force(), bare.force());
}

/// Each effect's counter is zero when it is absent, and counts every element when it is on; constant effects evaluate nothing.
///
/// *Source.* Effects are paid for only where the scene calls for them.
#[test]
fn absent_effects_evaluate_nothing() {
    let counts = |effects: Effects| {
        let mut cable = soft_cable().fix(At::Start).effects(effects).build().unwrap();
        (0..5).for_each(|_| cable.step(0.01).unwrap());
        let d = *cable.diagnostics();
        (d.element_evaluations(), [d.effects.damping, d.effects.drag, d.effects.rest_shape])
    };
    assert_eq!(counts(Effects::default()).1, [0; 3]);
    let constant = Effects { damping: None, drag: None, rest_shape: None, ..all() };
    assert_eq!(counts(constant).1, [0; 3]);
    let (n, c) = counts(only(|e| e.damping = Some(DAMPING)));
    assert_eq!(c, [n, 0, 0]);
    let (n, c) = counts(only(|e| e.drag = Some(drag(Vector3::zeros()))));
    assert_eq!(c, [0, n, 0]);
    let (n, c) = counts(only(|e| e.rest_shape = Some(rest_shape())));
    assert_eq!(c, [0, 0, n]);
    let (n, c) = counts(all());
    assert_eq!(c, [n; 3]);
}

/// What an effect needs and the cable does not have is an error, never ignored; the cable is then as before.
///
/// *Source.* The contract.
#[test]
fn an_effect_without_its_numbers_is_refused() {
    let section = Section::from_stiffness(100.0, 0.1, 1.0).unwrap();
    let points = [Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0)];
    let build = || Cable::builder().points(points).section(section);
    let mut cable = build().build().unwrap();
    let refused = |result: Result<(), Error>, text: &str| {
        let error = result.unwrap_err().to_string();
        assert!(error.contains(text), "{error}");
    };
    refused(cable.set_drag(Drag::new(1.2, 1.0, 0.0, Flow::default())), "diameter");
    refused(cable.set_buoyancy(Buoyancy::new(1000.0, 1.0)), "area");
    refused(cable.set_damping(Damping { axial: -1.0, bending: 0.0 }), "axial damping time");
    refused(cable.set_rest_shape(RestShape::stretched(0.0)), "rest stretch");
    refused(cable.set_gravity_scale(GravityScale(f64::NAN)), "gravity scale");
    refused(cable.add_line_load(LineLoad { from: 2.0, to: 3.0, force: Vector3::x() }), "line load");
    assert_eq!(*cable.effects(), Effects::default());
    let mut limp = build().rule(rule("G5-none")).build().unwrap();
    refused(limp.set_damping(DAMPING), "bending rule");
    refused(limp.set_rest_shape(RestShape::curved(1.0)), "bending rule");
    limp.set_damping(Damping { axial: 0.1, bending: 0.0 }).unwrap();
    // explicit methods
    refused(limp.set_integrator(Integrator::substeps(Method::Verlet, 100).unwrap()), "verlet");
    cable.set_integrator(Integrator::substeps(Method::Rkn4, 100).unwrap()).unwrap();
    refused(cable.set_damping(DAMPING), "rkn4");
    cable.set_rest_shape(RestShape::curved(0.3)).unwrap();
    cable.step(0.001).unwrap();
}
