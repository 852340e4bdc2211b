//! Loads on the other bodies of a mechanism, which the prediction bears: gravity and the user's forces.
//!
//! ```text
//! L x'' = f + L a0,   a0 = the body's row of a = P M^-1 f_others        v += a h/2 before Rapier's step, and again after it
//! ```
//!
//! The mechanism is predicted with all its loads, and handed over whole: every body of it at the mean velocity of the step, and with a force that
//! balances its weight. Rapier's joints then have nothing to do, so it does not matter how many iterations they get. *Where.* No cable
//! holds another body of it, and none of the others is near a body from outside: else the body learns what the others do.
//! *Measured* (arm of three links of 1 kg, its tip on a soft rope; host steps of 1/30 s, one iteration): the rope carries 14.715 N for 14.715, where
//! with learning alone it carried 14.28 N on welded impulse joints, 10.9 N on a multibody at its limits, and was refused on impulse joints
//! at theirs; gap 4e-7 m (5e-3 m), energy made 0 (1.8 of the largest): `lariat stability --case arm`. *Rejected.* Learning the loads of the others as a reaction: ten steps go by until it is
//! learnt, meanwhile joints that have not converged yield, and what Rapier takes back of it is learnt as force.

use crate::convert::vector;
use crate::linkage::both;
use ::nalgebra::{DVector, Vector6};
use rapier::dynamics::RigidBodyHandle;
use rapier::math::{AngVector, Real, Vector};
use rapier::pipeline::PhysicsWorld;

/// What loads on the other bodies of a mechanism do.
#[derive(Clone, Debug, Default)]
pub(crate) struct Borne {
    /// The other bodies; none if their loads are not borne.
    pub bodies: Vec<Aside>,
    /// a: of all bodies, of a multibody of its generalised velocity.
    pub free: DVector<f64>,
    /// a0.
    pub of_body: Vector6<f64>,
    /// Whether it bears them, and none of the bodies is near one from outside.
    pub quiet: bool,
}

/// What to restore of a body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aside {
    handle: RigidBodyHandle,
    force: Vector,
    torque: AngVector,
    linear_damping: Real,
    angular_damping: Real,
}

/// Whether a body is near no other but those of its mechanism.
pub(crate) fn alone(world: &PhysicsWorld, bodies: &[RigidBodyHandle], body: RigidBodyHandle) -> bool {
    let Some(found) = world.bodies.get(body) else { return false };
    found.colliders().iter().all(|&c| {
        world.narrow_phase.contact_pairs_with(c).all(|pair| {
            let parents = [pair.collider1, pair.collider2].map(|c| world.colliders.get(c));
            parents.iter().all(|c| c.is_none_or(|c| c.parent().is_some_and(|p| bodies.contains(&p))))
        })
    })
}

/// Whether the loads on the other bodies of a mechanism can be foreseen: no cable holds another, and none is near a body from outside.
pub(crate) fn bears(
    world: &PhysicsWorld,
    bodies: &[RigidBodyHandle],
    body: RigidBodyHandle,
    held: &dyn Fn(RigidBodyHandle) -> bool,
) -> bool {
    bodies.iter().filter(|b| **b != body).all(|b| !held(*b) && alone(world, bodies, *b))
}

/// What loads a body, and what to restore of it.
pub(crate) fn put_aside(world: &PhysicsWorld, handle: RigidBodyHandle) -> (Aside, Vector6<f64>) {
    let body = &world.bodies[handle];
    let weight = vector(world.gravity) * f64::from(body.mass()) * f64::from(body.gravity_scale());
    let load = both(&(weight + vector(body.user_force())), &vector(body.user_torque()));
    let aside = Aside {
        handle,
        force: body.user_force(),
        torque: body.user_torque(),
        linear_damping: body.linear_damping(),
        angular_damping: body.angular_damping(),
    };
    (aside, load)
}

/// Lets the bodies move uniformly.
pub(crate) fn balance(world: &mut PhysicsWorld, borne: &Borne) {
    let gravity = world.gravity;
    for aside in &borne.bodies {
        let Some(body) = world.bodies.get_mut(aside.handle) else { continue };
        body.reset_forces(false);
        body.reset_torques(false);
        let weight = gravity * (body.mass() * body.gravity_scale());
        body.add_force(-weight, false);
        body.set_linear_damping(0.0);
        body.set_angular_damping(0.0);
    }
}

/// Restores what [`balance`] put aside.
pub(crate) fn restore(world: &mut PhysicsWorld, borne: &Borne) {
    for aside in &borne.bodies {
        let Some(body) = world.bodies.get_mut(aside.handle) else { continue };
        body.reset_forces(false);
        body.reset_torques(false);
        body.add_force(aside.force, false);
        body.add_torque(aside.torque, false);
        body.set_linear_damping(aside.linear_damping);
        body.set_angular_damping(aside.angular_damping);
    }
}

/// Damps the bodies as Rapier would have done in `h` (s).
pub(crate) fn damp(world: &mut PhysicsWorld, borne: &Borne, h: f64) {
    for aside in &borne.bodies {
        let Some(body) = world.bodies.get_mut(aside.handle) else { continue };
        let still = |damping: Real| (1.0 / (1.0 + h * f64::from(damping))) as Real;
        body.set_linvel(body.linvel() * still(aside.linear_damping), false);
        body.set_angvel(body.angvel() * still(aside.angular_damping), false);
    }
}
