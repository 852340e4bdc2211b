//! The plugin for apps.

use crate::event::*;
use crate::install::install;
use crate::physics::Physics;
use crate::schedule::CableStep;
use bevy_app::{App, FixedUpdate, Plugin, Startup};
use bevy_ecs::intern::Interned;
use bevy_ecs::schedule::ScheduleLabel;
use bevy_ecs::system::Res;
use bevy_ecs::world::World;
use bevy_time::{Fixed, Time};

/// Steps cables and bodies once in each run of a schedule, [`FixedUpdate`] by default. There a host
/// step is as long as that of [`Time<Fixed>`](bevy_time::Fixed), 1/64 s unless it is set, and
/// `integration_parameters.dt` of [`Physics`] follows it; in other schedules, and without
/// [`TimePlugin`](bevy_time::TimePlugin), that is the host step; `FixedUpdate` does not run without
/// it, which is logged.
#[derive(Clone, Debug)]
pub struct LariatPlugin {
    schedule: Interned<dyn ScheduleLabel>,
}

impl Default for LariatPlugin {
    fn default() -> Self {
        Self::in_schedule(FixedUpdate)
    }
}

impl LariatPlugin {
    /// Steps once in each run of `schedule`.
    pub fn in_schedule(schedule: impl ScheduleLabel) -> Self {
        LariatPlugin { schedule: schedule.intern() }
    }
}

/// Adds resources, messages, schedules and registered types, but no system: for plugins that step
/// with an engine of their own.
pub fn install_in(app: &mut App) {
    macro_rules! add {
        ($($event:ident),*) => { $( app.add_message::<$event>(); )* };
    }
    for_each_event!(add);
    install(app.world_mut());
    #[cfg(feature = "reflect")]
    crate::components::register(app);
}

/// Says that nothing runs `FixedUpdate`, where nothing does.
fn needs_time(time: Option<Res<Time<Fixed>>>) {
    if time.is_none() {
        log::error!(
            "`LariatPlugin` steps in `FixedUpdate`, and no plugin runs that, so nothing moves: add `TimePlugin`, or take `LariatPlugin::in_schedule(Update)`"
        );
    }
}

/// Sets the host step to that of the app.
fn follow_time(world: &mut World) {
    let Some(step) = world.get_resource::<Time<Fixed>>().map(|time| time.timestep().as_secs_f32()) else { return };
    if let Some(mut physics) = world.get_resource_mut::<Physics>()
        && physics.integration_parameters.dt != step
    {
        physics.integration_parameters.dt = step;
    }
}

impl Plugin for LariatPlugin {
    fn build(&self, app: &mut App) {
        install_in(app);
        let is_fixed = self.schedule == FixedUpdate.intern();
        if is_fixed {
            app.add_systems(Startup, needs_time);
        }
        app.add_systems(self.schedule, move |world: &mut World| {
            if is_fixed {
                follow_time(world);
            }
            world.run_schedule(CableStep);
        });
    }
}
