//! A mooring line from an anchor to a ship that heaves.

use super::{Outcome, Stage};
use lariat::{
    At, Buoyancy, Cable, Damping, Drag, Effects, Flow, Integrator, Method, Motion, Section, SlopeSupport, Support,
    Vector3,
};
use std::f64::consts::TAU;

const SHIP: Vector3<f64> = Vector3::new(80.0, 50.0, 0.0); // m from the anchor
const HEAVE: f64 = 1.0; // m
const PERIOD: f64 = 8.0; // s

/// 96 m of 16 mm chain in water, from an anchor to a ship that heaves by 1 m.
pub struct Mooring {
    line: Cable,
    still: f64,
    largest: f64,
}

impl Mooring {
    pub fn new() -> Outcome<Self> {
        let mut drag = Drag::new(1025.0, 2.4, 1.15, Flow::default());
        drag.diameter = Some(0.016); // m
        let buoyancy = Buoyancy { area: Some(7.1e-4), ..Buoyancy::new(1025.0, 1.0) }; // m^2: 5.6 kg/m of steel
        let damping = Damping { axial: 0.02, bending: 0.0 }; // s
        let mut line = Cable::builder()
            .name("mooring line")
            .points([Vector3::zeros(), SHIP])
            .length(96.0) // m
            .section(Section::from_stiffness(2.2e7, 0.0, 5.6)?) // EA N, no EI: a chain, kg/m
            .rule("projected-none".parse()?) // no bending code runs
            .elements(30)
            .effects(Effects {
                drag: Some(drag),
                buoyancy: Some(buoyancy),
                damping: Some(damping),
                ..Effects::default()
            })
            .integrator(Integrator::tolerance(Method::Esdirk4, 1e-4)?) // m per host step
            .fix(At::Start)
            .fix(At::End)
            .build()?;
        line.equilibrium()?;
        let still = line.sample(96.0)?.tension;
        Ok(Mooring { line, still, largest: 0.0 })
    }

    /// Lets the upper end follow the ship for the coming host step.
    fn heave(&mut self, dt: f64) -> Outcome<()> {
        let (t, w) = (self.line.time(), TAU / PERIOD);
        let ship =
            |t: f64| (SHIP + Vector3::y() * HEAVE * (1.0 - (w * t).cos()), Vector3::y() * HEAVE * w * (w * t).sin());
        let position = Some(Motion::hermite(t, dt, ship(t), ship(t + dt)));
        self.line.set_support(At::End, Support { position, slope: SlopeSupport::Free, attached: false })?;
        Ok(())
    }
}

impl Stage for Mooring {
    fn step(&mut self) -> Outcome<()> {
        let dt = 1.0 / 60.0;
        self.heave(dt)?;
        self.line.step(dt)?;
        self.largest = self.largest.max(self.line.peak_tension().1);
        Ok(())
    }

    fn check(&mut self) -> Outcome<String> {
        // a limp line of length l, span w and rise v: sqrt(l^2 - v^2) = 2 a sinh(w/2a), H = m g a, top tension m g (a cosh)
        let weight = (5.6 - 1025.0 * 7.1e-4) * 9.81;
        let chord = (96.0f64 * 96.0 - 50.0 * 50.0).sqrt();
        let (mut low, mut high) = (10.0, 1000.0);
        for _ in 0..100 {
            let a: f64 = 0.5 * (low + high);
            if 2.0 * a * (80.0 / (2.0 * a)).sinh() > chord { low = a } else { high = a }
        }
        let top = 40.0 + low * (50.0f64 / 96.0).atanh();
        let expected = weight * low * (top / low).cosh();
        let line = format!(
            "still water: {:.0} N at the ship, catenary {expected:.0} N; heaving: at most {:.0} N",
            self.still, self.largest
        );
        if (self.still / expected - 1.0).abs() < 0.01 && self.largest > self.still {
            Ok(line)
        } else {
            Err(line.into())
        }
    }
}
