//! The energy balance of a run: what integration made or lost.
//!
//! # Equation
//!
//! ```text
//! B(t) = change of (kinetic + strain + gravity) + dissipated - work
//! S(t) = largest of kinetic energy, change of strain energy, change of gravity's, dissipated energy, work, weight times 1 mm, the energy of
//!                a strain of 1e-6, so far
//! ```
//!
//! The work on one cable is that of its effects, loads, supports and reels. A cable that exchanges energy with dynamic bodies or other cables has
//! the balance of all that moves together with it, its island, of which the first cable tells ([`IslandChange`]); a run of a scene has one of everything.
//! Energy made above 1e-3 S, or lost above 1e-2 S, beyond what rounding may account for, is worth a warning.
//!
//! # Validity
//!
//! The discrete gradient has an energy law: B is then its residual less what it lost, and counts as made beyond the energy that damping took,
//! because the residual of a step may be as large. A step in which a program changes positions, velocities, loads, supports or effects is left
//! out. The balance is no estimate of the error of positions.
//!
//! # References
//!
//! Work-energy theorem; quadratures: [`Cable::effect_work`], [`Cable::energy_law`].
//!
//! # Alternatives considered
//!
//! The total energy alone: it changes by the work of loads and moving supports, and by damping.

use crate::cable::Cable;
use crate::integrate::Method;
use serde::{Deserialize, Serialize};

/// Share of the energy of a run above which energy that it makes is warned of.
const MADE: f64 = 1e-3;
/// Share of the energy of a run above which energy that integration takes is warned of.
const LOST: f64 = 1e-2;
/// Rounding error of a balance over the energy of cables: that of statics.
pub const ROUNDING: f64 = 1e-9;
/// Height in m over which all weight is the least energy to compare with, as in the law of the discrete gradient.
const LEAST_HEIGHT: f64 = 1e-3;
/// Strain of all cables that is the least energy to compare with, where nothing has weight and all is at rest.
const LEAST_STRAIN: f64 = 1e-6;

/// The energy of a run: what integration made or lost, and what to compare it with.
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
    /// Errors in J that the balance may have: rounding of the energies, which are differences, and of the positions of bodies in single
    /// precision, by which the forces of cables do work in every step; and in steps that do not resolve the motion, of the quadrature of what damping
    /// and drag take.
    pub rounding_j: f64,
    /// Energy that damping and drag took in J.
    pub dissipated_j: f64,
    /// Work of loads, moving supports, flows and other bodies in J.
    pub work_j: f64,
}

/// Energies (J) and sizes at a host time, to compare a balance with.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sizes {
    /// Kinetic energy in J.
    pub kinetic: f64,
    /// Change of the strain energy in J.
    pub strain: f64,
    /// Change of the energy of gravity in J.
    pub gravity: f64,
    /// Weight of everything in N.
    pub weight: f64,
    /// Sum of axial stiffness times length in J.
    pub stiffness: f64,
}

/// What a balance is worth a warning for: time (s), energy (J), and the energy to compare with (J).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// Integration made this energy.
    Made(f64, f64, f64),
    /// Integration lost this energy.
    Lost(f64, f64, f64),
}

impl EnergyBalance {
    /// Returns the share of the energy of the run that integration made, beyond rounding errors.
    pub fn made(&self) -> f64 {
        self.share(self.made_j)
    }

    /// Returns the share of the energy of the run that integration lost at most, beyond rounding errors.
    pub fn lost(&self) -> f64 {
        self.share(self.lost_j)
    }

    fn share(&self, energy: f64) -> f64 {
        let beyond = energy - self.rounding_j;
        if beyond > 0.0 { beyond / self.scale_j } else { 0.0 }
    }

