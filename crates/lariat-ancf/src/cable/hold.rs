//! What holds a cable and what pulls at it: supports and point loads, changed between steps.

use super::{At, Cable};
use crate::error::{Error, require, require_finite};
use crate::load::PointLoad;
use crate::support::{Motion, SlopeSupport, Support};

impl Cable {
    /// What holds a node.
    ///
    /// # Errors
    /// As [`node`](Self::node).
    pub fn support(&self, at: impl Into<At>) -> Result<Support, Error> {
        Ok(self.model.support(self.node(at)?).copied().unwrap_or_default())
    }

    /// Holds a node, or frees it with `Support::default()`. A prescribed position or slope jumps to its value at the next step.
    ///
    /// # Errors
    /// As [`node`](Self::node); [`Error::InvalidValue`] for numbers that are not finite or a direction that is not a unit vector.
    pub fn set_support(&mut self, at: impl Into<At>, support: Support) -> Result<(), Error> {
        let node = self.node(at)?;
        let motions = support.position.iter().chain(match &support.slope {
            SlopeSupport::Prescribed(motion) => Some(motion),
            _ => None,
        });
        for motion in motions {
            require("prescribed motion", if motion.is_finite() { 0.0 } else { f64::NAN }, true, "a number")?;
        }
        if let SlopeSupport::Direction(d) = support.slope {
            require("length of a clamp's direction", d.norm(), (d.norm() - 1.0).abs() < 1e-6, "1")?;
        }
        self.model.set_support(node, support);
        let failure = self.system.factor_mass(&self.model).err();
        self.disturb();
        failure.map_or(Ok(()), |failure| Err(self.refused(self.time(), 0.0, failure)))
    }

    /// Holds the position of a node where it is.
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
        self.state.phase.memory.valid = false;
        Ok(())
    }

    /// Frees a node.
    ///
    /// # Errors
    /// As [`node`](Self::node).
    pub fn release(&mut self, at: impl Into<At>) -> Result<(), Error> {
        self.set_support(at, Support::default())
    }

    /// Point loads.
    pub fn loads(&self) -> &[PointLoad] {
        &self.model.loads
    }

    /// Adds a point load.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an arc length off the cable, [`Error::InvalidValue`] for numbers that are not finite.
    pub fn add_load(&mut self, load: PointLoad) -> Result<(), Error> {
        self.check_arc_length(load.arc_length)?;
        require_finite("force (N)", &load.force)?;
        require_finite("moment (N m)", &load.moment)?;
        require("ramp (s)", load.ramp, load.ramp >= 0.0, ">= 0")?;
        self.model.loads.push(load);
        self.disturb();
        Ok(())
    }

    /// Removes all point loads.
    pub fn clear_loads(&mut self) {
        self.model.loads.clear();
        self.disturb();
    }
}
