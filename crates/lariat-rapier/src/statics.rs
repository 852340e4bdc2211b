//! Static equilibrium of the cables of a set and the bodies that they carry.
//!
//! # Scheme
//! Each island is solved by [`lariat_ancf::island::equilibrium`], with six unknowns per dynamic body.
//! Fixed, kinematic and disabled bodies hold their cables where they are. Everything is written back
//! only when all islands are in equilibrium.
//!
//! # Validity
//! No joints and no contacts of bodies: a body that has one is an error, before or after the search. Cables with contact lie on the
//! colliders of fixed and kinematic bodies, without friction; one that would be in another collider, or on a sharp edge or something thin, is an error. Contact of
//! cables with each other takes no part. A cable alone may end in an indifferent shape, which its report says.

use crate::body::{is_integrated, rigid_body};
use crate::contact::broad::Finder;
use crate::contents::Contents;
use crate::convert::{rotation, to_pose, vector};
use crate::error::Error;
use crate::handle::CableHandle;
use crate::islands::{Island, Islands, Member};
use crate::ledger::is_ledger;
use crate::record::ExactState;
use ::nalgebra::{Matrix3, Vector3, Vector6};
use lariat_ancf::island::{self, RigidBody};
use lariat_ancf::{At, Cable, EquilibriumFailure, EquilibriumOptions, EquilibriumReport, Motion};
use rapier::dynamics::RigidBodyHandle;
use rapier::geometry::{BoundingVolume, Collider};
use rapier::math::{Pose, Real, Vector};
use rapier::parry::query::contact;
use rapier::pipeline::PhysicsWorld;

/// Distance in m within which two colliders count as touching.
const TOUCH: f64 = 1e-3;

/// The result of [`CableSet::equilibrium`](crate::CableSet::equilibrium).
#[derive(Clone, Debug, Default)]
pub struct Equilibrium {
    /// By cable, the report of its island: cables of one island share it.
    pub cables: Vec<(CableHandle, EquilibriumReport)>,
    /// Dynamic bodies that were moved to their place.
    pub moved: Vec<RigidBodyHandle>,
    /// Attached bodies that were held where they are: fixed, kinematic, disabled or without mass.
    pub held: Vec<RigidBodyHandle>,
    /// Dynamic bodies that no cable is attached to: they were left where they are, and nothing that acts
    /// on them was looked at.
    pub unattached: Vec<RigidBodyHandle>,
}

impl Equilibrium {
    /// Returns whether all islands are stable.
    pub fn is_stable(&self) -> bool {
        self.cables.iter().all(|(_, report)| report.stable)
    }
}

/// Cables and members of an island in equilibrium.
struct Solved<'a> {
    island: &'a Island,
    cables: Vec<Cable>,
    members: Vec<RigidBody>,
}

/// Moves cables and the dynamic bodies attached to them to static equilibrium.
pub(crate) fn equilibrium(
    contents: &mut Contents,
    finder: &mut Finder,
    world: &mut PhysicsWorld,
    options: EquilibriumOptions,
) -> Result<Equilibrium, Error> {
    contents.follow_gravity(world)?;
    let mut islands = Islands::default();
    let found = islands.update(contents, world, &[], &[]);
    // the stepper has not seen these changes
    contents.changed = true;
    found?;
    let mut out = Equilibrium::default();
    let mut solved = Vec::new();
    for island in &islands.list {
        solved.push(solve(contents, finder, world, island, options, &mut out)?);
    }
    let poses: Vec<(RigidBodyHandle, Pose)> = solved.iter().flat_map(|s| poses(world, s)).collect();
    check_contacts(world, &poses)?;
    finder.begin(contents, world, 0.0);
    for solved in &mut solved {
        for (&index, cable) in solved.island.cables.iter().zip(&mut solved.cables) {
            finder.check_statics(contents, world, index, cable)?;
        }
    }
    for a in contents.attachments.values() {
        if !is_integrated(world, a.body) && !out.held.contains(&a.body) {
            out.held.push(a.body);
        }
    }
    let attached = |handle| contents.attachments.values().any(|a| a.body == handle);
    let loose = world.bodies.iter().filter(|(h, b)| is_integrated(world, *h) && !is_ledger(b) && !attached(*h));
    out.unattached = loose.map(|(handle, _)| handle).collect();
    for island in solved {
        write(contents, world, island);
    }
    read_forces(contents, world);
    out.moved = poses.into_iter().map(|(handle, _)| handle).collect();
    Ok(out)
}