    /// Adds the change (J) of the balance in the host step that ended at a time in s, after dissipated energy and work were set; `by_law` if it is
    /// that of the energy law of the discrete gradient, which sees to it that a step makes no more than damping takes.
    pub fn add(&mut self, time: f64, change: f64, by_law: bool, sizes: &Sizes) {
        self.balance_j += change;
        let Sizes { kinetic, strain, gravity, weight, stiffness } = *sizes;
        let least = (weight * LEAST_HEIGHT).max(0.5 * stiffness * LEAST_STRAIN * LEAST_STRAIN);
        let sizes = [least, kinetic, strain, gravity, self.dissipated_j, self.work_j];
        self.scale_j = sizes.iter().fold(self.scale_j, |largest, size| largest.max(size.abs()));
        let made = self.balance_j - if by_law { self.dissipated_j.max(0.0) } else { 0.0 };
        if made > self.made_j {
            (self.made_j, self.made_at_s) = (made, time);
        }
        if -self.balance_j > self.lost_j {
            (self.lost_j, self.lost_at_s) = (-self.balance_j, time);
        }
    }

    /// Returns what is worth a warning: energy made, or else energy lost.
    pub fn verdict(&self) -> Option<Verdict> {
        if self.made() > MADE {
            return Some(Verdict::Made(self.made_at_s, self.made_j, self.scale_j));
        }
        (self.lost() > LOST).then_some(Verdict::Lost(self.lost_at_s, self.lost_j, self.scale_j))
    }
}

/// The balance of one cable, or of the island of which it is the first.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct CableAccount {
    last: Option<Last>,
    /// Of an island, what its energies are compared with.
    #[serde(default)]
    island: Option<Start>,
    /// Largest rounding error of an energy, and the sum of what is uncertain, in J.
    #[serde(default)]
    errors: [f64; 2],
    #[serde(skip)]
    buffer: Vec<f64>,
    pub balance: EnergyBalance,
}

/// Terms at the last host time, and the revision of the cable then.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Last {
    revision: u64,
    terms: CableTerms,
    /// At the first host time of those that are compared.
    strain: f64,
    gravity: f64,
}

/// Energies of an island in J when its cables and bodies were first read together, and their number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Start {
    parts: [usize; 2],
    strain: f64,
    gravity: f64,
}

/// Energies of a cable, and works on it since it was built, in J: the terms of a balance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CableTerms {
    /// Kinetic energy.
    pub kinetic: f64,
    /// Strain energy.
    pub strain: f64,
    /// Energy of gravity.
    pub gravity: f64,
    /// Energy that damping, drag, friction and impacts took.
    pub dissipated: f64,
    /// Work of loads, moving supports, flows, reels and other bodies.
    pub work: f64,
    /// Energy that the law of the discrete gradient says was made, less what it lost.
    pub by_law: f64,
    /// By how much the works may be wrong.
    #[serde(default)]
    pub uncertain: f64,
}

impl CableTerms {
    /// Reads the works on a cable, without its energies.
    pub fn of_works(cable: &Cable) -> Self {
        let (effects, law) = (cable.effect_work(), cable.energy_law());
        let dissipated = effects.dissipated() + law.contacts + law.impacts;
        let reels: f64 = cable.reels().map(|reel| reel.work + reel.remeshed).sum();
        // impacts do no work: they take energy
        let of_effects = effects.total() + dissipated - law.impacts;
        CableTerms {
            dissipated,
            work: of_effects + law.loads + law.supports + cable.inserted_energy() + reels,
            by_law: law.residual - law.numerical - law.rescaled,
            uncertain: law.uncertain,
            ..CableTerms::default()
        }
    }

    /// Reads energies and works of a cable; `buffer` is for its momenta.
    pub fn of(cable: &Cable, buffer: &mut Vec<f64>) -> Self {
        let energy = cable.energy_in(buffer);
        let (kinetic, strain, gravity) = (energy.kinetic, energy.axial + energy.bending, energy.gravity);
        CableTerms { kinetic, strain, gravity, ..CableTerms::of_works(cable) }
    }

    /// Returns the sum of energies and dissipated energy, less the work: constant but for what integration makes or loses.
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
        self.by_law += other.by_law;
        self.uncertain += other.uncertain;
    }
}

