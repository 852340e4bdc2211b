//! Points of a cable that are led to a place, and held there.
//!
//! # Equation
//!
//! From position and velocity now to those at the end of the duration by the cubic of Hermite;
//! from then on at the place, at rest.
//!
//! # Validity
//!
//! A snapshot knows what was prescribed: one that is restored leads the points as it did then, and
//! gives those that were prescribed since the support that they had. On a cable with a reel, whose
//! nodes come and go, it does not.
//!
//! # References
//!
//! [`Motion::hermite`].
//!
//! # Alternatives considered
//!
//! The cubic beyond its end: a point that was not prescribed again ran away with the cube of time.

use super::Cable;
use crate::at::At;
use crate::error::{Error, require, require_finite};
use crate::state::State;
use crate::support::{Motion, Prescription, Support};
use nalgebra::Vector3;

impl Cable {
    /// Leads a node to `position` (m) with `velocity` (m/s) there, by a cubic from its present
    /// position and velocity over `duration` (s); then it is held at that place. Its slope stays as
    /// it is held. [`restore`](Self::restore) restores it.
    ///
    /// # Errors
    /// As [`node`](Self::node); [`Error::InvalidValue`] for a duration that is not positive and
    /// numbers that are not finite.
    pub fn prescribe(
        &mut self,
        at: impl Into<At>,
        position: impl Into<crate::Point>,
        velocity: impl Into<crate::Point>,
        duration: f64,
    ) -> Result<(), Error> {
        let node = self.node(at)?;
        let (position, velocity) = (position.into().0, velocity.into().0);
        let checked = require("duration (s)", duration, duration > 0.0, "> 0")
            .and_then(|()| require_finite("position (m)", &position))
            .and_then(|()| require_finite("velocity (m/s)", &velocity));
        checked.map_err(|e| e.of_cable(self.name()))?;
        let now = Vector3::from_column_slice(&self.velocities()[6 * node..6 * node + 3]);
        let from = (self.node_position(node), now);
        let motion = Motion::hermite(self.time(), duration, from, (position, velocity)).until(self.time() + duration);
        let before = self.support(At::Node(node))?;
        let mut prescribed = core::mem::take(&mut self.snapshot.prescribed);
        let set = self.set_motion(node, motion);
        if set.is_ok() && !self.has_reel() {
            match prescribed.iter_mut().find(|p| p.node == node) {
                Some(known) => known.motion = motion,
                None => prescribed.push(Prescription { node, motion, before }),
            }
        }
        self.snapshot.prescribed = prescribed;
        set
    }

    /// Stops nodes whose prescribed motion has ended: methods that compute velocities from
    /// displacements carry them on.
    pub(crate) fn stop_ended(&mut self) {
        let State { time, v, .. } = &self.snapshot.state;
        let moves = |node: usize| v[6 * node..6 * node + 3].iter().any(|v| *v != 0.0);
        let over = |support: &Support| support.position.is_some_and(|motion| motion.is_over(*time));
        let stopped = self.model.supports.iter().any(|(node, support)| over(support) && moves(*node));
        if stopped {
            self.revise();
        }
    }

    /// Gives points that were prescribed their supports of before, and those of a snapshot theirs.
    pub(super) fn restore_prescribed(&mut self, then: &[Prescription]) -> Result<(), Error> {
        let now = core::mem::take(&mut self.snapshot.prescribed);
        if now == then {
            return Ok(());
        }
        let nodes = self.nodes();
        // what was attached to a body since stays there
        let is_led = |cable: &Cable, p: &Prescription| {
            p.node < nodes && !cable.model.support(p.node).is_some_and(|support| support.attached)
        };
        for p @ Prescription { node, before, .. } in &now {
            if !is_led(self, p) {
                continue;
            }
            self.set_support(At::Node(*node), *before)?;
        }
        for p @ Prescription { node, motion, .. } in then {
            if !is_led(self, p) {
                continue;
            }
            let support = self.support(At::Node(*node))?;
            self.set_support(At::Node(*node), Support { position: Some(*motion), attached: false, ..support })?;
        }
        Ok(())
    }
}
