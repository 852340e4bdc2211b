//! What can go wrong between cables and bodies.

use crate::{AttachmentHandle, CableHandle};
use thiserror::Error as ThisError;

/// The error type of this crate.
#[derive(Clone, Debug, PartialEq, ThisError)]
pub enum Error {
    /// From the mechanics of a cable.
    #[error(transparent)]
    Cable(#[from] lariat_ancf::Error),
    /// A handle of a cable that is not, or no longer, in the set.
    #[error("no cable {0:?} in this set")]
    NoCable(CableHandle),
    /// A handle of an attachment that is not, or no longer, in the set.
    #[error("no attachment {0:?} in this set")]
    NoAttachment(AttachmentHandle),
    /// A body that is not in the world.
    #[error("no body {0:?} in this world")]
    NoBody(rapier::dynamics::RigidBodyHandle),
    /// A node that already holds to a body.
    #[error("cable {cable:?}: node {node} is attached already")]
    AlreadyAttached {
        /// Name of the cable.
        cable: String,
        /// The node.
        node: usize,
    },
    /// A body whose state is not finite.
    #[error("body {body:?} has a {what} that is not finite at t = {time} s")]
    BodyNotFinite {
        /// The body.
        body: rapier::dynamics::RigidBodyHandle,
        /// Position, velocity, force or mass.
        what: &'static str,
        /// Time in s.
        time: f64,
    },
}