/// What a step of integration made of an island, cables and the bodies that move with them: for [`Cable::note_island`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct IslandChange {
    /// Change of the balance in J.
    pub made: f64,
    /// True if that is the energy law of the discrete gradient.
    pub by_law: bool,
    /// Energy that damping, drag, friction and impacts took in the step, in J.
    pub dissipated: f64,
    /// Work on cables and bodies in the step in J, but that of gravity.
    pub work: f64,
    /// Energies at the end of the step in J, not their changes, and the weight.
    pub sizes: Sizes,
    /// By how much the works may be wrong, in J.
    pub uncertain: f64,
    /// Number of cables and of bodies.
    pub parts: [usize; 2],
}

/// Returns the weight of a cable in N and its axial stiffness times its length in J.
pub fn weight_and_stiffness(cable: &Cable) -> (f64, f64) {
    let gravity = cable.gravity().norm();
    let of_element =
        |e: &crate::Element| (e.section.mass_per_length * e.length * gravity, e.section.axial_stiffness * e.length);
    cable.elements().iter().map(of_element).fold((0.0, 0.0), |sum, part| (sum.0 + part.0, sum.1 + part.1))
}

impl CableAccount {
    /// Leaves the coming step out, because a program changes the state before it.
    pub fn interrupt(&mut self) {
        self.last = None;
    }

    /// Reads the cable at a host time.
    pub fn note(&mut self, cable: &Cable) {
        let terms = CableTerms::of(cable, &mut self.buffer);
        let now = Last { revision: cable.revision, terms, strain: terms.strain, gravity: terms.gravity };
        let Some(last) = self.last.replace(now).filter(|last| last.revision == now.revision) else { return };
        self.last = Some(Last { strain: last.strain, gravity: last.gravity, ..now });
        let by_law = cable.integrator().method == Method::DiscreteGradient && !cable.has_reel();
        let change = if by_law { terms.by_law - last.terms.by_law } else { terms.sum() - last.terms.sum() };
        self.balance.dissipated_j += terms.dissipated - last.terms.dissipated;
        self.balance.work_j += terms.work - last.terms.work;
        self.note_errors(
            terms.kinetic + terms.strain.abs() + terms.gravity.abs(),
            terms.uncertain - last.terms.uncertain,
        );
        let (weight, stiffness) = weight_and_stiffness(cable);
        let sizes = Sizes {
            kinetic: terms.kinetic,
            strain: terms.strain - last.strain,
            gravity: terms.gravity - last.gravity,
            weight,
            stiffness,
        };
        self.balance.add(cable.time(), change, by_law, &sizes);
    }

    /// Notes the rounding errors of energies of this sum, and what is uncertain of a step, in J.
    fn note_errors(&mut self, held: f64, uncertain: f64) {
        let [rounding, sum] = self.errors;
        self.errors = [rounding.max(ROUNDING * held), sum + uncertain];
        self.balance.rounding_j = self.errors.iter().sum();
    }

    /// Adds a step of the island, which ended at a time in s. Differences are within steps alone: an island that changes between them needs no new
    /// account, only other energies to begin with.
    fn add(&mut self, time: f64, step: &IslandChange) {
        let Sizes { kinetic, strain, gravity, .. } = step.sizes;
        let parts = step.parts;
        let start = self.island.filter(|start| start.parts == parts).unwrap_or(Start { parts, strain, gravity });
        self.island = Some(start);
        self.balance.dissipated_j += step.dissipated;
        self.balance.work_j += step.work;
        self.note_errors(kinetic + strain.abs() + gravity.abs(), step.uncertain);
        let sizes = Sizes { strain: strain - start.strain, gravity: gravity - start.gravity, ..step.sizes };
        self.balance.add(time, step.made, step.by_law, &sizes);
    }
}

impl Cable {
    /// Returns the energy balance since the cable is [watched](Self::set_watched): its own, or of the first cable of an [island](crate::island) that of
    /// all that moves together with it; `None` if it is not watched.
    pub fn energy_balance(&self) -> Option<EnergyBalance> {
        self.watch.as_deref().map(|watch| watch.account.balance)
    }

    /// Adds a step of the [island](crate::island) of which it is the first cable to its energy balance, if it is watched: for those who step islands.
    pub fn note_island(&mut self, step: &IslandChange) {
        let time = self.time();
        if let Some(watch) = &mut self.watch {
            watch.account.add(time, step);
        }
    }
}
