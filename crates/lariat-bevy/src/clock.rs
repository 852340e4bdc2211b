//! Fixed steps from a frame's time, for programs without an app.

use crate::event;
use crate::schedule::CableStep;
use crate::world::Physics;
use bevy_ecs::resource::Resource;
use bevy_ecs::world::World;

/// Time that passed and is not stepped yet.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct FixedClock {
    overstep: f64,
    step: f64,
    /// Host steps per call of [`advance`] at most; time beyond is dropped. Default 8.
    pub most_steps: u32,
}

impl Default for FixedClock {
    fn default() -> Self {
        FixedClock { overstep: 0.0, step: 0.0, most_steps: 8 }
    }
}

impl FixedClock {
    /// Share of a host step that has passed since the last one, 0 to 1: for [`Interpolate`](crate::Interpolate).
    pub fn fraction(&self) -> f64 {
        if self.step > 0.0 { (self.overstep / self.step).clamp(0.0, 1.0) } else { 0.0 }
    }
}

/// Lets `elapsed` seconds pass: runs [`CableStep`] as often as they are due, and keeps the rest for the next call. Returns the number of host
/// steps. Messages live for two calls.
pub fn advance(world: &mut World, elapsed: f64) -> u32 {
    event::update(world);
    let step = f64::from(world.resource::<Physics>().integration_parameters.dt);
    let mut clock = *world.resource::<FixedClock>();
    clock.step = step;
    if elapsed.is_finite() && elapsed > 0.0 {
        clock.overstep += elapsed;
    }
    let mut steps = 0;
    // a frame that is a step long to rounding is a step
    while step > 0.0 && clock.overstep >= step * (1.0 - 1e-6) && steps < clock.most_steps {
        clock.overstep = (clock.overstep - step).max(0.0);
        world.run_schedule(CableStep);
        steps += 1;
    }
    if steps == clock.most_steps {
        clock.overstep = clock.overstep.min(step);
    }
    *world.resource_mut::<FixedClock>() = clock;
    steps
}
