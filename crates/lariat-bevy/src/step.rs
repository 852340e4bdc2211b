//! One host step, taken apart into systems.

use crate::diagnostics::{Diagnostics, Stage};
use crate::error::Error;
use crate::event::{Notice, StepRefused};
use crate::schedule::RapierStep;
use crate::world::{AllCables, Cables, Physics, bring_home, lend_out};
use bevy_ecs::entity::Entity;
use bevy_ecs::prelude::ResMut;
use bevy_ecs::world::World;
use std::time::Instant;

/// Runs [`RapierStep`] as often as a host step has Rapier steps.
pub(crate) fn advance(world: &mut World) {
    let begun = begin(world);
    match begun {
        Ok(()) => {
            while world.resource::<Cables>().host.as_ref().is_some_and(lariat_rapier::HostStep::is_unfinished) {
                world.run_schedule(RapierStep);
            }
            finish(world);
        }
        Err(error) => refuse(&mut world.resource_mut::<Cables>(), error),
    }
    world.resource_mut::<Diagnostics>().host_steps += 1;
}

fn begin(world: &mut World) -> Result<(), lariat_rapier::Error> {
    world.resource_scope(|world, mut cables: bevy_ecs::change_detection::Mut<Cables>| {
        let host = cables.set.begin(&mut world.resource_mut::<Physics>())?;
        cables.host = Some(host);
        Ok(())
    })
}

/// Begins a host step that is one Rapier step.
pub(crate) fn begin_one(world: &mut World) {
    let mut cables = world.resource_mut::<Cables>();
    (cables.set.settings.rapier_steps, cables.set.settings.max_rapier_steps) = (1, 1);
    if let Err(error) = begin(world) {
        refuse(&mut world.resource_mut::<Cables>(), error);
    }
    world.resource_mut::<Diagnostics>().host_steps += 1;
}

pub(crate) fn finish(world: &mut World) {
    world.resource_scope(|world, mut cables: bevy_ecs::change_detection::Mut<Cables>| {
        if let Some(host) = cables.host.take() {
            cables.set.finish(&mut world.resource_mut::<Physics>(), host);
        }
    });
}

/// Tells the cables that a refused step concerns.
fn refuse(cables: &mut Cables, error: lariat_rapier::Error) {
    let culprits: Vec<Entity> =
        cables.set.failed_cables().iter().filter_map(|handle| cables.links.cables.get(handle)).copied().collect();
    let culprits = if culprits.is_empty() { vec![Entity::PLACEHOLDER] } else { culprits };
    for entity in culprits {
        cables.notices.push(Notice::Refused(StepRefused { entity, error: Error::Coupling(error.clone()) }));
    }
}

/// Integrates cables and their bodies over the next Rapier step, and hands the motion over.
pub(crate) fn predict(
    mut cables: ResMut<Cables>,
    mut physics: ResMut<Physics>,
    mut of: AllCables,
    mut diagnostics: ResMut<Diagnostics>,
) {
    let start = Instant::now();
    let cables = &mut *cables;
    bring_home(cables, &mut of);
    if let Some(mut host) = cables.host.take() {
        let outcome = cables.set.predict_next(&mut physics, &mut host);
        cables.host = Some(host);
        if let Err(error) = outcome {
            diagnostics.refused_steps += 1;
            refuse(cables, error);
        }
    }
    lend_out(cables, &mut of);
    diagnostics.spent(Stage::Predict, start);
}

/// Rapier's own step; not run where the prediction was refused.
pub(crate) fn engine(cables: ResMut<Cables>, mut physics: ResMut<Physics>, mut diagnostics: ResMut<Diagnostics>) {
    if cables.host.as_ref().is_some_and(lariat_rapier::HostStep::has_failed) {
        return;
    }
    let start = Instant::now();
    physics.step();
    diagnostics.spent(Stage::Engine, start);
}

/// Settles bodies and cables.
pub(crate) fn reconcile(
    mut cables: ResMut<Cables>,
    mut physics: ResMut<Physics>,
    mut of: AllCables,
    mut diagnostics: ResMut<Diagnostics>,
) {
    let start = Instant::now();
    let cables = &mut *cables;
    if cables.host.as_ref().is_some_and(lariat_rapier::HostStep::has_failed) {
        return;
    }
    bring_home(cables, &mut of);
    cables.set.reconcile(&mut physics);
    lend_out(cables, &mut of);
    diagnostics.spent(Stage::Reconcile, start);
}
