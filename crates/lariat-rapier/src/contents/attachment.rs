//! A node of a cable attached to a body, and the force and moment between them.

use crate::body::ledger::Ledger;
use crate::contents::gaps::GapWatch;
use crate::error::Error;
use crate::handle::CableHandle;
use crate::scales::HOST_ROUNDING;
use crate::scales::contents::ATTACHMENT_GAP;
use ::nalgebra::Vector3;
use lariat_ancf::Point;
use lariat_ancf::island::PinAccount;
use rapier::dynamics::RigidBodyHandle;
use rapier::math::Real;
use serde::{Deserialize, Serialize};

/// How a node is attached.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AttachmentKind {
    /// A ball joint: the position of the node. It transmits no moment.
    #[default]
    Ball,
    /// The position of the node and the direction of its tangent: moments reach the body. The
    /// length of the tangent (the stretch) stays free, and so does twist, which these cables do not
    /// have.
    Clamp,
}

impl AttachmentKind {
    /// Attaches with this treatment of a gap.
    pub fn with_gap(self, gap: Gap) -> AttachmentOptions {
        AttachmentOptions { kind: self, gap, direction: None }
    }

    /// Attaches with the tangent, towards growing arc length, along `direction` (body axes, any
    /// length). A ball has no direction.
    pub fn along(self, direction: impl Into<Point>) -> AttachmentOptions {
        AttachmentOptions { kind: self, direction: Some(direction.into().0), ..AttachmentOptions::default() }
    }
}

/// What to do if a point of a cable is not where it is to be attached.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Gap {
    /// Closes a gap of up to this length in m, and rejects a longer one with
    /// [`Error::GapTooLong`](crate::Error::GapTooLong).
    Refuse(f64),
    /// Closes a gap of any length: in the next step, at 10 m/s at most.
    Close,
}

impl Default for Gap {
    /// Rejects gaps of more than 1e-3 m.
    fn default() -> Self {
        Gap::Refuse(ATTACHMENT_GAP)
    }
}

impl Gap {
    /// Returns the length in m up to which a gap is closed.
    pub(crate) fn allowed(self) -> f64 {
        match self {
            Gap::Refuse(limit) => limit,
            Gap::Close => f64::MAX,
        }
    }

    /// Checks the distance between a point of a cable and what it is to be attached to, in m.
    pub(crate) fn check(
        self,
        cable: &lariat_ancf::Cable,
        point: &Vector3<f64>,
        target: &Vector3<f64>,
    ) -> Result<(), Error> {
        let Gap::Refuse(limit) = self else { return Ok(()) };
        let gap = (point - target).norm();
        // far from the origin, Rapier's positions are no more accurate
        let rounding = HOST_ROUNDING * f64::from(Real::EPSILON) * target.amax();
        if gap <= limit + rounding {
            return Ok(());
        }
        Err(Error::GapTooLong { cable: cable.name().to_string(), gap, limit })
    }
}

/// How a node is attached. An [`AttachmentKind`] converts into it, with the default [`Gap`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AttachmentOptions {
    /// Ball or clamp. Default: ball.
    pub kind: AttachmentKind,
    /// What to do if the cable is not at the anchor. Default: reject gaps of more than 1e-3 m.
    pub gap: Gap,
    /// Direction of the tangent in body axes, for a clamp. Default: that of the cable where it is
    /// attached, of a slack cable as it was laid that of the drawing.
    pub direction: Option<Vector3<f64>>,
}

impl From<AttachmentKind> for AttachmentOptions {
    fn from(kind: AttachmentKind) -> Self {
        kind.with_gap(Gap::default())
    }
}

/// A node of a cable attached to a point of a body.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Attachment {
    pub(crate) cable: CableHandle,
    pub(crate) node: usize,
    /// Arc length of the node in m.
    pub(crate) arc_length: f64,
    pub(crate) body: RigidBodyHandle,
    /// Point of the body, in body axes from its origin, in m.
    pub(crate) anchor: Vector3<f64>,
    /// Direction of the tangent in body axes; `None` for a ball.
    pub(crate) direction: Option<Vector3<f64>>,
    pub(crate) ledger: Option<Ledger>,
    /// Last position in m of the anchor on a body with prescribed motion.
    pub(crate) last_anchor: Option<Vector3<f64>>,
    pub(crate) reading: AttachmentReading,
    #[serde(default)]
    pub(crate) watch: GapWatch,
    /// Whether a gap has opened in a step although the body is a link of a multibody: its motion
    /// was not the predicted one.
    #[serde(default)]
    pub(crate) lost_link: bool,
    /// Whether it is at the last node of a cable with a reel, and how many elements had come from
    /// one at the start.
    #[serde(default)]
    pub(crate) at_eye: bool,
    #[serde(default)]
    pub(crate) from_start: i64,
    /// Force in N when the time until sleep last began to count.
    pub(crate) steady_force: Vector3<f64>,
    /// Exchange between cable and body in the Rapier step that was predicted.
    #[serde(skip)]
    pub(crate) predicted: PinAccount,
}

/// Force, moment, gap and work at an attachment after a step. World axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct AttachmentReading {
    /// Force of the cable on the body at the end of the step in N.
    pub force: Vector3<f64>,
    /// Moment of the cable on the body about the anchor at the end of the step in N m; zero for a
    /// ball.
    pub moment: Vector3<f64>,
    /// Position of the node minus that of the anchor in m.
    pub gap: Vector3<f64>,
    /// Work of the cable on the body since the attachment was made, in J.
    pub work: f64,
    /// The part of this work that the cable did not lose, in J: force times the growth of the gap,
    /// summed over Rapier's steps.
    pub residual: f64,
}

impl Attachment {
    /// Returns the cable.
    pub fn cable(&self) -> CableHandle {
        self.cable
    }

    /// Returns the index of the node.
    pub fn node(&self) -> usize {
        self.node
    }

    /// Returns the arc length of the node in m.
    pub fn arc_length(&self) -> f64 {
        self.arc_length
    }

    /// Returns the body.
    pub fn body(&self) -> RigidBodyHandle {
        self.body
    }

    /// Returns how the node is attached.
    pub fn kind(&self) -> AttachmentKind {
        if self.direction.is_some() { AttachmentKind::Clamp } else { AttachmentKind::Ball }
    }

    /// Returns the point of the body, in body axes from its origin, in m.
    pub fn anchor(&self) -> Vector3<f64> {
        self.anchor
    }

    /// Returns force, moment, gap and work after the last step.
    pub fn reading(&self) -> &AttachmentReading {
        &self.reading
    }

    /// Returns the force of the cable on the body at the end of the last step, in N, world axes.
    pub fn force(&self) -> Vector3<f64> {
        self.reading.force
    }

    /// Returns the moment of the cable on the body about the anchor at the end of the last step, in
    /// N m, world axes; zero for a ball.
    pub fn moment(&self) -> Vector3<f64> {
        self.reading.moment
    }

    /// Returns the distance between node and anchor after the last step, in m.
    pub fn gap(&self) -> f64 {
        self.reading.gap.norm()
    }

    /// Returns the work of the cable on the body since the attachment was made, in J.
    pub fn work(&self) -> f64 {
        self.reading.work
    }

    /// Returns the part of this work that the cable did not lose, in J: force times the growth of
    /// the gap, summed over Rapier's steps.
    pub fn residual(&self) -> f64 {
        self.reading.residual
    }
}