/// Returns an error of statics with the collider in which a cable would be.
fn name_collider(error: lariat_ancf::Error) -> Error {
    match error {
        lariat_ancf::Error::NoEquilibrium {
            cable,
            failure: EquilibriumFailure::Touches { obstacle, arc_length, depth },
            ..
        } => Error::CableTouchesInStatics { cable, collider: crate::contact::collider(obstacle), arc_length, depth },
        error => error.into(),
    }
}

/// Solves an island on copies.
fn solve<'a>(
    contents: &mut Contents,
    finder: &mut Finder,
    world: &PhysicsWorld,
    island: &'a Island,
    options: EquilibriumOptions,
    out: &mut Equilibrium,
) -> Result<Solved<'a>, Error> {
    let slots = island.cables.iter().filter_map(|&index| contents.cables.get(index));
    let mut cables: Vec<Cable> = slots.map(|slot| slot.cable.clone()).collect();
    for (&index, cable) in island.cables.iter().zip(&mut cables) {
        finder.gather_for_statics(contents, world, index, cable)?;
    }
    for a in island.supports.iter().filter_map(|&i| contents.attachments.get(i)) {
        let Some(cable) = island.cables.iter().position(|&c| c == a.cable.0 as usize) else { continue };
        let body = world.bodies.get(a.body).ok_or(Error::NoBody(a.body))?;
        let anchor = vector(body.translation()) + rotation(*body.rotation()) * a.anchor;
        let mut support = cables[cable].support(At::Node(a.node))?;
        (support.position, support.attached) = (Some(Motion::fixed(anchor)), false);
        cables[cable].set_support(At::Node(a.node), support)?;
    }
    let mut members = Vec::new();
    for member in &island.members {
        members.push(match member {
            Member::Body(handle) => free_body(contents, world, *handle)?,
            Member::Driven(handle) => held_body(world, *handle)?,
            Member::Junction(j) => {
                let junction = contents.junctions.get(*j).expect("islands are found anew when a junction ends");
                junction.point(contents.cable(junction.nodes[0].0)?)?
            }
        });
    }
    let reports = if members.is_empty() {
        cables
            .iter_mut()
            .map(|cable| cable.equilibrium_with(options).map_err(name_collider))
            .collect::<Result<Vec<_>, _>>()?
    } else {
        let mut refs: Vec<&mut Cable> = cables.iter_mut().collect();
        vec![island::equilibrium(&mut refs, &mut members, &island.pins, options)?; island.cables.len()]
    };
    out.cables.extend(island.cables.iter().map(|&c| CableHandle(c as u32)).zip(reports));
    Ok(Solved { island, cables, members })
}

