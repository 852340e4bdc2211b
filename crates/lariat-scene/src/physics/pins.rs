//! Attachments in the coupling's own terms: the only place that holds cables to bodies and reads what passes there.

use super::convert::to_vector;
use lariat_ancf::{At, Vector3};
use lariat_rapier::rapier::dynamics::RigidBodyHandle;
use lariat_rapier::rapier::prelude::PhysicsWorld;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableHandle, CableSet, Error};

/// What passes at an attachment.
#[derive(Clone, Copy, Debug, Default)]
pub struct Passing {
    /// Force of the cable on the body in N.
    pub force: Vector3<f64>,
    /// Moment about the anchor on the body in N m.
    pub moment: Vector3<f64>,
    /// Distance between node and anchor in m.
    pub gap: f64,
    /// Work of the cable on the body so far in J.
    pub work: f64,
}

/// Holds the point of a cable at an arc length (m) to a point of a body in its axes, or to where the cable is if none is given, with
/// its tangent if `clamp`.
pub fn attach(
    set: &mut CableSet,
    world: &PhysicsWorld,
    (cable, arc_length): (CableHandle, f64),
    (body, anchor): (RigidBodyHandle, Option<Vector3<f64>>),
    clamp: bool,
) -> Result<AttachmentHandle, Error> {
    let (at, pin) = (At::ArcLength(arc_length), if clamp { AttachmentKind::Clamp } else { AttachmentKind::Ball });
    match anchor {
        None => set.attach_here(world, cable, at, body, pin),
        Some(anchor) => set.attach(world, cable, at, body, to_vector(&anchor), pin),
    }
}

/// What passes at an attachment after the last step.
pub fn passing(set: &CableSet, attachment: AttachmentHandle) -> Result<Passing, Error> {
    let a = set.attachment(attachment)?;
    Ok(Passing { force: a.force(), moment: a.moment(), gap: a.gap(), work: a.work() })
}
