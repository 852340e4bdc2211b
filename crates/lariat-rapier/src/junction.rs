//! Cables tied to each other at nodes: a ball joint without mass or body.

use crate::CableHandle;
use lariat_ancf::Cable;
use lariat_ancf::island::{BodyMemory, RigidBody};
use serde::{Deserialize, Serialize};

/// Names a junction of a [`CableSet`](crate::CableSet).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct JunctionHandle(pub(crate) u32);

/// Nodes of cables that share one position.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Junction {
    pub(crate) nodes: Vec<(CableHandle, usize)>,
    /// By node, its arc length in m.
    pub(crate) arc_lengths: Vec<f64>,
    pub(crate) memory: Option<BodyMemory>,
}

impl Junction {
    /// Cables and their nodes.
    pub fn nodes(&self) -> &[(CableHandle, usize)] {
        &self.nodes
    }

    /// The point without mass, where its first node is.
    pub(crate) fn point(&self, first: &Cable) -> Result<RigidBody, lariat_ancf::Error> {
        let node = self.nodes[0].1;
        let mut point = RigidBody::junction(first.node_position(node))?;
        point.velocity = ::nalgebra::Vector3::from_column_slice(&first.velocities()[6 * node..6 * node + 3]);
        point.memory = self.memory;
        Ok(point)
    }
}
