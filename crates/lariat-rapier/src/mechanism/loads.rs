//! Gravity and applied forces on the other bodies of a mechanism, included in the prediction.
//!
//! # Equation
//! ```text
//! L x'' = f + L a0,   a0 = the body's row of a = P M^-1 f_others
//! v += a h/2   before Rapier's step, and again after it
//! ```
//! The mechanism is predicted with all its loads and given to Rapier as a whole: each of its bodies
//! moves with the mean velocity of the step, under a force that balances its weight. Rapier's
//! joints then have nothing to do, for any number of iterations.
//!
//! # Validity
//! The others are near no body from outside. Otherwise their loads are part of the reaction
//! estimate.
//!
//! Measured: an arm of three links of 1 kg, its tip on a soft rope, host steps of 1/30 s, one
//! iteration (`lariat stability --case arm`). The rope carries 14.715 N of 14.715; without these
//! loads 14.28 N on welded impulse joints and 10.9 N on a multibody at its limits, and the step
//! failed for impulse joints at theirs. Gap 4e-7 m (5e-3 m), spurious energy 0 (1.8 of the
//! largest).
//!
//! # Alternatives considered
//! The loads of the others as a reaction estimate: it takes ten steps to settle; meanwhile joints
//! that have not converged yield, and what Rapier corrects of it enters the estimate as a force.

use super::joint_damping::{JointDamping, edit_damping};
use super::request::Request;
use crate::body::proximity::may_touch;
use crate::body::spatial::stack_spatial;
use crate::body::{SavedBody, replace_loads};
use crate::convert::vector;
use ::nalgebra::{DVector, Vector6};
use rapier::dynamics::RigidBodyHandle;
use rapier::geometry::Collider;
use rapier::math::{AngVector, Real};
use rapier::pipeline::PhysicsWorld;

/// The loads on the other bodies of a mechanism that the prediction includes.
#[derive(Clone, Debug, Default)]
pub(crate) struct CarriedLoads {
    /// The other bodies; empty if their loads are not included.
    pub(super) bodies: Vec<(RigidBodyHandle, SavedBody)>,
    /// Damping of the joints of a multibody that the prediction includes, with one of its links.
    pub(super) joint_damping: Option<(RigidBodyHandle, JointDamping)>,
    /// Accelerations a of all bodies, or generalised ones of a multibody.
    pub(super) accelerations: DVector<f64>,
    /// Acceleration a0 of the attached body.
    pub of_body: Vector6<f64>,
    /// Whether the loads are included and the mechanism touches no other body.
    pub isolated: bool,
    /// Whether joints of a multibody are at their limits, which Rapier's solver keeps in its own
    /// step.
    pub limited: bool,
}

impl CarriedLoads {
    /// Adds a body, and returns the force and torque on it.
    pub(super) fn add(&mut self, world: &PhysicsWorld, handle: RigidBodyHandle) -> Vector6<f64> {
        let body = &world.bodies[handle];
        self.bodies.push((handle, SavedBody::of(body)));
        let weight = vector(world.gravity) * f64::from(body.mass()) * f64::from(body.gravity_scale());
        stack_spatial(&(weight + vector(body.user_force())), &vector(body.user_torque()))
    }

    /// Makes the bodies move uniformly.
    pub fn balance(&self, world: &mut PhysicsWorld) {
        let gravity = world.gravity;
        for (handle, _) in &self.bodies {
            let Some(body) = world.bodies.get_mut(*handle) else { continue };
            let weight = gravity * (body.mass() * body.gravity_scale());
            replace_loads(body, -weight, AngVector::ZERO);
        }
        if let Some((link, _)) = &self.joint_damping {
            edit_damping(world, *link, |damping| damping.fill(0.0));
        }
    }

    /// Restores the loads and settings of the bodies.
    pub fn restore(&self, world: &mut PhysicsWorld) {
        for (handle, saved) in &self.bodies {
            if let Some(body) = world.bodies.get_mut(*handle) {
                saved.restore_settings(body);
            }
        }
        if let Some((link, saved)) = &self.joint_damping {
            edit_damping(world, *link, |damping| {
                // the user may have changed the joints meanwhile
                if damping.len() == saved.len() {
                    damping.copy_from(saved);
                }
            });
        }
    }

    /// Damps the bodies as Rapier would have done in `h` (s).
    pub fn damp(&self, world: &mut PhysicsWorld, h: f64) {
        for (handle, saved) in &self.bodies {
            let Some(body) = world.bodies.get_mut(*handle) else { continue };
            let (linear, angular) = saved.damping_factors(h);
            body.set_linvel(body.linvel() * linear as Real, false);
            body.set_angvel(body.angvel() * angular as Real, false);
        }
    }
}

/// Returns whether the prediction can include the loads on the other bodies of a mechanism: no
/// cable of another island is attached to them, and they are near no body from outside.
pub(super) fn can_predict_loads(world: &PhysicsWorld, bodies: &[RigidBodyHandle], request: &Request) -> bool {
    let others = bodies.iter().filter(|b| !request.is_member(**b));
    others.into_iter().all(|b| !(request.is_attached)(*b) && is_isolated(world, bodies, *b))
}

/// Returns whether no body of a mechanism is near one from outside.
pub(super) fn are_isolated(world: &PhysicsWorld, bodies: &[RigidBodyHandle]) -> bool {
    bodies.len() > 1 && bodies.iter().all(|body| is_isolated(world, bodies, *body))
}

/// Returns whether a body is near no other but those of its mechanism.
fn is_isolated(world: &PhysicsWorld, bodies: &[RigidBodyHandle], body: RigidBodyHandle) -> bool {
    let Some(body) = world.bodies.get(body) else { return false };
    body.colliders().iter().all(|&c| {
        world.narrow_phase.contact_pairs_with(c).all(|pair| {
            let [Some(one), Some(two)] = [pair.collider1, pair.collider2].map(|c| world.colliders.get(c)) else {
                return true;
            };
            let own = |c: &Collider| c.parent().is_some_and(|p| bodies.contains(&p));
            own(one) && own(two) || !may_touch(world, one, two, pair)
        })
    })
}
