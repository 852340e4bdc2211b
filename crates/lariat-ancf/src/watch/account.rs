//! The energy balance of one cable, or of the island of which it is the first, from host step to
//! host step. Equation: [`EnergyBalance`].

use super::balance::{EnergyBalance, Sizes};
use crate::scales::term::TOLERANCE;
use serde::{Deserialize, Serialize};

/// The balance of one cable, or of the island of which it is the first.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct CableAccount {
    pub(crate) last: Option<Last>,
    /// Of an island, what its energies are compared with.
    #[serde(default)]
    pub(crate) island: Option<Start>,
    /// Largest rounding error of an energy, and the sum of what is uncertain, in J.
    #[serde(default)]
    pub(crate) errors: [f64; 2],
    #[serde(skip)]
    pub(crate) buffer: Vec<f64>,
    pub(crate) balance: EnergyBalance,
}

/// Terms at the last host time, and the revision of the cable then.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Last {
    pub(crate) revision: u64,
    pub(crate) terms: CableTerms,
    /// At the first host time of those that are compared.
    pub(crate) strain: f64,
    pub(crate) gravity: f64,
}

/// Energies of an island in J when its cables and bodies were first read together, and their
/// number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Start {
    pub(crate) parts: [usize; 2],
    pub(crate) strain: f64,
    pub(crate) gravity: f64,
}

/// Energies of a cable, and works on it since it was built, in J: the terms of a balance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CableTerms {
    /// Kinetic energy.
    pub kinetic: f64,
    /// Strain energy, and that of potentials.
    pub strain: f64,
    /// Energy of gravity.
    pub gravity: f64,
    /// Energy that damping, drag, friction and impacts took.
    pub dissipated: f64,
    /// Work of loads, moving supports, flows, reels and other bodies.
    pub work: f64,
    /// Of that, the work of the forces on the bodies of its island.
    #[serde(default)]
    pub on_bodies: f64,
    /// Energy that the law of the discrete gradient says was made, less what it lost.
    pub by_law: f64,
    /// By how much the works may be wrong.
    #[serde(default)]
    pub uncertain: f64,
}

impl CableTerms {
    /// Returns the sum of energies and dissipated energy, less the work: constant but for what
    /// integration makes or loses.
    pub fn sum(&self) -> f64 {
        self.kinetic + self.strain + self.gravity + self.dissipated - self.work
    }

    /// Adds the terms of another cable.
    pub fn add(&mut self, other: &CableTerms) {
        self.kinetic += other.kinetic;
        self.strain += other.strain;
        self.gravity += other.gravity;
        self.dissipated += other.dissipated;
        self.work += other.work;
        self.on_bodies += other.on_bodies;
        self.by_law += other.by_law;
        self.uncertain += other.uncertain;
    }
}

/// What a step of integration made of an island, cables and the bodies that move with them: for
/// [`Cable::note_island`](crate::coupling::Coupling::note_island).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct IslandChange {
    /// Change of the balance in J.
    pub made: f64,
    /// True if that is the energy law of the discrete gradient.
    pub by_law: bool,
    /// Energy that damping, drag, friction and impacts took in the step, in J.
    pub dissipated: f64,
    /// Work on the cables in the step in J, but that of gravity.
    pub work: f64,
    /// Energies at the end of the step in J, not their changes, and the weight.
    pub sizes: Sizes,
    /// By how much the works may be wrong, in J.
    pub uncertain: f64,
    /// Number of cables and of bodies.
    pub parts: [usize; 2],
}

impl CableAccount {
    /// Leaves the coming step out, because a program changes the state before it.
    pub fn interrupt(&mut self) {
        self.last = None;
    }

    /// Notes the rounding errors of energies of this sum, and what is uncertain of a step, in J.
    pub(crate) fn note_errors(&mut self, held: f64, uncertain: f64) {
        let [rounding, sum] = self.errors;
        self.errors = [rounding.max(TOLERANCE * held), sum + uncertain];
        self.balance.rounding_j = self.errors.iter().sum();
    }

    /// Adds a step of the island, which ended at a time in s. Differences are within steps alone:
    /// an island that changes between them needs no new account, only other energies to begin with.
    pub(crate) fn add(&mut self, time: f64, step: &IslandChange) {
        let Sizes { kinetic, strain, gravity, .. } = step.sizes;
        let parts = step.parts;
        let start = self.island.filter(|start| start.parts == parts).unwrap_or(Start { parts, strain, gravity });
        self.island = Some(start);
        self.balance.dissipated_j += step.dissipated;
        self.balance.work_j += step.work;
        self.note_errors(kinetic + strain.abs() + gravity.abs(), step.uncertain);
        let sizes = Sizes { strain: strain - start.strain, gravity: gravity - start.gravity, ..step.sizes };
        let excuse = if step.by_law { step.dissipated } else { 0.0 };
        self.balance.add(time, step.made, excuse, &sizes);
    }
}
