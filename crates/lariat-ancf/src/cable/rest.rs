//! A cable at rest: whether it is, and time passing over it without a step.

use super::Cable;
use crate::error::{Error, require};
use crate::support::SlopeSupport;
use nalgebra::Vector3;

impl Cable {
    /// Speed of the fastest node in m/s.
    pub fn speed(&self) -> f64 {
        let squared = |v: &[f64]| v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        self.velocities().chunks_exact(6).map(squared).fold(0.0, f64::max).sqrt()
    }

    /// Whether all loads are at their full value now: no ramp is under way.
    pub fn is_loaded_steadily(&self) -> bool {
        self.model.loads.iter().all(|load| load.factor(self.time()) == 1.0)
    }

    /// Whether no prescribed motion of a support moves.
    pub fn is_held_still(&self) -> bool {
        self.model.supports.iter().all(|(_, support)| support.is_still())
    }

    /// Lets `dt` (s) pass at rest: positions stay, velocities become zero. For a caller who knows that the cable is at rest, or
    /// wants it frozen.
    pub fn rest(&mut self, dt: f64) {
        let phase = &mut self.state.phase;
        phase.time += dt;
        phase.v.fill(0.0);
        phase.memory.valid = false;
        phase.memory.step = 0.0;
    }

    /// Sets the clock to `time` (s); prescribed motions and the ramps of loads keep their distance from it.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a time that is not finite.
    pub fn set_time(&mut self, time: f64) -> Result<(), Error> {
        require("time (s)", time, true, "a number")?;
        let later = time - self.time();
        self.model.loads.iter_mut().for_each(|load| load.start += later);
        for (_, support) in &mut self.model.supports {
            let slope = match &mut support.slope {
                SlopeSupport::Prescribed(motion) => Some(motion),
                _ => None,
            };
            support.position.iter_mut().chain(slope).for_each(|motion| motion.start += later);
        }
        self.state.phase.time = time;
        self.revise();
        Ok(())
    }

    /// Force (N) and moment about the node (N m) of the cable on what holds `node`, at the present state and its known
    /// accelerations; those of a state without any are taken as zero. Allocates nothing.
    pub fn pull(&mut self, node: usize) -> (Vector3<f64>, Vector3<f64>) {
        self.refresh_memory();
        let mut rows = core::mem::take(&mut self.system.rhs);
        let mut inertia = core::mem::take(&mut self.system.product);
        let (mut equations, phase) = self.equations();
        equations.moving_force(phase.time, &phase.q, &phase.v, 1.0, &mut rows);
        if phase.memory.valid {
            equations.system.multiply_mass(&phase.memory.acceleration, &mut inertia);
            rows.iter_mut().zip(&inertia).for_each(|(r, m)| *r -= m);
        }
        let vector = |x: &[f64]| Vector3::new(x[0], x[1], x[2]);
        let (force, slope) = (vector(&rows[6 * node..]), vector(&rows[6 * node + 3..]));
        let moment = vector(&phase.q[6 * node + 3..]).cross(&slope);
        self.system.rhs = rows;
        self.system.product = inertia;
        (force, moment)
    }
}
