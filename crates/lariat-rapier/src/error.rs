//! The error type of this crate.

use crate::handle::{AttachmentHandle, CableHandle, JunctionHandle, SheaveHandle};
use rapier::dynamics::RigidBodyHandle;
use rapier::geometry::ColliderHandle;
use thiserror::Error as ThisError;

/// What can go wrong between cables and bodies.
#[derive(Clone, Debug, PartialEq, ThisError)]
#[non_exhaustive]
pub enum Error {
    /// An error of the mechanics of a cable.
    #[error(transparent)]
    Cable(#[from] lariat_ancf::Error),
    /// Cables that cannot step with the bodies attached to them: they stay as they are, and all
    /// other cables and bodies go on.
    #[error("cables {cables:?} cannot step at t = {time} s: {cause}")]
    StepRefused {
        /// Names of the cables of the island.
        cables: Vec<String>,
        /// Time in s.
        time: f64,
        /// Why they cannot step.
        cause: Box<Error>,
    },
    /// The handle of a cable that is not, or no longer, in the set.
    #[error("no cable {0:?} in this set")]
    NoCable(CableHandle),
    /// The handle of an attachment that is not, or no longer, in the set.
    #[error("no attachment {0:?} in this set")]
    NoAttachment(AttachmentHandle),
    /// The handle of a junction that is not, or no longer, in the set.
    #[error("no junction {0:?} in this set")]
    NoJunction(JunctionHandle),
    /// A drum that is not a dynamic body: the rate of a reel is set by
    /// [`lariat_ancf::Cable::set_reel_rate`].
    #[error("body {0:?} is not dynamic and cannot be a drum: give the reel the rate of its spin instead")]
    DrumBody(RigidBodyHandle),
    /// A drum that is a link of a multibody, or joined to a dynamic body: their common inertia is
    /// not known to it.
    #[error(
        "drum {0:?} is joined to a dynamic body or a link of a multibody, which is not coupled to its cable: join it by an impulse joint to a fixed or \
        kinematic body, or lock its other axes"
    )]
    DrumJoined(RigidBodyHandle),
    /// The handle of a sheave that is not, or no longer, in the set.
    #[error("no sheave {0:?} in this set")]
    NoSheave(SheaveHandle),
    /// The handle of a body that is not in the world.
    #[error("no body {0:?} in this world")]
    NoBody(RigidBodyHandle),
    /// A body that is to be in water and is not dynamic.
    #[error("body {0:?} is not dynamic: water does not move it")]
    NotDynamic(RigidBodyHandle),
    /// A body in water without a collider that encloses a volume.
    #[error("body {0:?} has no collider that encloses a volume: give the volume that it displaces")]
    NoVolume(RigidBodyHandle),
    /// A number of a body in water that is out of range.
    #[error("body {body:?} in water: {what} of {value}; expected a number of at least 0, and a volume above it")]
    WaterValue {
        /// The body.
        body: RigidBodyHandle,
        /// What it is.
        what: &'static str,
        /// The number.
        value: f64,
    },
    /// A world that is not the one of the attachments: no body is where it belongs, or handles name
    /// other bodies. Nothing has changed.
    #[error("the cables are attached to bodies of another world: step that one, or detach them first")]
    OtherWorld,
    /// An anchor or a second cable too far from the point of the cable.
    #[error(
        "cable {cable:?}: {gap:.3e} m from what it is to be attached to, at most {limit:e} m are allowed (`Gap`); anchors are in the axes of their body"
    )]
    GapTooLong {
        /// Name of the cable.
        cable: String,
        /// Distance in m.
        gap: f64,
        /// Largest distance allowed in m.
        limit: f64,
    },
    /// A time step that is negative or not finite.
    #[error("a time step of {dt} s; expected 0 or more")]
    TimeStep {
        /// The time step in s.
        dt: f64,
    },
    /// An anchor that is not finite.
    #[error("the anchor on body {body:?} is not finite: {anchor:?} m")]
    AnchorNotFinite {
        /// The body.
        body: RigidBodyHandle,
        /// The anchor in m.
        anchor: ::nalgebra::Vector3<f64>,
    },
    /// A node that is already attached to a body or part of a junction.
    #[error("cable {cable:?}: node {node} is attached already")]
    AlreadyAttached {
        /// Name of the cable.
        cable: String,
        /// The node.
        node: usize,
    },
    /// A link of a multibody that moved otherwise than predicted, so that the cable has lost it:
    /// one that is thrown against another body or its limits.
    #[error(
        "cable {cable:?} has lost body {body:?}, a link of a multibody that Rapier moved otherwise than predicted: \
         {gap:.3e} m apart; use impulse joints"
    )]
    LinkLost {
        /// Name of the cable.
        cable: String,
        /// The link.
        body: RigidBodyHandle,
        /// Distance of the node from the anchor in m.
        gap: f64,
    },
    /// A body that is to be moved with its cables, and is joined to one that is not, or a link of a
    /// multibody.
    #[error(
        "body {body:?} cannot be moved with its cables: move all bodies that joints connect at once; links of multibodies cannot be moved"
    )]
    JointInMove {
        /// The body.
        body: RigidBodyHandle,
    },
    /// A direction that is given for a ball.
    #[error("a ball holds no direction of the cable: choose a clamp, or leave the direction out")]
    DirectionOfBall,
    /// A cable on bodies that are to be moved, which something else holds, too.
    #[error(
        "cable {cable:?} cannot be moved with the bodies: something holds it that stays where it is; move that too, or detach it first"
    )]
    HeldInMove {
        /// Name of the cable.
        cable: String,
    },
    /// A motion by which bodies are to be moved that is not finite, or turns by no unit quaternion.
    #[error("bodies cannot be moved by what is not a finite displacement and a rotation")]
    MoveNotFinite,
    /// A joint on a body whose equilibrium is asked for, of a kind that statics do not compute.
    #[error("no equilibrium of body {body:?} is computed: {reason}; step until the body rests")]
    JointInStatics {
        /// The body.
        body: RigidBodyHandle,
        /// What of the joint.
        reason: &'static str,
    },
    /// Bodies and cables that nothing holds against what acts on them: neither a support, a joint
    /// or a body with prescribed motion, nor something on which they would fall and come to rest by
    /// their motion.
    #[error(
        "nothing holds {} against gravity and the users' forces, connected by {}: attach one of the cables to what stays where it is, or put something \
         below on which they come to rest",
        names_of(.bodies),
        cables_of(.cables)
    )]
    NotHeldInStatics {
        /// The dynamic bodies.
        bodies: Vec<RigidBodyHandle>,
        /// Names of the cables that connect them.
        cables: Vec<String>,
    },
    /// A contact of a body whose equilibrium is asked for, where it was, where it was moved or on
    /// its way, in a world that comes to no rest by its motion.
    #[error(
        "statics compute no contacts of bodies, body {body:?} touches {}, and in 30 s of motion not all comes to rest, or something changes with time: \
         step until it rests",
        name_of(.other)
    )]
    ContactInStatics {
        /// The body.
        body: RigidBodyHandle,
        /// The other body; `None` for a collider without one.
        other: Option<RigidBodyHandle>,
    },
    /// Cables that touch each other, themselves, or bodies that they move, with a shape in which
    /// they do not stand, in a world that comes to no rest by its motion.
    #[error(
        "statics compute no contact of cables with each other and with bodies that they move: from what they find something moves by {way:.1e} m in a \
         quarter of a second, and in 30 s of motion not all comes to rest: step until it rests"
    )]
    MovesInStatics {
        /// The largest way in m.
        way: f64,
    },
    /// A cable with contact that would run through a collider in equilibrium: over a sharp edge or
    /// something thin, which the samples of contact do not see.
    #[error(
        "cable {cable:?} would run through collider {collider:?}, {depth:.1e} m deep at {arc_length:.4} m: statics compute contact at samples, which do \
         not see sharp edges and thin things between them: use more elements, or step until it rests"
    )]
    CableTouchesInStatics {
        /// Name of the cable.
        cable: String,
        /// The collider.
        collider: ColliderHandle,
        /// Arc length in m.
        arc_length: f64,
        /// Depth in m.
        depth: f64,
    },
    /// Cables that touch each other, and would be found on the other side of each other: statics
    /// compute no contact between them.
    #[error(
        "cable {cable:?} would pass through {}, near {arc_length:.4} m, from where it was drawn to where it would rest: {}",
        if .cable == .other { "itself".to_string() } else { format!("cable {other:?}") },
        if *.by_motion {
            "in motion from there, too: their contact is too soft for what it carries: give it a stiffness, or draw it on the other side"
        } else {
            "statics compute no contact of cables with each other, and in 30 s of motion not all comes to rest: draw it on the other side, or step until \
             it rests"
        }
    )]
    CablesPassInStatics {
        /// Name of the cable.
        cable: String,
        /// Name of the other one, or its own.
        other: String,
        /// Arc length of the first in m.
        arc_length: f64,
        /// Whether it came to rest there by its motion.
        by_motion: bool,
    },
    /// A cable with contact that would be found in a body which cables move, or on its other side:
    /// statics compute no contact between them.
    #[error(
        "cable {cable:?} would be in body {body:?} or pass through it, near {arc_length:.4} m, from where it was drawn to where it would rest: {}",
        beyond_body(*.by_motion)
    )]
    CablePassesBodyInStatics {
        /// Name of the cable.
        cable: String,
        /// The body.
        body: RigidBodyHandle,
        /// Arc length in m.
        arc_length: f64,
        /// Whether it came to rest there by its motion.
        by_motion: bool,
    },
    /// A body whose state is not finite.
    #[error("body {body:?} has a {quantity} that is not finite at t = {time} s")]
    BodyNotFinite {
        /// The body.
        body: RigidBodyHandle,
        /// The quantity that is not finite.
        quantity: BodyQuantity,
        /// Time in s.
        time: f64,
    },
}

