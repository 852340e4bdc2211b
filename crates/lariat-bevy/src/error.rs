//! What can go wrong between entities and cables.

use bevy_ecs::entity::Entity;
use thiserror::Error as ThisError;

/// The error type of this crate.
#[derive(Clone, Debug, PartialEq, ThisError)]
#[non_exhaustive]
pub enum Error {
    /// A cable that is not built: see [`Cable::failure`](crate::Cable::failure).
    #[error("the cable is not built")]
    NotBuilt,
    /// From the mechanics of a cable.
    #[error(transparent)]
    Cable(#[from] lariat_ancf::Error),
    /// From the coupling to bodies.
    #[error(transparent)]
    Coupling(#[from] lariat_rapier::Error),
    /// An attachment to an entity that is no cable.
    #[error("entity {0} is no cable")]
    NotACable(Entity),
    /// An attachment to an entity that is no body.
    #[error("entity {0} is no body")]
    NotABody(Entity),
    /// The schedules and resources of [`install`](crate::install) are missing.
    #[error("no cables in this world: call lariat_bevy::install first")]
    NotInstalled,
}
