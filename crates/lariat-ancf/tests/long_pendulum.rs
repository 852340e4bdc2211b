//! An undamped pendulum swings for minutes at host steps of any length.

use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::{Island, PinConstraint, RigidBody};
use lariat_ancf::{At, Cable, Fidelity, Integrator, Section, Vector3};
use nalgebra::Matrix3;

/// Ten minutes, or in the quick set as many seconds, of a body of 1 kg on a rope of 1 m without
/// damping, released at 60 degrees, at eleven host steps from 1/240 to 1/20 s that are no multiples
/// of each other: no step fails, and the energy stays within 1 % of that of the swing.
///
/// *Source.* Conservation of energy.
#[test]
fn a_pendulum_keeps_its_energy_at_any_host_step() {
    let long = std::env::var_os("LARIAT_LONG_TESTS").is_some();
    let time = if long { 600.0 } else { 10.0 };
    for fidelity in [Fidelity::Game, Fidelity::Engineering, Integrator::ADAPTIVE.into()] {
        for i in 0..11 {
            // evenly spread in the logarithm
            let dt = 12f64.powf(f64::from(i) / 10.0) / 240.0;
            let (sin, cos) = (60f64.to_radians().sin(), 60f64.to_radians().cos());
            let end = Vector3::new(sin, -cos, 0.0);
            let mut rope = Cable::builder()
                .points([Vector3::zeros(), end])
                .section(Section::from_stiffness(1e5, 0.01, 0.05).unwrap())
                .elements(4)
                .fidelity(fidelity)
                .fix(At::Start)
                .build()
                .unwrap();
            let node = rope.attach(At::End).unwrap();
            let mut body = RigidBody::new(1.0, Matrix3::identity() * 1e-3, end).unwrap();
            body.force = Vector3::new(0.0, -9.81, 0.0);
            let pin = PinConstraint { cable: 0, node, body: 0, anchor: Vector3::zeros(), direction: None };
            let (mut bodies, mut island, integrator) = ([body], Island::default(), rope.integrator());
            let energy = |rope: &Cable, body: &RigidBody| {
                rope.energy().total() + rope.energy_in_store() + body.kinetic_energy() + body.energy_in_store()
                    - body.force.dot(&body.position)
            };
            let start = energy(&rope, &bodies[0]);
            // what falls by half a metre
            let swing = 9.81 * (1.0 + 0.5 * 0.05) * (1.0 - cos);
            let (mut made, mut lost) = (0.0f64, 0.0f64);
            for _ in 0..(time / dt) as usize {
                let outcome = island.step(&mut [&mut rope], &mut bodies, &[pin], integrator, dt);
                outcome.unwrap_or_else(|e| panic!("{fidelity:?} at {dt} s: {e}"));
                let change = energy(&rope, &bodies[0]) - start;
                (made, lost) = (made.max(change / swing), lost.max(-change / swing));
            }
            let case = format!("{fidelity:?} at 1/{:.1} s: made {made:.1e}, lost {lost:.1e}", 1.0 / dt);
            println!("{case}, {} iterations", rope.diagnostics().newton_iterations);
            assert!(made < 0.01 && lost < 0.01, "{case}");
        }
    }
}
