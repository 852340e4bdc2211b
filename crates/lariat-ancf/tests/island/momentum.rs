//! Free systems keep their momenta and their energy; turned systems run the same.

use super::bench::{Scene, cube, soft};
use super::common::{Random, map3};
use lariat_ancf::island::RigidBody;
use lariat_ancf::{At, Cable, Integrator, Method, StepControl, Vector3};
use nalgebra::{Matrix3, UnitQuaternion};

fn cable(from: Vector3<f64>, to: Vector3<f64>, length: f64) -> Cable {
    Cable::builder()
        .points([from, to])
        .length(length)
        .section(soft())
        .elements(5)
        .gravity(Vector3::zeros())
        .build()
        .unwrap()
}

/// 1 kg and 10 kg on a cable that is a little stretched, spinning about one of them.
fn dumbbell(integrator: Integrator) -> Scene {
    let mut bodies =
        [(1.0, 0.0), (10.0, 2.0)].map(|(m, x)| RigidBody::new(m, cube(m, 0.2), Vector3::new(x, 0.0, 0.0)).unwrap());
    for (body, speed) in bodies.iter_mut().zip([-9.0, 1.0]) {
        body.velocity = Vector3::new(0.0, speed, 0.0);
        body.angular_velocity = Vector3::new(0.0, 0.0, 5.0);
    }
    let cable = cable(Vector3::new(0.1, 0.0, 0.0), Vector3::new(1.9, 0.0, 0.0), 1.799);
    Scene::new(vec![cable], bodies.to_vec(), integrator).pin(0, At::Start, 0, Vector3::new(0.1, 0.0, 0.0)).pin(
        0,
        At::End,
        1,
        Vector3::new(-0.1, 0.0, 0.0),
    )
}

/// Three tumbling bricks on two cables, one slack, one taut, pinned off their axes, drifting.
fn three_bricks(integrator: Integrator) -> Scene {
    let brick = |mass: f64, at: Vector3<f64>, velocity: Vector3<f64>, spin: Vector3<f64>| {
        let inertia = Matrix3::from_diagonal(&Vector3::new(0.02, 0.05, 0.06)) * mass;
        let mut body = RigidBody::new(mass, inertia, at).unwrap();
        body.velocity = velocity;
        body.angular_velocity = spin;
        body
    };
    let bodies = vec![
        brick(2.0, Vector3::new(-0.1, -0.1, 0.0), Vector3::new(0.0, 1.0, 0.5), Vector3::new(1.0, -2.0, 3.0)),
        brick(5.0, Vector3::new(1.1, 0.1, 0.0), Vector3::new(0.3, 0.0, -0.2), Vector3::new(0.5, 4.0, 0.1)),
        brick(1.0, Vector3::new(2.2, -0.1, 0.1), Vector3::new(0.0, -2.0, 1.0), Vector3::new(-2.0, 0.0, 1.0)),
    ];
    let cables = vec![
        cable(Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0), 1.05),
        cable(Vector3::new(1.2, 0.2, 0.0), Vector3::new(2.1, 0.0, 0.1), 0.9268),
    ];
    Scene::new(cables, bodies, integrator)
        .pin(0, At::Start, 0, Vector3::new(0.1, 0.1, 0.0))
        .pin(0, At::End, 1, Vector3::new(-0.1, -0.1, 0.0))
        .pin(1, At::Start, 1, Vector3::new(0.1, 0.1, 0.0))
        .pin(1, At::End, 2, Vector3::new(-0.1, 0.1, 0.0))
}

/// Relative changes of linear momentum, angular momentum and energy over 1 s at 1/60 s, from the first step on: in that one
/// the cables, at rest at first, are struck by their bodies.
fn changes(mut scene: Scene) -> (f64, f64, f64) {
    scene.run(1.0 / 60.0, 1);
    let ((p0, l0), e0) = (scene.momentum(), scene.energy());
    scene.run(1.0 / 60.0, 60);
    let ((p, l), e) = (scene.momentum(), scene.energy());
    assert!(scene.gap() < 1e-12, "gap {:.1e}", scene.gap());
    ((p - p0).norm() / l0.norm(), (l - l0).norm() / l0.norm(), (e - e0) / e0)
}

