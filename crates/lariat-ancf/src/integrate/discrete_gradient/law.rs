//! The energy law of a step by its terms, and what a system must be able to do.

use crate::error::StepFailure;
use serde::{Deserialize, Serialize};

/// Share of what damping, friction and impact take that the residual of a step may make.
pub(super) const CLOSURE: f64 = 1e-2;

/// Terms of the energy law `D H = work - losses + residual` since the cable was built, in J. The
/// [discrete gradient](crate::integrate::discrete_gradient) knows them all; the other methods know the work of supports and loads by a
/// quadrature of the step. The work of effects, internal damping among them, is in [`EffectWork`](crate::EffectWork).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
#[non_exhaustive]
pub struct EnergyLaw {
    /// Numerical dissipation; never falls.
    pub numerical: f64,
    /// Energy of motion relative to rigid motion, taken where the iteration did not converge; never falls.
    pub rescaled: f64,
    /// Work of supports that move.
    pub supports: f64,
    /// Work of point loads.
    pub loads: f64,
    /// Energy that contacts lost: friction and impact. Never falls.
    pub contacts: f64,
    /// Energy that the inelastic impacts lost by which pinned nodes and their bodies begin a step with one velocity, where an engine, a user or a
    /// collision changed that of the body; of the methods with accelerations. Never falls.
    pub impacts: f64,
    /// By how much the works of effects may be wrong: the difference of two quadratures of each step; zero under the discrete gradient. Never falls.
    pub uncertain: f64,
    /// Work of obstacles that move.
    pub obstacles: f64,
    /// Sum over all steps of the product of the residual and the velocity: energy by which the iteration missed the law.
    pub residual: f64,
    /// Most energy that a single step made: the product of its residual and velocity beyond what it lost. At most the
    /// tolerance, 1e-9 of the energy of the system.
    pub made: f64,
}

impl EnergyLaw {
    /// Adds a step.
    pub(crate) fn add(&mut self, step: &Balance) {
        self.numerical += step.numerical;
        self.rescaled += step.rescaled;
        self.supports += step.supports + step.closing;
        self.loads += step.loads;
        self.contacts += step.contacts + step.left;
        self.obstacles += step.obstacles;
        self.residual += step.residual;
        self.made = self.made.max(step.excess());
    }

    /// Adds another part of the run.
    pub(crate) fn merge(&mut self, other: &EnergyLaw) {
        self.numerical += other.numerical;
        self.rescaled += other.rescaled;
        self.supports += other.supports;
        self.loads += other.loads;
        self.contacts += other.contacts;
        self.impacts += other.impacts;
        self.uncertain += other.uncertain;
        self.obstacles += other.obstacles;
        self.residual += other.residual;
        self.made = self.made.max(other.made);
    }

    /// The terms, to check them.
    pub(crate) fn terms(&self) -> [f64; 10] {
        let EnergyLaw { numerical, rescaled, supports, loads, contacts, impacts, uncertain, .. } = *self;
        [numerical, rescaled, supports, loads, contacts, impacts, uncertain, self.obstacles, self.residual, self.made]
    }
}

/// The law of one step, in J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Balance {
    /// Product of the residual and the velocity, over free coordinates.
    pub residual: f64,
    /// Numerical dissipation.
    pub numerical: f64,
    /// Dissipation by effects within elements.
    pub effects: f64,
    /// Work of supports that move.
    pub supports: f64,
    /// Work of what closes gaps of pins and rotates clamps into their direction.
    pub closing: f64,
    /// Work of point loads.
    pub loads: f64,
    /// Energy taken from velocities.
    pub rescaled: f64,
    /// Kinetic and strain energy and that of contacts at the beginning, and the weight times 1 mm.
    pub held: f64,
    /// The weight times 1 mm.
    pub weight: f64,
    /// Energy that contacts lose.
    pub contacts: f64,
    /// Energy that is lost with contacts of the last step that no contact took up; it hides nothing.
    pub left: f64,
    /// What contacts with obstacles give back of what they lost before.
    pub given_back: f64,
    /// Work of obstacles that move.
    pub obstacles: f64,
    /// Whether an obstacle is near.
    pub near: bool,
    /// Sum in N of contact forces, and of what the linear solve missed of them.
    pub forces: f64,
    pub missed: f64,
    /// Sum in N by which motors of reels break their laws, and that of their forces.
    pub slip: [f64; 2],
    /// Whether friction stops a sheave that runs when the step begins.
    pub stops: bool,
    /// Sum over nodes and bodies of the impulse in N s that the residual leaves unbalanced.
    pub imbalance: f64,
    /// By axis, the impulse in N s that the residual leaves unbalanced in all; only with stock of a reel on a body that moves freely.
    pub drift: [f64; 3],
    /// Sum of the impulses in N s that must balance: of inertia, of external forces, of supports and pins.
    pub impulse: f64,
}

impl Balance {
    /// Adds the law of another part of the system.
    pub fn add(&mut self, other: &Balance) {
        self.residual += other.residual;
        self.numerical += other.numerical;
        self.effects += other.effects;
        self.supports += other.supports;
        self.closing += other.closing;
        self.loads += other.loads;
        self.rescaled += other.rescaled;
        self.held += other.held;
        self.weight += other.weight;
        self.contacts += other.contacts;
        self.left += other.left;
        self.given_back += other.given_back;
        self.obstacles += other.obstacles;
        self.near |= other.near;
        self.forces += other.forces;
        self.missed += other.missed;
        (0..2).for_each(|i| self.slip[i] += other.slip[i]);
        self.stops |= other.stops;
        self.imbalance += other.imbalance;
        (0..3).for_each(|i| self.drift[i] += other.drift[i]);
        self.impulse += other.impulse;
    }

