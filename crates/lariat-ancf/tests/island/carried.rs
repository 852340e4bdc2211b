//! Bodies with a carried inertia: they move as the rigidly joined bodies.

use super::bench::{Scene, cube};
use lariat_ancf::island::RigidBody;
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
