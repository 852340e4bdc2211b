//! The mechanism of one body: a link of a multibody, or a body of a chain of impulse joints.

use super::generalised::edit_velocity;
use super::loads::CarriedLoads;
use crate::body::spatial::split_spatial;
use crate::body::unsettled::JointGap;
use crate::convert::{to_vector, vector};
use ::nalgebra::{DMatrix, DVector, Matrix6, Vector6};
use rapier::dynamics::RigidBodyHandle;
use rapier::math::{AngVector, Real, Vector};
use rapier::pipeline::PhysicsWorld;

/// The bodies that a body moves with.
#[derive(Clone, Debug)]
pub(crate) struct Mechanism {
    pub handle: RigidBodyHandle,
    /// R: change of all velocities per impulse on the body.
    pub(super) response: DMatrix<f64>,
    /// Change of velocity of the members of the island per impulse on the body.
    pub(super) mobilities: Vec<(RigidBodyHandle, Matrix6<f64>)>,
    pub(super) before: Velocities,
    pub loads: CarriedLoads,
    /// To what its joints open where Rapier does not converge.
    pub opening: JointGap,
}

/// The velocities of a mechanism before the step.
#[derive(Clone, Debug)]
pub(super) enum Velocities {
    /// The generalised velocity of a multibody.
    Generalised(Vec<Real>),
    /// Those of bodies that impulse joints hold.
    OfBodies(Vec<(RigidBodyHandle, Vector, AngVector)>),
}

impl Mechanism {
    /// Returns whether the body is a link of a multibody.
    pub fn is_multibody(&self) -> bool {
        matches!(self.before, Velocities::Generalised(_))
    }

    /// Returns the change of velocity of a member of the island per impulse on the body; `None` for
    /// one that is not of the mechanism.
    pub fn mobility_of(&self, member: RigidBodyHandle) -> Option<Matrix6<f64>> {
        self.mobilities.iter().find(|(body, _)| *body == member).map(|(_, mobility)| *mobility)
    }

    /// Applies an impulse and its moment to the body; all that it moves with follows.
    pub fn apply_impulse(&self, world: &mut PhysicsWorld, impulse: &Vector6<f64>) {
        self.change_velocities(world, &(&self.response * impulse));
    }

    /// Applies the change of velocity by the loads on the other bodies in `time` (s).
    pub fn apply_loads(&self, world: &mut PhysicsWorld, time: f64) {
        self.change_velocities(world, &(&self.loads.accelerations * time));
    }

    /// Changes the velocities of all bodies.
    fn change_velocities(&self, world: &mut PhysicsWorld, change: &DVector<f64>) {
        match &self.before {
            Velocities::Generalised(_) => {
                edit_velocity(world, self.handle, change.iter(), |u, change| *u += *change as Real);
            }
            Velocities::OfBodies(bodies) => {
                for (i, (handle, ..)) in bodies.iter().enumerate() {
                    let Some(body) = world.bodies.get_mut(*handle) else { continue };
                    let (linear, angular) = split_spatial(&change.fixed_rows::<6>(6 * i).into_owned());
                    body.set_linvel(to_vector(&(vector(body.linvel()) + linear)), false);
                    body.set_angvel(to_vector(&(vector(body.angvel()) + angular)), false);
                }
            }
        }
    }

    /// Restores the velocities before the step.
    pub fn revert(&self, world: &mut PhysicsWorld) {
        match &self.before {
            Velocities::Generalised(before) => {
                edit_velocity(world, self.handle, before.iter(), |u, before| *u = *before);
            }
            Velocities::OfBodies(bodies) => {
                for (handle, linvel, angvel) in bodies {
                    let Some(body) = world.bodies.get_mut(*handle) else { continue };
                    body.set_linvel(*linvel, false);
                    body.set_angvel(*angvel, false);
                }
            }
        }
    }
}
