//! Gravity and point loads of a cable, changed between steps.

use super::Cable;
use crate::element::shape::{self, combine};
use crate::error::{Error, require_finite};
use crate::load::PointLoad;
use nalgebra::Vector3;

impl Cable {
    /// Changes gravity (m/s^2).
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for numbers that are not finite.
    pub fn set_gravity(&mut self, gravity: Vector3<f64>) -> Result<(), Error> {
        require_finite("gravity (m/s^2)", &gravity).map_err(|e| e.of_cable(self.name()))?;
        self.model.gravity = gravity;
        self.system.loads.weigh(&self.model);
        self.system.forces.weigh_water(&self.model);
        self.system.feeds.forget_lengths();
        self.sync_reel();
        self.revise();
        Ok(())
    }

    /// Returns the point loads.
    pub fn loads(&self) -> &[PointLoad] {
        &self.model.loads
    }

    /// Adds a point load; its ramp and history begin now.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an arc length off the cable, [`Error::InvalidValue`] for numbers
    /// that are not finite, [`Error::NotWithReel`] for a load on the element at the eye of a reel.
    pub fn add_load(&mut self, load: PointLoad) -> Result<(), Error> {
        let arc_length = self.on_cable(load.arc_length)?;
        load.check().map_err(|e| e.of_cable(self.name()))?;
        self.model.loads.push(PointLoad { arc_length, start: self.time(), ..load });
        if let Err(error) = self.model.check_loads_at_eyes() {
            self.model.loads.pop();
            return Err(error.of_cable(self.name()));
        }
        self.take_loads();
        Ok(())
    }

    /// Replaces all point loads. A load that does not change keeps the time at which it began;
    /// others begin now.
    ///
    /// # Errors
    /// As [`add_load`](Self::add_load); the cable is then as before.
    pub fn set_loads(&mut self, loads: &[PointLoad]) -> Result<(), Error> {
        let before = core::mem::take(&mut self.model.loads);
        for load in loads {
            if let Err(error) = self.add_load(load.clone()) {
                self.model.loads = before;
                self.take_loads();
                return Err(error);
            }
            if let (Some(old), Some(new)) = (before.iter().find(|old| old.is_same(load)), self.model.loads.last_mut()) {
                new.start = old.start;
            }
        }
        self.take_loads();
        Ok(())
    }

    /// Takes up point loads that were changed.
    fn take_loads(&mut self) {
        let passed = self.snapshot.passed_at_start();
        self.model.note_load_origins(passed);
        self.model.move_loads(passed);
        self.system.loads.locate(&self.model);
        self.revise();
    }

    /// Removes all point loads.
    pub fn clear_loads(&mut self) {
        self.model.loads.clear();
        self.take_loads();
    }

    /// Returns of the moment with the largest part about the tangent, which does nothing, the arc
    /// length in m, that part and the moment in N m; those with less than `share` of themselves
    /// about it, and those that a clamp takes, do not count.
    pub(crate) fn moment_along(&self, share: f64) -> Option<[f64; 3]> {
        let loads = self.model.loads.iter().filter(|load| load.moment != Vector3::zeros());
        let of = |load: &PointLoad| {
            let (e, xi) = self.model.locate(load.arc_length);
            let slope = combine(self.positions(), e, &shape::slope(xi, self.model.elements[e].length));
            let (part, moment) = (load.moment.dot(&slope.try_normalize(0.0)?).abs(), load.moment.norm());
            (part > share * moment && !self.holds_moment(load.arc_length)).then_some([load.arc_length, part, moment])
        };
        loads.filter_map(of).max_by(|a, b| a[1].total_cmp(&b[1]))
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn is_loaded_steadily(&self, h: f64) -> bool {
        let now = self.time();
        self.model.loads.iter().all(|load| load.is_steady(now, now + h))
            && self.model.effects.are_steady(now, now + h)
            && !self.model.force_densities.depend_on_time()
    }
}
