//! What can go wrong between cables and bodies.

use crate::{AttachmentHandle, CableHandle, JunctionHandle};
use thiserror::Error as ThisError;

/// The error type of this crate.
#[derive(Clone, Debug, PartialEq, ThisError)]
#[non_exhaustive]
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
    /// A handle of a junction that is not, or no longer, in the set.
    #[error("no junction {0:?} in this set")]
    NoJunction(JunctionHandle),
    /// A body that is not in the world.
    #[error("no body {0:?} in this world")]
    NoBody(rapier::dynamics::RigidBodyHandle),
    /// A time step that is negative or not finite.
    #[error("a time step of {dt} s; expected 0 or more")]
    TimeStep {
        /// The step in s.
        dt: f64,
    },
    /// An anchor that is not finite.
    #[error("the anchor on body {body:?} is not finite: {anchor:?} m")]
    AnchorNotFinite {
        /// The body.
        body: rapier::dynamics::RigidBodyHandle,
        /// The anchor in m.
        anchor: ::nalgebra::Vector3<f64>,
    },
    /// A node that already holds to a body or a junction.
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
