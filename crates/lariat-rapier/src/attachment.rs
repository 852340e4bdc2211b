//! A node of a cable held to a body, and what passes through it.

use crate::CableHandle;
use ::nalgebra::Vector3;
use lariat_ancf::island::PinAccount;
use rapier::dynamics::{ImpulseJointHandle, RigidBodyHandle};
use serde::{Deserialize, Serialize};

/// Names an attachment of a [`CableSet`](crate::CableSet).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct AttachmentHandle(pub(crate) u32);

/// How a node is held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AttachmentKind {
    /// Its position: a ball joint.
    #[default]
    Ball,
    /// Its position and the direction of its tangent: moments reach the body. The length of the tangent, the stretch, is free; so
    /// is twist, which these cables do not have.
    Clamp,
}

/// A node of a cable held to a point of a body.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Attachment {
    pub(crate) cable: CableHandle,
    pub(crate) node: usize,
    /// Of the node, in m.
    pub(crate) arc_length: f64,
    pub(crate) body: RigidBodyHandle,
    /// Point of the body, in body axes from its origin, in m.
    pub(crate) anchor: Vector3<f64>,
    /// Of a clamp, the tangent in body axes.
    pub(crate) direction: Option<Vector3<f64>>,
    pub(crate) ledger: Option<Ledger>,
    /// Where the anchor of a body that feels nothing was last, in m.
    pub(crate) placed: Option<Vector3<f64>>,
    pub(crate) account: Account,
    /// The force with which the body's patience to sleep began, in N.
    pub(crate) steady: Vector3<f64>,
    /// What passed in the Rapier step that was predicted.
    #[serde(skip)]
    pub(crate) passed: PinAccount,
}

/// What passed through an attachment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Account {
    pub force: Vector3<f64>,
    pub moment: Vector3<f64>,
    /// Node less anchor, in m.
    pub gap: Vector3<f64>,
    pub work: f64,
    pub residual: f64,
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

    /// The point of the cable, as arc length in m.
    pub fn arc_length(&self) -> f64 {
        self.arc_length
    }

    /// The body.
    pub fn body(&self) -> RigidBodyHandle {
        self.body
    }

    /// How the node is held.
    pub fn kind(&self) -> AttachmentKind {
        if self.direction.is_some() { AttachmentKind::Clamp } else { AttachmentKind::Ball }
    }

    /// The point of the body, in body axes from its origin, in m.
    pub fn anchor(&self) -> Vector3<f64> {
        self.anchor
    }

    /// Force of the cable on the body at the end of the last step, in N, world axes.
    pub fn force(&self) -> Vector3<f64> {
        self.account.force
    }

    /// Moment of the cable on the body about the anchor at the end of the last step, in N m, world axes; zero for a ball.
    pub fn moment(&self) -> Vector3<f64> {
        self.account.moment
    }

    /// Distance of node and anchor after the last step, in m.
    pub fn gap(&self) -> f64 {
        self.account.gap.norm()
    }

    /// Work of the cable on the body since the attachment was made, in J.
    pub fn work(&self) -> f64 {
        self.account.work
    }

    /// What of this work the cable did not lose, in J: force times the growth of the gap, summed over Rapier's steps.
    pub fn residual(&self) -> f64 {
        self.account.residual
    }
}