    /// Returns what the method itself loses.
    pub fn losses(&self) -> f64 {
        self.numerical + self.effects + self.contacts
    }

    /// Returns what energies are compared with: the energy held at the beginning, and the work of supports, loads and obstacles.
    pub fn scale(&self) -> f64 {
        self.held + self.supports.abs() + self.loads.abs() + self.obstacles.abs()
    }

    /// Returns the energy that the step makes.
    pub fn excess(&self) -> f64 {
        self.residual - self.losses() - self.rescaled
    }

    /// Returns the energy that is to be taken from velocities: what the step makes, and away from obstacles also what damping hides of it.
    pub fn to_take(self) -> f64 {
        let hidden = if self.near { 0.0 } else { (1.0 - CLOSURE) * self.effects };
        self.excess() + hidden
    }
}

/// Which contacts may close offsets in a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Closing {
    /// Those with obstacles.
    pub obstacles: bool,
    /// Those between cables.
    pub cables: bool,
}

/// Returns the sum of the magnitudes of the forces on positions in a nodal vector.
pub(crate) fn sum_of_forces(x: &[f64]) -> f64 {
    x.as_chunks::<6>().0.iter().map(|x| (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt()).sum()
}

/// A mechanical system with discrete gradients, at its present state.
pub(crate) trait DiscreteGradientSystem {
    /// Returns the present time in s.
    fn time(&self) -> f64;

    /// Sets the present time to `time` (s), from which it differs by rounding.
    fn set_time(&mut self, time: f64);

    /// Begins a host step: puts prescribed coordinates in place if supports or the state were changed.
    fn begin(&mut self);

    /// Begins a step of length `h` (s): sets the first iterate. Contacts close offsets as `closing` says.
    fn predict(&mut self, h: f64, closing: Closing);

    /// Takes one Newton iteration, with a new tangent if `fresh`, else with the factors of the last one, adds a share of the increment, and
    /// returns what its result does to the energy.
    ///
    /// # Errors
    /// If the matrix is singular or a number is not finite.
    fn iterate(&mut self, fresh: bool, share: f64) -> Result<Balance, StepFailure>;

    /// Scales velocities relative to rigid motion down until the step makes no energy; returns false, and changes nothing, if that
    /// would take a larger share of them than `largest_share` (0 to 1).
    fn rescale(&mut self, balance: &mut Balance, largest_share: f64) -> bool;

    /// Takes the velocity across contacts that push at the end of the step, if it has more energy than `least` (J).
    fn land(&mut self, balance: &mut Balance, least: f64);

    /// Makes the end of the step the present state.
    fn accept(&mut self, balance: &Balance);

    /// Adds contacts with what the iterate entered although they were not found before; returns whether there are any.
    fn add_missed(&mut self) -> bool;

    /// Sets the bounds of friction of contacts with obstacles by their present normal forces, if they miss them, by more than `least` (N) in all;
    /// returns whether they did.
    fn renew_friction(&mut self, least: f64) -> bool;

    /// Returns whether centre lines of cables go through each other, or through thin parts of obstacles, in the step.
    fn crosses(&mut self) -> bool;

    /// Counts an event.
    fn count(&mut self, event: Event);

    /// Returns how many steps were divided.
    fn splits(&self) -> u64;
}

/// What happened to a step for which one iteration was not enough.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Event {
    /// Velocities were scaled down.
    Rescaled,
    /// The step was divided.
    Split,
    /// Centre lines of cables went through each other or through thin parts of obstacles.
    Crossed,
    /// Friction did not settle on the normal forces of the step itself.
    Lagging,
}

/// Returns the share of an impact that makes no energy ([`impact`](crate::contact)) but the work of obstacles and what contacts lost in the step, and adds it to
/// the balance: `[P, E, W]` are its terms. One that `gives` velocity may also take back what the step lost numerically.
pub(crate) fn share_of_impact(balance: &mut Balance, [taken, held, work]: [f64; 3], gives: bool) -> f64 {
    let lost = balance.contacts + if gives { balance.numerical } else { 0.0 };
    let (half, lost) = (0.5 * (taken + work), (lost - balance.residual.max(0.0)).max(0.0));
    let most = half + (half * half + held * lost).sqrt();
    let share = (most / held).clamp(0.0, 1.0);
    if share > 0.0 {
        balance.contacts += share * (taken + work) - share * share * held;
        balance.obstacles += share * work;
        if gives && balance.contacts < 0.0 {
            balance.numerical += core::mem::take(&mut balance.contacts);
        }
        share
    } else {
        // also of what is no number
        0.0
    }
}

/// Returns the smaller share u for which v - u w has less kinetic energy than v by the excess, from `1/2 w.M w` and `v.M w`; `None` if
/// there is none up to `largest_share`.
pub(crate) fn share_to_take(energy: f64, product: f64, excess: f64, largest_share: f64) -> Option<f64> {
    let root = product * product - 4.0 * energy * excess;
    let share = (product - root.max(0.0).sqrt()) / (2.0 * energy);
    (root >= 0.0 && (0.0..=largest_share).contains(&share)).then_some(share)
}
