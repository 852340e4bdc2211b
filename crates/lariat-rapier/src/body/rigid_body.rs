//! Rapier's bodies as the mechanics see them.

use crate::body::record::BodyRecord;
use crate::body::spatial::split_spatial;
use crate::convert::{matrix, rotation, vector};
use crate::error::{BodyQuantity, Error};
use ::nalgebra::{Matrix3, Vector3};
use lariat_ancf::island::RigidBody;
use rapier::dynamics::{LockedAxes, Multibody, RigidBody as RapierBody, RigidBodyHandle};
use rapier::geometry::Collider;
use rapier::pipeline::PhysicsWorld;

/// Returns whether the coupling integrates a body: dynamic, enabled, of finite mass, and not welded
/// to a fixed one. The motion of others is prescribed to their cables.
pub(crate) fn is_integrated(world: &PhysicsWorld, handle: RigidBodyHandle) -> bool {
    let moves = |b: &RapierBody| b.is_dynamic() && b.is_enabled() && b.mass_properties().local_mprops.inv_mass > 0.0;
    world.bodies.get(handle).is_some_and(moves) && !is_welded(world, handle)
}

/// Returns whether a body is a link of a multibody without a degree of freedom on a fixed body: it
/// does not move, and Rapier has no mass matrix that says so.
fn is_welded(world: &PhysicsWorld, handle: RigidBodyHandle) -> bool {
    let link = world.multibody_joints.rigid_body_link(handle);
    let multibody = link.and_then(|link| world.multibody_joints.get_multibody(link.multibody));
    let root = |multibody: &Multibody| world.bodies.get(multibody.root().rigid_body_handle());
    multibody.is_some_and(|m| m.ndofs() == 0 && root(m).is_some_and(RapierBody::is_fixed))
}

/// Makes Rapier compute the mass of a body that has none yet: one that was given a mass besides its
/// colliders has it from its next step on only.
pub(crate) fn give_mass(world: &mut PhysicsWorld, handle: RigidBodyHandle) {
    let massless = |b: &RapierBody| b.is_dynamic() && b.mass_properties().local_mprops.inv_mass == 0.0;
    if world.bodies.get(handle).is_some_and(massless) {
        recompute_mass(world, handle);
    }
}

/// Makes Rapier compute the mass, centre of mass and inertia of a body with what the user changed
/// of them, or of its colliders, since the last step: it does so in its next step only, when the
/// forces of the cables are known. A body without a collider that is enabled keeps its mass, since
/// those of one that was just enabled are so from the next step on only.
pub(crate) fn update_mass(world: &mut PhysicsWorld, handle: RigidBodyHandle) {
    let Some(body) = world.bodies.get(handle) else { return };
    let mut colliders = body.colliders().iter().filter_map(|&c| world.colliders.get(c)).peekable();
    let is_known = colliders.peek().is_none() || colliders.any(Collider::is_enabled);
    if body.is_dynamic() && body.is_enabled() && !body.is_sleeping() && is_known {
        recompute_mass(world, handle);
    }
}

fn recompute_mass(world: &mut PhysicsWorld, handle: RigidBodyHandle) {
    let PhysicsWorld { bodies, colliders, .. } = world;
    bodies[handle].recompute_mass_properties_from_colliders(colliders);
}

/// Returns a body as Rapier holds it: mass, inertia, state in `f64`, and the forces of gravity and
/// the user. A body without inertia does not rotate. `None` if it is not in the world.
pub fn rigid_body(world: &PhysicsWorld, handle: RigidBodyHandle) -> Option<RigidBody> {
    let body = world.bodies.get(handle)?;
    let properties = body.mass_properties();
    let local = &properties.local_mprops;
    let mass = 1.0 / f64::from(local.inv_mass);
    let allowed = |axis: LockedAxes| !properties.flags.contains(axis);
    let inverse = local.inv_principal_inertia;
    let turns = inverse.x > 0.0 && inverse.y > 0.0 && inverse.z > 0.0;
    Some(RigidBody {
        mass,
        inertia: if turns { matrix(&local.reconstruct_inertia_matrix()) } else { Matrix3::zeros() },
        position: vector(body.center_of_mass()),
        rotation: rotation(*body.rotation()),
        velocity: vector(body.linvel()),
        angular_velocity: vector(body.angvel()),
        force: vector(world.gravity) * mass * f64::from(body.gravity_scale()) + vector(body.user_force()),
        torque: vector(body.user_torque()),
        free: [
            allowed(LockedAxes::TRANSLATION_LOCKED_X),
            allowed(LockedAxes::TRANSLATION_LOCKED_Y),
            allowed(LockedAxes::TRANSLATION_LOCKED_Z),
            allowed(LockedAxes::ROTATION_LOCKED_X) && turns,
            allowed(LockedAxes::ROTATION_LOCKED_Y) && turns,
            allowed(LockedAxes::ROTATION_LOCKED_Z) && turns,
        ],
        carried: None,
        turning_torque: Vector3::zeros(),
        carried_at: None,
        gyroscopic: body.gyroscopic_forces_enabled(),
        memory: None,
        unsteadiness: Default::default(),
        at_points: None,
    })
}

/// Reads a body of the world: as [`rigid_body`], with the state in `f64` that its record keeps and
/// the reaction estimate as a further force. A sleeping body stands still.
pub(crate) fn read(
    world: &PhysicsWorld,
    handle: RigidBodyHandle,
    record: &BodyRecord,
    time: f64,
) -> Result<RigidBody, Error> {
    let mut out = rigid_body(world, handle).ok_or(Error::NoBody(handle))?;
    let body = &world.bodies[handle];
    let (force, torque) = split_spatial(&record.reaction);
    out.force += force;
    out.torque += torque;
    if let Some(exact) = &record.exact {
        exact.apply_to(body, &mut out);
    }
    if body.is_sleeping() {
        out.free = [false; 6];
        out.velocity = Vector3::zeros();
        out.angular_velocity = Vector3::zeros();
    }
    let finite = |v: &Vector3<f64>| v.iter().all(|x| x.is_finite());
    let checks = [
        (BodyQuantity::Position, finite(&out.position) && out.rotation.coords.iter().all(|x| x.is_finite())),
        (BodyQuantity::Velocity, finite(&out.velocity) && finite(&out.angular_velocity)),
        (BodyQuantity::Force, finite(&out.force) && finite(&out.torque)),
        (BodyQuantity::Mass, out.mass.is_finite() && out.inertia.iter().all(|x| x.is_finite())),
    ];
    match checks.into_iter().find(|(_, finite)| !finite) {
        None => Ok(out),
        Some((quantity, _)) => Err(Error::BodyNotFinite { body: handle, quantity, time }),
    }
}
