//! Reels at the ends of cables.

use bevy_ecs::component::Component;
use lariat_ancf::At;
use serde::{Deserialize, Serialize};

/// A reel at the end of a cable: change its rates as you like. `cables.get(entity)?.reel(At::End)` reads it. One that the cable cannot carry
/// is an error: [`CableFailed`](crate::event::CableFailed).
///
/// ```
/// use bevy_ecs::prelude::*;
/// use lariat_bevy::{Attachment, At, Cable, Cables, Reel};
/// # use lariat_bevy::CableStep;
///
/// let mut world = World::new();
/// lariat_bevy::install(&mut world);
/// let rope = Cable::steel_rope(0.012).between([0.0, -4.0, 0.0], [0.0, 0.0, 0.0]);
/// let rope = world.spawn((rope, Reel::with_rate(-0.5))).id(); // m/s: takes in
/// world.spawn(Attachment::ball(rope, At::End).to_world());
/// for _ in 0..60 {
///     world.run_schedule(CableStep);
/// }
/// assert!(world.resource::<Cables>().get(rope).unwrap().length() < 3.7);
/// ```
#[derive(Component, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Reel(pub lariat_ancf::Reel);

impl Reel {
    /// A reel with a constant rate in m/s: positive pays out.
    pub fn with_rate(rate: f64) -> Self {
        Reel(lariat_ancf::Reel::with_rate(rate))
    }

    /// A reel that comes to a length of cable (m) that is out, with at most a rate (m/s), and stops
    /// there. It speeds up and slows down with its acceleration, 2 m/s^2 unless that is set, and so
    /// does not come to the rate on ways that are shorter than rate^2/acceleration.
    pub fn to_length(length: f64, rate: f64) -> Self {
        Reel(lariat_ancf::Reel::to_length(length, rate))
    }
}

/// A reel at the start of a cable, as [`Reel`] is one at the end.
#[derive(Component, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ReelAtStart(pub lariat_ancf::Reel);

impl ReelAtStart {
    /// A reel with a constant rate in m/s: positive pays out.
    pub fn with_rate(rate: f64) -> Self {
        ReelAtStart(lariat_ancf::Reel::with_rate(rate))
    }

    /// A reel that comes to a length of cable (m) that is out, with at most a rate (m/s), and stops
    /// there. It speeds up and slows down with its acceleration, 2 m/s^2 unless that is set, and so
    /// does not come to the rate on ways that are shorter than rate^2/acceleration.
    pub fn to_length(length: f64, rate: f64) -> Self {
        ReelAtStart(lariat_ancf::Reel::to_length(length, rate))
    }
}

/// The component of the reel at an end.
pub(crate) trait EndReel: Component {
    /// The end.
    const AT: At;

    /// Returns its description.
    fn description(&self) -> &lariat_ancf::Reel;
}

impl EndReel for Reel {
    const AT: At = At::End;

    fn description(&self) -> &lariat_ancf::Reel {
        &self.0
    }
}

impl EndReel for ReelAtStart {
    const AT: At = At::Start;

    fn description(&self) -> &lariat_ancf::Reel {
        &self.0
    }
}
