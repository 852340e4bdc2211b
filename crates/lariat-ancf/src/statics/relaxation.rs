//! A cable that a host brings to rest by its motion: what acts on it stays as statics have it.
//!
//! Kelvin-Voigt damping of the relaxation joins that of the cable: it leaves the equilibrium as it
//! is, and ends vibrations that are faster than the host stops.
//!
//! # Validity
//!
//! Supports, reels and flows must [stay](crate::coupling::Coupling::is_held_still) as they are.
//!
//! # References
//!
//! Barnes 1999 (dynamic relaxation with kinetic damping).

use crate::cable::Cable;
use crate::effect::Damping;
use crate::integrate::Fidelity;
use crate::scales::statics::RELAXATION_DAMPING;
use crate::strength::Strength;
use nalgebra::Vector3;

impl Cable {
    /// Begins at rest, under its loads at the end of their ramps; it cannot break.
    pub(crate) fn begin_relaxation(&mut self) {
        let now = self.time();
        self.model.loads.iter_mut().for_each(|load| load.stay(now));
        self.model.strength = Strength::default();
        self.set_watched(false);
        let mut effects = self.effects().clone();
        let own = effects.damping.unwrap_or_default();
        let [axial, bending] = [own.axial, own.bending].map(|time| time.max(RELAXATION_DAMPING));
        effects.damping = Some(Damping { axial, bending });
        // damping goes with all effects
        let _ = self.set_effects(effects);
        // that of a fidelity fits every cable, but one with contact keeps the one that can step it
        let _ = self.set_integrator(self.integrator_for(Fidelity::Game));
        self.stop();
    }

    /// Stops it where it is; what it touches stays.
    pub(crate) fn stop(&mut self) {
        // these numbers are finite
        let _ = self.set_rigid_motion(Vector3::zeros(), Vector3::zeros());
    }

    /// Ends at rest, with the clock, loads, strength, integrator and history of the cable `before`.
    pub(crate) fn end_relaxation(&mut self, before: &Cable) {
        for (load, own) in self.model.loads.iter_mut().zip(&before.model.loads) {
            *load = crate::PointLoad { arc_length: load.arc_length, ..own.clone() };
        }
        self.model.strength = before.model.strength;
        // they were its own; what it touches is forgotten with a change, but of the state
        let state = self.snapshot.state.clone();
        let _ = self.set_effects(before.effects().clone());
        self.snapshot.state = state;
        (self.integrator, self.default_integrator) = (before.integrator, before.default_integrator);
        self.diagnostics = before.diagnostics;
        let (own, history) = (&mut self.snapshot, &before.snapshot);
        (own.work, own.law, own.load, own.inserted_energy) =
            (history.work, history.law, history.load, history.inserted_energy);
        own.state.time = history.state.time;
        self.stop();
        self.set_watched(before.is_watched());
    }
}
