//! The accounts of the energy law of a step.

use crate::scales::term::CONSISTENCY;

/// An account of the energy law. The order is that of the sums.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Account {
    /// Elements and their effects.
    Elements,
    /// Supports, pins and what locks bodies.
    Supports,
    /// Point loads, and those of bodies.
    Loads,
    /// Contacts with obstacles and between cables.
    Contacts,
    /// Reels, sheaves and drums.
    Reels,
}

impl Account {
    /// Layout: number of accounts.
    pub const COUNT: usize = Account::Reels as usize + 1;
}

/// What a term does in one step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Entry {
    /// Work in J that it does on the system.
    pub work: f64,
    /// Energy in J that it loses.
    pub loss: f64,
    /// Work or loss in J that is told beside these: nothing is compared with it, and it hides
    /// nothing.
    pub aside: f64,
    /// Sum in N by which its forces are not those of its law, or of the linear solve.
    pub missed: f64,
    /// Sum in N of its forces.
    pub forces: f64,
}

impl Entry {
    /// Adds the entry of another part of the system.
    pub fn add(&mut self, other: &Entry) {
        self.work += other.work;
        self.loss += other.loss;
        self.aside += other.aside;
        self.missed += other.missed;
        self.forces += other.forces;
    }

    /// Returns whether its forces are right, to a share of them and of `weight` (its energy in J at
    /// 1 mm is its thousandth in N).
    pub fn is_consistent(&self, weight: f64) -> bool {
        self.missed <= CONSISTENCY * self.forces + weight
    }
}
