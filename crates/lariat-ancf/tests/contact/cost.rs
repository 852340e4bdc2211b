//! What the dearest host steps cost.

use crate::bench::{GRAVITY, RADIUS, run, steps, up};
use crate::common::Random;
use lariat_ancf::contact::{Cylinder, HalfSpace, Obstacle, RigidMotion};
use lariat_ancf::{Cable, Contact, Damping, Section};
use nalgebra::UnitQuaternion;
use std::f64::consts::FRAC_PI_2;

/// Damping of bending makes impacts no dearer: of ropes that fall in any direction on a floor and a rod, the dearest host steps take no more Newton iterations than
/// those of the same ropes without it, in the mean of their logarithms, and no more than twice as many in any.
///
/// *Source.* The same ropes without damping of bending, by counts. With the rate of the scalar curvature alone in steps, damped ropes took up to 60 times as many.
#[test]
fn damping_of_bending_makes_impacts_no_dearer() {
    let (mut sum, mut count, mut most) = (0.0, 0.0, 0.0f64);
    for seed in 0..12 {
        let dearest = [0.0, 0.01, 0.1].map(|bending| {
            let mut random = Random::new(90_300 + seed);
            let mut unit = || 0.5 * (random.next() + 1.0);
            let along = nalgebra::Vector3::new(unit() - 0.5, unit() - 0.5, unit() - 0.5).normalize();
            let (elements, mass) = (12 + (unit() * 20.0) as usize, 0.05 + 0.2 * unit());
            let ei = 10f64.powf(-3.0 + 2.0 * unit());
            let middle = up() * (0.6 + 0.4 * unit());
            let cable = Cable::builder()
                .points([middle - 0.5 * along, middle + 0.5 * along])
                .section(Section::from_stiffness(1e5, ei, mass).unwrap())
                .elements(elements)
                .damping(Damping { axial: 1e-3, bending })
                .gravity(-GRAVITY * up())
                .integrator(steps(240.0));
            let turned = UnitQuaternion::from_axis_angle(&nalgebra::Vector3::x_axis(), FRAC_PI_2);
            let motion = RigidMotion { rotation: turned, ..RigidMotion::default() };
            let rod = Obstacle::new(1, Cylinder { half_height: 1.0, radius: 2e-3 }, up() * 0.0, 0.5).moving(motion);
            let mut cable = cable.build().unwrap();
            cable.set_contact(Contact::with_friction(0.5).with_radius(RADIUS)).unwrap();
            cable.set_obstacles(vec![rod, Obstacle::new(2, HalfSpace { normal: up() }, up() * -0.3, 0.5)]).unwrap();
            let (mut before, mut dearest) = (0, 0);
            let made = run(&mut cable, 60, |cable| {
                let now = cable.diagnostics().newton_iterations;
                (before, dearest) = (now, dearest.max(now - before));
            });
            assert!(made < 1e-9, "seed {seed}, {bending} s: {made:e}");
            dearest as f64
        });
        println!("seed {seed}: {dearest:?}");
        for damped in [dearest[1], dearest[2]] {
            (sum, count) = (sum + (damped / dearest[0]).ln(), count + 1.0);
            most = most.max(damped / dearest[0]);
        }
    }
    println!("mean {:.2}, most {most:.2}", f64::exp(sum / count));
    assert!(sum / count < 0.0 && most < 2.0, "{} {most}", f64::exp(sum / count));
}
