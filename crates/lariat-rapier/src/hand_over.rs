//! Giving Rapier the predicted motion, and reading what became of it.

use crate::body::{Exact, Remembered};
use crate::convert::{rotation, to_vector, vector};
use crate::ends::MOST_TURN;
use crate::islands::Given;
use crate::linkage::Linkage;
use crate::{bear, impedance, linkage};
use ::nalgebra::Vector3;
use lariat_ancf::island::RigidBody;
use rapier::dynamics::RigidBodyHandle;
use rapier::math::Real;
use rapier::pipeline::PhysicsWorld;

/// Share by which the learnt reaction follows.
const LEARNING: f64 = 0.3;
/// A body landed where predicted if it is within this many units of `Real`'s rounding.
const ROUNDING: f64 = 32.0;
/// Half of a turn in a substep, in rad, beyond which a tangent says little.
const MOST_HALF_TURN: f64 = 1.2;
/// Rapier's default number of substeps, for which [`ROUNDING`] is meant.
const SUBSTEPS: usize = 4;
/// ... and its velocities within this many times more: Rapier adds up forces that balance.
const VELOCITY_ROUNDING: f64 = 8.0;

/// The angular velocity with which Rapier turns a body as `spin` (rad/s) would: in each substep of `h` (s) it multiplies the attitude by
/// the normalised quaternion (1, w h/2), which is a turn by 2 atan(|w| h/2).
fn linearised(spin: &Vector3<f64>, h: f64) -> Vector3<f64> {
    let half = (0.5 * spin.norm() * h).min(MOST_HALF_TURN);
    if half > 0.0 { spin * (half.tan() / half) } else { *spin }
}

/// Makes Rapier move the body uniformly from where it is to where `end` is, in `h` (s). One that moves with others is struck instead of
/// being given a velocity.
pub(crate) fn give(
    world: &mut PhysicsWorld,
    handle: RigidBodyHandle,
    (start, end): (&RigidBody, &RigidBody),
    linkage: Option<&Linkage>,
    memory: &Remembered,
    h: f64,
) -> Given {
    let gravity = world.gravity;
    let (alone, linked) = (impedance::is_alone(world, handle), impedance::is_linked(world, handle));
    let body = &mut world.bodies[handle];
    let mass = end.mass as Real;
    let linvel = to_vector(&((end.position - vector(body.center_of_mass())) / h));
    let turn = (end.rotation * rotation(*body.rotation()).inverse()).scaled_axis() / h;
    let substeps = world.integration_parameters.num_solver_iterations.max(1) as f64;
    // links of a multibody are turned exactly
    let angvel = match linkage {
        Some(Linkage::Link { .. }) => to_vector(&turn),
        _ => to_vector(&linearised(&turn, h / substeps)),
    };
    let fast = turn.norm() * h > 0.9 * MOST_TURN;
    let weight = vector(gravity).norm() * f64::from(body.gravity_scale()).abs();
    let given = Given {
        linvel,
        angvel,
        centre: body.local_center_of_mass(),
        alone,
        linked,
        rounding: (weight + memory.force.norm() / end.mass) * h,
        own_linvel: body.linvel(),
        own_angvel: body.angvel(),
        user_force: body.user_force(),
        user_torque: body.user_torque(),
        gyroscopic: body.gyroscopic_forces_enabled(),
        fast_rotation: body.is_fast_rotation_allowed(),
        linear_damping: body.linear_damping(),
        angular_damping: body.angular_damping(),
    };
    // joints bear what the body does not move by
    let learnt = linkage::both(&memory.force, &memory.torque);
    let learnt = if linkage.is_some() { linkage::moving(end, &learnt) } else { learnt };
    let (force, torque) = linkage::halves(&learnt);
    let balance = -to_vector(&force) - gravity * (mass * body.gravity_scale());
    body.reset_forces(false);
    body.reset_torques(false);
    body.add_force(balance, false);
    body.add_torque(-to_vector(&torque), false);
    body.enable_gyroscopic_forces(false);
    if fast {
        body.set_allow_fast_rotation(true);
    }
    body.set_linear_damping(0.0);
    body.set_angular_damping(0.0);
    if let Some(linkage) = linkage {
        let wanted = linkage::both(&vector(linvel), &vector(angvel));
        let change = wanted - linkage::both(&start.velocity, &start.angular_velocity);
        // loads on the others do half of their work before the uniform motion, and half after it
        let change = change - linkage.borne().of_body * (0.5 * h);
        bear::balance(world, linkage.borne());
        linkage::load_others(world, handle, linkage, 0.5 * h);
        linkage::strike(world, handle, linkage, &(linkage::inertia(start) * change));
    } else {
        body.set_linvel(linvel, false);
        body.set_angvel(angvel, false);
    }
    given
}

/// Restores the user's forces and settings, which [`give`] put aside.
fn restore(body: &mut rapier::dynamics::RigidBody, given: &Given) {
    body.reset_forces(false);
    body.reset_torques(false);
    body.add_force(given.user_force, false);
    body.add_torque(given.user_torque, false);
    body.enable_gyroscopic_forces(given.gyroscopic);
    body.set_allow_fast_rotation(given.fast_rotation);
    body.set_linear_damping(given.linear_damping);
    body.set_angular_damping(given.angular_damping);
}

/// Undoes [`give`]: the body is as it was.
pub(crate) fn take_back(world: &mut PhysicsWorld, handle: RigidBodyHandle, linkage: Option<&Linkage>, given: &Given) {
    if let Some(linkage) = linkage {
        bear::restore(world, linkage.borne());
        linkage::take_back(world, handle, linkage);
    }
    let body = &mut world.bodies[handle];
    restore(body, given);
    body.set_linvel(given.own_linvel, false);
    body.set_angvel(given.own_angvel, false);
}

