//! Random drums that take in slack rope, run free and stop: no step fails.

use super::common::G;
use super::random::Random;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::{Drum, Island, PinConstraint, RigidBody, Wheels};
use lariat_ancf::{At, Cable, Damping, Error, Integrator, Method, Reel, Section, StepControl, Vector3};
use nalgebra::Matrix3;

const GAME: Integrator = Integrator { method: Method::DiscreteGradient, control: StepControl::Substeps(1) };

/// Random loads hang by a rope, slack by up to 30 %, from drums that spin or are torqued: no step fails, but for those by which more than the half of an
/// element would pass, which are refused by that name.
///
/// *Source.* Random draws over drum inertia, radius and torque, EA, mass, slack, rate, step and mesh; the refusal is checked against the rate.
#[test]
fn random_drums_take_in_slack_rope_without_failing() {
    let (mut refused, count) = (0, 80);
    for seed in 0..count {
        let mut n = Random::new(seed);
        let (stiffness, density) = (n.log(1e3, 1e6), n.log(0.02, 1.0));
        let (load, wheel, radius) = (n.log(0.1, 100.0), n.log(1e-3, 100.0), n.log(0.05, 0.5));
        let slack = n.between(-0.01, 0.3);
        let dt = 1.0 / n.log(30.0, 240.0);
        let rate = n.between(-3.0, 2.0);
        let elements = 3 + n.between(0.0, 8.0) as usize;
        // a torque that does not move half of an element in a step
        let most = 0.2 * 1.2 / elements as f64 / (dt * dt) * wheel;
        let pull = (n.between(-2.0, 0.5) * load * G).clamp(-most, most);
        let damping = if n.between(0.0, 1.0) < 0.5 { 0.0 } else { 5e-3 };
        let stock = n.between(1.3, 6.0);
        let length = 1.2;
        let drop = length * (1.0 - slack);
        let middle = Vector3::new(0.5 * (length * length - drop * drop).max(0.0).sqrt(), -0.5 * drop, 0.0);
        let mut cable = Cable::builder()
            .points([Vector3::new(0.0, -drop, 0.0), middle, Vector3::zeros()])
            .length(length)
            .section(Section::from_stiffness(stiffness, 1e-3, density).unwrap())
            .elements(elements)
            .gravity(Vector3::new(0.0, -G, 0.0))
            .damping(Damping { axial: damping, bending: damping })
            .integrator(GAME)
            .fix(At::End)
            .build()
            .unwrap();
        cable.add_reel(At::End, Reel { stock: Some(stock), ..Reel::on_drum() }).unwrap();
        cable.attach(At::Start).unwrap();
        let mut bodies = vec![
            RigidBody::new(load, Matrix3::identity() * 0.02 * load, Vector3::new(0.0, -drop, 0.0)).unwrap(),
            RigidBody::new(5.0, Matrix3::identity() * wheel * radius * radius, Vector3::zeros()).unwrap(),
        ];
        bodies[0].force = Vector3::new(0.0, -G * load, 0.0);
        bodies[1].torque = Vector3::new(0.0, 0.0, pull * radius);
        bodies[1].angular_velocity = Vector3::new(0.0, 0.0, rate / radius);
        bodies[1].free = [false, false, false, false, false, true];
        let mut pin = PinConstraint { cable: 0, node: 0, body: 0, anchor: Vector3::zeros(), direction: None };
        let drum = Drum { cable: (0, false), body: 1, axis: Vector3::z(), radius };
        let mut island = Island::default();
        let steps = (2.0 / dt) as usize;
        for step in 0..steps {
            cable.remesh_reel().unwrap();
            pin.node = 0;
            let outcome = island.step_with_wheels(
                &mut [&mut cable],
                &mut bodies,
                &[pin],
                Wheels { drums: &[drum], ..Wheels::default() },
                (&GAME).into(),
                dt,
            );
            if let Err(error) = outcome {
                let reel = cable.reel(At::End).unwrap();
                let passing = reel.rate.abs() * dt / (1.2 / elements as f64);
                let by_name = matches!(&error, Error::FastReel { .. });
                assert!(by_name && passing > 0.1, "seed {seed}, step {step}: {error}, {reel:?}");
                refused += 1;
                break;
            }
        }
    }
    println!("{refused} of {count} too fast for their mesh and step");
    assert!(2 * refused < count, "{refused}");
}