/// Says why a cable would be in a body that cables move, or beyond it, and what to do.
fn beyond_body(by_motion: bool) -> &'static str {
    if by_motion {
        "in motion from there, too: use more elements where it bends around the body, or a stiffness of contact"
    } else {
        "statics compute no contact of cables with bodies that they move, and in 30 s of motion not all comes to rest: step until it rests"
    }
}

impl Error {
    /// Returns the error of a shape beyond what is touched as that of one that was found by motion.
    pub(crate) fn by_motion(mut self) -> Self {
        if let Error::CablesPassInStatics { by_motion, .. } | Error::CablePassesBodyInStatics { by_motion, .. } =
            &mut self
        {
            *by_motion = true;
        }
        self
    }
}

fn names_of(bodies: &[RigidBodyHandle]) -> String {
    let names: Vec<String> = bodies.iter().map(|body| format!("{body:?}")).collect();
    format!("{} {}", if names.len() == 1 { "body" } else { "bodies" }, names.join(", "))
}

fn cables_of(cables: &[String]) -> String {
    let names: Vec<String> = cables.iter().map(|cable| format!("{cable:?}")).collect();
    format!("{} {}", if names.len() == 1 { "cable" } else { "cables" }, names.join(", "))
}

fn name_of(body: &Option<RigidBodyHandle>) -> String {
    body.map_or("a collider".to_string(), |body| format!("body {body:?}"))
}

/// An island of cables and bodies that could not step: it stays as it is, and all others go on.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Failure {
    /// The cables of the island.
    pub cables: Vec<CableHandle>,
    /// The cause, an [`Error::StepRefused`] with the names of the cables.
    pub error: Error,
}

/// A quantity of a body, named in an [`Error`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BodyQuantity {
    /// Position or rotation.
    Position,
    /// Velocity or angular velocity.
    Velocity,
    /// Force or torque.
    Force,
    /// Mass or inertia.
    Mass,
}

impl core::fmt::Display for BodyQuantity {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            BodyQuantity::Position => "position",
            BodyQuantity::Velocity => "velocity",
            BodyQuantity::Force => "force",
            BodyQuantity::Mass => "mass",
        })
    }
}
