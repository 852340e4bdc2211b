//! Static equilibrium of the cables of a set and the bodies that they carry.
//!
//! # Scheme
//! Each island is solved by [`lariat_ancf::island::equilibrium`], with six unknowns per dynamic
//! body. Fixed, kinematic and disabled bodies hold their cables where they are. Everything is
//! written back only when all islands are in equilibrium.
//!
//! Water is at rest but for its current: the load of a body in it depends on where this is
//! ([`crate::water`]), so that a float comes to its draught.
//!
//! # Validity
//! Bodies are where their [joints](joints) allow; those that joints connect to a body with a cable
//! move with it. Over sheaves runs what the pulls ask for; a drum must be locked in its rotation,
//! or it has no equilibrium. Cables with contact lie, without friction, on the colliders of all
//! bodies that stay where they are: fixed, kinematic, and dynamic ones that do not move with
//! cables. One that would run through a collider, over a sharp edge or something thin that its
//! samples do not see, is an error. Contact of cables with each other, with themselves, and with
//! bodies that they move takes no part in the search: where the shape that was found is
//! [beyond](passed) what was drawn beside it, or does not stand, and where bodies [touch](contacts)
//! where they were drawn or found or on the way, or [would fall](unheld) on something since nothing
//! holds them, all of the world [comes to rest](relaxation) by its motion. A reel holds by no more
//! than its largest force. A cable alone may end in an indifferent shape, which its report says.

mod contacts;
mod joints;
mod multibody;
mod passed;
mod relaxation;
mod report;
mod solve;
mod unheld;
mod write;

pub use report::{Equilibrium, Relaxed};
pub use solve::BodyForce;

use crate::body::ledger::is_ledger;
use crate::body::{give_mass, is_integrated};
use crate::contact::broad::Finder;
use crate::contents::Contents;
use crate::error::Error;
use crate::handle::CableHandle;
use crate::islands::Islands;
use crate::step::{self, reels};
use contacts::check_contacts;
use lariat_ancf::{Cable, EquilibriumFailure, EquilibriumOptions, EquilibriumReport};
use passed::{Moved, check_passed};
use rapier::dynamics::RigidBodyHandle;
use rapier::math::Pose;
use rapier::pipeline::PhysicsWorld;
use solve::{name_collider, poses, solve};
use write::{read_forces, write};

/// Moves a cable that is in no set to static equilibrium among all colliders of a world, as they
/// stand.
pub(crate) fn among(finder: &mut Finder, world: &PhysicsWorld, cable: &mut Cable) -> Result<EquilibriumReport, Error> {
    finder.gather_still(world, cable)?;
    cable.equilibrium().map_err(name_collider)
}

/// Refuses cables of a set that are beyond what they touch, seen from how they were drawn.
pub(crate) fn check_drawn(
    contents: &Contents,
    finder: &Finder,
    world: &PhysicsWorld,
    drawn: &[(CableHandle, Cable)],
) -> Result<(), Error> {
    let cables = contents.cables.iter();
    let moved = cables.filter_map(|(index, slot)| Moved::of(contents, drawn, (index, &slot.cable)));
    check_passed(contents, finder, world, moved.collect(), &[])
}

/// Moves cables and the dynamic bodies attached to them to static equilibrium; where statics have
/// no law for what touches, all of the world by its motion.
pub(crate) fn equilibrium(
    contents: &mut Contents,
    finder: &mut Finder,
    world: &mut PhysicsWorld,
    (forces, drawn): (&[BodyForce], &[(CableHandle, Cable)]),
    options: EquilibriumOptions,
) -> Result<Equilibrium, Error> {
    let before = relaxation::has_more_contact(contents).then(|| (contents.clone(), relaxation::copy(world)));
    let reason = match search(contents, finder, world, (forces, drawn), options) {
        Err(
            reason @ (Error::Cable(lariat_ancf::Error::NoEquilibrium {
                failure: EquilibriumFailure::Snags { .. }, ..
            })
            | Error::ContactInStatics { .. }
            | Error::CablesPassInStatics { .. }
            | Error::CablePassesBodyInStatics { .. }),
        ) => reason,
        Err(Error::NotHeldInStatics { bodies, cables }) => {
            let lands = unheld::land(world, &bodies, forces);
            let reason = Error::NotHeldInStatics { bodies, cables };
            if !lands {
                return Err(reason);
            }
            reason
        }
        Ok(found) => {
            let Some((contents_before, world_before)) = before else { return Ok(found) };
            let Some(way) = relaxation::moves(contents, world, forces) else { return Ok(found) };
            *contents = contents_before;
            relaxation::replace(world, world_before);
            Error::MovesInStatics { way }
        }
        found => return found,
    };
    let relaxed = relaxation::relax(contents, (finder, world), (forces, drawn))?.ok_or(reason)?;
    read_forces(contents, world);
    Ok(Equilibrium::by_motion(contents, world, relaxed))
}

/// Searches the equilibrium of each island by its forces.
fn search(
    contents: &mut Contents,
    finder: &mut Finder,
    world: &mut PhysicsWorld,
    (forces, drawn): (&[BodyForce], &[(CableHandle, Cable)]),
    options: EquilibriumOptions,
) -> Result<Equilibrium, Error> {
    contents.follow_gravity(world)?;
    step::water::begin(contents);
    contents.held_bodies().for_each(|body| give_mass(world, body));
    let mut islands = Islands::default();
    let found = islands.update(contents, world, &[], &[]);
    // the stepper has not seen these changes
    contents.changed = true;
    found?;
    let mut out = Equilibrium::default();
    let joined = joints::joined(world, &islands.list);
    let moving: Vec<RigidBodyHandle> = joined.iter().flat_map(|island| island.bodies().collect::<Vec<_>>()).collect();
    joined.iter().try_for_each(|island| joints::of_island(world, island).map(drop))?;
    // what touches where it was drawn needs no search
    let drawn_at: Vec<(RigidBodyHandle, Pose)> =
        moving.iter().map(|&handle| (handle, *world.bodies[handle].position())).collect();
    check_contacts(world, &drawn_at)?;
    let mut solved = Vec::new();
    for island in joined {
        solved.push(solve(contents, finder, world, (island, &moving, forces), options, &mut out)?);
    }
    let poses: Vec<(RigidBodyHandle, Pose)> = solved.iter().flat_map(|s| poses(world, s)).collect();
    check_contacts(world, &poses)?;
    let found = solved.iter().flat_map(|s| s.island.cables.iter().zip(&s.cables));
    let moved = found.filter_map(|(&index, found)| Moved::of(contents, drawn, (index, found)));
    check_passed(contents, finder, world, moved.collect(), &poses)?;
    out.held = report::held(contents, world);
    let loose = world.bodies.iter().filter(|(h, b)| is_integrated(world, *h) && !is_ledger(b) && !moving.contains(h));
    out.unattached = loose.map(|(handle, _)| handle).collect();
    // elements are split and merged where material runs over sheaves
    reels::mark(contents);
    for island in solved {
        write(contents, world, island);
    }
    reels::follow(contents);
    read_forces(contents, world);
    if let Some(water) = &mut contents.water {
        for (handle, _) in &poses {
            let own = forces.iter().filter(|force| force.body == *handle);
            water.rest(world, *handle, &own.map(|force| force.force).sum());
        }
    }
    out.moved = poses.into_iter().map(|(handle, _)| handle).collect();
    Ok(out)
}
