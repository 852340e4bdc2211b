//! Bodies with a carried inertia: they move as the rigidly joined bodies.

use super::bench::{Scene, cube};
use lariat_ancf::island::{CoupledInertia, RigidBody};
use lariat_ancf::{At, Cable, Integrator, Method, Section, Vector3};
use nalgebra::{Matrix3, Matrix6};

/// N, m, kg/m: a spring of 5e4 N/m.
const STIFFNESS: f64 = 1e5;
const LENGTH: f64 = 2.0;
const LINE: f64 = 1e-3;
/// Stretch at the start in m, so small that directions are constant.
const STRETCH: f64 = 1e-5;

/// Returns the inertia of a second body, `arm` away from the first, about the first's centre of
/// mass.
fn joined(mass: f64, inertia: &Matrix3<f64>, arm: &Vector3<f64>) -> Matrix6<f64> {
    let lever = arm.cross_matrix() * mass;
    let mut out = Matrix6::identity() * mass;
    out.fixed_view_mut::<3, 3>(0, 3).copy_from(&-lever);
    out.fixed_view_mut::<3, 3>(3, 0).copy_from(&lever);
    out.fixed_view_mut::<3, 3>(3, 3).copy_from(&(inertia - lever * arm.cross_matrix()));
    out
}

/// A cube of 2 kg with another of 3 kg joined to it, above, beside and behind, on a taut light rope
/// along x, is released: it oscillates along x with the effective mass of the joined bodies, for
/// each of several methods.
///
/// *Source.* Rigid dynamics: at a distance d from the common centre of mass, across the force, a
/// body of mass M and inertia I about that centre has the effective mass 1/(1/M + d.I^-1 d); the
/// rope adds a third of its mass. The position is a cosine of time.
#[test]
fn a_body_with_carried_inertia_moves_as_the_joined_bodies() {
    let (mass, other, side) = (2.0, 3.0, 0.2);
    let arms =
        [Vector3::zeros(), Vector3::new(0.3, 0.0, 0.0), Vector3::new(0.0, 0.3, 0.0), Vector3::new(0.1, -0.2, 0.25)];
    for (arm, method) in arms.iter().flat_map(|arm| [Method::Esdirk4, Method::TrBdf2, Method::Rkn4].map(|m| (*arm, m)))
    {
        let cable = Cable::builder()
            .points([Vector3::zeros(), Vector3::new(LENGTH + STRETCH, 0.0, 0.0)])
            .length(LENGTH)
            .section(Section::from_stiffness(STIFFNESS, 0.1, LINE).unwrap())
            .elements(2)
            .gravity(Vector3::zeros())
            .fix(At::Start)
            .build()
            .unwrap();
        let mut body = RigidBody::new(mass, cube(mass, side), Vector3::new(LENGTH + STRETCH, 0.0, 0.0)).unwrap();
        body.carried = Some(joined(other, &cube(other, side), &arm));
        let integrator = match method {
            Method::Rkn4 => Integrator { method, control: lariat_ancf::StepControl::Stable(0.5) },
            _ => Integrator::tolerance(method, 1e-10).unwrap(),
        };
        let mut scene = Scene::new(vec![cable], vec![body], integrator).pin(0, At::End, 0, Vector3::zeros());

        let total = mass + other;
        // the common centre of mass, and the inertia about it
        let centre = arm * (other / total);
        let part = |m: f64, at: Vector3<f64>| cube(m, side) - m * at.cross_matrix() * at.cross_matrix();
        let inertia = part(mass, -centre) + part(other, arm - centre);
        let across = (-centre).cross(&Vector3::x());
        let rotation = inertia.try_inverse().unwrap() * across;
        let reduced = 1.0 / (1.0 / total + across.dot(&rotation)) + LINE * LENGTH / 3.0;
        let rate = (STIFFNESS / LENGTH / reduced).sqrt();

        let (steps, dt) = (60, core::f64::consts::TAU / rate / 40.0);
        let mut worst = 0.0f64;
        for k in 1..=steps {
            scene.run(dt, 1);
            let expected = LENGTH + STRETCH * (rate * dt * f64::from(k)).cos();
            worst = worst.max((scene.bodies[0].position.x - expected).abs() / STRETCH);
        }
        println!("{arm:?} {method:?}: {worst:.1e} of the stretch, reduced mass {reduced:.4} kg");
        assert!(worst < 1e-3, "{arm:?} {method:?}: {worst:.1e}");
    }
}

