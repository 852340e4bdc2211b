//! Nodes of cables tied to each other: a ball joint without a body.

use crate::handle::CableHandle;
use lariat_ancf::Cable;
use lariat_ancf::island::{BodyMemory, RigidBody};
use serde::{Deserialize, Serialize};

/// Nodes of cables that share one position.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Junction {
    pub(crate) nodes: Vec<(CableHandle, usize)>,
    /// Arc length in m of each node.
    pub(crate) arc_lengths: Vec<f64>,
    pub(crate) memory: Option<BodyMemory>,
}

impl Junction {
    /// Returns the cables and their nodes.
    pub fn nodes(&self) -> &[(CableHandle, usize)] {
        &self.nodes
    }

    /// Returns the cables and the arc lengths of their nodes in m, in the order in which they were
    /// tied.
    pub fn points(&self) -> impl Iterator<Item = (CableHandle, f64)> {
        self.nodes.iter().map(|(cable, _)| *cable).zip(self.arc_lengths.iter().copied())
    }

    /// Returns the massless point that the island solver moves, at the junction's first node, which
    /// is one of `first`.
    pub(crate) fn point(&self, first: &Cable) -> Result<RigidBody, lariat_ancf::Error> {
        let node = self.nodes[0].1;
        let mut point = RigidBody::junction(first.node_position(node))?;
        point.velocity = ::nalgebra::Vector3::from_column_slice(&first.velocities()[6 * node..6 * node + 3]);
        point.memory = self.memory;
        Ok(point)
    }
}
