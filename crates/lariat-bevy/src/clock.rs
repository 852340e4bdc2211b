//! Fixed host steps from the time of a frame, for programs without an app.

use crate::cables::Cables;
use crate::error::Error;
use crate::event;
use crate::physics::Physics;
use crate::schedule::CableStep;
use bevy_ecs::resource::Resource;
use bevy_ecs::world::World;
use serde::{Deserialize, Serialize};

/// Time that has elapsed and is not yet stepped.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FixedClock {
    /// In s.
    overstep: f64,
    /// The host step in s.
    step: f64,
    /// Largest number of host steps per call of [`advance`]; time beyond it is dropped. Default 8.
    pub max_steps: u32,
}

impl Default for FixedClock {
    fn default() -> Self {
        FixedClock { overstep: 0.0, step: 0.0, max_steps: 8 }
    }
}

impl FixedClock {
    /// Returns the share of a host step that has elapsed since the last one, 0 to 1, for
    /// [`Interpolate`](crate::Interpolate).
    pub fn fraction(&self) -> f64 {
        if self.step > 0.0 { (self.overstep / self.step).clamp(0.0, 1.0) } else { 0.0 }
    }
}

/// Time in s beyond which a frame is told of: in ms it is none.
const LONGEST_FRAME: f64 = 2.0;

/// A frame longer than that was told of.
#[derive(Resource)]
struct LongFrame;

/// Advances by `elapsed` seconds: runs [`CableStep`] as often as host steps are due, and keeps the
/// remaining time for the next call. Returns the number of host steps. Messages are kept for two
/// calls. A time that is negative or not finite counts as zero. At most
/// [`FixedClock::max_steps`] are taken, 8 unless that is set: what is left of a longer time, but for
/// one host step, is dropped.
///
/// # Panics
/// Without [`install`](crate::install).
pub fn advance(world: &mut World, elapsed: f64) -> u32 {
    assert!(world.contains_resource::<Cables>(), "{}", Error::NotInstalled);
    event::update(world);
    let step = f64::from(world.resource::<Physics>().integration_parameters.dt);
    let mut clock = *world.resource::<FixedClock>();
    clock.step = step;
    if elapsed.is_finite() && elapsed > 0.0 {
        clock.overstep += elapsed;
    }
    let mut steps = 0;
    // a frame that equals a step up to rounding is a step
    while step > 0.0 && clock.overstep >= step * (1.0 - 1e-6) && steps < clock.max_steps {
        clock.overstep = (clock.overstep - step).max(0.0);
        world.run_schedule(CableStep);
        steps += 1;
    }
    if steps == clock.max_steps {
        // a spike is dropped without a word; what is longer than any frame is no frame
        if elapsed > LONGEST_FRAME && !world.contains_resource::<LongFrame>() {
            world.insert_resource(LongFrame);
            log::warn!(
                "a frame of {elapsed} s takes {steps} host steps of {step:.4} s, and the rest of it is dropped: times of frames are in s"
            );
        }
        clock.overstep = clock.overstep.min(step);
    }
    *world.resource_mut::<FixedClock>() = clock;
    steps
}
