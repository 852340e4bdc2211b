//! A plugin for apps.

use crate::event::*;
use crate::schedule::{CableStep, install};
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
    /// Steps in another schedule.
    pub fn in_schedule(schedule: impl ScheduleLabel) -> Self {
        LariatPlugin { schedule: schedule.intern() }
    }
}

impl Plugin for LariatPlugin {
    fn build(&self, app: &mut App) {
        macro_rules! add {
            ($($event:ident),*) => { $( app.add_message::<$event>(); )* };
        }
        for_each_event!(add);
        install(app.world_mut());
        #[cfg(feature = "reflect")]
        crate::effects::register(app);
        app.add_systems(self.schedule, |world: &mut World| world.run_schedule(CableStep));
    }
}
