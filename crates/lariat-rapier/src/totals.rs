//! Momentum and energy of cables and dynamic bodies together.

use crate::Error;
use crate::body::{Remembered, is_integrated, read};
use crate::set::CableSet;
use ::nalgebra::Vector3;
use lariat_ancf::{Energy, Momentum};
use rapier::dynamics::RigidBodyHandle;
use rapier::pipeline::PhysicsWorld;

/// Energies in J; potentials of gravity are zero at the origin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorldEnergy {
    /// Of all cables.
    pub cables: Energy,
    /// Kinetic, of all dynamic bodies.
    pub bodies_kinetic: f64,
    /// Gravity, of all dynamic bodies.
    pub bodies_gravity: f64,
}

impl WorldEnergy {
    /// Sum of all, in J.
    pub fn total(&self) -> f64 {
        self.cables.total() + self.bodies_kinetic + self.bodies_gravity
    }
}

impl CableSet {
    /// Linear momentum (kg m/s) and angular momentum about the origin (kg m^2/s) of all cables and enabled dynamic bodies.
    ///
    /// # Errors
    /// [`Error::BodyNotFinite`].
    pub fn momentum(&self, world: &PhysicsWorld) -> Result<Momentum, Error> {
        let mut sum = Momentum { linear: Vector3::zeros(), angular: Vector3::zeros() };
        for (_, cable) in self.iter() {
            let own = cable.momentum();
            sum.linear += own.linear;
            sum.angular += own.angular;
        }
        for body in self.dynamic_bodies(world) {
            let (linear, angular) = body?.1.momentum();
            sum.linear += linear;
            sum.angular += angular;
        }
        Ok(sum)
    }

    /// Energy of all cables and enabled dynamic bodies.
    ///
    /// # Errors
    /// [`Error::BodyNotFinite`].
    pub fn energy(&self, world: &PhysicsWorld) -> Result<WorldEnergy, Error> {
        let mut sum = WorldEnergy::default();
        for (_, cable) in self.iter() {
            sum.cables += cable.energy();
        }
        let gravity = crate::convert::vector(world.gravity);
        for body in self.dynamic_bodies(world) {
            let (handle, body) = body?;
            let scale = f64::from(world.bodies[handle].gravity_scale());
            sum.bodies_kinetic += body.kinetic_energy();
            sum.bodies_gravity -= body.mass * scale * gravity.dot(&body.position);
        }
        Ok(sum)
    }

    /// Dynamic bodies but for ledgers, in `f64` where they are kept so.
    fn dynamic_bodies(
        &self,
        world: &PhysicsWorld,
    ) -> impl Iterator<Item = Result<(RigidBodyHandle, lariat_ancf::island::RigidBody), Error>> {
        let ledgers: Vec<RigidBodyHandle> = self.attachments().filter_map(|(_, a)| a.ledger.map(|l| l.body)).collect();
        let counts = move |handle: &RigidBodyHandle| is_integrated(world, *handle) && !ledgers.contains(handle);
        world.bodies.iter().map(|(handle, _)| handle).filter(counts).map(move |handle| {
            let unknown = Remembered::new(handle);
            let memory = self.remembered(handle).unwrap_or(&unknown);
            Ok((handle, read(world, handle, memory, 0.0)?))
        })
    }
}
