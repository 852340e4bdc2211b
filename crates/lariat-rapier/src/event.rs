//! What happens to cables during a step.

use crate::{AttachmentHandle, CableHandle};
use rapier::dynamics::RigidBodyHandle;

/// Something that happened during a host step.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Event {
    /// A body went away; its attachment with it, and the cable's node is free.
    AttachmentEnded {
        /// The attachment.
        attachment: AttachmentHandle,
        /// The body it held to.
        body: RigidBodyHandle,
    },
    /// A cable and the bodies that it holds came to rest and sleep.
    Asleep(CableHandle),
    /// A cable was woken.
    Awake(CableHandle),
}
