//! Momentum and energy of cables and dynamic bodies together.

use crate::body::record::BodyRecord;
use crate::body::{is_integrated, read};
use crate::contents::Contents;
use crate::convert::vector;
use crate::error::Error;
use ::nalgebra::{Matrix3, Vector3};
use lariat_ancf::island::RigidBody;
use lariat_ancf::{Energy, Momentum};
use rapier::dynamics::RigidBodyHandle;
use rapier::pipeline::PhysicsWorld;

/// Energies of a world in J; potentials of gravity are zero at the origin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct WorldEnergy {
    /// Energy of all cables.
    pub cables: Energy,
    /// Kinetic energy of all dynamic bodies.
    pub bodies_kinetic: f64,
    /// Potential energy in gravity of all dynamic bodies.
    pub bodies_gravity: f64,
}

impl WorldEnergy {
    /// Returns the sum in J.
    pub fn total(&self) -> f64 {
        self.cables.total() + self.bodies_kinetic + self.bodies_gravity
    }
}

/// Returns the momentum of all cables and dynamic bodies.
pub(crate) fn momentum(contents: &Contents, world: &PhysicsWorld) -> Result<Momentum, Error> {
    let mut sum = Momentum { linear: Vector3::zeros(), angular: Vector3::zeros() };
    for slot in contents.cables.values() {
        let own = slot.cable.momentum();
        sum.linear += own.linear;
        sum.angular += own.angular;
    }
    for body in dynamic_bodies(contents, world) {
        let (handle, body) = body?;
        let (linear, angular) = body.momentum();
        sum.linear += linear;
        sum.angular += angular;
        if let Some(further) = further_mass(contents, world, handle) {
            let linear = further * body.velocity;
            sum.linear += linear;
            sum.angular += body.position.cross(&linear);
        }
    }
    Ok(sum)
}

/// Returns the energy of all cables and dynamic bodies.
pub(crate) fn energy(contents: &Contents, world: &PhysicsWorld) -> Result<WorldEnergy, Error> {
    let mut sum = WorldEnergy::default();
    for slot in contents.cables.values() {
        sum.cables += slot.cable.energy();
    }
    let gravity = vector(world.gravity);
    for body in dynamic_bodies(contents, world) {
        let (handle, body) = body?;
        let scale = f64::from(world.bodies[handle].gravity_scale());
        sum.bodies_kinetic += body.kinetic_energy();
        if let Some(further) = further_mass(contents, world, handle) {
            sum.bodies_kinetic += 0.5 * body.velocity.dot(&(further * body.velocity));
        }
        // added mass has no weight
        let added = contents.water.as_ref().map_or(0.0, |water| water.added_mass(handle));
        sum.bodies_gravity -= (body.mass - added) * scale * gravity.dot(&body.position);
    }
    Ok(sum)
}

/// Returns the added mass of a body in kg that is not in its mass, in world axes.
fn further_mass(contents: &Contents, world: &PhysicsWorld, handle: RigidBodyHandle) -> Option<Matrix3<f64>> {
    contents.water.as_ref()?.further_mass(world, handle)
}

/// Returns all dynamic bodies but ledgers, with their state in `f64` where it is kept.
fn dynamic_bodies(
    contents: &Contents,
    world: &PhysicsWorld,
) -> impl Iterator<Item = Result<(RigidBodyHandle, RigidBody), Error>> {
    let ledgers: Vec<RigidBodyHandle> =
        contents.attachments.values().filter_map(|a| a.ledger.map(|l| l.body)).collect();
    let counts = move |handle: &RigidBodyHandle| is_integrated(world, *handle) && !ledgers.contains(handle);
    world.bodies.iter().map(|(handle, _)| handle).filter(counts).map(move |handle| {
        let unknown = BodyRecord::new(handle);
        let record = contents.records.get(handle).unwrap_or(&unknown);
        Ok((handle, read(world, handle, record, 0.0)?))
    })
}
