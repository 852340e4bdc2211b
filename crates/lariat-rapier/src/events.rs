//! Events of a host step.

use crate::handle::{AttachmentHandle, CableHandle};
use rapier::dynamics::RigidBodyHandle;

/// Something that happened during a host step.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Event {
    /// The body of an attachment was removed from the world; the attachment ended and the node of
    /// the cable is free.
    AttachmentEnded {
        /// The attachment.
        attachment: AttachmentHandle,
        /// The removed body.
        body: RigidBodyHandle,
    },
    /// A cable and the bodies attached to it came to rest and fell asleep.
    Asleep(CableHandle),
    /// The tension of a cable exceeded its [strength](crate::CableSet::set_strength), and it broke.
    Broken {
        /// The cable, which is now the part before the break.
        cable: CableHandle,
        /// A new cable: the part behind the break.
        rest: CableHandle,
        /// Arc length of the break in m, unstretched: the new length of the cable.
        arc_length: f64,
        /// The tension in N at which it broke.
        tension: f64,
    },
    /// A cable woke up.
    Awake(CableHandle),
}
