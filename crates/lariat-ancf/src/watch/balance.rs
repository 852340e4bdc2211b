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
//! The work on one cable is that of its effects, loads, supports and reels. A cable that exchanges
//! energy with dynamic bodies or other cables has the balance of all that moves together with it,
//! its island, of which the first cable tells ([`IslandChange`]); a run of a scene has one of
//! everything. Energy made above 1e-3 S, or lost above 1e-2 S, beyond what rounding may account
//! for, is worth a warning.
//!
//! # Validity
//!
//! The discrete gradient has an energy law: B is then its residual less what it lost. The residual
//! of a step may be a hundredth of what damping, friction and impacts take in that step, and as
//! much of it does not count as made; what others lost before excuses nothing. A cable with a reel
//! is judged by its works, those of the winch among them, unless it has contact, too. A step in
//! which a program changes positions, velocities, loads, supports or effects is left out. The
//! balance is no estimate of the error of positions.
//!
//! # References
//!
//! Work-energy theorem; quadratures: [`Cable::effect_work`](crate::Cable::effect_work),
//! [`Cable::energy_law`](crate::Cable::energy_law).
//!
//! # Alternatives considered
//!
//! The total energy alone: it changes by the work of loads and moving supports, and by damping.
//! Lost energy told only where it is more than a quarter of what damping took: a bridge whose
//! forces are 7 % off was silent (seed 5110 of tests/seeds of lariat-rapier). Made beyond all
//! energy that was dissipated since the start: a grapple that made 170 J of 6.2 kJ was silent,
//! because friction had taken 1 kJ before.

use crate::scales::LEAST_HEIGHT;
use crate::scales::term::CLOSURE;
use crate::scales::watch::{LEAST_STRAIN_OF_RUN, LOST, MADE};
use serde::{Deserialize, Serialize};

/// The energy of a run: what integration made or lost, and what to compare it with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct EnergyBalance {
    /// Change of the energy less the work at the end, in J: what integration made, or lost.
    pub balance_j: f64,
    /// What of it is not counted as made, in J: the share that the energy law leaves to a step of
    /// what damping, friction and impacts take in it.
    #[serde(default)]
    pub excused_j: f64,
    /// Most that it had made at a host time in J.
    pub made_j: f64,
    /// Host time of that in s.
    pub made_at_s: f64,
    /// Most that it had lost at a host time in J.
    pub lost_j: f64,
    /// Host time of that in s.
    pub lost_at_s: f64,
    /// Energy of the run in J, to compare with: the largest of kinetic energy, changes of strain
    /// energy and of that of gravity, dissipated energy, work, all weight times 1 mm, and the
    /// energy of a strain of 1e-6 of all cables.
    pub scale_j: f64,
    /// Errors in J that the balance may have: rounding of the energies, which are differences, and
    /// of the positions of bodies in single precision, by which the forces of cables do work in
    /// every step; and in steps that do not resolve the motion, of the quadrature of what damping
    /// and drag take.
    pub rounding_j: f64,
    /// Energy that damping and drag took in J.
    pub dissipated_j: f64,
    /// Work on cables of loads, moving supports, flows and other bodies in J.
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

    /// Returns the share of the energy of the run that integration lost at most, beyond rounding
    /// errors.
    pub fn lost(&self) -> f64 {
        self.share(self.lost_j)
    }

    fn share(&self, energy: f64) -> f64 {
        let beyond = energy - self.rounding_j;
        if beyond > 0.0 { beyond / self.scale_j } else { 0.0 }
    }

    /// Adds the change (J) of the balance in the host step that ended at a time in s, after
    /// dissipated energy and work were set; `excuse` is what was dissipated (J) in this step, if
    /// the change is that of the energy law of the discrete gradient, else 0.
    pub fn add(&mut self, time: f64, change: f64, excuse: f64, sizes: &Sizes) {
        self.balance_j += change;
        self.excused_j += (CLOSURE * excuse).max(0.0).min(change.max(0.0));
        let Sizes { kinetic, strain, gravity, weight, stiffness } = *sizes;
        let least = (weight * LEAST_HEIGHT).max(0.5 * stiffness * LEAST_STRAIN_OF_RUN * LEAST_STRAIN_OF_RUN);
        let sizes = [least, kinetic, strain, gravity, self.dissipated_j, self.work_j];
        self.scale_j = sizes.iter().fold(self.scale_j, |largest, size| largest.max(size.abs()));
        let made = self.balance_j - self.excused_j;
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Energy that is made after friction took more is made: 1 J in each of 100 steps, after 1 kJ
    /// was dissipated, of a run that exchanged 1 kJ. What a step makes up to a hundredth of what it
    /// dissipates itself is within the law.
    ///
    /// *Source.* The sums.
    #[test]
    fn what_others_lost_before_excuses_nothing() {
        let sizes = Sizes { kinetic: 10.0, ..Sizes::default() };
        let mut balance = EnergyBalance::default();
        for i in 0..100 {
            balance.dissipated_j += 10.0;
            balance.add(f64::from(i), 0.005 * 10.0, 10.0, &sizes);
        }
        assert!(balance.made() == 0.0 && (balance.excused_j - 5.0).abs() < 1e-9, "{balance:?}");
        assert_eq!(balance.verdict(), None);
        for i in 100..200 {
            balance.add(f64::from(i), 1.0, 0.0, &sizes);
        }
        assert!((balance.made() - 0.1).abs() < 1e-9, "{balance:?}");
        assert!(matches!(balance.verdict(), Some(Verdict::Made(..))));
    }
}
