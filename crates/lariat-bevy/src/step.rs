//! The systems of one host step.

use crate::cables::Cables;
use crate::diagnostics::{Diagnostics, Stage};
use crate::error::Error;
use crate::event::StepFailed;
use crate::physics::Physics;
use crate::schedule::RapierStep;
use bevy_ecs::entity::Entity;
use bevy_ecs::prelude::ResMut;
use bevy_ecs::world::World;
use lariat_ancf::warning::Interface;
use lariat_rapier::HostStep;

/// Begins a host step.
pub(crate) fn begin(mut cables: ResMut<Cables>, mut physics: ResMut<Physics>, mut diagnostics: ResMut<Diagnostics>) {
    diagnostics.host_steps += 1;
    cables.set.set_interface(Interface::Bevy);
    match cables.set.begin(&mut physics) {
        Ok(host) => cables.host = Some(host),
        Err(error) => report(&mut cables, error),
    }
}

/// Begins a host step that is one Rapier step.
pub(crate) fn begin_single(mut cables: ResMut<Cables>, physics: ResMut<Physics>, diagnostics: ResMut<Diagnostics>) {
    (cables.set.settings.rapier_steps, cables.set.settings.max_rapier_steps) = (1, 1);
    begin(cables, physics, diagnostics);
}

/// Runs [`RapierStep`] until the host step is complete or has failed.
pub(crate) fn run_rapier_steps(world: &mut World) {
    while world.resource::<Cables>().host.as_ref().is_some_and(HostStep::is_unfinished) {
        world.run_schedule(RapierStep);
    }
}

/// Ends a host step, and reports the islands that could not step.
pub(crate) fn finish(mut cables: ResMut<Cables>, mut physics: ResMut<Physics>, mut diagnostics: ResMut<Diagnostics>) {
    let Some(host) = cables.host.take() else { return };
    if cables.set.finish(&mut physics, host).is_ok() {
        return;
    }
    diagnostics.failed_steps += 1;
    let Cables { set, links, events, .. } = &mut *cables;
    for failure in set.failures() {
        for entity in failure.cables.iter().filter_map(|cable| links.cables.get(cable)).map(|link| link.entity) {
            events.push(StepFailed { entity, error: Error::Coupling(failure.error.clone()) }.into());
        }
    }
}

/// Queues [`StepFailed`] for an error that concerns all cables.
fn report(cables: &mut Cables, error: lariat_rapier::Error) {
    cables.events.push(StepFailed { entity: Entity::PLACEHOLDER, error: Error::Coupling(error) }.into());
}

/// Integrates cables with their bodies over the next Rapier step, and applies the motion to
/// Rapier's bodies.
pub(crate) fn predict(mut cables: ResMut<Cables>, mut physics: ResMut<Physics>, mut diagnostics: ResMut<Diagnostics>) {
    diagnostics.start();
    let cables = &mut *cables;
    if let Some(host) = &mut cables.host
        && let Err(error) = cables.set.predict_next(&mut physics, host)
    {
        diagnostics.failed_steps += 1;
        report(cables, error);
    }
    diagnostics.stop(Stage::Predict);
}

/// Steps Rapier, unless the prediction failed.
pub(crate) fn engine(cables: ResMut<Cables>, mut physics: ResMut<Physics>, mut diagnostics: ResMut<Diagnostics>) {
    if cables.host.as_ref().is_some_and(HostStep::has_failed) {
        return;
    }
    diagnostics.start();
    physics.step();
    diagnostics.stop(Stage::Engine);
}

/// Reconciles bodies and cables, unless the prediction failed.
pub(crate) fn reconcile(
    mut cables: ResMut<Cables>,
    mut physics: ResMut<Physics>,
    mut diagnostics: ResMut<Diagnostics>,
) {
    if cables.host.as_ref().is_some_and(HostStep::has_failed) {
        return;
    }
    diagnostics.start();
    cables.set.reconcile(&mut physics);
    diagnostics.stop(Stage::Reconcile);
}
