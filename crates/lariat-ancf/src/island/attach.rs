//! Giving nodes of a cable to an island, and taking them back.

use super::hold::vector;
use crate::at::At;
use crate::cable::Cable;
use crate::error::Error;
use crate::support::{SlopeSupport, Support};

impl Cable {
    /// Gives the position of a node to an island: it will follow the body that a
    /// [`PinConstraint`](super::PinConstraint) names.
    ///
    /// # Errors
    /// As [`node`](Self::node).
    pub fn attach(&mut self, at: impl Into<At>) -> Result<usize, Error> {
        let node = self.node(at)?;
        let mut support = self.support(At::Node(node))?;
        support.position = None;
        support.attached = true;
        self.set_support(At::Node(node), support)?;
        Ok(node)
    }

    /// Frees a node that was attached: its position, and its tangent if that was clamped to the
    /// body.
    ///
    /// # Errors
    /// As [`node`](Self::node).
    pub fn detach(&mut self, at: impl Into<At>) -> Result<(), Error> {
        let node = self.node(at)?;
        let mut support = self.support(At::Node(node))?;
        support.attached = false;
        support.position = None;
        if let SlopeSupport::Attached(_) = support.slope {
            support.slope = SlopeSupport::Free;
        }
        self.set_support(At::Node(node), support)
    }

    /// Gives the position of a node and the direction of its tangent to an island, for a
    /// [`PinConstraint`](super::PinConstraint) with a direction.
    ///
    /// # Errors
    /// As [`node`](Self::node); [`Error::NoTangent`] if the tangent has no length.
    pub fn attach_clamped(&mut self, at: impl Into<At>) -> Result<usize, Error> {
        let node = self.node(at)?;
        let Some(tangent) = vector(&self.positions()[6 * node + 3..]).try_normalize(1e-9) else {
            return Err(Error::NoTangent { cable: self.name().to_string(), node });
        };
        let support = Support { position: None, slope: SlopeSupport::Attached(tangent), attached: true };
        self.set_support(At::Node(node), support)?;
        Ok(node)
    }
}
