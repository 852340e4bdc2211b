//! The plugin for apps.

use crate::event::*;
use crate::install::install;
use crate::schedule::CableStep;
use bevy_app::{App, FixedUpdate, Plugin};
use bevy_ecs::intern::Interned;
use bevy_ecs::schedule::ScheduleLabel;
use bevy_ecs::world::World;

/// Steps cables and bodies once in each run of a schedule, [`FixedUpdate`] by default.
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

impl Plugin for LariatPlugin {
    fn build(&self, app: &mut App) {
        install_in(app);
        app.add_systems(self.schedule, |world: &mut World| world.run_schedule(CableStep));
    }
}
