//! Loads from a hundredth to a hundred thousand times the mass of their cable, a steel wire of 2 m
//! and 3 mm.

use super::prelude::*;

const LENGTH: f64 = 2.0;

pub fn cases() -> Vec<Case> {
    let own = steel_wire().mass_per_length * LENGTH;
    let mut cases = Vec::new();
    for ratio in [1e-2, 1.0, 1e2, 1e4, 1e5] {
        let mass = ratio * own;
        // starts uniformly stretched as its middle is at rest, by the load and the lower half of
        // the cable
        let hanging = case(Family::MassRatio, format!("hanging {ratio:.0e}"), 1.0, move |w| {
            let f = green_stretch(G * (mass + 0.5 * own) / steel_wire().axial_stiffness);
            let load = w.ball(mass, 0.05, [0.0, -LENGTH * f, 0.0]);
            let rope = straight([0.0; 3], [0.0, -LENGTH * f, 0.0], steel_wire()).length(LENGTH);
            w.rope(rope, End::Fixed, End::On(load, [0.0; 3]))?;
            Ok(Script::new().checks(move |w| {
                let pull = w.monitor.mean_force(0).y / (mass * G);
                vec![
                    Check::between("mean pull over weight", pull, (0.98, 1.02), "statics"),
                    Check::at_most("stretch from equilibrium", (w.stretch(0) - (f - 1.0)).abs(), 1e-4, "Green's law"),
                ]
            }))
        });
        cases.push(hanging);
        // released from horizontal: passes the lowest point after 0.84 s
        let swinging = case(Family::MassRatio, format!("swinging {ratio:.0e}"), 1.0, move |w| {
            let load = w.ball(mass, 0.05, [LENGTH, 0.0, 0.0]);
            w.rope(straight([0.0; 3], [LENGTH, 0.0, 0.0], steel_wire()), End::Fixed, End::On(load, [0.0; 3]))?;
            Ok(Script::new().checks(move |w| {
                // three times the weight at the lowest point, twice that if it vibrates, Green's
                // law
                let most = green_stretch(6.0 * G * (mass + own) / steel_wire().axial_stiffness) - 1.0;
                vec![Check::at_most(
                    "stretch",
                    w.monitor.stretch,
                    most + 1e-4,
                    "pendulum: 3 times the weight, twice that if it vibrates",
                )]
            }))
        });
        cases.push(swinging);
    }
    cases
}
