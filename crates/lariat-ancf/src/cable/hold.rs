//! What holds a cable and what pulls at it: supports and point loads, changed between steps.

use super::{At, Cable};
use crate::error::{Error, require, require_finite};
use crate::load::PointLoad;
use crate::support::{Motion, SlopeSupport, Support};
use nalgebra::Vector3;

impl Cable {
    /// What holds a node.
    ///
    /// # Errors
    /// As [`node`](Self::node).
    pub fn support(&self, at: impl Into<At>) -> Result<Support, Error> {
        Ok(self.model.support(self.node(at)?).copied().unwrap_or_default())
    }

    /// Holds a node, or frees it with `Support::default()`. A prescribed position or slope jumps to its value at the next step; a
    /// slope held to a direction is turned there at once, keeping its length.
    ///
    /// # Errors
    /// As [`node`](Self::node); [`Error::InvalidValue`] for numbers that are not finite or a direction that is not a unit vector.
    pub fn set_support(&mut self, at: impl Into<At>, support: Support) -> Result<(), Error> {
        let node = self.node(at)?;
        support.check().map_err(|e| e.of_cable(self.name()))?;
        let mut support = support;
        if let SlopeSupport::Direction(d) = &mut support.slope {
            d.normalize_mut();
        }
        let before = self.model.support(node).copied().unwrap_or_default();
        self.model.set_support(node, support);
        if let Err(failure) = self.system.factor_mass(&self.model) {
            self.model.set_support(node, before);
            let _ = self.system.factor_mass(&self.model);
            return Err(self.step_failed(self.time(), 0.0, failure));
        }
        if before.slope != support.slope {
            support.turn(&mut self.state.phase.q[6 * node + 3..6 * node + 6]);
        }
        self.revise();
        Ok(())
    }

    /// Holds the position of a node where it is; its slope is free.
    ///
    /// # Errors
    /// As [`node`](Self::node).
    pub fn fix(&mut self, at: impl Into<At>) -> Result<(), Error> {
        let node = self.node(at)?;
        let position = Some(Motion::fixed(self.node_position(node)));
        self.set_support(At::Node(node), Support { position, slope: SlopeSupport::Free, attached: false })
    }

    /// Prescribes the position of a node as `motion`, keeping what holds its slope; cheap if it was prescribed already.
    ///
    /// # Errors
    /// As [`set_support`](Self::set_support).
    pub fn set_motion(&mut self, node: usize, motion: Motion) -> Result<(), Error> {
        let support = self.support(At::Node(node))?;
        let new = Support { position: Some(motion), attached: false, ..support };
        if support.position.is_none() || !motion.is_finite() {
            return self.set_support(At::Node(node), new);
        }
        self.model.set_support(node, new);
        let step = self.state.phase.memory.step;
        self.revise();
        self.state.phase.memory.step = step;
        Ok(())
    }

    /// Frees a node.
    ///
    /// # Errors
    /// As [`node`](Self::node).
    pub fn release(&mut self, at: impl Into<At>) -> Result<(), Error> {
        self.set_support(at, Support::default())
    }

    /// Gives the cable the velocity field of a rigid motion: `velocity` (m/s) of the start point, `angular_velocity` (rad/s) about it.
    /// Held points keep the velocity of what holds them.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for numbers that are not finite.
    pub fn set_rigid_motion(&mut self, velocity: Vector3<f64>, angular_velocity: Vector3<f64>) -> Result<(), Error> {
        require_finite("velocity (m/s)", &velocity)?;
        require_finite("angular velocity (rad/s)", &angular_velocity)?;
        let start = self.node_position(0);
        let phase = &mut self.state.phase;
        for (q, v) in phase.q.chunks_exact(6).zip(phase.v.chunks_exact_mut(6)) {
            let (r, t) = (Vector3::new(q[0], q[1], q[2]), Vector3::new(q[3], q[4], q[5]));
            v[..3].copy_from_slice((velocity + angular_velocity.cross(&(r - start))).as_slice());
            v[3..].copy_from_slice(angular_velocity.cross(&t).as_slice());
        }
        for (node, support) in &self.model.supports {
            // what is held is moved there by the next step; here only its velocity counts
            let mut position = [0.0; 6];
            support.prescribe(phase.time, &mut position, &mut phase.v[6 * node..6 * node + 6]);
        }
        self.disturb();
        Ok(())
    }

    /// Changes gravity (m/s^2).
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for numbers that are not finite.
    pub fn set_gravity(&mut self, gravity: Vector3<f64>) -> Result<(), Error> {
        require_finite("gravity (m/s^2)", &gravity).map_err(|e| e.of_cable(self.name()))?;
        self.model.gravity = gravity;
        self.system.weigh(&self.model);
        self.revise();
        Ok(())
    }

    /// Point loads.
    pub fn loads(&self) -> &[PointLoad] {
        &self.model.loads
    }

    /// Adds a point load; a ramp begins now.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an arc length off the cable, [`Error::InvalidValue`] for numbers that are not finite.
    pub fn add_load(&mut self, load: PointLoad) -> Result<(), Error> {
        self.check_arc_length(load.arc_length)?;
        require_finite("force (N)", &load.force)
            .and_then(|()| require_finite("moment (N m)", &load.moment))
            .and_then(|()| require("ramp (s)", load.ramp, load.ramp >= 0.0, ">= 0"))
            .map_err(|e| e.of_cable(self.name()))?;
        self.model.loads.push(PointLoad { start: self.time(), ..load });
        self.system.locate_loads(&self.model);
        self.revise();
        Ok(())
    }

    /// Replaces all point loads. One that is there already keeps the time at which its ramp began, others begin now.
    ///
    /// # Errors
    /// As [`add_load`](Self::add_load); the cable is then as before.
    pub fn set_loads(&mut self, loads: &[PointLoad]) -> Result<(), Error> {
        let before = core::mem::take(&mut self.model.loads);
        for load in loads {
            if let Err(error) = self.add_load(*load) {
                self.model.loads = before;
                self.system.locate_loads(&self.model);
                self.revise();
                return Err(error);
            }
            if let (Some(old), Some(new)) = (before.iter().find(|old| old.is_same(load)), self.model.loads.last_mut()) {
                new.start = old.start;
            }
        }
        self.system.locate_loads(&self.model);
        self.revise();
        Ok(())
    }

    /// Removes all point loads.
    pub fn clear_loads(&mut self) {
        self.model.loads.clear();
        self.system.locate_loads(&self.model);
        self.revise();
    }
}
