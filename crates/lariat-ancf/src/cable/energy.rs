//! Energies and momenta of a cable, summed over its elements.

use super::Cable;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Energies in J. Potential of gravity is zero at the origin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Energy {
    /// Kinetic, that of added mass included.
    pub kinetic: f64,
    /// Axial strain, from the rest shape.
    pub axial: f64,
    /// Bending, from the rest shape.
    pub bending: f64,
    /// Gravity, less buoyancy.
    pub gravity: f64,
    /// Torsion. Of a [stranded rope](crate::Torsion::torque_per_tension) what its torque does, so
    /// that the axial energy is that at no torque.
    #[serde(default)]
    pub torsion: f64,
    /// [Potentials](crate::Potential) of your own.
    pub potentials: f64,
}

impl Energy {
    /// Returns the sum of all, in J.
    pub fn total(&self) -> f64 {
        self.kinetic + self.axial + self.bending + self.gravity + self.torsion + self.potentials
    }
}

impl core::ops::AddAssign for Energy {
    fn add_assign(&mut self, other: Energy) {
        self.kinetic += other.kinetic;
        self.axial += other.axial;
        self.bending += other.bending;
        self.gravity += other.gravity;
        self.torsion += other.torsion;
        self.potentials += other.potentials;
    }
}

/// Momentum of a cable.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Momentum {
    /// Linear, in kg m/s.
    pub linear: Vector3<f64>,
    /// Angular about the origin, in kg m^2/s.
    pub angular: Vector3<f64>,
}

impl Cable {
    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn energy_in_store(&self) -> f64 {
        self.energy_in_store_by(&mut <[Vec<f64>; 3]>::default())
    }

    /// Returns what the method holds beyond the mechanical energy in J, computed in these vectors.
    pub(crate) fn energy_in_store_by(&self, vectors: &mut [Vec<f64>; 3]) -> f64 {
        let store = self.system.energy_in_store_by(&self.snapshot.state, vectors);
        if self.model.effects.torsion.is_none() || self.snapshot.state.memory.differences.is_empty() {
            return store;
        }
        let share = 0.5 * self.snapshot.state.memory.differences.dissipation;
        store + self.sum_of_segments(|segment, twist| share * segment.stiffness * twist.change.powi(2))
    }

    /// Returns kinetic, strain and gravity energy of the present state.
    pub fn energy(&self) -> Energy {
        self.energy_in(&mut Vec::new())
    }

    /// Returns the energy as [`energy`](Self::energy) does, with the momenta in a buffer.
    pub(crate) fn energy_in(&self, momentum: &mut Vec<f64>) -> Energy {
        let (axial, bending) = self.system.forces.strain_energy(self.positions());
        momentum.resize(self.velocities().len(), 0.0);
        self.system.mass.multiply(self.system.level, self.velocities(), momentum);
        let (time, q, v) = (self.time(), self.positions(), self.velocities());
        let kinetic = 0.5 * momentum.iter().zip(v).map(|(p, v)| p * v).sum::<f64>()
            + self.system.feed_kinetic(&self.model, time, q, v);
        let gravity = -self.system.loads.gravity_work(self.positions());
        let potentials = self.system.potentials.energy(&self.model, self.positions());
        let torsion = self.sum_of_segments(|segment, twist| {
            0.5 * segment.stiffness * segment.loaded(self.elements(), self.positions(), twist.twist).powi(2)
        });
        Energy { kinetic, axial, bending, gravity, torsion, potentials }
    }

    /// Returns linear and angular momentum of the present state.
    pub fn momentum(&self) -> Momentum {
        let p = self.generalised_momentum();
        let vector = |x: &[f64]| Vector3::new(x[0], x[1], x[2]);
        // q = a + W x q is a rigid motion of (r, t): its conjugate momenta are sums of p over r,
        // and of q x p over all
        let mut momentum = Momentum { linear: Vector3::zeros(), angular: Vector3::zeros() };
        for (p, q) in p.chunks_exact(6).zip(self.positions().chunks_exact(6)) {
            momentum.linear += vector(&p[..3]);
            momentum.angular += vector(&q[..3]).cross(&vector(&p[..3])) + vector(&q[3..]).cross(&vector(&p[3..]));
        }
        momentum
    }

    pub(super) fn generalised_momentum(&self) -> Vec<f64> {
        let mut p = self.mass_times_velocity();
        self.system.add_feed_momentum(&self.model, self.time(), self.positions(), &mut p);
        p
    }

    fn mass_times_velocity(&self) -> Vec<f64> {
        let mut p = vec![0.0; self.velocities().len()];
        self.system.mass.multiply(self.system.level, self.velocities(), &mut p);
        p
    }
}
