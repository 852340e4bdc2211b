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
use crate::islands::Island;
use crate::scales::step::MAX_OWED;
use crate::step::HostStep;
use crate::step::energy::kinetic;
use crate::step::prediction::Prediction;
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

/// Returns into how many parts a step is to be divided so that what Munk's moment lacks in it, of
/// the bodies of an island, has no more of their energy than a [share](MAX_OWED).
pub(super) fn parts(contents: &Contents, island: &Island, prediction: &Prediction) -> f64 {
    let Some(water) = &contents.water else { return 1.0 };
    let members = island.members.iter().zip(prediction.start.iter().zip(&prediction.end));
    let shares = members.filter_map(|(member, (start, end))| {
        let owed = water.owed(member.body()?, &(end.velocity - start.velocity))?;
        let spun = end.world_inertia(&end.rotation).try_inverse()? * owed;
        let all = kinetic(start).max(kinetic(end));
        let energy = owed.dot(&end.angular_velocity).abs() + 0.5 * owed.dot(&spun);
        (all > 0.0).then_some(energy / all)
    });
    shares.fold(0.0, f64::max) / MAX_OWED
}

/// Ends a host step of `dt` (s).
pub(super) fn finish(contents: &mut Contents, dt: f64) {
    if let Some(water) = &mut contents.water {
        water.set_time(water.time() + dt);
    }
}