/// Two bodies whose inertia is coupled, each on a taut light rope along x, are released in one of their modes: both oscillate at its
/// frequency, for each of several methods.
///
/// *Source.* The eigenvalue problem `K - w^2 M` of two degrees of freedom, solved by hand; the ropes add a third of their mass. The
/// positions are cosines of time.
#[test]
fn bodies_with_coupled_inertia_move_in_their_modes() {
    let (masses, coupling, k) = ([2.0, 3.5], 1.3, STIFFNESS / LENGTH);
    let [a, b] = masses.map(|m| m + LINE * LENGTH / 3.0);
    // (a b - c^2) x^2 - k (a + b) x + k^2 = 0 of x = w^2
    let (p, q) = (a * b - coupling * coupling, k * (a + b));
    for (sign, method) in [-1.0, 1.0]
        .into_iter()
        .flat_map(|sign| [Method::Esdirk4, Method::TrBdf2, Method::DiscreteGradient].map(|method| (sign, method)))
    {
        let square = (q + sign * (q * q - 4.0 * p * k * k).sqrt()) / (2.0 * p);
        let rate: f64 = f64::sqrt(square);
        let mode = Vector3::new(coupling * square, k - a * square, 0.0).normalize();
        let start = [mode.x, mode.y].map(|share| LENGTH + 2.0 * STRETCH + STRETCH * share);
        let cables = [0.0, 1.0].into_iter().zip(start).map(|(y, x)| {
            let rope = Cable::builder().points([Vector3::new(0.0, y, 0.0), Vector3::new(x, y, 0.0)]).length(LENGTH);
            let section = Section::from_stiffness(STIFFNESS, 0.1, LINE).unwrap();
            rope.section(section).elements(2).gravity(Vector3::zeros()).fix(At::Start).build().unwrap()
        });
        let bodies = [0.0, 1.0].into_iter().zip(start).zip(masses).map(|((y, x), mass)| {
            let mut body = RigidBody::new(mass, cube(mass, 0.2), Vector3::new(x, y, 0.0)).unwrap();
            // holds the ropes taut
            body.force.x = k * 2.0 * STRETCH;
            body
        });
        let integrator = match method {
            Method::DiscreteGradient => Integrator { method, control: lariat_ancf::StepControl::Substeps(8) },
            _ => Integrator::tolerance(method, 1e-10).unwrap(),
        };
        let mut scene = Scene::new(cables.collect(), bodies.collect(), integrator);
        for i in 0..2 {
            scene = scene.pin(i, At::End, i, Vector3::zeros());
        }
        let matrix = Matrix6::from_diagonal_element(coupling);
        scene.island.couple(&[CoupledInertia { bodies: [0, 1], matrix }]);
        let (steps, dt) = (60, core::f64::consts::TAU / rate / 40.0);
        let mut worst = 0.0f64;
        for step in 1..=steps {
            scene.run(dt, 1);
            for (body, share) in scene.bodies.iter().zip([mode.x, mode.y]) {
                let expected = LENGTH + 2.0 * STRETCH + STRETCH * share * (rate * dt * f64::from(step)).cos();
                worst = worst.max((body.position.x - expected).abs() / STRETCH);
            }
        }
        println!("{method:?}, {rate:.1} rad/s: {worst:.1e} of the stretch");
        // of the discrete gradient: second order, at 320 steps per period
        assert!(worst < 2e-3, "{method:?} at {rate:.1} rad/s: {worst:.1e}");
    }
}

/// A coupling of bodies that are not there, or of a body with itself, or that is not finite, is a typed error.
#[test]
fn an_impossible_coupling_is_an_error_that_changes_nothing() {
    for (bodies, value) in [([0, 0], 0.1), ([0, 7], 0.1), ([0, 1], f64::NAN)] {
        let cable =
            Cable::builder().points([Vector3::zeros(), Vector3::x()]).section(Section::square(0.01, 1e9, 1e3).unwrap());
        let body = |x: f64| RigidBody::new(1.0, cube(1.0, 0.2), Vector3::new(x, 0.0, 0.0)).unwrap();
        let cable = cable.fix(At::Start).build().unwrap();
        let scene = Scene::new(vec![cable], vec![body(1.0), body(2.0)], Integrator::default());
        let mut scene = scene.pin(0, At::End, 0, Vector3::zeros());
        scene.island.couple(&[CoupledInertia { bodies, matrix: Matrix6::from_diagonal_element(value) }]);
        let before = scene.cables[0].positions().to_vec();
        assert!(matches!(scene.try_step(0.01), Err(lariat_ancf::Error::InvalidValue { .. })), "{bodies:?}");
        assert_eq!(scene.cables[0].positions(), before);
    }
}
