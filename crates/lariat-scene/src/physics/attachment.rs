//! Attachments in terms of the coupling: attaches cables to bodies and reads forces.

use super::convert::to_vector;
use lariat_ancf::{At, Vector3};
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::rapier::prelude::PhysicsWorld;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableHandle, CableSet, Error};

/// Forces and work at an attachment.
#[derive(Clone, Copy, Debug, Default)]
pub struct Transfer {
    /// Force of the cable on the body in N.
    pub force: Vector3<f64>,
    /// Moment about the anchor on the body in N m.
    pub moment: Vector3<f64>,
    /// Distance between node and anchor in m.
    pub gap: f64,
    /// Work that the cable has done on the body in J.
    pub work: f64,
}

/// Attaches the point of a cable at an arc length (m) to an anchor in the axes of a body, or to the point of the body where the
/// cable is; with its tangent if `clamp`.
pub fn attach(
    set: &mut CableSet,
    world: &PhysicsWorld,
    (cable, arc_length): (CableHandle, f64),
    (body, anchor): (RigidBodyHandle, Option<Vector3<f64>>),
    clamp: bool,
) -> Result<AttachmentHandle, Error> {
    let (at, kind) = (At::ArcLength(arc_length), if clamp { AttachmentKind::Clamp } else { AttachmentKind::Ball });
    match anchor {
        None => set.attach_here(world, cable, at, body, kind),
        Some(anchor) => set.attach(world, cable, at, body, to_vector(&anchor), kind),
    }
}

/// Returns forces and work at an attachment after the last step.
pub fn transfer(set: &CableSet, attachment: AttachmentHandle) -> Result<Transfer, Error> {
    let a = set.attachment(attachment)?;
    Ok(Transfer { force: a.force(), moment: a.moment(), gap: a.gap(), work: a.work() })
}
