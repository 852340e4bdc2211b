//! Ropes without bending stiffness, slack and weightless: nothing moves. Then gravity, tension and a load at once.

use super::stage::{Case, End, Play, case, to};
use super::{G, green_stretch};
use crate::stability::Family::Limp;
use crate::stability::outcome::Reading;
use lariat_ancf::{Cable, Fidelity, Section, Vector3};

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, ei) in [("limp", 0.0), ("hardly bending", 1e-6)] {
        let section = Section::from_stiffness(1e5, ei, 0.1).expect("a section");
        let zigzag = || [[0.0, 0.0, 0.0], [0.5, 0.1, 0.0], [1.0, 0.0, 0.0]].map(Vector3::from);
        let still = case(Limp, format!("{name}, slack and weightless, stays"), 1.0, move |s| {
            s.weightless();
            let rope = Cable::builder().points([Vector3::zeros(), Vector3::x()]).section(section);
            s.rope(rope.gravity(Vector3::zeros()), End::Fixed, End::Free)?;
            Ok(Play::idle().judging(|s| {
                let moved = s.cable(0).map_or(f64::NAN, |c| {
                    let node = |k: usize| (c.node_position(k) - Vector3::x() * 0.1 * k as f64).norm();
                    (0..c.nodes()).map(node).fold(0.0, f64::max)
                });
                vec![Reading::at_most("moved, m", moved, 1e-9, "no force acts")]
            }))
        });
        cases.push(still.energy(1e-3, 1e-3));
        let at_once = case(Limp, format!("{name}, then gravity and a load"), 1.0, move |s| {
            s.weightless();
            let load = s.ball(5.0, 0.05, [1.0, 0.0, 0.0]);
            let rope =
                Cable::builder().points(zigzag()).length(1.3).section(section).elements(12).fidelity(Fidelity::Game);
            s.rope(rope, End::Fixed, End::On(load, [0.0; 3]))?;
            Ok(Play::idle()
                .acting(|s| {
                    if (s.time - 0.3).abs() < 0.5 * s.dt() {
                        s.world.gravity = to([0.0, -G, 0.0]);
                        s.rebase();
                    }
                    Ok(())
                })
                .judging(|s| {
                    // falls at most 1.3 m: v^2 = 2 g h; the snatch of a spring, Green's law, twice for the wave
                    let (k, m) = (1e5 / 1.3, 5.0);
                    let v2 = 2.0 * G * 1.3;
                    let pull = m * G + ((m * G).powi(2) + k * m * v2).sqrt();
                    let most = green_stretch(2.0 * pull / 1e5) - 1.0;
                    vec![Reading::at_most("stretch", s.trace.stretch, most, "snatch of a spring, twice for the wave")]
                }))
        });
        cases.push(at_once.energy(0.01, f64::INFINITY).may_refuse());
    }
    cases
}
