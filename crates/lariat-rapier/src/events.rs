//! Events of a host step.

use crate::body::unsettled::Unsettled;
use crate::contents::gaps::OpenGap;
use crate::handle::{AttachmentHandle, CableHandle};
use lariat_ancf::{Break, Warning};
use rapier::dynamics::RigidBodyHandle;
use rapier::geometry::ColliderHandle;

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
    /// A cable carried more than its [strength](crate::CableSet::set_strength) and broke, or was
    /// [cut](crate::CableSet::cut) since the last host step.
    Broken {
        /// The cable, which is now the part before the break.
        cable: CableHandle,
        /// A new cable: the part behind the break.
        rest: CableHandle,
        /// Why, where and under which load.
        how: Break,
    },
    /// A cable and the anchor of an attachment, which had met, came apart: by more than 2e-3 of the
    /// length of the cable at the end of a host step. Once for each attachment; take shorter steps,
    /// or find what holds the body back.
    GapOpened {
        /// The attachment.
        attachment: AttachmentHandle,
        /// The gap.
        gap: OpenGap,
    },
    /// A body on joints did not move as predicted for a second: the forces of its cables are
    /// not to be trusted. Once for each attachment; the warning
    /// [`Unsettled`](crate::Warning::Unsettled) says what to do.
    Unsettled {
        /// The attachment.
        attachment: AttachmentHandle,
        /// When, and by how much.
        how: Unsettled,
    },
    /// A cable began to touch a collider.
    ContactStarted {
        /// The cable.
        cable: CableHandle,
        /// The collider.
        collider: ColliderHandle,
        /// Arc length of the centre of the forces in m.
        arc_length: f64,
        /// Sum of the normal forces in N.
        force: f64,
    },
    /// A cable no longer touches a collider.
    ContactEnded {
        /// The cable.
        cable: CableHandle,
        /// The collider; it may be gone.
        collider: ColliderHandle,
        /// Arc length in m where it was last touched.
        arc_length: f64,
    },
    /// A cable with contact is in a collider that it cannot touch, one with a shape of the
    /// program's own. Said once for each.
    ContactIgnored {
        /// The cable.
        cable: CableHandle,
        /// The collider.
        collider: ColliderHandle,
    },
    /// Accuracy was reduced: the [budget](crate::Budget) of the host step was spent, or a cable
    /// with error control holds a body in contact that is so light that
    /// [`Settings::max_rapier_steps`](crate::Settings::max_rapier_steps) do not resolve its
    /// vibration: it is then integrated as in fidelity game.
    Degraded {
        /// The cable.
        cable: CableHandle,
        /// Newton iterations of its island in the host step until then.
        iterations: u64,
    },
    /// A cable woke up.
    Awake(CableHandle),
    /// The mesh, the steps, the law or the sizes of a cable are probably not good enough. Each kind
    /// once for each cable.
    Warning {
        /// The cable.
        cable: CableHandle,
        /// What it says about itself, and what to do.
        warning: Warning,
    },
}