/// Settles a body that Rapier put to sleep instead of stepping it: it is where it was, at rest.
pub(crate) fn fall_asleep(
    world: &mut PhysicsWorld,
    handle: RigidBodyHandle,
    (given, linkage): (&Given, Option<&Linkage>),
    memory: &mut Remembered,
) {
    if let Some(linkage) = linkage {
        bear::restore(world, linkage.borne());
    }
    let body = &mut world.bodies[handle];
    restore(body, given);
    if let Some(exact) = &mut memory.exact {
        (exact.velocity, exact.spin) = (Vector3::zeros(), Vector3::zeros());
        (exact.linvel, exact.angvel) = (body.linvel(), body.angvel());
        exact.accelerations = None;
    }
}

/// Restores what [`give`] put aside, and settles the body's state: as predicted if it landed there, else Rapier's position with
/// the velocity that contacts and joints left of the predicted one. `impulse` and `couple` are what motors did to it. Returns whether it deviated.
pub(crate) fn settle(
    world: &mut PhysicsWorld,
    handle: RigidBodyHandle,
    end: &RigidBody,
    (given, linkage): (&Given, Option<&Linkage>),
    memory: &mut Remembered,
    (impulse, couple): (Vector3<f64>, Vector3<f64>),
    h: f64,
) -> bool {
    if let Some(linkage) = linkage {
        bear::restore(world, linkage.borne());
        linkage::refresh(world, handle);
    }
    let body = &mut world.bodies[handle];
    restore(body, given);
    if body.local_center_of_mass() != given.centre {
        // its mass changed under way: what it did says nothing about forces
        memory.forget();
        return true;
    }

    let (before, spin_before) = (vector(given.linvel), vector(given.angvel));
    let (after, spin_after) = (vector(body.linvel()), vector(body.angvel()));
    let deviation = after - before;
    let turn = spin_after - spin_before;
    // every substep rounds
    let substeps = world.integration_parameters.num_solver_iterations.max(SUBSTEPS) as f64 / SUBSTEPS as f64;
    let epsilon = f64::from(Real::EPSILON) * ROUNDING * substeps;
    let reach = vector(body.center_of_mass()).norm().max(1.0);
    let off = (vector(body.center_of_mass()) - end.position).norm();
    let attitude = (rotation(*body.rotation()).inverse() * end.rotation).angle();
    let slow = epsilon * VELOCITY_ROUNDING;
    let landed = off <= epsilon * reach
        && attitude <= epsilon.max(1e-3 * f64::from(Real::EPSILON).sqrt()) * 4.0
        && deviation.norm() <= slow * (before.norm() + given.rounding).max(1e-3)
        && turn.norm() <= slow * spin_before.norm().max(1e-2);

    let still = (1.0 / (1.0 + h * f64::from(given.linear_damping)), 1.0 / (1.0 + h * f64::from(given.angular_damping)));
    let (velocity, spin) = if landed {
        (end.velocity, end.angular_velocity)
    } else {
        // the whole of what cables and loads changed: less of it, and the cables' momentum is no longer what they gave
        (end.velocity + deviation, end.angular_velocity + turn)
    };
    let moved = (vector(body.center_of_mass()) - end.position) / h;
    let turned = (rotation(*body.rotation()) * end.rotation.inverse()).scaled_axis() / h;
    // what motors did is not a reaction; but in a chain of joints they work against each other, and settle on a wrong force without
    let (impulse, couple) = if given.linked { (Vector3::zeros(), Vector3::zeros()) } else { (impulse, couple) };
    // where no other body is near a mechanism, its place tells of joints that Rapier corrects
    let quiet = linkage.is_some_and(|l| l.borne().quiet);
    let place = if quiet { 0.0 } else { 1.0 };
    let change = linkage::both(&(deviation + moved * place), &(turn + turned * place));
    let reaction = if linkage.is_some() { linkage::told(end, &change, quiet) } else { linkage::inertia(end) * change };
    let (force, torque) = linkage::halves(&reaction);
    memory.force += LEARNING * (force - impulse) / h;
    memory.torque += LEARNING * (torque - couple) / h;
    if let Some(linkage) = linkage {
        let change = linkage::both(&(velocity - after), &(spin - spin_after)) - linkage.borne().of_body * (0.5 * h);
        linkage::load_others(world, handle, linkage, 0.5 * h);
        linkage::strike(world, handle, linkage, &(linkage::inertia(end) * change));
        if let Linkage::Chain(_) = linkage {
            bear::damp(world, linkage.borne(), h);
        }
        let body = &mut world.bodies[handle];
        if let Linkage::Chain(_) = linkage {
            // Rapier damps no links
            body.set_linvel(to_vector(&(vector(body.linvel()) * still.0)), false);
            body.set_angvel(to_vector(&(vector(body.angvel()) * still.1)), false);
        }
        memory.exact = None;
        return true;
    }
    let (velocity, spin) = (velocity * still.0, spin * still.1);
    body.set_linvel(to_vector(&velocity), false);
    body.set_angvel(to_vector(&spin), false);
    memory.exact = landed.then(|| Exact {
        position: end.position,
        rotation: end.rotation,
        velocity,
        spin,
        accelerations: end.memory,
        centre: given.centre,
        inverse_mass: body.mass_properties().local_mprops.inv_mass,
        pose: *body.position(),
        linvel: body.linvel(),
        angvel: body.angvel(),
    });
    if landed && given.alone {
        memory.force = Vector3::zeros();
        memory.torque = Vector3::zeros();
    }
    !landed
}
