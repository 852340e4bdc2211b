//! A node of a cable held to a body.

use crate::CableHandle;
use ::nalgebra::Vector3;
use rapier::dynamics::{ImpulseJointHandle, RigidBodyHandle};
use serde::{Deserialize, Serialize};

/// Names an attachment of a [`CableSet`](crate::CableSet).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct AttachmentHandle(pub(crate) u32);

/// A node of a cable held to a point of a body.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Attachment {
    pub(crate) cable: CableHandle,
    pub(crate) node: usize,
    pub(crate) body: RigidBodyHandle,
    /// Point of the body, in body axes from its origin, in m.
    pub(crate) anchor: Vector3<f64>,
    pub(crate) ledger: Option<Ledger>,
    pub(crate) gap: f64,
}

/// The heavy body and the joint through which a pinned body feels its cable within Rapier's step.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Ledger {
    pub body: RigidBodyHandle,
    pub joint: ImpulseJointHandle,
}

impl Attachment {
    /// The cable.
    pub fn cable(&self) -> CableHandle {
        self.cable
    }

    /// The node of the cable.
    pub fn node(&self) -> usize {
        self.node
    }

    /// The body.
    pub fn body(&self) -> RigidBodyHandle {
        self.body
    }

    /// Distance of node and anchor after the last step, in m.
    pub fn gap(&self) -> f64 {
        self.gap
    }
}

/// Something that happened to cables during a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// A body went away; its attachment with it, and the cable's node is free.
    AttachmentEnded {
        /// The attachment.
        attachment: AttachmentHandle,
        /// The body it held to.
        body: RigidBodyHandle,
    },
}
