//! What is read from a scene.

use super::{Fault, HEAVIEST_BODY, Scene};
use crate::single::convert::from_rapier;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{Cable, Vector3};
use lariat_rapier::rapier::prelude::*;

/// Energies and works up to now, in J.
#[derive(Clone, Copy, Debug)]
pub struct Ledger {
    /// Kinetic, strain and gravity energy of all and what contacts store, less all work on it from
    /// outside, and with what contacts and sheaves took; `None` where that is not known: of a drum,
    /// the energy of what it winds up.
    pub kept: Option<f64>,
    /// Kinetic and strain energy.
    pub scale: f64,
}

impl Scene {
    /// Returns the positions of nine points of each cable, and of each dynamic body.
    pub fn positions(&self) -> Vec<Vector3<f64>> {
        let of = |cable: &Cable| {
            let at = |k: usize| cable.length() * k as f64 / 8.0;
            (0..=8).map(|k| cable.sample(at(k)).map_or(Vector3::repeat(f64::NAN), |s| s.position)).collect::<Vec<_>>()
        };
        let bodies = self.bodies().map(|(_, body)| from_rapier(body.translation()));
        self.set.iter().flat_map(|(_, cable)| of(cable)).chain(bodies).collect()
    }

    /// Returns the centre of mass of cables and dynamic bodies, in m.
    pub fn centre(&self) -> Vector3<f64> {
        let (mut sum, mut mass) = (Vector3::zeros(), 0.0);
        for (_, cable) in self.set.iter() {
            let mut s = 0.0;
            for element in cable.elements() {
                let own = element.length * element.section.mass_per_length;
                // Simpson's rule
                for (share, weight) in [(0.0, 1.0 / 6.0), (0.5, 4.0 / 6.0), (1.0, 1.0 / 6.0)] {
                    let at = cable.sample((s + share * element.length).min(cable.length()));
                    sum += at.map_or(Vector3::repeat(f64::NAN), |sample| sample.position) * (own * weight);
                }
                (s, mass) = (s + element.length, mass + own);
            }
        }
        for (_, body) in self.bodies() {
            sum += from_rapier(body.center_of_mass()) * f64::from(body.mass());
            mass += f64::from(body.mass());
        }
        sum / mass
    }

    /// Returns the dynamic bodies of the scene.
    fn bodies(&self) -> impl Iterator<Item = (RigidBodyHandle, &RigidBody)> {
        let own = |body: &RigidBody| body.is_dynamic() && f64::from(body.mass()) < HEAVIEST_BODY;
        self.physics.bodies.iter().filter(move |(_, body)| own(body))
    }

    /// Returns cables and bodies, to the bit.
    pub fn bits(&self) -> Vec<u64> {
        let cables = self.set.iter().flat_map(|(_, cable)| cable.positions().iter().chain(cable.velocities()).copied());
        let state = |b: &RigidBody| {
            let (x, r, v, w) = (b.translation(), b.rotation(), b.linvel(), b.angvel());
            [x.x, x.y, x.z, r.x, r.y, r.z, r.w, v.x, v.y, v.z, w.x, w.y, w.z].map(f64::from)
        };
        let bodies = self.bodies().flat_map(|(_, body)| state(body));
        cables.chain(bodies).map(f64::to_bits).collect()
    }

    /// Returns energies and works.
    ///
    /// # Errors
    /// Those of the coupling.
    pub fn ledger(&self) -> Result<Ledger, Fault> {
        let energy = self.set.energy(&self.physics)?;
        let cables = &energy.cables;
        let mut work = 0.0;
        for (_, cable) in self.set.iter() {
            let law = cable.energy_law();
            // what contacts do within the system is no work from outside: their force on cables has
            // what loose bodies get, and what passes a sheave. What they take is known; what
            // sheaves take is in the work of their reels
            let effects = cable.effect_work();
            work += effects.total() - effects.contact + law.obstacles - law.contacts - law.impacts;
            // that of supports has the work of bodies that do not give way, and of kinematic ones
            work += law.supports;
            // the work of loads is independent of the run's account, which counts all forces on
            // bodies, too
            for load in cable.loads().iter().filter(|load| load.history.is_empty()) {
                work += load.force.dot(&cable.sample(load.arc_length)?.position);
            }
            work += cable.inserted_energy() + cable.reels().map(|reel| reel.work + reel.remeshed).sum::<f64>();
        }
        work += self.load_work;
        if let Some(water) = self.set.water() {
            let of = |body| Some(water.work(body)? - water.lost_in_substeps(body)?);
            work += water.bodies().filter_map(of).sum::<f64>();
        }
        let scale = cables.kinetic + cables.axial + cables.bending + energy.bodies_kinetic;
        let known = self.set.drums().next().is_none();
        let stored: f64 = self.set.iter().map(|(_, cable)| cable.contact_energy()).sum();
        Ok(Ledger { kept: known.then_some(energy.total() + stored - work), scale })
    }

    /// Returns the work in J of the loads that vary, from the origin to where they are, with the
    /// forces of a time in s.
    ///
    /// # Errors
    /// Those of the coupling.
    pub(super) fn potential_of_loads(&self, time: f64) -> Result<f64, Fault> {
        let mut sum = 0.0;
        for (_, cable) in self.set.iter() {
            for load in cable.loads().iter().filter(|load| !load.history.is_empty()) {
                sum += load.factor(time) * load.force.dot(&cable.sample(load.arc_length)?.position);
            }
        }
        Ok(sum)
    }

    /// Returns linear and angular momentum, in kg m/s and kg m^2/s.
    ///
    /// # Errors
    /// Those of the coupling.
    pub fn momentum(&self) -> Result<[Vector3<f64>; 2], Fault> {
        let momentum = self.set.momentum(&self.physics)?;
        Ok([momentum.linear, momentum.angular])
    }

    /// Returns what the weight of all does over a distance of 1 cm, in J: the smallest energy that
    /// others are compared with.
    pub fn least_energy(&self) -> f64 {
        let cable = |c: &Cable| c.elements().iter().map(|e| e.length * e.section.mass_per_length).sum::<f64>();
        let cables: f64 = self.set.iter().map(|(_, c)| cable(c)).sum();
        let bodies: f64 = self.bodies().map(|(_, body)| f64::from(body.mass())).sum();
        0.0981 * (cables + bodies)
    }
}