/// A dumbbell, and three tumbling bricks on two cables, 3D, pinned off their axes, one cable slack, for 1 s at 1/60 s: momenta
/// and energy stay to what the integrator promises. With a tolerance of 1e-8 m momenta stay to rounding; TR-BDF2 damps waves, so
/// its energy falls (by 3.5 % here: the cables start at rest and are struck), and its momenta stay to its order; explicit methods see the bodies' velocities half a step late, so
/// here they are of order 1, and small only because their steps are.
///
/// *Source.* Conservation laws. Changes are relative to the angular momentum and the energy of the start.
#[test]
fn free_systems_keep_their_momenta() {
    let explicit = |method, share| Integrator { method, control: StepControl::Stable(share) };
    let cases = [
        (Integrator::tolerance(Method::Esdirk4, 1e-8).unwrap(), 1e-11, 1e-11, 1e-7),
        (Integrator::default(), 1e-9, 1e-7, 1e-4),
        (Integrator { method: Method::TrBdf2, control: StepControl::MaxStep(1.0 / 240.0) }, 1e-5, 1e-4, 0.05),
        (explicit(Method::Verlet, 0.5), 2e-5, 5e-5, 1e-4),
        (explicit(Method::Verlet, 0.25), 1e-5, 2.5e-5, 5e-5),
        (explicit(Method::Rkn6, 0.5), 1e-5, 2e-5, 5e-5),
    ];
    for (integrator, linear, angular, energy) in cases {
        for (name, scene) in [("dumbbell", dumbbell(integrator)), ("bricks", three_bricks(integrator))] {
            let (p, l, e) = changes(scene);
            let case = format!("{name} {integrator:?}: {p:.1e} {l:.1e} {e:.1e}");
            assert!(p < linear && l < angular && e.abs() < energy, "{case}");
            assert!(integrator.method != Method::TrBdf2 || e < 0.0, "{case}");
        }
    }
}

/// The same scene turned in space, without gravity, runs the same to rounding: nothing in the equations knows the axes.
///
/// *Source.* Isotropy of space.
#[test]
fn a_turned_system_runs_the_same() {
    let integrator = Integrator::substeps(Method::Esdirk4, 4).unwrap();
    let mut random = Random::new(7);
    let mut straight = three_bricks(integrator);
    straight.run(1.0 / 60.0, 30);
    for _ in 0..3 {
        let turn = random.rotation();
        let mut turned = three_bricks(integrator);
        for cable in &mut turned.cables {
            let q = map3(cable.positions(), |x| turn * x);
            let v = map3(cable.velocities(), |x| turn * x);
            cable.set_coordinates(&q, &v).unwrap();
        }
        for body in &mut turned.bodies {
            body.position = turn * body.position;
            body.velocity = turn * body.velocity;
            body.angular_velocity = turn * body.angular_velocity;
            body.rotation = UnitQuaternion::from_rotation_matrix(&turn) * body.rotation;
        }
        turned.run(1.0 / 60.0, 30);
        for (a, b) in straight.bodies.iter().zip(&turned.bodies) {
            let off = (turn * a.position - b.position).norm();
            let spin = (turn * a.angular_velocity - b.angular_velocity).norm();
            assert!(off < 1e-11 && spin < 1e-9, "{off:.1e} m, {spin:.1e} rad/s");
        }
    }
}

/// A body whose velocity is changed from outside (an engine's collision, a user) takes its cable along, and the cable's mass holds
/// it back: what the system has after a step is what the change gave it, not more.
///
/// *Source.* Conservation of linear and angular momentum in an inelastic impact.
#[test]
fn a_struck_body_shares_its_momentum_with_its_cable() {
    let mut scene = three_bricks(Integrator::tolerance(Method::Esdirk4, 1e-8).unwrap());
    scene.run(1e-3, 1);
    scene.bodies[0].velocity += Vector3::new(3.0, 1.0, -2.0);
    scene.bodies[0].angular_velocity += Vector3::new(0.0, 2.0, 1.0);
    let (linear, angular) = scene.momentum();
    scene.run(1e-3, 1);
    let (after, turned) = scene.momentum();
    assert!((after - linear).norm() < 1e-9 * linear.norm(), "{linear} {after}");
    assert!((turned - angular).norm() < 1e-7 * angular.norm(), "{angular} {turned}");
}
