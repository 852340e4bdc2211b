//! A load falls 1 m on a slack rope of 2 m, which then stops it.

use super::prelude::*;

const LENGTH: f64 = 2.0;
const FALL: f64 = 1.0;
const MASS: f64 = 10.0;

/// Returns the largest force in N on a load that fell 1 m, for a massless spring by Green's law:
/// Runge-Kutta steps of 1e-6 s.
fn massless_peak(ea: f64) -> f64 {
    let pull = |x: f64| {
        let f = x / LENGTH;
        if f > 1.0 { 0.5 * ea * (f * f - 1.0) * f } else { 0.0 }
    };
    let (mut x, mut v, h) = (LENGTH, (2.0 * G * FALL).sqrt(), 1e-6);
    let mut peak = 0.0f64;
    while v > 0.0 {
        let a = |x: f64| G - pull(x) / MASS;
        let (k1, l1) = (v, a(x));
        let (k2, l2) = (v + 0.5 * h * l1, a(x + 0.5 * h * k1));
        let (k3, l3) = (v + 0.5 * h * l2, a(x + 0.5 * h * k2));
        let (k4, l4) = (v + h * l3, a(x + h * k3));
        x += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        v += h / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
        peak = peak.max(pull(x));
    }
    peak
}

pub fn cases() -> Vec<Case> {
    // EA = 1e4 N: a bungee of 1 cm whose half period of 140 ms every host resolves
    let bungee = Section::from_stiffness(1e4, 0.05, 0.1).expect("a section");
    let mut cases = Vec::new();
    for (name, section) in [("bungee", bungee), ("soft rope", polymer_rope()), ("steel wire", steel_wire())] {
        let falling = case(Family::Snatch, name, 1.0, move |w| {
            let load = w.ball(MASS, 0.05, [0.0, FALL - LENGTH, 0.0]);
            let rope = straight([0.0; 3], [0.0, FALL - LENGTH, 0.0], section).length(LENGTH);
            w.rope(rope, End::Fixed, End::On(load, [0.0; 3]))?;
            Ok(Script::new().checks(move |w| {
                let ea = section.axial_stiffness;
                let v = (2.0 * G * FALL).sqrt();
                let (k, own) = (ea / LENGTH, section.mass_per_length * LENGTH);
                // the load on a spring, twice the wave in the rope's own mass, and Green's law,
                // stiffer by 3/2 of the strain
                let simple = MASS * G + ((MASS * G).powi(2) + k * MASS * v * v).sqrt();
                let most = (simple + 2.0 * v * (k * own).sqrt()) * (1.0 + 1.5 * simple / ea);
                let peak = w.monitor.peak_force[0];
                let mut readings = vec![Check::at_most(
                    "peak pull, N",
                    peak,
                    most,
                    "m g + sqrt((m g)^2 + k m v^2), twice the wave v sqrt(k m') of the rope, Green's law",
                )];
                // a peak is resolved if a host step is a small part of half a period
                let half = std::f64::consts::PI * (MASS / k).sqrt();
                if w.dt() < 0.1 * half {
                    let fine = massless_peak(ea);
                    readings.push(Check::near(
                        "peak pull, N",
                        peak,
                        fine,
                        0.15,
                        "a fine run of the load on a massless rope; 15 % for the rope's own mass",
                    ));
                }
                readings
            }))
        });
        cases.push(falling);
    }
    cases
}
