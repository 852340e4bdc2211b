//! Free rotation: Euler's equations within the island.

use super::bench::{Scene, soft};
use lariat_ancf::island::RigidBody;
use lariat_ancf::{At, Cable, Integrator, Method, Vector3};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion};

const INERTIA: Vector3<f64> = Vector3::new(0.02, 0.05, 0.06);

fn brick(spin: Vector3<f64>) -> RigidBody {
    let mut body = RigidBody::new(3.0, Matrix3::from_diagonal(&INERTIA), Vector3::zeros()).unwrap();
    body.rotation = UnitQuaternion::from_euler_angles(0.3, -0.5, 1.1);
    body.angular_velocity = spin;
    body
}

/// Returns attitude (body to world) and world angular velocity after `duration` (s) of torque-free
/// motion: Euler's equations in body axes and the quaternion's rate, classical Runge-Kutta of order
/// 4, 20 000 steps.
fn euler(body: &RigidBody, torque: Vector3<f64>, duration: f64) -> (UnitQuaternion<f64>, Vector3<f64>) {
    let h = duration / 2e4;
    let rate = |q: Quaternion<f64>, w: Vector3<f64>| {
        let local = UnitQuaternion::from_quaternion(q).inverse() * torque;
        let acceleration = (local - w.cross(&INERTIA.component_mul(&w))).component_div(&INERTIA);
        (q * Quaternion::from_imag(w) * 0.5, acceleration)
    };
    let (mut q, mut w) = (body.rotation.into_inner(), body.rotation.inverse() * body.angular_velocity);
    for _ in 0..20_000 {
        let k1 = rate(q, w);
        let k2 = rate(q + k1.0 * (0.5 * h), w + k1.1 * (0.5 * h));
        let k3 = rate(q + k2.0 * (0.5 * h), w + k2.1 * (0.5 * h));
        let k4 = rate(q + k3.0 * h, w + k3.1 * h);
        q += (k1.0 + (k2.0 + k3.0) * 2.0 + k4.0) * (h / 6.0);
        w += (k1.1 + (k2.1 + k3.1) * 2.0 + k4.1) * (h / 6.0);
    }
    let attitude = UnitQuaternion::from_quaternion(q);
    (attitude, attitude * w)
}

/// Returns a scene with a cable pinned at the body's centre of mass, which exerts no moment.
fn pinned_at_centre(body: RigidBody, integrator: Integrator) -> Scene {
    let cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(0.6, 0.3, 0.0)])
        .section(soft())
        .elements(4)
        .build()
        .unwrap();
    Scene::new(vec![cable], vec![body], integrator).pin(0, At::Start, 0, Vector3::zeros())
}

/// A brick with three different principal inertias rotates about each of its axes with a
/// disturbance; about the intermediate one it flips over. A falling and swinging cable is pinned at
/// its centre of mass. Attitude and angular velocity after 2 s at 1/60 s are those of Euler's
/// equations.
///
/// *Source.* Euler's equations, integrated in body axes with quaternions by another method, with no
/// shared code.
#[test]
fn a_tumbling_brick_satisfies_eulers_equations() {
    let integrator = Integrator::tolerance(Method::Esdirk4, 1e-8).unwrap();
    for axis in 0..3 {
        let mut spin = Vector3::new(0.02, -0.03, 0.04);
        spin[axis] = 6.0;
        let mut body = brick(Vector3::zeros());
        body.angular_velocity = body.rotation * spin;
        let (attitude, velocity) = euler(&body, Vector3::zeros(), 2.0);
        let mut scene = pinned_at_centre(body, integrator);
        scene.run(1.0 / 60.0, 120);
        let after = &scene.bodies[0];
        assert!(after.rotation.angle_to(&attitude) < 1e-11, "axis {axis}: {:.1e}", after.rotation.angle_to(&attitude));
        assert!((after.angular_velocity - velocity).norm() < 1e-11, "axis {axis}");
    }
}

/// A constant torque in world axes acts in addition to the gyroscopic one.
///
/// *Source.* As above.
#[test]
fn a_brick_under_a_torque_satisfies_eulers_equations() {
    let torque = Vector3::new(0.05, -0.02, 0.03);
    let mut body = brick(Vector3::new(1.0, 2.0, -1.5));
    body.torque = torque;
    let (attitude, velocity) = euler(&body, torque, 2.0);
    let mut scene = pinned_at_centre(body, Integrator::tolerance(Method::Esdirk4, 1e-8).unwrap());
    scene.run(1.0 / 60.0, 120);
    let after = &scene.bodies[0];
    assert!(after.rotation.angle_to(&attitude) < 1e-11, "{:.1e} rad", after.rotation.angle_to(&attitude));
    assert!((after.angular_velocity - velocity).norm() < 1e-11);
}

/// Without the gyroscopic torque, which some engines omit, a free body keeps its angular velocity.
///
/// *Source.* I omega' = 0.
#[test]
fn without_the_gyroscopic_torque_the_spin_is_constant() {
    let mut body = brick(Vector3::new(1.0, 2.0, -1.5));
    body.gyroscopic = false;
    let spin = body.angular_velocity;
    let mut scene = pinned_at_centre(body, Integrator::default());
    scene.run(1.0 / 60.0, 60);
    assert!((scene.bodies[0].angular_velocity - spin).norm() < 1e-14);
}
