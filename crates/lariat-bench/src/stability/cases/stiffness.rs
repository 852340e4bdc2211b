//! Young's modulus from 1e5 to 2.1e11 Pa, diameters from 1 to 50 mm, 2 to 200 elements: a load that
//! swings from horizontal.
//!
//! The load is 1 kg, or less so that it stretches the cable by a fifth at most. EA L^2/EI = 16
//! L^2/d^2 is 1e8 for 2.5 m of 1 mm, of any material.

use super::prelude::*;

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (young, millimetres, elements, length) in [
        (1e5, 1.0, 10, 2.5),
        (1e5, 50.0, 10, 2.0),
        (1e7, 10.0, 50, 2.0),
        (1e9, 1.0, 2, 2.5),
        (2.1e11, 1.0, 10, 2.5),
        (2.1e11, 1.0, 50, 2.5),
        (2.1e11, 50.0, 2, 2.0),
        (2.1e11, 50.0, 10, 2.0),
        (2.1e11, 10.0, 200, 2.0),
    ] {
        let name = format!("E {young:.0e} Pa, {millimetres} mm, {elements} elements");
        let swinging = case(Family::Stiffness, name, 0.5, move |w| {
            let density = if young < 1e8 { 1000.0 } else { 7850.0 };
            let section = Section::round(1e-3 * millimetres, young, density)?;
            let ea = section.axial_stiffness;
            let mass = (0.2 * ea / G).min(1.0);
            let load = w.ball(mass, 0.05, [length, 0.0, 0.0]);
            let rope = straight([0.0; 3], [length, 0.0, 0.0], section).elements(elements);
            w.rope(rope, End::Fixed, End::On(load, [0.0; 3]))?;
            Ok(Script::new().checks(move |w| {
                let total = mass + section.mass_per_length * length;
                let most = green_stretch(6.0 * G * total / ea) - 1.0;
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
