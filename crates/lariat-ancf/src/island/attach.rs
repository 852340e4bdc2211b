//! Giving nodes of a cable to an island, and taking them back.

use crate::at::At;
use crate::cable::Cable;
use crate::error::Error;
use crate::support::{SlopeSupport, Support};
use nalgebra::Vector3;

impl Cable {
    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn attach(&mut self, at: impl Into<At>) -> Result<usize, Error> {
        let node = self.node(at)?;
        let mut support = self.support(At::Node(node))?;
        support.position = None;
        support.attached = true;
        self.set_support(At::Node(node), support)?;
        Ok(node)
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn detach(&mut self, at: impl Into<At>) -> Result<(), Error> {
        let node = self.node(at)?;
        let mut support = self.support(At::Node(node))?;
        support.attached = false;
        support.position = None;
        if let SlopeSupport::Attached(_) = support.slope {
            support.slope = SlopeSupport::Free;
        }
        self.set_support(At::Node(node), support)
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn attach_clamped(&mut self, at: impl Into<At>, along: Option<Vector3<f64>>) -> Result<usize, Error> {
        let node = self.node(at)?;
        let direction = self.direction_of_clamp(node, along)?;
        let support = Support { position: None, slope: SlopeSupport::Attached(direction), attached: true };
        self.hold_along(node, support, direction)?;
        Ok(node)
    }
}
