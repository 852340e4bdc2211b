//! A host step of a cable with a reel: in parts in which little material passes the eye.

use super::plan::{asked, plan};
use crate::cable::Cable;
use crate::element::flow::Extent;
use crate::error::{Error, require};
use crate::integrate::IntegratorRef;

/// Largest length of material that passes the eye in a part of a host step, as a share of an element.
const PASSING: f64 = 0.15;
/// Largest number of parts.
const MOST_PARTS: f64 = 1e5;
/// Rate in m/s below which a reel stands.
const LEAST_RATE: f64 = 1e-12;

impl Cable {
    /// Returns the number of parts in which a host step of `dt` (s) is to be taken; 1 without a reel.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a rate that needs more than 1e5.
    pub(crate) fn reel_parts(&self, dt: f64) -> Result<usize, Error> {
        let Some(own) = &self.model.reel else { return Ok(1) };
        let element = own.mesh.iter().map(|element| element.length).fold(own.stock.length, f64::min);
        let parts = (self.fastest_rate(dt) * dt / (PASSING * element)).ceil().max(1.0);
        require("parts of a host step for the rate of its reel", parts, parts <= MOST_PARTS, "<= 1e5")
            .map_err(|e| e.of_cable(self.name()))?;
        Ok(parts as usize)
    }

    /// Sets the rate of the reel for a part of length `h` (s).
    pub(crate) fn begin_reel(&mut self, h: f64) {
        let (Some(own), Some(winding)) = (&self.model.reel, &self.snapshot.winding) else { return };
        let plan = plan(&self.model, &own.reel, winding, self.snapshot.state.time, h);
        self.sync_reel();
        if let Some(flow) = &mut self.system.flow {
            flow.extent.acceleration = plan.acceleration;
            flow.stopped = plan.stopped;
        }
    }

    /// Takes over what the reel did in a part, if that succeeded.
    pub(crate) fn end_reel(&mut self, succeeded: bool) {
        let (Some(flow), Some(winding)) = (&self.system.flow, &mut self.snapshot.winding) else { return };
        if succeeded {
            let Extent { length, rate, acceleration } = flow.at(self.snapshot.state.time);
            // braking to rest ends at rest
            let rate = if rate.abs() < LEAST_RATE { 0.0 } else { rate };
            winding.extent = [length, rate, acceleration];
            winding.length_before = flow.length_before;
            winding.stopped = flow.stopped;
            if let Some(last) = self.model.elements.last_mut() {
                last.length = length;
            }
        }
        self.sync_reel();
    }

    /// Checks that an island can step a cable with a reel by `dt` (s).
    ///
    /// # Errors
    /// [`Error::ReelPlace`] for an eye on a body that the cable moves; [`Error::InvalidValue`] if more than half of an element would
    /// pass the eye.
    pub(crate) fn check_reel_in_island(&self, held_by_free_body: bool, dt: f64) -> Result<(), Error> {
        let (Some(own), Some(winding)) = (&self.model.reel, &self.snapshot.winding) else { return Ok(()) };
        if held_by_free_body {
            let reason = "its eye is on a body that moves freely, whose change of mass is not accounted for: \
                use a fixed or kinematic body";
            return Err(Error::ReelPlace { cable: self.name().to_string(), reason });
        }
        let full = own.element(self.elements().len() - 1).length;
        let [length, rate, _] = winding.extent;
        let passing = (rate.abs() + own.reel.acceleration * dt).min(self.fastest_rate(dt)) * dt;
        require(
            "share of an element that its reel moves in a step of an island",
            passing / full,
            passing <= 0.5 * full,
            "<= 0.5",
        )
        .and_then(|()| {
            require("length of the element at the eye over its full one", length / full, length < 2.5 * full, "< 2.5")
        })
        .map_err(|e| e.of_cable(self.name()))
    }

    /// Returns the largest rate in m/s in the coming `dt` (s).
    fn fastest_rate(&self, dt: f64) -> f64 {
        let (Some(own), Some(winding)) = (&self.model.reel, &self.snapshot.winding) else { return 0.0 };
        let rate = winding.extent[1].abs();
        let rows = own.reel.rate.iter().filter(|row| row[0] > self.time() && row[0] < self.time() + dt);
        let asked = rows.map(|row| row[1].abs()).fold(asked(&own.reel, self.time()).abs(), f64::max);
        rate.max(asked.min(rate + own.reel.acceleration * dt))
    }

    /// Advances a cable with a reel by `dt` (s).
    pub(crate) fn step_with_reel(&mut self, dt: f64, integrator: IntegratorRef<'_>) -> Result<(), Error> {
        let parts = self.reel_parts(dt)?;
        let end = self.time() + dt;
        let before = (parts > 1).then(|| Box::new(self.clone()));
        for part in 0..parts {
            let h = (end - self.time()) / (parts - part) as f64;
            self.begin_reel(h);
            let outcome = self.with_workspace(|cable| cable.step_in_workspace(h, integrator));
            self.end_reel(outcome.is_ok());
            if let Err(error) = outcome.and_then(|()| self.remesh_reel()) {
                if let Some(before) = before {
                    *self = *before;
                }
                return Err(error);
            }
        }
        self.snapshot.state.time = end;
        self.sync_reel();
        Ok(())
    }
}
