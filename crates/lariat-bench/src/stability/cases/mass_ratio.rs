//! Loads from a hundredth to a hundred thousand times the mass of their cable, a steel wire of 2 m and 3 mm.

use super::stage::{Case, End, Play, case, line, wire};
use super::{G, green_stretch};
use crate::stability::Family::MassRatio;
use crate::stability::outcome::Reading;

const LENGTH: f64 = 2.0;

pub fn cases() -> Vec<Case> {
    let own = wire().mass_per_length * LENGTH;
    let mut cases = Vec::new();
    for ratio in [1e-2, 1.0, 1e2, 1e4, 1e5] {
        let mass = ratio * own;
        // hung in at the stretch of its middle: the load and what hangs below it
        let hanging = case(MassRatio, format!("hanging {ratio:.0e}"), 1.0, move |s| {
            let f = green_stretch(G * (mass + 0.5 * own) / wire().axial_stiffness);
            let load = s.ball(mass, 0.05, [0.0, -LENGTH * f, 0.0]);
            let rope = line([0.0; 3], [0.0, -LENGTH * f, 0.0], wire()).length(LENGTH);
            s.rope(rope, End::Fixed, End::On(load, [0.0; 3]))?;
            Ok(Play::idle().judging(move |s| {
                let pull = s.mean_force(0).y / (mass * G);
                vec![
                    Reading::between("mean pull over weight", pull, (0.98, 1.02), "statics"),
                    Reading::at_most("sag from equilibrium, m", (s.stretch(0) - (f - 1.0)).abs(), 1e-4, "Green's law"),
                ]
            }))
        });
        cases.push(hanging.energy(0.01, 0.02));
        // let go from horizontal: through the lowest point after 0.84 s
        let swinging = case(MassRatio, format!("swinging {ratio:.0e}"), 1.0, move |s| {
            let load = s.ball(mass, 0.05, [LENGTH, 0.0, 0.0]);
            s.rope(line([0.0; 3], [LENGTH, 0.0, 0.0], wire()), End::Fixed, End::On(load, [0.0; 3]))?;
            Ok(Play::idle().judging(move |s| {
                // three weights at the lowest point, twice that if it rings, Green's law
                let most = green_stretch(6.0 * G * (mass + own) / wire().axial_stiffness) - 1.0;
                vec![Reading::at_most(
                    "stretch",
                    s.trace.stretch,
                    most + 1e-4,
                    "pendulum: 3 weights, twice if it rings",
                )]
            }))
        });
        cases.push(swinging.energy(0.01, 0.02));
    }
    cases
}
