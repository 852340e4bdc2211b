//! The error type of this crate.

use bevy_ecs::entity::Entity;
use lariat_ancf::warning::Interface;
use thiserror::Error as ThisError;

/// The error type of this crate.
#[derive(Clone, Debug, PartialEq, ThisError)]
#[non_exhaustive]
pub enum Error {
    /// An entity without a [`Cable`](crate::Cable), or one that was spawned before
    /// [`install`](crate::install) and waits for the first host step.
    #[error("entity {0} has no cable")]
    NotACable(Entity),
    /// A cable whose description cannot be built.
    #[error("the cable of entity {entity} could not be built: {}", Interface::Bevy.text(.reason))]
    NotBuilt {
        /// The entity of the cable.
        entity: Entity,
        /// Why it could not be built.
        reason: lariat_ancf::Error,
    },
    /// A junction of fewer than two points.
    #[error("a junction needs two points of cables or more")]
    TooFewCables,
    /// An attachment to an entity without a body.
    #[error("entity {0} has no body")]
    NotABody(Entity),
    /// An attachment of which an end is missing: it was not given, or its entity was despawned.
    #[error("an attachment has no {0}: none was given, or that entity was despawned")]
    Incomplete(&'static str),
    /// A [`BreakForce`](crate::BreakForce) that is not positive.
    #[error("the force at which an attachment breaks is {0} N: must be > 0")]
    BreakForce(f64),
    /// An entity without a [`Sheave`](crate::Sheave) over which a cable runs.
    #[error("entity {0} has no sheave over which a cable runs")]
    NotASheave(Entity),
    /// From the mechanics of a cable.
    #[error("{}", Interface::Bevy.text(.0))]
    Cable(#[from] lariat_ancf::Error),
    /// From the coupling to bodies.
    #[error("{}", Interface::Bevy.text(.0))]
    Coupling(#[from] lariat_rapier::Error),
    /// A host engine that takes several Rapier steps between [`BeforeEngine`](crate::BeforeEngine)
    /// and [`AfterEngine`](crate::AfterEngine).
    #[error("the host engine is set to {substeps} substeps, cables need 1: shorten the time step instead")]
    Substeps {
        /// Rapier steps per host step.
        substeps: usize,
    },
    /// A host engine that takes a varying number of Rapier steps between
    /// [`BeforeEngine`](crate::BeforeEngine) and [`AfterEngine`](crate::AfterEngine).
    #[error(
        "the host engine takes a varying number of steps per frame, cables need one: use a fixed time step without substeps \
         in a fixed schedule"
    )]
    VaryingSteps,
    /// A body of another engine, which a [`Snapshot`](crate::Snapshot) cannot hold.
    #[error("the body of attachment {attachment} is not in the resource Physics: a snapshot cannot hold it")]
    ForeignBodies {
        /// An attachment to such a body.
        attachment: Entity,
    },
    /// Bytes that are no saved [`Snapshot`](crate::Snapshot), or are damaged.
    #[error(transparent)]
    Seal(#[from] lariat_ancf::seal::SealError),
    /// Bytes under the seal of a [`Snapshot`](crate::Snapshot) that hold none.
    #[error("not a saved snapshot: {0}")]
    NotASnapshot(String),
    /// A [`Snapshot`](crate::Snapshot) that cannot be saved.
    #[error("this snapshot cannot be saved: {0}")]
    NotWritten(String),
    /// The schedules and resources of [`install`](crate::install) are missing.
    #[error("this world has no cables: call lariat_bevy::install first")]
    NotInstalled,
}
