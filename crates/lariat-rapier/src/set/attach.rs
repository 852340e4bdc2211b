//! Attaching the cables of a set to bodies, and tying them to each other.

use super::{CableSet, slack};
use crate::contents::attachment::{Attachment, AttachmentOptions, Gap};
use crate::contents::junction::Junction;
use crate::edit::{attach, join, kink, movement, world_mark};
use crate::error::Error;
use crate::handle::{AttachmentHandle, CableHandle, JunctionHandle};
use lariat_ancf::{At, Point};
use rapier::dynamics::RigidBodyHandle;
use rapier::math::Pose;
use rapier::pipeline::PhysicsWorld;

impl CableSet {
    /// Attaches a point of a cable to a point of a body (body axes from its origin, in m). A node
    /// is inserted there if there is none. The two points may be up to 1e-3 m apart, or as far as
    /// `kind.with_gap(..)` says ([`Gap`](crate::Gap)); a clamp keeps the angle that tangent and
    /// body have now, or holds the tangent in a [direction](crate::AttachmentKind::along): a cable
    /// at rest at time 0 takes the shape of equilibrium between its clamps. At an end of a slack
    /// cable as it was laid, the direction is that of the drawing. A slack cable with contact that
    /// was laid through a body that it is attached to is laid beside it, if there is room.
    ///
    /// # Errors
    /// [`Error::NoCable`], [`Error::NoBody`], [`Error::AlreadyAttached`],
    /// [`Error::AnchorNotFinite`], [`Error::GapTooLong`], [`Error::OtherWorld`], or
    /// [`Error::Cable`] for a point that is not on the cable.
    pub fn attach(
        &mut self,
        world: &PhysicsWorld,
        cable: CableHandle,
        at: impl Into<At>,
        body: RigidBodyHandle,
        anchor: impl Into<Point>,
        kind: impl Into<AttachmentOptions>,
    ) -> Result<AttachmentHandle, Error> {
        let point = (cable, at.into());
        let made = attach::attach(&mut self.contents, world, point, (body, anchor.into().0), kind.into())?;
        slack::draw_outside(&mut self.contents, world, cable)?;
        Ok(made)
    }

    /// As [`attach`](Self::attach), to the point of the body where the point of the cable is now.
    ///
    /// # Errors
    /// As [`attach`](Self::attach).
    pub fn attach_here(
        &mut self,
        world: &PhysicsWorld,
        cable: CableHandle,
        at: impl Into<At>,
        body: RigidBodyHandle,
        kind: impl Into<AttachmentOptions>,
    ) -> Result<AttachmentHandle, Error> {
        let point = (cable, at.into());
        let anchor = attach::anchor_here(&self.contents, world, point, body)?;
        let made = attach::attach(&mut self.contents, world, point, (body, anchor), kind.into())?;
        slack::draw_outside(&mut self.contents, world, cable)?;
        Ok(made)
    }

    /// Moves bodies by a rigid motion in world axes, with the cables that are attached to them and
    /// those tied to these: a teleport without a jolt. Velocities turn with them, strains and
    /// tensions stay; contacts begin anew.
    ///
    /// # Errors
    /// [`Error::HeldInMove`] for a cable that a body which stays, or a support of its own, holds;
    /// [`Error::JointInMove`] for a body that is joined to one that stays, or a link of a
    /// multibody; [`Error::MoveNotFinite`], [`Error::NoBody`], [`Error::OtherWorld`]. Nothing has
    /// moved then.
    pub fn move_bodies(
        &mut self,
        world: &mut PhysicsWorld,
        bodies: &[RigidBodyHandle],
        by: &Pose,
    ) -> Result<(), Error> {
        world_mark::check(&mut self.contents, world)?;
        movement::move_bodies(&mut self.contents, world, bodies, by)
    }

    /// Ends an attachment and frees its node.
    ///
    /// # Errors
    /// [`Error::NoAttachment`].
    pub fn detach(&mut self, world: &mut PhysicsWorld, attachment: AttachmentHandle) -> Result<(), Error> {
        attach::detach(&mut self.contents, world, attachment)
    }

    /// Returns all attachments.
    pub fn attachments(&self) -> impl Iterator<Item = (AttachmentHandle, &Attachment)> {
        self.contents.attachments.iter().map(|(i, a)| (AttachmentHandle(i as u32), a))
    }

    /// Returns an attachment.
    ///
    /// # Errors
    /// [`Error::NoAttachment`].
    pub fn attachment(&self, attachment: AttachmentHandle) -> Result<&Attachment, Error> {
        self.contents.attachment(attachment)
    }

    /// Ties a point of a cable to a point of another, or of itself: they share one position, like a
    /// massless shackle. Nodes are inserted there if there are none. The points may be up to 1e-3 m
    /// apart ([`join_with_gap`](Self::join_with_gap)). If one of the points is part of a junction,
    /// the other joins that junction.
    ///
    /// # Errors
    /// [`Error::NoCable`]; [`Error::GapTooLong`]; [`Error::AlreadyAttached`] for a node that is
    /// attached to a body, or if both are part of junctions; [`Error::Cable`] for a point that is
    /// not on its cable.
    pub fn join(
        &mut self,
        first: (CableHandle, impl Into<At>),
        second: (CableHandle, impl Into<At>),
    ) -> Result<JunctionHandle, Error> {
        self.join_with_gap(first, second, Gap::default())
    }

    /// As [`join`](Self::join), with another treatment of a gap between the two points.
    ///
    /// # Errors
    /// As [`join`](Self::join).
    pub fn join_with_gap(
        &mut self,
        first: (CableHandle, impl Into<At>),
        second: (CableHandle, impl Into<At>),
        gap: Gap,
    ) -> Result<JunctionHandle, Error> {
        join::join(&mut self.contents, (first.0, first.1.into()), (second.0, second.1.into()), gap)
    }

    /// Frees the slope of a cable at a point between its ends, on both sides, as a hinge does:
    /// where a point load or a junction bends a cable that is limp, `sqrt(EI/T)` far below an
    /// element, so that the mesh, which is smooth, would round the corner and positions converge
    /// with the first order. A cable with stiffness wants a mesh that is fine there instead
    /// ([`CableBuilder::finest`](lariat_ancf::CableBuilder::finest), `2 sqrt(EI/T)`). The cable
    /// becomes two that share the point; `cable` keeps the part before it, with a load there.
    /// Returns the handle of the other part and the junction of both, to whose node other cables
    /// can be [joined](Self::join). No moment and no torque goes through it.
    ///
    /// # Errors
    /// [`Error::NoCable`]; [`Error::AlreadyAttached`] for a point that is attached or part of a
    /// junction; [`Error::Cable`] for a point that is not between the ends.
    pub fn add_kink(&mut self, cable: CableHandle, at: impl Into<At>) -> Result<(CableHandle, JunctionHandle), Error> {
        kink::kink(&mut self.contents, cable, at.into())
    }

    /// Unties a cable from a junction; a junction with a single node left ends.
    ///
    /// # Errors
    /// [`Error::NoJunction`]; [`Error::NoCable`] for a cable that is not part of it.
    pub fn leave(&mut self, junction: JunctionHandle, cable: CableHandle) -> Result<(), Error> {
        join::leave(&mut self.contents, junction, cable)
    }

    /// Returns a junction.
    ///
    /// # Errors
    /// [`Error::NoJunction`].
    pub fn junction(&self, junction: JunctionHandle) -> Result<&Junction, Error> {
        self.contents.junction(junction)
    }
}
