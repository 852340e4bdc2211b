//! A load falls 1 m on a slack rope of 2 m, which snatches it.

use super::G;
use super::stage::{Case, End, Play, case, line, soft, wire};
use crate::stability::Family::Snatch;
use crate::stability::outcome::Reading;
use lariat_ancf::Section;

const LENGTH: f64 = 2.0;
const FALL: f64 = 1.0;
const MASS: f64 = 10.0;

/// Greatest pull on a load that fell 1 m, of a spring without mass by Green's law: Runge-Kutta steps of 1e-6 s.
fn fine_peak(ea: f64) -> f64 {
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
    // EA = 1e4 N: a bungee of 1 cm whose half period, 140 ms, every host resolves
    let bungee = Section::from_stiffness(1e4, 0.05, 0.1).expect("a section");
    let mut cases = Vec::new();
    for (name, section) in [("bungee", bungee), ("soft rope", soft()), ("steel wire", wire())] {
        let falling = case(Snatch, name, 1.0, move |s| {
            let load = s.ball(MASS, 0.05, [0.0, FALL - LENGTH, 0.0]);
            let rope = line([0.0; 3], [0.0, FALL - LENGTH, 0.0], section).length(LENGTH);
            s.rope(rope, End::Fixed, End::On(load, [0.0; 3]))?;
            Ok(Play::idle().judging(move |s| {
                let ea = section.axial_stiffness;
                let v = (2.0 * G * FALL).sqrt();
                let (k, own) = (ea / LENGTH, section.mass_per_length * LENGTH);
                // the load on a spring, the wave in its own mass, and Green's law, stiffer by 3/2 of the strain
                let simple = MASS * G + ((MASS * G).powi(2) + k * MASS * v * v).sqrt();
                let most = (simple + 2.0 * v * (k * own).sqrt()) * (1.0 + 1.5 * simple / ea);
                let peak = s.trace.peak[0];
                let mut readings = vec![Reading::at_most(
                    "peak pull, N",
                    peak,
                    most,
                    "m g + sqrt((m g)^2 + k m v^2), twice the wave v sqrt(k m') of the rope, Green's law",
                )];
                // a peak is seen where a host step is a small part of half a period
                let half = std::f64::consts::PI * (MASS / k).sqrt();
                if s.dt() < 0.1 * half {
                    let fine = fine_peak(ea);
                    readings.push(Reading::near(
                        "peak pull, N",
                        peak,
                        fine,
                        0.15,
                        "fine run of the load on a massless rope; 15 % for the rope's own mass",
                    ));
                }
                readings
            }))
        });
        cases.push(falling);
    }
    cases
}
