//! Whether the mesh resolves what a cable touches.
//!
//! # Validity
//!
//! The centre line is looked at three places between two samples of its elements, at host times,
//! beside obstacles that are fixed or move as prescribed. Between samples a cable sags with the
//! square of their distance. Where an element that touches turns by more than a ninth of a turn,
//! tensions along a drum are off by 5 to 8 % (8 elements per turn; 10: by 1 %), and the iterations
//! of a step grow to tens. Both are told of if they last longer than an impact, and at once of a
//! cable that rests on what it touches.
//!
//! A cable that slides along itself over the facets of a mesh, about which it bends, loses energy
//! at each edge without friction: masses on prisms of 12 to 96 sides fall 5 to 56 % too slowly
//! (docs/decisions/contact.md). It is told after ten radii.

use super::Warning;
use crate::cable::Cable;
use crate::obstacle::{Obstacle, RigidMotion};
use crate::scales::watch::{ADVISED, CONTACT_TURN, DEPTH, DURATION, FACET_TURN, SLID};
use crate::watch::{Contacts, Excess};
use nalgebra::Vector3;

/// Returns the largest speed (m/s) with which a cable slides along itself over an obstacle about
/// which it bends.
fn sliding(cable: &Cable, obstacle: &Obstacle) -> Option<f64> {
    let touches = || cable.snapshot.state.memory.contacts.iter().filter(|touch| touch.obstacle == obstacle.key);
    let first = touches().next()?.direction;
    if touches().all(|touch| touch.direction.dot(&first) > FACET_TURN.cos()) {
        return None;
    }
    let RigidMotion { position, velocity, angular_velocity, .. } = &obstacle.motion;
    let (q, v) = (cable.positions(), cable.velocities());
    let slides = touches().filter(|touch| touch.slips || obstacle.friction == 0.0);
    let speed = slides.map(|touch| {
        let node = |x: &[f64], i: usize| Vector3::from_column_slice(&x[6 * i..6 * i + 3]);
        let e = touch.element as usize;
        let (along, place) = ((node(q, e + 1) - node(q, e)).normalize(), 0.5 * (node(q, e) + node(q, e + 1)));
        let own = 0.5 * (node(v, e) + node(v, e + 1));
        (own - velocity - angular_velocity.cross(&(place - position))).dot(&along).abs()
    });
    Some(speed.filter(|speed| speed.is_finite()).fold(0.0, f64::max))
}

impl Excess {
    fn note(&mut self, time: f64, [arc_length, reading]: [f64; 2], limit: f64) {
        if reading <= limit {
            self.since = None;
            return;
        }
        let since = *self.since.get_or_insert_with(|| {
            self.least = [arc_length, reading];
            time
        });
        if reading < self.least[1] {
            self.least = [arc_length, reading];
        }
        if time - since > DURATION && self.least[1] > self.worst[1] {
            self.worst = self.least;
        }
    }

    /// Notes the reading of a cable at rest, which lasts.
    fn rest(&mut self, reading: [f64; 2], limit: f64) {
        if reading[1] > limit.max(self.worst[1]) {
            self.worst = reading;
        }
    }

    fn told(&self) -> Option<[f64; 2]> {
        Some(self.worst).filter(|worst| worst[1] > 0.0)
    }
}

impl Contacts {
    /// Reads the cable at a host time.
    pub fn note(&mut self, cable: &Cable) {
        if cable.effects().contact.is_none() {
            return;
        }
        self.note_facets(cable);
        let [depth, turn] = cable.contact_quality(CONTACT_TURN);
        let rests = !cable.snapshot.state.memory.contacts.is_empty() && cable.velocities().iter().all(|v| *v == 0.0);
        for (excess, reading, limit) in [(&mut self.depth, depth, DEPTH), (&mut self.turn, turn, 1.0)] {
            excess.note(cable.time(), reading, limit);
            if rests {
                excess.rest(reading, limit);
            }
        }
    }

    /// Reads how fast the cable slides along itself over facets.
    fn note_facets(&mut self, cable: &Cable) {
        let passed = cable.time() - core::mem::replace(&mut self.facets.at, cable.time());
        let fastest = cable.obstacles().iter().filter(|obstacle| obstacle.surface.has_facets());
        let fastest = fastest.filter_map(|obstacle| sliding(cable, obstacle)).fold(0.0, f64::max);
        // of a cable that was read before
        if passed.is_finite() && passed > 0.0 {
            self.facets.slid += fastest * passed;
        }
    }

    pub fn facets(&self, cable: &Cable) -> Option<Warning> {
        let slid_m = self.facets.slid;
        (slid_m > SLID * cable.contact_radius()).then(|| Warning::Facets {
            cable: cable.name().to_string(),
            time_s: cable.time(),
            slid_m,
        })
    }

    pub fn sinks(&self, cable: &Cable) -> Option<Warning> {
        self.depth.told().map(|[arc_length_m, share]| {
            let enough = (cable.elements().len() as f64 * (2.0 * share / DEPTH).sqrt()).ceil() as usize;
            let cable = cable.name().to_string();
            Warning::Sinks { cable, arc_length_m, share, enough }
        })
    }

    pub fn coarse(&self, cable: &Cable) -> Option<Warning> {
        self.turn.told().map(|[arc_length_m, share]| {
            let turn_rad = share * CONTACT_TURN;
            let enough = (cable.elements().len() as f64 * turn_rad / ADVISED).ceil() as usize;
            Warning::CoarseContact { cable: cable.name().to_string(), arc_length_m, turn_rad, enough }
        })
    }

    /// Whether friction lags in more than a hundredth of all steps.
    pub fn lags(cable: &Cable) -> Option<Warning> {
        let counts = cable.diagnostics();
        let steps = counts.lagging_steps;
        (steps > 10 && 100 * steps > counts.steps)
            .then(|| Warning::FrictionLags { cable: cable.name().to_string(), steps })
    }
}
