//! A mooring line that lies on the seabed.

use super::{Outcome, Stage};
use lariat::contact::{HalfSpace, Obstacle};
use lariat::{At, Buoyancy, Cable, Contact, Damping, Drag, Effects, Fidelity, Flow, Motion, Section, Vector3};
use lariat::{SlopeSupport, Support};
use std::f64::consts::TAU;

const LENGTH: f64 = 130.0; // m
const DEPTH: f64 = 30.0; // m
const SPAN: f64 = 120.0; // m
const BAR: f64 = 0.03; // m, radius of contact
const HEAVE: f64 = 0.5; // m
const PERIOD: f64 = 10.0; // s

/// 130 m of chain from an anchor on the seabed to a ship 30 m above it that heaves by 0.5 m.
pub struct Seabed {
    line: Cable,
    still: [f64; 2],
    touchdown: [f64; 2],
}

impl Seabed {
    pub fn new() -> Outcome<Self> {
        let mut drag = Drag::new(1025.0, 2.4, 1.15, Flow::default());
        drag.diameter = Some(0.03); // m
        let buoyancy = Buoyancy { area: Some(2.5e-3), ..Buoyancy::new(1025.0, 1.0) }; // m^2: 19.6 kg/m of steel
        let mut line = Cable::builder()
            .name("mooring line")
            .points([Vector3::zeros(), Vector3::new(SPAN, DEPTH, 0.0)])
            .length(LENGTH)
            .section(Section::from_stiffness(8.0e7, 10.0, 19.6)?) // EA N, EI N m^2, kg/m
            .elements(52)
            .effects(Effects {
                drag: Some(drag),
                buoyancy: Some(buoyancy),
                damping: Some(Damping { axial: 0.02, bending: 0.0 }), // s
                ..Effects::default()
            })
            .fidelity(Fidelity::Game)
            .fix(At::Start)
            .fix(At::End)
            .build()?;
        line.set_contact(Contact::with_friction(0.8).with_radius(BAR))?;
        // the centre line lies at y = 0
        line.set_obstacles([Obstacle::new(1, HalfSpace { normal: Vector3::y() }, Vector3::y() * -BAR, 0.8)])?;
        line.equilibrium()?;
        let still = [line.sample(0.0)?.tension, line.sample(LENGTH)?.tension];
        Ok(Seabed { line, still, touchdown: [f64::INFINITY, 0.0] })
    }

    /// Lets the upper end follow the ship for the coming host step.
    fn heave(&mut self, dt: f64) -> Outcome<()> {
        let (t, w) = (self.line.time(), TAU / PERIOD);
        let (up, ship) = (Vector3::y() * HEAVE, Vector3::new(SPAN, DEPTH, 0.0));
        let ship = |t: f64| (ship + up * (1.0 - (w * t).cos()), up * w * (w * t).sin());
        let position = Some(Motion::hermite(t, dt, ship(t), ship(t + dt)));
        self.line.set_support(At::End, Support { position, slope: SlopeSupport::Free, attached: false })?;
        Ok(())
    }

    /// Arc length in m at which the line leaves the seabed.
    fn touchdown(&self) -> f64 {
        self.line.contacts().map(|touch| touch.arc_length).fold(0.0, f64::max)
    }
}

impl Stage for Seabed {
    fn step(&mut self) -> Outcome<()> {
        let dt = 1.0 / 60.0;
        self.heave(dt)?;
        self.line.step(dt)?;
        let at = self.touchdown();
        self.touchdown = [self.touchdown[0].min(at), self.touchdown[1].max(at)];
        Ok(())
    }

    fn check(&mut self) -> Outcome<String> {
        // a limp line with a = H/w: suspended length s = sqrt(h^2 + 2 h a), span l - s + a asinh(s/a), top tension w (a + h)
        let weight = (19.6 - 1025.0 * 2.5e-3) * 9.81;
        let suspended = |a: f64| (DEPTH * DEPTH + 2.0 * DEPTH * a).sqrt();
        let (mut low, mut high) = (1.0, 1000.0);
        for _ in 0..100 {
            let a = 0.5 * (low + high);
            let s = suspended(a);
            if LENGTH - s + a * (s / a).asinh() < SPAN { low = a } else { high = a }
        }
        let expected = [weight * low, weight * (low + DEPTH)];
        let line = format!(
            "still: {:.0} N at the anchor and {:.0} N at the ship, by hand {:.0} and {:.0} N; heaving, the line leaves the seabed between {:.1} and {:.1} m",
            self.still[0], self.still[1], expected[0], expected[1], self.touchdown[0], self.touchdown[1]
        );
        let close = |k: usize| (self.still[k] / expected[k] - 1.0).abs() < 0.02;
        let touches = self.touchdown[0] > 0.0 && self.touchdown[1] < LENGTH;
        if close(0) && close(1) && touches { Ok(line) } else { Err(line.into()) }
    }
}
