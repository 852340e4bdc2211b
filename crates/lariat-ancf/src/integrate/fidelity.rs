//! Presets: an integrator and a recommended number of elements for each of three levels of
//! accuracy.
//!
//! The figures of each preset are those of `docs/accuracy/fidelity.csv`, which `lariat report`
//! measures; a test of `lariat-bench` compares them with that file.
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/integration.md.

use super::integrator::{Integrator, StepControl};
use super::method::Method;
use crate::error::{Error, nearest};
use crate::rule::{BendingRule, Rule};
use crate::scales::integrate::MAX_EXPLICIT_FREQUENCY;
use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// Accuracy against time: a preset, or an integrator of your own, which converts to it.
///
/// Each preset is measured in three scenes, with its own integrator, its own rule, and the number
/// of elements in the table (`docs/accuracy`, CPU time of one thread): *pendulum*, the paper's, 2
/// s, against the beam without discretisation; *payload*, a crate of 50 kg in Rapier on a cable, 1
/// s, against an independent code; *taut steel*, a plucked cable of 10 mm, 0.1 s, against its
/// analytic modes (amplitude 1e-4 m). The payload's cable vibrates undamped, and a tolerance
/// resolves that vibration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Fidelity {
    /// Guarded discrete gradient at h <= 1/240 s: it cannot make energy, and costs the same in
    /// every step of a smooth motion.
    ///
    /// | scene | elements | error m | CPU ms |
    /// |---|---:|---:|---:|
    /// | pendulum | 10 | 2.6e-3 | 2.32 |
    /// | payload | 10 | 8.9e-3 | 5.03 |
    /// | taut steel | 10 | 1.9e-4 | 0.107 |
    Game,
    /// Error-controlled ESDIRK4, 1e-6 m per host step of the motion: the default. With contact,
    /// torsion, clutches, sheaves or drums [`Integrator::COUPLED`].
    ///
    /// | scene | elements | error m | CPU ms |
    /// |---|---:|---:|---:|
    /// | pendulum | 20 | 3.7e-4 | 11.1 |
    /// | payload | 10 | 8.7e-4 | 140 |
    /// | taut steel | 20 | 5.6e-5 | 1.08 |
    #[default]
    Engineering,
    /// The symplectic explicit method of order 4 at half its stable step where the cable is soft
    /// enough (omega_max below 5e4 rad/s), else ESDIRK4 at 1e-9 m per host step.
    ///
    /// | scene | elements | error m | CPU ms |
    /// |---|---:|---:|---:|
    /// | pendulum | 80 | 4.0e-6 | 1400 |
    /// | payload | 10 | 1.3e-4 | 264 |
    /// | taut steel | 80 | 2.0e-8 | 227 |
    Reference,
    /// This integrator.
    Custom(Integrator),
}

impl Fidelity {
    /// All presets, from the cheapest.
    pub const ALL: [Fidelity; 3] = [Fidelity::Game, Fidelity::Engineering, Fidelity::Reference];

    /// Returns the name: `game`, `engineering`, `reference` or `custom`.
    pub fn name(self) -> &'static str {
        match self {
            Fidelity::Game => "game",
            Fidelity::Engineering => "engineering",
            Fidelity::Reference => "reference",
            Fidelity::Custom(_) => "custom",
        }
    }

    /// Returns the force strategy of a cable for which none is chosen: the default rule, which has
    /// the smallest error for its time in `docs/accuracy`; for [`Game`](Self::Game) `projected-T1`,
    /// whose force of bending is linear. It costs a tenth less, kinks softly, and differs by less
    /// than a step of 1/240 s does.
    pub fn rule(self) -> Rule {
        match self {
            Fidelity::Game => Rule { bending: BendingRule::T1, ..Rule::default() },
            Fidelity::Engineering | Fidelity::Reference | Fidelity::Custom(_) => Rule::default(),
        }
    }

    /// Returns the recommended number of elements: the mesh error is about the time error for a
    /// cable that swings and bends as the pendulum of `docs/accuracy` does. A taut cable needs
    /// fewer elements, one with sharper bends more. For an integrator of your own it is that of
    /// [`Engineering`](Self::Engineering).
    pub fn elements(self) -> usize {
        match self {
            Fidelity::Game => 10,
            Fidelity::Engineering | Fidelity::Custom(_) => 20,
            Fidelity::Reference => 80,
        }
    }

    /// Returns the integrator for a cable whose frequencies stay below `frequency_bound` (rad/s).
    pub fn integrator(self, frequency_bound: f64) -> Integrator {
        match self {
            Fidelity::Game => {
                Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) }
            }
            Fidelity::Engineering => Integrator::default(),
            Fidelity::Reference if frequency_bound < MAX_EXPLICIT_FREQUENCY => {
                Integrator { method: Method::Rkn4, control: StepControl::Stable(0.5) }
            }
            Fidelity::Reference => Integrator { method: Method::Esdirk4, control: StepControl::Tolerance(1e-9) },
            Fidelity::Custom(integrator) => integrator,
        }
    }
}

impl FromStr for Fidelity {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self, Error> {
        Fidelity::ALL.into_iter().find(|fidelity| fidelity.name() == text).ok_or_else(|| Error::UnknownFidelity {
            name: text.to_string(),
            suggestion: nearest(text, Fidelity::ALL.map(|fidelity| fidelity.name().to_string())),
        })
    }
}

impl From<Integrator> for Fidelity {
    fn from(integrator: Integrator) -> Self {
        Fidelity::Custom(integrator)
    }
}
