//! Points along a cable.

use serde::{Deserialize, Serialize};

/// A point of a cable.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum At {
    /// The first node.
    Start,
    /// The last node.
    End,
    /// A node by number, from 0.
    Node(usize),
    /// An arc length of the unstretched cable in m.
    ArcLength(f64),
}

impl From<f64> for At {
    fn from(arc_length: f64) -> Self {
        At::ArcLength(arc_length)
    }
}
