//! Solves an island on copies.

use super::joints;
use super::report::Equilibrium;
use crate::body::rigid_body;
use crate::contact::broad::Finder;
use crate::contents::Contents;
use crate::convert::{rotation, to_pose, vector};
use crate::error::Error;
use crate::handle::CableHandle;
use crate::islands::{Island, Member};
use crate::water::StillWater;
use ::nalgebra::{Matrix3, Vector3};
use lariat_ancf::island::{self, Links, PlacedLoad, RigidBody, Sheave};
use lariat_ancf::{At, Cable, EquilibriumFailure, EquilibriumOptions, Motion};
use rapier::dynamics::RigidBodyHandle;
use rapier::math::{Pose, Vector};
use rapier::pipeline::PhysicsWorld;

/// Cables and members of an island in equilibrium.
pub(super) struct Solved {
    pub island: Island,
    pub cables: Vec<Cable>,
    pub members: Vec<RigidBody>,
}

/// A force of constant direction at a point of a body, in statics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyForce {
    /// The body.
    pub body: RigidBodyHandle,
    /// The point in m, in the axes of the body.
    pub point: Vector,
    /// The force in N, in the axes of the world.
    pub force: Vector3<f64>,
}

/// Returns an error of statics with the collider in which a cable would be.
pub(super) fn name_collider(error: lariat_ancf::Error) -> Error {
    match error {
        lariat_ancf::Error::NoEquilibrium {
            cable,
            failure: EquilibriumFailure::Touches { obstacle, arc_length, depth },
            ..
        } => Error::CableTouchesInStatics { cable, collider: crate::contact::collider(obstacle), arc_length, depth },
        error => error.into(),
    }
}

/// Returns an error of statics with the bodies that nothing holds, or the collider in which a cable
/// would be.
fn name_bodies(island: &Island, cables: &[Cable], error: lariat_ancf::Error) -> Error {
    let not_held = matches!(error, lariat_ancf::Error::NoEquilibrium { failure: EquilibriumFailure::NotHeld, .. });
    let bodies: Vec<RigidBodyHandle> = island.bodies().collect();
    if not_held && !bodies.is_empty() {
        return Error::NotHeldInStatics {
            bodies,
            cables: cables.iter().map(|cable| cable.name().to_string()).collect(),
        };
    }
    name_collider(error)
}

/// Solves an island on copies.
pub(super) fn solve(
    contents: &mut Contents,
    finder: &mut Finder,
    world: &PhysicsWorld,
    (island, moving, forces): (Island, &[RigidBodyHandle], &[BodyForce]),
    options: EquilibriumOptions,
    out: &mut Equilibrium,
) -> Result<Solved, Error> {
    let slots = island.cables.iter().filter_map(|&index| contents.cables.get(index));
    let mut cables: Vec<Cable> = slots.map(|slot| slot.cable.clone()).collect();
    for (&index, cable) in island.cables.iter().zip(&mut cables) {
        finder.gather_for_statics(contents, world, (index, cable), moving)?;
    }
    for a in island.supports.iter().filter_map(|&i| contents.attachments.get(i)) {
        let Some(cable) = island.cables.iter().position(|&c| c == a.cable.0 as usize) else { continue };
        let body = world.bodies.get(a.body).ok_or(Error::NoBody(a.body))?;
        let anchor = vector(body.translation()) + rotation(*body.rotation()) * a.anchor;
        let mut support = cables[cable].support(At::Node(a.node))?;
        (support.position, support.attached) = (Some(Motion::fixed(anchor)), false);
        cables[cable].set_support(At::Node(a.node), support)?;
    }
    let joints = joints::of_island(world, &island)?;
    let sheaves: Vec<Sheave> = island.wheels.over(contents, &island.cables).collect();
    let mut members = Vec::new();
    for member in &island.members {
        members.push(match member {
            Member::Body(handle) => free_body(contents, world, *handle, forces)?,
            Member::Driven(handle) => held_body(world, *handle)?,
            Member::Junction(j) => {
                let junction = contents.junctions.get(*j).expect("islands are found anew when a junction ends");
                junction.point(contents.cable(junction.nodes[0].0)?)?
            }
        });
    }
    let in_water = island.members.iter().enumerate().filter_map(|(i, member)| {
        let (Member::Body(body), Some(water)) = (member, &contents.water) else { return None };
        Some((i, water.still(world, *body)?))
    });
    let in_water: Vec<(usize, StillWater)> = in_water.collect();
    let loads: Vec<(usize, &dyn PlacedLoad)> = in_water.iter().map(|(i, load)| (*i, load as &dyn PlacedLoad)).collect();
    let links =
        Links { pins: &island.pins, joints: &joints, sheaves: &sheaves, drums: &island.wheels.drums, loads: &loads };
    let reports = if members.is_empty() && sheaves.is_empty() {
        cables
            .iter_mut()
            .map(|cable| cable.equilibrium_with(options).map_err(name_collider))
            .collect::<Result<Vec<_>, _>>()?
    } else {
        let mut refs: Vec<&mut Cable> = cables.iter_mut().collect();
        let report = island::equilibrium(&mut refs, &mut members, links, options);
        let report = report.map_err(|error| name_bodies(&island, &cables, error))?;
        vec![report; island.cables.len()]
    };
    out.cables.extend(island.cables.iter().map(|&c| CableHandle(c as u32)).zip(reports));
    Ok(Solved { island, cables, members })
}

/// Returns a dynamic body at its place, with gravity and the user's forces.
fn free_body(
    contents: &Contents,
    world: &PhysicsWorld,
    handle: RigidBodyHandle,
    forces: &[BodyForce],
) -> Result<RigidBody, Error> {
    let mut body = rigid_body(world, handle).ok_or(Error::NoBody(handle))?;
    if let Some(exact) = contents.records.get(handle).and_then(|record| record.exact.as_ref()) {
        exact.apply_to(&world.bodies[handle], &mut body);
    }
    if body.inertia == Matrix3::zeros() {
        body.inertia = Matrix3::identity();
    }
    let centre = world.bodies[handle].local_center_of_mass();
    for BodyForce { point, force, .. } in forces.iter().filter(|force| force.body == handle) {
        body.at_points.get_or_insert_default().add(&vector(*point - centre), force)?;
    }
    Ok(body)
}

/// Returns a body that holds its clamps where it is.
fn held_body(world: &PhysicsWorld, handle: RigidBodyHandle) -> Result<RigidBody, Error> {
    let body = world.bodies.get(handle).ok_or(Error::NoBody(handle))?;
    let mut out = RigidBody::new(1.0, Matrix3::identity(), vector(body.translation()))?;
    out.rotation = rotation(*body.rotation());
    out.free = [false; 6];
    Ok(out)
}

/// Returns the poses of the dynamic bodies of an island.
pub(super) fn poses(world: &PhysicsWorld, solved: &Solved) -> Vec<(RigidBodyHandle, Pose)> {
    let members = solved.island.members.iter().zip(&solved.members);
    members
        .filter_map(|(member, end)| {
            let Member::Body(handle) = member else { return None };
            let centre = vector(world.bodies[*handle].local_center_of_mass());
            Some((*handle, to_pose(&(end.position - end.rotation * centre), &end.rotation)))
        })
        .collect()
}
