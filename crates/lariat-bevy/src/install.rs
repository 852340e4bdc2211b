//! Setting a world up: resources, messages, and the systems of each schedule.

use crate::breaking;
use crate::cables::Cables;
use crate::clock::FixedClock;
use crate::diagnostics::Diagnostics;
use crate::event;
use crate::mesh;
use crate::pending::Pending;
use crate::physics::Physics;
use crate::prepare::{
    self, attachments, bodies, drums, effects, junctions, kinks, passing, reels, removals, sheaves, water,
};
use crate::publish;
use crate::reel::{Reel, ReelAtStart};
use crate::schedule::{AfterEngine, BeforeEngine, CableStep, CableSystems, RapierStep};
use crate::step;
use bevy_ecs::schedule::{IntoScheduleConfigs, Schedule, Schedules};
use bevy_ecs::world::World;

/// Adds resources, messages and schedules to a world. A [`Physics`] that is there is kept. A second
/// call does nothing.
pub fn install(world: &mut World) {
    if world.contains_resource::<Cables>() {
        return;
    }
    world.init_resource::<Physics>();
    world.init_resource::<Cables>();
    world.init_resource::<Pending>();
    world.init_resource::<Diagnostics>();
    world.init_resource::<FixedClock>();
    event::register(world);
    let mut schedules = world.get_resource_or_init::<Schedules>();
    for schedule in [cable_step(), rapier_step(), before_engine(), after_engine()] {
        schedules.insert(schedule);
    }
}

fn cable_step() -> Schedule {
    let mut schedule = Schedule::new(CableStep);
    schedule.configure_sets((CableSystems::Prepare, CableSystems::Publish).chain());
    add_prepare(&mut schedule);
    schedule.add_systems(
        (step::begin, step::run_rapier_steps, step::finish)
            .chain()
            .after(CableSystems::Prepare)
            .before(CableSystems::Publish),
    );
    add_publish(&mut schedule);
    schedule
}

fn rapier_step() -> Schedule {
    let mut schedule = Schedule::new(RapierStep);
    schedule.configure_sets((CableSystems::Predict, CableSystems::Engine, CableSystems::Reconcile).chain());
    schedule.add_systems((
        step::predict.in_set(CableSystems::Predict),
        step::engine.in_set(CableSystems::Engine),
        step::reconcile.in_set(CableSystems::Reconcile),
    ));
    schedule
}

fn before_engine() -> Schedule {
    let mut schedule = Schedule::new(BeforeEngine);
    schedule.configure_sets((CableSystems::Prepare, CableSystems::Predict).chain());
    add_prepare(&mut schedule);
    schedule.add_systems((step::begin_single, step::predict).chain().in_set(CableSystems::Predict));
    schedule
}

fn after_engine() -> Schedule {
    let mut schedule = Schedule::new(AfterEngine);
    schedule.configure_sets((CableSystems::Reconcile, CableSystems::Publish).chain());
    schedule.add_systems((step::reconcile, step::finish).chain().in_set(CableSystems::Reconcile));
    add_publish(&mut schedule);
    schedule
}

fn add_prepare(schedule: &mut Schedule) {
    schedule.add_systems(
        (
            prepare::begin,
            breaking::split_entities,
            removals::remove,
            prepare::build_cables,
            bodies::update,
            water::update,
            effects::watch,
            effects::update,
            junctions::update,
            attachments::update,
            sheaves::update,
            passing::update,
            kinks::update,
            drums::update,
            reels::update::<Reel>,
            reels::update::<ReelAtStart>,
            breaking::set_strengths,
            prepare::copy_coordinates,
            prepare::end,
        )
            .chain()
            .in_set(CableSystems::Prepare),
    );
}

fn add_publish(schedule: &mut Schedule) {
    schedule.add_systems(
        (
            publish::read_events,
            publish::read_attachments,
            publish::count,
            publish::read_bodies,
            breaking::split_entities,
            mesh::draw,
            publish::send,
        )
            .chain()
            .in_set(CableSystems::Publish),
    );
}
