//! Supports of a cable, changed between steps.

use super::Cable;
use crate::at::At;
use crate::error::Error;
use crate::support::{Motion, SlopeSupport, Support};

impl Cable {
    /// Returns the support of a node.
    ///
    /// # Errors
    /// As [`node`](Self::node).
    pub fn support(&self, at: impl Into<At>) -> Result<Support, Error> {
        Ok(self.model.support(self.node(at)?).copied().unwrap_or_default())
    }

    /// Holds a node, or frees it with `Support::default()`. A prescribed position or slope jumps to
    /// its value at the next step; a slope held to a direction is rotated to it at once, keeping
    /// its length.
    ///
    /// # Errors
    /// As [`node`](Self::node); [`Error::InvalidValue`] for numbers that are not finite or a
    /// direction that is not a unit vector.
    pub fn set_support(&mut self, at: impl Into<At>, support: Support) -> Result<(), Error> {
        let node = self.node(at)?;
        support.check().map_err(|e| e.of_cable(self.name()))?;
        self.snapshot.prescribed.retain(|led| led.node != node);
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
        if before.holds_position() != support.holds_position() {
            // other free spans
            self.snapshot.state.memory.bent_at.fill(0.0);
        }
        if before.slope != support.slope {
            let before = self.snapshot.state.q.clone();
            support.turn(&mut self.snapshot.state.q[6 * node + 3..6 * node + 6]);
            self.follow_twist(&before);
        }
        self.follow_holds();
        self.revise();
        Ok(())
    }

    /// Holds the position of a node where it is; its slope is free. An end that turned with a
    /// [clamp](Self::clamp) is held where it was drawn.
    ///
    /// # Errors
    /// As [`node`](Self::node).
    pub fn fix(&mut self, at: impl Into<At>) -> Result<(), Error> {
        let at = at.into();
        self.lay_as_drawn(at)?;
        let node = self.node(at)?;
        let position = Some(Motion::fixed(self.node_position(node)));
        self.set_support(At::Node(node), Support { position, slope: SlopeSupport::Free, attached: false })
    }

    /// Prescribes the position of a node as `motion` and keeps the support of its slope; cheap if
    /// the position was prescribed already. A motion that continues position and velocity of the
    /// last one keeps what integrators carry from step to step.
    ///
    /// # Errors
    /// As [`set_support`](Self::set_support).
    pub fn set_motion(&mut self, node: usize, motion: Motion) -> Result<(), Error> {
        let support = self.support(At::Node(node))?;
        let new = Support { position: Some(motion), attached: false, ..support };
        if support.position.is_none() || !motion.is_finite() {
            return self.set_support(At::Node(node), new);
        }
        self.snapshot.prescribed.retain(|led| led.node != node);
        self.model.set_support(node, new);
        let time = self.snapshot.state.time;
        let [now, then] = [motion.at(time), support.position.unwrap_or(motion).at(time)];
        let memory = &mut self.snapshot.state.memory;
        if now[..2] == then[..2] {
            for held in [&mut memory.acceleration, &mut memory.algorithmic] {
                if let Some(held) = held.get_mut(6 * node..6 * node + 3) {
                    held.copy_from_slice(now[2].as_slice());
                }
            }
            return Ok(());
        }
        let step = memory.step;
        self.revise();
        self.snapshot.state.memory.step = step;
        Ok(())
    }

    /// Frees a node.
    ///
    /// # Errors
    /// As [`node`](Self::node).
    pub fn release(&mut self, at: impl Into<At>) -> Result<(), Error> {
        self.set_support(at, Support::default())
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn is_held_still(&self) -> bool {
        self.model.supports.iter().all(|(_, support)| support.is_still_from(self.time()))
            && self.is_reel_still()
            && self.is_spin_still()
    }
}
