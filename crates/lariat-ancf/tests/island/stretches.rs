//! Cables on so many bodies that they are cut at their pins (`src/island/cuts.rs`).

use super::bench::{Scene, cube, soft};
use super::common::Random;
use lariat_ancf::island::RigidBody;
use lariat_ancf::{At, Cable, Integrator, Method, StepControl, Vector3};

const BODIES: usize = 15;

/// A ladder in space: two cables of 40 elements with 15 rungs of 0.5 kg, pinned off their axes, one
/// of them clamped, thrown apart and spinning.
fn ladder(integrator: Integrator) -> Scene {
    let mut random = Random::new(5);
    let place = |node: usize, z: f64| Vector3::new(0.1 * node as f64, 0.0, z);
    let cable = |z: f64| {
        Cable::builder()
            .points([place(0, z), place(40, z)])
            .section(soft())
            .elements(40)
            .gravity(Vector3::zeros())
            .build()
            .unwrap()
    };
    let node = |body: usize| 3 + 5 * body / 2;
    let mut bodies = Vec::new();
    for body in 0..BODIES {
        let mut rung = RigidBody::new(0.5, cube(0.5, 0.3), place(node(body), 0.0) + random.vector() * 0.02).unwrap();
        rung.velocity = random.vector() * 0.5;
        rung.angular_velocity = random.vector();
        bodies.push(rung);
    }
    let mut scene = Scene::new(vec![cable(-0.2), cable(0.2)], bodies, integrator);
    for body in 0..BODIES {
        for (c, z) in [(0, -0.2), (1, 0.2)] {
            let anchor = place(node(body), z) - scene.bodies[body].position;
            let at = At::Node(node(body));
            scene = if (body, c) == (7, 0) { scene.clamp(c, at, body, anchor) } else { scene.pin(c, at, body, anchor) };
        }
    }
    scene
}

/// The ladder keeps its momenta for 0.1 s, to the bounds of dumbbells and bricks (`momentum.rs`). Its
/// energy stays under the explicit method, which resolves the waves of the impact, and never rises
/// under the others, which damp them.
///
/// *Source.* Conservation laws. Changes are relative to the angular momentum and the energy after
/// the first step, in which the cables take the velocities of the bodies by an impact.
#[test]
fn a_ladder_in_space_keeps_momenta_and_energy() {
    let gradient = Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) };
    let cases = [
        (Integrator::default(), 1e-9, 1e-7, None),
        (gradient, 1e-12, 1e-6, None),
        (Integrator { method: Method::Rkn6, control: StepControl::Stable(0.5) }, 2e-5, 5e-5, Some(5e-5)),
    ];
    for (integrator, linear, angular, kept) in cases {
        let mut scene = ladder(integrator);
        scene.run(1.0 / 60.0, 1);
        let ((p0, l0), e0) = (scene.momentum(), scene.energy());
        scene.run(1.0 / 60.0, 6);
        let ((p, l), e) = (scene.momentum(), scene.energy());
        let [p, l, e] = [(p - p0).norm() / l0.norm(), (l - l0).norm() / l0.norm(), (e - e0) / e0];
        println!("{integrator:?}: {p:.1e} {l:.1e} {e:.1e}, gap {:.1e}", scene.gap());
        assert!(scene.gap() < 1e-12, "gap {:.1e}", scene.gap());
        let energy = kept.map_or(e < 1e-9, |kept| e.abs() < kept);
        assert!(p < linear && l < angular && energy, "{integrator:?}: {p:.1e} {l:.1e} {e:.1e}");
    }
}

/// Newton's iteration of the ladder converges as with an exact tangent: at most four iterations a
/// step, none of them through an indefinite matrix.
///
/// *Source.* The iteration is quadratic if each increment solves the linear equations.
#[test]
fn a_ladder_takes_few_iterations() {
    let gradient = Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) };
    let mut scene = ladder(gradient);
    scene.run(1.0 / 60.0, 30);
    for cable in &scene.cables {
        let d = cable.diagnostics();
        println!("{} iterations in {} steps", d.newton_iterations, d.steps);
        assert!(d.newton_iterations <= 4 * d.steps && d.indefinite_factorisations == 0, "{d:?}");
    }
}
