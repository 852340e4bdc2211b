//! Accuracy, momenta and cost of smooth motions.

use crate::common::{EXACT_IN_TIME, pendulum, rule, soft_cable, tip};
use crate::law::energies;
use lariat_ancf::{Cable, Damping, Integrator, Method, StepControl, Vector3};

fn steps(longest: f64) -> Integrator {
    Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(longest) }
}

/// The falling pendulum in 2 s, against its own mesh exact in time: what a step of 1/240 s and half of it err, one iteration each.
///
/// *Source.* The symplectic method of order 6. The bounds are what was measured, 5.9e-3 and 1.8e-3 m, and 10 %.
#[test]
fn the_pendulum_errs_by_millimetres_at_one_iteration_per_step() {
    for name in ["projected-3", "projected-T1", "ST2"] {
        let path = |integrator: Integrator| {
            let mut cable = pendulum(10).rule(rule(name)).integrator(integrator).build().unwrap();
            let path: Vec<Vector3<f64>> = (0..120)
                .map(|_| {
                    cable.step(1.0 / 60.0).unwrap();
                    tip(&cable)
                })
                .collect();
            (path, *cable.diagnostics())
        };
        let (exact, _) = path(EXACT_IN_TIME);
        for (h, bound) in [(1.0 / 240.0, 6.5e-3), (1.0 / 480.0, 2.1e-3)] {
            let (ours, d) = path(steps(h));
            let error = ours.iter().zip(&exact).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
            println!(
                "{name}, h = 1/{:.0}: {error:.2e} m, {} iterations in {} steps",
                1.0 / h,
                d.newton_iterations,
                d.steps
            );
            assert!(error < bound, "{name}, {h}: {error:e}");
            assert!(d.newton_iterations as f64 <= 1.05 * d.steps as f64, "{name}: {d:?}");
        }
    }
}

/// A minute of the undamped pendulum costs as much per second at its end as at its beginning, and its energy only falls.
///
/// *Source.* The method has no step control. A step takes at most four solves for its forces, to 1 %; a third of all may take a second one.
#[test]
fn a_minute_of_the_undamped_pendulum_has_constant_cost_and_falling_energy() {
    let mut cable = pendulum(10).integrator(steps(1.0 / 240.0)).build().unwrap();
    let mut last = energies(&cable)[0];
    let mut worst_second = 0;
    for second in 0..60 {
        let before = *cable.diagnostics();
        for _ in 0..60 {
            cable.step(1.0 / 60.0).unwrap();
            let [energy, scale] = energies(&cable);
            assert!(energy <= last + 1e-8 * scale, "second {second}: {last} {energy}");
            last = energy;
        }
        worst_second = worst_second.max(cable.diagnostics().since(&before).newton_iterations);
    }
    let d = cable.diagnostics();
    println!("{d:?}, worst second {worst_second}");
    assert_eq!(d.steps, 14_400);
    assert!(d.newton_iterations <= 14_400 * 4 / 3 && worst_second <= 3 * 240, "{worst_second}: {d:?}");
    assert!(d.factorisations <= 14_400 + 288, "{d:?}");
    assert_eq!((d.rescaled_steps, d.split_steps), (0, 0));
}

/// Linear and angular momentum of a thrown cable are constant to rounding.
///
/// *Source.* The forces sum to zero and have no moment about the mean configuration; what the dissipation takes is restored.
#[test]
fn a_thrown_cable_keeps_its_momentum() {
    let mut cable: Cable = soft_cable()
        .gravity(Vector3::zeros())
        .velocity(Vector3::new(0.2, 0.1, -0.4))
        .angular_velocity(Vector3::new(0.5, -1.0, 2.0))
        .integrator(steps(1.0 / 240.0))
        .build()
        .unwrap();
    let before = cable.momentum();
    for _ in 0..120 {
        cable.step(1.0 / 60.0).unwrap();
    }
    let after = cable.momentum();
    let linear = (after.linear - before.linear).norm() / before.linear.norm();
    let angular = (after.angular - before.angular).norm() / before.angular.norm();
    println!("linear momentum off by {linear:.1e}, angular by {angular:.1e}");
    assert!(linear < 1e-13 && angular < 1e-12, "{linear:e} {angular:e}");
}

/// Internal damping takes as much energy from a bent and a stretched cable as with an accurate integrator.
///
/// *Source.* Error-controlled ESDIRK4. The bound is the error of the step.
#[test]
fn damping_takes_the_energy_that_it_takes_with_an_accurate_integrator() {
    let lost = |integrator: Integrator| {
        let mut cable = soft_cable()
            .gravity(Vector3::zeros())
            .effects(lariat_ancf::Effects {
                damping: Some(Damping { axial: 0.02, bending: 0.05 }),
                ..Default::default()
            })
            .integrator(integrator)
            .build()
            .unwrap();
        cable.step(0.5).unwrap();
        cable.effect_work().damping
    };
    let exact = lost(Integrator::tolerance(Method::Esdirk4, 1e-9).unwrap());
    let (coarse, fine) = (lost(steps(1.0 / 480.0)), lost(steps(1.0 / 960.0)));
    println!("work of damping {exact:.6e} J, with steps {coarse:.6e}, {fine:.6e}");
    assert!((coarse / exact - 1.0).abs() < 2e-2 && (fine / exact - 1.0).abs() < 6e-3);
}
