//! Loads at which cables break, as components.

use bevy_ecs::component::Component;
use serde::{Deserialize, Serialize};

/// The tension in N above which a cable breaks, compared after each integration step; without it
/// nothing is compared. On bevy_rapier3d, where a host step is one Rapier step, it breaks at the end
/// of the host step.
///
/// The cable breaks at the inner node nearest to the largest tension. The part behind the break is a
/// new entity with the same components, and takes the attachments behind the break. A limit that is
/// not positive, or on a cable of one element, is an error: [`CableFailed`](crate::event::CableFailed).
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BreakTension(pub f64);

/// The strain (stretch over rest stretch less 1) above which a cable breaks, as [`BreakTension`] says.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BreakStrain(pub f64);
