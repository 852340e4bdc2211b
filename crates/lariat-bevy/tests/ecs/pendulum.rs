//! The falling pendulum of Bulin & Hajzman through the ECS.

use super::common::{bits, cable_of, pin, steps, world};
use lariat_bevy::lariat_ancf::{self, At, Section, Vector3};
use lariat_bevy::{Bending, Cable, Cables, Diagnostics, Physics, Rule};

fn section() -> Section {
    Section::square(0.01, 1.0e8, 4000.0).unwrap()
}

/// 2 s at 1/60 s, with one Rapier step in a host step.
///
/// *Source.* The mechanics alone, with the same host steps.
#[test]
fn the_pendulum_is_bitwise_that_of_the_mechanics_alone() {
    let mut world = world();
    let mut cables = world.resource_mut::<Cables>();
    let settings = lariat_bevy::Settings { rapier_steps: 1, ..cables.settings() };
    cables.set_settings(settings);
    let cable = Cable::new(section()).between([0.0, 0.0, 0.0], [2.0, 0.0, 0.0]);
    let cable = world.spawn((cable, Rule::G5_3, Bending)).id();
    world.spawn(pin(cable));
    let mut core = lariat_ancf::Cable::builder()
        .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(section())
        .rule(Rule::G5_3.0)
        .fidelity(lariat_ancf::Fidelity::Game)
        .fix(At::Start)
        .build()
        .unwrap();
    let dt = f64::from(world.resource::<Physics>().integration_parameters.dt);
    for _ in 0..120 {
        steps(&mut world, 1);
        core.step(dt).unwrap();
    }
    let own: Vec<u64> = core.positions().iter().chain(core.velocities()).map(|x| x.to_bits()).collect();
    assert!(own == bits(&world, cable));
    let counted = world.resource::<Diagnostics>();
    assert_eq!(counted.cables.newton_iterations, core.diagnostics().newton_iterations);
    // all elements once more per step, for the force at the pin
    let evaluations = core.diagnostics().element_evaluations() + 120 * 10;
    assert_eq!(counted.elements_by_rule, vec![(Rule::G5_3.0, evaluations)]);
}

/// The tip after 0.5 s, with four Rapier steps in a host step and the default rule.
///
/// *Source.* A converged solution of the beam, assets/reference/pendulum_converged_tip.csv:
/// (1.3108, -1.2034) m, 10 elements of the default rule are within 2.4e-3 m.
#[test]
fn the_pendulum_follows_the_reference_beam() {
    let mut world = world();
    let cable = Cable::new(section()).between([0.0, 0.0, 0.0], [2.0, 0.0, 0.0]);
    let cable = world.spawn((cable, Bending)).id();
    world.spawn(pin(cable));
    steps(&mut world, 30);
    let tip = cable_of(&world, cable).sample(2.0).unwrap().position;
    assert!((tip - Vector3::new(1.3108, -1.2034, 0.0)).norm() < 3e-3, "{tip}");
}
