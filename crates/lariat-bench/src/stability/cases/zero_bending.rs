//! Ropes without bending stiffness, slack and weightless: nothing moves. Then gravity and a load
//! act at once.

use super::prelude::*;

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, ei) in [("no bending stiffness", 0.0), ("EI 1e-6 N m^2", 1e-6)] {
        let section = Section::from_stiffness(1e5, ei, 0.1).expect("a section");
        let zigzag = || [[0.0, 0.0, 0.0], [0.5, 0.1, 0.0], [1.0, 0.0, 0.0]].map(Vector3::from);
        let still = case(Family::ZeroBending, format!("{name}, slack and weightless, stays at rest"), 1.0, move |w| {
            w.remove_gravity();
            let rope = Cable::builder()
                .points([Vector3::zeros(), Vector3::x()])
                .section(section)
                .fidelity(Fidelity::Engineering);
            w.rope(rope.gravity(Vector3::zeros()), End::Fixed, End::Free)?;
            Ok(Script::new().checks(|w| {
                let moved = w.cable(0).map_or(f64::NAN, |c| {
                    let node = |k: usize| (c.node_position(k) - Vector3::x() * 0.1 * k as f64).norm();
                    (0..c.nodes()).map(node).fold(0.0, f64::max)
                });
                vec![Check::at_most("displacement, m", moved, 1e-9, "no force acts")]
            }))
        });
        cases.push(still.energy(1e-3, 1e-3));
        let at_once = case(Family::ZeroBending, format!("{name}, then gravity and a load"), 1.0, move |w| {
            w.remove_gravity();
            let load = w.ball(5.0, 0.05, [1.0, 0.0, 0.0]);
            let rope =
                Cable::builder().points(zigzag()).length(1.3).section(section).elements(12).fidelity(Fidelity::Game);
            w.rope(rope, End::Fixed, End::On(load, [0.0; 3]))?;
            Ok(Script::new()
                .before_step(|w| {
                    if (w.time - 0.3).abs() < 0.5 * w.dt() {
                        w.physics.gravity = to_rapier([0.0, -G, 0.0]);
                        w.restart_balance();
                    }
                    Ok(())
                })
                .checks(|w| {
                    // a fall of at most 1.3 m, v^2 = 2 g h; the peak force of a spring, twice that
                    // for the wave, Green's law
                    let (k, m) = (1e5 / 1.3, 5.0);
                    let v2 = 2.0 * G * 1.3;
                    let pull = m * G + ((m * G).powi(2) + k * m * v2).sqrt();
                    let most = green_stretch(2.0 * pull / 1e5) - 1.0;
                    vec![Check::at_most(
                        "stretch",
                        w.monitor.stretch,
                        most,
                        "peak of a spring, twice that for the wave",
                    )]
                }))
        });
        // The rope is laid along a polyline shorter than itself, and so begins with strain energy,
        // all of which generalised-alpha 0.5 at 1/240 s may damp; no more than that can be lost.

        cases.push(at_once.energy(0.01, 1.0).may_fail());
    }
    cases
}
