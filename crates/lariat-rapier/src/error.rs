//! The error type of this crate.

use crate::handle::{AttachmentHandle, CableHandle, JunctionHandle};
use rapier::dynamics::RigidBodyHandle;
use thiserror::Error as ThisError;

/// What can go wrong between cables and bodies.
#[derive(Clone, Debug, PartialEq, ThisError)]
#[non_exhaustive]
pub enum Error {
    /// An error of the mechanics of a cable.
    #[error(transparent)]
    Cable(#[from] lariat_ancf::Error),
    /// The handle of a cable that is not, or no longer, in the set.
    #[error("no cable {0:?} in this set")]
    NoCable(CableHandle),
    /// The handle of an attachment that is not, or no longer, in the set.
    #[error("no attachment {0:?} in this set")]
    NoAttachment(AttachmentHandle),
    /// The handle of a junction that is not, or no longer, in the set.
    #[error("no junction {0:?} in this set")]
    NoJunction(JunctionHandle),
    /// The handle of a body that is not in the world.
    #[error("no body {0:?} in this world")]
    NoBody(RigidBodyHandle),
    /// A time step that is negative or not finite.
    #[error("a time step of {dt} s; expected 0 or more")]
    TimeStep {
        /// The time step in s.
        dt: f64,
    },
    /// An anchor that is not finite.
    #[error("the anchor on body {body:?} is not finite: {anchor:?} m")]
    AnchorNotFinite {
        /// The body.
        body: RigidBodyHandle,
        /// The anchor in m.
        anchor: ::nalgebra::Vector3<f64>,
    },
    /// A node that is already attached to a body or part of a junction.
    #[error("cable {cable:?}: node {node} is attached already")]
    AlreadyAttached {
        /// Name of the cable.
        cable: String,
        /// The node.
        node: usize,
    },
    /// A joint on a body whose equilibrium is asked for.
    #[error("statics compute no joints, and body {body:?} has one: remove it, or step until the body rests")]
    JointInStatics {
        /// The body.
        body: RigidBodyHandle,
    },
    /// A contact of a body whose equilibrium is asked for, where it was or where it was moved.
    #[error("statics compute no contacts, and body {body:?} touches {}: step until it rests", name_of(.other))]
    ContactInStatics {
        /// The body.
        body: RigidBodyHandle,
        /// The other body; `None` for a collider without one.
        other: Option<RigidBodyHandle>,
    },
    /// A body whose state is not finite.
    #[error("body {body:?} has a {quantity} that is not finite at t = {time} s")]
    BodyNotFinite {
        /// The body.
        body: RigidBodyHandle,
        /// The quantity that is not finite.
        quantity: BodyQuantity,
        /// Time in s.
        time: f64,
    },
}

fn name_of(body: &Option<RigidBodyHandle>) -> String {
    body.map_or("a collider".to_string(), |body| format!("body {body:?}"))
}

/// A quantity of a body, named in an [`Error`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BodyQuantity {
    /// Position or rotation.
    Position,
    /// Velocity or angular velocity.
    Velocity,
    /// Force or torque.
    Force,
    /// Mass or inertia.
    Mass,
}

impl core::fmt::Display for BodyQuantity {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            BodyQuantity::Position => "position",
            BodyQuantity::Velocity => "velocity",
            BodyQuantity::Force => "force",
            BodyQuantity::Mass => "mass",
        })
    }
}
