//! The energy law of all steps, by name.

use super::account::Account;
use super::balance::Balance;
use serde::{Deserialize, Serialize};

/// Terms of the energy law `D H = work - losses + residual` since the cable was built, in J. The
/// [discrete gradient](crate::integrate::discrete_gradient) knows them all; the other methods know
/// the work of supports and loads by a quadrature of the step. The work of effects, internal
/// damping among them, is in [`EffectWork`](crate::EffectWork).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
#[non_exhaustive]
pub struct EnergyLaw {
    /// Numerical dissipation; never falls.
    pub numerical: f64,
    /// Energy of motion relative to rigid motion, taken where the iteration did not converge, or
    /// where the errors of many steps within a tolerance had made half a per cent of the energy;
    /// never falls.
    pub rescaled: f64,
    /// What a step that is shorter than the one before it, as where a step was divided, does not
    /// take up of the energy [in the store](crate::coupling::Coupling::energy_in_store), or one of
    /// less dissipation; never falls.
    pub shortened: f64,
    /// Work of supports that move.
    pub supports: f64,
    /// Work of point loads, and of the forces on the bodies of an island.
    pub loads: f64,
    /// Of that, the work of the forces and torques on bodies: gravity, those of the user, and those
    /// by which an engine's contacts and joints take part.
    pub bodies: f64,
    /// Energy that contacts lost: friction and impact. Never falls.
    pub contacts: f64,
    /// Energy that contacts and damping would have lost by their laws beside that, in steps that
    /// were [not solved](crate::Diagnostics::unsolved_steps). Never falls.
    pub unsolved: f64,
    /// Energy that the friction of sheaves took. Never falls.
    pub sheaves: f64,
    /// Energy that the inelastic impacts lost by which pinned nodes and their bodies begin a step
    /// with one velocity, where an engine, a user or a collision changed that of the body; of the
    /// methods with accelerations. Never falls.
    pub impacts: f64,
    /// By how much the works of effects may be wrong: the difference of two quadratures of each
    /// step; zero under the discrete gradient. Never falls.
    pub uncertain: f64,
    /// Work of obstacles that move.
    pub obstacles: f64,
    /// Sum over all steps of the product of the residual and the velocity: energy by which the
    /// iteration missed the law.
    pub residual: f64,
    /// Most energy that a single step made: the product of its residual and velocity beyond what it
    /// lost. At most the tolerance, 1e-9 of the energy of the system, of which bending counts as
    /// EI/2 times the integral of |r''|^2 (rule T1): that is the energy of its curvature but where
    /// the stretch changes within an element, as in crumpled thick rods, where it is far larger.
    pub made: f64,
}

impl EnergyLaw {
    /// Returns the energy in J that contacts, sheaves and impacts took.
    pub fn dissipated(&self) -> f64 {
        self.contacts + self.sheaves + self.impacts
    }

    /// Adds a step.
    pub(crate) fn add(&mut self, step: &Balance) {
        let [supports, loads, contacts, reels] =
            [Account::Supports, Account::Loads, Account::Contacts, Account::Reels].map(|account| step.of(account));
        self.numerical += step.numerical;
        self.rescaled += step.rescaled;
        self.supports += supports.work + supports.aside;
        self.loads += loads.work;
        self.bodies += loads.aside;
        self.contacts += contacts.loss + contacts.aside;
        self.unsolved += step.hidden[0] + step.hidden[1];
        self.sheaves += reels.aside;
        self.obstacles += contacts.work;
        self.residual += step.residual;
        self.made = self.made.max(step.excess());
    }

    /// Adds another part of the run.
    pub(crate) fn merge(&mut self, other: &EnergyLaw) {
        self.numerical += other.numerical;
        self.rescaled += other.rescaled;
        self.shortened += other.shortened;
        self.supports += other.supports;
        self.loads += other.loads;
        self.bodies += other.bodies;
        self.contacts += other.contacts;
        self.unsolved += other.unsolved;
        self.sheaves += other.sheaves;
        self.impacts += other.impacts;
        self.uncertain += other.uncertain;
        self.obstacles += other.obstacles;
        self.residual += other.residual;
        self.made = self.made.max(other.made);
    }

    /// The terms, to check them.
    pub(crate) fn terms(&self) -> [f64; 14] {
        let EnergyLaw { numerical, rescaled, shortened, supports, loads, bodies, contacts, .. } = *self;
        let EnergyLaw { unsolved, sheaves, impacts, uncertain, obstacles, residual, made, .. } = *self;
        [
            numerical, rescaled, shortened, supports, loads, bodies, contacts, unsolved, sheaves, impacts, uncertain,
            obstacles, residual, made,
        ]
    }
}
