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

use super::Warning;
use crate::cable::Cable;
use crate::scales::watch::{ADVISED, CONTACT_TURN, DEPTH, DURATION};
use crate::watch::{Contacts, Excess};

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
        let [depth, turn] = cable.contact_quality(CONTACT_TURN);
        let rests = !cable.snapshot.state.memory.contacts.is_empty() && cable.velocities().iter().all(|v| *v == 0.0);
        for (excess, reading, limit) in [(&mut self.depth, depth, DEPTH), (&mut self.turn, turn, 1.0)] {
            excess.note(cable.time(), reading, limit);
            if rests {
                excess.rest(reading, limit);
            }
        }
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
