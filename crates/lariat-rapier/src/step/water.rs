//! The forces of water on bodies, over each Rapier step.
//!
//! # Scheme
//! Before a Rapier step is predicted, the mean forces of water over it are added to the user's
//! ([`crate::water`]); after it they are taken off, so that the user's are again what they were. A
//! step that is predicted anew, in another length, has other forces.
//!
//! # Validity
//! The time of the water is that of the cables, so that its wave is in phase with their drag. A set
//! without cables counts its own steps.

use crate::contents::Contents;
use crate::step::HostStep;
use crate::step::settings::Settings;
use rapier::pipeline::PhysicsWorld;

/// Begins a host step, or statics: the water has the time of the cables.
pub(crate) fn begin(contents: &mut Contents) {
    let Contents { water: Some(water), cables, .. } = contents else { return };
    let latest = cables.values().map(|slot| slot.cable.time()).fold(f64::NEG_INFINITY, f64::max);
    if latest.is_finite() {
        water.set_time(latest);
    }
}

/// Adds the forces over the present Rapier step.
pub(super) fn put_on(contents: &mut Contents, world: &mut PhysicsWorld, settings: &Settings, host: &HostStep) {
    let Contents { water: Some(water), attachments, wheels, .. } = contents else { return };
    let coupled = |body| attachments.values().any(|a| a.body == body) || wheels.bodies().any(|(_, drum)| drum == body);
    let step = (host.share().0 * f64::from(host.dt), f64::from(world.integration_parameters.dt));
    water.put_on(world, step, settings.sleep_speed, coupled);
}

/// Takes them off, after a Rapier step or without one.
pub(super) fn take_off(contents: &mut Contents, world: &mut PhysicsWorld, stepped: bool) {
    if let Some(water) = &mut contents.water {
        water.take_off(world, stepped);
    }
}

/// Ends a host step of `dt` (s).
pub(super) fn finish(contents: &mut Contents, dt: f64) {
    if let Some(water) = &mut contents.water {
        water.set_time(water.time() + dt);
    }
}
