//! The energy law of one step.
//!
//! # Equation
//!
//! ```text
//! D H = sum of work - numerical dissipation - sum of losses + residual
//! ```
//!
//! The residual is the product of the residual of the equations and the velocity. The step *makes*
//! what of it is beyond the losses. Damping, friction and impact lose so much that an error of the
//! iteration hides behind them, so their losses excuse a small share of it alone.

use super::account::{Account, Entry};
use crate::scales::term::{CLOSURE, TOLERANCE};

/// The law of one step, in J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Balance {
    /// Product of the residual and the velocity, over free coordinates.
    pub residual: f64,
    /// Numerical dissipation of the method.
    pub numerical: f64,
    /// Energy taken from velocities.
    pub rescaled: f64,
    /// Energy that contacts, and the damping of elements, did not take, as the step is not solved.
    pub hidden: [f64; 2],
    /// Kinetic and strain energy and that of contacts at the beginning, and the weight times 1 mm;
    /// bending by rule T1, whose forms the method's own dissipation has.
    pub held: f64,
    /// The weight times 1 mm.
    pub weight: f64,
    /// Sum over nodes and bodies of the impulse in N s that the residual leaves unbalanced.
    pub imbalance: f64,
    /// The largest share of the impulses of a body that is left unbalanced: of inertia, loads, and
    /// standard gravity.
    pub imbalance_of_bodies: f64,
    /// Sum of the impulses in N s that must balance: of inertia, of external forces, of supports
    /// and pins.
    pub impulse: f64,
    /// What standard gravity gives the cables in N s: less than a share of it is no imbalance.
    pub of_gravity: f64,
    /// Whether a term with corners in its law acts, or is about to: iterates may swing between both
    /// sides of a corner.
    pub nonsmooth: bool,
    pub entries: [Entry; Account::COUNT],
}

impl Balance {
    /// Returns the entry of an account.
    pub fn of(&self, account: Account) -> &Entry {
        &self.entries[account as usize]
    }

    /// Returns the entry of an account, to add to it.
    pub fn to(&mut self, account: Account) -> &mut Entry {
        &mut self.entries[account as usize]
    }

    /// Adds the law of another part of the system.
    pub fn add(&mut self, other: &Balance) {
        self.residual += other.residual;
        self.numerical += other.numerical;
        self.rescaled += other.rescaled;
        (0..2).for_each(|k| self.hidden[k] += other.hidden[k]);
        self.held += other.held;
        self.weight += other.weight;
        self.imbalance += other.imbalance;
        self.imbalance_of_bodies = self.imbalance_of_bodies.max(other.imbalance_of_bodies);
        self.impulse += other.impulse;
        self.of_gravity += other.of_gravity;
        self.nonsmooth |= other.nonsmooth;
        self.entries.iter_mut().zip(&other.entries).for_each(|(own, other)| own.add(other));
    }

    /// Returns what method and terms lose.
    pub fn losses(&self) -> f64 {
        self.entries.iter().fold(self.numerical, |sum, entry| sum + entry.loss)
    }

    /// Returns what energies are compared with: the energy held at the beginning, and the work of
    /// all terms.
    pub fn scale(&self) -> f64 {
        self.entries.iter().fold(self.held, |sum, entry| sum + entry.work.abs())
    }

    /// Returns the energy in J that the step may make.
    pub fn tolerance(&self) -> f64 {
        TOLERANCE * self.scale()
    }

    /// Returns the energy that the step makes.
    pub fn excess(&self) -> f64 {
        self.residual - self.losses() - self.rescaled
    }

    /// Takes from the losses of contacts and of elements what the residual of a step that is not
    /// solved hides of them: the energy that they did not take.
    pub fn take_hidden(&mut self) {
        for (account, k) in [(Account::Contacts, 0), (Account::Elements, 1)] {
            let hidden = (self.residual - self.rescaled).clamp(0.0, self.of(account).loss.max(0.0));
            self.residual -= hidden;
            self.to(account).loss -= hidden;
            self.hidden[k] += hidden;
        }
    }

    /// Returns the energy that is to be taken from velocities: what the step makes, and where all
    /// terms are smooth also what their losses hide of it.
    pub fn surplus(&self) -> f64 {
        let lost = || self.entries.iter().map(|entry| entry.loss).sum::<f64>();
        let hidden = if self.nonsmooth { 0.0 } else { (1.0 - CLOSURE) * lost() };
        self.excess() + hidden
    }

    /// Returns whether the forces of all terms are those of their laws.
    pub fn is_consistent(&self) -> bool {
        self.entries.iter().all(|entry| entry.is_consistent(self.weight))
    }

    /// Returns whether a term has forces that [may be inconsistent](Entry::is_consistent).
    pub fn has_laws(&self) -> bool {
        self.entries.iter().any(|entry| entry.forces > 0.0)
    }
}
