//! Slack cables that are drawn beside the bodies that they are tied to.
//!
//! # Equation
//!
//! A cable with contact that is laid in arcs, and runs through a collider of a body that it is
//! attached to, is turned about the line between its ends: of 24 planes it takes the one in which
//! the least distance of its centre line from all that it can touch is largest, the nearest to the
//! plane of gravity of several. Where none is free, since its arcs begin behind a face that they
//! leave, they leave along the line between the ends, and are turned likewise.
//!
//! # Validity
//!
//! A cable at rest as it was built, without clamps. One that runs through a body in every plane
//! stays as it is laid, and [`Warning::InCollider`](crate::Warning::InCollider) tells.
//!
//! # References
//!
//! None.
//!
//! # Alternatives considered
//!
//! Refusing it: most ropes on crates begin so.

use crate::contents::Contents;
use crate::error::Error;
use crate::handle::CableHandle;
use crate::read::inside::{deepest_beside, depth, held_beside};
use crate::scales::set::{LEADS, PLANES, SAME_CLEARANCE, SAMPLES};
use lariat_ancf::Cable;
use lariat_ancf::coupling::Coupling;
use rapier::geometry::Collider;
use rapier::pipeline::PhysicsWorld;
use std::f64::consts::TAU;

/// A collider that a cable can touch, and the pieces of the cable that do not touch it.
struct Near<'a> {
    collider: &'a Collider,
    except: Vec<[f64; 2]>,
}

/// Turns the slack cables that have not moved yet out of the bodies that they are attached to:
/// contact may have been given after the attachment.
pub(super) fn draw_all_outside(contents: &mut Contents, world: &PhysicsWorld) -> Result<(), Error> {
    (0..contents.cables.len()).try_for_each(|cable| draw_outside(contents, world, CableHandle(cable as u32)))
}

/// Turns a slack cable out of the bodies that it is attached to, if it runs through one.
pub(super) fn draw_outside(contents: &mut Contents, world: &PhysicsWorld, handle: CableHandle) -> Result<(), Error> {
    let Some(slot) = contents.cables.get(handle.0 as usize) else { return Ok(()) };
    let Some(cable) = outside(contents, world, (handle, &slot.cable)) else { return Ok(()) };
    *contents.cable_mut(handle)? = cable;
    Ok(())
}

/// Returns a slack cable turned out of the bodies to which the one in the set is attached; `None`
/// if it runs through none, or cannot be turned out.
pub(super) fn outside(
    contents: &Contents,
    world: &PhysicsWorld,
    (handle, drawn): (CableHandle, &Cable),
) -> Option<Cable> {
    let slot = contents.cables.get(handle.0 as usize)?;
    if drawn.effects().contact.is_none() || !drawn.can_turn_slack() {
        return None;
    }
    let touched = world.colliders.iter().map(|(_, c)| c).filter(|c| !c.is_sensor() && slot.rules.allow(c));
    let near: Vec<Near<'_>> =
        touched.map(|collider| Near { collider, except: held_beside(contents, handle, drawn, collider) }).collect();
    // what it is attached to has such pieces
    let own = |near: &&Near<'_>| !near.except.is_empty();
    if !near.iter().filter(own).any(|near| runs_through(drawn, near)) {
        return None;
    }
    LEADS.iter().find_map(|lead| clearest(drawn, &near, *lead))
}

fn runs_through(cable: &Cable, near: &Near<'_>) -> bool {
    deepest_beside(cable, near.collider, &near.except).is_some()
}

/// Returns a slack cable in the plane in which it is clearest; `None` if it runs through a collider
/// in each.
fn clearest(slack: &Cable, near: &[Near<'_>], lead: f64) -> Option<Cable> {
    let mut best: Option<(f64, Cable)> = None;
    for plane in 0..PLANES {
        // 0, 1, -1, 2, -2 ...
        let turn = if plane % 2 == 0 { -(plane as f64) / 2.0 } else { (plane as f64 + 1.0) / 2.0 };
        let mut cable = slack.clone();
        if !cable.turn_slack(turn * TAU / PLANES as f64, lead) || near.iter().any(|near| runs_through(&cable, near)) {
            continue;
        }
        let clear = clearance(&cable, near);
        // of planes that are equal but for rounding, the first
        if best.as_ref().is_none_or(|(most, _)| clear > most + SAME_CLEARANCE * cable.length()) {
            best = Some((clear, cable));
        }
    }
    best.map(|(_, cable)| cable)
}

/// Returns the least distance in m of a cable from what it can touch; negative inside.
fn clearance(cable: &Cable, near: &[Near<'_>]) -> f64 {
    let count = SAMPLES * cable.elements().len();
    let places = (0..=count).map(|k| cable.length() * k as f64 / count as f64);
    let mut least = f64::INFINITY;
    for s in places {
        let Ok(sample) = cable.sample(s) else { continue };
        for near in near.iter().filter(|near| !near.except.iter().any(|[from, to]| (from..=to).contains(&&s))) {
            let (distance, is_inside) = depth(near.collider, &sample.position);
            least = least.min(if is_inside { -distance } else { distance });
        }
    }
    least
}
