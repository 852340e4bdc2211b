//! The energy balance of a run.
//!
//! # Equation
//!
//! ```text
//! B(t) = change of (kinetic + strain + gravity) - work on it
//! S(t) = largest of kinetic energy, change of strain energy, change of gravity's, dissipated energy, work, weight times 1 mm, the energy of
//!                a strain of 1e-6, so far
//! ```
//!
//! of all cables, and of the dynamic bodies that nothing but cables, gravity and loads moves. The work is that of effects (damping and
//! drag take it), point loads, moving supports, loads on bodies, and of all other bodies on their cables. B is what integration makes
//! (above 0) or loses.
//!
//! # Validity
//!
//! Cables that step by the discrete gradient have an energy law: of a run in which all do, B is its residual less what it lost, and counts
//! as made beyond the energy that damping took, because the residual of a step may be as large.
//! A body in a host step in which a collider is near it, or with a joint, takes part by what its cables do on it: what contacts and joints
//! take is not known. The balance is no estimate of the error of positions.
//!
//! # References
//!
//! Work-energy theorem; quadratures: [`Cable::effect_work`](lariat_ancf::Cable::effect_work), [`Cable::energy_law`](lariat_ancf::Cable::energy_law).
//!
//! # Alternatives considered
//!
//! The total energy alone: it changes by the work of loads and kinematic bodies, and by damping.

use super::World;
use crate::error::Error;
use crate::physics::BodyTerms;
use serde::{Deserialize, Serialize};

/// Share of the energy of a run above which energy that it makes is warned of.
pub(super) const MADE: f64 = 1e-3;
/// Share of the energy of a run above which energy that integration takes is warned of.
pub(super) const LOST: f64 = 1e-2;

/// Rounding error of the balance over the energy of cables: that of statics.
const ROUNDING: f64 = 1e-9;

/// Height in m over which the weight of everything is the least energy to compare with, as in the law of the discrete gradient.
const LEAST_HEIGHT: f64 = 1e-3;

/// Strain of all cables that is the least energy to compare with, where nothing has weight and all is at rest.
const LEAST_STRAIN: f64 = 1e-6;

/// What `summary.json` says about the energy of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergyBalance {
    /// Change of the energy less the work at the end, in J: what integration made, or lost.
    pub balance_j: f64,
    /// Most that it had made at a host time in J.
    pub made_j: f64,
    /// Host time of that in s.
    pub made_at_s: f64,
    /// Most that it had lost at a host time in J.
    pub lost_j: f64,
    /// Host time of that in s.
    pub lost_at_s: f64,
    /// Energy of the run in J, to compare with: the largest of kinetic energy, changes of strain energy and of that of gravity, dissipated
    /// energy, work, all weight times 1 mm, and the energy of a strain of 1e-6 of all cables.
    pub scale_j: f64,
    /// Rounding errors in J that the balance may have: of the energies, which are differences, and of the positions of bodies in single
    /// precision, by which the forces of cables do work in every step.
    pub rounding_j: f64,
    /// Energy that damping and drag took in J.
    pub dissipated_j: f64,
    /// Work of loads, moving supports, flows and other bodies in J.
    pub work_j: f64,
}

impl EnergyBalance {
    /// Returns the share of the energy of the run that integration made, beyond rounding errors.
    pub fn made(&self) -> f64 {
        share(self.made_j, self)
    }

    /// Returns the share of the energy of the run that integration lost at most, beyond rounding errors.
    pub fn lost(&self) -> f64 {
        share(self.lost_j, self)
    }
}

fn share(energy: f64, balance: &EnergyBalance) -> f64 {
    let beyond = energy - balance.rounding_j;
    if beyond > 0.0 { beyond / balance.scale_j } else { 0.0 }
}

/// Energies and works up to a time, in J.
#[derive(Clone, Debug, Default)]
pub(super) struct Terms {
    pub kinetic: f64,
    pub strain: f64,
    pub gravity: f64,
    /// Weight of all cables and dynamic bodies in N.
    pub weight: f64,
    /// Sum of axial stiffness times length of all cables in J.
    pub stiffness: f64,
    pub dissipated: f64,
    /// Work on cables, but that of damping and drag.
    pub work: f64,
    /// Energy that the discrete gradient made, less what it lost; only if all cables step by it.
    pub by_law: Option<f64>,
    /// Work that a rounding error of the positions of bodies is worth, with the present forces.
    pub rounding: f64,
    /// By dynamic body, in the order of the scene.
    pub bodies: Vec<BodyTerms>,
}

/// The balance of a run so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Account {
    start: Option<Terms>,
    last: Terms,
    /// Sum of [`Terms::rounding`] in J.
    steps_rounding: f64,
    pub balance: EnergyBalance,
}

impl Account {
    /// Reads the energy at a host time.
    ///
    /// # Errors
    /// [`Error::Coupling`]; not for a running scene.
    pub fn note(&mut self, world: &World) -> Result<(), Error> {
        let now = world.terms()?;
        let Account { start, last, steps_rounding, balance } = self;
        let start = start.get_or_insert_with(|| {
            last.clone_from(&now);
            now.clone()
        });
        let cables = |t: &Terms| t.kinetic + t.strain + t.gravity + t.dissipated - t.work;
        let mut change = cables(&now) - cables(last);
        let mut work = now.work - last.work;
        for (now, last) in now.bodies.iter().zip(&last.bodies) {
            if now.free && last.free {
                change += now.kinetic + now.gravity - now.loads - (last.kinetic + last.gravity - last.loads);
                work += now.loads - last.loads;
            } else {
                change += now.cables - last.cables;
                work -= now.cables - last.cables;
            }
        }
        let by_law = now.by_law.zip(last.by_law).map(|(now, last)| now - last);
        change = by_law.unwrap_or(change);
        let sum = |t: &Terms, of: fn(&BodyTerms) -> f64| t.bodies.iter().map(of).sum::<f64>();
        let kinetic = now.kinetic + sum(&now, |body| body.kinetic);
        let gravity = |t: &Terms| t.gravity + sum(t, |body| body.gravity);
        balance.balance_j += change;
        balance.work_j += work;
        balance.dissipated_j = now.dissipated - start.dissipated;
        let sizes = [
            now.weight * LEAST_HEIGHT,
            0.5 * now.stiffness * LEAST_STRAIN * LEAST_STRAIN,
            kinetic,
            now.strain - start.strain,
            gravity(&now) - gravity(start),
            balance.dissipated_j,
            balance.work_j,
        ];
        balance.scale_j = sizes.iter().fold(balance.scale_j, |largest, size| largest.max(size.abs()));
        let held = kinetic + now.strain.abs() + now.gravity.abs();
        let bodies = sum(&now, |body| body.kinetic + body.gravity.abs());
        *steps_rounding += now.rounding;
        let differences = ROUNDING * held + f64::from(f32::EPSILON) * bodies;
        balance.rounding_j = balance.rounding_j.max(*steps_rounding + differences);
        let time = world.time();
        // the discrete gradient sees to it that a step makes no more than damping takes
        let made = balance.balance_j - by_law.map_or(0.0, |_| balance.dissipated_j.max(0.0));
        if made > balance.made_j {
            (balance.made_j, balance.made_at_s) = (made, time);
        }
        if -balance.balance_j > balance.lost_j {
            (balance.lost_j, balance.lost_at_s) = (-balance.balance_j, time);
        }
        *last = now;
        Ok(())
    }
}
