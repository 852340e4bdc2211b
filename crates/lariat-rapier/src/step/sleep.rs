//! Sleep: a cable falls asleep with the bodies attached to it, and wakes up with them.
//!
//! # Scheme
//! Rapier puts a body to sleep that was slower than 0.05 m/s for half a second. On a cable that is
//! too soon: a steel wire that bounces so slowly is far from the tension at which it will rest.
//! Therefore the time until sleep starts anew as long as a cable or a body of the island is faster
//! than
//! [`Settings::sleep_speed`](crate::Settings), the force at an attachment changes by more than
//! [`STEADY_FORCE_CHANGE`] from its value when that time began, a twist changes by more than
//! [`SLEEP_SPIN`], a load ramps, a flow changes, or an
//! end moves. A cable on which a force per length of a program depends on time never sleeps.
//!
//! An island whose bodies all sleep is not stepped; only its clock advances. It wakes up when one
//! of its bodies does, an end or what it can touch moves, a cable is modified, gravity or an
//! attachment changes, or what acts on it: each effect says so
//! ([`Effect::is_steady`](lariat_ancf::effect::Effect::is_steady)).
//!
//! Rapier wakes bodies within its step, by rules of which not all can be foreseen from outside.
//! What it would be given for the prediction that the island rests stands in it meanwhile, as
//! motors ([`Ledger`](crate::body::ledger::Ledger)): a woken body feels its cables in that step as
//! an awake one.
//!
//! # Validity
//! The cable must come to rest; without damping it never does. Of a body that is only touched by a
//! cable, the force of that contact is missing in the step in which Rapier wakes it.

use crate::contents::Contents;
use crate::events::Event;
use crate::handle::CableHandle;
use crate::islands::Island;
use crate::scales::step::{SLEEP_SPIN, STEADY_FORCE_CHANGE};
use lariat_ancf::coupling::Coupling;
use rapier::pipeline::PhysicsWorld;

/// Whether an island sleeps through a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct SleepState {
    /// It is not stepped.
    pub asleep: bool,
    /// An end moved or a cable was modified.
    pub disturbed: bool,
}

/// Decides whether an island sleeps through the coming step, and wakes all of it if not.
/// `ends_moved` tells whether something moves its ends or what it can touch. Bodies slower than
/// `speed` (m/s) may sleep, if nothing that acts changes in the step of `h` (s).
pub(crate) fn update(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    island: &Island,
    ends_moved: bool,
    (h, speed): (f64, f64),
    events: &mut Vec<Event>,
) -> SleepState {
    wake_what_rapier_steps(contents, world, island);
    let count = island.bodies().count();
    let sleeping = island.bodies().filter(|&b| world.bodies[b].is_sleeping()).count();
    let mut disturbed = ends_moved;
    for &c in &island.cables {
        let Some(slot) = contents.cables.get_mut(c) else { continue };
        disturbed |= core::mem::take(&mut slot.modified);
    }
    let undisturbed = sleeping > 0 && !disturbed && is_quiet(contents, island, (h, speed));
    let asleep = undisturbed && sleeping == count;
    if !asleep {
        release(contents, island);
    }
    if sleeping > 0 && !undisturbed {
        for body in island.bodies() {
            world.islands.wake_up(&mut world.bodies, body, true);
        }
    }
    for &c in &island.cables {
        let Some(slot) = contents.cables.get_mut(c) else { continue };
        if slot.asleep != asleep {
            slot.asleep = asleep;
            let cable = CableHandle(c as u32);
            events.push(if asleep { Event::Asleep(cable) } else { Event::Awake(cable) });
        }
    }
    SleepState { asleep, disturbed }
}

/// Wakes bodies that a program put to sleep by hand, and that are among those that Rapier steps:
/// they fall asleep within its step, if they may.
fn wake_what_rapier_steps(contents: &Contents, world: &mut PhysicsWorld, island: &Island) {
    let is_awake = |&c: &usize| contents.cables.get(c).is_some_and(|slot| !slot.asleep);
    if !island.cables.iter().any(is_awake) {
        return;
    }
    for handle in island.bodies() {
        if world.bodies[handle].is_sleeping() && world.islands.active_bodies().any(|active| active == handle) {
            world.bodies[handle].wake_up(false);
        }
    }
}

/// Forgets the forces that hold sleeping bodies: the island is predicted.
fn release(contents: &mut Contents, island: &Island) {
    for index in island.attachments.iter().flatten() {
        if let Some(ledger) = contents.attachments.get_mut(*index).and_then(|a| a.ledger.as_mut()) {
            ledger.rest = None;
        }
    }
}

/// After a step, prevents bodies from falling asleep whose cables still move or change their force.
pub(crate) fn keep_awake(
    contents: &mut Contents,
    world: &mut PhysicsWorld,
    island: &Island,
    disturbed: bool,
    (h, speed): (f64, f64),
) {
    if island.bodies().next().is_none() || !disturbed && is_resting(contents, island, (h, speed)) {
        return;
    }
    for index in island.attachments.iter().flatten() {
        if let Some(a) = contents.attachments.get_mut(*index) {
            a.steady_force = a.reading.force;
        }
    }
    for handle in island.bodies() {
        if let Some(body) = world.bodies.get_mut(handle)
            && !body.is_sleeping()
        {
            body.activation_mut().time_since_can_sleep = 0.0;
        }
    }
}

/// Returns whether an island is slower than `speed` (m/s), under forces that do not change in the
/// next `h` (s).
pub(crate) fn is_resting(contents: &Contents, island: &Island, (h, speed): (f64, f64)) -> bool {
    is_steady(contents, island) && is_quiet(contents, island, (h, speed))
}

/// Returns whether the forces at the attachments of an island are those at which the time until
/// sleep began.
fn is_steady(contents: &Contents, island: &Island) -> bool {
    island.attachments.iter().flatten().filter_map(|&i| contents.attachments.get(i)).all(|a| {
        let force = a.reading.force;
        (force - a.steady_force).norm() <= STEADY_FORCE_CHANGE * force.norm()
    })
}

/// Returns whether the cables of an island are slower than `speed` (m/s), their ends held still,
/// and what acts on them stays the same for `h` (s).
fn is_quiet(contents: &Contents, island: &Island, (h, speed): (f64, f64)) -> bool {
    let mut cables = island.cables.iter().filter_map(|&c| contents.cables.get(c)).map(|slot| &slot.cable);
    cables.all(|cable| {
        let slow = cable.speed() < speed && cable.spin_rate() < SLEEP_SPIN;
        slow && cable.is_loaded_steadily(h) && cable.is_held_still()
    })
}
