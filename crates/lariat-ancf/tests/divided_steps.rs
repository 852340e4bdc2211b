//! Steps of fixed length that fail: they are divided, and the work of a host step is bounded.

use lariat_ancf::{At, Cable, Error, Integrator, Method, Motion, Section, StepControl, StepFailure, Support, Vector3};

/// A stiff cable that hangs at rest, whose upper end is set in motion in no time.
fn struck(axial: f64, bending: f64, elements: usize, method: Method) -> Cable {
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(0.0, -2.0, 0.0)])
        .section(Section::from_stiffness(axial, bending, 0.2).unwrap())
        .elements(elements)
        .fix(At::Start)
        .integrator(Integrator { method, control: StepControl::Substeps(1) })
        .build()
        .unwrap();
    cable.equilibrium().unwrap();
    let position = Some(Motion::uniform(0.0, Vector3::zeros(), Vector3::new(1.5, 0.0, 0.5)));
    cable.set_support(At::Start, Support { position, ..Support::default() }).unwrap();
    cable
}

/// Methods without damping on stiff cables: a host step ends, or fails by name, after two failures of full depth in each of its regular steps, whatever
/// the cable; a method with damping takes the same steps.
///
/// *Source.* The bound: 172 tries with at most 20 iterations for each of the stages.
#[test]
fn a_method_that_cannot_take_the_steps_of_a_stiff_cable_says_so_after_bounded_work() {
    let mut refused = 0;
    for (axial, bending, elements) in [(1e6, 0.05, 10), (1e7, 0.05, 40), (1e8, 50.0, 10), (5e8, 1e3, 20)] {
        for method in [Method::Midpoint, Method::Trapezoid, Method::GeneralisedAlpha { rho: 0.9 }] {
            let mut cable = struck(axial, bending, elements, method);
            for _ in 0..30 {
                let before = *cable.diagnostics();
                let outcome = cable.step(1.0 / 240.0);
                let now = cable.diagnostics();
                let tries = now.steps + now.rejected_steps - before.steps - before.rejected_steps;
                assert!(tries <= 172 + 20, "{method:?} {axial:e}: {tries} tries");
                assert!(now.newton_iterations - before.newton_iterations <= 192 * 20 * 2);
                match outcome {
                    Ok(()) => {}
                    Err(Error::StepFailed { failure: failure @ StepFailure::Divided { .. }, .. }) => {
                        assert!(failure.to_string().contains("generalised-alpha-0"), "{failure}");
                        refused += 1;
                        break;
                    }
                    Err(Error::StepFailed { .. }) => break,
                    Err(other) => panic!("{other}"),
                }
            }
        }
        let mut damped = struck(axial, bending, elements, Method::GeneralisedAlpha { rho: 0.0 });
        (0..30).for_each(|_| damped.step(1.0 / 240.0).unwrap());
    }
    assert!(refused >= 3, "{refused}");
}
