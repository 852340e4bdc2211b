//! What the dearest host steps cost.

use crate::bench::{RADIUS, rope, run, up, with};
use lariat_ancf::contact::{Cylinder, Obstacle, RigidMotion};
use lariat_ancf::{Contact, Damping, Vector3};
use nalgebra::UnitQuaternion;
use std::f64::consts::FRAC_PI_2;

/// Damping of bending makes impacts no dearer: of ropes that fall over a thin rod in different directions, the dearest host steps take no more Newton
/// iterations than those of the same ropes without it, in the mean of their logarithms, and less than twice as many in any.
///
/// *Source.* The same ropes without damping of bending, by counts. Without the stiffness of the damping across the curvature in the tangent, damped ropes
/// took up to 40 times as many.
#[test]
fn damping_of_bending_makes_impacts_no_dearer() {
    let (mut sum, mut count, mut most) = (0.0, 0.0, 0.0f64);
    for seed in 0..6 {
        let turn = f64::from(seed);
        let along = Vector3::new(1.0, 0.1 * (1.7 * turn).sin(), 0.4 * (2.3 * turn).sin()).normalize();
        let middle = Vector3::new(0.1 * (0.9 * turn).sin(), 0.15, 0.0);
        let dearest = [0.0, 0.01, 0.1].map(|bending| {
            let cable = rope(1e-2, &[middle - along * 0.5, middle + along * 0.5], 20);
            let cable = cable.damping(Damping { axial: 1e-3, bending }).build().unwrap();
            let rotation = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2);
            let lying = RigidMotion { rotation, ..RigidMotion::default() };
            let rod = Obstacle::new(1, Cylinder { half_height: 1.0, radius: 2e-3 }, up() * 0.0, 0.5).moving(lying);
            let mut cable = with(cable, vec![rod]);
            cable.set_contact(Contact::with_friction(0.5).with_radius(RADIUS)).unwrap();
            let (mut before, mut dearest) = (0, 0);
            let made = run(&mut cable, 60, |cable| {
                let now = cable.diagnostics().newton_iterations;
                dearest = dearest.max(now - before);
                before = now;
            });
            assert!(made < 1e-8, "seed {seed}, {bending} s: {made:e}");
            dearest as f64
        });
        println!("seed {seed}: {dearest:?}");
        for damped in [dearest[1], dearest[2]] {
            (sum, count) = (sum + (damped / dearest[0]).ln(), count + 1.0);
            most = most.max(damped / dearest[0]);
        }
    }
    println!("mean {:.2}, most {most:.2}", f64::exp(sum / count));
    assert!(sum < 0.0 && most < 2.0, "{sum} {most}");
}
