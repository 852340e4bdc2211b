//! What cables of an island are pinned to.

use rapier::dynamics::RigidBodyHandle;

/// Something that pins connect cables to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Member {
    /// An integrated body.
    Body(RigidBodyHandle),
    /// A body with prescribed motion.
    Driven(RigidBodyHandle),
    /// A junction, by its index.
    Junction(usize),
}

impl Member {
    /// Returns the handle of an integrated body.
    pub fn body(&self) -> Option<RigidBodyHandle> {
        if let Member::Body(handle) = self { Some(*handle) } else { None }
    }
}