/// Returns a dynamic body at its place, with gravity and the user's forces.
fn free_body(contents: &Contents, world: &PhysicsWorld, handle: RigidBodyHandle) -> Result<RigidBody, Error> {
    let ledger = |b: RigidBodyHandle| world.bodies.get(b).is_some_and(is_ledger);
    let joined = world.impulse_joints.attached_enabled_joints(handle).any(|(a, b, _, _)| !ledger(a) && !ledger(b));
    if joined || world.multibody_joints.rigid_body_link(handle).is_some() {
        return Err(Error::JointInStatics { body: handle });
    }
    let mut body = rigid_body(world, handle).ok_or(Error::NoBody(handle))?;
    if let Some(exact) = contents.records.get(handle).and_then(|record| record.exact.as_ref()) {
        exact.apply_to(&world.bodies[handle], &mut body);
    }
    if body.inertia == Matrix3::zeros() {
        body.inertia = Matrix3::identity();
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
fn poses(world: &PhysicsWorld, solved: &Solved<'_>) -> Vec<(RigidBodyHandle, Pose)> {
    let members = solved.island.members.iter().zip(&solved.members);
    members
        .filter_map(|(member, end)| {
            let Member::Body(handle) = member else { return None };
            let centre = vector(world.bodies[*handle].local_center_of_mass());
            Some((*handle, to_pose(&(end.position - end.rotation * centre), &end.rotation)))
        })
        .collect()
}

/// Rejects moved bodies that touch another, where they were or where they are to be.
fn check_contacts(world: &PhysicsWorld, poses: &[(RigidBodyHandle, Pose)]) -> Result<(), Error> {
    let solid: Vec<&Collider> =
        world.colliders.iter().map(|(_, c)| c).filter(|c| c.is_enabled() && !c.is_sensor()).collect();
    let after = |c: &Collider| {
        let moved = c.parent().and_then(|parent| poses.iter().find(|(handle, _)| *handle == parent));
        match (moved, c.position_wrt_parent()) {
            (Some((_, pose)), Some(local)) => *pose * *local,
            _ => *c.position(),
        }
    };
    let before = |c: &Collider| match (c.parent().and_then(|b| world.bodies.get(b)), c.position_wrt_parent()) {
        (Some(body), Some(local)) => *body.position() * *local,
        _ => *c.position(),
    };
    for &(handle, _) in poses {
        let own = solid.iter().filter(|c| c.parent() == Some(handle));
        for (a, b) in own.flat_map(|a| solid.iter().map(move |b| (a, b))) {
            if b.parent() == Some(handle) || !a.collision_groups().test(b.collision_groups()) {
                continue;
            }
            for (at, to) in [(before(a), before(b)), (after(a), after(b))] {
                let near = a.shape().compute_aabb(&at).loosened(TOUCH as Real);
                // pairs of shapes that parry does not compare cannot collide in Rapier either
                if near.intersects(&b.shape().compute_aabb(&to))
                    && matches!(contact(&at, a.shape(), &to, b.shape(), TOUCH as Real), Ok(Some(_)))
                {
                    return Err(Error::ContactInStatics { body: handle, other: b.parent() });
                }
            }
        }
    }
    Ok(())
}

/// Writes an island in equilibrium to the set and the world.
fn write(contents: &mut Contents, world: &mut PhysicsWorld, solved: Solved<'_>) {
    let poses = poses(world, &solved);
    let Solved { island, cables, members } = solved;
    for (&index, cable) in island.cables.iter().zip(cables) {
        if let Some(slot) = contents.cables.get_mut(index) {
            (slot.cable, slot.modified, slot.asleep) = (cable, true, false);
        }
    }
    for (handle, pose) in poses {
        let body = &mut world.bodies[handle];
        body.set_position(pose, true);
        body.set_linvel(Vector::ZERO, true);
        body.set_angvel(Vector::ZERO, true);
        let end = island.members.iter().position(|m| *m == Member::Body(handle)).map(|m| &members[m]);
        let record = contents.records.record_mut(handle);
        record.reaction = Vector6::zeros();
        let still = (Vector3::zeros(), Vector3::zeros());
        record.exact = end.map(|end| ExactState::new(end, still, body));
    }
}

/// Updates the readings of all attachments.
fn read_forces(contents: &mut Contents, world: &PhysicsWorld) {
    let Contents { cables, attachments, records, .. } = contents;
    for a in attachments.values_mut() {
        let (Some(slot), Some(body)) = (cables.get_mut(a.cable.0 as usize), world.bodies.get(a.body)) else { continue };
        let (force, moment) = slot.cable.pull(a.node);
        let anchor = match records.get(a.body).and_then(|record| record.exact.as_ref()) {
            Some(exact) => exact.point(&(a.anchor - vector(body.local_center_of_mass()))),
            None => vector(body.translation()) + rotation(*body.rotation()) * a.anchor,
        };
        a.reading.force = force;
        a.reading.moment = if a.direction.is_some() { moment } else { Vector3::zeros() };
        a.reading.gap = slot.cable.node_position(a.node) - anchor;
        a.steady_force = force;
    }
}
